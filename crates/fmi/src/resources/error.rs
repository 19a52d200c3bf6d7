//! What can be wrong with an FMU's resources.

use std::io;
use std::path::{Path, PathBuf};

use crate::c_interface::UriError;
use brinell::scene::model_file::ModelFileError;
use brinell::simulation::SimulationError;

/// Why the model could not be read or set up. Messages include their causes, which are therefore no `source`: the log
/// would tell them twice.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ResourceError {
    #[error(transparent)]
    Uri(#[from] UriError),
    #[error("resource {path}: {cause}")]
    Unreadable { path: PathBuf, cause: io::Error },
    #[error("profile \"{0}\": it must be the name of a file beside model.bin")]
    OutsideResources(String),
    #[error("resource {path}: {cause}")]
    Model { path: PathBuf, cause: ModelFileError },
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    #[error("out of memory: an instance asks for {:.0} MB; free some, or allow this process more", *.0 as f64 / 1e6)]
    Memory(usize),
}

impl ResourceError {
    pub(super) fn unreadable(path: &Path, cause: io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), cause }
    }
}
