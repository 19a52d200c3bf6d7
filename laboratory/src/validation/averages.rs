//! Averaged passages and their characteristic frequencies: the paper's Figure 6, at its nominal depth and under the two
//! assumptions by which the extended spall's floor comes to carry load between 500 and 600 N.

use std::fmt::Write;

use anyhow::Result;
use brinell::scene::{ContactLaw, DefectShape};
use brinell_analysis::sizing::passages::fold;
use brinell_analysis::sizing::waveform::{Rig, Trial, synthesis};
use brinell_analysis::sizing::waveform::{Ringing, ringing};
use brinell_analysis::statics::StaticBearing;

use super::runs::Case;
use super::{LAWS, Values, write_csv};
use fmu_build::shared::Project;

const RATE: f64 = 51_200.0;
/// Share of a period before the entry.
const LEAD: f64 = 0.25;
/// Passages left out at the start, and passages averaged: chatter differs from passage to passage.
const SKIP: usize = 4;
const COUNT: usize = 24;

/// What is run: key, label, scene and load (N), and the paper's frequencies.
const CASES: [(&str, &str, &str, f64, &str); 7] = [
    ("tb1", "TB1, 500 N", "er16k-tb1", 500.0, "≈ 1000 Hz"),
    ("tb2-500", "TB2, 500 N", "er16k-tb2", 500.0, "≈ 600 Hz"),
    ("tb2-600", "TB2, 600 N", "er16k-tb2", 600.0, "rises"),
    ("30um-500", "TB2 30 µm deep, 500 N", "er16k-tb2-30um", 500.0, "≈ 600 Hz"),
    ("30um-600", "TB2 30 µm deep, 600 N", "er16k-tb2-30um", 600.0, "rises"),
    ("soft-500", "TB2 compliant, 500 N", "er16k-tb2-compliant", 500.0, "≈ 600 Hz"),
    ("soft-600", "TB2 compliant, 600 N", "er16k-tb2-compliant", 600.0, "rises"),
];

/// Fills in `frequencies` and `lighter`, and writes the averaged passages that the spectrograms show.
pub fn fill(project: &Project, values: &mut Values) -> Result<()> {
    let mut table = String::new();
    let mut time = Vec::new();
    let (mut names, mut columns) = (vec![("time".to_owned(), "s")], Vec::new());
    for (key, label, scene, load, paper) in CASES {
        let case = Case::shipped(project, scene)?.with_load(load);
        let mut row = Vec::new();
        for law in LAWS {
            // The compliant assembly's approaches go beyond the map.
            if law == ContactLaw::Map && scene == "er16k-tb2-compliant" {
                row.push("–".to_owned());
                continue;
            }
            let case = case.clone().with_law(law);
            let passage = averaged(project, &case)?;
            row.push(shown(rings(&case, &passage)));
            let own = case.scene.contact.law == Case::shipped(project, scene)?.scene.contact.law;
            if own {
                time = (0..passage.len()).map(|k| k as f64 / RATE - LEAD / case.bpfo()).collect();
                names.push((format!("{key} sensor.acceleration"), "m/s2"));
                columns.push(passage);
            }
        }
        let expected = shown(expected(&case));
        writeln!(table, "| {label} | {paper} | {} | {expected} | {:.0} |", row.join(" | "), least_stiffness(&case)?)?;
    }
    values.set("frequencies", table)?;
    // The periods of all scenes are equal: one bearing, one speed.
    let mut all = vec![time];
    all.extend(columns);
    write_csv(project, "averages", &names, &all)?;
    values.set("lighter", lighter(project)?)?;
    Ok(())
}

/// The ring masses with which the prototype came nearest to the paper.
fn lighter(project: &Project) -> Result<String> {
    let mut table = String::new();
    for (label, name, prototype) in [("TB1", "er16k-tb1", "905 / 1128"), ("TB2", "er16k-tb2", "639 / 910")] {
        let mut case = Case::shipped(project, name)?;
        (case.scene.shaft.mass, case.scene.housing.mass) = (2.4, 5.8);
        let passage = averaged(project, &case)?;
        writeln!(table, "| {label} | {prototype} | {} |", shown(rings(&case, &passage)))?;
    }
    Ok(table)
}

fn averaged(project: &Project, case: &Case) -> Result<Vec<f64>> {
    let seconds = (SKIP + COUNT + 2) as f64 / case.bpfo();
    let run = case.record(project, &["sensor.acceleration"], RATE, seconds)?;
    Ok(case.average(&run[0], RATE, case.length(), LEAD, SKIP))
}

/// Strongest frequency after the entry, and after the next exit.
fn rings(case: &Case, passage: &[f64]) -> Option<Ringing> {
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

/// The rings' mode on the static stiffness of this spall.
fn expected(case: &Case) -> Option<Ringing> {
    let spacing = 360.0 / case.scene.bearing.element_count as f64;
    let Some(DefectShape::Spall { depth, .. }) = case.scene.defects.first().map(|defect| defect.shape.clone()) else {
        return None;
    };
    let rig = Rig::new(&case.scene, case.bpfo(), &|_| None)?;
    ringing::expected(&rig, Trial { length: case.length(), depth, law: ContactLaw::Hertz }, spacing).ok()
}

/// Stiffness along the load with two elements about the middle of the spall (N/µm).
fn least_stiffness(case: &Case) -> Result<f64> {
    let bearing = StaticBearing::new(&case.clone().with_law(ContactLaw::Hertz).scene, None)?;
    let angle = -std::f64::consts::FRAC_PI_2 - if case.length() > 40.0 { 0.5 * bearing.spacing() } else { 0.0 };
    Ok(1e-6 * bearing.balance(angle, bearing.load())?.free_stiffness())
}

fn shown(ringing: Option<Ringing>) -> String {
    ringing.map_or("–".to_owned(), |r| format!("{:.0} / {:.0}", r.after_entry, r.after_exit))
}
