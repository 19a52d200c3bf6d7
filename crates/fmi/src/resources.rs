//! The FMU's `resources/` directory: `scene.toml`, the profile that the scene names, and the contact map `map.bin`.
//!
//! The one place in the FMU that reads files, and only when an instance is made.

use std::path::{Component, Path, PathBuf};
use std::{fs, io};

use super::shared_models::SharedModel;
use super::uri::UriError;
use brinell::scene::{Scene, SceneError};
use brinell::simulation::guid::guid;
use brinell::simulation::{Simulation, SimulationError};

/// Why the model could not be read or set up.
#[derive(Debug, thiserror::Error)]
pub(super) enum ResourceError {
    /// The location names no path.
    #[error(transparent)]
    Uri(#[from] UriError),
    /// A file that cannot be read.
    #[error("resource {path}: {source}")]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A profile that does not lie in the directory.
    #[error("profile \"{0}\": it must be the name of a file beside scene.toml")]
    OutsideResources(String),
    /// A scene that is refused.
    #[error("resource {path}: {source}")]
    Scene {
        /// Path of the scene.
        path: PathBuf,
        /// What is wrong with it.
        source: SceneError,
    },
    /// A scene that cannot be set up.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

impl ResourceError {
    pub(super) fn unreadable(path: &Path, source: io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), source }
    }
}

/// The model that the resources in a directory describe.
pub(super) fn load(directory: &Path) -> Result<SharedModel, ResourceError> {
    let path = directory.join("scene.toml");
    let text = read(&path)?;
    let scene = Scene::from_toml(&text).map_err(|source| ResourceError::Scene { path, source })?;
    let profile = |name| read(&beside(directory, name)?);
    let profiles: Vec<String> = scene.profile_names().into_iter().map(profile).collect::<Result<_, _>>()?;
    let guid = guid(&text, profiles.iter().map(String::as_str));
    let set_up = |map| Simulation::with_shared_map(scene, profiles.iter().map(String::as_str), map);
    SharedModel::obtain(guid, &directory.join("map.bin"), set_up)
}

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
