//! What is measured of elements without inertia: spectra by band, events and run time beside the full model.
//!
//! The figures of `docs/guide.md`: `cargo test --workspace --release --test element_inertia -- --ignored --nocapture`.

use super::without_inertia;
use crate::support::{Named, shipped};
use brinell::scene::Scene;
use brinell_analysis::spectrum::{Band, Spectrum};
use std::time::Instant;

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

/// Processor time of this thread (s); where the system does not tell, time on the clock.
fn processor_time(start: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|told| told.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or(start.elapsed().as_secs_f64(), |nanoseconds| 1e-9 * nanoseconds)
}

/// Seconds of a processor core per second of the bearing in steps of 1 ms, over so many steps after the first 50: what
/// the system tells of them goes up in steps of 4 ms.
fn cost(scene: &Scene, steps: usize) -> f64 {
    let mut bearing = Named::started(scene.clone());
    bearing.run(1e-3, 50);
    let start = Instant::now();
    let before = processor_time(start);
    bearing.run(1e-3, steps);
    (processor_time(start) - before) / (1e-3 * steps as f64)
}

/// Velocity of the outer ring every millisecond.
fn velocities(scene: &Scene, tolerance: f64) -> Vec<f64> {
    let mut bearing = Named::started(Scene { tolerance, ..scene.clone() });
    (0..100)
        .map(|_| {
            bearing.run(1e-3, 1);
            bearing.get("housing.vy")
        })
        .collect()
}

/// Root mean square of what a tolerance leaves of an error in the outer ring's velocity, over that of the velocity.
fn error(scene: &Scene, tolerance: f64, exact: &[f64]) -> f64 {
    let square = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>();
    let found = velocities(scene, tolerance);
    let misses = square(&mut found.iter().zip(exact).map(|(a, b)| a - b));
    (misses / square(&mut exact.iter().copied())).sqrt()
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

#[test]
#[ignore = "measures run time"]
fn bands_events_and_run_time_beside_the_full_model() {
    for name in ["6205-healthy", "nu205-healthy", "er16k-tb1", "er16k-inner", "er16k-element"] {
        let scene = shipped(name);
        let [full, none] = pair(&scene, "housing.ay", 0.5);
        println!("{name}");
        for (low, high) in BANDS {
            let [a, b] = [&full, &none].map(|signal| level(signal, low, high));
            let between: Vec<f64> = full.iter().zip(&none).map(|(a, b)| b - a).collect();
            let d = level(&between, low, high);
            let [level, miss] = [100.0 * (b / a - 1.0), 100.0 * d / a];
            println!("  {low} to {high} Hz: {a:.3e} m/s², {level:+.2} %, difference {miss:.2} %");
        }
        for sensors in [true, false] {
            let mut full = scene.clone();
            if !sensors {
                full.sensors.clear();
            }
            let none = without_inertia(full.clone());
            let exact = [&full, &none].map(|scene| velocities(scene, 1e-9));
            for tolerance in [1e-3, 1e-4, 1e-5] {
                let of = |scene: &Scene, exact: &[f64], steps: usize| {
                    (cost(&Scene { tolerance, ..scene.clone() }, steps), error(scene, tolerance, exact))
                };
                let [a, b] = [of(&full, &exact[0], 1000), of(&none, &exact[1], 4000)];
                println!(
                    "  tolerance {tolerance:e}, sensor {sensors}: {:.4} s/s, error {:.1e}; {:.4} s/s, error {:.1e}; \
                     ratio {:.1}",
                    a.0,
                    a.1,
                    b.0,
                    b.1,
                    a.0 / b.0
                );
            }
        }
    }
    let scene = shipped("er16k-tb1");
    println!("events {:?} {:?}", events(scene.clone()), events(without_inertia(scene)));
}
