//! Tables of averaged passages: the paper's Figure 6, and with the prototype's ring masses.

use std::fmt::Write;

use anyhow::Result;
use brinell::scene::{ContactLaw, DefectShape};
use brinell_analysis::sizing::waveform::{Rig, Ringing, Trial, ringing};
use brinell_analysis::statics::StaticBearing;
use fmu_build::paper::averages::{PANELS, averaged, rings, times};
use fmu_build::paper::{Case, LAWS};

use super::{page::Page, write_csv};
use fmu_build::shared::Project;

/// Fills in `frequencies` and `lighter`, and writes the averaged passages that the spectrograms show.
pub fn fill(project: &Project, page: &Page) -> Result<()> {
    let mut table = String::new();
    let mut time = Vec::new();
    let (mut names, mut columns) = (vec![("time".to_owned(), "s")], Vec::new());
    for panel in PANELS {
        let case = panel.case()?;
        let mut row = Vec::new();
        for law in LAWS {
            // The compliant assembly's approaches go beyond the map.
            if law == ContactLaw::Map && panel.scene == "er16k-tb2-compliant" {
                row.push("–".to_owned());
                continue;
            }
            let case = case.clone().with_law(law);
            let passage = averaged(project, &case)?;
            row.push(shown(rings(&case, &passage)));
            let own = case.scene.contact.law == panel.case()?.scene.contact.law;
            if own {
                time = times(&case, passage.len());
                names.push((format!("{} sensor.acceleration", panel.key), "m/s2"));
                columns.push(passage);
            }
        }
        let expected = shown(expected(&case));
        let (label, paper, row) = (panel.label, panel.paper, row.join(" | "));
        writeln!(table, "| {label} | {paper} | {row} | {expected} | {:.0} |", least_stiffness(&case)?)?;
    }
    page.set_rows("frequencies", &table)?;
    // The periods of all scenes are equal: one bearing, one speed.
    let mut all = vec![time];
    all.extend(columns);
    write_csv(project, "averages", &names, &all)?;
    page.set_rows("lighter", &lighter(project)?)?;
    Ok(())
}

/// The ring masses with which the prototype came nearest to the paper.
fn lighter(project: &Project) -> Result<String> {
    let mut table = String::new();
    for (label, name, prototype) in [("TB1", "er16k-tb1", "905 / 1128"), ("TB2", "er16k-tb2", "639 / 910")] {
        let mut case = Case::shipped(name)?;
        (case.scene.shaft.mass, case.scene.housing.mass) = (2.4, 5.8);
        let passage = averaged(project, &case)?;
        writeln!(table, "| {label} | {prototype} | {} |", shown(rings(&case, &passage)))?;
    }
    Ok(table)
}

fn shown(ringing: Option<Ringing>) -> String {
    ringing.map_or("–".to_owned(), |r| format!("{:.0} / {:.0}", r.after_entry, r.after_exit))
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
