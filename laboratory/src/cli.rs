//! The command `cargo lab`: the studies behind the pages in `docs/`, and what users install.

use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::{Args, Parser, Subcommand};
use fmu_build::cli::Talk;
use fmu_build::shared::Project;

use crate::{diagnosis, dist, report, site, validation};

/// Brinell's laboratory: computes the pages in docs/ anew and makes what users install. `cargo fmu` is the program.
#[derive(Debug, Parser)]
#[command(name = "cargo lab", bin_name = "cargo lab", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    talk: Talk,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Error against run time, measured on this machine: Markdown, CSV and figures
    Report(Report),
    /// Computes every claim of the paper anew: docs/evidence/validation.md and its figures
    Validate(Validate),
    /// Judges recordings of known machines, whole, in halves and by the second, beside a plain script
    Diagnose(Diagnose),
    /// Makes what users install, for all platforms: wheels and archives of the program with the libraries inside
    Dist(Dist),
    /// The documentation as a book: docs/ as it is, and every key of a scene; needs mdBook
    Site(Site),
}

#[derive(Debug, Args)]
struct Diagnose {
    /// CSV file with a row for each recording: file, machine, bearing, speed_hz, fault (outer, inner, ball, none), and
    /// where they are known rate_hz, length_deg, load_n, channel
    list: PathBuf,
    /// Write each answer into this file
    #[arg(short, long, value_name = "FILE.csv")]
    output: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct Site {
    /// Folder for the book and what it is made of [default: target/site]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct Dist {
    /// Platforms to make wheels and archives for, each with the libraries of these [default: all]
    #[arg(long, value_name = "PLATFORM,…", value_delimiter = ',')]
    platforms: Vec<String>,
    /// Only the libraries, for a program compiled with BRINELL_LIBRARIES set to their folder
    #[arg(long)]
    only_libraries: bool,
    /// Folder for libraries, wheels and archives [default: target/dist]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct Report {
    /// Two scenes and few tolerances only
    #[arg(long)]
    short: bool,
    /// Folder for the page, its figures and its data [default: docs; target/report with --short]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct Validate {
    /// Recordings to be sized, as FILE@HZ=DEGREES with the shaft's speed and the nominal length, 0 if healthy, with an
    /// i behind it of the inner raceway, or FILE@HZ=ball; FILE@HZ/RATE=... where the sampling rate is another; without
    /// them the table of recordings stays as it was
    #[arg(value_name = "RECORDING")]
    recordings: Vec<String>,
    /// Sampling rate of the recordings in hertz
    #[arg(long, value_name = "HZ", default_value_t = 51_200.0)]
    rate: f64,
    /// Compute this part alone; the other tables stay as they are
    #[arg(long, value_enum, value_name = "PART")]
    only: Option<validation::Part>,
    /// Sizes the synthetic machines with these numbers and nothing else: how many intervals hold, and how wide they are
    #[arg(long, value_name = "FROM..TO", value_parser = machines, exclusive = true)]
    machines: Option<Range<u64>>,
    /// Folder with evidence/validation.md, whose tables are written anew, and for figures [default: docs]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Leave the figures out; no Python is needed then
    #[arg(long)]
    no_figure: bool,
}

/// Numbers of machines as they are typed.
fn machines(text: &str) -> Result<Range<u64>, String> {
    let wanted = || format!("{text}: two whole numbers are wanted, as in 900..940");
    let (from, to) = text.split_once("..").ok_or_else(wanted)?;
    Ok(from.parse().map_err(|_| wanted())?..to.parse().map_err(|_| wanted())?)
}

impl Arguments {
    /// Does what was asked. An error is one line for the user.
    pub fn execute(self) -> Result<()> {
        self.talk.apply();
        let project = Project::find().with_library_beside();
        match self.command {
            Command::Report(options) => {
                let folder = if options.short {
                    project.results("report")
                } else {
                    project.source().unwrap_or(Path::new(".")).join("docs")
                };
                let folder = options.output.unwrap_or(folder);
                let extent = if options.short { report::Extent::Short } else { report::Extent::Full };
                report::command(&project, extent, &folder)
            }
            Command::Diagnose(options) => diagnosis::command(&options.list, options.output.as_deref()),
            Command::Dist(options) => {
                let folder = options.output.unwrap_or_else(|| project.results("dist"));
                dist::command(&project, &options.platforms, options.only_libraries, &folder)
            }
            Command::Site(options) => {
                site::command(&project, &options.output.unwrap_or_else(|| project.results("site")))
            }
            Command::Validate(Validate { machines: Some(machines), .. }) => {
                print!("{}", validation::rigs::coverage(&machines)?);
                Ok(())
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
