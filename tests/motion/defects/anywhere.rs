//! Defects of the inner raceway and of rolling elements, and outer rings that turn: closed forms, symmetries, energy.

use crate::support::defects::{PAST_INNER, SPIN, cells_kept, element, inner, spall};
use crate::support::energy::exchanged_and_lost;
use crate::support::{Named, map_of};
use brinell::contact::rolling::RacewaySide;
use brinell::scene::{ContactLaw, Damping, Defect, DefectOn, Ring, Scene};
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
    let step = 2e-6;
    let mut inside = Vec::new();
    for k in 0..6000 {
        bearing.0.step(step).unwrap();
        if bearing.get("shaft.torque") != 0.0 || bearing.get("element[1].force.inner") == 0.0 {
            inside.push(f64::from(k) * step);
        }
    }
    let (first, last) = (inside[0], inside[inside.len() - 1]);
    // Entry after 5 ms, except for the inner ring's swing: 10 µm are 17 µs.
    assert!((first - 5e-3).abs() < 60e-6, "enters after {first} s");
    let passage = 10f64.to_radians() / PAST_INNER;
    assert!((last - first - passage).abs() < 40e-6, "{} s over it, {passage} s by kinematics", last - first);
}

#[test]
fn an_elements_spall_meets_the_raceways_half_a_turn_of_its_spin_apart() {
    let mut bearing = Named::started(element(0.4e-3));
    let step = 5e-6;
    let mut least = [(f64::INFINITY, 0.0); 2];
    for k in 0..6000 {
        bearing.0.step(step).unwrap();
        for (least, side) in least.iter_mut().zip(["outer", "inner"]) {
            let force = bearing.get(&format!("element[1].force.{side}"));
            let time = f64::from(k + 1) * step;
            let window = if side == "outer" { 3e-3..7e-3 } else { 24e-3..28e-3 };
            if window.contains(&time) && force < least.0 {
                *least = (force, time);
            }
        }
    }
    let [(outer, first), (inner, second)] = least;
    assert!((first - 5e-3).abs() < 20e-6, "deepest on the outer raceway after {first} s");
    assert!((second - first - PI / SPIN).abs() < 60e-6, "{} s apart, not {}", second - first, PI / SPIN);
    // Bridged, not left, on both raceways.
    assert!(outer > 20.0 && inner > 20.0, "{outer} N, {inner} N");
}

/// Position of the shaft and the elements' paths and inner forces over some milliseconds.
fn course(scene: Scene, step: f64, count: usize) -> Vec<Vec<f64>> {
    let z = scene.bearing.element_count;
    let mut bearing = Named::started(scene);
    let mut all = Vec::new();
    for _ in 0..count {
        bearing.0.step(step).unwrap();
        let mut row = vec![bearing.get("shaft.x"), bearing.get("shaft.y")];
        row.extend((1..=z).map(|j| bearing.get(&format!("element[{j}].path"))));
        all.push(row);
    }
    all
}

#[test]
fn turning_the_whole_scene_turns_the_result() {
    for scene in [inner(), element(0.4e-3)] {
        let by = 1.234f64;
        let (sin, cos) = by.sin_cos();
        let turned = |v: [f64; 2]| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]];
        let mut other = scene.clone();
        (other.gravity, other.shaft.load) = (turned(scene.gravity), turned(scene.shaft.load));
        other.cage.initial_angle += by;
        // The angle on an element is counted from the element's own direction.
        if scene.defects[0].on == DefectOn::Inner {
            other.shaft_initial_angle += by;
        }
        for (a, b) in course(scene, 1e-4, 120).iter().zip(course(other, 1e-4, 120)) {
            let [x, y] = turned([a[0], a[1]]);
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
        let mut bearing = Named::started(scene);
        bearing.run(1e-4, at);
        let bytes = bearing.0.save().to_bytes();
        let run = |bearing: &mut Named| -> Vec<u64> {
            (0..40)
                .flat_map(|_| {
                    bearing.0.step(1e-4).unwrap();
                    ["shaft.x", "shaft.y", "element[1].path", "cage.torque"].map(|name| bearing.get(name).to_bits())
                })
                .collect()
        };
        let first = run(&mut bearing);
        let state = bearing.0.state_from_bytes(&bytes).unwrap();
        bearing.0.restore(&state).unwrap();
        assert_eq!(run(&mut bearing), first);
    }
}

#[test]
fn energy_goes_nowhere_but_into_the_forced_motions_under_law_map() {
    for (mut scene, from) in [(inner(), 4.7e-3), (element(1.2e-3), 3.6e-3)] {
        scene.contact.law = ContactLaw::Map;
        scene.contact.cells = Some([24, 16]);
        scene.contact.map_accuracy = Some(1e-2);
        (scene.contact.damping, scene.shaft.damping) = (Damping::HuntCrossley(0.0), 0.0);
        let map = map_of(&scene, None);
        let mut bearing =
            Named(brinell::simulation::Simulation::with_map(scene.clone(), None, map.as_deref()).unwrap());
        bearing.0.initialize(0.0).unwrap();
        bearing.run(1e-4, (from / 1e-4) as usize);
        let [moved, drift] = exchanged_and_lost(&mut bearing, &scene, 1e-6, 1500);
        // Trapezoids of 1 µs over forces that swing in some 10 µs; the exchange is what makes the figure say something.
        assert!(moved > 1e-5 && drift < 2e-4 * moved, "{drift:e} J of {moved:e} J are lost");
    }
}

#[test]
fn a_balance_is_found_with_elements_anywhere_over_an_inner_defect() {
    let mut scene = inner();
    scene.contact.law = ContactLaw::Map;
    scene.contact.cells = Some([24, 16]);
    scene.contact.map_accuracy = Some(1e-2);
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
    let inputs =
        ["shaft.x", "shaft.y", "shaft.vx", "shaft.vy", "shaft.ax", "shaft.ay"].map(|name| still.reference(name));
    let about =
        ["shaft.x", "shaft.y", "shaft.vx", "shaft.vy", "shaft.ax", "shaft.ay"].map(|name| turning.reference(name));
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
