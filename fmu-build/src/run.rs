//! A run without a host: the simulation is stepped directly, with its inputs at their start values.

use std::f64::consts::TAU;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use brinell::recording::Recording;
use brinell::scene::{Experiment, Scene};
use brinell::simulation::variables::{Causality, Kind, Variable};
use brinell::simulation::{Simulation, SimulationError};
use brinell_analysis::envelope_spectrum::{self, EnvelopeSpectrum};

use crate::csv;
use crate::model::Model;
use crate::project::Project;
use crate::python::Python;
use crate::units;
use crate::whole_file;

/// Equal communication steps from 0 on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Communication step [s].
    pub step: f64,
    /// Number of steps.
    pub count: u64,
}

impl Grid {
    /// The scene's default run, with what the user says instead. The run ends with the last whole step.
    pub fn new(experiment: &Experiment, stop: Option<f64>, step: Option<f64>) -> Result<Self> {
        let stop = stop.unwrap_or(experiment.stop);
        let step = step.unwrap_or(experiment.step);
        for (quantity, value) in [("stop time", stop), ("communication step", step)] {
            if !(value.is_finite() && value > 0.0) {
                bail!("{quantity} {value} s: it must be finite and above 0");
            }
        }
        // A stop time that is a multiple of the step up to rounding counts as one.
        let count = (stop / step * (1.0 + 1e-9)).floor();
        if !(1.0..=1e9).contains(&count) {
            bail!("{count} communication steps of {step} s until {stop} s: between 1 and 1e9 are possible");
        }
        Ok(Self { step, count: count as u64 })
    }
}

/// The columns of a run: all inputs and outputs that are numbers.
#[derive(Debug, Clone)]
pub struct Columns {
    names: Vec<(String, &'static str)>,
    reals: Vec<u32>,
    integers: Vec<u32>,
    /// Among the reals, the acceleration whose envelope is drawn: a sensor's, else the housing's.
    acceleration: Option<usize>,
}

impl Columns {
    /// All of the table but parameters, reals first.
    pub fn new(table: &[Variable]) -> Self {
        let mut columns = Self { names: Vec::new(), reals: Vec::new(), integers: Vec::new(), acceleration: None };
        let mut counters = Vec::new();
        for variable in table.iter().filter(|variable| variable.causality != Causality::Parameter) {
            match variable.kind {
                Kind::Real { unit, .. } => {
                    columns.names.push((variable.name.clone(), units::name(unit)));
                    columns.reals.push(variable.reference);
                }
                Kind::Integer => {
                    counters.push((variable.name.clone(), "1"));
                    columns.integers.push(variable.reference);
                }
                _ => {}
            }
        }
        let place = |wanted: &dyn Fn(&str) -> bool| columns.names.iter().position(|(name, _)| wanted(name));
        columns.acceleration = place(&|name| name.starts_with("sensor") && name.ends_with("acceleration"))
            .or_else(|| place(&|name| name == "housing.ay"));
        columns.names.extend(counters);
        columns
    }
}

/// Runs an initialized simulation over the grid and writes one row at the start and one after each step. Gives the
/// acceleration of these rows, if there is one.
pub fn write(
    simulation: &mut Simulation,
    columns: &Columns,
    grid: Grid,
    out: &mut impl Write,
    mut recording: Option<&mut Recording>,
) -> Result<Vec<f64>> {
    let names = columns.names.iter().map(|(name, unit)| (name.as_str(), *unit));
    csv::header(out, std::iter::once(("time", "s")).chain(names))?;
    let mut reals = vec![0.0; columns.reals.len()];
    let mut integers = vec![0; columns.integers.len()];
    let mut acceleration = Vec::new();
    for index in 0..=grid.count {
        if index > 0 {
            let at = simulation.time();
            simulation.step(grid.step).with_context(|| format!("at {at} s"))?;
            if let Some(recording) = &mut recording {
                recording.keep_up(simulation)?;
            }
        }
        read(simulation, columns, &mut reals, &mut integers)?;
        acceleration.extend(columns.acceleration.map(|place| reals[place]));
        let counts = integers.iter().map(|&count| f64::from(count));
        csv::row(out, std::iter::once(simulation.time()).chain(reals.iter().copied()).chain(counts))?;
    }
    Ok(acceleration)
}

fn read(
    simulation: &mut Simulation,
    columns: &Columns,
    reals: &mut [f64],
    integers: &mut [i32],
) -> Result<(), SimulationError> {
    simulation.reals(&columns.reals, reals)?;
    simulation.integers(&columns.integers, integers)
}

/// The command: `<folder>/<scene>.csv`, `.npy` where the scene has a recorder, and, if wanted, `.svg` and `.png`.
pub fn command(project: &Project, model: Model, grid: Grid, folder: &Path, figure: bool) -> Result<()> {
    let mut simulation = model.simulation;
    let columns = Columns::new(simulation.table());
    // The recording grows in a folder of its own, so that it too is whole before it takes the place of an earlier one.
    let growing = whole_file::folder_in(folder)?;
    simulation.record_into(&growing.path().to_string_lossy());
    simulation.initialize(0.0).context("initial equilibrium")?;
    let mut recording = Recording::begin(&simulation, &model.scene.name)?;
    let path = folder.join(format!("{}.csv", model.scene.name));
    let mut acceleration = Vec::new();
    whole_file::write_with(&path, |mut out| {
        acceleration = write(&mut simulation, &columns, grid, &mut out, recording.as_mut())?;
        Ok(recording.as_mut().map_or(Ok(()), |recording| recording.store(&mut simulation))?)
    })?;
    println!("{}", path.display());
    if let Some(file) = recording.map(|recording| recording.path().to_owned()) {
        println!("{}", whole_file::take_out(&file, folder)?.display());
    }
    if figure {
        let mut files = vec![path];
        files.extend(write_envelope(&model.scene, &acceleration, grid, folder)?);
        let python = Python::prepare(project)?;
        print!("{}", python.run("run_figure.py", &files)?);
    }
    Ok(())
}

/// Spectrum of the acceleration's envelope as `<scene>-envelope.csv`, and beside it, as `.json`, band, width of a line
/// and the frequencies to mark; nothing where the run is too short or too coarse, or nothing shakes.
fn write_envelope(scene: &Scene, acceleration: &[f64], grid: Grid, folder: &Path) -> Result<Option<PathBuf>> {
    let (rate, speed) = (1.0 / grid.step, scene.shaft_speed / TAU);
    let Some(characteristic) = envelope_spectrum::frequencies(scene) else { return Ok(None) };
    let shortest = libm::ceil(100.0 * envelope_spectrum::FEWEST_PASSAGES / characteristic.bpfo) / 100.0;
    if !acceleration.is_empty() && acceleration.len() as f64 * grid.step < shortest {
        eprintln!(
            "note: no spectrum of the envelope: its lines would run into each other; --stop {shortest:.2} is enough"
        );
    }
    let Some(found) = EnvelopeSpectrum::of(acceleration, rate, characteristic, speed) else { return Ok(None) };
    let path = folder.join(format!("{}-envelope.csv", scene.name));
    whole_file::write_with(&path, |mut out| {
        csv::header(&mut out, [("frequency", "Hz"), ("amplitude", "1")].into_iter())?;
        for (&frequency, &amplitude) in found.frequency.iter().zip(&found.amplitude) {
            csv::row(&mut out, [frequency, amplitude].into_iter())?;
        }
        Ok(())
    })?;
    let said = serde_json::json!({
        "band_hz": [found.band.low, found.band.high],
        "line_width_hz": found.line_width,
        "rate_hz": rate,
        "frequencies_hz": {
            "BPFO": characteristic.bpfo,
            "BPFI": characteristic.bpfi,
            "2 BSF": 2.0 * characteristic.bsf,
            "FTF": characteristic.ftf,
        },
    });
    whole_file::write(&path.with_extension("json"), serde_json::to_string_pretty(&said)? + "\n")?;
    Ok(Some(path))
}
