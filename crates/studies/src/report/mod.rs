//! The command `report`: error against run time, measured here and now, as Markdown, CSV and figures.
//!
//! | part | asks |
//! |---|---|
//! | `contact` | how wrong is one contact, by grid and by map, for which CPU time |
//! | `integration` | how wrong is a run, by which method and tolerance, for which CPU time |
//! | `co_simulation` | how wrong is a coupled run, and when unstable, by communication step and way of coupling |
//! | `leaving_out` | what does each part of a scene cost |
//! | `choice` | does the automatic choice of the method cost more than the better one |
//! | `elements` | what does a step cost over the number of elements |
//! | `steady` | what does a whole second cost after the start |
//!
//! Times are CPU times of the one thread that steps, best of several runs; other programs on the machine still take
//! caches and memory from it, so ratios within a table mean more than the times.

mod choice;
mod co_simulation;
mod contact;
pub mod coupling;
mod elements;
mod fixed_step;
mod integration;
mod leaving_out;
mod machine;
mod markdown;
mod run;
mod side_by_side;
mod steady;
mod steps_page;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use fmu_build::shared::{Project, Python, whole_file};
use side_by_side::SideBySide;

/// How much of the report to make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    Full,
    /// Two scenes and few tolerances: a minute, to see that it works.
    Short,
}

/// The command: `<folder>/error-vs-run-time.md` and `<folder>/cost-of-steps.md`, their figures and, under
/// `<folder>/data`, its CSV files.
pub fn command(project: &Project, extent: Extent, folder: &Path) -> Result<()> {
    let [data, figures] = folders(folder)?;
    let python = Python::prepare(project)?;
    steps(&python, extent, folder)?;
    let contacts = contact::measure(extent, &data)?;
    let integration = integration::measure(&python, extent, &data)?;
    let coupled = co_simulation::measure(extent, &data)?;
    let parts = leaving_out::measure(extent, &data)?;
    let stem = figures.join("error-vs-run-time");
    print!("{}", python.run("report.py", [data.as_os_str(), stem.as_os_str()])?);
    let text = markdown::page(&machine::description(), &contacts, &integration, &coupled, &parts);
    let path = folder.join("error-vs-run-time.md");
    whole_file::write(&path, text)?;
    println!("{}", path.display());
    Ok(())
}

/// `<folder>/cost-of-steps.md` alone.
pub fn steps_command(project: &Project, folder: &Path) -> Result<()> {
    steps(&Python::prepare(project)?, Extent::Full, folder)
}

fn steps(python: &Python, extent: Extent, folder: &Path) -> Result<()> {
    let [data, figures] = folders(folder)?;
    let fastest = steady::fastest_of_healthy()?;
    let choices = choice::measure(extent, &data)?;
    let (elements, hosted) = elements::measure(extent, &data)?;
    print!("{}", python.run("elements.py", [data.as_os_str(), figures.join("elements").as_os_str()])?);
    let gain = SideBySide::new(&elements);
    if let Some(gain) = &gain {
        gain.write(&data)?;
        print!("{}", python.run("side_by_side.py", [data.as_os_str(), figures.join("side-by-side").as_os_str()])?);
    }
    let seconds = steady::measure(extent, &data)?;
    let path = folder.join("cost-of-steps.md");
    let mut text = steps_page::page(&machine::description(), &choices, &elements, gain.as_ref(), &hosted);
    text += &steps_page::seconds(&seconds, gain.as_ref(), fastest);
    whole_file::write(&path, text)?;
    println!("{}", path.display());
    Ok(())
}

/// The folders for data and figures, made where they are missing.
fn folders(folder: &Path) -> Result<[PathBuf; 2]> {
    let folders = ["data", "figures"].map(|name| folder.join(name));
    for folder in &folders {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    Ok(folders)
}
