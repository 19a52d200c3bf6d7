//! The command `validate`: every claim of the paper beside what comes out here, into `docs/evidence/validation.md` and
//! its figures.
//!
//! Data go to `target/validation`.

pub mod averages;
pub mod blind;
pub mod events;
mod page;
pub mod recordings;
pub mod rigs;
pub mod statics;
pub mod synthetic_rig;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use fmu_build::shared::{Project, Python, bar, csv};
use page::Page;
use recordings::Known;

/// What can be computed by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// Static stiffness and critical loads
    Statics,
    /// Single passages: four events, Epps
    Events,
    /// Averaged passages, their frequencies and spectrograms
    Averages,
    /// Simulated recordings, sized
    Blind,
    /// Recordings of machines that do not exist, sized
    Rigs,
    /// Recordings that are given, sized
    Recordings,
}

/// What the user says.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Recordings to size and to lay beside their scene.
    pub recordings: Vec<Known>,
    /// Their sampling rate (Hz).
    pub rate: f64,
    /// The one part to compute; the others' tables stay as they are.
    pub only: Option<Part>,
    /// Whether to draw.
    pub figures: bool,
}

impl Part {
    /// What is computed, and the figures that show it.
    fn about(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Part::Statics => ("static stiffness and critical loads", &[]),
            Part::Events => ("single passages", &["four-events", "epps"]),
            Part::Averages => ("averaged passages", &["spectrograms", "assumptions"]),
            Part::Blind => ("simulated recordings, sized", &[]),
            Part::Rigs => ("machines that do not exist, sized", &[]),
            Part::Recordings => ("recordings", &["beside"]),
        }
    }
}

/// The command. `docs` is where `evidence/validation.md`, whose tables are written anew, and `figures/` are.
pub fn command(project: &Project, options: &Options, docs: &Path) -> Result<()> {
    let page = Page { path: docs.join("evidence/validation.md") };
    // What is computed for hours should have where to go.
    fs::metadata(&page.path).with_context(|| page.path.display().to_string())?;
    if options.only == Some(Part::Recordings) && options.recordings.is_empty() {
        bail!("no recordings are given");
    }
    let is_wanted = |part: &Part| {
        options.only.is_none_or(|only| only == *part) && (*part != Part::Recordings || !options.recordings.is_empty())
    };
    let parts: Vec<Part> = Part::value_variants().iter().copied().filter(is_wanted).collect();
    let bar = bar(parts.len() as u64, "{bar:30} {pos} of {len} parts, {elapsed}");
    for part in &parts {
        bar.suspend(|| eprintln!("validate: {}", part.about().0));
        match part {
            Part::Statics => statics::fill(&page)?,
            Part::Events => events::fill(project, &page)?,
            Part::Averages => averages::fill(project, &page)?,
            Part::Blind => blind::fill(project, &page)?,
            Part::Rigs => rigs::fill(&page)?,
            Part::Recordings => {
                page.set("recordings", &recordings::table(project, &options.recordings, options.rate)?)?;
            }
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    println!("{}", page.path.display());
    let names: Vec<&str> = parts.iter().flat_map(|part| part.about().1).copied().collect();
    if options.figures && !names.is_empty() {
        let python = Python::prepare(project)?;
        let figures = docs.join("figures");
        fs::create_dir_all(&figures).with_context(|| figures.display().to_string())?;
        for name in names {
            let stem = figures.join(format!("validation-{name}"));
            print!("{}", python.run("paper.py", [name.as_ref(), folder(project).as_os_str(), stem.as_os_str()])?);
        }
    }
    Ok(())
}

fn folder(project: &Project) -> PathBuf {
    project.results("validation")
}

/// Columns of equal length into `target/validation/<name>.csv`.
fn write_csv(project: &Project, name: &str, names: &[(String, &str)], columns: &[Vec<f64>]) -> Result<()> {
    csv::table(&folder(project).join(format!("{name}.csv")), names, columns)
}
