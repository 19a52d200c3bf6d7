//! The static equilibrium from which a run starts, where contacts are hard to balance.
#![allow(clippy::unwrap_used)]

use crate::support::{Named, shipped};
use brinell::scene::{Damping, DefectOn, Roller, RollerProfile, RollingElement, Scene};
use brinell::simulation::{Simulation, SimulationError};
use std::f64::consts::TAU;

/// A shipped scene with straight rollers, damped as whole bearings are where nothing else is known.
fn straight_rollers(name: &str, speed_hz: f64, cage_angle: f64) -> Scene {
    let mut scene = shipped(name);
    let profile = RollerProfile::Straight;
    scene.bearing.element =
        RollingElement::CylindricalRoller(Roller { length: 9e-3, profile, laminae: Roller::LAMINAE });
    scene.contact.damping = Damping::Proportional(1.25e-5);
    scene.shaft_speed = speed_hz * TAU;
    scene.cage.initial_angle = cage_angle;
    scene
}

fn started(scene: Scene) -> Result<Named, SimulationError> {
    let mut bearing = Simulation::new(scene, None).unwrap();
    bearing.initialize(0.0).map(|()| Named(bearing))
}

/// Starts a bearing and runs it for 2 ms. Gives what its contacts lack of the load at the start (N).
fn lacking(scene: Scene) -> Result<f64, SimulationError> {
    let load = scene.shaft.load;
    let mut bearing = started(scene)?;
    let lacking = [("shaft.force.x", load[0]), ("shaft.force.y", load[1])]
        .map(|(name, load)| (bearing.get(name) + load).abs())
        .into_iter()
        .fold(0.0, f64::max);
    bearing.run(1e-4, 20);
    Ok(lacking)
}

/// Cage angles at which these start not, or with less of the load than a path between two numbers can cost.
fn refused(scene: impl Fn(f64) -> Scene) -> Vec<String> {
    let angles = (0..24).map(|k| f64::from(k) * TAU / 24.0);
    let one = |angle: f64| {
        let scene = scene(angle);
        // Each roller that rests on the inner ring may lack its own weight.
        let weights = scene.bearing.element_count as f64 * scene.bearing.mass_of_element() * 9.81;
        match lacking(scene) {
            Ok(lacking) if lacking <= weights => None,
            Ok(lacking) => Some(format!("{angle:.3} rad: {lacking} N")),
            Err(error) => Some(format!("{angle:.3} rad: {error}")),
        }
    };
    angles.filter_map(one).collect()
}

#[test]
fn straight_rollers_that_rest_on_the_inner_ring_start_at_every_cage_angle() {
    // From 8.2 Hz on the centrifugal force holds all rollers on the outer raceway.
    for speed_hz in [0.5, 1.0, 2.0, 4.0, 6.0, 8.0] {
        let refused = refused(|angle| straight_rollers("nu205-healthy", speed_hz, angle));
        assert!(refused.is_empty(), "{speed_hz} Hz: {refused:#?}");
    }
}

#[test]
fn straight_rollers_start_beside_defects_of_every_body() {
    for on in [DefectOn::Outer, DefectOn::Inner, DefectOn::Element { element: 0, tilt: 0.0 }] {
        for speed_hz in [2.0, 25.0] {
            let scene = |angle| {
                let mut scene = straight_rollers("nu205-inner", speed_hz, angle);
                scene.defects[0].on = on;
                scene
            };
            let refused = refused(scene);
            assert!(refused.is_empty(), "{on:?}, {speed_hz} Hz: {refused:#?}");
        }
    }
}
