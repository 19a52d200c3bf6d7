//! The commands: what a user types, and the order of work behind each.

use std::env;
use std::path::PathBuf;

use anyhow::{Context, Result};
use brinell::scene::Experiment;
use brinell_analysis::recording::Speed;
use clap::{Args, Parser, Subcommand};

use crate::library::{self, Library};
use crate::new_scene::{self, Spall};
use crate::numbers::{number, seed, whole};
use crate::reference::Reference;
use crate::run::grid::Grid;
use crate::run::noise::Noise;
use crate::run::speed_profile::SpeedProfile;
use crate::run::table::Format;
use crate::run::wav::Wav;
use crate::{
    catalogue, check, contact, demo, fmu, model::Model, modes, project::Project, run, scenes, schema, size, stiffness,
};

/// Rolling bearings with a real surface defect as FMI co-simulation units.
#[derive(Debug, Parser)]
#[command(name = "brinell", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// What a user can ask for.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Builds the FMU of each scene
    Build(Build),
    /// Simulates a scene without a host and writes its signals, a figure, sound, a page to look at
    Run(Run),
    /// Unzips, validates, loads and steps an FMU
    Check(Check),
    /// Static stiffness, load distribution and critical load over the cage angle: CSV, figure and summary
    Stiffness(Stiffness),
    /// Natural frequencies, damping ratios and mode shapes over the cage angle: JSON, figure and summary
    Modes(Modes),
    /// Pressure of one ball on a raceway as measured, and the stresses below: JSON on standard output, CSV, figure
    Contact(Contact),
    /// Length of a spall from recordings of one bearing, or why there is none: JSON on standard output, figures
    Size(Size),
    /// Builds the FMU of a spalled 6205 bearing, drives it with fmpy and draws what happens
    Demo(Demo),
    /// Lists the shipped scenes, or writes the files of those that are named
    Scenes(Scenes),
    /// Writes a commented scene of a bearing of the catalogue that runs as it is
    New(New),
    /// Lists bearings that a scene can name: dimensions with their source, assumed ones marked
    Catalogue(Catalogue),
    /// Prints the JSON schema of scene files, by which editors complete and explain their keys
    Schema,
}

/// Options of `build`.
#[derive(Debug, Args)]
pub struct Build {
    /// Scene files (TOML), or names of shipped scenes
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Folder for the FMUs [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Version of the FMI standard
    #[arg(long, value_enum, default_value_t, value_name = "VERSION")]
    fmi: fmu::Version,
    /// Beside each FMU the inputs, outputs and options of a reference run, as the FMI cross-check wants them; an FMU of
    /// FMI 3.0 holds them as well
    #[arg(long)]
    reference: bool,
    #[command(flatten)]
    library: LibraryChoice,
}

/// Options of `run`.
#[derive(Debug, Args)]
pub struct Run {
    /// Scene file (TOML), or the name of a shipped scene
    scene: PathBuf,
    /// Stop time in seconds [default: the scene's]
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = number)]
    stop: Option<f64>,
    /// Communication step in seconds [default: the scene's]
    #[arg(long, value_name = "H", allow_negative_numbers = true, value_parser = number)]
    step: Option<f64>,
    /// Columns beside the time, separated by commas; * stands for any characters [default: all]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    columns: Vec<String>,
    /// What the table is written as
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: Format,
    /// The shaft's speed over time: CSV with the columns time_s and speed_hz; the run then ends with it
    #[arg(long, value_name = "FILE")]
    speed_profile: Option<PathBuf>,
    /// Noise of the sensors: their signal's root mean square over its own, in decibels
    #[arg(long, value_name = "DB", allow_negative_numbers = true, value_parser = number)]
    noise_db: Option<f64>,
    /// Which noise: equal seeds give equal bits
    #[arg(
        long,
        value_name = "SEED",
        default_value_t = 1,
        requires = "noise_db",
        allow_negative_numbers = true,
        value_parser = seed,
    )]
    noise_seed: u64,
    /// Write what the sensors show as sound, through the recorder's filter against aliases
    #[arg(long)]
    wav: bool,
    /// Its samples per second [default: the scene's recorder's, or 51200]
    #[arg(long, value_name = "HZ", requires = "wav", allow_negative_numbers = true, value_parser = number)]
    wav_rate: Option<f64>,
    /// Acceleration in m/s² that becomes 1 in it
    #[arg(
        long,
        value_name = "M_S2",
        default_value_t = 1.0,
        requires = "wav",
        allow_negative_numbers = true,
        value_parser = number,
    )]
    wav_scale: f64,
    /// Write a page to look at in a browser: signals, path over the defect, spectra
    #[arg(long)]
    html: bool,
    /// Folder for what is written [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figure out; without --html no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

impl Run {
    fn options(&self, experiment: &Experiment) -> Result<run::Options> {
        let profile = self.speed_profile.as_deref().map(SpeedProfile::read).transpose()?;
        let stop = self.stop.or(profile.as_ref().map(SpeedProfile::end));
        let grid = Grid::new(experiment, stop, self.step)?;
        if let (Some(profile), Some(file)) = (&profile, &self.speed_profile) {
            profile.check_covers(grid.end()).with_context(|| file.display().to_string())?;
        }
        let wav = self.wav.then_some(Wav { rate: self.wav_rate, scale: self.wav_scale });
        wav.map_or(Ok(()), |wav| wav.check())?;
        Ok(run::Options {
            grid,
            columns: self.columns.clone(),
            format: self.format,
            profile,
            noise: self.noise_db.map(|ratio| Noise::new(ratio, self.noise_seed)).transpose()?,
            wav,
            figure: !self.no_figure,
            page: self.html,
        })
    }
}

/// Options of `check`.
#[derive(Debug, Args)]
pub struct Check {
    /// The FMU
    #[arg(value_name = "FILE.fmu")]
    fmu: PathBuf,
}

/// Options of `stiffness`.
#[derive(Debug, Args)]
pub struct Stiffness {
    /// Scene file (TOML), or the name of a shipped scene
    scene: PathBuf,
    /// Load in newtons along the scene's load [default: the scene's]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    load: Option<f64>,
    /// Cage angles within one element spacing [default: 200, more for a short defect]; those at which elements begin to
    /// carry are added
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true, value_parser = whole::<1, 100_000>)]
    points: Option<u32>,
    /// Folder for CSV and figure [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figure out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

/// Options of `modes`.
#[derive(Debug, Args)]
pub struct Modes {
    /// Scene file (TOML); its cage stands still
    scene: PathBuf,
    /// Load in newtons along the scene's load; of a scene without load, on the shaft and downwards, wherever that is
    /// held [default: the scene's]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    load: Option<f64>,
    /// Cage angles within one element spacing [default: 200, more for a short defect]; those at which elements begin
    /// to be pressed are added
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true, value_parser = whole::<1, 100_000>)]
    points: Option<u32>,
    /// Folder for JSON and figure [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figure out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

/// Options of `contact`.
#[derive(Debug, Args)]
pub struct Contact {
    /// Scene file (TOML) of a ball bearing, or the name of a shipped scene; nothing moves
    scene: PathBuf,
    /// The raceway
    #[arg(long, value_enum)]
    on: contact::On,
    /// Angle of the ball in degrees from the middle of the raceway's first defect, counter-clockwise about the
    /// bearing's axis in the ring's own frame: 0 is over the middle, half the defect's length over its end
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = number)]
    angle: f64,
    /// Contact force in newtons
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    force: f64,
    /// Cells along and across the raceway, over the contact and a little more
    #[arg(long, value_name = "CELLS", default_value_t = 512)]
    resolution: usize,
    /// Folder for CSV, JSON and figure [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figure out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

/// Options of `size`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("shaft").required(true))]
pub struct Size {
    /// Recordings of one bearing: .csv, .txt, .npy or .wav
    #[arg(required = true, value_name = "RECORDING")]
    recordings: Vec<PathBuf>,
    /// Scene file (TOML) of the bearing, its load and, if known, its rig; its defect is not looked at
    #[arg(long)]
    scene: PathBuf,
    /// Sampling rate in hertz [default: the file's own]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, value_parser = number)]
    rate: Option<f64>,
    /// Shaft speed in hertz: one for all recordings, or one for each, separated by commas
    #[arg(
        long,
        value_name = "HZ",
        value_delimiter = ',',
        group = "shaft",
        allow_negative_numbers = true,
        value_parser = number,
    )]
    speed: Vec<f64>,
    /// Column of a tachometer, by name or by number from 1
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    tacho: Option<String>,
    /// Pulses of the tachometer per shaft turn
    #[arg(
        long,
        value_name = "COUNT",
        default_value_t = 1,
        allow_negative_numbers = true,
        value_parser = whole::<1, 10_000>,
    )]
    pulses: u32,
    /// Column of the shaft's speed at every sample, in hertz unless its heading says rpm or rad/s
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    speed_column: Option<String>,
    /// Column of the signal, by name or by number from 1 [default: the acceleration]
    #[arg(long, value_name = "COLUMN")]
    column: Option<String>,
    /// Folder for averaged passages and figures [default: the current one]
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

/// Options of `demo`.
#[derive(Debug, Args)]
pub struct Demo {
    /// Folder for CSV and figure [default: brinell-demo]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryChoice,
}

/// Options of `scenes`.
#[derive(Debug, Args)]
pub struct Scenes {
    /// Names of shipped scenes whose files are written
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Folder for the files [default: the current one]
    #[arg(short, long, value_name = "DIR", requires = "names")]
    output: Option<PathBuf>,
}

/// Options of `new`.
#[derive(Debug, Args)]
pub struct New {
    /// Name of the scene: letters, digits, - and _
    #[arg(value_name = "NAME")]
    name: String,
    /// The bearing, as `brinell catalogue` lists it
    #[arg(long, value_name = "NAME", default_value = "6205")]
    bearing: String,
    /// A spall: outer, inner or element, a colon and its length in mm or deg [default: none]
    #[arg(long, value_name = "inner:1.2mm")]
    defect: Option<Spall>,
    /// Folder for the file [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Options of `catalogue`.
#[derive(Debug, Args)]
pub struct Catalogue {
    /// How the names begin, as 62
    #[arg(value_name = "FILTER", default_value = "", hide_default_value = true)]
    filter: String,
}

#[derive(Debug, Args)]
struct LibraryChoice {
    /// Compiled model library to pack, instead of building it from source; so does the environment's BRINELL_LIBRARY
    #[arg(long, value_name = "PATH", conflicts_with = "platforms")]
    library: Option<PathBuf>,
    /// Platforms to pack the library for: all, or a list of linux64, win64, darwin64, aarch64-linux
    /// [default: all that this program holds; where it compiles them, this machine's]
    #[arg(long, value_name = "PLATFORM,…", value_delimiter = ',')]
    platforms: Vec<String>,
}

impl From<LibraryChoice> for library::Choice {
    fn from(choice: LibraryChoice) -> Self {
        let named = || env::var_os("BRINELL_LIBRARY").map(PathBuf::from).filter(|_| choice.platforms.is_empty());
        Self { file: choice.library.or_else(named), platforms: choice.platforms }
    }
}

impl Arguments {
    /// Does what was asked. An error is one line for the user.
    pub fn execute(self) -> Result<()> {
        self.command.execute(&Project::of_user())
    }
}

impl Command {
    /// Does what was asked. An error is one line for the user.
    pub fn execute(self, project: &Project) -> Result<()> {
        match self {
            Command::Build(options) => build(project, options),
            Command::Run(options) => {
                let model = Model::read(&options.scene)?;
                let wanted = options.options(&model.scene.experiment)?;
                let folder = options.output.unwrap_or_else(|| project.results("run"));
                run::command(project, model, &wanted, &folder)
            }
            Command::Check(options) => check::command(project, &options.fmu),
            Command::Stiffness(options) => {
                let model = Model::read(&options.scene)?;
                let folder = options.output.unwrap_or_else(|| project.results("stiffness"));
                let wanted = swept(options.load, options.points, options.no_figure);
                stiffness::command(project, &model, wanted, &folder)
            }
            Command::Modes(options) => {
                let model = Model::read(&options.scene)?;
                let folder = options.output.unwrap_or_else(|| project.results("modes"));
                let wanted = swept(options.load, options.points, options.no_figure);
                modes::command(project, &model, wanted, &folder)
            }
            Command::Contact(options) => {
                let wanted = contact::Options {
                    on: options.on,
                    angle_deg: options.angle,
                    force: options.force,
                    resolution: options.resolution,
                    figure: !options.no_figure,
                };
                let folder = options.output.unwrap_or_else(|| project.results("contact"));
                contact::command(project, &options.scene, &wanted, &folder)
            }
            Command::Size(options) => {
                let wanted = size::Options {
                    rate: options.rate,
                    speeds: options.speeds(),
                    column: options.column.clone(),
                    figure: !options.no_figure,
                };
                let folder = options.output.unwrap_or_else(|| project.results("size"));
                size::command(project, &options.scene, &options.recordings, &wanted, &folder)
            }
            Command::Demo(options) => {
                let folder = options.output.unwrap_or_else(|| project.results("demo"));
                demo::command(project, &options.library.into(), &folder)
            }
            Command::Scenes(options) => scenes::command(&options.names, &options.output.unwrap_or_default()),
            Command::New(options) => {
                let folder = options.output.unwrap_or_default();
                new_scene::command(&options.name, &options.bearing, options.defect.as_ref(), &folder)
            }
            Command::Catalogue(options) => catalogue::command(&options.filter),
            Command::Schema => {
                print!("{}", schema::text()?);
                Ok(())
            }
        }
    }
}

fn build(project: &Project, options: Build) -> Result<()> {
    let read = |path: &PathBuf| {
        let mut model = Model::read(path)?;
        if options.reference {
            model.reference = Some(Reference::of(&model).with_context(|| path.display().to_string())?);
        }
        Ok(model)
    };
    // Scenes first: a typing error should not wait for a compiler.
    let models = options.scenes.iter().map(read).collect::<Result<Vec<_>>>()?;
    let library = Library::obtain(project, &options.library.into())?;
    for line in library.describe() {
        println!("{line}");
    }
    let folder = options.output.unwrap_or_else(|| project.results("fmu"));
    for model in &models {
        if let Some(reference) = &model.reference {
            for path in reference.write(&folder)? {
                println!("{}", path.display());
            }
        }
        let path = fmu::write(model, &library, options.fmi, &folder)?;
        println!("{}", path.display());
    }
    Ok(())
}

/// What the commands that sweep the cage angle are told.
fn swept(load: Option<f64>, points: Option<u32>, no_figure: bool) -> stiffness::Options {
    stiffness::Options { load, points: points.map(|count| count as usize), figure: !no_figure }
}
