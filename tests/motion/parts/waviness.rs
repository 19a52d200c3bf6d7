//! Waviness: load distributions against an independent computation, energy, lines of a spectrum.

use crate::support::Named;
use crate::support::defects::{mapped, spall};
use crate::support::energy::exchanged_and_lost;
use crate::support::loaded::{TURNS, lines, loaded, preloaded, start};
use brinell::scene::{ContactLaw, Damping, Defect, DefectOn, ElementInertia, Scene, Waviness, WavyBody};
use brinell::simulation::Simulation;
use std::f64::consts::FRAC_PI_2;

fn waves(on: WavyBody, order: u32, amplitude: f64, crest_deg: f64) -> Waviness {
    Waviness { on, order, amplitude, crest: crest_deg.to_radians() }
}

fn with(mut scene: Scene, all: &[Waviness]) -> Scene {
    scene.waviness = all.to_vec();
    scene
}

#[test]
fn the_torque_on_the_shaft_is_described_by_what_causes_it() {
    let inner = waves(WavyBody::Inner, 3, 1e-6, 0.0);
    let mut struck = loaded();
    struck.contact.law = ContactLaw::Hertz;
    struck.defects = vec![Defect::inner(-FRAC_PI_2, spall(0.8e-3, 50e-6))];
    for (scene, at) in [
        (struck.clone(), "at the defect on"),
        (with(loaded(), std::slice::from_ref(&inner)), "at the waves of"),
        (with(struck, &[inner]), "at the defect and the waves of"),
    ] {
        let simulation = Simulation::new(scene, None).unwrap();
        let row = simulation.table().iter().find(|row| row.name == "shaft.torque").unwrap();
        assert_eq!(row.description, format!("Torque of contacts {at} the inner ring about its centre"));
    }
}

/// Energy minimized, exact geometry: an independent computation, to the digits that it was printed with.
#[test]
fn load_distributions_are_those_of_an_independent_computation() {
    use WavyBody::{Inner, Outer};
    for inertia in [ElementInertia::Full, ElementInertia::None] {
        for (on, order, crest, [cage, shaft], expected) in [
            (Outer, 9, -90.0, [-90.0, 0.0], [0.0, -15.826_961_7, 285.237_38, 140.237_69, 140.237_69]),
            (Outer, 8, -90.0, [-90.0, 0.0], [0.0, -15.679_429_0, 278.838_13, 144.415_75, 144.415_75]),
            (Outer, 8, -90.0, [-80.0, 0.0], [0.581_147_2, -14.784_449_4, 270.564_79, 79.111_06, 209.967_16]),
            (Inner, 3, 0.0, [-90.0, 20.0], [0.672_591_1, -14.493_663_6, 308.745_15, 124.894_32, 124.895_36]),
        ] {
            let mut scene = with(loaded(), &[waves(on, order, 1e-6, crest)]);
            scene.bearing.element_inertia = inertia;
            (scene.cage.initial_angle, scene.shaft_initial_angle) = (f64::to_radians(cage), f64::to_radians(shaft));
            let found = start(scene);
            // Printed are normal forces; outputs have the part along the raceway with them, outside by w'/ρ.
            let slope = |degrees: f64| match on {
                Outer => {
                    1e-6 / 19.5e-3 * f64::from(order) * (f64::from(order) * (cage + degrees - crest).to_radians()).sin()
                }
                _ => 0.0,
            };
            let along = [0.0, 0.0, slope(0.0), slope(40.0), slope(-40.0)].map(|slope| (1.0 + slope * slope).sqrt());
            for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                let (digits, found) = (if k < 2 { 6e-8 } else { 6e-6 }, found / along[k]);
                assert!((found - expected).abs() < digits, "{on:?} {order}, {inertia:?}: {k}: {found} for {expected}");
            }
        }
    }
}

/// What Newton's method left of a contact that ends without force was no balance: nine of 288 bearings were refused.
#[test]
fn elements_without_weight_and_inertia_find_their_place_under_any_load_or_none() {
    for on in [WavyBody::Outer, WavyBody::Inner, WavyBody::Element(1)] {
        for load in [0.0, -1e-6, -0.01, -1.0] {
            let mut scene = with(loaded(), &[waves(on, 7, 1e-6, 11.0)]);
            (scene.bearing.element_inertia, scene.shaft.load) = (ElementInertia::None, [0.0, load]);
            let force = Named::started(scene).get("shaft.force.y");
            // What a search leaves of a force, or counts as none.
            assert!((force + load).abs() < 1e-11, "{on:?}, {load} N: {force}");
        }
    }
}

/// Bodies that are wavy one after the other, and a ring's waves beside a defect of it.
fn wavy() -> Vec<(&'static str, Scene)> {
    use WavyBody::{Element, Inner, Outer};
    let outer = with(loaded(), &[waves(Outer, 8, 2e-6, 30.0), waves(Outer, 3, 1e-6, -70.0)]);
    let inner = with(loaded(), &[waves(Inner, 7, 2e-6, 10.0)]);
    let element = with(loaded(), &[waves(Element(0), 4, 2e-6, 40.0), waves(Element(1), 2, 1e-6, 0.0)]);
    let damaged = |scene: &Scene, defect: Defect| Scene { defects: vec![defect], ..scene.clone() };
    let beside = damaged(&outer, Defect::outer(-FRAC_PI_2, spall(0.8e-3, 50e-6)));
    let inside = damaged(&inner, Defect::inner(-FRAC_PI_2, spall(0.8e-3, 50e-6)));
    let on = DefectOn::Element { element: 0, tilt: 0.0 };
    let own = damaged(&element, Defect { on, angle: 0.1, shape: spall(0.5e-3, 50e-6) });
    vec![("outer", outer), ("inner", inner), ("element", element), ("beside", beside), ("inside", inside), ("own", own)]
}

#[test]
fn energy_goes_nowhere_but_into_the_forced_motions() {
    for (name, scene) in wavy() {
        let mut scene = if scene.defects.is_empty() { scene } else { mapped(scene) };
        (scene.contact.damping, scene.shaft.damping) = (Damping::HuntCrossley(0.0), 0.0);
        (scene.tolerance, scene.gravity, scene.shaft_speed) = (1e-9, [3.0, -9.81], 100.0);
        let mut bearing = Named::started(scene.clone());
        let [moved, lost] = exchanged_and_lost(&mut bearing, &scene, 2e-6, 3000);
        // Trapezoids of 2 µs over forces that swing in some 100 µs, over a defect's edges in some 10 µs.
        let share = if scene.defects.is_empty() { 1e-4 } else { 2e-3 };
        assert!(moved > 1e-6 && lost < share * moved, "{name}: {lost:e} J of {moved:e} J are lost");
    }
}

/// Lines that sound with waves of an order of a body, or without them.
#[test]
fn orders_of_waves_sound_where_theory_has_their_lines() {
    use WavyBody::{Element, Inner, Outer};
    let [shaft, cage, spin] = TURNS;
    // kZ f_c of n = kZ ± 1 outside, kZ (f_s − f_c) ± f_s of n = kZ ± 1 inside, 2k f_b ± f_c of even orders of a ball.
    let [outside, above, below] = [9 * cage, 9 * (shaft - cage) + shaft, 9 * (shaft - cage) - shaft];
    let rolled = 2 * spin;
    for (body, order, heard) in [
        (Outer, 8, &[outside][..]),
        (Outer, 10, &[outside]),
        (Outer, 17, &[2 * outside]),
        (Outer, 6, &[]),
        (Outer, 9, &[]),
        (Inner, 10, &[above]),
        (Inner, 8, &[below]),
        (Inner, 6, &[]),
        (Element(4), 2, &[rolled - cage, rolled + cage]),
        (Element(4), 4, &[2 * rolled - cage, 2 * rolled + cage]),
        (Element(4), 3, &[]),
    ] {
        let all = [cage, below, outside, above, rolled - cage, rolled + cage];
        let all = [&all[..], &[2 * outside, 3 * spin - cage, 3 * spin + cage], &[2 * rolled - cage, 2 * rolled + cage]];
        let all: [usize; 11] = all.concat().try_into().unwrap();
        let found = lines(with(preloaded(), &[waves(body, order, 0.02e-6, 25.0)]), all);
        for (line, amplitude) in all.into_iter().zip(found) {
            if heard.contains(&line) {
                assert!(amplitude > 0.2, "{body:?} {order}: line {line} has {amplitude} N");
            } else {
                // Of second order in the wave's height.
                assert!(amplitude < 0.005, "{body:?} {order}: line {line} has {amplitude} N");
            }
        }
    }
}
