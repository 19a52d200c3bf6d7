//! Tables of single passages: the four events of the line spall (the paper's Figure 1) and Epps' spall (Figures 4 and
//! 5).

use std::fmt::Write;

use anyhow::Result;
use brinell::scene::ContactLaw;
use fmu_build::paper::{Case, Epps, FourEvents, LAWS, Passage, passage};

use super::{Values, write_csv};
use fmu_build::shared::Project;

/// A row of the table of events: its name, the prototype's figure, and how ours is read.
type Event = (&'static str, &'static str, fn(&FourEvents) -> f64);

/// Fills in `four_events` and `epps`, and writes what the figures show.
pub fn fill(project: &Project, values: &mut Values) -> Result<()> {
    let mut table = String::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut found = Vec::new();
    for law in LAWS {
        let case = Case::shipped("er16k-tb1")?.with_law(law);
        let passage = Passage::of(project, &case, case.length(), [2e-3, 22e-3])?;
        found.push(FourEvents::of(&passage, case.length() / case.travel()));
        if columns.is_empty() {
            columns.push(passage.time);
        }
        columns.extend(passage.signals);
    }
    let rows: [Event; 6] = [
        ("element free of load after the leading edge (ms)", "0.6", |e| 1e3 * e.free),
        ("first strike of the floor after the leading edge (ms)", "weak", |e| 1e3 * e.floor),
        ("inner ring carries again (ms)", "10.1", |e| 1e3 * e.reload),
        ("end of the chatter: no more lift-off (ms)", "10.6", |e| 1e3 * e.settled),
        ("centre over the trailing edge (ms)", "11.0", |e| 1e3 * e.exit),
        ("greatest force on the element at the exit (N)", "≈ 400", |e| e.peak),
    ];
    for (label, prototype, of) in rows {
        let ours = found.iter().map(|e| format!("{:.*}", if of(e) > 50.0 { 0 } else { 2 }, of(e)));
        writeln!(table, "| {label} | {prototype} | {} |", ours.collect::<Vec<_>>().join(" | "))?;
    }
    values.set("four_events", table)?;
    write_csv(project, "four-events", &passage::columns(&["map", "hertz"]), &columns)?;
    epps(project, values)
}

fn epps(project: &Project, values: &mut Values) -> Result<()> {
    let shipped = Case::shipped("6205-epps")?;
    let sharp = shipped.clone().with_spall(Epps::degrees(&shipped), 100e-6);
    let mut table = String::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for (shape, case) in [("trace", &shipped), ("90° edges", &sharp)] {
        for law in LAWS {
            let Epps { passage, drop, deepest, traverse, force: [before, least, peak], rings } =
                Epps::of(project, &case.clone().with_law(law))?;
            let law = if law == ContactLaw::Map { "map" } else { "hertz" };
            writeln!(
                table,
                "| {shape}, {law} | {:.1} | {:.1} | {:.2} | {before:.0} → {least:.0} → {peak:.0} | {} |",
                1e6 * drop,
                1e6 * deepest,
                1e3 * traverse,
                rings.map_or("–".to_owned(), |f| format!("{f:.0}")),
            )?;
            if columns.is_empty() {
                columns.push(passage.time);
            }
            columns.extend(passage.signals);
        }
    }
    values.set("epps", table)?;
    write_csv(project, "epps", &passage::columns(&["trace map", "trace hertz", "sharp map", "sharp hertz"]), &columns)?;
    let (names, columns) = passage::profile(&shipped)?;
    write_csv(project, "profile", &names, &columns)
}
