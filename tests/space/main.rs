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
#[path = "../support/mod.rs"]
mod support;
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

/// A 6205 with 8 µm of radial clearance that runs at 15°.
fn b6205_at_15_degrees() -> Bearing {
    Bearing { operating_angle: Some(15f64.to_radians()), ..b6205(8e-6) }
}

/// A bearing whose outer ring stands and whose inner ring is the host's.
fn hosted_shaft(bearing: Bearing, freedom: DegreesOfFreedom) -> SceneBuilder {
    free_shaft(bearing, freedom).shaft(Ring::hosted())
}

/// A bearing whose outer ring stands and whose inner ring is free.
fn free_shaft(bearing: Bearing, freedom: DegreesOfFreedom) -> SceneBuilder {
    Scene::builder(bearing).degrees_of_freedom(freedom).housing(Ring::fixed())
}

fn started(scene: Scene) -> Simulation {
    started_with(Simulation::new(scene, None).unwrap(), &[])
}

/// Started with variables set before.
fn started_with(mut simulation: Simulation, values: &[(&str, f64)]) -> Simulation {
    values.iter().for_each(|(name, value)| simulation.set(name, *value).unwrap());
    simulation.initialize(0.0).unwrap();
    simulation
}

/// One moves as the other seen in a mirror across the axis: signals, whether they turn their sign, and how far they may
/// be off.
fn are_mirror_images(
    one: &mut Simulation,
    other: &mut Simulation,
    signals: &[(&str, f64)],
    off: impl Fn(&str, f64) -> f64,
) {
    for (name, way) in signals {
        let (found, expected) = (one.get(name).unwrap(), way * other.get(name).unwrap());
        assert!((found - expected).abs() <= off(name, expected.abs()), "{name}: {found:e} {expected:e}");
    }
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
fn printed(found: &[f64], unit: f64, expected: &str) {
    printed_within(1.01, found, unit, expected);
}

/// The same to so many halves of the last digit.
fn printed_within(halves: f64, found: &[f64], unit: f64, expected: &str) {
    assert_eq!(found.len(), expected.split_whitespace().count());
    for (k, (&found, text)) in found.iter().zip(expected.split_whitespace()).enumerate() {
        let mantissa = text.split('e').next().unwrap();
        let decimals = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len()) as i32;
        let exponent: i32 = text.split_once('e').map_or(0, |(_, power)| power.parse().unwrap());
        let (value, half) = (text.parse::<f64>().unwrap(), 0.5 * 10f64.powi(exponent - decimals));
        assert!((found / unit - value).abs() <= halves * half, "number {k}: {:.12e}, not {text}", found / unit);
    }
}
