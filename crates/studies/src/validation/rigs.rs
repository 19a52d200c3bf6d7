//! Sizing on machines that do not exist: how often a length comes out right, wrong, or not at all.
//!
//! Machines are numbered and each is drawn anew from its number and the length. **The first half was looked at while
//! the method was made, the second only to write down the result.** The scene that sizes them knows the bearing, and
//! the load within a third; it has no rig.

use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::Result;
use brinell::scene::Scene;
use brinell_analysis::error::SizingError;
use brinell_analysis::recording::Recording;
use brinell_analysis::spall_size;
use brinell_analysis::statistics::Random;

use super::Values;
use super::synthetic_rig::SyntheticRig;

/// Machines of each half, for each length.
const MACHINES: u64 = 40;
/// Numbers from which each half begins.
const FIRST: [u64; 2] = [0, 100];
/// Lengths of spalls [degrees]; 0 is healthy.
const LENGTHS: [f64; 7] = [0.0, 0.5, 0.9, 1.3, 2.0, 5.0, 8.0];
/// Error up to which a length counts as right.
const RIGHT: f64 = 0.15;
/// Elements, their diameter and pitch diameter [mm]: 6205 for every other machine, else one of all.
const BEARINGS: [(usize, f64, f64); 4] = [(9, 7.94, 39.04), (8, 6.747, 28.5), (9, 7.94, 39.32), (9, 9.53, 46.0)];

/// Fills in `rigs`.
pub fn fill(values: &mut Values) -> Result<()> {
    let mut table = String::new();
    for length in LENGTHS {
        write!(table, "| {} |", if length == 0.0 { "healthy".to_owned() } else { format!("{length:.1}°") })?;
        for half in 0..2 {
            let found = sized(length, half)?;
            let lengths: Vec<f64> = found.iter().filter_map(|(found, _)| *found).collect();
            let right = lengths.iter().filter(|&&l| (l / length - 1.0).abs() <= RIGHT).count();
            let (wrong, unresolved) = (lengths.len() - right, found.len() - lengths.len());
            // Of a wrong one, whether its interval at least holds the truth.
            let held = |&&(found, interval): &&(Option<f64>, f64)| {
                found.is_some_and(|found| (found / length - 1.0).abs() > RIGHT && (found - length).abs() <= interval)
            };
            let honest = found.iter().filter(held).count();
            write!(table, " {right} | {wrong} ({honest}) | {unresolved} |")?;
        }
        writeln!(table)?;
        eprintln!("{}", table.lines().last().unwrap_or_default());
    }
    values.set("rigs", table)
}

/// Length and half its 95 % interval [degrees], of all machines of a half.
fn sized(length: f64, half: usize) -> Result<Vec<(Option<f64>, f64)>> {
    let next = AtomicU64::new(0);
    let found = Mutex::new(Vec::new());
    let work = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= MACHINES {
                break;
            }
            let one = one(FIRST[half] + k, length);
            found.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push(one);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    found.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner).into_iter().collect()
}

fn one(number: u64, length: f64) -> Result<(Option<f64>, f64)> {
    let mut random = Random::new(1000 * number + (10.0 * length) as u64);
    let rig = SyntheticRig::draw(&mut random);
    let (count, element, pitch) = BEARINGS[if random.uniform() < 0.5 { 0 } else { random.below(BEARINGS.len()) }];
    let load = rig.load * libm::exp(0.3 * random.normal());
    let scene = Scene::from_toml(&format!(
        "name = \"rig\"
        [bearing]
        element_count = {count}
        element_diameter_mm = {element}
        pitch_diameter_mm = {pitch}
        conformity_inner = 0.52
        conformity_outer = 0.52
        radial_clearance_um = 5.0
        youngs_modulus_gpa = 207.0
        poissons_ratio = 0.3
        density_kg_m3 = 7800.0
        [shaft]
        motion = \"internal\"
        speed_hz = 10.0
        load_n = [0.0, -{load}]
        [housing]
        motion = \"internal\""
    ))?;
    let signal = rig.record(&scene.bearing, length, &mut random);
    let recording = Recording::new("synthetic", signal, rig.rate, rig.speed)?;
    match spall_size::size(&[recording], &scene) {
        Ok(report) => {
            let interval = report.recordings.first().and_then(|r| r.uncertainty_deg).unwrap_or(0.0);
            Ok((report.length_deg, interval))
        }
        // Too few samples per passage at this rate and speed: no length either.
        Err(SizingError::TooCoarse { .. } | SizingError::TooShort { .. }) => Ok((None, 0.0)),
        Err(other) => Err(other.into()),
    }
}
