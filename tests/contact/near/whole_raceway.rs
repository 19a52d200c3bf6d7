//! Defects that go round almost the whole raceway: the ridge that is left carries what the same ridge does in the
//! middle of a profile, or the defect is refused.

use crate::support::{Named, shipped};
use brinell::contact::error::ContactError;
use brinell::contact::rolled_path::RigidPath;
use brinell::contact::rolling::Rolling;
use brinell::scene::{ContactLaw, Defect, DefectShape, Motion, Scene};
use brinell::simulation::{Simulation, SimulationError};
use std::f64::consts::{FRAC_PI_2, TAU};

const DEPTH: f64 = 100e-6;

/// One element that stands at −90°, under a shaft that is pressed 30 µm down on it.
fn standing(law: ContactLaw, shape: DefectShape, angle: f64) -> Scene {
    let mut scene = shipped("er16k-tb1");
    (scene.contact.law, scene.contact.largest_force) = (law, Some(1500.0));
    scene.defects = vec![Defect::outer(angle, shape)];
    (scene.bearing.element_count, scene.cage.initial_angle, scene.shaft_speed) = (1, -FRAC_PI_2, 0.0);
    (scene.shaft.motion, scene.shaft.load, scene.housing.motion) = (Motion::Host, [0.0; 2], Motion::Fixed);
    scene.sensors.clear();
    scene
}

fn force(scene: Scene, profile: Option<&str>) -> Result<f64, SimulationError> {
    let mut bearing = Named(Simulation::new(scene, profile)?);
    bearing.set("shaft.y", -30e-6);
    bearing.0.initialize(0.0)?;
    Ok(bearing.get("element[1].force.outer"))
}

fn circumference() -> f64 {
    TAU * shipped("er16k-tb1").bearing.outer_raceway_radius()
}

/// Force on the middle of a ridge that a spall of this length leaves on the other side of the ring.
fn on_the_rest(law: ContactLaw, length: f64) -> Result<f64, SimulationError> {
    force(standing(law, DefectShape::Spall { length, depth: DEPTH, edge_slope: FRAC_PI_2 }, FRAC_PI_2), None)
}

/// The same on a ridge in the middle of a defect of 8 mm.
fn on_a_ridge(law: ContactLaw, ridge: f64) -> f64 {
    let (half, side, run) = (4.0, 0.5 * ridge * 1e3, 1e-6);
    let right = [(side, 0.0), (side + run, DEPTH * 1e6), (half - run, DEPTH * 1e6), (half, 0.0)];
    let points = right.iter().rev().map(|&(s, d)| (-s, d)).chain(right);
    let text: String = points.map(|(s, d)| format!("{s:.9},{d:.9}\n")).collect();
    let scene = standing(law, DefectShape::Profile("ridge.csv".into()), -FRAC_PI_2);
    force(scene, Some(&format!("arc_mm,depth_um\n{text}"))).unwrap()
}

/// The longest spall that is taken, from the refusal of a longer one (m).
fn limit(law: ContactLaw) -> f64 {
    let length = 359.9 / 360.0 * circumference();
    match on_the_rest(law, length) {
        Err(SimulationError::Contact(ContactError::EndsMeet {
            length_mm,
            limit_mm,
            reach_mm,
            circumference_mm,
            ..
        })) => {
            assert!((length_mm - length * 1e3).abs() < 1e-9 && (circumference_mm - circumference() * 1e3).abs() < 1e-9);
            // 1e-6: knots of less than 1e-8 rad between them are one.
            assert!((limit_mm + 2.0 * reach_mm - circumference_mm).abs() < 1e-6, "{limit_mm}, {reach_mm}");
            limit_mm * 1e-3
        }
        other => panic!("{law:?}: {other:?}"),
    }
}

#[test]
fn a_spall_that_leaves_less_than_a_contact_is_refused_and_a_shorter_one_is_exact() {
    // Cells are as long as fits a whole number into the length, and a contact's reach is counted in cells: by less than
    // 1e-6.
    let longest = limit(ContactLaw::Love);
    assert!(on_the_rest(ContactLaw::Love, longest * (1.0 + 1e-6)).is_err());
    let rest = on_the_rest(ContactLaw::Love, longest * (1.0 - 1e-6)).unwrap();
    let ridge = on_a_ridge(ContactLaw::Love, circumference() - longest);
    // Cells lie otherwise on the two ridges: the grid's own ripple.
    assert!((rest / ridge - 1.0).abs() < 1e-4, "{rest} N on the rest, {ridge} N on a ridge");
    // The map is made on the same stretches.
    assert_eq!(limit(ContactLaw::Map), longest);
    let message = on_the_rest(ContactLaw::Map, longest * 1.001).unwrap_err().to_string();
    assert!(message.contains("mm long, it must be below") && message.contains("contact.largest_force_n"), "{message}");
}

#[test]
fn a_rigid_element_on_a_narrow_rest_feels_it_as_any_ridge() {
    let rest = on_the_rest(ContactLaw::Hertz, 359.9 / 360.0 * circumference()).unwrap();
    let ridge = on_a_ridge(ContactLaw::Hertz, 0.1 / 360.0 * circumference());
    // Both are Hertz's contact on the smooth raceway; positions are rounded otherwise.
    assert!((rest / ridge - 1.0).abs() < 1e-9, "{rest} N on the rest, {ridge} N on a ridge");
}

#[test]
fn raised_rims_that_lift_an_element_at_both_ends_at_once_are_refused() {
    let (element, radius) = (3.97e-3, circumference() / TAU);
    let rimmed = |share: f64| {
        let half = 0.5 * share * circumference();
        let points = [(-half, 0.0), (-half + 1e-4, -2e-6), (half - 1e-4, -2e-6), (half, 0.0)];
        RigidPath::new(&points, Rolling::outer_ring(element, radius))
    };
    // 2 µm lift an element over 0.14 mm on either side.
    let message = rimmed(0.999).unwrap_err().to_string();
    assert!(message.contains("it must be below") && message.contains("raised rims"), "{message}");
    assert!(rimmed(0.99).is_ok());
}
