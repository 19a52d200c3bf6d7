//! What goes wrong with a recording.

use std::io;
use std::path::PathBuf;

/// What goes wrong with a recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum RecordingError {
    /// The system refuses.
    #[error("recording {path}: {cause}. Check the folder given as recorder.folder", path = path.display())]
    Unwritable { path: PathBuf, cause: io::Error },
    /// Another instance in this process writes it.
    #[error(
        "recording {path}: instance {other:?} is writing it, and instance {name:?} would write over it. \
         Give them names that differ in letters, digits, - or _, or another recorder.folder",
        path = path.display()
    )]
    Claimed { path: PathBuf, name: String, other: String },
    /// Another process writes it, or another FMU's library in this one.
    #[error(
        "recording {path}: another process, or another FMU in this one, is writing it, and instance {name:?} would \
         write over it. Give the instances other names, or another recorder.folder",
        path = path.display()
    )]
    ClaimedElsewhere { path: PathBuf, name: String },
}
