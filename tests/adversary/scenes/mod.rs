//! Random scenes against the oracle.

mod commands;
mod found;
mod judge;
mod report;

use crate::case::Case;
use crate::draw::{Draw, for_compared, seeds};
use crate::oracle::Bearing;
use crate::oracle::envelope::within_half_a_turn;
use crate::oracle::surface::Surface;
use crate::random_case::random;
use crate::subject::{Refusal, Subject};
use brinell::contact::error::ContactError;
use brinell::contact::near_defect::LoveSolvers;
use brinell::dynamics::parameters::{Defects, SMOOTH};
use brinell::simulation::SimulationError;
use judge::{Verdict, judge};
use report::{Came, Entry, Tally};
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fs::{self, OpenOptions};
use std::io::Write;

/// Judges the scene of a seed: its run, and what the commands say about it.
fn judged(seed: u64) -> Entry {
    let (kind, case) = random(&mut Draw::new(seed));
    let (verdict, compared) = match commands::compared(&case) {
        Ok(compared) => (judge(&case), compared),
        Err(why) => (Verdict::Failed(why), [false; 3]),
    };
    Entry::new(seed, kind, case.tolerance, verdict, compared)
}

/// A scene that is replayed alone, as files.
fn show(seed: u64) {
    let (_, case): (_, Case) = random(&mut Draw::new(seed));
    println!("{}{}{:#?}", case.toml(), case.profiles().join("\n"), case.steps);
}

#[test]
fn random_scenes_agree_with_the_oracle() {
    let seeds = seeds(6);
    if seeds.end - seeds.start == 1 {
        show(seeds.start);
    }
    let entries: Vec<Entry> = seeds.map(judged).collect();
    let tally = Tally::new(&entries);
    println!("{}", tally.summary());
    let failed = tally.failed();
    assert!(failed.is_empty(), "{} failed:\n{}", failed.len(), failed.join("\n"));
    // Two thirds of all do; one that is replayed alone may be refused.
    assert!(entries.len() == 1 || 3 * tally.agreed() >= entries.len(), "hardly any could be compared");
}

/// One line for each scene that a long run has judged.
const LINES: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/adversary.tsv");

/// The scenes that long runs have judged so far, the last word on each.
fn judged_so_far() -> Vec<Entry> {
    let mut entries: Vec<Entry> =
        fs::read_to_string(LINES).unwrap_or_default().lines().filter_map(Entry::parse).collect();
    entries.reverse();
    entries.sort_by_key(|entry| entry.seed);
    entries.dedup_by_key(|entry| entry.seed);
    entries
}

/// Takes up where it was broken off, and judges anew what failed; without the file of lines it begins anew. Several may
/// run side by side with seeds of their own.
#[test]
#[ignore = "takes an hour of a core for 10 000 scenes"]
fn many_random_scenes_agree_with_the_oracle() {
    let so_far = judged_so_far();
    let done: BTreeSet<u64> =
        so_far.iter().filter(|entry| !matches!(entry.came, Came::Failed(_))).map(|entry| entry.seed).collect();
    let mut lines = OpenOptions::new().create(true).append(true).open(LINES).unwrap();
    let judged_now = |seed: u64| {
        let entry = judged(seed);
        lines.write_all(format!("{entry}\n").as_bytes()).unwrap();
        entry
    };
    let entries: Vec<Entry> = seeds(10_000).filter(|seed| !done.contains(seed)).map(judged_now).collect();
    let failed = Tally::new(&entries).failed();
    assert!(failed.is_empty(), "{} failed:\n{}", failed.len(), failed.join("\n"));
}

#[test]
#[ignore = "writes docs/data/random-scenes.csv and a table of docs/evidence/stability.md, of what the long run judged"]
fn write_the_tables_of_random_scenes() {
    let entries = judged_so_far();
    assert!(!entries.is_empty(), "{LINES} holds no scene: run the test above first");
    let tally = Tally::new(&entries);
    let mut table = csv::Writer::from_path(brinell_tests::root().join("docs/data/random-scenes.csv")).unwrap();
    table.write_record(report::COLUMNS).unwrap();
    tally.table().iter().for_each(|row| table.write_record(row).unwrap());
    table.flush().unwrap();
    brinell_tests::page::write("docs/evidence/stability.md", [("random scenes", tally.summary())]);
}

/// The path that the simulation's elements follow over a scene's defect, at angles all around, is the brute-force
/// envelope, on either raceway that meets it.
#[test]
fn random_rigid_paths_are_the_envelope() {
    for_compared(60, |_, draw| {
        let (_, mut case) = random(draw);
        // They come on top of a path.
        case.waves.clear();
        let oracle = Bearing::new(&case);
        if oracle.all_surfaces().next().is_none() {
            return Ok(false);
        }
        let simulation = match Subject::new(&case) {
            Ok(subject) => subject.simulation,
            Err(Refusal::Simulation(SimulationError::Contact(ContactError::NoWayOut { .. }))) if oracle.leaps() => {
                return Ok(false);
            }
            // A bearing larger than the scene allows; defects that overlap.
            Err(Refusal::Scene(_) | Refusal::Simulation(SimulationError::Surface(_))) => return Ok(false),
            Err(error) => return Err(error.to_string()),
        };
        if oracle.leaps() {
            return Err("an element that only its side holds is not refused".to_owned());
        }
        let (model, position_error) = (simulation.equations().0, crate::units::position_error(&case));
        for side in 0..2 {
            if let Some(surface) = &oracle.surfaces.rings[side] {
                path_is_the_envelope(
                    draw,
                    &oracle,
                    position_error,
                    surface,
                    [&model.inner.defects, &model.outer.defects][side],
                )?;
            }
            for (j, own) in oracle.surfaces.own.iter().enumerate() {
                let Some(own) = own else { continue };
                let found = model.defective.iter().find(|found| found.element == j).ok_or("no defect")?;
                path_is_the_envelope(draw, &oracle, position_error, &own[side], &found.defects[side])?;
            }
        }
        Ok(true)
    });
}

fn path_is_the_envelope(
    draw: &mut Draw,
    oracle: &Bearing,
    position_error: f64,
    surface: &Surface,
    defects: &Defects,
) -> Result<(), String> {
    let envelope = &surface.envelope;
    // Around each knot and change, along the defect, and anywhere.
    let mut angles: Vec<f64> = (0..500).map(|_| draw.between(-PI, PI)).collect();
    for defect in defects.iter() {
        let (knots, shift) = (defect.knots(), defect.centre - surface.centre);
        let [first, last] = [knots[0], knots[knots.len() - 1]];
        angles.extend(knots.iter().flat_map(|at| [at - 1e-9, at + 1e-9]).map(|at| at + shift));
        angles.extend((0..1000).map(|i| first + (last - first) * (f64::from(i) + 0.5) / 1000.0 + shift));
    }
    angles.extend(envelope.changes.iter().flat_map(|at| [at - 1e-9, at + 1e-9]));
    for psi in angles.into_iter().map(within_half_a_turn) {
        let direction = psi + surface.centre;
        let cell = defects.cell_at(direction);
        let found = match cell {
            SMOOTH => 0.0,
            _ => {
                let solvers = &mut LoveSolvers::default();
                -defects.approach(cell, 0.0, direction, oracle.rho_0, true, solvers).map_err(|e| e.to_string())?.value
            }
        };
        let expected = envelope.touched(psi).1;
        // Roundings of the radii, and the polynomials that the path is kept as.
        let (kept, slope) = envelope.path(envelope.feature(envelope.stretch(psi)), psi);
        let (off, by_position) = (found - expected, position_error * (slope / envelope.own).abs());
        let limit = crate::units::rounding(oracle) + crate::units::path_error(surface, psi) + by_position;
        if !((kept - expected).abs() <= limit && off.abs() <= limit) {
            return Err(format!("path at {psi} is {found:e}, not {expected:e} (kept as {kept:e}): {off:e} off"));
        }
    }
    Ok(())
}
