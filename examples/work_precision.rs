//! Work against precision: CPU seconds per simulated second and error of the housing's acceleration and of the elements'
//! paths over the tolerance, against the same method at a tolerance of 1e-12.
//!
//! `cargo run --release --example work_precision -- SCENE [STOP [STEP]]`

use brinell::scene::{ContactLaw, Scene};
use brinell::simulation::{Method, Simulation};
use std::error::Error;
use std::path::Path;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

struct Run {
    seconds: f64,
    counts: [i32; 2],
    acceleration: Vec<f64>,
    paths: Vec<f64>,
}

fn run(bearing: &Simulation, method: Method, tolerance: f64, stop: f64, step: f64) -> Outcome<Run> {
    let mut bearing = bearing.clone();
    bearing.set_method(method);
    let reference = |name: &str| bearing.table().iter().position(|v| v.name == name).map(|i| i as u32);
    let acceleration: Vec<u32> = reference("housing.ay").into_iter().collect();
    let solver: Vec<u32> = reference("solver.tolerance").into_iter().collect();
    let counts: Vec<u32> = ["solver.steps", "solver.rejected_steps"].iter().filter_map(|n| reference(n)).collect();
    bearing.set_reals(&solver, &[tolerance])?;
    bearing.initialize(0.0)?;
    let z = bearing.scene().bearing.element_count;
    let mut found = Run { seconds: 0.0, counts: [0; 2], acceleration: Vec::new(), paths: Vec::new() };
    for _ in 0..(stop / step).round() as usize {
        let before = Instant::now();
        bearing.step(step)?;
        found.seconds += before.elapsed().as_secs_f64();
        let mut a = [0.0];
        bearing.reals(&acceleration, &mut a)?;
        found.acceleration.push(a[0]);
        found.paths.extend(&bearing.state_vector()[..z]);
    }
    bearing.integers(&counts, &mut found.counts)?;
    found.seconds /= stop;
    Ok(found)
}

fn rms(a: &[f64], b: &[f64]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    let of: f64 = b.iter().map(|b| b * b).sum();
    (sum / of).sqrt()
}

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "6205-healthy".to_owned());
    let method = if std::env::var_os("RODAS").is_some() { Method::Rodas } else { Method::DormandPrince };
    let stop = arguments.next().map_or(Ok(0.025), |t| t.parse())?;
    let step = arguments.next().map_or(Ok(1e-4), |t| t.parse())?;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut scene = Scene::from_toml(&std::fs::read_to_string(root.join(format!("{name}.toml")))?)?;
    if std::env::var_os("LAW_HERTZ").is_some() {
        scene.contact.law = ContactLaw::Hertz;
    }
    let bearing = Simulation::new(scene, None)?;
    let mut warm = bearing.clone();
    warm.initialize(0.0)?;
    let reference = run(&bearing, Method::DormandPrince, 1e-12, stop, step)?;
    let second = run(&bearing, Method::DormandPrince, 1e-11, stop, step)?;
    println!("reference differs by {:.1e}", rms(&second.acceleration, &reference.acceleration));
    println!("tolerance, CPU s/s, steps/s, rejected/s, acceleration error, path error m");
    for tolerance in [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8] {
        let mut best: Option<Run> = None;
        for _ in 0..5 {
            let next = run(&bearing, method, tolerance, stop, step)?;
            if best.as_ref().is_none_or(|b| next.seconds < b.seconds) {
                best = Some(next);
            }
        }
        let Some(found) = best else { continue };
        let path = found.paths.iter().zip(&reference.paths).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
        println!(
            "{tolerance:.0e} {:8.4} {:8.0} {:8.0} {:8.1e} {:8.1e}",
            found.seconds,
            f64::from(found.counts[0]) / stop,
            f64::from(found.counts[1]) / stop,
            rms(&found.acceleration, &reference.acceleration),
            path
        );
    }
    Ok(())
}
