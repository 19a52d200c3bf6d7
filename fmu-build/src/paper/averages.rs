//! Averaged passages and their characteristic frequencies: the paper's Figure 6, at its nominal depth and under the two
//! assumptions by which the extended spall's floor comes to carry load between 500 and 600 N.

use anyhow::Result;
use brinell_analysis::sizing::passages::fold;
use brinell_analysis::sizing::waveform::{Ringing, ringing, synthesis};

use super::Case;
use crate::shared::Project;

/// Samples per second.
pub const RATE: f64 = 51_200.0;
/// Share of a period before the entry.
const LEAD: f64 = 0.25;
/// Passages left out at the start, and passages averaged: chatter differs from passage to passage.
const SKIP: usize = 4;
const COUNT: usize = 24;

/// One panel of the figure.
#[derive(Debug, Clone, Copy)]
pub struct Panel {
    /// Its key in files.
    pub key: &'static str,
    /// What it is called.
    pub label: &'static str,
    /// The shipped scene.
    pub scene: &'static str,
    /// Load (N).
    pub load: f64,
    /// The paper's frequencies, in words.
    pub paper: &'static str,
}

const fn panel(key: &'static str, label: &'static str, scene: &'static str, load: f64, paper: &'static str) -> Panel {
    Panel { key, label, scene, load, paper }
}

/// What is run.
pub const PANELS: [Panel; 7] = [
    panel("tb1", "TB1, 500 N", "er16k-tb1", 500.0, "≈ 1000 Hz"),
    panel("tb2-500", "TB2, 500 N", "er16k-tb2", 500.0, "≈ 600 Hz"),
    panel("tb2-600", "TB2, 600 N", "er16k-tb2", 600.0, "rises"),
    panel("30um-500", "TB2 30 µm deep, 500 N", "er16k-tb2-30um", 500.0, "≈ 600 Hz"),
    panel("30um-600", "TB2 30 µm deep, 600 N", "er16k-tb2-30um", 600.0, "rises"),
    panel("soft-500", "TB2 compliant, 500 N", "er16k-tb2-compliant", 500.0, "≈ 600 Hz"),
    panel("soft-600", "TB2 compliant, 600 N", "er16k-tb2-compliant", 600.0, "rises"),
];

impl Panel {
    /// The scene under its load.
    ///
    /// # Errors
    /// None of a shipped scene.
    pub fn case(&self) -> Result<Case> {
        Ok(Case::shipped(self.scene)?.with_load(self.load))
    }
}

/// Times of an averaged passage's samples, from the entry (s).
pub fn times(case: &Case, samples: usize) -> Vec<f64> {
    (0..samples).map(|k| k as f64 / RATE - LEAD / case.bpfo()).collect()
}

/// The sensor's averaged passage.
///
/// # Errors
/// Of the simulation.
pub fn averaged(project: &Project, case: &Case) -> Result<Vec<f64>> {
    let seconds = (SKIP + COUNT + 2) as f64 / case.bpfo();
    let run = case.record(project, &["sensor.acceleration"], RATE, seconds)?;
    Ok(case.average(&run[0], RATE, case.length(), LEAD, SKIP))
}

/// Strongest frequency after the entry, and after the next exit.
pub fn rings(case: &Case, passage: &[f64]) -> Option<Ringing> {
    let spacing = 360.0 / case.scene.bearing.element_count as f64;
    let over = case.length().rem_euclid(spacing);
    // From the entry on, on a grid of degrees; half a degree to a degree after an event is left to the event itself.
    let row = fold::cut(passage, &[0.0], passage.len() as f64 - 1.0, synthesis::POINTS).pop()?;
    let smooth = synthesis::below_cut(&row, case.bpfo());
    let n = smooth.len();
    let stretch = |from: f64, to: f64| -> Vec<f64> {
        let point = |degrees: f64| ((LEAD + degrees / spacing) * n as f64) as usize;
        (point(from)..point(to)).map(|k| smooth[k % n]).collect()
    };
    let rate = case.bpfo() * n as f64;
    let after_entry = ringing::strongest(&stretch(1.0, over - 1.0), rate)?;
    let after_exit = ringing::strongest(&stretch(over + 0.5, spacing - 0.5), rate)?;
    Some(Ringing { after_entry, after_exit })
}
