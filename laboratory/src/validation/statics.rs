//! Static stiffness and critical loads: the prototype's figures beside ours, law `hertz` beside `map`, and what the
//! critical load depends on.

use std::fmt::Write;

use anyhow::{Context, Result};
use brinell::scene::ContactLaw;
use brinell_analysis::statics::StaticBearing;

use super::page::Page;
use fmu_build::paper::statics::bearing;
use fmu_build::paper::{self, Case};

/// Rows of the stiffness table: label, scene, spall depth (m) where it is not the scene's, load (N), and the
/// prototype's figures (N/µm).
type Row = (&'static str, &'static str, Option<f64>, f64, Option<[f64; 3]>);
const ROWS: [Row; 5] = [
    ("healthy, 500 N", "healthy", None, 500.0, Some([87.3, 88.4, 88.8])),
    ("TB1, 500 N", "er16k-tb1", None, 500.0, Some([56.5, 77.0, 88.8])),
    ("TB2, 500 N", "er16k-tb2", None, 500.0, Some([27.8, 47.3, 58.6])),
    ("TB2 30 µm deep, 500 N", "er16k-tb2", Some(30e-6), 500.0, None),
    ("TB2 30 µm deep, 600 N", "er16k-tb2", Some(30e-6), 600.0, None),
];

/// Fills in `stiffness`, `critical`, `depths`, `clearances`, `compliances` and `sensitivity`.
pub fn fill(page: &Page) -> Result<()> {
    page.set_rows("stiffness", &stiffness()?)?;
    let deep = bearing(&Case::shipped("er16k-tb2")?.with_law(ContactLaw::Hertz))?;
    page.set_rows("critical", &critical_loads()?)?;
    let mut table = String::new();
    for depth in [20.0, 25.0, 30.0, 33.0, 40.0, 50.0, 75.0, 100.0] {
        writeln!(table, "| {depth:.0} | {} |", load(&deep.with_depth_times(depth / 100.0)?)?)?;
    }
    page.set_rows("depths", &table)?;
    let shallow = deep.with_depth_times(0.3)?;
    let mut table = String::new();
    for clearance in [0.0, 5.0, 10.0, 20.0, 40.0] {
        let with = |bearing: &StaticBearing| load(&bearing.with_clearance(1e-6 * clearance));
        writeln!(table, "| {clearance:.0} | {} | {} |", with(&shallow)?, with(&deep)?)?;
    }
    page.set_rows("clearances", &table)?;
    let mut table = String::new();
    for compliance in [0.0, 10.0, 20.0, 40.0, 65.0, 80.0] {
        let with = |bearing: &StaticBearing| load(&bearing.with_outer_compliance(1e-9 * compliance));
        writeln!(table, "| {compliance:.0} | {} | {} |", with(&shallow)?, with(&deep)?)?;
    }
    page.set_rows("compliances", &table)?;
    let mut table = String::new();
    for (label, bearing) in [("100 µm", &deep), ("30 µm", &shallow)] {
        let critical = bearing.critical_load()??;
        let by = bearing.sensitivity(&critical)?.context("no sensitivity")?;
        writeln!(
            table,
            "| {label} | {:.0} | {:+.1} | {:+.1} | {:+.1} |",
            critical.load,
            1e-6 * by.by_depth,
            1e-6 * by.by_clearance,
            1e-9 * by.by_compliance
        )?;
    }
    page.set_rows("sensitivity", &table)?;
    Ok(())
}

fn stiffness() -> Result<String> {
    let mut table = String::new();
    for (label, name, depth, load, prototype) in ROWS {
        let case =
            if name == "healthy" { Case::shipped("er16k-tb1")?.with_spall(0.0, 0.0) } else { Case::shipped(name)? };
        let case = case.with_load(load);
        let case = depth.map_or(case.clone(), |depth| case.clone().with_spall(case.length(), depth));
        let of = |law: ContactLaw| paper::statics::stiffness(&case.clone().with_law(law));
        let shown = |k: [f64; 3]| k.map(|k| format!("{k:.1}")).join(" / ");
        let (hertz, map) = (of(ContactLaw::Hertz)?, of(ContactLaw::Map)?);
        let theirs = prototype.map_or("minimum 27.8, then 55.6".to_owned(), shown);
        writeln!(table, "| {label} | {theirs} | {} | {} |", shown(hertz), shown(map))?;
    }
    Ok(table)
}

fn critical_loads() -> Result<String> {
    let mut table = String::new();
    // The paper's step is that of the nominal depth; the prototype gave a number there alone.
    let theirs = |name: &str| if name == "er16k-tb2" { "500–600 | 3630" } else { "500–600 | –" };
    for (label, name) in [
        ("TB2, 100 µm", "er16k-tb2"),
        ("TB2, 30 µm", "er16k-tb2-30um"),
        ("TB2, 100 µm, 65 nm/N in series", "er16k-tb2-compliant"),
    ] {
        let case = Case::shipped(name)?;
        let hertz = load(&bearing(&case.clone().with_law(ContactLaw::Hertz))?)?;
        let map = if name == "er16k-tb2-compliant" {
            "beyond the map".to_owned()
        } else {
            load(&bearing(&case.with_law(ContactLaw::Map))?)?
        };
        writeln!(table, "| {label} | {} | {hertz} | {map} |", theirs(name))?;
    }
    Ok(table)
}

fn load(bearing: &StaticBearing) -> Result<String> {
    Ok(bearing.critical_load()?.map_or("none".to_owned(), |critical| format!("{:.0}", critical.load)))
}
