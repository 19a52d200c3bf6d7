//! Irregular cages: elements off even spacing, jitter about it, a speed that wanders.

use crate::support::defects::{cells_kept, element, held, inner, spall};
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

/// Magnitudes of the lines of the outer ring's vertical force at whole multiples of the cage's speed.
fn lines(scene: Scene, orders: &[usize]) -> Vec<f64> {
    let mut bearing = Named::new(scene);
    bearing.0.set("shaft.y", -12e-6).unwrap();
    bearing.0.initialize(0.0).unwrap();
    let turn = TAU / bearing.get("cage.speed");
    let count = 4500;
    // Elements come to their ways within a spacing.
    bearing.run(turn / 9.0, 1);
    let force: Vec<f64> = (0..count)
        .map(|_| {
            bearing.0.step(turn / f64::from(count)).unwrap();
            bearing.get("shaft.force.y")
        })
        .collect();
    orders
        .iter()
        .map(|&order| {
            let sums = force.iter().enumerate().fold([0.0; 2], |[re, im], (k, force)| {
                let (sin, cos) = (TAU * (order * k) as f64 / f64::from(count)).sin_cos();
                [re + force * cos, im + force * sin]
            });
            sums[0].hypot(sums[1]) / f64::from(count)
        })
        .collect()
}

#[test]
fn lines_of_uneven_spacing_are_those_of_even_spacing_times_the_mean_of_their_phases() {
    let offsets = [0.02, -0.015, 0.005, 0.011, -0.02, 0.004, 0.009, -0.019, 0.005];
    let orders = [9, 18, 27, 36];
    let even = lines(eccentric(), &orders);
    let found = lines(irregular(eccentric(), offsets.to_vec(), 0.0, 0.0), &orders);
    for ((order, even), found) in orders.into_iter().zip(even).zip(found) {
        let phases = offsets.iter().enumerate().map(|(j, offset)| order as f64 * (TAU * j as f64 / 9.0 + offset));
        let sums = phases.fold([0.0; 2], |[re, im], phase| [re + phase.cos(), im + phase.sin()]);
        let expected = even * sums[0].hypot(sums[1]) / 9.0;
        // What samples leave of the edges' steps.
        assert!((found - expected).abs() < 0.01 * even, "order {order}: {found} N, {expected} N expected");
        assert!(even > 0.01, "{even}");
    }
}

#[test]
fn a_cage_whose_speed_wanders_is_an_even_one_driven_at_that_speed() {
    let scene = irregular(eccentric(), vec![0.0; 9], 0.0, 0.03);
    let mut wandering = Named::new(scene);
    let mut driven = Named::new(eccentric());
    for bearing in [&mut wandering, &mut driven] {
        bearing.0.set("shaft.y", -12e-6).unwrap();
        bearing.0.initialize(0.0).unwrap();
    }
    let (step, input) = (1e-4, driven.reference("shaft.speed"));
    let ratio = driven.get("shaft.speed") / driven.get("cage.speed");
    let mut before = wandering.get("cage.speed");
    let (mut most, mut least) = (before, before);
    for k in 0..2000 {
        wandering.0.step(step).unwrap();
        let after = wandering.get("cage.speed");
        driven.0.set_reals(&[input], &[before * ratio]).unwrap();
        driven.0.set_input_derivatives(&[input], &[1], &[(after - before) * ratio / step]).unwrap();
        driven.0.step(step).unwrap();
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
    let alone = |scene: Scene| {
        let mut scene = scene;
        scene.bearing.element_count = 1;
        scene
    };
    let mut jittering = Named::new(alone(irregular(eccentric(), vec![0.0], 0.1, 0.0)));
    let mut driven = Named::new(alone(eccentric()));
    for bearing in [&mut jittering, &mut driven] {
        bearing.0.set("shaft.y", -12e-6).unwrap();
    }
    jittering.0.initialize(0.0).unwrap();
    let start = jittering.get("element[1].angle");
    driven.0.set("cage.initial_angle", start).unwrap();
    driven.0.initialize(0.0).unwrap();
    let (step, input) = (1e-4, driven.reference("shaft.speed"));
    let ratio = driven.get("shaft.speed") / driven.get("cage.speed");
    let angle = jittering.reference("element[1].angle");
    let mut swing = 0.0f64;
    for k in 0..2000 {
        let speed = |bearing: &mut Named| {
            let mut rate = [0.0];
            bearing.0.output_derivatives(&[angle], &[1], &mut rate).unwrap();
            rate[0]
        };
        let before = speed(&mut jittering);
        jittering.0.step(step).unwrap();
        let after = speed(&mut jittering);
        driven.0.set_reals(&[input], &[before * ratio]).unwrap();
        driven.0.set_input_derivatives(&[input], &[1], &[(after - before) * ratio / step]).unwrap();
        driven.0.step(step).unwrap();
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
    let mut bearing = Named::started(uneven(inner()));
    bearing.run(1e-4, 30);
    let state = bearing.0.save();
    let course = |bearing: &mut Named| {
        bearing.run(1e-4, 40);
        ["shaft.x", "shaft.y", "element[3].path", "cage.torque", "cage.speed"].map(|name| bearing.get(name).to_bits())
    };
    let first = course(&mut bearing);
    bearing.run(1e-3, 30);
    bearing.0.restore(&state).unwrap();
    assert_eq!(course(&mut bearing), first);
}

#[test]
fn rates_of_outputs_are_what_short_steps_show() {
    let mut scene = uneven(shipped("er16k-tb1-hosted-shaft"));
    scene.defects =
        vec![Defect { on: DefectOn::Element { element: 2, tilt: 0.0 }, ..Defect::outer(0.0, spall(3e-4, 1e-5)) }];
    scene.contact.law = brinell::scene::ContactLaw::Hertz;
    assert_eq!(scene.shaft.motion, Motion::Host);
    scene.tolerance = 1e-9;
    let mut bearing = Named::new(scene);
    bearing.0.set("shaft.y", -12e-6).unwrap();
    bearing.0.initialize(0.0).unwrap();
    bearing.run(1e-4, 20);
    let names =
        ["cage.angle", "cage.speed", "element[1].angle", "element[9].angle", "element[3].spin_angle", "cage.torque"];
    let references = names.map(|name| bearing.reference(name));
    let mut rates = [0.0; 6];
    bearing.0.output_derivatives(&references, &[1; 6], &mut rates).unwrap();
    let start = names.map(|name| bearing.get(name));
    let step = 2e-9;
    bearing.0.step(step).unwrap();
    let end = names.map(|name| bearing.get(name));
    for k in 0..names.len() {
        let quotient = (end[k] - start[k]) / step;
        // One-sided: half the second derivative times the step, that of 40 kHz; and the rounding of radians, and of the
        // newton metres that cancel in the torque.
        let limit = 1e-3 * quotient.abs() + 4e-15 / step;
        assert!((quotient - rates[k]).abs() < limit, "{}: {quotient} {}", names[k], rates[k]);
    }
    // How the speed answers to the shaft's.
    let (input, output) = (bearing.reference("shaft.speed"), bearing.reference("cage.speed"));
    let mut derivative = [0.0];
    bearing.0.directional_derivative(&[output], &[input], &[1.0], &mut derivative).unwrap();
    let at = |bearing: &mut Named, by: f64| {
        let speed = bearing.get("shaft.speed");
        bearing.0.set_reals(&[input], &[speed + by]).unwrap();
        bearing.get("cage.speed")
    };
    let quotient = at(&mut bearing, 1.0) - at(&mut bearing, -1.0);
    assert!((quotient - derivative[0]).abs() < 1e-9, "{quotient} {}", derivative[0]);
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
