//! Options of commands. Those of `contact`, `modes`, `size`, `stiffness` and `sweep` stand with their command.

use std::path::PathBuf;

use anyhow::{Context, Result};
use brinell::scene::Scene;
use clap::Args;

use crate::commands::{Asked, Spall, new_scene};
use crate::package::{Model, library};
use crate::run;
use crate::run::noise::Noise;
use crate::run::speed_profile::SpeedProfile;
use crate::run::table::Format;
use crate::run::wav::Wav;
use crate::shared::{Grid, Kind, Names, Version, number, rate, seed};

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
    pub(super) library: library::Choice,
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
    /// Its samples per second, in hertz or as 51.2kHz [default: the scene's recorder's, or 51200]
    #[arg(long, value_name = "HZ", requires = "wav", allow_negative_numbers = true, value_parser = rate)]
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

    pub(super) fn options(&self, scene: &Scene) -> Result<run::Options> {
        let read = |path| SpeedProfile::read(path, &scene.bearing);
        let profile = self.speed_profile.as_deref().map(read).transpose()?;
        let stop = self.stop.or(profile.as_ref().map(SpeedProfile::end));
        let grid = Grid::new(&scene.experiment, stop, self.step)?;
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

/// Options of `demo`.
#[derive(Debug, Args)]
pub struct Demo {
    /// Folder for CSV and figure [default: brinell-demo]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten)]
    pub(super) library: library::Choice,
}
