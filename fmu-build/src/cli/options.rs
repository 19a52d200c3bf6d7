//! Options of each command.

use std::env;
use std::path::PathBuf;

use anyhow::{Context, Result};
use brinell::scene::Experiment;
use brinell_analysis::recording::{Speed, TextFormat};
use clap::Args;

use crate::commands::size::ShaftSpeed;
use crate::commands::{Asked, Spall, contact, new_scene, size, stiffness};
use crate::package::{Model, library};
use crate::run::noise::Noise;
use crate::run::speed_profile::SpeedProfile;
use crate::run::table::Format;
use crate::run::wav::Wav;
use crate::shared::{Grid, Kind, Names, Project, Version, delimiter, gigapascals, html_file, number, seed, whole};
use crate::{run, sweep};

/// Options of `build`.
#[derive(Debug, Args)]
pub struct Build {
    /// Scene files (TOML), or names of shipped scenes
    #[arg(required = true, value_name = "SCENE")]
    pub(super) scenes: Vec<PathBuf>,
    /// Folder for the FMUs [default: the current one; in the repository of Brinell target/fmu]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    /// Version of the FMI standard
    #[arg(long, value_enum, default_value_t, value_name = "VERSION")]
    pub(super) fmi: Version,
    /// How it is simulated: the FMU integrates, the host does, or either
    #[arg(long, value_enum, default_value_t, value_name = "KIND")]
    pub(super) kind: Kind,
    /// How variables are named: `element[3].path` or `element_3_path`
    #[arg(long, value_enum, default_value_t, value_name = "NAMES")]
    pub(super) names: Names,
    /// FMI 3.0 for hosts without arrays: a variable for each element, counters as Int64
    #[arg(long)]
    pub(super) scalars: bool,
    /// Beside each FMU the inputs, outputs and options of a reference run, as the FMI cross-check wants them; the FMU
    /// holds them as well, by the layered standard FMI-LS-REF
    #[arg(long)]
    pub(super) reference: bool,
    #[command(flatten)]
    pub(super) library: LibraryChoice,
}

/// Options of `run`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("what").required(true))]
pub struct Run {
    /// Scene file (TOML), or the name of a shipped scene
    #[arg(group = "what")]
    pub(super) scene: Option<PathBuf>,
    /// Instead of a scene a bearing that `brinell catalogue` lists, as `brinell new` writes its scene
    #[arg(long, value_name = "NAME", group = "what")]
    pub(super) bearing: Option<String>,
    /// Its spall: outer, inner or element, a colon and its length in mm or deg [default: none]
    #[arg(long, value_name = "inner:1.2mm", requires = "bearing", conflicts_with = "scene")]
    pub(super) defect: Option<Spall>,
    /// Stop time in seconds [default: the scene's]
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = number)]
    pub(super) stop: Option<f64>,
    /// Communication step in seconds [default: the scene's]
    #[arg(long, value_name = "H", allow_negative_numbers = true, value_parser = number)]
    pub(super) step: Option<f64>,
    /// Columns beside the time, separated by commas; * stands for any characters [default: all; in a table
    /// of more than a million numbers sensors, probe, positions and force of the rings, speed and cage]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub(super) columns: Vec<String>,
    /// What the table is written as
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(super) format: Format,
    /// The shaft's speed over time: CSV with the columns time_s and speed_hz; the run then ends with it
    #[arg(long, value_name = "FILE")]
    pub(super) speed_profile: Option<PathBuf>,
    /// Noise of the sensors: their signal's root mean square over its own, in decibels
    #[arg(long, value_name = "DB", allow_negative_numbers = true, value_parser = number)]
    pub(super) noise_db: Option<f64>,
    /// Which noise: equal seeds give equal bits
    #[arg(
        long,
        value_name = "SEED",
        default_value_t = 1,
        requires = "noise_db",
        allow_negative_numbers = true,
        value_parser = seed,
    )]
    pub(super) noise_seed: u64,
    /// Write what the sensors show as sound, through the recorder's filter against aliases
    #[arg(long)]
    pub(super) wav: bool,
    /// Its samples per second [default: the scene's recorder's, or 51200]
    #[arg(long, value_name = "HZ", requires = "wav", allow_negative_numbers = true, value_parser = number)]
    pub(super) wav_rate: Option<f64>,
    /// Acceleration in m/s² that becomes 1 in it
    #[arg(
        long,
        value_name = "M_S2",
        default_value_t = 1.0,
        requires = "wav",
        allow_negative_numbers = true,
        value_parser = number,
    )]
    pub(super) wav_scale: f64,
    /// Write an HTML page for a browser: signals, path over the defect, spectra
    #[arg(long)]
    pub(super) html: bool,
    /// Open the page in the browser; implies --html
    #[arg(long)]
    pub(super) open: bool,
    /// Folder for what is written [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    /// Leave the figure out; without --html no Python is needed then
    #[arg(long)]
    pub(super) no_figure: bool,
}

impl Run {
    pub(super) fn model(&self) -> Result<Model> {
        let Some(scene) = &self.scene else {
            let bearing = self.bearing.as_deref().unwrap_or_default();
            return Model::of_text(
                new_scene::unwritten(bearing, Asked { spall: self.defect.as_ref(), ..Asked::default() })?,
                bearing,
            );
        };
        Model::read(scene)
    }

    pub(super) fn options(&self, experiment: &Experiment) -> Result<run::Options> {
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
            page: self.html || self.open,
            open: self.open,
        })
    }
}

/// Options of `sweep`.
#[derive(Debug, Args)]
pub struct Sweep {
    /// File of the sweep (TOML): which scene is run, and what changes from run to run
    pub(super) file: PathBuf,
    /// Folder for the table; a sweep that was interrupted goes on in it [default: named after the file]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    /// Runs at once [default: as many as there are cores]
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true, value_parser = whole::<1, 4096>)]
    pub(super) jobs: Option<u32>,
    /// Write the signals of the runs as well [default format: npy]
    #[arg(long, value_enum, value_name = "FORMAT", num_args = 0..=1, default_missing_value = "npy")]
    pub(super) signals: Option<sweep::SignalFormat>,
    /// Make part K of N only, on any machine; the same command without it joins all parts in the folder
    #[arg(long, value_name = "K/N")]
    pub(super) part: Option<sweep::Part>,
    /// Print the scene of one run, which `brinell run` takes, and run nothing
    #[arg(long, value_name = "RUN", allow_negative_numbers = true, value_parser = seed)]
    pub(super) scene_of: Option<u64>,
}

impl Sweep {
    pub(super) fn options(&self) -> sweep::Options {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        sweep::Options {
            jobs: self.jobs.map_or_else(cores, |jobs| jobs as usize),
            signals: self.signals,
            part: self.part,
        }
    }
}

/// Options of `check`.
#[derive(Debug, Args)]
pub struct Check {
    /// The FMU
    #[arg(value_name = "FILE.fmu")]
    pub(super) fmu: PathBuf,
    /// Prints what passed as JSON
    #[arg(long)]
    pub(super) json: bool,
}

/// Options of `stiffness` and `modes`, which sweep the cage angle.
#[derive(Debug, Args)]
pub struct OverCageAngle {
    /// Scene file (TOML), or the name of a shipped scene; its cage stands still
    pub(super) scene: PathBuf,
    /// Load in newtons along the scene's load; `modes` takes a scene without load as well, and puts it on the shaft
    /// and downwards, wherever that is held [default: the scene's]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    pub(super) load: Option<f64>,
    /// Cage angles within one element spacing [default: 200, more for a short defect]; those at which elements begin to
    /// carry are added, by `modes` also those at an edge of a defect and where modes change much
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true, value_parser = whole::<1, 100_000>)]
    pub(super) points: Option<u32>,
    /// Print the summary as JSON; files are named on standard error
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) drawn: Drawn,
}

impl OverCageAngle {
    pub(super) fn options(&self) -> stiffness::Options {
        let points = self.points.map(|count| count as usize);
        stiffness::Options { load: self.load, points, figure: !self.drawn.no_figure, json: self.json }
    }
}

/// Where results go, and whether they are drawn.
#[derive(Debug, Args)]
pub(super) struct Drawn {
    /// Folder for what is written [default: the current one]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    /// Leave figures out; no Python is needed then
    #[arg(long)]
    pub(super) no_figure: bool,
}

impl Drawn {
    /// The folder; `results` is the one of the command.
    pub(super) fn folder(&self, project: &Project, results: &str) -> PathBuf {
        self.output.clone().unwrap_or_else(|| project.results(results))
    }
}

/// Options of `contact`.
#[derive(Debug, Args)]
pub struct Contact {
    /// Scene file (TOML) of a ball bearing, or the name of a shipped scene; nothing moves
    pub(super) scene: PathBuf,
    /// The raceway
    #[arg(long, value_enum)]
    pub(super) on: contact::On,
    /// Angle of the ball in degrees from the middle of the raceway's first defect, counter-clockwise about the
    /// bearing's axis in the ring's own frame: 0 is over the middle, half the defect's length over its end
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = number)]
    pub(super) angle: f64,
    /// Contact force in newtons
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    pub(super) force: f64,
    /// Cells along and across the raceway, over the contact and a little more
    #[arg(long, value_name = "CELLS", default_value_t = 512)]
    pub(super) resolution: usize,
    /// Largest pressure in GPa, from 1 to 20, at which the surface yields and stays dented: the indentation hardness, 6
    /// to 7.5 of hardened bearing steel [default: none, the surface stays elastic]
    #[arg(long = "yield", value_name = "GPA", allow_negative_numbers = true, value_parser = gigapascals)]
    pub(super) pressure_limit: Option<f64>,
    #[command(flatten)]
    pub(super) drawn: Drawn,
}

/// Options of `size`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("shaft").required(true))]
#[command(group = clap::ArgGroup::new("which").required(true))]
pub struct Size {
    /// Recordings of one bearing: .csv, .txt, .npy, .npz, .mat or .wav
    #[arg(required = true, value_name = "RECORDING")]
    pub(super) recordings: Vec<PathBuf>,
    /// Scene file (TOML) of the bearing, its load and, if known, its rig; its defect is ignored
    #[arg(long, group = "which")]
    pub(super) scene: Option<PathBuf>,
    /// Instead of a scene a bearing that `brinell catalogue` lists; nothing is known of its rig
    #[arg(long, value_name = "NAME", group = "which")]
    pub(super) bearing: Option<String>,
    /// Load of that bearing in newtons [default: 5 % of the static rating]
    #[arg(long, value_name = "N", requires = "bearing", allow_negative_numbers = true, value_parser = number)]
    pub(super) load: Option<f64>,
    /// Sampling rate in hertz [default: the file's own]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, value_parser = number)]
    pub(super) rate: Option<f64>,
    /// Shaft speed in hertz, or in rpm as in 1797rpm: one for all recordings, or one for each, separated by commas;
    /// LOW..HIGH seeks it by the shaft's own lines, and auto from 5 to 60 Hz
    #[arg(
        long,
        value_name = "HZ|LOW..HIGH|auto",
        value_delimiter = ',',
        group = "shaft",
        allow_negative_numbers = true,
        value_parser = size::shaft_speed,
    )]
    pub(super) speed: Vec<ShaftSpeed>,
    /// Column of a tachometer, by name or by number from 1
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    pub(super) tacho: Option<String>,
    /// Pulses of the tachometer per shaft turn
    #[arg(
        long,
        value_name = "COUNT",
        default_value_t = 1,
        allow_negative_numbers = true,
        value_parser = whole::<1, 10_000>,
    )]
    pub(super) pulses: u32,
    /// Column of the shaft's speed at every sample, in hertz unless its heading says rpm or rad/s
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    pub(super) speed_column: Option<String>,
    /// Channel of the signal, by name or by number from 1, where a file has several
    #[arg(long, value_name = "NAME|NUMBER", alias = "column")]
    pub(super) channel: Option<String>,
    /// What stands between the columns of a text: a sign, tab or blank [default: a comma, of .txt blanks; a semicolon
    /// with --decimal ,]
    #[arg(long, value_name = "SIGN", value_parser = delimiter)]
    pub(super) delimiter: Option<char>,
    /// Decimal sign of a text, a point or a comma [default: .]
    #[arg(long, value_name = "SIGN")]
    pub(super) decimal: Option<char>,
    /// Write an HTML page with what the answer rests on: spectra, combs, averaged passage
    #[arg(long, value_name = "FILE.html", value_parser = html_file)]
    pub(super) report: Option<PathBuf>,
    #[command(flatten)]
    pub(super) drawn: Drawn,
}

impl Size {
    pub(super) fn bearing(&self) -> size::Bearing {
        match (&self.scene, &self.bearing) {
            (Some(scene), _) => size::Bearing::Scene(scene.clone()),
            (None, name) => size::Bearing::Catalogue(name.clone().unwrap_or_default(), self.load),
        }
    }

    pub(super) fn text(&self) -> TextFormat {
        TextFormat { delimiter: self.delimiter, decimal: self.decimal }
    }

    pub(super) fn speeds(&self) -> Vec<ShaftSpeed> {
        if let Some(column) = &self.tacho {
            vec![ShaftSpeed::Stated(Speed::Tachometer(column.clone(), self.pulses))]
        } else if let Some(column) = &self.speed_column {
            vec![ShaftSpeed::Stated(Speed::Column(column.clone()))]
        } else {
            self.speed.clone()
        }
    }
}

/// Options of `demo`.
#[derive(Debug, Args)]
pub struct Demo {
    /// Folder for CSV and figure [default: brinell-demo]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten)]
    pub(super) library: LibraryChoice,
}

#[derive(Debug, Args)]
pub struct LibraryChoice {
    /// Compiled model library to pack, instead of building it from source; so does the environment's BRINELL_LIBRARY
    #[arg(long, value_name = "PATH", conflicts_with = "platforms")]
    pub(super) library: Option<PathBuf>,
    /// Platforms to pack the library for: all, or a list of linux64, win64, darwin64, aarch64-linux
    /// [default: all that this program holds; where it compiles them, this machine's]
    #[arg(long, value_name = "PLATFORM,…", value_delimiter = ',')]
    pub(super) platforms: Vec<String>,
}

impl From<LibraryChoice> for library::Choice {
    fn from(choice: LibraryChoice) -> Self {
        let named = || env::var_os("BRINELL_LIBRARY").map(PathBuf::from).filter(|_| choice.platforms.is_empty());
        Self { file: choice.library.or_else(named), platforms: choice.platforms }
    }
}
