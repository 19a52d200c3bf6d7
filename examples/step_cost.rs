//! What a step costs: nanoseconds per communication step of 10 µs when the host moves both rings, and CPU seconds per
//! simulated second over the number of elements.
//!
//! Each figure is the best of several runs: what disturbs a measurement only adds.
//!
//! `cargo run --release --example step_cost`

use brinell::scene::{Motion, Ring, Scene};
use brinell::simulation::Simulation;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn scene(name: &str) -> Outcome<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.toml"));
    Ok(Scene::from_toml(&std::fs::read_to_string(path)?)?)
}

/// Seconds of the fastest of `runs` runs.
fn best(runs: usize, mut run: impl FnMut() -> Outcome<()>) -> Outcome<f64> {
    let mut fastest = f64::INFINITY;
    for _ in 0..runs {
        let start = Instant::now();
        run()?;
        fastest = fastest.min(start.elapsed().as_secs_f64());
    }
    Ok(fastest)
}

fn hosted(tolerance: f64) -> Outcome<()> {
    let mut scene = scene("6205-healthy")?;
    for ring in [&mut scene.shaft, &mut scene.housing] {
        *ring = Ring { motion: Motion::Host, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 };
    }
    (scene.sensor, scene.tolerance) = (None, tolerance);
    let mut bearing = Simulation::new(scene, None)?;
    let place = ["shaft.y", "shaft.vy"]
        .map(|name| bearing.table().iter().position(|variable| variable.name == name).unwrap_or_default() as u32);
    // 20 µm beyond the concentric place, some hundred newtons on the lowest elements.
    bearing.set_reals(&place, &[-20e-6, 0.0])?;
    bearing.initialize(0.0)?;
    let start = bearing.save();
    let count = 2000;
    let seconds = best(200, || {
        bearing.restore(&start)?;
        for _ in 0..count {
            bearing.set_reals(&place, &[-20e-6, 0.0])?;
            bearing.step(1e-5)?;
        }
        Ok(())
    })?;
    let steps = bearing.step_counts().0 as f64 / f64::from(count);
    println!(
        "tolerance {tolerance:.0e}: {:.0} ns per communication step of 10 us, {steps:.2} integration steps each",
        seconds / f64::from(count) * 1e9
    );
    Ok(())
}

fn elements(count: usize) -> Outcome<()> {
    let mut scene = scene("6205-healthy")?;
    scene.bearing.element_count = count;
    // Room for all of them, at the same load per element.
    scene.bearing.pitch_diameter *= (count as f64 / 9.0).max(1.0);
    scene.shaft.load[1] *= count as f64 / 9.0;
    let mut bearing = Simulation::new(scene, None)?;
    bearing.initialize(0.0)?;
    let start = bearing.save();
    let seconds = best(30, || {
        bearing.restore(&start)?;
        for _ in 0..50 {
            bearing.step(1e-4)?;
        }
        Ok(())
    })?;
    let steps = bearing.step_counts().0 as f64;
    println!(
        "{count:4} elements: {:8.1} ns per integration step, {:8.4} CPU s/s",
        seconds / steps * 1e9,
        seconds / 5e-3
    );
    Ok(())
}

fn main() -> Outcome<()> {
    println!("both rings moved by the host, no defect");
    for tolerance in [1e-3, 1e-5] {
        hosted(tolerance)?;
    }
    println!("cost over the number of elements");
    for count in [3, 5, 9, 16, 25, 50, 100] {
        elements(count)?;
    }
    Ok(())
}
