//! Files that are whole or not there: a disk that fills up, or a run that fails, leaves a file of that name as it was.
//!
//! Everything is written into a temporary file in the same folder, which takes the name when its last byte is on the
//! disk. It is removed on the way out of every failure, and where a signal ends the program.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use anyhow::{Context, Result, ensure};
use tempfile::{NamedTempFile, TempDir};

use crate::interrupt::Temporary;

use super::talk::note;

/// Why a file was not written; the file of that name is what it was before.
#[derive(Debug, thiserror::Error)]
#[error(
    "{path} was not written, and what was there before is unchanged: see whether its disk is full and who may write \
     there, or choose another folder"
)]
pub struct NotWritten {
    path: String,
    /// What the system says.
    source: io::Error,
}

impl NotWritten {
    pub(crate) fn new(path: &Path, source: io::Error) -> Self {
        Self { path: path.display().to_string(), source }
    }
}

/// Writes a file of these bytes.
pub fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<()> {
    write_with(path, |out| Ok(out.write_all(bytes.as_ref())?))
}

/// Writes a file of these bytes unless it has them already; whether it did. A process that reads the old ones goes on
/// with them.
pub fn write_if_new(path: &Path, bytes: impl AsRef<[u8]>) -> Result<bool> {
    let is_new = !fs::read(path).is_ok_and(|there| there == bytes.as_ref());
    if is_new {
        write(path, bytes)?;
    }
    Ok(is_new)
}

/// Writes a file for the user and names it; one that is there stays.
///
/// # Errors
/// That it is there; of writing.
pub(crate) fn write_own(path: &Path, text: &str) -> Result<()> {
    ensure!(!path.exists(), "{} is there already and stays as it is", path.display());
    write(path, text)?;
    println!("{}", path.display());
    Ok(())
}

/// A file whose name is that of `stem`, which may hold dots, and this end.
pub(crate) fn beside(stem: &Path, end: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(end);
    name.into()
}

/// Files that are there, and when they were written.
pub(crate) type Earlier = Vec<(PathBuf, SystemTime)>;

/// What there is of these ends.
pub(crate) fn earlier(stem: &Path, ends: &[&str]) -> Earlier {
    let paths = ends.iter().map(|end| beside(stem, end));
    paths.filter_map(|path| Some((path.clone(), written(&path)?))).collect()
}

/// Names those of them that were not written anew: they do not show what a command has written since.
pub(crate) fn tell_earlier(earlier: &Earlier) {
    let left = earlier.iter().filter(|(path, at)| written(path) == Some(*at));
    let names: Vec<String> = left.map(|(path, _)| path.display().to_string()).collect();
    if !names.is_empty() {
        note!("note: of an earlier run, and left as they are: {}", names.join(", "));
    }
}

fn written(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).and_then(|about| about.modified()).ok()
}

/// Writes a file by `fill`. Where the folder is missing it is made.
///
/// # Errors
/// Of `fill`, as they are; what the system says of writing, with the path and what to do.
pub fn write_with(path: &Path, fill: impl FnOnce(&mut (dyn Write + Send)) -> Result<()>) -> Result<()> {
    let failed = |source: io::Error| NotWritten::new(path, source);
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let (_temporary, file) = Temporary::made(|| temporary(path, folder), NamedTempFile::path).map_err(failed)?;
    let mut out = BufWriter::new(file);
    if let Err(error) = fill(&mut out) {
        // Only what went wrong with writing is the disk's.
        return Err(match error.downcast::<io::Error>() {
            Ok(source) => failed(source).into(),
            Err(other) => other,
        });
    }
    let file = out.into_inner().map_err(|error| failed(error.into_error()))?;
    // Some file systems tell only now that they are full.
    file.as_file().sync_all().map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// A folder for files that grow, which is removed with all that is left in it.
#[derive(Debug)]
pub struct GrowingIn {
    folder: TempDir,
    _temporary: Temporary,
}

impl GrowingIn {
    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// A folder for files that grow, in `folder`, which is made where it is missing.
pub fn folder_in(folder: &Path) -> Result<GrowingIn> {
    let about = || folder.display().to_string();
    fs::create_dir_all(folder).with_context(about)?;
    let made = || tempfile::Builder::new().suffix(".part").tempdir_in(folder);
    let (_temporary, folder) = Temporary::made(made, TempDir::path).with_context(about)?;
    Ok(GrowingIn { folder, _temporary })
}

/// Moves a file that is whole into `folder`, in place of one of its name, and gives its path there.
pub fn take_out(file: &Path, folder: &Path) -> Result<PathBuf> {
    let path = folder.join(file.file_name().unwrap_or_default());
    match fs::rename(file, &path) {
        Ok(()) => Ok(path),
        Err(source) => Err(NotWritten::new(&path, source).into()),
    }
}

/// A temporary file that is removed unless it is given a name.
fn temporary(path: &Path, folder: &Path) -> io::Result<NamedTempFile> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".");
    let mut builder = tempfile::Builder::new();
    builder.prefix(&name).suffix(".part");
    #[cfg(unix)]
    {
        // As any file that a program makes: the user's mask takes away from this.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
        entries.map(|name| name.to_string_lossy().into_owned()).collect()
    }

    #[test]
    fn a_file_whose_filling_fails_stays_as_it_was_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("signals.csv");
        write(&path, "earlier").unwrap();
        let full = write_with(&path, |out| {
            out.write_all(&[b'1'; 100_000])?;
            Err(io::Error::from(io::ErrorKind::StorageFull).into())
        });
        let message = format!("{:#}", full.unwrap_err());
        assert!(message.contains("signals.csv was not written") && message.contains("no storage space"), "{message}");
        let other = write_with(&path, |out| {
            out.write_all(b"half")?;
            anyhow::bail!("element 3 was thrown out")
        });
        // What is none of the disk's doing is not blamed on it.
        assert_eq!(format!("{:#}", other.unwrap_err()), "element 3 was thrown out");
        assert_eq!(fs::read_to_string(&path).unwrap(), "earlier");
        assert_eq!(names(folder.path()), ["signals.csv"]);
    }

    #[test]
    fn a_folder_that_is_missing_is_made_and_one_that_cannot_be_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/b/page.md");
        write(&path, "whole").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "whole");
        let message = format!("{:#}", write(&path.join("c.md"), "").unwrap_err());
        assert!(message.contains("page.md"), "{message}");
    }

    #[cfg(unix)]
    #[test]
    fn a_file_may_be_read_by_whom_the_users_mask_lets() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        write(&ours, "").unwrap();
        fs::write(&plain, "").unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }
}
