//! Derivatives of outputs: at the start by all that the start depends on, and by time where defects inside are met.

use crate::support::differences::{by_input, by_time, reals};
use crate::support::{Named, shipped, shipped_as_it_is, straight};
use brinell::scene::{
    Bearing, ContactLaw, Damping, Defect, DefectOn, DefectShape, DrawnDiameters, Ring, Scene, Waviness, WavyBody,
};
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

/// Each of them, and one whose elements are unequal and whose raceways are wavy.
fn scenes() -> Vec<(&'static str, Scene)> {
    let mut uneven = shipped("6205-inner-5deg");
    uneven.bearing.draw_diameters(DrawnDiameters { rms: 0.5e-6, seed: 3 });
    let waves = |on, order, crest| Waviness { on, order, amplitude: 0.5e-6, crest };
    uneven.waviness = vec![waves(WavyBody::Inner, 7, 0.2), waves(WavyBody::Outer, 10, 1.0)];
    SCENES.into_iter().map(|name| (name, shipped(name))).chain([("uneven", uneven)]).collect()
}

fn simulation(scene: Scene) -> Simulation {
    Named::new(scene).0
}

/// How far a known is moved: other ways than those of the derivatives that are differences themselves.
fn nudge(known: &Variable) -> f64 {
    let Kind::Real { nominal, .. } = known.kind else { panic!("{}", known.name) };
    match &*known.name {
        "bearing.internal_clearance" => 4e-9,
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
    for (name, scene) in scenes() {
        let mut simulation = simulation(scene);
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
    for slope in by_input(&mut simulation, &["shaft.y", "element[4].force.outer"], "shaft.speed", 0.05) {
        assert!(slope.miss() < 1e-3 * slope.given.abs(), "{slope:?}");
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
    simulation.initialize(0.0).unwrap();
    let (mut compared, step) = (0, 1e-8);
    for _ in 0..160 {
        simulation.step(2.5e-4).unwrap();
        let slopes = by_time(&mut simulation, &STIFFNESSES, step);
        for (slope, name) in slopes.iter().zip(STIFFNESSES) {
            // Where the slope itself changes within the step a quotient says little: a contact begins, or nearly.
            if slope.second > 2e-2 * slope.found.abs() {
                continue;
            }
            // The rest of truncation is (2e-2)² of it; rounding of 1e8 N/m over 1e-8 s.
            let allowed = 2e-3 * slope.found.abs() + 1e-13 * slopes[3].size / step;
            assert!(slope.miss() <= allowed, "{name}: {slope:?}");
            compared += 1;
        }
    }
    assert!(compared > 500, "{compared}");
}

const BOTTOM: f64 = -std::f64::consts::FRAC_PI_2;

/// Balls without weight, the first at the bottom, in rings that a host holds.
fn weightless(radial_clearance: f64, outer_compliance: f64) -> Scene {
    let bearing = Bearing { radial_clearance, outer_compliance, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) };
    let scene = Scene::builder(bearing).gravity([0.0; 2]).shaft(Ring::hosted()).housing(Ring::fixed());
    scene.cage(0.0, BOTTOM).law(ContactLaw::Hertz).build().unwrap()
}

/// Presses the inner ring down until the ball at the bottom is touched, and by this much (m) further.
fn press(simulation: &mut Simulation, x: f64, further: f64) {
    let [x_of, y_of, force] =
        ["shaft.x", "shaft.y", "element[1].force.inner"].map(|name| simulation.reference(name).unwrap());
    let (mut deep, mut open) = (-100e-6, 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (deep + open);
        simulation.set_reals(&[x_of, y_of], &[x, middle]).unwrap();
        if reals(simulation, &[force])[0] > 0.0 { deep = middle } else { open = middle }
    }
    simulation.set_reals(&[y_of], &[deep - further]).unwrap();
}

#[test]
fn the_stiffness_of_contacts_pressed_in_by_less_than_a_nanometre_changes_as_its_derivative_says() {
    // Beside an edge, where a ball hangs on it and is not on the floor.
    let spall = |on: DefectOn| {
        let mut scene = weightless(5e-6, 0.0);
        let length = 1.2e-3;
        let radius = if on == DefectOn::Inner { 15.55e-3 } else { 23.49e-3 };
        let shape = DefectShape::Spall { length, depth: 30e-6, edge_slope: 87f64.to_radians() };
        scene.defects = vec![Defect { on, angle: BOTTOM + (0.5 * length - 20e-6) / radius, shape }];
        scene
    };
    let scenes = [
        ("rigid", weightless(5e-6, 0.0)),
        ("yielding", weightless(5e-6, 2e-9)),
        ("edge inside", spall(DefectOn::Inner)),
        ("edge outside", spall(DefectOn::Outer)),
    ];
    for (what, scene) in scenes {
        let mut simulation = simulation(scene);
        let further = 6e-10;
        press(&mut simulation, 0.0, further);
        let slope = by_input(&mut simulation, &STIFFNESSES[3..], "shaft.y", 3e-3 * further)[0];
        // The difference of the derivative over a hundredth of the approach leaves out 3e-5, what is near the edge up
        // to ten times that, as its tangent is a difference itself.
        assert!(slope.miss() <= 3e-4 * slope.found.abs(), "{what}: {slope:?}");
        assert!(slope.found < 0.0, "{what}: deeper is stiffer, {slope:?}");
    }
}

#[test]
fn weights_of_balls_in_a_clearance_of_a_millimetre_follow_it_as_their_derivative_says() {
    let bearing = Bearing { radial_clearance: 1.1e-3, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) };
    let scene = Scene::builder(bearing).shaft(Ring::hosted()).housing(Ring::fixed()).law(ContactLaw::Hertz);
    let mut simulation = simulation(scene.gravity([0.0, -9.81]).build().unwrap());
    simulation.set("shaft.x", 5e-4).unwrap();
    simulation.set("shaft.y", 3e-4).unwrap();
    let forces: Vec<String> = (1..=9).map(|j| format!("element[{j}].force.inner")).collect();
    let forces: Vec<&str> = forces.iter().map(String::as_str).collect();
    let mut wrong = 0.0f64;
    for k in 0..12 {
        simulation.set("cage.initial_angle", 0.05 * f64::from(k)).unwrap();
        let slopes = by_input(&mut simulation, &forces, "bearing.internal_clearance", 2e-7);
        wrong = slopes.iter().fold(wrong, |wrong, slope| wrong.max(slope.miss()));
    }
    // Positions of a millimetre are known to 2e-19 m, which 2e6 N/m make 4e-13 N. Of four differences three times as
    // much is left over a hundredth of the 5 nm by which the least ball is pressed in: 0.03 N/m, twice.
    assert!(wrong < 5e-2, "{wrong} N/m");
}

/// Where the balance of a roller lies between two neighbouring numbers of its path, less touches it at one than at the
/// other. Its path follows the ring that carries it.
#[test]
fn straight_rollers_that_rest_on_the_inner_ring_follow_it_at_every_cage_angle() {
    let mut scene = shipped("nu205-healthy");
    scene.bearing.element = straight(9e-3);
    scene.contact.damping = Damping::Proportional(1.25e-5);
    (scene.shaft, scene.housing) = (Ring::hosted(), Ring::fixed());
    (scene.shaft_speed, scene.recorder) = (std::f64::consts::TAU, None);
    scene.sensors.clear();
    let count = scene.bearing.element_count;
    let mut simulation = simulation(scene);
    let paths: Vec<String> = (1..=count).map(|j| format!("element[{j}].path")).collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    simulation.set("shaft.x", 4e-6).unwrap();
    // Of 0.03 N of weight a damper of 1.25e-5 s carries more from one number to the next.
    simulation.set("shaft.vy", 1e-3).unwrap();
    let mut carried = 0;
    for k in 0..24 {
        simulation.set("cage.initial_angle", f64::from(k) * std::f64::consts::TAU / 24.0).unwrap();
        for (slope, path) in by_input(&mut simulation, &paths, "shaft.y", 1e-10).iter().zip(&paths) {
            // A roller that begins to be carried has two derivatives.
            if slope.second > 1e-3 {
                continue;
            }
            // A path of 30 µm is known to 3e-21 m, and the ring's distance curves over its play: 1e-10/0.02.
            assert!(slope.miss() < 1e-4, "angle {k}, {path}: {slope:?}");
            carried += usize::from(slope.found.abs() > 0.1);
        }
    }
    assert!(carried > 24, "{carried}");
}
