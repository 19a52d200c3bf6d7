//! What is compared: the oracle's signals under the names of the variables.

use crate::bearing::Bearing;
use crate::case::{Case, Motion};
use crate::instant::{Acting, ELEMENTS, Outside};
use std::f64::consts::TAU;

/// What a signal is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Force,
    Length,
    Velocity,
    /// Of the shaft, the housing, the sensor.
    Acceleration(usize),
    Angle,
    Torque,
}

/// Names of the signals that are compared, as the variables are called.
pub fn signals(case: &Case) -> Vec<(String, Kind)> {
    let mut found = Vec::new();
    let mut pair = |name: &str, kind: Kind| {
        found.extend(["x", "y"].map(|axis| (name.replace('*', axis), kind)));
    };
    for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
        pair(&format!("{name}.force.*"), Kind::Force);
        match case.rings[which].motion {
            Motion::Internal => {
                pair(&format!("{name}.*"), Kind::Length);
                pair(&format!("{name}.v*"), Kind::Velocity);
                pair(&format!("{name}.a*"), Kind::Acceleration(which));
            }
            Motion::Host => pair(&format!("{name}.mean_force.*"), Kind::Force),
            Motion::Fixed => {}
        }
    }
    if case.marks_inner_ring() {
        found.push(("shaft.angle".to_owned(), Kind::Angle));
        found.push(("shaft.torque".to_owned(), Kind::Torque));
    }
    if case.housing_hz.is_some() {
        found.push(("housing.angle".to_owned(), Kind::Angle));
    }
    for element in case.defective_elements() {
        found.push((format!("element[{}].spin_angle", element + 1), Kind::Angle));
    }
    if case.sensor.is_some() {
        found.push(("sensor.acceleration".to_owned(), Kind::Acceleration(2)));
    }
    found.push(("cage.angle".to_owned(), Kind::Angle));
    found.push(("cage.torque".to_owned(), Kind::Torque));
    for j in 1..=case.count {
        found.push((format!("element[{j}].path"), Kind::Length));
        found.push((format!("element[{j}].force.inner"), Kind::Force));
        found.push((format!("element[{j}].force.outer"), Kind::Force));
    }
    found
}

/// The signals of a run as it is, after a communication step of this length, in the order of [`signals`].
pub(crate) fn values(bearing: &Bearing, y: &[f64], outside: &Outside, acting: &Acting, length: f64) -> Vec<f64> {
    let mut found = Vec::new();
    let impulses = &y[ELEMENTS + 2 * bearing.count..][..4];
    for which in 0..2 {
        found.extend(acting.rings[which]);
        match bearing.rings[which].motion {
            Motion::Internal => {
                found.extend(&y[4 * which..4 * which + 4]);
                found.extend(acting.accelerations[which]);
            }
            Motion::Host if length == 0.0 => found.extend(acting.rings[which]),
            Motion::Host => found.extend([0, 1].map(|a| impulses[2 * which + a] / length)),
            Motion::Fixed => {}
        }
    }
    let [cage, shaft, housing, spin] = outside.turns.map(|turn| turn[0]);
    if bearing.inner_marked {
        found.extend([shaft, acting.shaft_torque]);
    }
    if bearing.turns {
        found.push(housing);
    }
    for (j, own) in bearing.surfaces.own.iter().enumerate() {
        if let Some([_, outside]) = own {
            found.push(outside.centre + spin - (cage + TAU * j as f64 / bearing.count as f64));
        }
    }
    if bearing.sensor.is_some() {
        found.push(acting.measured);
    }
    found.extend([cage, acting.torque]);
    for j in 0..bearing.count {
        let [inner, outer] = acting.contacts[j];
        found.extend([y[ELEMENTS + 2 * j], inner.force, outer.force]);
    }
    found
}
