//! A run without a host: the simulation is stepped directly, with its inputs at their start values.

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, bail};
use brinell::recording::Recording;
use brinell::scene::Experiment;
use brinell::simulation::variables::{Causality, Kind, Variable};
use brinell::simulation::{Simulation, SimulationError};

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
}

impl Columns {
    /// All of the table but parameters, reals first.
    pub fn new(table: &[Variable]) -> Self {
        let mut columns = Self { names: Vec::new(), reals: Vec::new(), integers: Vec::new() };
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
        columns.names.extend(counters);
        columns
    }
}

/// Runs an initialized simulation over the grid and writes one row at the start and one after each step.
pub fn write(
    simulation: &mut Simulation,
    columns: &Columns,
    grid: Grid,
    out: &mut impl Write,
    mut recording: Option<&mut Recording>,
) -> Result<()> {
    let names = columns.names.iter().map(|(name, unit)| (name.as_str(), *unit));
    csv::header(out, std::iter::once(("time", "s")).chain(names))?;
    let mut reals = vec![0.0; columns.reals.len()];
    let mut integers = vec![0; columns.integers.len()];
    for index in 0..=grid.count {
        if index > 0 {
            let at = simulation.time();
            simulation.step(grid.step).with_context(|| format!("at {at} s"))?;
            if let Some(recording) = &mut recording {
                recording.keep_up(simulation)?;
            }
        }
        read(simulation, columns, &mut reals, &mut integers)?;
        let counts = integers.iter().map(|&count| f64::from(count));
        csv::row(out, std::iter::once(simulation.time()).chain(reals.iter().copied()).chain(counts))?;
    }
    Ok(())
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
    whole_file::write_with(&path, |mut out| {
        write(&mut simulation, &columns, grid, &mut out, recording.as_mut())?;
        Ok(recording.as_mut().map_or(Ok(()), |recording| recording.store(&mut simulation))?)
    })?;
    println!("{}", path.display());
    if let Some(file) = recording.map(|recording| recording.path().to_owned()) {
        println!("{}", whole_file::take_out(&file, folder)?.display());
    }
    if figure {
        let python = Python::prepare(project)?;
        print!("{}", python.run("run_figure.py", [&path])?);
    }
    Ok(())
}
