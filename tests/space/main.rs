//! Rings with three and five degrees of freedom against figures of an independent reference: in balance, in motion, and
//! against laws.
#![allow(clippy::unwrap_used)]

mod arrangements;
mod balance;
mod coupling;
mod defects;
mod derivatives;
mod laws;
mod motion;
mod standards;
mod statics;
mod topographies;

use brinell::scene::{Bearing, DegreesOfFreedom, Ring, Scene, SceneBuilder};
use brinell::simulation::Simulation;

/// A 6205 with a radial clearance (m).
fn b6205(clearance: f64) -> Bearing {
    Bearing { radial_clearance: clearance, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) }
}

/// The angular contact bearing of twelve balls, with a free contact angle (degrees).
fn angular(degrees: f64) -> Bearing {
    let mut bearing = Bearing {
        conformity_inner: 0.515,
        conformity_outer: 0.525,
        element_mass: Some(2.0427e-3),
        ..Bearing::steel_balls(12, 7.938e-3, 38.5e-3)
    };
    bearing.set_contact_angle(degrees.to_radians());
    bearing
}

/// A bearing whose outer ring stands and whose inner ring is free.
fn free_shaft(bearing: Bearing, freedom: DegreesOfFreedom) -> SceneBuilder {
    Scene::builder(bearing).degrees_of_freedom(freedom).housing(Ring::fixed())
}

fn started(scene: Scene) -> Simulation {
    let mut simulation = Simulation::new(scene, None).unwrap();
    simulation.initialize(0.0).unwrap();
    simulation
}

/// What the cage does (J) on the elements in so many steps of a microsecond, after each of which it is looked at.
///
/// By Simpson's rule over half microseconds: the fastest vibration turns by 0.2 rad in one.
fn work_of_cage(simulation: &mut Simulation, count: usize, mut look: impl FnMut(&mut Simulation)) -> f64 {
    let h = 0.5e-6;
    let power = |simulation: &mut Simulation| {
        let [torque, speed] = values(simulation, ["cage.torque", "cage.speed"]);
        torque * speed
    };
    let (mut work, mut before) = (0.0, power(simulation));
    for _ in 0..count {
        simulation.step(h).unwrap();
        let middle = power(simulation);
        simulation.step(h).unwrap();
        let after = power(simulation);
        // The cage's torque is that of the elements on it.
        work -= (before + 4.0 * middle + after) * h / 3.0;
        before = after;
        look(simulation);
    }
    work
}

/// Values of some variables.
fn values<const N: usize>(simulation: &mut Simulation, names: [&str; N]) -> [f64; N] {
    names.map(|name| simulation.get(name).unwrap_or_else(|error| panic!("{name}: {error}")))
}

/// Compares values with printed ones times `unit`, each to half of its last digit.
fn printed(found: &[f64], unit: f64, expected: &[&str]) {
    assert_eq!(found.len(), expected.len());
    for (k, (&found, text)) in found.iter().zip(expected).enumerate() {
        let mantissa = text.split('e').next().unwrap();
        let decimals = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len()) as i32;
        let exponent: i32 = text.split_once('e').map_or(0, |(_, power)| power.parse().unwrap());
        let (value, half) = (text.parse::<f64>().unwrap(), 0.5 * 10f64.powi(exponent - decimals));
        assert!((found / unit - value).abs() <= 1.01 * half, "number {k}: {:.12e}, not {text}", found / unit);
    }
}
