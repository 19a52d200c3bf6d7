//! A 6205 under a load downwards: its start, and the lines of its force as it turns.

use super::Named;
use brinell::scene::{Bearing, Ring, Scene};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A 6205 at rest under 500 N downwards, its outer ring held, element 1 under the load, without weight.
pub fn loaded() -> Scene {
    let built = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3)).gravity([0.0; 2]).housing(Ring::fixed());
    built.shaft_load([0.0, -500.0]).cage(0.0, -FRAC_PI_2).build().unwrap()
}

/// Position of the shaft (µm), and forces of elements 1, 2 and 9 outside (N), at the start.
pub fn start(scene: Scene) -> [f64; 5] {
    let mut bearing = Named::started(scene);
    let [x, y] = ["shaft.x", "shaft.y"].map(|name| 1e6 * bearing.get(name));
    let [one, two, nine] = [1, 2, 9].map(|j| bearing.get(&format!("element[{j}].force.outer")));
    [x, y, one, two, nine]
}

/// Turns of the shaft and of the cage, and of an element against the cage, of a [`preloaded`] bearing over the time of
/// [`lines`].
pub const TURNS: [usize; 3] = [5, 2, 12];

/// Nine balls between concentric raceways that press them by 5 µm; γ = 1/5, so that all turns are whole together.
pub fn preloaded() -> Scene {
    let mut bearing = Bearing::steel_balls(9, 7.94e-3, 39.7e-3);
    bearing.radial_clearance = -5e-6;
    let built = Scene::builder(bearing).gravity([0.0; 2]).housing(Ring::fixed()).shaft(Ring::hosted());
    built.shaft_speed(TAU * 10.0).build().unwrap()
}

/// Amplitudes (N) of lines of the inner ring's vertical force, the ring held in the middle, while the shaft turns five
/// times: at multiples of one over that time.
pub fn lines<const N: usize>(scene: Scene, orders: [usize; N]) -> [f64; N] {
    let time = TURNS[0] as f64 * TAU / scene.shaft_speed;
    let mut bearing = Named::started(scene);
    // What vibrates at the start dies away.
    bearing.run(1e-3, 20);
    let force = bearing.course(["shaft.force.y"], time / 2000.0, 2000);
    orders.map(|order| amplitude(force.as_flattened(), order))
}

/// Amplitude of a line that goes through so many periods in a signal.
pub fn amplitude(signal: &[f64], order: usize) -> f64 {
    let count = signal.len();
    let [re, im] = signal.iter().enumerate().fold([0.0; 2], |[re, im], (k, value)| {
        let (sin, cos) = (TAU * ((order * k) % count) as f64 / count as f64).sin_cos();
        [re + value * cos, im + value * sin]
    });
    2.0 * re.hypot(im) / count as f64
}
