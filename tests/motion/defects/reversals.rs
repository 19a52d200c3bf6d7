//! The cage turns back inside a communication step: elements must be where they would be had the host taken many small
//! ones.

use crate::support::defects::short_spall;
use crate::support::{Named, shipped};
use brinell::contact::rolled_path::RigidPath;
use brinell::contact::rolling::Rolling;
use brinell::scene::{ContactLaw, Defect, DefectShape, Ring, Scene};
use brinell::surface::Profile;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Two rings that nothing moves and nine elements pressed between them by 25 µm, so that each is in contact all the
/// time; free ones bounce, and two such runs can be compared for a few strikes only.
fn pressed(law: ContactLaw, shape: DefectShape) -> Scene {
    let mut scene = shipped("er16k-tb1");
    let fixed = Ring::fixed();
    (scene.shaft, scene.housing, scene.sensors) = (fixed, fixed, Vec::new());
    scene.bearing.radial_clearance = -25e-6;
    // 1258 N on the smooth raceway; entering and leaving the defect add to it.
    scene.contact.largest_force = Some(4000.0);
    (scene.contact.law, scene.tolerance) = (law, 1e-9);
    scene.defects = vec![Defect::outer(-FRAC_PI_2, shape)];
    scene
}

/// A motion of the cage: angle of element 1 from the defect's centre at the start (rad), speed (rad/s) and acceleration
/// (rad/s²) of the cage, duration (s).
#[derive(Debug, Clone, Copy)]
struct Swing {
    angle: f64,
    speed: f64,
    acceleration: f64,
    time: f64,
}

impl Swing {
    /// From `angle` to `turn` and back to `angle` (rad), turning in the middle.
    fn there_and_back(angle: f64, turn: f64, time: f64) -> Self {
        let speed = 4.0 * (turn - angle) / time;
        Self { angle, speed, acceleration: -2.0 * speed / time, time }
    }
}

/// Path (m) and outer force (N) of every element after the swing, taken in `count` communication steps.
fn after(swing: Swing, count: u32, scene: &Scene) -> Vec<[f64; 2]> {
    let mut scene = scene.clone();
    scene.cage.initial_angle = -FRAC_PI_2 + swing.angle;
    let mut bearing = Named::started(scene);
    let cage_ratio = bearing.get("cage.speed") / bearing.get("shaft.speed");
    let (step, speed) = (swing.time / f64::from(count), bearing.reference("shaft.speed"));
    for i in 0..count {
        let now = swing.speed + swing.acceleration * f64::from(i) * step;
        bearing.set("shaft.speed", now / cage_ratio);
        bearing.0.set_input_derivatives(&[speed], &[1], &[swing.acceleration / cage_ratio]).unwrap();
        bearing.run(step, 1);
    }
    let elements = 1..=9;
    elements.map(|j| ["path", "force.outer"].map(|what| bearing.get(&format!("element[{j}].{what}")))).collect()
}

/// One communication step against `count`. Returns the force on element 1.
fn compare(swing: Swing, count: u32, scene: &Scene) -> f64 {
    let (one, many) = (after(swing, 1, scene), after(swing, count, scene));
    for (j, (one, many)) in one.iter().zip(&many).enumerate() {
        let what = format!("{swing:?}, element {}: {one:?} in one step, {many:?} in {count}", j + 1);
        // Each run's steps err by 1e-9 of an approach of 15 µm, and some thousands of them meet in an oscillation that
        // is damped over a hundred. A wrong cell is off by micrometres.
        assert!((one[0] - many[0]).abs() < 1e-10 && (one[1] - many[1]).abs() < 0.02, "{what}");
    }
    one[0][1]
}

/// Half the angle of the spall of `er16k-tb1` (rad).
const HALF: f64 = 7.9 * PI / 180.0;

/// The spall of `er16k-tb1` with another depth (m).
fn line_spall(depth: f64) -> DefectShape {
    DefectShape::Spall { length: 6.517e-3, depth, edge_slope: FRAC_PI_2 }
}

#[test]
fn an_element_that_enters_a_deep_spall_and_turns_back_is_on_the_smooth_raceway_again() {
    let scene = pressed(ContactLaw::Hertz, line_spall(100e-6));
    for (angle, turn, time) in [(-HALF - 0.03, -HALF + 0.01, 0.02), (HALF + 0.03, HALF - 0.08, 0.03)] {
        let force = compare(Swing::there_and_back(angle, turn, time), 400, &scene);
        assert!(force > 1200.0, "{force}");
    }
}

#[test]
fn an_element_that_leaves_a_deep_spall_and_turns_back_hangs_on_its_edge_again() {
    let scene = pressed(ContactLaw::Hertz, line_spall(100e-6));
    let force = compare(Swing::there_and_back(HALF - 0.015, HALF + 0.03, 0.02), 400, &scene);
    // Of 1258 N on the smooth raceway and none over the floor.
    assert!((100.0..1000.0).contains(&force), "{force}");
}

#[test]
fn one_step_of_a_slow_swing_over_a_spall_is_forty_small_ones() {
    // 20 degrees there and back.
    let scene = pressed(ContactLaw::Hertz, line_spall(4e-6));
    for angle in [-HALF - 0.09, -HALF - 0.03, HALF - 0.09] {
        for time in [0.2, 0.4] {
            compare(Swing::there_and_back(angle, angle + PI / 9.0, time), 40, &scene);
        }
    }
}

#[test]
fn an_element_that_turns_on_a_knot_stays_on_either_side_of_it() {
    let scene = pressed(ContactLaw::Hertz, line_spall(4e-6));
    let knots = knots(&scene);
    for &knot in &knots {
        for away in [-0.02, 0.02] {
            for miss in [0.0, 1e-17, -1e-17, 1e-13, -1e-13, 1e-9, -1e-9] {
                compare(Swing::there_and_back(knot + away, knot + miss, 2e-3), 7, &scene);
            }
        }
    }
}

/// Knots of law `hertz` (rad) from the defect's centre.
fn knots(scene: &Scene) -> Vec<f64> {
    let DefectShape::Spall { length, depth, edge_slope } = scene.defects[0].shape else { panic!() };
    let profile = Profile::spall(length, depth, edge_slope);
    let bearing = &scene.bearing;
    let (element, raceway) = (bearing.element_radius(), bearing.outer_raceway_radius());
    RigidPath::new(profile.points(), Rolling::outer_ring(element, raceway)).unwrap().knots().to_vec()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn any_swing_is_the_same_in_one_step_and_in_many(
        angle in -0.3..0.3f64,
        turn in -0.3..0.3f64,
        // 1: back to the start. The turn may also come early or late, or after the end.
        share in prop_oneof![Just(1.0), 0.3..3.0f64],
        time in 1e-3..8e-3f64,
        count in 2..40u32,
    ) {
        let mut swing = Swing::there_and_back(angle, turn, time);
        swing.time *= share;
        compare(swing, count, &pressed(ContactLaw::Hertz, line_spall(4e-6)));
    }
}

#[test]
fn swings_over_a_map_are_the_same_in_one_step_and_in_many() {
    let scene = pressed(ContactLaw::Map, short_spall());
    for turn in [-0.012, -0.005, 0.0, 0.004, 0.02] {
        for time in [1e-3, 4e-3] {
            compare(Swing::there_and_back(-0.025, turn, time), 30, &scene);
            compare(Swing::there_and_back(0.001, turn, time), 30, &scene);
        }
    }
}

#[test]
fn a_swing_over_a_grid_is_the_same_in_one_step_and_in_many() {
    let mut scene = pressed(ContactLaw::Love, short_spall());
    // Each contact is solved anew; a coarse grid turns back as a fine one does.
    (scene.contact.cells, scene.tolerance) = (Some([24, 8]), 1e-7);
    // From the spall out to the smooth raceway, which no grid is solved for, and back.
    for (angle, turn) in [(0.001, 0.06), (-0.002, -0.05), (0.0, 0.07)] {
        for time in [2e-4, 2.9e-4] {
            compare(Swing::there_and_back(angle, turn, time), 5, &scene);
        }
    }
}
