//! Our side of `laboratory/peers/integration.py`: seconds per simulated second and error over the first 20 ms under law
//! `hertz`.
//!
//!     cargo run --release -p brinell-laboratory --example beside_peers -- SCENE.toml …
//!
//! Samples every 10 µs; errors are the root mean square of the outer ring's vertical acceleration against a run at a
//! tolerance of 1e-12, over that of the acceleration. Times are those of the fastest of twenty runs that keep nothing.

use brinell::scene::{ContactLaw, Recorder, RecorderFilter};
use brinell::simulation::Simulation;
use std::error::Error;
use std::time::Instant;

/// End and communication step (s).
const STOP: f64 = 0.02;
const STEP: f64 = 1e-4;

fn main() -> Result<(), Box<dyn Error>> {
    for path in std::env::args().skip(1) {
        let mut scene = brinell_scene_file::from_toml(&std::fs::read_to_string(&path)?)?;
        scene.contact.law = ContactLaw::Hertz;
        scene.recorder = Some(Recorder { rate: 1e5, filter: RecorderFilter::None });
        let simulation = Simulation::new(scene, None)?;
        let reference = signal(&simulation, 1e-12)?;
        println!("{path}");
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let mut seconds = f64::INFINITY;
            for _ in 0..20 {
                seconds = seconds.min(run(&mut started(&simulation, tolerance)?)?);
            }
            let found = signal(&simulation, tolerance)?;
            let off: Vec<f64> = found.iter().zip(&reference).map(|(a, b)| a - b).collect();
            let error = rms(&off) / rms(&reference);
            println!("  tolerance {tolerance:.0e}: {:.3} s/s, error {error:.1e}", seconds / STOP);
        }
    }
    Ok(())
}

fn started(simulation: &Simulation, tolerance: f64) -> Result<Simulation, Box<dyn Error>> {
    let mut simulation = simulation.clone();
    simulation.set("solver.tolerance", tolerance)?;
    simulation.initialize(0.0)?;
    Ok(simulation)
}

/// The seconds that the steps of a run take.
fn run(simulation: &mut Simulation) -> Result<f64, Box<dyn Error>> {
    let begun = Instant::now();
    for _ in 0..(STOP / STEP).round() as usize {
        simulation.step(STEP)?;
    }
    Ok(begun.elapsed().as_secs_f64())
}

/// The outer ring's vertical acceleration in a run.
fn signal(simulation: &Simulation, tolerance: f64) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut simulation = started(simulation, tolerance)?;
    simulation.record_into("memory");
    run(&mut simulation)?;
    let wanted = simulation.reference("housing.ay")?;
    let recorder = simulation.recorder().ok_or("no recorder")?;
    // The first column is the time.
    let column = 1 + recorder.references().position(|known| known == wanted).ok_or("housing.ay is not recorded")?;
    let samples = recorder.samples();
    Ok(samples.values.chunks(samples.width).map(|row| row[column]).collect())
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}
