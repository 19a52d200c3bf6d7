//! The commands: what a user types, and the order of work behind each.

mod options;
mod shipped_options;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::commands::{catalogue, check, contact, demo, modes, new_scene, scenes, schema, size, stiffness};
use crate::package::{Library, Model, Reference, fmu};
use crate::shared::{Interface, Project, Version, talk};
use crate::{paper, run, sweep};
use options::{Build, Check, Demo, Run};
use shipped_options::{Catalogue, New, Paper, Scenes};

/// Rolling bearings with a real surface defect as FMI co-simulation units.
#[derive(Debug, Parser)]
#[command(name = "brinell", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    talk: Talk,
}

/// How much is said on standard error.
#[derive(Debug, Clone, Copy, Args)]
pub struct Talk {
    /// Say nothing but errors and results: no remarks, no bars
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say what is done: files that are taken from elsewhere, steps and times
    #[arg(short, long, global = true)]
    verbose: bool,
}

impl Talk {
    /// From now on.
    pub fn apply(self) {
        talk::set(self.quiet, self.verbose);
    }
}

/// What a user can ask for.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Builds the FMU of each scene
    Build(Build),
    /// Simulates a scene without a host and writes its signals, a figure, sound, an HTML page
    Run(Run),
    /// Runs a scene thousands of times over grids and random values, on all cores: one Parquet table
    Sweep(sweep::Options),
    /// Unzips, validates, loads and steps an FMU
    Check(Check),
    /// Static stiffness, load distribution and critical load over the cage angle: CSV, figure and summary
    Stiffness(stiffness::OverCageAngle),
    /// Natural frequencies, damping ratios and mode shapes over the cage angle: JSON, figure and summary
    Modes(stiffness::OverCageAngle),
    /// Pressure of one ball on a raceway as measured, and the stresses below: JSON on standard output, CSV, figure
    Contact(contact::Contact),
    /// Length of a spall from recordings of one bearing, or why there is none: JSON on standard output, figures
    Size(size::Size),
    /// Builds the FMU of a spalled 6205 bearing, drives it with fmpy and draws what happens
    Demo(Demo),
    /// A figure or table of the paper behind the model, computed anew: each claim with its outcome
    Paper(Paper),
    /// Lists the shipped scenes, or writes the files of those that are named
    Scenes(Scenes),
    /// Writes a commented scene of a bearing of the catalogue, or a sweep, that runs as it is
    New(New),
    /// Lists bearings that a scene can name: dimensions with their source, assumed ones marked
    Catalogue(Catalogue),
    /// Prints the JSON schema of scene files, by which editors complete and explain their keys
    Schema,
    /// Prints what a shell needs to complete commands and options
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
}

impl Arguments {
    /// The arguments of this process, whose program users know by this name; ends it where they are wrong.
    pub fn parse_as(name: &'static str) -> Self {
        let matches = Self::command().name(name).bin_name(name).get_matches();
        Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
    }

    /// Does what was asked. An error is one line for the user.
    pub fn execute(self, project: &Project) -> Result<()> {
        self.talk.apply();
        self.command.execute(project)
    }
}

impl Command {
    /// Does what was asked. An error is one line for the user.
    pub fn execute(self, project: &Project) -> Result<()> {
        match self {
            Command::Build(options) => build(project, options),
            Command::Run(options) => {
                let model = options.model()?;
                let wanted = options.options(&model.scene)?;
                let folder = options.output.unwrap_or_else(|| project.results("run"));
                run::command(project, model, &wanted, &folder)
            }
            Command::Sweep(options) => sweep::command(project, &options),
            Command::Check(options) => check::command(project, &options.fmu, options.json),
            Command::Stiffness(options) => stiffness::command(project, &options),
            Command::Modes(options) => modes::command(project, &options),
            Command::Contact(options) => contact::command(project, &options),
            Command::Size(options) => size::command(project, &options),
            Command::Demo(options) => {
                let folder = options.output.unwrap_or_else(|| project.results("demo"));
                demo::command(project, &options.library.or_environment(), &folder)
            }
            Command::Paper(options) => paper::command(project, options.part, options.json, &options.drawn),
            Command::Scenes(options) => {
                scenes::command(&options.names, options.json, &options.output.unwrap_or_default())
            }
            Command::New(options) => new(&options),
            Command::Catalogue(options) => catalogue::command(&options.filter, options.json),
            Command::Completions { shell } => {
                // `generate` panics where its reader has gone; a text is printed as all others are.
                let mut text = Vec::new();
                clap_complete::generate(shell, &mut Arguments::command(), "brinell", &mut text);
                print!("{}", String::from_utf8(text)?);
                Ok(())
            }
            Command::Schema => {
                print!("{}", schema::text()?);
                Ok(())
            }
        }
    }
}

fn build(project: &Project, options: Build) -> Result<()> {
    let (version, scalars) = (options.fmi, options.scalars);
    ensure!(!scalars || version == Version::Fmi3, "--scalars is for --fmi 3: FMI 2.0 has no arrays");
    let interface = Interface { version, kind: options.kind, names: options.names, scalars };
    let read = |path: &PathBuf| {
        let mut model = Model::read(path)?;
        if options.reference {
            let reference = Reference::of(&model.scene, model.simulation.clone());
            model.reference = Some(reference.with_context(|| path.display().to_string())?);
        }
        Ok(model)
    };
    // Scenes first: a typing error should not wait for a compiler. One that cannot be built does not stop the others.
    let mut refused = Vec::new();
    let mut models = Vec::new();
    for path in &options.scenes {
        read(path).map_or_else(|error| refused.push(error), |model| models.push(model));
    }
    if !models.is_empty() {
        let library = Library::obtain(project, &options.library.or_environment())?;
        for line in library.describe() {
            println!("{line}");
        }
        let folder = options.output.unwrap_or_else(|| project.results("fmu"));
        for model in &models {
            let written = pack(model, &library, interface, &folder);
            refused.extend(written.err());
        }
    }
    match (refused.pop(), options.scenes.len()) {
        (None, _) => Ok(()),
        (Some(only), 1) => Err(only),
        (Some(last), count) => {
            refused.push(last);
            let why: Vec<_> = refused.iter().map(|error| format!("{error:#}")).collect();
            bail!("{} of {count} scenes were not built:\n{}", why.len(), why.join("\n"))
        }
    }
}

/// Writes a model's FMU, and its reference results if it has any.
fn pack(model: &Model, library: &Library, interface: Interface, folder: &Path) -> Result<()> {
    for path in model.reference.iter().map(|reference| reference.write(folder)).collect::<Result<Vec<_>>>()?.concat() {
        println!("{}", path.display());
    }
    println!("{}", fmu::write(model, library, interface, folder)?.display());
    Ok(())
}

fn new(options: &New) -> Result<()> {
    let folder = options.output.clone().unwrap_or_default();
    match options.asked() {
        None => new_scene::sweep(options.name.as_deref().unwrap_or("sweep"), &folder),
        Some(asked) => new_scene::command(options.name.as_deref(), &options.bearing, asked, &folder),
    }
}
