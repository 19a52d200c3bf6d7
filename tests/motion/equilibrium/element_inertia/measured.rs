//! What is measured of elements without inertia beside the full model: spectra by band, and events.

use super::without_inertia;
use crate::support::Named;
use brinell::scene::Scene;
use brinell_analysis::spectrum::{Band, Spectrum};

/// Bands (Hz).
pub(crate) const BANDS: [(f64, f64); 5] =
    [(0.0, 500.0), (500.0, 1000.0), (1000.0, 2000.0), (2000.0, 5000.0), (5000.0, 10_000.0)];
/// Samples per second: elements with inertia vibrate up to 100 kHz.
const RATE: f64 = 200_000.0;
/// What is left out at the start and, because filters ring, at the end (s).
const EDGE: f64 = 0.02;

/// A signal of the full model and of the same bearing without the inertia of its elements, sampled at [`RATE`].
pub(crate) fn pair(scene: &Scene, variable: &str, time: f64) -> [Vec<f64>; 2] {
    [scene.clone(), without_inertia(scene.clone())].map(|scene| signal(scene, variable, time))
}

fn signal(scene: Scene, variable: &str, time: f64) -> Vec<f64> {
    Named::started(scene).course([variable], 1.0 / RATE, (time * RATE) as usize).concat()
}

/// Root mean square in a band.
pub(crate) fn level(signal: &[f64], low: f64, high: f64) -> f64 {
    let mean = signal.iter().sum::<f64>() / signal.len() as f64;
    let centred: Vec<f64> = signal.iter().map(|x| x - mean).collect();
    let band = Spectrum::of(&centred, RATE).filtered(Band { low, high });
    let edge = (EDGE * RATE) as usize;
    let inside = &band[edge..band.len() - edge];
    (inside.iter().map(|x| x * x).sum::<f64>() / inside.len() as f64).sqrt()
}

/// When element 1 loses its load over the spall and when it first has it again (s).
pub(crate) fn events(mut scene: Scene) -> [f64; 2] {
    // It stands before the spall.
    scene.cage.initial_angle = scene.defects[0].angle - 0.25;
    let force = signal(scene, "element[1].force.outer", 0.03);
    let lost = force.iter().position(|&force| force < 1.0).unwrap();
    let again = lost + force[lost..].iter().position(|&force| force > 20.0).unwrap();
    [lost, again].map(|sample| sample as f64 / RATE)
}
