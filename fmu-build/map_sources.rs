//! Fingerprint of the code that computes contact maps: a map kept on disk is used by the code that computed it only.
//!
//! For the build script, which tells it to the program, and for tests.

use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// All in the workspace on which the bits of a map depend: the layers below and up to `contact`, and versions of other
/// people's crates. What `scene` has to do with a map are numbers, which are in the fingerprint of its inputs.
pub(crate) const SOURCES: [&str; 5] = ["Cargo.lock", "src/numerics", "src/geometry", "src/surface", "src/contact"];

/// Of names and contents of all these files in a workspace, in hexadecimal digits.
///
/// # Errors
/// Where one cannot be read.
pub(crate) fn fingerprint(root: &Path) -> io::Result<String> {
    let mut files = Vec::new();
    for source in SOURCES {
        add_files(&root.join(source), &mut files)?;
    }
    files.sort();
    let mut sum = DefaultHasher::new();
    for file in files {
        let bytes = fs::read(&file)?;
        sum.write(file.strip_prefix(root).unwrap_or(&file).as_os_str().as_encoded_bytes());
        sum.write_usize(bytes.len());
        sum.write(&bytes);
    }
    Ok(format!("{:016x}", sum.finish()))
}

fn add_files(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !path.is_dir() {
        files.push(path.to_owned());
        return Ok(());
    }
    for entry in fs::read_dir(path)? {
        add_files(&entry?.path(), files)?;
    }
    Ok(())
}
