//! What can be wrong with an FMU's resources.

use std::io;
use std::path::{Path, PathBuf};

use crate::c_interface::UriError;
use brinell::scene::SceneError;
use brinell::simulation::SimulationError;

/// Why the model could not be read or set up. Messages include their causes, which are therefore no `source`: the log
/// would tell them twice.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ResourceError {
    /// The location names no path.
    #[error(transparent)]
    Uri(#[from] UriError),
    /// A file that cannot be read.
    #[error("resource {path}: {cause}")]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A profile that does not lie in the directory.
    #[error("profile \"{0}\": it must be the name of a file beside scene.toml")]
    OutsideResources(String),
    /// A scene that is refused.
    #[error("resource {path}: {cause}")]
    Scene {
        /// Path of the scene.
        path: PathBuf,
        /// What is wrong with it.
        cause: SceneError,
    },
    /// A scene that cannot be set up.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

impl ResourceError {
    pub(super) fn unreadable(path: &Path, cause: io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), cause }
    }
}
