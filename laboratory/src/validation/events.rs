//! Tables of single passages: the four events of the line spall (the paper's Figure 1) and Epps' spall (Figures 4 and
//! 5).

use std::fmt::Write;

use anyhow::Result;
use fmu_build::paper::{self, Epps, FourEvents};

use super::{folder, page::Page};
use fmu_build::shared::Project;

/// A row of the table of events: its name, the paper's figure and the prototype's, and how ours is read.
type Event = (&'static str, [&'static str; 2], fn(&FourEvents) -> f64);

/// Fills in `four_events` and `epps`, and writes what the figures show.
pub fn fill(project: &Project, page: &Page) -> Result<()> {
    let mut table = String::new();
    let found = paper::four_events(project, &folder(project))?;
    let rows: [Event; 6] = [
        ("2: element free of load after the leading edge (ms)", ["–", "0.6"], |e| 1e3 * e.free),
        ("3: first strike of the floor after the leading edge (ms)", ["weak"; 2], |e| 1e3 * e.floor),
        ("4: inner ring carries again (ms)", ["–", "10.1"], |e| 1e3 * e.reload),
        ("end of the chatter: no more lift-off (ms)", ["–", "10.6"], |e| 1e3 * e.settled),
        ("centre over the trailing edge (ms)", ["–", "11.0"], |e| 1e3 * e.exit),
        ("greatest force on the element at the exit (N)", ["–", "≈ 400"], |e| e.peak),
    ];
    for (label, [paper, prototype], of) in rows {
        let ours = found.iter().map(|(e, _)| format!("{:.*}", if of(e) > 50.0 { 0 } else { 2 }, of(e)));
        writeln!(table, "| {label} | {paper} | {prototype} | {} |", ours.collect::<Vec<_>>().join(" | "))?;
    }
    page.set_rows("four_events", &table)?;
    epps(project, page)
}

fn epps(project: &Project, page: &Page) -> Result<()> {
    let shipped = paper::epps_profile(&folder(project))?;
    let sharp = shipped.clone().with_spall(Epps::degrees(&shipped), 100e-6);
    let found = paper::epps(project, &[("trace", &shipped), ("sharp", &sharp)], &folder(project))?;
    let labels = ["trace, map", "trace, hertz", "90° edges, map", "90° edges, hertz"];
    let mut table = "| *prototype, 90° edges* | *16.8* | | *0.54* | *780 → 99 → 1281* | *1174* |\n".to_owned();
    for (label, Epps { drop, deepest, traverse, force: [before, least, peak], rings, .. }) in labels.iter().zip(&found)
    {
        writeln!(
            table,
            "| {label} | {:.1} | {:.1} | {:.2} | {before:.0} → {least:.0} → {peak:.0} | {} |",
            1e6 * drop,
            1e6 * deepest,
            1e3 * traverse,
            rings.map_or("–".to_owned(), |f| format!("{f:.0}")),
        )?;
    }
    page.set_rows("epps", &table)
}
