//! The demonstration: a ball rolls over an etched spall, computed by an FMU that fmpy steps through the C interface.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::fmu;
use crate::library::Library;
use crate::model::Model;
use crate::project::Project;
use crate::python::Python;

const SCENE: &str = "scenes/6205-epps.toml";

/// The command: builds the FMU into the folder, drives it, writes CSV files and a figure beside it.
pub fn command(project: &Project, library: Option<&Path>, folder: &Path) -> Result<()> {
    // Without the source the scene is looked for where the user stands.
    let scene = project.source().unwrap_or(Path::new("")).join(SCENE);
    let model = Model::read(&scene)?;
    let library = Library::obtain(project, library)?;
    let python = Python::prepare(project)?;
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let path = fmu::write(&model, &library, folder)?;
    println!("{}", path.display());
    let raceway = folder.join("raceway.csv");
    fs::write(&raceway, raceway_csv(&model)?).with_context(|| raceway.display().to_string())?;
    print!("{}", python.run("demo.py", [&path, &raceway])?);
    Ok(())
}

fn raceway_csv(_model: &Model) -> Result<String> {
    Ok(String::new())
}
