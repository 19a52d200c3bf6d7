//! One writer per recording: whoever begins a recording claims its file, and nobody else gets it until the claim is
//! dropped.
//!
//! The system keeps the claim, so it holds against other processes and ends with the process, however that ends: a lock
//! on the file where locks only bind those who ask for them, and on Windows, where a lock would shut out readers as
//! well, an opening that lets others read but not write. On file systems that know no locks it holds within the process
//! only.
//!
//! What the system does not know is whose claim it is. A list in the process knows the instances' names.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use super::error::RecordingError;
use crate::numerics::lists::opened;

/// Files claimed in this process and the names of the instances that write them.
static CLAIMED: Mutex<Vec<(PathBuf, String)>> = Mutex::new(Vec::new());

/// A file that is open for writing, and nobody else's.
#[derive(Debug)]
pub(super) struct Claim {
    /// The file, empty when it was claimed.
    pub(super) file: File,
    /// Its canonical path, or the one given where the file system cannot say.
    canonical: PathBuf,
}

impl Claim {
    /// Claims a file for the instance `name` and empties it; the file is made if there is none.
    pub(super) fn new(path: &Path, name: &str) -> Result<Self, RecordingError> {
        let failed = |cause| RecordingError::Unwritable { path: path.to_owned(), cause };
        let file = open(path).map_err(failed)?;
        // Some file systems cannot say where a file really is; names are then found by the path given.
        let canonical = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let (path, name) = (path.to_owned(), name.to_owned());
        // Without the list the system's lock is what there is.
        let listed = opened(&CLAIMED).map(|mut claimed| {
            let other = claimed.iter().find(|(other, _)| *other == canonical).map(|(_, other)| other.clone());
            if other.is_none() && file.is_some() {
                claimed.push((canonical.clone(), name.clone()));
            }
            other
        });
        if let Some(Some(other)) = listed {
            return Err(RecordingError::Claimed { path, name, other });
        }
        let Some(file) = file else { return Err(RecordingError::ClaimedElsewhere { path, name }) };
        let claim = Self { file, canonical };
        claim.file.set_len(0).map_err(|cause| RecordingError::Unwritable { path, cause })?;
        Ok(claim)
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        if let Some(mut claimed) = opened(&CLAIMED) {
            claimed.retain(|(canonical, _)| *canonical != self.canonical);
            if claimed.is_empty() {
                // Nothing is left of the list when the library is unloaded.
                *claimed = Vec::new();
            }
        }
        // A child that was forked in the meantime has the file open as well, and closing it here would not free it.
        drop(self.file.unlock());
    }
}

/// Opens a file for writing and keeps it as it is; `None` if somebody else writes it.
#[cfg(not(windows))]
fn open(path: &Path) -> io::Result<Option<File>> {
    let file = OpenOptions::new().write(true).create(true).truncate(false).open(path)?;
    match file.try_lock() {
        Err(fs::TryLockError::WouldBlock) => Ok(None),
        // A file system without locks is no reason to record nothing.
        Ok(()) | Err(fs::TryLockError::Error(_)) => Ok(Some(file)),
    }
}

/// Opens a file for writing and keeps it as it is; `None` if somebody else writes it.
#[cfg(windows)]
fn open(path: &Path) -> io::Result<Option<File>> {
    use std::os::windows::fs::OpenOptionsExt;
    /// Others may open it to read, and for nothing else.
    const FILE_SHARE_READ: u32 = 1;
    const ERROR_SHARING_VIOLATION: i32 = 32;
    let opened = OpenOptions::new().write(true).create(true).truncate(false).share_mode(FILE_SHARE_READ).open(path);
    match opened {
        Err(cause) if cause.raw_os_error() == Some(ERROR_SHARING_VIOLATION) => Ok(None),
        opened => opened.map(Some),
    }
}
