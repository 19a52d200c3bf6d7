//! The model against laws: balance, symmetry, conservation, and what a step may not do.

use crate::counting;
use crate::support::energy::energy;
use crate::support::{Named, shipped};
use brinell::scene::{Damping, Ring, Scene};
use brinell::simulation::Method;
use proptest::prelude::*;

#[test]
fn contact_forces_of_the_initial_equilibrium_sum_to_the_load() {
    for name in ["6205-healthy", "6205-epps", "er16k-tb1", "er16k-tb2"] {
        let scene = shipped(name);
        let load = scene.shaft.load;
        let mut bearing = Named::started(scene);
        for (axis, letter) in ["x", "y"].iter().enumerate() {
            let force = bearing.get(&format!("shaft.force.{letter}"));
            // The balance that was asked for: nine digits of the load.
            assert!((force + load[axis]).abs() < 1e-9 * load[1].abs(), "{name}: {force} along {letter}");
        }
    }
}

#[test]
fn the_element_forces_of_the_initial_equilibrium_add_up_to_the_load() {
    let scene = shipped("6205-healthy");
    let mut bearing = Named::started(scene.clone());
    let [x, y, housing_x, housing_y] = bearing.all(["shaft.x", "shaft.y", "housing.x", "housing.y"]);
    let radius = scene.bearing.outer_raceway_radius() - scene.bearing.element_radius();
    let mut sum = [0.0; 2];
    for j in 1..=9 {
        let [angle, path, force] =
            ["angle", "path", "force.inner"].map(|what| bearing.get(&format!("element[{j}].{what}")));
        let rho = radius + path;
        let q = [housing_x + rho * angle.cos() - x, housing_y + rho * angle.sin() - y];
        let length = q[0].hypot(q[1]);
        sum = [0, 1].map(|axis| sum[axis] - force * q[axis] / length);
    }
    let load = scene.shaft.load;
    assert!((0..2).all(|axis| (sum[axis] + load[axis]).abs() < 1e-9 * load[1].abs()), "{sum:?} {load:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn turning_the_cage_by_one_spacing_changes_no_force(
        angle in -3.2..3.2f64,
        load in prop_oneof![Just(0.0), 1.0..5000.0f64],
        direction in 0.0..6.3f64,
        speed in 0.0..1000.0f64,
    ) {
        let at = |initial_angle: f64| {
            let mut scene = shipped("er16k-tb1");
            scene.shaft.load = [load * direction.cos(), load * direction.sin()];
            scene.shaft_speed = speed;
            scene.cage.initial_angle = initial_angle;
            let mut bearing = Named::started(scene);
            (bearing.inner_forces(9), [bearing.get("shaft.force.x"), bearing.get("shaft.force.y")])
        };
        let (here, force_here) = at(angle);
        let (mut turned, force_turned) = at(angle + std::f64::consts::TAU / 9.0);
        turned.rotate_right(1);
        // Balance is solved to 1e-12 of the largest force; a loose position lets 1e-9 pass.
        let scale = here.iter().fold(1.0f64, |m, f| m.max(*f));
        for (a, b) in here.iter().zip(&turned) {
            prop_assert!((a - b).abs() < 1e-7 * scale, "{a} against {b}");
        }
        for axis in 0..2 {
            prop_assert!((force_here[axis] - force_turned[axis]).abs() < 1e-9 * scale);
        }
    }
}

#[test]
fn without_load_and_gravity_nothing_moves() {
    let mut scene = shipped("6205-healthy");
    scene.gravity = [0.0; 2];
    scene.shaft.load = [0.0; 2];
    scene.shaft_speed = 0.0;
    let mut bearing = Named::started(scene);
    bearing.run(1e-3, 50);
    for name in ["shaft.x", "shaft.y", "shaft.vx", "housing.y", "housing.ay", "element[4].path", "sensor.acceleration"]
    {
        assert_eq!(bearing.get(name), 0.0, "{name}");
    }
}

#[test]
fn without_damping_and_speed_energy_is_conserved() {
    let mut scene = Scene { housing: Ring::fixed(), sensors: Vec::new(), ..shipped("6205-healthy") };
    (scene.contact.damping, scene.shaft.damping) = (Damping::HuntCrossley(0.0), 0.0);
    (scene.shaft_speed, scene.tolerance) = (0.0, 1e-12);
    let mut bearing = Named::started(scene.clone());
    let energy = |bearing: &mut Named, scene: &Scene| energy(&mut bearing.0, scene)[0];
    let before = energy(&mut bearing, &scene);
    // A load that jumps sets the ring and the elements in motion, through loss and gain of contacts.
    scene.shaft.load = [200.0, 0.3 * scene.shaft.load[1]];
    bearing.set("shaft.load.x", scene.shaft.load[0]);
    bearing.set("shaft.load.y", scene.shaft.load[1]);
    let start = energy(&mut bearing, &scene);
    assert!(start != before);
    let stored = (start - energy(&mut Named::started(scene.clone()), &scene)).abs();
    let mut drift: f64 = 0.0;
    for _ in 0..100 {
        bearing.run(1e-3, 1);
        drift = drift.max((energy(&mut bearing, &scene) - start).abs());
    }
    // Relative to the energy that is exchanged between motion and contacts; the demand of the time integration.
    assert!(drift < 1e-10 * stored, "energy drifts by {drift:e} J of {stored:e} J");
}

#[test]
fn a_step_allocates_nothing() {
    let scenes = ["6205-healthy", "er16k-tb1", "6205-hosted"];
    for (name, method) in scenes.into_iter().flat_map(|n| [Method::Automatic, Method::Rodas].map(|m| (n, m))) {
        let mut bearing = Named::started(shipped(name));
        bearing.0.set_method(method);
        bearing.run(1e-4, 5);
        let (result, allocations) = counting::counted(|| (0..200).try_for_each(|_| bearing.0.step(1e-4)));
        result.unwrap();
        assert_eq!(allocations, 0, "{name}");
    }
}

/// Instants (s), on a grid of `step`, at which elements that carried before the leading edge of the spall of
/// `er16k-tb1` let go behind it.
fn lettings_go(scene: Scene, step: f64) -> Vec<f64> {
    let mut bearing = Named::started(scene);
    let (mut instants, mut carried) = (Vec::new(), [false; 9]);
    for i in 1..9000 {
        bearing.run(step, 1);
        for (j, carried) in carried.iter_mut().enumerate() {
            let angle = bearing.get(&format!("element[{}].angle", j + 1)).to_degrees();
            let past_edge = (angle + 90.0 + 7.9 + 180.0).rem_euclid(360.0) - 180.0;
            let carries = bearing.get(&format!("element[{}].force.outer", j + 1)) > 0.0;
            if (-2.0..0.0).contains(&past_edge) {
                *carried = carries;
            } else if (0.0..7.9).contains(&past_edge) && *carried && !carries {
                instants.push(f64::from(i) * step);
                *carried = false;
            }
        }
    }
    instants
}

#[test]
fn elements_fall_into_the_defect_at_the_ball_pass_frequency() {
    let scene = shipped("er16k-tb1");
    let bpfo = brinell::geometry::kinematics::frequencies(&scene.bearing, 0.0, 10.0).bpfo;
    // The source says 35.9 Hz.
    assert!((bpfo - 35.9).abs() < 0.05, "{bpfo}");
    let step = 1e-5;
    let instants = lettings_go(scene.clone(), step);
    assert!(instants.len() >= 3, "{instants:?}");
    for pair in instants.windows(2) {
        // Times are read on a grid of one step.
        assert!((pair[1] - pair[0] - 1.0 / bpfo).abs() < 1.5 * step, "{instants:?}");
    }
    let healthy = lettings_go(Scene { defects: Vec::new(), ..scene }, step);
    assert!(healthy.is_empty(), "without a defect: {healthy:?}");
}

#[test]
fn ring_motion_from_the_host_gives_the_forces_of_the_same_motion_computed_inside() {
    let scene = shipped("er16k-tb1");
    let mut inside = Named::started(scene.clone());
    let mut hosted = Named::new(Scene { shaft: Ring::hosted(), housing: Ring::hosted(), sensors: Vec::new(), ..scene });
    let names = ["x", "y", "vx", "vy", "ax", "ay"];
    let transfer = |inside: &mut Named, hosted: &mut Named| {
        for ring in ["shaft", "housing"] {
            for part in names {
                let value = inside.get(&format!("{ring}.{part}"));
                hosted.set(&format!("{ring}.{part}"), value);
            }
        }
    };
    transfer(&mut inside, &mut hosted);
    hosted.0.initialize(0.0).unwrap();
    let (mut worst, mut largest) = (0.0f64, 0.0f64);
    for _ in 0..4000 {
        // 2 µs: extrapolation by v and a is wrong by 1/6 jerk H³, below 1e-12 m here except for impacts.
        inside.run(2e-6, 1);
        hosted.run(2e-6, 1);
        transfer(&mut inside, &mut hosted);
        let (a, b) = (inside.get("shaft.force.y"), hosted.get("shaft.force.y"));
        worst = worst.max((a - b).abs());
        largest = largest.max(a.abs());
    }
    // Ten times the solver's tolerance of 1e-5, over 8 ms that contain the entry of an element into the spall.
    assert!(worst < 1e-4 * largest, "{worst} of {largest} N");
}

#[test]
fn the_result_does_not_depend_on_how_the_host_splits_the_time() {
    let end = |steps: &[f64]| {
        let mut scene = shipped("er16k-tb1");
        scene.tolerance = 1e-9;
        let mut bearing = Named::started(scene);
        let mut time = 0.0;
        for &step in steps.iter().cycle() {
            let step = f64::min(step, 0.009 - time);
            if step <= 1e-12 {
                break;
            }
            bearing.run(step, 1);
            time += step;
        }
        ["shaft.y", "housing.y", "element[2].path", "element[9].force.outer"].map(|name| bearing.get(name))
    };
    let whole = end(&[0.009]);
    for steps in [&[1e-3][..], &[1e-5], &[3.3e-5, 1.7e-4, 2e-6]] {
        let split = end(steps);
        for (a, b) in whole.iter().zip(split) {
            // Errors of some hundred steps at 1e-9 add up.
            assert!((a - b).abs() < 1e-6 * a.abs(), "{steps:?}: {a} against {b}");
        }
    }
}
