//! What an FMU of a scene holds, and where in it.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use brinell::scene::model_file;

use super::archive::Archive;
use super::documentation;
use super::library::Library;
use super::model::Model;
use crate::package::description::{model_description, terminals};
use crate::shared::{Interface, Version, note, whole_file};

const ICON: &[u8] = include_bytes!("../../assets/model.png");
/// Bytes of a description in which its version stands.
const LONGEST_HEAD: u64 = 1000;
const LICENSE: &str = "Brinell is licensed under either of\n\n\
    - the Apache License, Version 2.0 (LICENSE-APACHE), or\n\
    - the MIT license (LICENSE-MIT)\n\nat your option.\n\n\
    third-party.txt lists what else is compiled into the model library.\n";

/// Packs a scene and the compiled library.
pub fn pack(model: &Model, library: &Library, interface: impl Into<Interface>) -> Result<Vec<u8>> {
    let interface = interface.into();
    let version = interface.version;
    let mut archive = Archive::default();
    archive.add("modelDescription.xml", model_description(model, interface)?)?;
    // FMI 2.0.4 has taken the terminals of 3.0 over.
    archive.add("terminalsAndIcons/terminalsAndIcons.xml", terminals(model.simulation.table(), interface)?)?;
    archive.add("terminalsAndIcons/icon.png", ICON)?;
    if version == Version::Fmi2 {
        archive.add("model.png", ICON)?;
    }
    if let Some(reference) = &model.reference {
        reference.add_to(&mut archive)?;
    }
    for binary in library.binaries() {
        let platform = &binary.platform;
        let folders = match version {
            Version::Fmi2 => &[platform.name],
            // A library for both kinds of Mac stands in the folders of both.
            Version::Fmi3 => platform.fmi3,
        };
        for folder in folders {
            let file = format!("binaries/{folder}/{}.{}", model.scene.model_identifier(), platform.extension);
            archive.add_compressed(file, binary.compressed()?)?;
        }
    }
    archive.add("resources/scene.toml", model.scene_text.as_str())?;
    archive.add("resources/model.bin", model_file::encode(&model.scene, &model.scene_text)?)?;
    if let Some(marks) = interface.marks() {
        archive.add("resources/interface", marks)?;
    }
    for profile in &model.profiles {
        archive.add(format!("resources/{}", profile.name), profile.text.as_str())?;
    }
    if let Some(map) = &model.map {
        archive.add("resources/map.bin", map.as_slice())?;
    }
    archive.add("documentation/index.html", documentation::write(model, interface)?)?;
    archive.add("documentation/licenses/license.txt", LICENSE)?;
    archive.add("documentation/licenses/LICENSE-MIT", include_str!("../../../LICENSE-MIT"))?;
    archive.add("documentation/licenses/LICENSE-APACHE", include_str!("../../../LICENSE-APACHE"))?;
    archive.add("documentation/licenses/third-party.txt", include_str!("../../assets/third-party.txt"))?;
    Ok(archive.to_zip()?)
}

/// The version of the standard after which an FMU is made, where a file is one.
fn version_of(path: &Path) -> Option<Version> {
    let mut archive = zip::ZipArchive::new(fs::File::open(path).ok()?).ok()?;
    let mut text = String::new();
    archive.by_name("modelDescription.xml").ok()?.take(LONGEST_HEAD).read_to_string(&mut text).ok()?;
    [Version::Fmi2, Version::Fmi3]
        .into_iter()
        .find(|version| text.contains(&format!("fmiVersion=\"{}", version.number())))
}

/// Packs a scene and writes `<scene name>.fmu` into the folder, making it if need be. Gives the file's path.
pub fn write(model: &Model, library: &Library, interface: impl Into<Interface>, folder: &Path) -> Result<PathBuf> {
    let path = folder.join(format!("{}.fmu", model.scene.name));
    let interface = interface.into();
    let bytes = pack(model, library, interface).with_context(|| path.display().to_string())?;
    if let Some(there) = version_of(&path).filter(|there| *there != interface.version) {
        let (name, path) = (interface.version.number(), path.display());
        note!("note: {path} was of FMI {} and is now of FMI {name}; -o names a folder apart", there.number());
    }
    whole_file::write(&path, bytes)?;
    Ok(path)
}
