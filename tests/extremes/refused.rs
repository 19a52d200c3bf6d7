//! Extremes that no simulation can answer: a clear error, and no number.

use crate::row::Row;
use crate::scenes::{BALLS, Kind, loaded, without_inertia};
use crate::support::defects::{short_spall, spall};
use crate::support::{Named, shipped};
use brinell::geometry::hertz_constant::HertzConstants;
use brinell::scene::{ContactLaw, Damping, Defect, Motion, Scene};
use brinell::simulation::{Method, Simulation, SimulationError};
use std::f64::consts::FRAC_PI_2;

/// A run that must not go on.
pub fn refused(what: &'static str, wanted: &str, found: Result<(), SimulationError>, bearing: &Named) -> Row {
    let message = found.expect_err(what).to_string();
    assert!(message.contains(wanted), "{what}: {message}");
    Row::new(what, "a clear error", message, bearing)
}

pub fn step_budget(kind: Kind) -> Row {
    let mut scene = loaded(kind.healthy(), 5e4, Damping::HuntCrossley(5.0));
    scene.max_steps = 1000;
    let mut bearing = Named::started(scene);
    bearing.0.set_method(Method::DormandPrince);
    let found = bearing.0.step(0.01);
    refused("50 kN, χ = 5 s/m, explicit only, solver.max_steps = 1000", "solver.max_steps", found, &bearing)
}

pub fn thrown_out(kind: Kind) -> Row {
    let mut scene = kind.hosted();
    scene.contact.damping = Damping::HuntCrossley(0.0);
    // A hard inner ring, whose energy drives the element out through a soft outer one; rollers have one law inside and
    // outside, and a soft seat of the outer ring.
    if kind.is_rollers() {
        scene.bearing.outer_compliance = 1e-8;
    } else {
        scene.bearing.hertz_inner = Some(10.0 * HertzConstants::of(&scene.bearing).inner);
    }
    let mut bearing = Named::started(scene);
    bearing.set("shaft.x", kind.pick(3.9e-3, 3.6e-3));
    let found = bearing.0.step(0.1);
    let what = kind.pick(
        "host moves the inner ring by 3.9 mm, no damping",
        "host moves the inner ring by 3.6 mm, soft seat outside, no damping",
    );
    refused(what, "has left the bearing", found, &bearing)
}

pub fn rings_apart(kind: Kind) -> Row {
    moved_apart("host moves the inner ring by 10 mm", kind.hosted())
}

pub fn rings_apart_without_inertia(kind: Kind) -> Row {
    moved_apart("the same, elements without inertia", without_inertia(kind.hosted()))
}

fn moved_apart(what: &'static str, scene: Scene) -> Row {
    let mut bearing = Named::started(scene);
    // As far as the variable allows: through the outer ring.
    bearing.set("shaft.x", 0.01);
    let found = bearing.0.step(0.1);
    refused(what, "offset of the rings", found, &bearing)
}

pub fn not_finite(kind: Kind) -> Row {
    let mut bearing = Named::started(kind.hosted());
    let reference = bearing.reference("shaft.x");
    bearing.0.set_input_derivatives(&[reference], &[2], &[1e300]).unwrap();
    let found = bearing.0.step(1e-3);
    refused("host accelerates the inner ring by 1e300 m/s²", "offset of the rings", found, &bearing)
}

pub fn too_deep(kind: Kind) -> Row {
    let bearing = Named::new(kind.healthy());
    let scene = Scene { defects: vec![Defect::outer(-FRAC_PI_2, spall(3e-3, 5e-3))], ..kind.spalled() };
    let found = Simulation::new(scene, None).map(|_| ());
    refused("spall 5 mm deep, deeper than an element's radius", "depth", found, &bearing)
}

/// A bearing whose element 1 stands over a short spall, under law `map` up to 1 kN.
fn mapped(kind: Kind) -> Scene {
    let mut scene = kind.spalled();
    (scene.contact.law, scene.contact.largest_force) = (ContactLaw::Map, Some(1000.0));
    scene.defects = vec![Defect::outer(-FRAC_PI_2, short_spall())];
    scene.cage.initial_angle = -FRAC_PI_2;
    scene
}

/// A contact near the defect that has no answer gives an approach that is NaN; the step must fail, and not take
/// it for no contact.
pub fn contact_without_answer(kind: Kind) -> Row {
    let mut scene = mapped(kind);
    // Element 1 enters within a millisecond, under a load that the map was not made for.
    scene.cage.initial_angle = -FRAC_PI_2 - 1e-3 / scene.bearing.outer_raceway_radius();
    let mut bearing = Named::started(loaded(scene, 500.0, Damping::HuntCrossley(0.5)));
    bearing.set("shaft.load.y", -2e4);
    let found = (0..100).try_for_each(|_| bearing.0.step(1e-4));
    let message = found.clone().expect_err("beyond the map").to_string();
    let named = ["element 1, -", "degrees from the defect's centre", "contact.largest_force_n = "];
    assert!(named.iter().all(|part| message.contains(part)) && !message.contains("NaN"), "{message}");
    refused("a contact on the defect's edge beyond its map", "limit of the contact map", found, &bearing)
}

/// The same, of elements that are there before the first step.
#[test]
fn an_equilibrium_beyond_the_contact_map_is_refused() {
    let scene = mapped(BALLS);
    let loaded = loaded(scene, 500.0, Damping::HuntCrossley(0.5));
    let mut hosted = loaded.clone();
    (hosted.shaft.motion, hosted.shaft.load) = (Motion::Host, [0.0; 2]);
    for (scene, name, value) in [(loaded, "shaft.load.y", -2e4), (hosted, "shaft.y", -1e-4)] {
        let mut bearing = Named::new(scene);
        bearing.set(name, value);
        let message = bearing.0.initialize(0.0).unwrap_err().to_string();
        let named = ["element 1, ", "finds no balance", "equivalent approach in the contact map", "largest_force_n"];
        assert!(named.iter().all(|part| message.contains(part)) && !message.contains("NaN"), "{name}: {message}");
    }
}

/// What runs away is named with its last value, and not what follows from it.
#[test]
fn a_ring_driven_beyond_all_numbers_is_named_with_its_last_position() {
    // Near a defect under law `map`, where the contacts are NaN then.
    let scene = Scene { shaft_speed: 0.0, ..mapped(BALLS) };
    let error = |motion: Motion, name: &str, order: i32, value: f64| {
        let mut scene = scene.clone();
        scene.shaft.motion = motion;
        if motion == Motion::Host {
            scene.shaft.load = [0.0; 2];
        }
        let mut bearing = Named::started(scene);
        let reference = bearing.reference(name);
        bearing.0.set_input_derivatives(&[reference], &[order], &[value]).unwrap();
        bearing.0.step(1e-3).unwrap_err().to_string()
    };
    let cases = [
        (error(Motion::Host, "shaft.x", 2, 1e300), "e269, 0.000e0) m, housing at ("),
        (error(Motion::Internal, "shaft.load.y", 1, 1e300), "shaft.vy leaves all bounds 0.000000e0 s"),
    ];
    for (message, wanted) in cases {
        assert!(message.contains(wanted) && !message.contains("NaN"), "{wanted}: {message}");
    }
}

#[test]
fn a_cage_that_turns_too_fast_for_time_to_pass_between_edges_fails_at_once() {
    let mut simulation = Simulation::new(shipped("er16k-tb1"), None).unwrap();
    simulation.initialize(0.0).unwrap();
    let speed = simulation.reference("shaft.speed").unwrap();
    // No host can set such a speed; a state in bytes can hold it. Marks are put in its place and looked for.
    simulation.set_reals(&[speed], &[12.3456]).unwrap();
    simulation.set_input_derivatives(&[speed], &[1], &[6.54321]).unwrap();
    let mut bytes = simulation.save().to_bytes();
    for (mark, value) in [(12.3456_f64, 1e200_f64), (6.54321, 1.0)] {
        let offsets: Vec<usize> = (0..bytes.len() - 7).filter(|&i| bytes[i..i + 8] == mark.to_le_bytes()).collect();
        assert_eq!(offsets.len(), 1);
        bytes[offsets[0]..offsets[0] + 8].copy_from_slice(&value.to_le_bytes());
    }
    let state = simulation.state_from_bytes(&bytes).unwrap();
    simulation.restore(&state).unwrap();
    // Without a limit this step would never end: passages at one instant are no integration steps.
    let message = simulation.step(1e-5).unwrap_err().to_string();
    assert!(message.contains("turns too fast"), "{message}");
}
