//! One run of a scene for the report: its signals at even instants, and what differs between two runs.

use anyhow::{Result, ensure};
use brinell::scene::{Recorder, RecorderFilter};
use brinell::simulation::{Method, Simulation};

use fmu_build::package::Model;

use crate::packed::HELD;

/// Rate at which runs are compared (Hz): above every frequency that a housing sensor sees.
const RATE: f64 = 100_000.0;
/// Communication step of the runs (s).
pub(super) const STEP: f64 = 1e-4;

/// A shipped scene, ready to be run by itself.
#[derive(Debug, Clone)]
pub(super) struct Subject {
    /// Its name.
    pub(super) name: String,
    simulation: Simulation,
    /// Simulated time (s).
    pub(super) stop: f64,
}

/// Signals of one run: rows of time instants.
#[derive(Debug, Clone)]
pub(super) struct Signals {
    /// Acceleration of the outer ring along y, or, where the host has it, the force on the inner ring.
    pub(super) acceleration: Vec<f64>,
    /// Paths of all elements at one instant after the other (m).
    pub(super) paths: Vec<f64>,
}

/// How far a run is from the reference: two norms of two quantities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Deviation {
    /// Root mean square of the acceleration's error over that of the acceleration.
    pub(super) acceleration_rms: f64,
    /// Largest error of the acceleration over the largest acceleration.
    pub(super) acceleration_max: f64,
    /// Root mean square error of the paths (m).
    pub(super) path_rms: f64,
    /// Largest error of any path (m).
    pub(super) path_max: f64,
}

impl Subject {
    /// A scene with a recorder. A ring that the host moves is held where it presses on the elements.
    pub(super) fn new(model: &Model, name: String, stop: f64) -> Result<Self> {
        let mut scene = model.scene.clone();
        // Two runs are compared at equal instants, so nothing is filtered.
        scene.recorder = Some(Recorder { rate: RATE, filter: RecorderFilter::None });
        let profiles = model.profile_texts();
        let mut simulation = Simulation::with_map(scene, profiles, model.map.as_deref())?;
        if model.scene.shaft.motion == brinell::scene::Motion::Host {
            simulation.set_reals(&[simulation.reference("shaft.y")?], &[HELD])?;
        }
        Ok(Self { name, simulation, stop })
    }

    /// The simulation at its start, at a tolerance and by a method.
    pub(super) fn start(&self, method: Method, tolerance: f64) -> Result<Simulation> {
        let mut simulation = self.simulation.clone();
        simulation.set_method(method);
        simulation.set_reals(&[simulation.reference("solver.tolerance")?], &[tolerance])?;
        simulation.initialize(0.0)?;
        Ok(simulation)
    }

    /// Runs a simulation to the end.
    pub(super) fn finish(&self, simulation: &mut Simulation) -> Result<()> {
        for _ in 0..(self.stop / STEP).round() as usize {
            simulation.step(STEP)?;
        }
        Ok(())
    }

    /// The signals of a run by a method at a tolerance.
    pub(super) fn signals(&self, method: Method, tolerance: f64) -> Result<Signals> {
        let mut simulation = self.start(method, tolerance)?;
        // Any name switches the recorder on; its samples stay in memory here.
        simulation.record_into("memory");
        self.finish(&mut simulation)?;
        let columns = Columns::of(&simulation)?;
        let samples = simulation.recorder().map(|recorder| recorder.samples());
        let rows = samples.iter().flat_map(|samples| samples.values.chunks(samples.width));
        let mut signals = Signals { acceleration: Vec::new(), paths: Vec::new() };
        for row in rows {
            signals.acceleration.push(row[columns.acceleration]);
            signals.paths.extend(columns.paths.iter().map(|&column| row[column]));
        }
        Ok(signals)
    }

    /// Name of the signal compared.
    pub(super) fn signal(&self) -> &'static str {
        signal(&self.simulation)
    }
}

fn signal(simulation: &Simulation) -> &'static str {
    if simulation.equations().0.layout.housing.is_some() { "housing.ay" } else { "shaft.force.y" }
}

struct Columns {
    acceleration: usize,
    paths: Vec<usize>,
}

impl Columns {
    fn of(simulation: &Simulation) -> Result<Self> {
        let references: Vec<u32> = simulation.recorder().iter().flat_map(|r| r.references()).collect();
        let names = references.iter().map(|&reference| simulation.table()[reference as usize].name.as_str());
        let (mut acceleration, mut paths) = (0, Vec::new());
        for (index, name) in names.enumerate() {
            if name == signal(simulation) {
                acceleration = index + 1;
            } else if name.ends_with(".path") {
                paths.push(index + 1);
            }
        }
        ensure!(acceleration > 0 && !paths.is_empty(), "the recorder has no {}", signal(simulation));
        Ok(Self { acceleration, paths })
    }
}

impl Signals {
    /// How far these are from `reference`; not a number where a run gave none.
    pub(super) fn deviation(&self, reference: &Signals) -> Deviation {
        let [acceleration_rms, acceleration_max] = norms(&self.acceleration, &reference.acceleration);
        let [rms, max] = norms(&reference.acceleration, &vec![0.0; reference.acceleration.len()]);
        let [path_rms, path_max] = norms(&self.paths, &reference.paths);
        Deviation {
            acceleration_rms: acceleration_rms / rms,
            acceleration_max: acceleration_max / max,
            path_rms,
            path_max,
        }
    }
}

/// Root mean square and largest amount of the difference.
fn norms(one: &[f64], other: &[f64]) -> [f64; 2] {
    if one.len() != other.len() {
        return [f64::NAN; 2];
    }
    let (mut sum, mut largest) = (0.0, 0.0_f64);
    for (a, b) in one.iter().zip(other) {
        let difference = (a - b).abs();
        if difference.is_nan() {
            return [f64::NAN; 2];
        }
        sum += difference * difference;
        largest = largest.max(difference);
    }
    [(sum / one.len() as f64).sqrt(), largest]
}
