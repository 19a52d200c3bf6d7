//! The command `report`: error against run time, measured here and now, as Markdown, CSV and figures.
//!
//! | part | asks |
//! |---|---|
//! | `contact` | how wrong is one contact, by grid and by map, for which CPU time |
//! | `integration` | how wrong is a run, by which method and tolerance, for which CPU time |
//!
//! Times are CPU times of the one thread that steps, best of several runs, of the automatic method within `fmi2DoStep`
//! of the library that FMUs are packed with; other programs on the machine still take caches and memory from it, so
//! ratios within a table mean more than the times.

mod contact;
mod integration;
mod machine;
mod markdown;
mod run;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use fmu_build::shared::{Project, Python, whole_file};

/// How much of the report to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    Full,
    /// Two scenes and few tolerances: a minute, to see that it works.
    Short,
}

/// The command: `<folder>/evidence/error-vs-run-time.md`, its figures and, under `<folder>/data`, its CSV files.
pub fn command(project: &Project, extent: Extent, folder: &Path) -> Result<()> {
    let [data, figures] = folders(folder)?;
    let python = Python::prepare(project)?;
    let contacts = contact::measure(extent, &data)?;
    let integration = integration::measure(project, extent, &data)?;
    let stem = figures.join("error-vs-run-time");
    let script = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/python/report.py"));
    print!("{}", python.run_file(script, [data.as_os_str(), stem.as_os_str()])?);
    let text = markdown::page(&machine::description(), &contacts, &integration)?;
    let path = folder.join("evidence/error-vs-run-time.md");
    whole_file::write(&path, text)?;
    println!("{}", path.display());
    Ok(())
}

/// The folders for data and figures, made where they are missing.
fn folders(folder: &Path) -> Result<[PathBuf; 2]> {
    let folders = ["data", "figures"].map(|name| folder.join(name));
    for folder in folders.iter().chain([&folder.join("evidence")]) {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    Ok(folders)
}
