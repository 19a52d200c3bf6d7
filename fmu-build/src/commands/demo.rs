//! The demonstration: a ball rolls over an etched spall, computed by an FMU that fmpy steps through the C interface.

use std::path::Path;

use anyhow::Result;

use crate::package::{Choice, Library, Model, fmu};
use crate::paper::{Case, passage};
use crate::shared::{Project, Python, Version, csv};

/// A shipped scene.
const SCENE: &str = "6205-epps";
/// What a reader of the figure must know.
const STAND_IN: &str = "the trace of the spall is a stand-in, 0.8 mm long as reported and rough as assumed: the \
                        measured one was never published";
/// How far the profile that is drawn goes beyond the defect (m).
const MARGIN: f64 = 0.5e-3;

/// The command: builds the FMU into the folder, drives it, writes CSV files and a figure beside it.
pub fn command(project: &Project, library: &Choice, folder: &Path) -> Result<()> {
    let model = Model::read(Path::new(SCENE))?;
    let python = Python::prepare(project)?;
    let library = Library::obtain(project, library)?;
    for line in library.describe() {
        println!("{line}");
    }
    println!("{STAND_IN}");
    let path = fmu::write(&model, &library, Version::Fmi2, folder)?;
    println!("{}", path.display());
    let raceway = folder.join("raceway.csv");
    let case = Case::shipped(SCENE)?;
    let (first, last) = passage::path_of(&case)?.0.extent();
    let (from, to) = (((first - MARGIN) / 1e-6).floor() as i32, ((last + MARGIN) / 1e-6).ceil() as i32);
    let (names, columns) = passage::profile(&case, from..=to)?;
    csv::table(&raceway, &names, &columns)?;
    let radius = model.scene.bearing.outer_raceway_radius().to_string();
    print!("{}", python.run("demo.py", [path.as_os_str(), raceway.as_os_str(), radius.as_ref()])?);
    Ok(())
}
