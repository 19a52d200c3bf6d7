//! What `cargo lab dist` made of this version.
#![allow(dead_code, clippy::unwrap_used)] // each test binary uses a part of this

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use fmu_build::shared::Project;

/// The one file of `target/dist` with this end, of this version: those of earlier ones may still be there.
pub(crate) fn made(end: &str) -> PathBuf {
    let folder = Project::find().results("dist");
    let start = concat!("brinell-", env!("CARGO_PKG_VERSION"), "-");
    let entries = fs::read_dir(&folder).unwrap_or_else(|_| panic!("{}: first `cargo lab dist`", folder.display()));
    let mut found: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    let fits = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_str().unwrap();
        name.starts_with(start) && name.ends_with(end)
    };
    found.retain(fits);
    assert_eq!(found.len(), 1, "{start}…{end}: {found:?}");
    found.remove(0)
}

/// Names of all that is in a folder.
pub(crate) fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}
