//! One passage in detail: the four events of the line spall (the paper's Figure 1) and Epps' spall (Figures 4 and 5).

use std::fmt::Write;

use anyhow::{Context, Result};
use brinell::contact::rolled_path::RigidPath;
use brinell::contact::rolling::{RacewaySide, Rolling};
use brinell::scene::ContactLaw;
use brinell::surface::Surface;
use brinell_analysis::sizing::waveform::ringing;
use brinell_analysis::sizing::waveform::synthesis;

use super::runs::Case;
use super::{LAWS, Values, write_csv};
use fmu_build::shared::Project;

/// A row of the table of events: its name, the prototype's figure, and how ours is read.
type Event = (&'static str, &'static str, fn(&FourEvents) -> f64);

/// Samples per second where a passage is shown in detail: elements ring on their contacts at 40 to 50 kHz.
const RATE: f64 = 1e6;
const NAMES: [&str; 5] =
    ["sensor.acceleration", "housing.ay", "element[1].path", "element[1].force.inner", "element[1].force.outer"];

/// Fills in `four_events` and `epps`, and writes what the figures show.
pub fn fill(project: &Project, values: &mut Values) -> Result<()> {
    let mut table = String::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut found = Vec::new();
    for law in LAWS {
        let case = Case::shipped(project, "er16k-tb1")?.with_law(law);
        let (time, run) = around_passage(project, &case, case.length(), [2e-3, 22e-3])?;
        found.push(FourEvents::of(&time, &run, case.length() / case.travel()));
        if columns.is_empty() {
            columns.push(time);
        }
        columns.extend(run);
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
    write_csv(project, "four-events", &named(&["map", "hertz"]), &columns)?;
    epps(project, values)
}

/// Time from the edge (s) and the outputs around the first passage of element 1, from so long before to so long after.
fn around_passage(project: &Project, case: &Case, length: f64, window: [f64; 2]) -> Result<(Vec<f64>, Vec<Vec<f64>>)> {
    let entry = case.entry(length);
    let run = case.record(project, &NAMES, RATE, entry + window[1])?;
    let from = ((entry - window[0]).max(0.0) * RATE) as usize;
    let time = (from..run[0].len()).map(|k| k as f64 / RATE - entry).collect();
    Ok((time, run.into_iter().map(|column| column[from..].to_vec()).collect()))
}

/// Times from the leading edge (s).
struct FourEvents {
    free: f64,
    floor: f64,
    reload: f64,
    settled: f64,
    exit: f64,
    peak: f64,
}

impl FourEvents {
    fn of(time: &[f64], run: &[Vec<f64>], exit: f64) -> Self {
        let (inner, outer) = (&run[3], &run[4]);
        let first = |from: f64, is: &dyn Fn(usize) -> bool| {
            (0..time.len()).find(|&k| time[k] >= from && is(k)).map_or(f64::NAN, |k| time[k])
        };
        let free = first(0.0, &|k| outer[k] == 0.0);
        let floor = first(free, &|k| outer[k] > 0.0);
        // Just after the release the inner contact holds on for some microseconds.
        let reload = first(free + 1e-3, &|k| inner[k] > 0.0);
        let before = |to: f64, is: &dyn Fn(usize) -> bool| {
            (0..time.len()).rev().find(|&k| time[k] <= to && is(k)).map_or(f64::NAN, |k| time[k])
        };
        let settled = before(exit, &|k| outer[k] == 0.0 || inner[k] == 0.0);
        let near = |k: &usize| (time[*k] - exit).abs() < 1.5e-3;
        let peak = (0..time.len()).filter(near).map(|k| outer[k]).fold(0.0, f64::max);
        Self { free, floor, reload, settled, exit, peak }
    }
}

fn epps(project: &Project, values: &mut Values) -> Result<()> {
    let shipped = Case::shipped(project, "6205-epps")?;
    let radius = shipped.scene.bearing.outer_raceway_radius();
    let length = (0.8e-3 / radius).to_degrees();
    let mut table = String::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for (shape, case) in [("trace", shipped.clone()), ("90° edges", shipped.with_spall(length, 100e-6))] {
        for law in LAWS {
            let case = case.clone().with_law(law);
            let (time, run) = around_passage(project, &case, length, [1e-3, 4e-3])?;
            let traverse = length / case.travel();
            let at = |from: f64, to: f64| {
                let within = |k: &usize| time[*k] >= from && time[*k] <= to;
                let force = |k: usize| run[4][k];
                (0..time.len()).filter(within).map(force).fold((f64::MAX, 0.0f64), |(l, h), f| (l.min(f), h.max(f)))
            };
            let before = at(-0.5e-3, -0.45e-3).1;
            // The peak as it takes up its load again; one of the ringing that follows may be higher.
            let (least, peak) = (at(0.0, 1.2 * traverse).0, at(0.5 * traverse, 1.5 * traverse).1);
            let deepest = run[2].iter().copied().fold(0.0, f64::max);
            let rings = rings_after(project, &case, length)?;
            let law = if law == ContactLaw::Map { "map" } else { "hertz" };
            writeln!(
                table,
                "| {shape}, {law} | {:.1} | {:.1} | {:.2} | {before:.0} → {least:.0} → {peak:.0} | {rings} |",
                1e6 * rigid_drop(&case)?,
                1e6 * deepest,
                1e3 * traverse,
            )?;
            if columns.is_empty() {
                columns.push(time);
            }
            columns.extend(run);
        }
    }
    values.set("epps", table)?;
    write_csv(project, "epps", &named(&["trace map", "trace hertz", "sharp map", "sharp hertz"]), &columns)?;
    profile_csv(project, &Case::shipped(project, "6205-epps")?)
}

/// Frequency of the averaged signal below 2.5 kHz after the exit (Hz).
fn rings_after(project: &Project, case: &Case, length: f64) -> Result<String> {
    let rate = 51_200.0;
    let run = case.record(project, &NAMES[..1], rate, 0.4)?;
    let passage = case.average(&run[0], rate, length, 0.0, 4);
    let smooth = synthesis::below_cut(&passage, case.bpfo());
    let from = (1.3 * length / case.travel() * rate) as usize;
    Ok(ringing::strongest(&smooth[from..], rate).map_or("–".to_owned(), |f| format!("{f:.0}")))
}

fn path_of(case: &Case) -> Result<(Surface, RigidPath)> {
    let bearing = &case.scene.bearing;
    let defect = case.scene.defects.first().context("no defect")?;
    let surface = Surface::load(defect, case.profile(), bearing)?;
    let Surface::Profile(profile) = &surface else { anyhow::bail!("a topography has no one path") };
    let path = RigidPath::new(profile.points(), Rolling::of(bearing, RacewaySide::Outer, false))?;
    Ok((surface, path))
}

/// Depth of the path of a rigid element (m) at angle (rad).
fn rigid(path: &RigidPath, angle: f64) -> f64 {
    let after = path.knots().partition_point(|&knot| knot <= angle);
    if after == 0 || after == path.knots().len() { 0.0 } else { path.at(after - 1, angle).path }
}

fn rigid_drop(case: &Case) -> Result<f64> {
    let (_, path) = path_of(case)?;
    let radius = case.scene.bearing.outer_raceway_radius();
    Ok((-500..=500).map(|k| rigid(&path, f64::from(k) * 1e-6 / radius)).fold(0.0, f64::max))
}

/// The profile and the rigid path over it, every micrometre.
fn profile_csv(project: &Project, case: &Case) -> Result<()> {
    let (surface, path) = path_of(case)?;
    let Surface::Profile(profile) = &surface else { return Ok(()) };
    let radius = case.scene.bearing.outer_raceway_radius();
    let arc: Vec<f64> = (-700..=700).map(|k| f64::from(k) * 1e-6).collect();
    let depth = arc.iter().map(|&arc| profile.depth_at(arc)).collect();
    let centre = arc.iter().map(|&arc| rigid(&path, arc / radius)).collect();
    let names = [("arc".to_owned(), "m"), ("depth".to_owned(), "m"), ("path".to_owned(), "m")];
    write_csv(project, "profile", &names, &[arc, depth, centre])
}

/// Time, and the outputs of each case.
fn named(cases: &[&str]) -> Vec<(String, &'static str)> {
    let mut names = vec![("time".to_owned(), "s")];
    for case in cases {
        for (name, unit) in NAMES.iter().zip(["m/s2", "m/s2", "m", "N", "N"]) {
            names.push((format!("{case} {name}"), unit));
        }
    }
    names
}
