//! Reference results: what an importer is to find when it runs an FMU, and by which inputs.
//!
//! Three files after the FMI cross-check rules, version 4.1 (modelica/fmi-cross-check, sections 9.1.4 and 10):
//! `<name>_ref.csv`, `<name>_in.csv` and `<name>_ref.opt`. The FMU holds them as well, described by the layered
//! standard FMI-LS-REF 1.0.0-beta.1 in `extra/org.fmi-standard.fmi-ls-ref`, with the experiment, `<name>.exp`, in the
//! Modelica Association's draft of an experiments format.
//!
//! The run is the scene's default experiment. Inputs stand at their start values, except of a shaft that hosts move: at
//! its start value it would hang in the clearance and touch nothing. It goes down through the clearance until the
//! elements are pressed, and back, y = −D (1 − cos 2πt/T)/2, with the velocity and acceleration that belong to it.
//! Inputs are set at each communication point, as importers do that do not interpolate.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use brinell::scene::{Experiment, Motion, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind};
use minijinja::context;

use super::archive::Archive;
use super::template::render;
use crate::shared::{Grid, csv, whole_file};

/// The rules recommend at most ten variables and want at most a megabyte: so many steps of ten columns are 0.2 MB.
const MOST_VARIABLES: usize = 10;
const MOST_STEPS: f64 = 1000.0;
const LARGEST: usize = 1_000_000;
/// What is worth comparing, by name; the first ten that the scene has as outputs.
const IMPORTANT: [&str; 15] = [
    "cage.angle",
    "shaft.x",
    "shaft.y",
    "shaft.force.x",
    "shaft.force.y",
    "shaft.mean_force.y",
    "housing.force.y",
    "housing.x",
    "housing.y",
    "housing.ay",
    "sensor.acceleration",
    "sensor[1].acceleration",
    "probe.x",
    "probe.y",
    "shaft.torque",
];
/// How far a hosted shaft goes beyond the clearance, as a share of the elements' diameter: some 10 µm in a 6205, which
/// then carries some 600 N.
const PRESSED: f64 = 1.2e-3;
/// Where the layered standard has its files.
const FOLDER: &str = "extra/org.fmi-standard.fmi-ls-ref";

/// A reference run of a scene, as files.
#[derive(Debug, Clone)]
pub struct Reference {
    name: String,
    /// Time and outputs at each communication point.
    results: String,
    /// Time and inputs, to be interpolated linearly; none where the scene has no inputs.
    inputs: Option<String>,
    /// Times, communication step and tolerance.
    options: String,
    /// The same and the files' names, as XML.
    experiment: String,
}

impl Reference {
    /// Runs a simulation of the scene as it is.
    ///
    /// # Errors
    /// What ends a run; a file that would be larger than the rules allow.
    pub fn of(scene: &Scene, mut simulation: Simulation) -> Result<Self> {
        let grid = grid(scene)?;
        let stimuli = Stimuli::of(&simulation, scene, grid);
        let outputs = outputs(&simulation);
        let mut results = header(outputs.iter().map(|(name, _)| *name));
        let references: Vec<u32> = outputs.iter().map(|&(_, reference)| reference).collect();
        let rows = rows(&mut simulation, &stimuli, &references, grid).context("reference run")?;
        results += &String::from_utf8(rows)?;
        let inputs = if stimuli.names.is_empty() { None } else { Some(stimuli.csv(grid)?) };
        let stop = grid.end();
        let options = format!(
            "StartTime, 0.0\nStopTime, {stop:?}\nStepSize, {:?}\nRelTol, {:?}\nOutputIntervalLength, {:?}\n",
            grid.step, scene.tolerance, grid.step
        );
        for text in [Some(&results), inputs.as_ref()].into_iter().flatten() {
            ensure!(text.len() <= LARGEST, "reference file of {} bytes: at most {LARGEST} are allowed", text.len());
        }
        let values = context! {
            name => &scene.name,
            stop => format!("{stop:?}"),
            step => format!("{:?}", grid.step),
            tolerance => format!("{:?}", scene.tolerance),
            inputs => inputs.is_some(),
        };
        let experiment = render("experiment", include_str!("../../assets/experiments.xml"), values)?;
        Ok(Self { name: scene.name.clone(), results, inputs, options, experiment })
    }

    /// The files: name, type, role in the layered standard, what it is, text.
    fn files(&self) -> Vec<(String, [&'static str; 3], &str)> {
        let name = |end| format!("{}_{end}", self.name);
        let mut files = vec![
            (name("ref.csv"), ["text/csv", "result", "Outputs of the default experiment"], self.results.as_str()),
            (name("ref.opt"), ["text/plain", "configuration", "Times, step and tolerance"], self.options.as_str()),
        ];
        if let Some(inputs) = &self.inputs {
            files.push((name("in.csv"), ["text/csv", "testcase", "Inputs of the default experiment"], inputs));
        }
        files
    }

    /// Writes the files into a folder and gives their paths.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>> {
        let files = self.files().into_iter();
        files
            .map(|(name, _, text)| {
                let path = folder.join(name);
                whole_file::write(&path, text)?;
                Ok(path)
            })
            .collect()
    }

    /// Puts the files into an FMU, with the experiment that they belong to and the manifest.
    pub(crate) fn add_to(&self, archive: &mut Archive) -> Result<()> {
        for (name, _, text) in self.files() {
            archive.add(format!("{FOLDER}/{name}"), text)?;
        }
        archive.add(format!("{FOLDER}/{}.exp", self.name), self.experiment.as_str())?;
        archive.add(format!("{FOLDER}/fmi-ls-manifest.xml"), self.manifest()?)?;
        Ok(archive.add(
            "documentation/fmi-ls-ref.txt",
            "Run the FMU with the inputs of *_in.csv, set at each communication point, from StartTime to StopTime with \
             the communication step StepSize of *_ref.opt: its outputs are those of *_ref.csv. After the first impacts \
             of a spall runs part: of those within 1e-12 of each other some 1e-3 of the load is left after 0.1 s.\n",
        )?)
    }

    fn manifest(&self) -> Result<String> {
        let files = self.files().into_iter();
        let mut files: Vec<_> =
            files.map(|(name, [kind, role, description], _)| context! { name, kind, role, description }).collect();
        files.push(context! {
            name => format!("{}.exp", self.name),
            kind => "application/x-ma-hs-experiments",
            role => "experiment/smoke-test",
            description => "The default experiment with its inputs and outputs",
        });
        render("fmi-ls-manifest.xml", include_str!("../../assets/fmi-ls-manifest.xml"), context! { files })
    }
}

/// The scene's default experiment, by as many of its steps at once as keep the files small.
fn grid(scene: &Scene) -> Result<Grid> {
    let whole = Grid::even(&scene.experiment)?;
    let together = (whole.count as f64 / MOST_STEPS).ceil();
    Grid::even(&Experiment { step: whole.step * together, ..scene.experiment })
}

/// The outputs that are compared: name and reference. Those of elements are arrays in FMI 3.0, and not among them.
fn outputs(simulation: &Simulation) -> Vec<(&'static str, u32)> {
    let output = |name: &str| {
        let mut rows = simulation.table().iter();
        rows.find(|row| row.name == name && row.causality == Causality::Output).map(|row| row.reference)
    };
    let present = IMPORTANT.iter().filter_map(|&name| output(name).map(|reference| (name, reference)));
    present.take(MOST_VARIABLES).collect()
}

/// What the host tells the FMU.
struct Stimuli {
    names: Vec<String>,
    references: Vec<u32>,
    start: Vec<f64>,
    /// Of a hosted shaft: columns of y, vy and ay.
    down: Option<[usize; 3]>,
    /// How far the shaft goes down (m), and how long it takes (s).
    depth: f64,
    period: f64,
}

impl Stimuli {
    fn of(simulation: &Simulation, scene: &Scene, grid: Grid) -> Self {
        let mut stimuli = Self {
            names: Vec::new(),
            references: Vec::new(),
            start: Vec::new(),
            down: None,
            depth: scene.bearing.radial_clearance.max(0.0) + PRESSED * scene.bearing.element_diameter,
            period: grid.end(),
        };
        for row in simulation.table().iter().filter(|row| row.causality == Causality::Input) {
            if let Kind::Real { start: Some(start), .. } = row.kind {
                stimuli.names.push(row.name.clone());
                stimuli.references.push(row.reference);
                stimuli.start.push(start);
            }
        }
        if scene.shaft.motion == Motion::Host {
            let column = |name: &str| stimuli.names.iter().position(|known| known == name);
            stimuli.down =
                column("shaft.y").zip(column("shaft.vy")).zip(column("shaft.ay")).map(|((y, v), a)| [y, v, a]);
        }
        stimuli
    }

    fn at(&self, time: f64) -> Vec<f64> {
        let mut values = self.start.clone();
        if let Some([y, v, a]) = self.down {
            let (rate, half) = (TAU / self.period, 0.5 * self.depth);
            let (sine, cosine) = (libm::sin(rate * time), libm::cos(rate * time));
            values[y] -= half * (1.0 - cosine);
            values[v] -= half * rate * sine;
            values[a] -= half * rate * rate * cosine;
        }
        values
    }

    /// One row for each communication point; where nothing changes, for the first and the last.
    fn csv(&self, grid: Grid) -> io::Result<String> {
        let mut text = header(self.names.iter().map(String::as_str));
        let every = if self.down.is_some() { 1 } else { grid.count as usize };
        let mut rows = Vec::new();
        for index in (0..=grid.count).step_by(every) {
            let time = index as f64 * grid.step;
            csv::row(&mut rows, std::iter::once(time).chain(self.at(time)))?;
        }
        text += &String::from_utf8(rows).map_err(io::Error::other)?;
        Ok(text)
    }
}

/// The first line of a file: names in quotes.
fn header<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut line = "\"time\"".to_owned();
    for name in names {
        let _ = write!(line, ",\"{name}\"");
    }
    line + "\n"
}

/// The run: one row at the start and one after each step.
fn rows(simulation: &mut Simulation, stimuli: &Stimuli, outputs: &[u32], grid: Grid) -> Result<Vec<u8>> {
    let mut rows = Vec::new();
    let mut values = vec![0.0; outputs.len()];
    simulation.set_reals(&stimuli.references, &stimuli.at(0.0))?;
    simulation.initialize(0.0)?;
    for index in 0..=grid.count {
        let time = index as f64 * grid.step;
        if index > 0 {
            let from = (index - 1) as f64 * grid.step;
            simulation.set_reals(&stimuli.references, &stimuli.at(from))?;
            simulation.step(grid.step)?;
        }
        simulation.reals(outputs, &mut values)?;
        csv::row(&mut rows, std::iter::once(time).chain(values.iter().copied()))?;
    }
    Ok(rows)
}
