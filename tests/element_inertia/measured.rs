//! What is measured of elements without inertia: spectra by band, events and run time beside the full model.
//!
//! The figures of `docs/guide.md`: `cargo test --release --test element_inertia -- --ignored --nocapture`.

use super::without_inertia;
use crate::support::{Named, shipped};
use brinell::scene::Scene;
use brinell_analysis::spectrum::{Band, Spectrum};
use std::time::Instant;

/// Bands [Hz].
pub(crate) const BANDS: [(f64, f64); 5] =
    [(0.0, 500.0), (500.0, 1000.0), (1000.0, 2000.0), (2000.0, 5000.0), (5000.0, 10_000.0)];
/// Samples per second: elements with inertia vibrate up to 100 kHz.
const RATE: f64 = 200_000.0;
/// What is left out at the start and, because filters ring, at the end [s].
const EDGE: f64 = 0.02;

/// A signal of the full model and of the same bearing without the inertia of its elements, sampled at [`RATE`].
pub(crate) fn pair(scene: &Scene, variable: &str, time: f64) -> [Vec<f64>; 2] {
    [scene.clone(), without_inertia(scene.clone())].map(|scene| signal(scene, variable, time))
}

fn signal(scene: Scene, variable: &str, time: f64) -> Vec<f64> {
    let mut bearing = Named::started(scene);
    let reference = [bearing.reference(variable)];
    let mut value = [0.0];
    (0..(time * RATE) as usize)
        .map(|_| {
            bearing.0.step(1.0 / RATE).unwrap();
            bearing.0.reals(&reference, &mut value).unwrap();
            value[0]
        })
        .collect()
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

/// Seconds of a processor core per second of the bearing, the first 50 ms left out.
fn cost(scene: &Scene) -> (f64, u64) {
    let mut bearing = Named::started(scene.clone());
    bearing.run(1e-3, 50);
    let before = bearing.0.step_counts().0;
    let start = Instant::now();
    bearing.run(1e-3, 1000);
    (start.elapsed().as_secs_f64(), bearing.0.step_counts().0 - before)
}

#[test]
#[ignore = "measures run time"]
fn bands_and_run_time_beside_the_full_model() {
    for name in ["6205-healthy", "nu205-healthy", "er16k-tb1", "er16k-inner", "er16k-element"] {
        let scene = shipped(name);
        let [full, none] = pair(&scene, "housing.ay", 0.5);
        println!("{name}");
        for (low, high) in BANDS {
            let [a, b] = [&full, &none].map(|signal| level(signal, low, high));
            let between: Vec<f64> = full.iter().zip(&none).map(|(a, b)| b - a).collect();
            let d = level(&between, low, high);
            println!("  {low} to {high} Hz: {a:.3e} m/s², {:+.2} %, difference {:.2} %", 100.0 * (b / a - 1.0), 100.0 * d / a);
        }
        for sensors in [true, false] {
            for tolerance in [1e-3, 1e-4, 1e-5] {
                let mut scene = Scene { tolerance, ..scene.clone() };
                if !sensors {
                    scene.sensors.clear();
                }
                let [full, none] = [cost(&scene), cost(&without_inertia(scene.clone()))];
                println!(
                    "  tolerance {tolerance:e}, sensor {sensors}: {:.4} s/s in {} steps, {:.4} s/s in {} steps, ratio {:.1}",
                    full.0,
                    full.1,
                    none.0,
                    none.1,
                    full.0 / none.0
                );
            }
        }
    }
}
