//! What a whole second costs once the start has died away, beside the first 25 ms.
//!
//! From rest elements hang in the clearance that later bounce, so a short run flatters. Elements that bounce lose all
//! memory of the start, and then two runs are not equal at equal instants: what is compared is the root mean square of
//! the signal over the second.

use std::path::Path;

use anyhow::{Context, Result};
use brinell::simulation::{Method, Simulation};
use brinell_analysis::modes::{Assembly, Hold, ModesReport, sweep};
use cpu_time::ThreadTime;

use super::Extent;
use super::integration::scene_file;
use super::run::{STEP, Subject};
use fmu_build::package::Model;
use fmu_build::shared::whole_file;

/// Tolerances of the runs.
const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-5];
/// Tolerance of the run that they are held against.
const REFERENCE: f64 = 1e-7;
/// The start, which is left out, and what is measured alone of it (s).
const START: f64 = 0.3;
const FIRST: f64 = 0.025;

/// Cage angles within one element spacing at which modes are computed, as many as `brinell modes` takes.
const CAGE_ANGLES: usize = 200;

/// One scene at one tolerance.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) scene: &'static str,
    pub(super) tolerance: f64,
    /// CPU seconds per simulated second, of the first 25 ms and of the second.
    pub(super) cost: [f64; 2],
    /// Accepted and rejected steps per simulated second of it.
    pub(super) steps: [f64; 2],
    /// Root mean square of the signal over the reference's, less 1.
    pub(super) error: f64,
    /// How many balls it has, if they are balls.
    pub(super) balls: Option<usize>,
}

/// Measures and writes `steady.csv`.
pub(super) fn measure(extent: Extent, data: &Path) -> Result<Vec<Row>> {
    let (names, length): (&[&'static str], f64) = match extent {
        Extent::Full => (
            &[
                "6205-hosted",
                "6205-healthy",
                "6205-spall-5deg",
                "6205-epps",
                "er16k-tb1",
                "er16k-tb2",
                "er16k-tb2-compliant",
                "nu205-healthy",
                "nu205-inner",
            ],
            1.0,
        ),
        Extent::Short => (&["6205-healthy"], 0.05),
    };
    let mut rows = Vec::new();
    for &scene in names {
        let model = Model::read(&scene_file(scene))?;
        let bearing = &model.scene.bearing;
        let balls = bearing.roller().is_none().then_some(bearing.element_count);
        let subject = Subject::new(&model, scene.to_owned(), length)?;
        let reference = run(&subject, REFERENCE, length)?;
        for tolerance in TOLERANCES {
            let found = run(&subject, tolerance, length)?;
            let error = found.rms / reference.rms - 1.0;
            rows.push(Row { scene, tolerance, cost: found.cost, steps: found.steps, error, balls });
        }
    }
    whole_file::write_with(&data.join("steady.csv"), |out| {
        writeln!(out, "scene,tolerance,first_cpu_s_per_s,cpu_s_per_s,steps_per_s,rejected_steps_per_s,rms_error")?;
        for Row { scene, tolerance, cost: [first, cost], steps: [steps, rejected], error, .. } in &rows {
            writeln!(out, "{scene},{tolerance:e},{first:.4e},{cost:.4e},{steps:.4e},{rejected:.4e},{error:.3e}")?;
        }
        Ok(())
    })?;
    Ok(rows)
}

/// Frequency up to which the loaded elements of `6205-healthy` vibrate (Hz).
pub(super) fn fastest_of_healthy() -> Result<f64> {
    let model = Model::read(&scene_file("6205-healthy"))?;
    let assembly = Assembly::new(&model.scene, None, None)?;
    let found = sweep(&assembly, 0.0, CAGE_ANGLES)?;
    let report = ModesReport::new(model.scene.name.clone(), &assembly, 0.0, &found);
    let [[_, most], _] = report.of_elements(Hold::Pressed).context("6205-healthy has no loaded element")?;
    Ok(most)
}

/// What one run gave.
struct Found {
    cost: [f64; 2],
    steps: [f64; 2],
    rms: f64,
}

/// One run: the first 25 ms, the rest of the start, and `length` (s) more.
fn run(subject: &Subject, tolerance: f64, length: f64) -> Result<Found> {
    let mut simulation = subject.start(Method::Automatic, tolerance)?;
    let signal = simulation.reference(subject.signal())?;
    let mut sum = Sum::default();
    let first = sum.over(&mut simulation, signal, FIRST)?;
    sum.over(&mut simulation, signal, START - FIRST)?;
    let before = counters(&mut simulation)?;
    sum = Sum::default();
    let cost = sum.over(&mut simulation, signal, length)? / length;
    let after = counters(&mut simulation)?;
    let steps = [0, 1].map(|k: usize| f64::from(after[k] - before[k]) / length);
    Ok(Found { cost: [first / FIRST, cost], steps, rms: (sum.squares / sum.count).sqrt() })
}

/// Accepted and rejected steps so far.
fn counters(simulation: &mut Simulation) -> Result<[i32; 2]> {
    let references = [simulation.reference("solver.steps")?, simulation.reference("solver.rejected_steps")?];
    let mut counts = [0; 2];
    simulation.integers(&references, &mut counts)?;
    Ok(counts)
}

#[derive(Default)]
struct Sum {
    squares: f64,
    count: f64,
}

impl Sum {
    /// Steps over `length` (s), takes the signal after each step, and gives the CPU seconds of the steps.
    fn over(&mut self, simulation: &mut Simulation, signal: u32, length: f64) -> Result<f64> {
        let start = ThreadTime::now();
        let mut value = [0.0];
        for _ in 0..(length / STEP).round() as usize {
            simulation.step(STEP)?;
            simulation.reals(&[signal], &mut value)?;
            self.squares += value[0] * value[0];
            self.count += 1.0;
        }
        Ok(start.elapsed().as_secs_f64())
    }
}
