//! The command line of the repository, `cargo fmu`: what users run, and the studies behind the pages in `docs/`.

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::{Args, Parser, Subcommand};
use fmu_build::cli::Command as UserCommand;
use fmu_build::project::Project;

use crate::{report, validation};

/// Turns bearing scenes into FMI 2.0 co-simulation FMUs and runs them; computes the pages in docs/ anew.
#[derive(Debug, Parser)]
#[command(name = "cargo fmu", bin_name = "cargo fmu", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    #[command(flatten)]
    User(UserCommand),
    /// Error against run time, measured on this machine: Markdown, CSV and figures
    Report(Report),
    /// Computes every claim of the paper anew: docs/validation.md and its figures
    Validate(Validate),
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
struct Validate {
    /// Recordings to be sized, as FILE@HZ=DEGREES with the shaft's speed and the nominal length, 0 if healthy, with an i
    /// behind it of the inner raceway, or FILE@HZ=ball; FILE@HZ/RATE=... where the sampling rate is another; without
    /// them the table of recordings stays as it was
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

impl Arguments {
    /// Does what was asked. An error is one line for the user.
    pub fn execute(self) -> Result<()> {
        let project = Project::find();
        match self.command {
            Command::User(command) => command.execute(&project),
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
        }
    }
}
