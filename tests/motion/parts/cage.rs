//! Irregular cages: elements off even spacing, jitter about it, a speed that wanders.

use crate::support::defects::{cells_kept, element, held, inner, spall};
use crate::support::differences::{by_input, by_time};
use crate::support::loaded::amplitude;
use crate::support::{Named, shipped};
use brinell::scene::{CageIrregularity, Defect, DefectOn, Motion, Ring, Scene};
use std::f64::consts::{FRAC_PI_2, TAU};

fn irregular(mut scene: Scene, offsets: Vec<f64>, jitter: f64, wander: f64) -> Scene {
    scene.cage.irregularity = Some(CageIrregularity { offsets, drawn: None, jitter, wander, seed: 42 });
    scene
}

/// Cage with everything uneven at once, far more than real ones.
fn uneven(scene: Scene) -> Scene {
    let offsets = [0.03, -0.02, 0.01, 0.02, -0.04, 0.0, 0.01, -0.03, 0.02];
    irregular(scene, offsets.to_vec(), 0.02, 0.01)
}

/// Both rings held with their centres apart, so that elements go their ways each for itself over a shallow dent.
fn eccentric() -> Scene {
    let mut scene = held(Defect::outer(-FRAC_PI_2, spall(0.5e-3, 2e-6)));
    (scene.shaft, scene.gravity) = (Ring::hosted(), [0.0; 2]);
    scene.tolerance = 1e-7;
    scene
}

/// Both rings of it held so, at the start.
const APART: [(&str, f64); 1] = [("shaft.y", -12e-6)];

/// Amplitudes of the lines of the outer ring's vertical force at whole multiples of the cage's speed.
fn lines<const N: usize>(scene: Scene, orders: [usize; N]) -> [f64; N] {
    let mut bearing = Named::started_with(scene, &APART);
    let turn = TAU / bearing.get("cage.speed");
    // Elements come to their ways within a spacing.
    bearing.run(turn / 9.0, 1);
    let force = bearing.course(["shaft.force.y"], turn / 4500.0, 4500);
    orders.map(|order| amplitude(force.as_flattened(), order))
}

#[test]
fn lines_of_uneven_spacing_are_those_of_even_spacing_times_the_mean_of_their_phases() {
    let offsets = [0.02, -0.015, 0.005, 0.011, -0.02, 0.004, 0.009, -0.019, 0.005];
    let orders = [9, 18, 27, 36];
    let even = lines(eccentric(), orders);
    let found = lines(irregular(eccentric(), offsets.to_vec(), 0.0, 0.0), orders);
    for ((order, even), found) in orders.into_iter().zip(even).zip(found) {
        let phases = offsets.iter().enumerate().map(|(j, offset)| order as f64 * (TAU * j as f64 / 9.0 + offset));
        let sums = phases.fold([0.0; 2], |[re, im], phase| [re + phase.cos(), im + phase.sin()]);
        let expected = even * sums[0].hypot(sums[1]) / 9.0;
        // What samples leave of the edges' steps.
        assert!((found - expected).abs() < 0.01 * even, "order {order}: {found} N, {expected} N expected");
        assert!(even > 0.02, "{even}");
    }
}

/// Steps of so long (s) in which the shaft turns the cage evenly from one speed to another.
fn driven_by(bearing: &mut Named, step: f64) -> impl FnMut(&mut Named, f64, f64) + use<> {
    let input = bearing.reference("shaft.speed");
    let ratio = bearing.get("shaft.speed") / bearing.get("cage.speed");
    move |bearing, before, after| {
        bearing.0.set_reals(&[input], &[before * ratio]).unwrap();
        bearing.0.set_input_derivatives(&[input], &[1], &[(after - before) * ratio / step]).unwrap();
        bearing.run(step, 1);
    }
}

#[test]
fn a_cage_whose_speed_wanders_is_an_even_one_driven_at_that_speed() {
    let [mut wandering, mut driven] =
        [irregular(eccentric(), vec![0.0; 9], 0.0, 0.03), eccentric()].map(|scene| Named::started_with(scene, &APART));
    let mut drive = driven_by(&mut driven, 1e-4);
    let mut before = wandering.get("cage.speed");
    let (mut most, mut least) = (before, before);
    for k in 0..2000 {
        wandering.run(1e-4, 1);
        let after = wandering.get("cage.speed");
        drive(&mut driven, before, after);
        before = after;
        (most, least) = (most.max(after), least.min(after));
        let off = (wandering.get("cage.angle") - driven.get("cage.angle")).abs();
        // Trapezoids of the speed add up to h²/12 of what its slope changes by, some rad/s².
        assert!(off < 5e-9, "{off:e} rad after {k} steps");
        for j in 1..=9 {
            for name in [format!("element[{j}].path"), format!("element[{j}].angle")] {
                let (a, b) = (wandering.get(&name), driven.get(&name));
                // Paths change by some 1e-6 m a radian, by more over the dent's edges.
                assert!((a - b).abs() < 3e-9, "{name}: {a} {b} after {k} steps");
            }
        }
    }
    assert!(most / least > 1.003, "{least} to {most}");
}

#[test]
fn one_element_that_jitters_is_a_cage_driven_unevenly() {
    let [even, irregular] = [eccentric(), irregular(eccentric(), vec![0.0], 0.1, 0.0)].map(|mut scene| {
        scene.bearing.element_count = 1;
        scene
    });
    let mut jittering = Named::started_with(irregular, &APART);
    let start = jittering.get("element[1].angle");
    let mut driven = Named::started_with(even, &[APART[0], ("cage.initial_angle", start)]);
    let mut drive = driven_by(&mut driven, 1e-4);
    let angle = jittering.reference("element[1].angle");
    let mut swing = 0.0f64;
    for k in 0..2000 {
        let speed = |bearing: &mut Named| {
            let mut rate = [0.0];
            bearing.0.output_derivatives(&[angle], &[1], &mut rate).unwrap();
            rate[0]
        };
        let before = speed(&mut jittering);
        jittering.run(1e-4, 1);
        let after = speed(&mut jittering);
        drive(&mut driven, before, after);
        swing = swing.max((jittering.get("element[1].angle") - jittering.get("cage.angle")).abs());
        for (name, limit) in [("element[1].angle", 1e-8), ("element[1].path", 1e-8), ("element[1].force.inner", 1e-2)] {
            let (a, b) = (jittering.get(name), driven.get(name));
            // Chords of the speed for its course.
            assert!((a - b).abs() < limit, "{name}: {a} {b} after {k} steps");
        }
    }
    assert!(swing > 0.05, "{swing}");
}

#[test]
fn contacts_meet_the_cells_in_which_their_angles_are() {
    let outer = held(Defect::outer(-FRAC_PI_2, spall(0.8e-3, 40e-6)));
    for scene in [uneven(inner()), uneven(element(0.4e-3)), uneven(outer)] {
        let [inside, differ] = cells_kept(scene);
        // On a knot itself rounding decides.
        assert!(inside > 15 && differ <= 1, "{inside} {differ}");
    }
}

#[test]
fn passages_are_functions_of_the_angle_whatever_the_communication_step() {
    let angles = |step: f64, count: usize| {
        let mut bearing = Named::started(uneven(held(Defect::outer(-FRAC_PI_2, spall(0.3e-3, 10e-6)))));
        bearing.run(step, count);
        let mut found: Vec<f64> = (1..=9).map(|j| bearing.get(&format!("element[{j}].angle"))).collect();
        found.extend([bearing.get("cage.angle"), bearing.get("cage.speed")]);
        found.extend((1..=9).map(|j| 1e3 * bearing.get(&format!("element[{j}].path"))));
        found
    };
    for (a, b) in angles(2e-3, 30).iter().zip(angles(7.5e-5, 800)) {
        // Rounding of the angle, and of paths the tolerance of the integration.
        assert!((a - b).abs() < 1e-8, "{a} {b}");
    }
    // Saved and put back: equal bits, at angles that have their shortcuts elsewhere.
    let [mut bearing, mut other] = [(); 2].map(|()| Named::started(uneven(inner())));
    bearing.run(1e-4, 30);
    other.run(1e-3, 37);
    let names = ["shaft.x", "shaft.y", "element[3].path", "cage.torque", "cage.speed"];
    bearing.goes_on_alike(&mut other, names, 1e-4, 40);
}

#[test]
fn rates_of_outputs_are_what_short_steps_show() {
    let mut scene = uneven(shipped("er16k-tb1-hosted-shaft"));
    scene.defects =
        vec![Defect { on: DefectOn::Element { element: 2, tilt: 0.0 }, ..Defect::outer(0.0, spall(3e-4, 1e-5)) }];
    assert_eq!(scene.shaft.motion, Motion::Host);
    scene.tolerance = 1e-9;
    let mut bearing = Named::started_with(scene, &APART);
    bearing.run(1e-4, 20);
    let names =
        ["cage.angle", "cage.speed", "element[1].angle", "element[9].angle", "element[3].spin_angle", "cage.torque"];
    let step = 2e-9;
    for (slope, name) in by_time(&mut bearing.0, &names, step).into_iter().zip(names) {
        // One-sided: a third of the third derivative times the step's square, of 40 kHz; and the rounding of radians,
        // and of the newton metres that cancel in the torque.
        assert!(slope.miss() < 1e-3 * slope.found.abs() + 4e-15 / step, "{name}: {slope:?}");
    }
    // How the speed answers to the shaft's.
    let slope = by_input(&mut bearing.0, &["cage.speed"], "shaft.speed", 0.5)[0];
    assert!(slope.miss() < 1e-9, "{slope:?}");
}

#[test]
fn a_defect_of_an_element_is_where_the_scene_says_at_the_start() {
    let mut bearing = Named::started(uneven(element(0.4e-3)));
    let start = bearing.get("element[1].spin_angle");
    let said = element(0.4e-3).defects[0].angle;
    assert!((start - said).abs() < 1e-13, "{start} {said}");
}

#[test]
fn keys_of_the_cage_are_read() {
    let text = include_str!("../../../scenes/er16k-tb1.toml");
    let with = |keys: &str| {
        let (before, after) = text.split_once("[cage]\n").unwrap();
        brinell_scene_file::from_toml(&format!("{before}[cage]\n{keys}\n{after}"))
    };
    let cage = |keys: &str| with(keys).unwrap().cage.irregularity;
    assert_eq!(cage("spacing_rms_deg = 0.0\njitter_rms_deg = 0.0\nwander = 0.0"), None);
    // Their sum is taken off.
    let given = cage("spacing_deg = [1, 0, 0, 0, 0, 0, 0, 0, 0.8]").unwrap();
    assert!(given.offsets.iter().sum::<f64>().abs() < 1e-16);
    assert!((given.offsets[0].to_degrees() - 0.8).abs() < 1e-12);
    let recorded = cage("irregularity = \"recorded\"\nseed = 3").unwrap();
    let rms = (recorded.offsets.iter().map(|x| x * x).sum::<f64>() / 9.0).sqrt();
    assert!((rms / (TAU / 9.0) - 0.006).abs() < 1e-9 && (recorded.jitter / (TAU / 9.0) - 0.004).abs() < 1e-9);
    assert_eq!(recorded.wander, 0.003);
    let drawn = |seed: u64| cage(&format!("spacing_rms_deg = 0.2\nseed = {seed}")).unwrap().offsets;
    assert!(drawn(1) == drawn(1) && drawn(1) != drawn(2));
}
