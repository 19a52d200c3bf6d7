//! The commands: what a user types, and the order of work behind each.

use std::path::{Path, PathBuf};

use anyhow::Result;
use brinell::analysis::recording::Speed;
use clap::{Args, Parser, Subcommand};

use crate::library::{self, Library};
use crate::{check, demo, fmu, model::Model, project::Project, report, run, size, stiffness, validation};

/// Rolling bearings with a real surface defect as FMI 2.0 co-simulation units.
#[derive(Debug, Parser)]
#[command(name = "cargo fmu", bin_name = "cargo fmu", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Builds the FMU of each scene
    Build(Build),
    /// Simulates a scene without a host and writes CSV and figure
    Run(Run),
    /// Unzips, validates, loads and steps an FMU
    Check(Check),
    /// Static stiffness, load distribution and critical load over the cage angle: CSV, figure and summary
    Stiffness(Stiffness),
    /// Error against run time, measured on this machine: Markdown, CSV and figures
    Report(Report),
    /// Length of a spall from recordings of one bearing, or why there is none: JSON on standard output, figures
    Size(Size),
    /// Computes every claim of the paper anew: docs/validation.md and its figures
    Validate(Validate),
    /// Builds the FMU of a spalled 6205 bearing, drives it with fmpy and draws what happens
    Demo(Demo),
}

#[derive(Debug, Args)]
struct Build {
    /// Scene files (TOML)
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Folder for the FMUs [default: target/fmu]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryChoice,
}

#[derive(Debug, Args)]
struct Run {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Stop time in seconds [default: the scene's]
    #[arg(long, value_name = "S")]
    stop: Option<f64>,
    /// Communication step in seconds [default: the scene's]
    #[arg(long, value_name = "H")]
    step: Option<f64>,
    /// Folder for CSV and figure [default: target/run]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figure out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

#[derive(Debug, Args)]
struct Check {
    /// The FMU
    #[arg(value_name = "FILE.fmu")]
    fmu: PathBuf,
}

#[derive(Debug, Args)]
struct Stiffness {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Load in newtons along the scene's load [default: the scene's]
    #[arg(long, value_name = "N")]
    load: Option<f64>,
    /// Cage angles within one element spacing [default: 200, more for a short defect]; those at which elements begin to
    /// carry are added
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    points: Option<u32>,
    /// Folder for CSV and figure [default: target/stiffness]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figure out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

#[derive(Debug, Args)]
struct Report {
    /// Two scenes and few tolerances only
    #[arg(long)]
    short: bool,
    /// Only which method steps and what a step costs
    #[arg(long, conflicts_with = "short")]
    steps: bool,
    /// Folder for the page, its figures and its data [default: docs; target/report with --short]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("shaft").required(true))]
struct Size {
    /// Recordings of one bearing: .csv, .txt, .npy or .wav
    #[arg(required = true, value_name = "RECORDING")]
    recordings: Vec<PathBuf>,
    /// Scene file (TOML) of the bearing, its load and, if known, its rig; its defect is not looked at
    #[arg(long)]
    scene: PathBuf,
    /// Sampling rate in hertz [default: the file's own]
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// Shaft speed in hertz: one for all recordings, or one for each, separated by commas
    #[arg(long, value_name = "HZ", value_delimiter = ',', group = "shaft")]
    speed: Vec<f64>,
    /// Column of a tachometer, by name or by number from 1
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    tacho: Option<String>,
    /// Pulses of the tachometer per shaft turn
    #[arg(long, value_name = "COUNT", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pulses: u32,
    /// Column of the shaft's speed at every sample, in hertz unless its heading says rpm or rad/s
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    speed_column: Option<String>,
    /// Column of the signal, by name or by number from 1 [default: the acceleration]
    #[arg(long, value_name = "COLUMN")]
    column: Option<String>,
    /// Folder for averaged passages and figures [default: target/size]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figures out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

impl Size {
    fn speeds(&self) -> Vec<Speed> {
        if let Some(column) = &self.tacho {
            vec![Speed::Tachometer(column.clone(), self.pulses)]
        } else if let Some(column) = &self.speed_column {
            vec![Speed::Column(column.clone())]
        } else {
            self.speed.iter().map(|&speed| Speed::Constant(speed)).collect()
        }
    }
}

#[derive(Debug, Args)]
struct Validate {
    /// Recordings to be sized, as FILE@HZ=DEGREES with the shaft's speed and the nominal length, 0 if healthy; without them the
    /// table of recordings stays as it was
    #[arg(value_name = "RECORDING")]
    recordings: Vec<String>,
    /// Sampling rate of the recordings in hertz
    #[arg(long, value_name = "HZ", default_value_t = 51_200.0)]
    rate: f64,
    /// Compute this part alone; the other tables are those of the last run
    #[arg(long, value_enum, value_name = "PART")]
    only: Option<validation::Part>,
    /// Folder for validation.md and figures [default: docs]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figures out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

#[derive(Debug, Args)]
struct Demo {
    /// Folder for CSV and figure [default: target/demo]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryChoice,
}

#[derive(Debug, Args)]
struct LibraryChoice {
    /// Compiled model library to pack, instead of building it from source
    #[arg(long, value_name = "PATH", conflicts_with = "target")]
    library: Option<PathBuf>,
    /// Platform to compile for: linux64, win64, darwin64, aarch64-linux, or Rust's name of it; may be given several times
    /// [default: this one's]
    #[arg(long, value_name = "PLATFORM")]
    target: Vec<String>,
}

impl From<LibraryChoice> for library::Choice {
    fn from(choice: LibraryChoice) -> Self {
        Self { file: choice.library, platforms: choice.target }
    }
}

impl Arguments {
    /// Does what was asked. An error is one line for the user.
    pub fn execute(self) -> Result<()> {
        let project = Project::find();
        match self.command {
            Command::Build(build) => {
                // Scenes first: a typing error should not wait for a compiler.
                let models = build.scenes.iter().map(|path| Model::read(path)).collect::<Result<Vec<_>>>()?;
                let library = Library::obtain(&project, &build.library.into())?;
                for line in library.describe() {
                    println!("{line}");
                }
                let folder = build.output.unwrap_or_else(|| project.target().join("fmu"));
                for model in &models {
                    let path = fmu::write(model, &library, &folder)?;
                    println!("{}", path.display());
                }
                Ok(())
            }
            Command::Run(options) => {
                let model = Model::read(&options.scene)?;
                let grid = run::Grid::new(&model.scene.experiment, options.stop, options.step)?;
                let folder = options.output.unwrap_or_else(|| project.target().join("run"));
                run::command(&project, model, grid, &folder, !options.no_figure)
            }
            Command::Check(options) => check::command(&project, &options.fmu),
            Command::Stiffness(options) => {
                let model = Model::read(&options.scene)?;
                let folder = options.output.unwrap_or_else(|| project.target().join("stiffness"));
                let wanted = stiffness::Options {
                    load: options.load,
                    points: options.points.map(|count| count as usize),
                    figure: !options.no_figure,
                };
                stiffness::command(&project, &model, wanted, &folder)
            }
            Command::Report(options) => {
                let folder = if options.short {
                    project.target().join("report")
                } else {
                    project.source().unwrap_or(Path::new(".")).join("docs")
                };
                let folder = options.output.unwrap_or(folder);
                if options.steps {
                    return report::steps_command(&project, &folder);
                }
                let extent = if options.short { report::Extent::Short } else { report::Extent::Full };
                report::command(&project, extent, &folder)
            }
            Command::Size(options) => {
                let wanted = size::Options {
                    rate: options.rate,
                    speeds: options.speeds(),
                    column: options.column.clone(),
                    figure: !options.no_figure,
                };
                let folder = options.output.unwrap_or_else(|| project.target().join("size"));
                size::command(&project, &options.scene, &options.recordings, &wanted, &folder)
            }
            Command::Validate(options) => {
                let known = options.recordings.iter().map(|text| validation::recordings::Known::parse(text));
                let wanted = validation::Options {
                    recordings: known.collect::<Result<_>>()?,
                    rate: options.rate,
                    only: options.only,
                    figures: !options.no_figure,
                };
                let docs = project.source().unwrap_or(Path::new("")).join("docs");
                validation::command(&project, &wanted, &options.output.unwrap_or(docs))
            }
            Command::Demo(options) => {
                let folder = options.output.unwrap_or_else(|| project.target().join("demo"));
                demo::command(&project, &options.library.into(), &folder)
            }
        }
    }
}
