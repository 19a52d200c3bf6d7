//! An FMU as a host has it: unpacked, its library loaded through its C interface and stepped. What an FMU costs is
//! measured on this.

use std::io::Cursor;

use anyhow::{Context, Result};
use brinell::scene::Motion;
use cpu_time::ThreadTime;
use fmu_build::package::{Choice, Library, Model, fmu};
use fmu_build::shared::{Project, Version};
use host::Instance;
use tempfile::TempDir;
use zip::ZipArchive;

/// Where a host holds an inner ring that it moves (m): 12 µm beyond the concentric position, some hundred newtons on
/// the lowest elements.
pub const HELD: f64 = -12e-6;

/// The library that FMUs are packed with.
///
/// # Errors
/// Of the compiler.
pub fn library(project: &Project) -> Result<Library> {
    Library::obtain(project, &Choice::default())
}

/// An FMU in a folder.
#[derive(Debug)]
pub struct Packed {
    folder: TempDir,
    /// The library in it.
    file: String,
    guid: String,
    /// Value references of the tolerance and of a position that is held.
    tolerance: u32,
    held: Option<u32>,
}

impl Packed {
    /// The FMU of a scene with this library. A ring that the host moves is held where it presses on the elements.
    ///
    /// # Errors
    /// Where it cannot be packed or written.
    pub fn new(model: &Model, library: &Library) -> Result<Self> {
        let folder = tempfile::tempdir()?;
        let archive = fmu::pack(model, library, Version::Fmi2)?;
        ZipArchive::new(Cursor::new(archive))?.extract(folder.path())?;
        let platform = library.binaries().first().context("no library for this platform")?.platform;
        let file = format!("binaries/{}/{}.{}", platform.name, model.scene.model_identifier(), platform.extension);
        let simulation = &model.simulation;
        let tolerance = simulation.reference("solver.tolerance")?;
        let is_held = model.scene.shaft.motion == Motion::Host;
        let held = is_held.then(|| simulation.reference("shaft.y")).transpose()?;
        Ok(Self { folder, file, guid: model.guid(), tolerance, held })
    }

    /// CPU seconds of this thread within `fmi2DoStep` over a run from the start.
    ///
    /// # Errors
    /// What the library refuses.
    pub fn run(&self, tolerance: f64, stop: f64, step: f64) -> Result<f64> {
        let (library, resources) = (self.folder.path().join(&self.file), self.folder.path().join("resources"));
        let mut instance = Instance::new(&library, "measured", &self.guid, &resources)?;
        instance.set_reals(&[self.tolerance], &[tolerance])?;
        if let Some(held) = self.held {
            instance.set_reals(&[held], &[HELD])?;
        }
        instance.initialize(None)?;
        let start = ThreadTime::now();
        for k in 0..(stop / step).round() as usize {
            instance.step(k as f64 * step, step)?;
        }
        Ok(start.elapsed().as_secs_f64())
    }
}
