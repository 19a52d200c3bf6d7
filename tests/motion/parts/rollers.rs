//! Cylindrical rollers in motion: closed forms at the extremes, energy, both methods, defects of every body.

use crate::support::energy::pushed;
use crate::support::{Named, furthest, shipped, straight};
use brinell::geometry::line_contact::line_constant;
use brinell::scene::{Bearing, ContactLaw, Damping, DefectOn, Ring, Scene};
use brinell::simulation::Method;
use std::f64::consts::FRAC_PI_2;

fn healthy() -> Scene {
    shipped("nu205-healthy")
}

/// The rings held by the host, straight rollers.
fn hosted() -> Scene {
    let mut scene = Scene { shaft: Ring::hosted(), housing: Ring::hosted(), sensors: Vec::new(), ..healthy() };
    scene.bearing.element = straight(9e-3);
    scene
}

#[test]
fn a_preload_presses_each_roller_with_half_of_it_in_each_contact() {
    let mut scene = hosted();
    (scene.bearing.radial_clearance, scene.gravity, scene.shaft_speed) = (-5e-6, [0.0; 2], 0.0);
    let expected = line_constant(9e-3) * 2.5e-6f64.powf(10.0 / 9.0);
    let mut bearing = Named::started(scene);
    bearing.run(1e-3, 20);
    let got = bearing.all(["element[5].force.inner", "element[5].force.outer"]);
    // The tolerance of 1e-5 of the approach, with the power 10/9.
    assert!(got.iter().all(|got| (got / expected - 1.0).abs() < 1.2e-5), "{got:?} {expected}");
}

#[test]
fn a_load_that_jumps_settles_in_the_static_balance() {
    // Without clearance, with preload, and with a hundred rollers.
    let hundred = Bearing { radial_clearance: 0.0, ..Bearing::steel_rollers(100, 1.1e-3, 2e-3, 39e-3) };
    let cases = [
        ("no clearance", Bearing { radial_clearance: 0.0, ..healthy().bearing }, Damping::HuntCrossley(0.5)),
        ("preload", Bearing { radial_clearance: -2e-6, ..healthy().bearing }, Damping::HuntCrossley(5.0)),
        ("yielding seat", Bearing { outer_compliance: 2e-9, ..healthy().bearing }, Damping::Proportional(1e-5)),
        ("a hundred rollers", hundred, Damping::Proportional(1e-5)),
    ];
    for (what, bearing, damping) in cases {
        let count = bearing.element_count;
        let mut scene = Scene { bearing, shaft_speed: 0.0, sensors: Vec::new(), ..healthy() };
        // At the default of 1e-5 rollers, as balls, go on vibrating by up to 7e-4 of the force.
        (scene.contact.damping, scene.tolerance) = (damping, 1e-7);
        let load = scene.shaft.load[1];
        let mut at_rest = Named::started(scene.clone());
        scene.shaft.load[1] = 0.2 * load;
        let mut bearing = Named::started(scene);
        bearing.set("shaft.load.y", load);
        // Rings' vibrations decay with 2m/c = 5 and 6 ms: e^-25 after 150 ms.
        bearing.run(1e-3, 150);
        let largest = |b: &mut Named| b.inner_forces(count).into_iter().fold(0.0, f64::max);
        let expected = largest(&mut at_rest);
        // Rollers that gravity alone holds go on bouncing, by which the force swings by up to 1.4e-3: its mean over 20
        // ms.
        let samples: Vec<f64> = (0..400)
            .map(|_| {
                bearing.run(5e-5, 1);
                largest(&mut bearing)
            })
            .collect();
        let got = samples.iter().sum::<f64>() / 400.0;
        assert!((got / expected - 1.0).abs() < 2e-5, "{what}: {got} N, in static equilibrium {expected} N");
        // Gravity on the rollers aside, the contacts carry the load.
        let force = at_rest.get("shaft.force.y");
        assert!((force + load).abs() < 1e-9 * load.abs(), "{what}: {force}");
    }
}

#[test]
fn a_crowned_roller_without_damping_keeps_its_energy() {
    let mut scene = hosted();
    scene.bearing.element = healthy().bearing.element;
    (scene.bearing.radial_clearance, scene.gravity, scene.shaft_speed) = (-10e-6, [0.0; 2], 0.0);
    scene.contact.damping = Damping::HuntCrossley(0.0);
    scene.tolerance = 1e-7;
    let mut bearing = Named::started(scene.clone());
    // Element 1 is under −y: the ring that moves down at once presses it.
    let [rest, start, _, drift] = pushed(&mut bearing, &scene, ("shaft.y", -3e-6));
    // Some 400 periods at a tolerance of 1e-7 of the approach.
    let share = drift / (start - rest).abs();
    assert!(start > 1.05 * rest && share < 1e-3, "{share}: {rest} {start}");
}

#[test]
fn both_methods_agree_on_a_spall_under_rollers() {
    let run = |method: Method, tolerance: f64| {
        let mut bearing = Named::started(Scene { tolerance, ..shipped("nu205-inner") });
        bearing.0.set_method(method);
        bearing.course(["shaft.force.y", "element[1].force.inner"], 1e-4, 60)
    };
    let (found, expected) = (run(Method::Automatic, 1e-6), run(Method::Rodas, 1e-7));
    let worst = furthest(found.as_flattened(), expected.as_flattened());
    // Of 1500 N, through entry, flight and strike; the spall empties the roller under the load.
    assert!(worst < 1.5, "{worst} N");
    let of_element: Vec<f64> = found.iter().map(|[_, force]| *force).collect();
    assert!(of_element[..18].iter().all(|&force| force > 500.0), "{of_element:?}");
    assert!(of_element.contains(&0.0), "{of_element:?}");
}

#[test]
fn a_defect_of_any_body_unloads_rollers_and_turns_with_its_body() {
    for on in [DefectOn::Outer, DefectOn::Inner, DefectOn::Element { element: 0, tilt: 0.0 }] {
        let mut scene = shipped("nu205-inner");
        scene.defects[0].on = on;
        // Into the load zone: on an element it faces the outer raceway after a millisecond.
        scene.defects[0].angle = match on {
            DefectOn::Outer => -FRAC_PI_2 + 0.05,
            DefectOn::Inner => scene.defects[0].angle,
            DefectOn::Element { .. } => 0.4,
        };
        let mut bearing = Named::started(scene);
        let forces = bearing.course(["element[1].force.outer"], 1e-5, 400);
        let (start, least) = (forces[0][0], forces.as_flattened().iter().copied().fold(f64::INFINITY, f64::min));
        assert!(start > 600.0 && least < 5.0, "{on:?}: {start} N at the start, least {least} N");
    }
}

#[test]
fn map_and_grid_give_a_roller_the_same_way_into_a_spall() {
    let [map, love, path] = [ContactLaw::Map, ContactLaw::Love, ContactLaw::Hertz].map(|law| {
        let mut scene = shipped("nu205-inner");
        (scene.contact.law, scene.contact.cells) = (law, Some([32, 8]));
        scene.contact.largest_force = Some(1200.0);
        Named::started(scene).course(["element[1].force.inner"], 1e-4, 30)
    });
    let largest = |a: &[[f64; 1]], b: &[[f64; 1]]| furthest(a.as_flattened(), b.as_flattened());
    // Of 758 N at the start, until 3 ms, on the edge and beyond.
    assert!(largest(&map, &love) < 1.0, "{} N", largest(&map, &love));
    // The path of a rigid roller is another law: it lets the roller go later and at once.
    assert!(largest(&path, &love) > 30.0);
}
