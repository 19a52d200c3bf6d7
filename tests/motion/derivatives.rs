//! Derivatives of outputs: at the start by all that the start depends on, and by time where defects inside are met.
#![allow(clippy::unwrap_used)]

use crate::support::{map_of, profiles_of, shipped, shipped_as_it_is};
use brinell::scene::{Ring, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind, Variable};

const STIFFNESSES: [&str; 4] = ["shaft.stiffness.xx", "shaft.stiffness.xy", "shaft.stiffness.yx", "shaft.stiffness.yy"];

/// All bearings that differ in what a start depends on.
const SCENES: [&str; 13] = [
    "6205-epps",
    "6205-hosted",
    "6205-inner-5deg",
    "6205-irregular-cage",
    "6205-two-defects",
    "er16k-element",
    "er16k-inner",
    "er16k-tb1-damped",
    "er16k-tb1-oil",
    "er16k-tb2-compliant",
    "er16k-turning-outer",
    "nu205-healthy",
    "nu205-inner",
];

fn simulation(scene: Scene) -> Simulation {
    let profiles = profiles_of(&scene);
    let map = map_of(&scene, profiles.iter().map(|text| &text[..]));
    Simulation::with_map(scene, profiles.iter().map(|text| &text[..]), map.as_deref()).unwrap()
}

fn reals(simulation: &mut Simulation, references: &[u32]) -> Vec<f64> {
    let mut values = vec![f64::NAN; references.len()];
    simulation.reals(references, &mut values).unwrap();
    values
}

/// How far a known is moved: other ways than those of the derivatives that are differences themselves.
fn nudge(known: &Variable) -> f64 {
    let Kind::Real { nominal, .. } = known.kind else { panic!("{}", known.name) };
    match &*known.name {
        "bearing.radial_clearance" => 2e-9,
        name if name.ends_with(".stiffness") => 3e3,
        name if name.contains("damping") => 0.03 * nominal,
        name if name.contains("slip") => 2e-3,
        name if name.contains("angle") => 2e-6,
        name if name.contains("speed") => 0.05,
        name if name.contains("load") => 0.005,
        name if name.ends_with(".x") || name.ends_with(".y") => 1e-11,
        _ => 1e-5 * nominal,
    }
}

/// Quotients of second order of the unknowns by a known: on both sides, or above where its limit is near.
fn quotients(simulation: &mut Simulation, unknowns: &[u32], known: &Variable) -> Vec<f64> {
    let (at, step) = (reals(simulation, &[known.reference])[0], nudge(known));
    let Kind::Real { min, .. } = known.kind else { panic!("{}", known.name) };
    let points = if min.is_some_and(|min| at - step < min) {
        [(0.0, -1.5), (1.0, 2.0), (2.0, -0.5)]
    } else {
        [(-1.0, -0.5), (0.0, 0.0), (1.0, 0.5)]
    };
    let mut sum = vec![0.0; unknowns.len()];
    for (steps, share) in points {
        simulation.set_reals(&[known.reference], &[at + steps * step]).unwrap();
        for (sum, value) in sum.iter_mut().zip(reals(simulation, unknowns)) {
            *sum += share / step * value;
        }
    }
    simulation.set_reals(&[known.reference], &[at]).unwrap();
    sum
}

#[test]
fn a_start_follows_every_known_that_is_listed_as_its_derivative_says_in_all_kinds_of_scenes() {
    for name in SCENES {
        let mut simulation = simulation(shipped(name));
        let table = simulation.table().to_vec();
        let is_real = |variable: &&Variable| matches!(variable.kind, Kind::Real { .. });
        let outputs = table.iter().filter(|variable| variable.causality == Causality::Output).filter(is_real);
        let unknowns: Vec<u32> = outputs.map(|variable| variable.reference).collect();
        let dependencies = simulation.dependencies();
        let middle = reals(&mut simulation, &unknowns);
        let mut compared = 0;
        for known in table.iter().filter(|v| matches!(v.causality, Causality::Input | Causality::Parameter)) {
            let listed =
                |unknown: u32| dependencies.iter().any(|d| d.output == unknown && d.initial.contains(&known.reference));
            if !is_real(&known) || !unknowns.iter().any(|&unknown| listed(unknown)) {
                continue;
            }
            let mut given = vec![f64::NAN; unknowns.len()];
            simulation.directional_derivative(&unknowns, &[known.reference], &[1.0], &mut given).unwrap();
            let found = quotients(&mut simulation, &unknowns, known);
            for (i, &unknown) in unknowns.iter().enumerate() {
                let Kind::Real { nominal, .. } = table[unknown as usize].kind else { panic!() };
                // Truncation goes with the squares of the steps, chosen for less than 1e-4; the equilibrium is known
                // to 1e-12 of an output's magnitude.
                let allowed = 1e-4 * given[i].abs() + 4e-12 * middle[i].abs().max(nominal) / nudge(known);
                let of = &table[unknown as usize].name;
                let miss = (given[i] - found[i]).abs();
                assert!(miss <= allowed, "{name}: {of} by {}: {} given, {} found", known.name, given[i], found[i]);
                assert!(listed(unknown) || given[i] == 0.0, "{name}: {of} by {} is not listed", known.name);
                compared += usize::from(given[i] != 0.0);
            }
        }
        assert!(compared > 50, "{name}: {compared}");
    }
}

#[test]
fn elements_in_a_cage_that_wanders_start_at_their_own_speeds_and_so_do_derivatives() {
    // As much wander as a scene may have, so that the nominal cage's speed would not do.
    let mut scene = shipped("6205-irregular-cage");
    let irregularity = scene.cage.irregularity.as_mut().unwrap();
    (irregularity.wander, irregularity.jitter) = (0.1, 0.0);
    let mut simulation = simulation(scene);
    let [speed, y, force] =
        ["shaft.speed", "shaft.y", "element[4].force.outer"].map(|name| simulation.reference(name).unwrap());
    let known = simulation.table()[speed as usize].clone();
    let mut given = [f64::NAN; 2];
    simulation.directional_derivative(&[y, force], &[speed], &[1.0], &mut given).unwrap();
    let found = quotients(&mut simulation, &[y, force], &known);
    for (given, found) in given.into_iter().zip(found) {
        // As in the test of all knowns.
        assert!((given - found).abs() < 1e-3 * given.abs(), "{given} {found}");
    }
}

#[test]
fn the_stiffness_beside_an_edge_inside_is_the_slope_of_the_force() {
    // Rings that a host holds, at rest: the force on the inner one is elastic, and elements are in balance.
    let mut scene = shipped_as_it_is("nu205-inner");
    (scene.shaft, scene.housing) = (Ring::hosted(), Ring::fixed());
    (scene.shaft_speed, scene.recorder) = (0.0, None);
    scene.sensors.clear();
    let bottom = -std::f64::consts::FRAC_PI_2;
    (scene.cage.initial_angle, scene.defects[0].angle) = (bottom, bottom);
    let (along, radius) = (1.2e-3, scene.bearing.inner_raceway_radius());
    let clearance = scene.bearing.radial_clearance;
    let mut simulation = simulation(scene);
    let (mut compared, push) = (0, -clearance - 9e-6);
    for beside in [-0.2, -0.1, -0.05, 0.05, 0.1, 0.2] {
        let edge = (0.5 * along + beside * 1e-3) / radius;
        for turned in [edge, -edge] {
            simulation.set("shaft.initial_angle", turned).unwrap();
            let mut at = |x: f64, y: f64| {
                simulation.set("shaft.x", x).unwrap();
                simulation.set("shaft.y", y).unwrap();
                let force = ["shaft.force.x", "shaft.force.y"].map(|name| simulation.get(name).unwrap());
                (force, STIFFNESSES.map(|name| simulation.get(name).unwrap()))
            };
            let h = 1e-10;
            let (_, found) = at(1e-6, push);
            let slopes = [(h, 0.0), (0.0, h)].map(|(x, y)| {
                let (before, after) = (at(1e-6 - x, push - y).0, at(1e-6 + x, push + y).0);
                [0, 1].map(|axis| -(after[axis] - before[axis]) / (2.0 * h))
            });
            let expected = [slopes[0][0], slopes[1][0], slopes[0][1], slopes[1][1]];
            let scale = expected.iter().fold(0.0f64, |most, value| most.max(value.abs()));
            for (found, expected) in found.into_iter().zip(expected) {
                // Rounding of 1e4 N over 1e-10 m, and second derivatives as differences over 1 nm.
                assert!((found - expected).abs() < 1e-5 * scale, "{beside} mm, {turned}: {found:e} {expected:e}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 48);
}

#[test]
fn the_stiffness_over_a_defect_inside_changes_with_time_as_its_derivative_says() {
    let mut simulation = simulation(shipped_as_it_is("nu205-inner"));
    let references = STIFFNESSES.map(|name| simulation.reference(name).unwrap());
    simulation.initialize(0.0).unwrap();
    let mut compared = 0;
    for _ in 0..160 {
        simulation.step(2.5e-4).unwrap();
        let (saved, mut given) = (simulation.save(), [f64::NAN; 4]);
        simulation.output_derivatives(&references, &[1; 4], &mut given).unwrap();
        let step = 1e-8;
        let [now, next, last] = [0.0, 1.0, 2.0].map(|steps| {
            simulation.restore(&saved).unwrap();
            if steps > 0.0 {
                simulation.step(steps * step).unwrap();
            }
            reals(&mut simulation, &references)
        });
        simulation.restore(&saved).unwrap();
        for i in 0..4 {
            let (first, second) = ((next[i] - now[i]) / step, (last[i] - next[i]) / step);
            let expected = 1.5 * first - 0.5 * second;
            // Where the slope itself changes within the step a quotient says little: a contact begins, or nearly.
            if (first - second).abs() > 2e-2 * expected.abs() {
                continue;
            }
            // The rest of truncation is (2e-2)² of it; rounding of 1e8 N/m over 1e-8 s.
            let allowed = 2e-3 * expected.abs() + 1e-13 * now[3].abs() / step;
            let name = STIFFNESSES[i];
            assert!((given[i] - expected).abs() <= allowed, "{name}: {} given, {expected} found", given[i]);
            compared += 1;
        }
    }
    assert!(compared > 500, "{compared}");
}
