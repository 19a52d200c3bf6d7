//! Numbers of the commands of a random scene against the oracle's: characteristic frequencies (`sweep`), load
//! distribution, tangent stiffness and critical load (`stiffness`), natural frequencies and shapes (`modes`).
//!
//! The oracle has its own kinematics and its own balance; stiffness is the difference of its forces, and a mode must
//! satisfy the matrix that differences of its equations of motion give.

mod modes;

use crate::case::{Case, Motion, Ring};
use crate::oracle::Bearing;
use crate::oracle::balance::{Held, best, held};
use crate::subject::Subject;
use crate::units::{path_error, position_error, rounding, slope_error};
use brinell::geometry::kinematics::Frequencies;
use brinell::scene::Scene;
use brinell_analysis::modes::Assembly;
use brinell_analysis::statics::{Balance, StaticBearing, StaticError};
use std::f64::consts::PI;

/// Whether load distribution and stiffness, critical load, and modes were compared.
pub type Compared = [bool; 3];

/// Differences of forces are trusted to this part of the stiffness.
const SMOOTH: f64 = 1e-4;

/// Compares the commands' numbers of a case; what the scene is refused for is another's to judge.
pub fn compared(case: &Case) -> Result<Compared, String> {
    let profiles = case.profiles();
    let profiles = || profiles.iter().map(String::as_str);
    let Ok(scene) = brinell_scene_file::from_toml(&case.toml()) else { return Ok([false; 3]) };
    if Subject::new(case).is_err() {
        return Ok([false; 3]);
    }
    frequencies(case, &scene)?;
    let bearing = StaticBearing::new(&scene, profiles()).map_err(|error| format!("stiffness: {error}"))?;
    let (of_load, critical) = stiffness(case, &bearing).map_err(|why| format!("stiffness: {why}"))?;
    let assembly = Assembly::new(&scene, profiles(), None).map_err(|error| format!("modes: {error}"))?;
    let modes = modes::agree(case, &assembly).map_err(|why| format!("modes: {why}"))?;
    Ok([of_load, critical, modes])
}

fn frequencies(case: &Case, scene: &Scene) -> Result<(), String> {
    let found = Frequencies::of(scene);
    // The scene has no key for the slip of the spin.
    let expected = Bearing::smooth(&Case { spin_slip: 0.0, ..case.clone() }).frequencies();
    let fastest = case.count as f64 * (case.speed_hz.abs() + case.housing_hz.unwrap_or(0.0).abs());
    // An element spins some times faster than the rings.
    let limit = 1e-14 * fastest * (1.0 + case.pitch_mm / case.diameter_mm);
    for (name, (a, b)) in ["BPFO", "BPFI", "BSF", "FTF"]
        .into_iter()
        .zip([found.bpfo, found.bpfi, found.bsf, found.ftf].into_iter().zip(expected))
    {
        if !((a - b).abs() <= limit) {
            return Err(format!("{name} is {a} Hz, the oracle says {b} Hz"));
        }
    }
    Ok(())
}

/// The bearing alone, as `stiffness` looks at it: at rest, without weight, the outer ring held.
fn alone(case: &Case, load: [f64; 2]) -> Case {
    let shaft = Ring { motion: Motion::Internal, load, mass: 1.0, ..Ring::FIXED };
    Case {
        gravity: [0.0; 2],
        rings: [shaft, Ring::FIXED],
        speed_hz: 0.0,
        housing_hz: case.housing_hz.map(|_| 0.0),
        film: None,
        sensor: None,
        steps: Vec::new(),
        ..case.clone()
    }
}

fn stiffness(case: &Case, found: &StaticBearing) -> Result<(bool, bool), String> {
    let [shaft, housing] = case.rings.map(|ring| ring.load);
    let load = if shaft == [0.0; 2] { housing.map(|force| -force) } else { shaft };
    if found.load().map(f64::abs) != load.map(f64::abs) {
        return Err(format!("the load is {:?} N, not {load:?} N", found.load()));
    }
    let smooth = Bearing::smooth(case);
    let load = if load == [0.0; 2] { [0.0, -smooth.growth[1].force(1e-4 * smooth.r)[0]] } else { load };
    let found = found.with_load(load);
    let alone = alone(case, load);
    let mut oracle = Bearing::new(&alone);
    let cage = case.cage_deg * PI / 180.0;
    let Some(_) = agrees(&found, &mut oracle, &alone, cage, load)? else { return Ok((false, false)) };
    // With the cage an element's own defect turns by a rule of the command's own.
    if !case.defective_elements().is_empty() || case.defects.is_empty() {
        return Ok((true, false));
    }
    Ok((true, critical(&found, &mut oracle, &alone, load)?))
}

/// At the critical load, with the cage where it is least, an element inside the defect just comes to be touched.
fn critical(found: &StaticBearing, oracle: &mut Bearing, alone: &Case, load: [f64; 2]) -> Result<bool, String> {
    let bottom = match found.bottom() {
        Ok(bottom) => bottom,
        Err(StaticError::NoDefect | StaticError::NoDepth { .. }) => return Ok(false),
        Err(error) => return Err(format!("the bottom of the defect: {error}")),
    };
    let Ok(critical) = found.critical_load().map_err(|error| format!("critical load: {error}"))? else {
        return Ok(false);
    };
    let length = load[0].hypot(load[1]);
    if critical.load <= 1e-9 * length {
        return Ok(false);
    }
    let load = load.map(|force| force / length * critical.load);
    let Some(gaps) = agrees(found, oracle, alone, critical.cage_angle, load)? else { return Ok(false) };
    // The load is sought to 1e-11 of its power 2/3.
    let limit = 1e-8 * bottom.path + 10.0 * rounding(oracle) + position_error(alone);
    // Between its raceways an element may be anywhere, and where it is turns the direction in which a defect is met.
    if gaps.iter().any(|[inner, outer]| (inner + outer).abs() <= limit + 0.1 * inner.abs().min(outer.abs())) {
        return Ok(true);
    }
    Err(format!("at the critical load of {} N no element just comes to be touched: {gaps:?} m", critical.load))
}

/// Balances at a cage angle and under a load with the oracle's at the same position of the shaft; approaches of both
/// contacts of elements that carry nothing. `None` where neither finds a balance.
fn agrees(
    found: &StaticBearing,
    oracle: &mut Bearing,
    alone: &Case,
    cage: f64,
    load: [f64; 2],
) -> Result<Option<Vec<[f64; 2]>>, String> {
    oracle.starts[0] = cage;
    oracle.rings[0].load = load;
    let balance = match found.balance(cage, load) {
        Ok(balance) => balance,
        Err(error @ StaticError::Equilibrium { .. }) => {
            let (left, largest) = best(oracle, alone);
            return if left <= 1e-6 * largest { Err(format!("{error}, where {left:e} N are left")) } else { Ok(None) };
        }
        Err(error) => return Err(error.to_string()),
    };
    let there = held(oracle, alone, balance.displacement);
    let contacts = || there.contacts.iter().flatten();
    let largest = contacts().fold(load[0].hypot(load[1]), |most, contact| most.max(contact.force));
    let approach = contacts().fold(0.0f64, |most, contact| most.max(contact.approach));
    let steepest = (0..2).map(|side| oracle.growth[side].force(approach)[1]).fold(0.0, f64::max);
    let known = (rounding(oracle) + position_error(alone)) * steepest + leaning(oracle, &there, steepest);
    let limit = 1e-9 * largest + known;
    for (j, (element, [inner, outer])) in balance.elements.iter().zip(&there.contacts).enumerate() {
        for (a, b) in [(element.inner_force, inner.force), (element.outer_force, outer.force)] {
            if !((a - b).abs() <= limit) {
                return Err(format!("element {} carries {a:e} N, the oracle says {b:e} N (limit {limit:e})", j + 1));
            }
        }
    }
    let [x, y] = there.force;
    if !(x.hypot(y) <= alone.count as f64 * limit) {
        return Err(format!("{x:e}, {y:e} N are left on the shaft of {largest:e} N (limit {limit:e} each)"));
    }
    slopes(&balance, (oracle, alone, &there), approach, known)?;
    let loose = there.contacts.iter().filter(|contacts| contacts.iter().any(|contact| contact.force <= limit));
    Ok(Some(loose.map(|contacts| contacts.map(|contact| contact.approach)).collect()))
}

/// The tangent stiffness against quotients of the oracle's forces, each with its own error from one over twice the
/// distance. A crowned roller's table turns a little at every step, where two quotients may be as good as equal and
/// both wrong: what is right agrees over one of three distances.
fn slopes(
    balance: &Balance,
    (oracle, alone, there): (&Bearing, &Case, &Held),
    approach: f64,
    known: f64,
) -> Result<(), String> {
    let quotients = |h: f64| {
        [0, 1].map(|a| {
            let [low, high] = [-h, h].map(|by| {
                let mut at = balance.displacement;
                at[a] += by;
                held(oracle, alone, at).force
            });
            [0, 1].map(|b| (low[b] - high[b]) / (2.0 * h))
        })
    };
    let all = || (0..4).map(|i| (i / 2, i % 2));
    let mut wrong = Ok(());
    for h in [1e-4, 1e-5, 1e-6].map(|part| part * approach) {
        // At the critical load an element just comes to be touched: no distance is small beside that.
        if there.contacts.iter().any(|[inner, outer]| (inner.approach + outer.approach).abs() <= 20.0 * h) {
            continue;
        }
        let (fine, coarse) = (quotients(h), quotients(2.0 * h));
        let size = all().map(|(a, b)| fine[a][b].abs()).fold(0.0, f64::max);
        let own = all().map(|(a, b)| (fine[a][b] - coarse[a][b]).abs()).fold(0.0, f64::max);
        let limit = 1e-6 * size + 2.0 * own + alone.count as f64 * known / h;
        if own > SMOOTH * size || limit > 10.0 * SMOOTH * size {
            continue;
        }
        // The column of the displacement a has the force b.
        let off = all().find(|&(a, b)| !((balance.stiffness[b][a] - fine[a][b]).abs() <= limit));
        let Some((a, b)) = off else { return Ok(()) };
        let (k, expected) = (balance.stiffness[b][a], fine[a][b]);
        wrong =
            Err(format!("the stiffness of {b} by {a} is {k:e} N/m, the oracle says {expected:e} (limit {limit:e})"));
    }
    wrong
}

/// What the rigid paths' own errors may do to a contact's force (N): their slopes direct it.
fn leaning(oracle: &Bearing, there: &Held, steepest: f64) -> f64 {
    let turns = &there.outside.turns;
    let motions = oracle.motions(&there.outside, 0.0, &there.y);
    let of = |(j, side): (usize, usize)| {
        let seat = oracle.seat(j, turns[0], &motions, &there.y);
        let Some(over) = oracle.over(side, j, &seat, turns, &there.stretches[j]) else { return 0.0 };
        let by_slope = there.contacts[j][side].force / over.surface.envelope.distance(over.path);
        by_slope * slope_error(oracle, over.surface, over.psi) + steepest * path_error(over.surface, over.psi)
    };
    (0..oracle.count).flat_map(|j| [(j, 0), (j, 1)]).map(of).fold(0.0, f64::max)
}
