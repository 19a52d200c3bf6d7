//! Our side of `laboratory/peers/planar.py`: CPU seconds of an FMU per simulated second and error over the first
//! 20 ms under law `hertz`.
//!
//!     cargo run --release -p brinell-laboratory --example beside_peers -- SCENE.toml …
//!
//! Samples every 10 µs; errors are the root mean square of the outer ring's vertical acceleration against a run at a
//! tolerance of 1e-12, over that of the acceleration. Times are those of the fastest of twenty runs of the library that
//! FMUs are packed with, in CPU time of the thread within `fmi2DoStep`.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use brinell::scene::{ContactLaw, Recorder, RecorderFilter};
use brinell::simulation::Simulation;
use brinell_laboratory::packed::{self, Packed};
use fmu_build::package::{Model, read_scene};
use fmu_build::shared::Project;

/// End and communication step (s).
const STOP: f64 = 0.02;
const STEP: f64 = 1e-4;

fn main() -> Result<()> {
    let library = packed::library(&Project::find())?;
    for path in std::env::args().skip(1) {
        let text = read_scene(Path::new(&path))?.0.replace("law = \"map\"", "law = \"hertz\"");
        let model = Model::of_text(text, &path)?;
        let mut scene = model.scene.clone();
        ensure!(scene.contact.law == ContactLaw::Hertz, "{path}: no line `law = \"map\"` or `law = \"hertz\"`");
        let fmu = Packed::new(&model, &library)?;
        scene.recorder = Some(Recorder { rate: 1e5, filter: RecorderFilter::None });
        let simulation = Simulation::new(scene, None)?;
        let reference = signal(&simulation, 1e-12)?;
        println!("{path}");
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let mut seconds = f64::INFINITY;
            for _ in 0..20 {
                seconds = seconds.min(fmu.run(tolerance, STOP, STEP)?);
            }
            let found = signal(&simulation, tolerance)?;
            let off: Vec<f64> = found.iter().zip(&reference).map(|(a, b)| a - b).collect();
            let error = rms(&off) / rms(&reference);
            println!("  tolerance {tolerance:.0e}: {:.3} s/s, error {error:.1e}", seconds / STOP);
        }
    }
    Ok(())
}

/// The outer ring's vertical acceleration in a run.
fn signal(simulation: &Simulation, tolerance: f64) -> Result<Vec<f64>> {
    let mut simulation = simulation.clone();
    simulation.set("solver.tolerance", tolerance)?;
    simulation.initialize(0.0)?;
    simulation.record_into("memory");
    for _ in 0..(STOP / STEP).round() as usize {
        simulation.step(STEP)?;
    }
    let wanted = simulation.reference("housing.ay")?;
    let recorder = simulation.recorder().context("no recorder")?;
    // The first column is the time.
    let column = 1 + recorder.references().position(|known| known == wanted).context("housing.ay is not recorded")?;
    let samples = recorder.samples();
    Ok(samples.values.chunks(samples.width).map(|row| row[column]).collect())
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}
