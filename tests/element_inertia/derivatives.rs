//! Derivatives of outputs where elements are in balance: by inputs against what a host finds by setting them, by time
//! against short steps, of the start against other starts.

use super::without_inertia;
use crate::support::{Named, shipped};
use brinell::scene::{Ring, Scene};
use brinell::simulation::interface::table::Causality;

/// The line spall, its shaft moved by a host, elements over the spall.
fn hosted() -> Scene {
    let mut scene = without_inertia(shipped("er16k-tb1"));
    scene.shaft = Ring::hosted();
    scene.cage.initial_angle = -1.62;
    scene
}

fn outputs(bearing: &Named) -> Vec<(String, u32)> {
    let table = bearing.0.table().iter().filter(|variable| variable.causality == Causality::Output);
    table.map(|variable| (variable.name.clone(), variable.reference)).collect()
}

fn pressed(scene: Scene) -> Named {
    let mut bearing = Named::new(scene);
    bearing.set("shaft.y", -60e-6);
    bearing.set("shaft.x", 2e-6);
    bearing
}

fn values(bearing: &mut Named, references: &[u32]) -> Vec<f64> {
    let mut values = vec![0.0; references.len()];
    bearing.0.reals(references, &mut values).unwrap();
    values
}

/// Derivatives by an input as given, and the values with that input `h` below and above what it is.
struct Sides {
    given: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
}

fn either_side(bearing: &mut Named, references: &[u32], input: &str, h: f64) -> Sides {
    let known = bearing.reference(input);
    let mut given = vec![0.0; references.len()];
    bearing.0.directional_derivative(references, &[known], &[1.0], &mut given).unwrap();
    let start = bearing.get(input);
    let mut at = |value: f64| {
        bearing.set(input, value);
        values(bearing, references)
    };
    let (before, after) = (at(start - h), at(start + h));
    bearing.set(input, start);
    Sides { given, before, after }
}

#[test]
fn derivatives_by_inputs_are_what_setting_them_shows() {
    let mut bearing = pressed(hosted());
    bearing.0.initialize(0.0).unwrap();
    bearing.run(1e-4, 3);
    bearing.set("shaft.vx", 1e-3);
    let (names, references): (Vec<_>, Vec<_>) = outputs(&bearing).into_iter().unzip();
    let mut compared = 0;
    for (input, h) in [("shaft.x", 1e-10), ("shaft.y", 1e-10), ("shaft.vy", 1e-5), ("shaft.speed", 1e-4)] {
        let Sides { given, before, after } = either_side(&mut bearing, &references, input, h);
        for (i, name) in names.iter().enumerate() {
            if name.contains("mean_force") {
                continue;
            }
            let found = (after[i] - before[i]) / (2.0 * h);
            // Truncation 1e-6 of either difference, rounding of the largest force over it.
            let limit = 1e-5 * found.abs() + 1e-13 * before[i].abs().max(1e-9) / h;
            assert!((given[i] - found).abs() <= limit, "∂({name})/∂({input}) = {}, found {found}", given[i]);
            compared += usize::from(found != 0.0);
        }
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn derivatives_by_time_are_what_short_steps_show() {
    for scene in [hosted(), without_inertia(shipped("er16k-inner")), without_inertia(shipped("nu205-healthy"))] {
        let is_hosted = scene.shaft == Ring::hosted();
        let mut bearing = if is_hosted { pressed(scene) } else { Named::new(scene) };
        bearing.0.initialize(0.0).unwrap();
        bearing.run(1e-3, 8);
        let (names, references): (Vec<_>, Vec<_>) = outputs(&bearing).into_iter().unzip();
        let mut given = vec![0.0; references.len()];
        bearing.0.output_derivatives(&references, &vec![1; references.len()], &mut given).unwrap();
        let state = bearing.0.save();
        let mut at = |h: f64| {
            bearing.0.restore(&state).unwrap();
            if h > 0.0 {
                bearing.0.step(h).unwrap();
            }
            values(&mut bearing, &references)
        };
        let h = 5e-8;
        let (before, near, far) = (at(0.0), at(h), at(2.0 * h));
        for (i, name) in names.iter().enumerate().filter(|(_, name)| !name.contains("mean_force")) {
            let found = (4.0 * near[i] - far[i] - 3.0 * before[i]) / (2.0 * h);
            // Rounding of the sensor's spring of 9e9 N/m over 60 µm; third derivatives over these steps.
            let rounding = if name.contains("sensor") { 1e-9 } else { 1e-12 };
            let limit = 1e-4 * found.abs() + rounding * before[i].abs().max(1e-6) / h + 1e-6;
            assert!((given[i] - found).abs() <= limit, "{name} changes by {} /s, found {found}", given[i]);
        }
    }
}

#[test]
fn derivatives_of_the_start_are_what_other_starts_show() {
    let mut bearing = Named::new(without_inertia(shipped("er16k-tb1")));
    let names = ["shaft.x", "shaft.y", "housing.y", "element[1].path", "element[3].force.outer", "shaft.force.y"];
    let references: Vec<u32> = names.iter().map(|name| bearing.reference(name)).collect();
    for (input, h) in [("shaft.load.y", 1e-3), ("shaft.load.x", 1e-3), ("shaft.speed", 1e-2)] {
        let Sides { given, before, after } = either_side(&mut bearing, &references, input, h);
        for (i, name) in names.iter().enumerate() {
            let found = (after[i] - before[i]) / (2.0 * h);
            // The equilibrium is found to 1e-12 of the largest force, 300 N.
            let rounding = if name.contains("force") { 1e-9 } else { 1e-17 };
            let limit = 1e-5 * found.abs() + rounding / h;
            assert!((given[i] - found).abs() <= limit, "∂({name})/∂({input}) = {:e}, found {found:e}", given[i]);
        }
    }
}
