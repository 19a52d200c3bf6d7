//! Sizing on machines that do not exist: how often a length comes out right, wrong, or not at all.
//!
//! Machines are numbered and each is drawn anew from its number and the length. **The first group was used to
//! develop the method, the second once, to correct what it had missed, the third only to record the result.** The scene
//! that sizes them knows the bearing, and the load within a third; it has no rig.

use std::fmt::Write;
use std::ops::Range;

use anyhow::Result;
use brinell::scene::{Bearing, Scene};
use brinell_analysis::recording::{Recording, SizingError};
use brinell_analysis::sizing;
use brinell_analysis::sizing::{Fault, Raceway};
use brinell_analysis::statistics::{Random, median};
use rayon::prelude::*;

use super::page::Page;
use super::synthetic_rig::SyntheticRig;

/// Numbers of the machines of each group, for each length.
const GROUPS: [Range<u64>; 3] = [0..20, 100..120, 500..540];
/// Lengths of spalls (degrees); 0 is healthy.
const LENGTHS: [f64; 7] = [0.0, 0.5, 0.9, 1.3, 2.0, 5.0, 8.0];
/// Lengths on the inner raceway.
const INNER: [f64; 3] = [2.0, 5.0, 8.0];
/// Error up to which a length counts as right.
const RIGHT: f64 = 0.15;
/// Elements, their diameter and pitch diameter (mm): 6205 for every other machine, else one of all.
const BEARINGS: [(usize, f64, f64); 4] = [(9, 7.94, 39.04), (8, 6.747, 28.5), (9, 7.94, 39.32), (9, 9.53, 46.0)];

/// Fills in `rigs` and `rigs_inner`.
pub fn fill(page: &Page) -> Result<()> {
    page.set_rows("rigs_inner", &table(Raceway::Inner, &INNER)?)?;
    page.set_rows("rigs", &table(Raceway::Outer, &LENGTHS)?)
}

fn table(raceway: Raceway, lengths: &[f64]) -> Result<String> {
    let mut table = String::new();
    for &length in lengths {
        write!(table, "| {} |", if length == 0.0 { "healthy".to_owned() } else { format!("{length:.1}°") })?;
        for group in GROUPS {
            let found = sized(raceway, length, group)?;
            let resolved: Vec<&Found> = found.iter().filter(|found| found.length.is_some()).collect();
            let right = resolved.iter().filter(|found| found.error(length) <= RIGHT * length).count();
            let (wrong, unresolved) = (resolved.len() - right, found.len() - resolved.len());
            let held = resolved.iter().filter(|found| found.error(length) <= found.interval).count();
            let other = resolved.iter().filter(|found| found.raceway != Some(raceway)).count();
            let other = if other > 0 { format!(", {other} of the other raceway") } else { String::new() };
            write!(table, " {right} | {wrong}{other} | {held} of {} | {unresolved} |", resolved.len())?;
        }
        writeln!(table)?;
        eprintln!("{}", table.lines().last().unwrap_or_default());
    }
    Ok(table)
}

/// Coverage and width together, of machines with these numbers, as Markdown: of all, and of those whose signal is 20 dB
/// and more above the noise.
pub fn coverage(machines: &Range<u64>) -> Result<String> {
    let mut table = String::from(
        "| spall | kind right / wrong / not named | lengths | hold | ± (median) | off 15 % | from 20 dB on: lengths \
         | hold | ± (median) |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    let outer = LENGTHS.iter().map(|&length| (Raceway::Outer, length));
    for (raceway, length) in outer.chain(INNER.iter().map(|&length| (Raceway::Inner, length))) {
        let found = sized(raceway, length, machines.clone())?;
        let of = if raceway == Raceway::Inner { "inside" } else { "outside" };
        let spall = if length == 0.0 { "healthy".to_owned() } else { format!("{length:.1}° {of}") };
        let counted = |of: &dyn Fn(&Found) -> bool| found.iter().filter(|found| of(found)).count();
        let right = counted(&|found| found.raceway == Some(raceway));
        let other = counted(&|found| found.other_kind || found.raceway.is_some_and(|named| named != raceway));
        let off = counted(&|found| found.length.is_some() && found.error(length) > RIGHT * length);
        let held = |least: f64| {
            let given: Vec<&Found> = found.iter().filter(|f| f.length.is_some() && f.noise_db >= least).collect();
            let held = given.iter().filter(|found| found.error(length) <= found.interval).count();
            let widths: Vec<f64> = given.iter().filter_map(|f| Some(100.0 * f.interval / f.length?)).collect();
            let width = if widths.is_empty() { "–".to_owned() } else { format!("{:.1} %", median(&widths)) };
            (given.len(), held, width)
        };
        let ((given, all, width), (quiet, of_quiet, narrow)) = (held(0.0), held(20.0));
        let (faulty, unnamed) = (length > 0.0, found.len() - right - other);
        let (right, other) = if faulty { (right, other) } else { (0, right + other) };
        writeln!(
            table,
            "| {spall} | {right} / {other} / {unnamed} | {given} | {all} | {width} | {off} | {quiet} | {of_quiet} \
             | {narrow} |"
        )?;
    }
    Ok(table)
}

/// What sizing gives.
struct Found {
    /// Length and half its 95 % interval (degrees).
    length: Option<f64>,
    interval: f64,
    /// Of which raceway.
    raceway: Option<Raceway>,
    /// Whether it is said to be an element's.
    other_kind: bool,
    /// Signal's power above the noise's (dB).
    noise_db: f64,
}

impl Found {
    fn error(&self, truth: f64) -> f64 {
        self.length.map_or(f64::INFINITY, |length| (length - truth).abs())
    }
}

/// What sizing gives of all machines of a group.
fn sized(raceway: Raceway, length: f64, machines: Range<u64>) -> Result<Vec<Found>> {
    machines.into_par_iter().map(|number| one(number, raceway, length)).collect()
}

fn one(number: u64, raceway: Raceway, length: f64) -> Result<Found> {
    let mut random = Random::new(1000 * number + (10.0 * length) as u64);
    let rig = SyntheticRig::draw(&mut random);
    let (count, element, pitch) = BEARINGS[if random.uniform() < 0.5 { 0 } else { random.below(BEARINGS.len()) }];
    let load = rig.load * libm::exp(0.3 * random.normal());
    let bearing = Bearing::steel_balls(count, element / 1e3, pitch / 1e3);
    let scene = Scene::builder(bearing).shaft_load([0.0, -load]).build()?;
    let signal = rig.record(&scene.bearing, raceway, length, &mut random);
    let recording = Recording::new("synthetic", signal, rig.rate, rig.speed)?;
    match sizing::size(&[recording], &scene) {
        Ok(report) => {
            let interval = report.recordings.first().and_then(|r| r.uncertainty_deg).unwrap_or(0.0);
            let raceway = match report.fault {
                Fault::Outer => Some(Raceway::Outer),
                Fault::Inner => Some(Raceway::Inner),
                _ => None,
            };
            let (length, other_kind) = (report.length_deg, report.fault == Fault::Element);
            Ok(Found { length, interval, raceway, other_kind, noise_db: rig.noise_db })
        }
        // Too few samples per passage at this rate and speed: no length either.
        Err(SizingError::TooCoarse { .. } | SizingError::TooShort { .. }) => {
            Ok(Found { length: None, interval: 0.0, raceway: None, other_kind: false, noise_db: rig.noise_db })
        }
        Err(other) => Err(other.into()),
    }
}
