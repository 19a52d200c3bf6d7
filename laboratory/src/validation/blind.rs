//! Sizing of simulated signals: the sensor of a scene with a spall is recorded, and the spall sized by the same scene
//! without it.

use std::fmt::Write;

use anyhow::Result;
use brinell::scene::Scene;
use brinell_analysis::recording::Recording;
use brinell_analysis::sizing;
use brinell_analysis::sizing::{Report, Verdict};
use brinell_analysis::statistics::{Random, rms};

use super::page::Page;
use fmu_build::paper::Case;
use fmu_build::shared::{Project, contact_map};

const RATE: f64 = 51_200.0;
/// Passages in a recording.
const PASSAGES: f64 = 60.0;
/// Noise of a tenth of the signal's root mean square: 20 dB below it.
const NOISE: f64 = 0.1;

/// Fills in `blind`, `blind_short` and `blind_extended`.
pub fn fill(project: &Project, page: &Page) -> Result<()> {
    let mut table = String::new();
    for (label, name, load) in [
        ("100 µm, 4000 N", "er16k-tb2", 4000.0),
        ("100 µm, 500 N", "er16k-tb2", 500.0),
        ("100 µm, 600 N", "er16k-tb2", 600.0),
        ("30 µm, 500 N", "er16k-tb2-30um", 500.0),
        ("30 µm, 600 N", "er16k-tb2-30um", 600.0),
    ] {
        let case = Case::shipped(name)?.with_load(load);
        let found = sized(project, &case, recorded(project, &case)?, 1.0)?;
        let warned = if found.reason.contains("WARNING") { "yes" } else { "no" };
        let kind = format!("{:?}", found.kind).to_lowercase();
        let critical = found.critical_load_n.map_or("–".to_owned(), |load| format!("{load:.0}"));
        writeln!(table, "| {label} | {} | {kind} | {critical} | {warned} |", verdict(&found))?;
    }
    page.set_rows("blind_extended", &table)?;
    let rig = Case::shipped("er16k-tb1")?;
    let mut table = String::new();
    for length in [0.0, 0.5, 1.0, 1.3] {
        let case = rig.clone().with_spall(length, 100e-6).at_speed(25.0);
        let signal = recorded(project, &case)?;
        for noise in [0.0, NOISE] {
            let found = sized(project, &case, with_noise(&signal, noise), 1.0)?;
            let label = if length == 0.0 { "healthy".to_owned() } else { format!("{length:.1}°") };
            let noise = if noise > 0.0 { "20 dB" } else { "none" };
            writeln!(table, "| {label} | {noise} | {} | {} |", verdict(&found), short(&found.reason))?;
        }
    }
    page.set_rows("blind_short", &table)?;
    let mut table = String::new();
    for length in [2.0, 5.0, 8.0, rig.length()] {
        for speed in [10.0, 25.0] {
            let case = rig.clone().with_spall(length, 100e-6).at_speed(speed);
            let signal = recorded(project, &case)?;
            let mut row = format!("| {length:.1} | {:.0} |", 60.0 * speed);
            for noise in [0.0, NOISE] {
                let found = sized(project, &case, with_noise(&signal, noise), 1.0)?;
                match found.length_deg {
                    Some(deg) => write!(row, " {deg:.2} ({:+.1} %) |", 100.0 * (deg / length - 1.0))?,
                    None => write!(row, " unresolved |")?,
                }
            }
            writeln!(table, "{row}")?;
        }
    }
    page.set_rows("blind", &table)?;
    Ok(())
}

/// What the sensor records.
pub fn recorded(project: &Project, case: &Case) -> Result<Vec<f64>> {
    Ok(case.record(project, &["sensor.acceleration"], RATE, PASSAGES / case.bpfo())?.remove(0))
}

/// The recording sized by the case's scene without its defect; `speed` is in shaft speeds of the case.
fn sized(project: &Project, case: &Case, signal: Vec<f64>, speed: f64) -> Result<Report> {
    let blind = Scene { defects: Vec::new(), ..case.scene.clone() };
    let recording = Recording::new("simulated", signal, RATE, speed * case.shaft_speed())?;
    let maps = |scene: &Scene| contact_map::of(scene, None, project).ok().flatten();
    Ok(sizing::size_with(&[recording], &blind, &maps, &mut |_| ())?)
}

fn with_noise(signal: &[f64], noise: f64) -> Vec<f64> {
    let (rms, mut random) = (rms(signal), Random::new(1));
    signal.iter().map(|x| x + noise * rms * random.normal()).collect()
}

fn verdict(found: &Report) -> String {
    match found.verdict {
        Verdict::Resolved => found.length_deg.map_or_else(String::new, |deg| format!("{deg:.2}°")),
        Verdict::Unresolved => "unresolved".to_owned(),
    }
}

/// The reason without the name of the recording.
fn short(reason: &str) -> String {
    reason.split("simulated: ").last().unwrap_or(reason).to_owned()
}
