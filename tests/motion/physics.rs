//! The model against laws: balance, symmetry, conservation, and what a step may not do.

use crate::counting;
use crate::support::{Named, shipped};
use brinell::scene::{Damping, Motion, Scene};
use brinell::simulation::Method;
use proptest::prelude::*;

fn without_damping(mut scene: Scene) -> Scene {
    scene.contact.damping = Damping::HuntCrossley(0.0);
    (scene.shaft.damping, scene.housing.damping) = (0.0, 0.0);
    scene
}

fn steady_housing(mut scene: Scene) -> Scene {
    scene.housing = brinell::scene::Ring::fixed();
    scene.sensors.clear();
    scene
}

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
    let mut bearing = Named::started(shipped("6205-healthy"));
    let (mut sum, z) = ([0.0; 2], 9);
    let shaft = [bearing.get("shaft.x"), bearing.get("shaft.y")];
    let housing = [bearing.get("housing.x"), bearing.get("housing.y")];
    let scene = shipped("6205-healthy");
    let radius = scene.bearing.outer_raceway_radius() - scene.bearing.element_radius();
    for j in 1..=z {
        let angle = bearing.get(&format!("element[{j}].angle"));
        let rho = radius + bearing.get(&format!("element[{j}].path"));
        let q = [housing[0] + rho * angle.cos() - shaft[0], housing[1] + rho * angle.sin() - shaft[1]];
        let force = bearing.get(&format!("element[{j}].force.inner"));
        let length = q[0].hypot(q[1]);
        (sum[0], sum[1]) = (sum[0] - force * q[0] / length, sum[1] - force * q[1] / length);
    }
    let load = scene.shaft.load;
    assert!((sum[0] + load[0]).abs() < 1e-9 * load[1].abs() && (sum[1] + load[1]).abs() < 1e-9 * load[1].abs());
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

/// Total energy of a bearing that stands: rings, radial motion of elements, contacts, supports, load and gravity.
fn energy(bearing: &mut Named, scene: &Scene) -> f64 {
    let hertz = brinell::geometry::hertz_constant::HertzConstants::of(&scene.bearing);
    let radius = scene.bearing.outer_raceway_radius() - scene.bearing.element_radius();
    let mass = scene.bearing.mass_of_element();
    let mut energy = 0.0;
    for (name, ring) in [("shaft", scene.shaft), ("housing", scene.housing)] {
        if ring.motion != Motion::Internal {
            continue;
        }
        for (axis, letter) in ["x", "y"].iter().enumerate() {
            let (x, v) = (bearing.get(&format!("{name}.{letter}")), bearing.get(&format!("{name}.v{letter}")));
            energy += 0.5 * ring.mass * v * v + 0.5 * ring.stiffness * x * x - ring.load[axis] * x;
        }
    }
    let state = bearing.0.state_vector().to_vec();
    let z = scene.bearing.element_count;
    for j in 1..=z {
        // Potential of a contact: ∫ K δ^1.5 dδ = ⅖ Q δ, and δ = (Q/K)^⅔.
        for (side, k) in [("inner", hertz.inner), ("outer", hertz.outer)] {
            let force = bearing.get(&format!("element[{j}].force.{side}"));
            energy += 0.4 * force * (force / k).powf(2.0 / 3.0);
        }
        let angle = bearing.get(&format!("element[{j}].angle"));
        let u = bearing.get(&format!("element[{j}].path"));
        let along = scene.gravity[0] * angle.cos() + scene.gravity[1] * angle.sin();
        energy += 0.5 * mass * state[z.next_multiple_of(8) + j - 1] * state[z.next_multiple_of(8) + j - 1]
            - mass * along * (radius + u);
    }
    energy
}

#[test]
fn without_damping_and_speed_energy_is_conserved() {
    let mut scene = without_damping(steady_housing(shipped("6205-healthy")));
    scene.shaft_speed = 0.0;
    scene.tolerance = 1e-12;
    let mut bearing = Named::started(scene.clone());
    let before = energy(&mut bearing, &scene);
    // A load that jumps sets the ring and the elements in motion, through loss and gain of contacts.
    bearing.set("shaft.load.y", 0.3 * scene.shaft.load[1]);
    bearing.set("shaft.load.x", 200.0);
    scene.shaft.load = [200.0, 0.3 * scene.shaft.load[1]];
    let start = energy(&mut bearing, &scene);
    assert!(start != before);
    let mut stored: f64 = 0.0;
    let mut drift: f64 = 0.0;
    let at_rest = energy_of_equilibrium(&scene);
    for _ in 0..100 {
        bearing.run(1e-3, 1);
        let now = energy(&mut bearing, &scene);
        drift = drift.max((now - start).abs());
        stored = stored.max((start - at_rest).abs());
    }
    // Relative to the energy that is exchanged between motion and contacts; the demand of the time integration.
    assert!(drift < 1e-10 * stored, "energy drifts by {drift:e} J of {stored:e} J");
}

fn energy_of_equilibrium(scene: &Scene) -> f64 {
    energy(&mut Named::started(scene.clone()), scene)
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
    let mut inside = Named::started(shipped("er16k-tb1"));
    let mut scene = shipped("er16k-tb1");
    for ring in [&mut scene.shaft, &mut scene.housing] {
        *ring = brinell::scene::Ring::hosted();
    }
    scene.sensors.clear();
    let mut hosted = Named::new(scene);
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

#[test]
fn a_saved_state_continues_with_the_same_bits() {
    let mut bearing = Named::started(shipped("er16k-tb1"));
    let names = ["shaft.y", "housing.ay", "element[1].path", "element[1].force.outer", "cage.angle"];
    bearing.run(1e-4, 30);
    for _ in 0..100 {
        let state = bearing.0.save();
        bearing.run(7.7e-5, 2);
        let first = names.map(|name| bearing.get(name).to_bits());
        bearing.0.restore(&state).unwrap();
        bearing.run(7.7e-5, 2);
        assert_eq!(first, names.map(|name| bearing.get(name).to_bits()));
    }
}
