//! Derivatives against differences.

use super::*;
use crate::support::differences::{by_input, by_time};
use brinell::dynamics::contacts::{Forces, Shortcuts};
use brinell::dynamics::derivatives::Jacobian;
use brinell::scene::{ContactLaw, Damping, Defect, DefectOn, DefectShape, Sensor};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A bearing with both rings free, sensors along a slope and a spall under element 1, shortly after a step of its
/// loads.
fn moving(bearing: Bearing, sensors: usize, freedom: DegreesOfFreedom) -> Simulation {
    let mut sensor = Sensor::default();
    sensor.set_direction([0.6, 0.64, 0.48]);
    let scene = Scene::builder(bearing).degrees_of_freedom(freedom).shaft_speed(TAU * 60.0);
    let scene = scene.shaft_load([20.0, -200.0]).axial_load(400.0).cage(0.0, -0.5 * PI + 0.004);
    let scene = (0..sensors).fold(scene, |scene, _| scene.sensor(sensor.clone()));
    let scene = scene.spall(-0.5 * PI, 0.5e-3, 50e-6).law(ContactLaw::Hertz).damping(Damping::HuntCrossley(0.5));
    let mut scene = scene.build().unwrap();
    let tilts = freedom == DegreesOfFreedom::Five;
    if tilts {
        scene.shaft.tilt.load_moment = [0.3, 0.2];
    }
    let mut simulation = started(scene);
    simulation.set("shaft.load.z", 500.0).unwrap();
    if tilts {
        simulation.set("shaft.load_moment.x", -0.3).unwrap();
    }
    simulation.step(0.3e-3).unwrap();
    simulation
}

#[test]
fn the_jacobian_is_the_quotient_of_differences() {
    // With several sensors the linear system has another size.
    use DegreesOfFreedom::{Five, Three};
    for (bearing, sensors, freedom) in [(angular(25.0), 1, Five), (b6205(8e-6), 2, Five), (angular(25.0), 1, Three)] {
        let simulation = moving(bearing, sensors, freedom);
        let (model, mut excitation) = simulation.equations();
        excitation.load[0][2].0[1] = 1e4;
        let (state, cells, len) = (simulation.state_vector().to_vec(), simulation.cells().clone(), model.layout.len);
        let mut jacobian = Jacobian::new(model);
        model.linearize(&excitation, 0.0, &cells, &state, &mut jacobian, &mut Shortcuts::default());
        model.derivative_by_time(&excitation, 0.0, &cells, &state, &mut jacobian, &mut Shortcuts::default());
        let matrix = jacobian.matrix(len);
        let mut forces = Forces::of(model);
        let mut rate = |tau: f64, state: &[f64]| {
            let mut rate = vec![0.0; len];
            model.derivative(&excitation, tau, &cells, state, &mut rate, &mut forces);
            rate
        };
        let quotient = |of: &mut dyn FnMut(f64) -> Vec<f64>, h: f64| {
            let (a, b) = (of(h), of(-h));
            let (c, d) = (of(2.0 * h), of(-2.0 * h));
            (0..len).map(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h)).collect::<Vec<_>>()
        };
        for column in (0..len).filter(|&i| model.layout.is_used(i)) {
            // A thousandth of an approach of some micrometres, or of a velocity's effect.
            let h = if model.layout.is_position(column) { 1e-9 } else { 1e-4 };
            let found = quotient(
                &mut |by| {
                    let mut moved = state.clone();
                    moved[column] += by;
                    rate(0.0, &moved)
                },
                h,
            );
            let scale = (0..len).map(|row| matrix[row][column].abs()).fold(0.0, f64::max);
            for row in 0..len {
                let miss = (found[row] - matrix[row][column]).abs();
                let of = [row, column].map(|i| model.layout.name(i));
                assert!(miss <= 1e-6 * scale.max(1.0), "{of:?}: {:e} {:e}", matrix[row][column], found[row]);
            }
        }
        for shift in [1e2, 1e5, 1e9] {
            jacobian.factor(shift);
            let is_used = |i: &usize| model.layout.is_used(*i);
            let b: Vec<f64> = (0..len).map(|i| if is_used(&i) { (1.7 * i as f64).sin() } else { 0.0 }).collect();
            let mut x = b.clone();
            jacobian.solve(&mut x);
            for row in (0..len).filter(is_used) {
                let terms = |k: usize| (if k == row { shift } else { 0.0 } - matrix[row][k]) * x[k];
                let (sum, size) = (0..len).map(terms).fold((0.0, b[row].abs()), |(a, b), t| (a + t, b + t.abs()));
                // Rounding of the largest terms, and some growth in the elimination.
                assert!((sum - b[row]).abs() < 1e-12 * size, "{} at {shift}: {sum}", model.layout.name(row));
            }
        }
        let found = quotient(&mut |by| rate(by, &state), 1e-8);
        let scale = jacobian.by_time.iter().fold(0.0f64, |most, rate| most.max(rate.abs()));
        for row in 0..len {
            assert!((found[row] - jacobian.by_time[row]).abs() < 1e-6 * scale, "{}", model.layout.name(row));
        }
    }
}

/// Outputs that follow at once.
const OUTPUTS: [&str; 9] = [
    "shaft.force.z",
    "shaft.moment.x",
    "shaft.force.y",
    "housing.force.x",
    "housing.moment.y",
    "element[2].force.outer",
    "element[1].contact_angle.inner",
    "shaft.stiffness.yz",
    "shaft.stiffness.tilt_x_y",
];

#[test]
fn what_a_host_moves_changes_outputs_by_the_directional_derivative() {
    let scene = hosted_shaft(angular(25.0), DegreesOfFreedom::Five).housing(Ring::hosted());
    let scene = scene.shaft_speed(TAU * 60.0).law(ContactLaw::Hertz);
    let mut simulation = Simulation::new(scene.build().unwrap(), None).unwrap();
    let inputs = [
        ("shaft.x", 2e-6, 1e-9),
        ("shaft.z", 14e-6, 1e-9),
        ("shaft.tilt.x", 1e-4, 1e-7),
        ("shaft.tilt.vy", 1e-2, 1e-4),
        ("housing.tilt.y", -1e-4, 1e-7),
        ("housing.vz", 1e-3, 1e-5),
        ("shaft.speed", TAU * 60.0, 1e-2),
    ];
    for (name, value, _) in inputs {
        simulation.set(name, value).unwrap();
    }
    for started in [false, true] {
        if started {
            simulation.initialize(0.0).unwrap();
            simulation.step(1e-4).unwrap();
        }
        for (input, _, h) in inputs {
            for (slope, output) in by_input(&mut simulation, &OUTPUTS, input, h).iter().zip(OUTPUTS) {
                // Second order of the step, and roundings of the values over it.
                let limit = 1e-4 * slope.largest() + 1e-10 * slope.size / h;
                assert!(slope.miss() <= limit, "{started} {output} by {input}: {slope:?}");
            }
        }
    }
}

#[test]
fn loads_move_the_balance_by_the_directional_derivative() {
    let scene = free_shaft(b6205(8e-6), DegreesOfFreedom::Five).shaft_load([0.0, -250.0]).axial_load(350.0);
    let scene = scene.shaft_speed(TAU * 40.0).cage(0.0, -1.3).law(ContactLaw::Hertz);
    loads_move_the_balance(scene.clone().build().unwrap());
    // On a flank of the inner ring the way that a ball goes round with the cage closes its contact, the faster the
    // farther out it is.
    let shape = DefectShape::Spall { length: 0.5e-3, depth: 50e-6, edge_slope: FRAC_PI_2 };
    let scene = scene.defect(Defect { on: DefectOn::Inner, angle: -1.31, shape }).shaft_speed(TAU * 400.0);
    loads_move_the_balance(scene.damping(Damping::HuntCrossley(0.5)).build().unwrap());
}

fn loads_move_the_balance(scene: Scene) {
    let mut simulation = Simulation::new(scene, None).unwrap();
    let names = ["shaft.y", "shaft.z", "shaft.tilt.x", "element[2].path", "element[2].axial", "element[2].force.inner"];
    for (input, value, h) in
        [("shaft.load.z", 350.0, 1e-2), ("shaft.load_moment.y", 0.1, 1e-4), ("shaft.load.x", 0.0, 1e-2)]
    {
        simulation.set(input, value).unwrap();
        for (slope, name) in by_input(&mut simulation, &names, input, h).iter().zip(names) {
            let limit = 1e-5 * slope.found.abs() + 1e-11 * slope.size / h;
            assert!(slope.miss() <= limit, "{name} by {input}: {slope:?}");
        }
    }
}

#[test]
fn outputs_change_by_time_as_their_derivatives_say() {
    let mut simulation = moving(angular(25.0), 1, DegreesOfFreedom::Five);
    let names = ["shaft.force.z", "shaft.moment.y", "shaft.az", "element[2].axial", "element[2].contact_angle.outer"];
    let h = 2e-8;
    for (slope, name) in by_time(&mut simulation, &names, h).iter().zip(names) {
        let limit = 2e-3 * slope.largest() + 1e-9 * slope.size / h;
        assert!(slope.miss() <= limit, "{name}: {slope:?}");
    }
}
