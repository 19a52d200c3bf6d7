//! The command `validate`: every claim of the paper beside what comes out here, into `docs/evidence/validation.md` and
//! its figures.
//!
//! The prose stands in `assets/validation.md`; `{{name}}` in it is a table that is computed. Data go to
//! `target/validation`.

pub mod averages;
pub mod blind;
pub mod events;
pub mod recordings;
pub mod rigs;
pub mod statics;
pub mod synthetic_rig;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use fmu_build::shared::{Project, Python, bar, csv, whole_file};
use recordings::Known;

const TEMPLATE: &str = include_str!("../../assets/validation.md");

/// What can be computed by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
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
    /// The one part to compute; the others' tables are taken from the last run.
    pub only: Option<Part>,
    /// Whether to draw.
    pub figures: bool,
}

/// The tables by their names in the template, kept beside the data.
#[derive(Debug, Clone)]
pub struct Values {
    folder: PathBuf,
}

impl Values {
    /// Sets the table of a name.
    pub fn set(&mut self, name: &str, text: String) -> Result<()> {
        whole_file::write(&self.path(name), text)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.md"))
    }

    /// Names of the template's tables that have never been computed here.
    fn missing<'t>(&self, template: &'t str) -> Vec<&'t str> {
        let names = template.split("{{").skip(1).filter_map(|part| Some(part.split_once("}}")?.0));
        names.filter(|name| !self.path(name).exists()).collect()
    }

    /// The template with all its tables.
    fn filled(&self, template: &str) -> Result<String> {
        let mut parts = template.split("{{");
        let mut text = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let (name, rest) = part.split_once("}}").unwrap_or(("", part));
            let path = self.path(name);
            text += fs::read_to_string(&path).with_context(|| path.display().to_string())?.trim_end();
            text += rest;
        }
        Ok(text)
    }
}

/// The command. `docs` is where `evidence/validation.md` and `figures/` are.
pub fn command(project: &Project, options: &Options, docs: &Path) -> Result<()> {
    fs::create_dir_all(docs.join("evidence")).with_context(|| docs.display().to_string())?;
    let mut values = Values { folder: folder(project).join("tables") };
    let parts = if options.only.is_some() { 1 } else { 5 + u64::from(!options.recordings.is_empty()) };
    let bar = bar(parts, "{bar:30} {pos} of {len} parts, {elapsed}");
    let mut begun = 0;
    let mut wanted = |part: Part, text: &str| {
        let wanted = options.only.is_none_or(|only| only == part);
        if wanted {
            bar.suspend(|| eprintln!("validate: {text}"));
            bar.set_position(begun);
            begun += 1;
        }
        wanted
    };
    if wanted(Part::Statics, "static stiffness and critical loads") {
        statics::fill(&mut values)?;
    }
    if wanted(Part::Events, "single passages") {
        events::fill(project, &mut values)?;
    }
    if wanted(Part::Averages, "averaged passages") {
        averages::fill(project, &mut values)?;
    }
    if wanted(Part::Blind, "simulated recordings, sized") {
        blind::fill(project, &mut values)?;
    }
    if wanted(Part::Rigs, "machines that do not exist, sized") {
        rigs::fill(&mut values)?;
    }
    if !options.recordings.is_empty() && wanted(Part::Recordings, "recordings") {
        let table = recordings::table(project, &options.recordings, options.rate)?;
        let path = recordings::kept(docs);
        whole_file::write(&path, table)?;
    }
    bar.finish_and_clear();
    values.set("recordings", recordings::last(docs))?;
    let missing = values.missing(TEMPLATE);
    if !missing.is_empty() {
        println!("{}", values.folder.display());
        eprintln!(
            "validate: page and figures are left as they were; of the tables {} have never been computed here",
            missing.join(", ")
        );
        return Ok(());
    }
    let path = docs.join("evidence/validation.md");
    whole_file::write(&path, values.filled(TEMPLATE)?)?;
    println!("{}", path.display());
    if options.figures {
        let python = Python::prepare(project)?;
        let figures = docs.join("figures");
        fs::create_dir_all(&figures).with_context(|| figures.display().to_string())?;
        for name in ["four-events", "epps", "spectrograms", "assumptions", "beside"] {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_lacks_no_table() {
        let folder = tempfile::tempdir().unwrap();
        let mut values = Values { folder: folder.path().to_owned() };
        values.set("there", "| 1 |\n".to_owned()).unwrap();
        assert_eq!(values.filled("a {{there}} b").unwrap(), "a | 1 | b");
        assert_eq!(values.missing("{{there}} {{one}} {{another}}"), ["one", "another"]);
        assert!(values.filled("{{one}}").is_err());
    }
}
