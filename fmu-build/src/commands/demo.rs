//! The demonstration: a ball rolls over an etched spall, computed by an FMU that fmpy steps through the C interface.

use std::path::Path;

use anyhow::{Context, Result};
use brinell::contact::rolled_path::RigidPath;
use brinell::contact::rolling::Rolling;
use brinell::surface::Surface;

use crate::package::{Choice, Library, Model, fmu};
use crate::shared::{Project, Python, Version, csv, whole_file};

/// A shipped scene.
const SCENE: &str = "6205-epps";
/// What a reader of the figure must know.
const STAND_IN: &str = "the trace of the spall is a stand-in, 0.8 mm long as reported and rough as assumed: the \
                        measured one was never published";
/// Spacing of the profile that is drawn, and how far it goes beyond the defect (m).
const SPACING: f64 = 1e-6;
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
    whole_file::write(&raceway, raceway_csv(&model)?)?;
    let radius = model.scene.bearing.outer_raceway_radius().to_string();
    print!("{}", python.run("demo.py", [path.as_os_str(), raceway.as_os_str(), radius.as_ref()])?);
    Ok(())
}

/// Profile and rigid path around the defect: `arc`, `depth`, `path`, each in metres, every micrometre.
fn raceway_csv(model: &Model) -> Result<Vec<u8>> {
    let bearing = &model.scene.bearing;
    let first = Surface::load_all(&model.scene, model.profile_texts())?.into_iter().next();
    let profile = match first.context("the scene has no defect to demonstrate")? {
        Surface::Profile(profile) => profile,
        Surface::Topography(topography) => topography.profile_at(0.0),
    };
    let radius = bearing.outer_raceway_radius();
    let path = RigidPath::new(profile.points(), Rolling::outer_ring(bearing.element_radius(), radius))?;
    let rigid = |arc: f64| {
        let after = path.knots().partition_point(|&knot| knot <= arc / radius);
        if after == 0 || after == path.knots().len() { 0.0 } else { path.at(after - 1, arc / radius).path }
    };
    let (first, last) = profile.extent();
    let from = ((first - MARGIN) / SPACING).floor() as i64;
    let to = ((last + MARGIN) / SPACING).ceil() as i64;
    let mut out = Vec::new();
    csv::header(&mut out, [("arc", "m"), ("depth", "m"), ("path", "m")].into_iter())?;
    for index in from..=to {
        let arc = index as f64 * SPACING;
        csv::row(&mut out, [arc, profile.depth_at(arc), rigid(arc)].into_iter())?;
    }
    Ok(out)
}
