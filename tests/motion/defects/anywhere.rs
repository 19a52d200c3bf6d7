//! Defects of the inner raceway and of rolling elements, and outer rings that turn: closed forms, symmetries, energy.

use crate::support::defects::{PAST_INNER, SPIN, cells_kept, element, inner, mapped, spall};
use crate::support::energy::exchanged_and_lost;
use crate::support::{Named, map_of, turned, turned_vector};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{Damping, Defect, DefectOn, Ring, Scene};
use brinell_analysis::statics::StaticBearing;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

#[test]
fn frequencies_of_the_elements_spin_are_those_of_pure_rolling() {
    for (mut scene, expected) in [(inner(), -PAST_INNER), (element(0.4e-3), -SPIN)] {
        // All in contact, so that the rings' swing leaves the rate alone.
        scene.bearing.radial_clearance = -5e-6;
        let mut bearing = Named::started(scene.clone());
        let angle = |bearing: &mut Named| match scene.defects[0].on {
            DefectOn::Inner => bearing.get("element[1].angle") - bearing.get("shaft.angle"),
            _ => bearing.get("element[1].spin_angle"),
        };
        let start = angle(&mut bearing);
        bearing.run(1e-4, 50);
        let speed = (angle(&mut bearing) - start) / 5e-3;
        // Printed digits.
        assert!((speed - expected).abs() < 1e-4, "{speed}, not {expected}");
    }
}

#[test]
fn an_element_is_over_an_inner_spall_as_long_as_its_length_over_its_speed() {
    let mut bearing = Named::started(inner());
    let course = bearing.course(["shaft.torque", "element[1].force.inner"], 2e-6, 6000);
    let is_inside = |(k, &[torque, force]): (usize, &[f64; 2])| (torque != 0.0 || force == 0.0).then_some(k as f64);
    let inside: Vec<f64> = course.iter().enumerate().filter_map(is_inside).map(|k| 2e-6 * k).collect();
    let (first, last) = (inside[0], inside[inside.len() - 1]);
    // Entry after 5 ms, except for the inner ring's swing: 10 µm are 17 µs.
    assert!((first - 5e-3).abs() < 60e-6, "enters after {first} s");
    let passage = 10f64.to_radians() / PAST_INNER;
    assert!((last - first - passage).abs() < 40e-6, "{} s over it, {passage} s by kinematics", last - first);
}

#[test]
fn an_elements_spall_meets_the_raceways_half_a_turn_of_its_spin_apart() {
    let mut bearing = Named::started(element(0.4e-3));
    let course = bearing.course(["element[1].force.outer", "element[1].force.inner"], 5e-6, 6000);
    let least = [(0, 600..1400), (1, 4800..5600)].map(|(side, window)| {
        let at = window.min_by(|&a, &b| course[a][side].total_cmp(&course[b][side])).unwrap();
        (course[at][side], (at + 1) as f64 * 5e-6)
    });
    let [(outer, first), (inner, second)] = least;
    assert!((first - 5e-3).abs() < 20e-6, "deepest on the outer raceway after {first} s");
    assert!((second - first - PI / SPIN).abs() < 60e-6, "{} s apart, not {}", second - first, PI / SPIN);
    // Bridged, not left, on both raceways.
    assert!(outer > 20.0 && inner > 20.0, "{outer} N, {inner} N");
}

/// Position of the shaft and the elements' paths over some milliseconds.
fn course(scene: Scene, step: f64, count: usize) -> Vec<[f64; 11]> {
    let paths: Vec<String> = (1..=9).map(|j| format!("element[{j}].path")).collect();
    let names =
        std::array::from_fn(|k| ["shaft.x", "shaft.y"].get(k).copied().unwrap_or_else(|| paths[k - 2].as_str()));
    Named::started(scene).course(names, step, count)
}

#[test]
fn turning_the_whole_scene_turns_the_result() {
    for scene in [inner(), element(0.4e-3)] {
        let by = 1.234;
        let other = turned(&scene, by);
        for (a, b) in course(scene, 1e-4, 120).iter().zip(course(other, 1e-4, 120)) {
            let [x, y] = turned_vector([a[0], a[1]], by);
            let off = (x - b[0]).abs().max((y - b[1]).abs());
            let paths = a[2..].iter().zip(&b[2..]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // The tolerance of the integration times approaches of some micrometres.
            assert!(off < 1e-13 && paths < 1e-12, "{off:e} {paths:e}");
        }
    }
}

#[test]
fn a_mirror_mirrors_the_result() {
    for (scene, on_element) in [(inner(), false), (element(0.4e-3), true)] {
        let mut other = scene.clone();
        other.shaft_speed = -scene.shaft_speed;
        other.cage.initial_angle = PI - scene.cage.initial_angle;
        let defect = &mut other.defects[0];
        defect.angle = if on_element { -defect.angle } else { PI - defect.angle };
        let z = scene.bearing.element_count;
        for (a, b) in course(scene, 1e-4, 120).iter().zip(course(other, 1e-4, 120)) {
            assert!((a[0] + b[0]).abs() < 1e-13 && (a[1] - b[1]).abs() < 1e-13, "{a:?} {b:?}");
            for j in 0..z {
                let off = (a[2 + j] - b[2 + (z - j) % z]).abs();
                assert!(off < 1e-12, "element {}: {off:e} m", j + 1);
            }
        }
    }
}

#[test]
fn a_state_put_back_continues_with_the_same_bits() {
    for (scene, at) in [(inner(), 52), (element(1.2e-3), 49)] {
        let [mut bearing, mut other] = [scene.clone(), scene].map(Named::started);
        bearing.run(1e-4, at);
        for _ in 0..40 {
            let names = ["shaft.x", "shaft.y", "element[1].path", "cage.torque"];
            bearing.goes_on_alike(&mut other, names, 1e-4, 1);
        }
    }
}

#[test]
fn energy_goes_nowhere_but_into_the_forced_motions_under_law_map() {
    for (scene, from) in [(inner(), 4.7e-3), (element(1.2e-3), 3.6e-3)] {
        let mut scene = mapped(scene);
        (scene.contact.damping, scene.shaft.damping) = (Damping::HuntCrossley(0.0), 0.0);
        let mut bearing = Named::started(scene.clone());
        bearing.run(1e-4, (from / 1e-4) as usize);
        let [moved, drift] = exchanged_and_lost(&mut bearing, &scene, 1e-6, 1500);
        // Trapezoids of 1 µs over forces that swing in some 10 µs; the exchange is what makes the figure say something.
        assert!(moved > 1e-5 && drift < 2e-4 * moved, "{drift:e} J of {moved:e} J are lost");
    }
}

#[test]
fn a_balance_is_found_with_elements_anywhere_over_an_inner_defect() {
    let scene = mapped(inner());
    let map = map_of(&scene, None);
    let bearing = StaticBearing::with_map(&scene, None, map.as_deref()).unwrap();
    let smooth = StaticBearing::new(&Scene { defects: Vec::new(), ..scene }, None).unwrap();
    let (mut least, mut whole) = (f64::INFINITY, f64::INFINITY);
    for k in 0..=80 {
        let cage = (-130.0 + f64::from(k)).to_radians();
        let stiffness = |bearing: &StaticBearing| bearing.balance(cage, bearing.load()).unwrap().stiffness[1][1];
        (least, whole) = (least.min(stiffness(&bearing)), whole.min(stiffness(&smooth)));
    }
    // One element less carries when the spall is under the load.
    assert!(least < 0.9 * whole && least > 0.3 * whole, "{least} N/m, {whole} N/m without the spall");
}

#[test]
fn turning_the_frame_changes_nothing_but_centrifugal_forces() {
    // The inner ring turns in a ring that stands, or the outer one turns the other way about one that does not; the
    // host holds the inner ring eccentric, and turns it about with the frame.
    let mut scene = inner();
    scene.gravity = [0.0; 2];
    scene.shaft = Ring::hosted();
    // Bridged: a ball that flew free would go where centrifugal forces take it.
    scene.defects = vec![Defect::outer(-FRAC_PI_2, spall(0.6e-3, 100e-6))];
    scene.cage.initial_angle = -97f64.to_radians();
    let mut other = scene.clone();
    (other.housing_speed, other.shaft_speed) = (Some(-scene.shaft_speed), 0.0);
    let (mut still, mut turning) = (Named::new(scene.clone()), Named::new(other));
    let [inputs, about] = [&still, &turning]
        .map(|bearing| ["x", "y", "vx", "vy", "ax", "ay"].map(|name| bearing.reference(&format!("shaft.{name}"))));
    let (step, speed, eccentric) = (2e-5, -scene.shaft_speed, 14e-6);
    let motion = |time: f64| {
        let (sin, cos) = (speed * time - FRAC_PI_2).sin_cos();
        let (v, a) = (eccentric * speed, eccentric * speed * speed);
        [eccentric * cos, eccentric * sin, -v * sin, v * cos, -a * cos, -a * sin]
    };
    still.0.set_reals(&inputs, &[0.0, -eccentric, 0.0, 0.0, 0.0, 0.0]).unwrap();
    turning.0.set_reals(&about, &motion(0.0)).unwrap();
    for bearing in [&mut still, &mut turning] {
        bearing.0.initialize(0.0).unwrap();
    }
    let mut largest = 0.0f64;
    for k in 0..500 {
        turning.0.set_reals(&about, &motion(f64::from(k) * step)).unwrap();
        still.0.step(step).unwrap();
        turning.0.step(step).unwrap();
        for j in 1..=9 {
            let name = format!("element[{j}].force.outer");
            let (a, b) = (still.get(&name), turning.get(&name));
            largest = largest.max(a);
            // m ρ ω² is 0.03 N at the cage's speed and 0.06 N at the other.
            assert!((a - b).abs() < 0.2, "{name} is {a} N and {b} N after {} s", f64::from(k + 1) * step);
        }
    }
    assert!(largest > 100.0, "{largest} N");
    assert!((turning.get("housing.angle") - speed * 500.0 * step).abs() < 1e-12);
}

#[test]
fn contacts_meet_the_cells_in_which_their_angles_are() {
    for scene in [inner(), element(1.2e-3)] {
        let [inside, differ] = cells_kept(scene);
        // On a knot itself rounding decides.
        assert!(inside > 20 && differ <= 1, "{inside} {differ}");
    }
}

#[test]
fn radii_and_lengths_are_those_of_the_body_that_bears_the_defect() {
    let scene = inner();
    let bearing = &scene.bearing;
    assert_eq!(DefectOn::Inner.radius(bearing), RacewaySide::Inner.radius(bearing));
    let tilted = DefectOn::Element { element: 0, tilt: 0.1 };
    // A chord 2 r sin λ off the middle of a pit.
    let expected = (1e-3f64.powi(2) - (2.0 * bearing.element_radius() * 0.1f64.sin()).powi(2)).sqrt();
    assert!((tilted.met_length(1e-3, bearing) - expected).abs() < 1e-15);
    assert!(TAU * bearing.inner_raceway_radius() * 0.9 == DefectOn::Inner.longest(bearing).size);
}
