//! The command `report`: error against run time, measured here and now, as Markdown, CSV and figures.
//!
//! | part | asks |
//! |---|---|
//! | `contact` | how wrong is one contact, by grid and by map, for which CPU time |
//! | `integration` | how wrong is a run, by which method and tolerance, for which CPU time |
//! | `co_simulation` | how wrong is a coupled run, and when unstable, by communication step and way of coupling |
//! | `leaving_out` | what does each part of a scene cost |
//!
//! Times are CPU times of the one thread that steps, best of several runs; other programs on the machine still take
//! caches and memory from it, so ratios within a table mean more than the times.

mod co_simulation;
mod contact;
pub mod coupling;
mod fixed_step;
mod integration;
mod leaving_out;
mod machine;
mod markdown;
mod run;

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::project::Project;
use crate::python::Python;

/// How much of the report to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    Full,
    /// Two scenes and few tolerances: a minute, to see that it works.
    Short,
}

/// The command: `<folder>/error-vs-run-time.md`, its figures and, under `<folder>/data`, its CSV files.
pub fn command(project: &Project, extent: Extent, folder: &Path) -> Result<()> {
    let data = folder.join("data");
    let figures = folder.join("figures");
    for folder in [&data, &figures] {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    let python = Python::prepare(project)?;
    let contacts = contact::measure(extent, &data)?;
    let integration = integration::measure(&python, extent, &data)?;
    let coupled = co_simulation::measure(extent, &data)?;
    let parts = leaving_out::measure(extent, &data)?;
    let stem = figures.join("error-vs-run-time");
    print!("{}", python.run("report.py", [data.as_os_str(), stem.as_os_str()])?);
    let text = markdown::page(&machine::description(), &contacts, &integration, &coupled, &parts);
    let path = folder.join("error-vs-run-time.md");
    fs::write(&path, text).with_context(|| path.display().to_string())?;
    println!("{}", path.display());
    Ok(())
}
