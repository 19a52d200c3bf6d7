//! Topographies that balls at a contact angle meet beside the groove's bottom: slices across the groove against law
//! `love`, what they conserve, and what is refused.

use super::*;
use crate::support::energy::energy;
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{ContactLaw, Damping, Defect, DefectOn, DefectShape};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write;

/// Place (mm) of the track at 15° in an outer groove of a 6205, r_g α.
const TRACK: f64 = 4.1288 * 15.0 * PI / 180.0;

/// A topography with points 6 µm along and 50 µm across; arcs and places in mm, depths in µm.
fn text(arcs: f64, places: [f64; 2], depth: impl Fn(f64, f64) -> f64) -> String {
    let mut text = String::from("arc_mm,axial_mm,depth_um\n");
    let (long, wide) = ((arcs / 0.006).round() as i32, ((places[1] - places[0]) / 0.05).round() as i32);
    for (i, j) in (-long..=long).flat_map(|i| (0..=wide).map(move |j| (i, j))) {
        let (s, y) = (0.006 * f64::from(i), places[0] + 0.05 * f64::from(j));
        writeln!(text, "{s:.5},{y:.5},{:.6}", depth(s, y)).unwrap();
    }
    text
}

/// A smooth hump of height 1, `half` to either side.
fn hump(x: f64, half: f64) -> f64 {
    if x.abs() < half { (0.5 * PI * x / half).cos().powi(2) } else { 0.0 }
}

/// A pit 5 µm deep, 0.6 mm long and 1.6 mm wide, whose middle is 0.3 mm beside the track outside and inside.
fn pit(side: RacewaySide) -> String {
    let middle = if side == RacewaySide::Outer { TRACK + 0.3 } else { -TRACK - 0.3 };
    text(0.3, [middle - 1.6, middle + 1.6], |s, y| 5.0 * hump(s, 0.3) * hump(y - middle, 0.8))
}

/// The defect that a file describes, its middle below the bearing's and `off` (rad) ahead.
fn defect(on: DefectOn, off: f64) -> Defect {
    Defect { on, angle: off - FRAC_PI_2, shape: DefectShape::Profile("measured.csv".into()) }
}

/// A 6205 whose shaft is the host's, ball 1 below.
fn held(defect: Defect, law: ContactLaw) -> Scene {
    let scene = hosted_shaft(b6205_at_15_degrees(), DegreesOfFreedom::Five).cage(0.0, -FRAC_PI_2);
    scene.defect(defect).law(law).contact_cells([24, 16]).map_accuracy(0.02).largest_force(600.0).build().unwrap()
}

/// Started with the shaft pressed onto ball 1 and along its axis, and tilted (rad).
fn pressed(simulation: Simulation, tilt: f64) -> Simulation {
    started_with(simulation, &[("shaft.y", -3e-6), ("shaft.z", 95e-6), ("shaft.tilt.x", tilt)])
}

/// Force on ball 1 from a side and from the other, angles, force and moment on the shaft.
fn loaded(scene: Scene, text: &str, tilt: f64) -> Vec<f64> {
    tilted(Simulation::new(scene, [text]).unwrap(), tilt)
}

fn tilted(simulation: Simulation, tilt: f64) -> Vec<f64> {
    let mut simulation = pressed(simulation, tilt);
    let names = [
        "element[1].force.inner",
        "element[1].force.outer",
        "element[1].contact_angle.inner",
        "element[1].contact_angle.outer",
        "shaft.force.y",
        "shaft.force.z",
        "shaft.moment.x",
    ];
    values(&mut simulation, names).to_vec()
}

#[test]
fn what_does_not_vary_across_gives_what_the_line_spall_gives() {
    let depth = |s: f64| 5.0 * ((0.25 - s.abs()) / 0.08).clamp(0.0, 1.0);
    let wide = text(0.3, [-1.9, 3.9], |s, _| depth(s));
    let mut line = String::from("arc_mm,depth_um\n");
    (-50..=50).for_each(|i| writeln!(line, "{:.5},{:.6}", 0.006 * f64::from(i), depth(0.006 * f64::from(i))).unwrap());
    for law in [ContactLaw::Map, ContactLaw::Love] {
        let [topography, line] =
            [&wide, &line].map(|text| loaded(held(defect(DefectOn::Outer, 0.005), law), text, 2e-4));
        for (found, expected) in topography.into_iter().zip(line) {
            assert!((found / expected - 1.0).abs() < 0.01, "{law:?}: {found} {expected}");
        }
    }
}

#[test]
fn slices_give_the_forces_of_law_love_beside_the_track_outside() {
    slices_agree_with_law_love(DefectOn::Outer, RacewaySide::Outer);
}

#[test]
fn slices_give_the_forces_of_law_love_beside_the_track_inside() {
    slices_agree_with_law_love(DefectOn::Inner, RacewaySide::Inner);
}

fn slices_agree_with_law_love(on: DefectOn, side: RacewaySide) {
    let both = [ContactLaw::Map, ContactLaw::Love].map(|law| {
        let mut simulation = Simulation::new(held(defect(on, 0.004), law), [&*pit(side)]).unwrap();
        // Makes the model, which copies share.
        simulation.get("shaft.force.y").unwrap();
        simulation
    });
    for tilt in [-3e-4, 0.0, 3e-4] {
        let [map, love] = both.each_ref().map(|simulation| tilted(simulation.clone(), tilt));
        for (map, love) in map.into_iter().zip(love) {
            // Maps of 2e-2 of 600 N keep 1e-3 of it; the moment is what is left of larger ones.
            assert!((map / love - 1.0).abs() < 0.01, "{on:?} {tilt}: {map} {love}");
        }
    }
}

/// A 6205 in motion without damping, whose ball 1 runs over the pit.
fn undamped(law: ContactLaw) -> Scene {
    let mut shaft = Ring { damping: 0.0, ..Ring::default_shaft() };
    shaft.axial.damping = 0.0;
    let scene =
        free_shaft(b6205_at_15_degrees(), DegreesOfFreedom::Three).shaft_speed(TAU * 40.0).cage(0.0, -FRAC_PI_2 - 0.02);
    let scene = scene.shaft(shaft).shaft_load([0.0, -300.0]).axial_load(330.0).law(law).tolerance(1e-10);
    let scene = scene.damping(Damping::HuntCrossley(0.0)).defect(defect(DefectOn::Outer, 0.0));
    let mut scene = scene.contact_cells([24, 16]).map_accuracy(0.02).largest_force(600.0).build().unwrap();
    scene.contact.across_damping = Some(0.0);
    scene
}

#[test]
fn a_ball_over_a_pit_beside_its_track_conserves_energy() {
    let scene = undamped(ContactLaw::Map);
    let mut simulation = started_with(Simulation::new(scene.clone(), [&*pit(RacewaySide::Outer)]).unwrap(), &[]);
    let [first, _] = energy(&mut simulation, &scene);
    let (mut forces, mut angles) = ([f64::INFINITY, 0.0], [f64::INFINITY, 0.0]);
    let work = work_of_cage(&mut simulation, 800, |simulation| {
        let found = values(simulation, ["element[1].force.outer", "element[1].contact_angle.outer"]);
        for (range, value) in [&mut forces, &mut angles].into_iter().zip(found) {
            *range = [range[0].min(value), range[1].max(value)];
        }
    });
    let lost = energy(&mut simulation, &scene)[0] - first - work;
    // A contact of 200 N stores 0.3 mJ. What is left is Simpson's rule over steps of the map's curvature: it changes
    // sign with half the step, and stays with a tolerance of 1e-9 or 1e-11. The force across, some 10 N on a ball that
    // it moves by micrometres, does thousands of times as much work.
    assert!(lost.abs() < 3e-9, "{lost:e}");
    assert!(forces[0] < 0.7 * forces[1] && angles[1] - angles[0] > 5e-3, "{forces:?} {angles:?}");
}

#[test]
fn a_topography_that_does_not_reach_the_track_is_refused_with_both_places() {
    let narrow = text(0.3, [-0.5, 0.5], |s, y| 5.0 * hump(s, 0.3) * hump(y, 0.4));
    for law in [ContactLaw::Map, ContactLaw::Love] {
        let refused = Simulation::new(held(defect(DefectOn::Outer, 0.0), law), [&*narrow]).unwrap_err().to_string();
        assert!(refused.contains("from -0.5000 to 0.5000 mm") && refused.contains("1.0809 mm"), "{refused}");
        let inside = Simulation::new(held(defect(DefectOn::Inner, 0.0), law), [&*narrow]).unwrap_err().to_string();
        assert!(inside.contains("inner ring") && inside.contains("-1.0809 mm"), "{inside}");
    }
    let rigid = held(defect(DefectOn::Outer, 0.0), ContactLaw::Hertz);
    let refused = Simulation::new(rigid, [&*pit(RacewaySide::Outer)]).unwrap_err().to_string();
    assert!(refused.contains("use map or love for a topography"), "{refused}");
}

#[test]
fn a_topography_beside_the_track_is_refused_on_every_body_whatever_the_degrees_of_freedom() {
    let beside = text(0.1, [2.5, 3.5], |s, y| 5.0 * hump(s, 0.1) * hump(y - 3.0, 0.4));
    let across = text(0.1, [-0.5, 2.0], |s, y| 5.0 * hump(s, 0.1) * hump(y - 0.5, 0.4));
    for on in [DefectOn::Outer, DefectOn::Inner, DefectOn::Element { element: 0, tilt: 0.0 }] {
        for freedom in [DegreesOfFreedom::Two, DegreesOfFreedom::Three, DegreesOfFreedom::Five] {
            let mut scene = held(defect(on, 0.0), ContactLaw::Map);
            (scene.bearing.degrees_of_freedom, scene.bearing.operating_angle) = (freedom, Some(0.0));
            if freedom == DegreesOfFreedom::Two {
                (scene.bearing.contact_angle, scene.bearing.operating_angle) = (None, None);
            }
            let refused = Simulation::new(scene.clone(), [&*beside]).unwrap_err().to_string();
            assert!(refused.contains("from 2.5000 to 3.5000 mm") && refused.contains("run at 0.0000 mm"), "{refused}");
            assert!(Simulation::new(scene, [&*across]).is_ok(), "{on:?} {freedom:?}");
        }
    }
    // Rollers of 9 mm run on rows up to 4.5 mm beside their middle.
    let mut rollers = crate::support::shipped("nu205-healthy");
    (rollers.defects, rollers.contact.law) = (vec![defect(DefectOn::Outer, 0.0)], ContactLaw::Map);
    assert!(Simulation::new(rollers.clone(), [&*beside]).is_ok());
    let off = text(0.1, [5.0, 6.0], |s, y| 5.0 * hump(s, 0.1) * hump(y - 5.5, 0.4));
    let refused = Simulation::new(rollers, [&*off]).unwrap_err().to_string();
    assert!(refused.contains("run from -4.5000 to 4.5000 mm"), "{refused}");
}

#[test]
fn contacts_beside_the_slices_are_counted_and_only_such_scenes_have_the_counter() {
    let counted = |tilt: f64| {
        let scene = held(defect(DefectOn::Outer, 0.004), ContactLaw::Map);
        let mut simulation = pressed(Simulation::new(scene, [&*pit(RacewaySide::Outer)]).unwrap(), tilt);
        simulation.step(5e-5).unwrap();
        let mut count = [0];
        simulation.counts(&[simulation.reference("solver.off_track_contacts").unwrap()], &mut count).unwrap();
        (count[0], simulation.get("element[1].contact_angle.outer").unwrap())
    };
    // Slices reach 0.4 mm to either side; at 7.9 degrees the contact is half a millimetre beside the track.
    let [(none, near), (some, far)] = [counted(0.0), counted(2e-3)];
    assert!(none == 0 && near > 0.3, "{none} at {near}");
    assert!(some > 1 && far < 0.14, "{some} at {far}");
    let trace = "arc_mm,depth_um\n-0.3,0\n-0.294,1\n0.294,1\n0.3,0\n";
    let line = Simulation::new(held(defect(DefectOn::Outer, 0.0), ContactLaw::Map), [trace]).unwrap();
    assert!(line.reference("solver.off_track_contacts").is_err());
}
