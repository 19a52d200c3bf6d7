//! The FMU's `resources/` directory: the scene `model.bin`, the profiles that it names, and the contact map `map.bin`.
//! Of `scene.toml`, which is for people, only the bytes count: the model belongs to them.
//!
//! The one place in the FMU that reads files, and only when an instance is made.

use std::fs;
use std::path::{Component, Path, PathBuf};

use super::error::ResourceError;
use super::shared_models::SharedModel;
use brinell::scene::model_file;
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::guid;

/// The model that the resources in a directory describe.
pub(crate) fn load(directory: &Path) -> Result<SharedModel, ResourceError> {
    ask_for_memory(directory)?;
    let text = read(&directory.join("scene.toml"))?;
    let path = directory.join("model.bin");
    let model = fs::read(&path).map_err(|cause| ResourceError::unreadable(&path, cause))?;
    let scene = model_file::decode(&model, &text).map_err(|cause| ResourceError::Model { path, cause })?;
    let profile = |name| read(&beside(directory, name)?);
    let profiles: Vec<String> = scene.profile_names().into_iter().map(profile).collect::<Result<_, _>>()?;
    let guid = guid(&text, profiles.iter().map(String::as_str));
    let set_up = |map| Simulation::with_shared_map(scene, profiles.iter().map(String::as_str), map);
    SharedModel::obtain(guid, &directory.join("map.bin"), set_up)
}

/// Asks for as much memory as setting up the resources in a directory takes, and gives it back: an allocation that
/// fails later would end the host's process.
fn ask_for_memory(directory: &Path) -> Result<(), ResourceError> {
    let files = fs::read_dir(directory).into_iter().flatten().flatten();
    let bytes: u64 = files.filter_map(|file| file.metadata().ok()).map(|file| file.len()).sum();
    let needed = usize::try_from(bytes.saturating_mul(PER_BYTE)).unwrap_or(usize::MAX).saturating_add(AT_LEAST);
    Vec::<u8>::new().try_reserve_exact(needed).map_err(|_| ResourceError::Memory(needed))
}

/// Bytes that setting up takes for each of the resources, which are read and decoded; and those of an instance itself.
const PER_BYTE: u64 = 4;
const AT_LEAST: usize = 4 << 20;

/// The path of a file in the directory, given by its bare name.
fn beside(directory: &Path, name: &str) -> Result<PathBuf, ResourceError> {
    let mut components = Path::new(name).components();
    match (components.next(), components.next()) {
        (Some(Component::Normal(_)), None) => Ok(directory.join(name)),
        _ => Err(ResourceError::OutsideResources(name.to_owned())),
    }
}

fn read(path: &Path) -> Result<String, ResourceError> {
    fs::read_to_string(path).map_err(|cause| ResourceError::unreadable(path, cause))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_outside_the_resources_is_refused() {
        for name in ["../a.csv", "/a.csv", "b/a.csv", "", "."] {
            assert!(matches!(beside(Path::new("/r"), name), Err(ResourceError::OutsideResources(_))), "{name}");
        }
        assert_eq!(beside(Path::new("/r"), "a.csv").unwrap(), Path::new("/r/a.csv"));
    }
}
