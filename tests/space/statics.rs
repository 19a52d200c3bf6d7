//! Stiffness and modes of bearings in space.

use super::*;
use brinell_analysis::modes::{Assembly, Mode};
use brinell_analysis::statics::BearingInSpace;
use std::f64::consts::PI;

#[test]
fn the_static_stiffness_of_an_angular_contact_bearing_is_as_printed() {
    let bearing = Bearing { hertz_inner: Some(2.82515273e10), hertz_outer: Some(2.49580607e10), ..angular(25.0) };
    let scene = free_shaft(bearing, DegreesOfFreedom::Five).shaft_load([0.0, -200.0]).axial_load(500.0);
    let mut scene = scene.cage(0.0, -0.5 * PI).build().unwrap();
    scene.shaft.tilt.load_moment = [0.5, 0.0];
    // Supports and gravity are not of the bearing.
    (scene.shaft.stiffness, scene.shaft.tilt.stiffness) = (1e6, 100.0);
    let found = BearingInSpace::new(&scene, None, None).unwrap().balance(-0.5 * PI).unwrap();
    let [_, y, z, tilt, _] = found.position;
    printed(&[y * 1e6, z * 1e6, tilt * 1e3], 1.0, "-21.6935185 6.8944875 2.1967200");
    let diagonal: Vec<f64> = (0..5).map(|k| found.stiffness[k][k]).collect();
    printed(&diagonal, 1.0, "1.3279508e8 1.5975606e8 7.4372046e7 1.5271644e4 1.2279294e4");
    printed(&[found.stiffness[0][4], found.stiffness[1][2]], 1.0, "-1.2203660e6 1.1919645e7");
}

/// A thrust bearing whose shaft stands, and is held in its plane so that it moves along its axis and tilts by itself.
fn standing() -> Scene {
    let scene = free_shaft(angular(25.0), DegreesOfFreedom::Five).gravity([0.0; 2]).axial_load(500.0);
    let mut scene = scene.shaft_speed(0.0).cage(0.0, -0.5 * PI).tolerance(1e-9).build().unwrap();
    scene.shaft.stiffness = 1e11;
    (scene.shaft.damping, scene.shaft.axial.damping, scene.shaft.tilt.damping) = (1e3, 20.0, 0.02);
    scene
}

/// Undamped frequency (Hz) of the mode with the largest share of its energy in a degree of freedom.
fn frequency_of(assembly: &Assembly, name: &str) -> f64 {
    let at = assembly.freedom_names().iter().position(|freedom| freedom == name).unwrap();
    let modes = assembly.modes(-0.5 * PI).unwrap().modes;
    let most = modes.iter().max_by(|a, b| a.energy[at].total_cmp(&b.energy[at])).unwrap();
    assert!(most.energy[at] > 0.9, "{}", most.energy[at]);
    Mode::damped_frequency(most).unwrap()
}

/// Frequency (Hz) at which an output swings through its rest after a small step of a load, over `swings` periods.
fn free_decay(output: &str, load: [&str; 2], frequency: f64, swings: usize) -> f64 {
    let mut simulation = started(standing());
    let [name, amount] = load;
    let rest = |simulation: &mut Simulation| simulation.get(output).unwrap();
    let before = rest(&mut simulation);
    let held = simulation.get(name).unwrap();
    let step = amount.parse::<f64>().unwrap();
    // Away for half a period, and back: about the old rest.
    let dt = 1.0 / (200.0 * frequency);
    simulation.set(name, held + step).unwrap();
    for _ in 0..100 {
        simulation.step(dt).unwrap();
    }
    simulation.set(name, held).unwrap();
    let (mut last, mut crossings) = (rest(&mut simulation) - before, Vec::new());
    for k in 0..200 * (swings + 4) {
        simulation.step(dt).unwrap();
        let next = rest(&mut simulation) - before;
        if last < 0.0 && next >= 0.0 {
            crossings.push((k as f64 + last / (last - next)) * dt);
        }
        last = next;
    }
    // The first ones are those of the balls' own modes, which die out.
    (swings as f64) / (crossings[2 + swings] - crossings[2])
}

#[test]
fn axial_and_tilting_modes_are_those_of_the_free_decay() {
    let assembly = Assembly::new(&standing(), None, None).unwrap();
    for (output, load) in [("shaft.z", ["shaft.load.z", "0.05"]), ("shaft.tilt.x", ["shaft.load_moment.x", "0.0005"])] {
        let mode = frequency_of(&assembly, output);
        let decay = free_decay(output, load, mode, 10);
        // Steps of 1e-4 of the load: its stiffness differs by a third of that; crossings are read to 1e-4 of a period.
        assert!((decay / mode - 1.0).abs() < 1e-3, "{output}: {decay} Hz by free decay, {mode} Hz by modes");
    }
}

#[test]
fn a_held_shaft_in_space_is_refused_by_the_modes() {
    let mut scene = standing();
    scene.shaft = Ring::fixed();
    let error = Assembly::new(&scene, None, None).unwrap_err().to_string();
    assert!(error.contains("degrees_of_freedom = 5") && error.contains("shaft.motion"), "{error}");
}
