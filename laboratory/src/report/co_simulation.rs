//! Error and stability of co-simulation against the communication step, and what a step costs beside it.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use super::Extent;
use super::coupling::{MASSES, Row, STEPS, study};
use super::integration::scene_file;
use fmu_build::shared::whole_file;

/// The scenes studied: without and with impacts.
const SCENES: [&str; 2] = ["6205-healthy", "er16k-tb1"];

/// Outcomes of one scene.
#[derive(Debug, Clone)]
pub(super) struct Coupled {
    pub(super) scene: &'static str,
    pub(super) rows: Vec<Row>,
    pub(super) steps: Vec<f64>,
}

/// Measures and writes `co-simulation.csv`.
pub(super) fn measure(extent: Extent, data: &Path) -> Result<Vec<Coupled>> {
    let steps = if extent == Extent::Full { STEPS.to_vec() } else { vec![1e-5, 1e-4, 3e-4] };
    let masses = if extent == Extent::Full { &MASSES[..] } else { &MASSES[2..] };
    let mut found = Vec::new();
    for scene in SCENES {
        let path = scene_file(scene);
        let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        let rows = study(&brinell_scene_file::from_toml(&text)?, masses, &steps).with_context(|| scene.to_owned())?;
        found.push(Coupled { scene, rows, steps: steps.clone() });
    }
    let path = data.join("co-simulation.csv");
    whole_file::write_with(&path, |out| {
        writeln!(out, "scene,host_mass_kg,coupling,step_s,error")?;
        for Coupled { scene, rows, .. } in &found {
            for Row { host_mass, coupling, step, error } in rows {
                let error = error.map_or("unstable".to_owned(), |error| format!("{error:.2e}"));
                writeln!(out, "{scene},{host_mass},{},{step:e},{error}", coupling.name())?;
            }
        }
        Ok(())
    })?;
    Ok(found)
}
