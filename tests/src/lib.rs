//! What all tests of this package stand on.
// What helpers unwrap is a test's own set-up.
#![allow(clippy::unwrap_used, clippy::expect_used)]

pub mod page;
pub mod resources;
pub mod snapshot;

use std::fs;
use std::path::{Path, PathBuf};

/// Root of the workspace.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// All files with an extension in a folder and below it, sorted, but for those in folders `target`; none where there is
/// no such folder.
pub fn files_below(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let (mut files, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.is_dir() && !path.ends_with("target") {
                folders.push(path);
            } else if path.extension().is_some_and(|found| found == extension) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
