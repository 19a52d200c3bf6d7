//! Derivatives of outputs where elements are in balance: by inputs against what a host finds by setting them, by time
//! against short steps, of the start against other starts.

use super::without_inertia;
use crate::support::differences::{by_input, by_time};
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

fn outputs(bearing: &Named) -> Vec<String> {
    let table = bearing.0.table().iter().filter(|variable| variable.causality == Causality::Output);
    table.map(|variable| variable.name.clone()).filter(|name| !name.contains("mean_force")).collect()
}

fn pressed(scene: Scene) -> Named {
    Named::started_with(scene, &[("shaft.y", -60e-6), ("shaft.x", 2e-6)])
}

#[test]
fn derivatives_by_inputs_are_what_setting_them_shows() {
    let mut bearing = pressed(hosted());
    bearing.run(1e-4, 3);
    bearing.set("shaft.vx", 1e-3);
    let names = outputs(&bearing);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut compared = 0;
    for (input, h) in [("shaft.x", 1e-10), ("shaft.y", 1e-10), ("shaft.vy", 1e-5), ("shaft.speed", 1e-4)] {
        for (slope, name) in by_input(&mut bearing.0, &names, input, h).iter().zip(&names) {
            // Truncation 1e-6 of either difference, rounding of the largest force over it.
            let limit = 1e-5 * slope.found.abs() + 1e-13 * slope.size.max(1e-9) / h;
            assert!(slope.miss() <= limit, "∂({name})/∂({input}): {slope:?}");
            compared += usize::from(slope.found != 0.0);
        }
    }
    assert!(compared > 60, "{compared}");
}

#[test]
fn derivatives_by_time_are_what_short_steps_show() {
    for scene in [hosted(), without_inertia(shipped("er16k-inner")), without_inertia(shipped("nu205-healthy"))] {
        let is_hosted = scene.shaft == Ring::hosted();
        let mut bearing = if is_hosted { pressed(scene) } else { Named::started(scene) };
        bearing.run(1e-3, 8);
        let names = outputs(&bearing);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let h = 5e-8;
        for (slope, name) in by_time(&mut bearing.0, &names, h).iter().zip(&names) {
            // Rounding of the sensor's spring of 9e9 N/m over 60 µm; third derivatives over these steps.
            let rounding = if name.contains("sensor") { 1e-9 } else { 1e-12 };
            let limit = 1e-4 * slope.found.abs() + rounding * slope.size.max(1e-6) / h + 1e-6;
            assert!(slope.miss() <= limit, "{name}: {slope:?}");
        }
    }
}

#[test]
fn derivatives_of_the_start_are_what_other_starts_show() {
    let mut bearing = Named::new(without_inertia(shipped("er16k-tb1")));
    let names = ["shaft.x", "shaft.y", "housing.y", "element[1].path", "element[3].force.outer", "shaft.force.y"];
    for (input, h) in [("shaft.load.y", 1e-3), ("shaft.load.x", 1e-3), ("shaft.speed", 1e-2)] {
        for (slope, name) in by_input(&mut bearing.0, &names, input, h).iter().zip(names) {
            // The equilibrium is found to 1e-12 of the largest force, 300 N.
            let rounding = if name.contains("force") { 1e-9 } else { 1e-17 };
            assert!(slope.miss() <= 1e-5 * slope.found.abs() + rounding / h, "∂({name})/∂({input}): {slope:?}");
        }
    }
}
