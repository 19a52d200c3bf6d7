//! The folder of a sweep or of a part of it: what its rows are of, its parts, its signals, its card.

mod array;
mod card;
mod record;
mod signals;

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use super::design::Part;
use super::rows;
use super::scenes::run_name;
use crate::interrupt::Temporary;
use crate::run::signals::Signals;
use crate::shared::NotWritten;
use array::{ArrayFile, Of};
pub(super) use card::Card;
pub(super) use record::Record;
pub(crate) use signals::SignalFormat;

/// Name of the array of all runs.
const ARRAY: &str = "signals.npy";

/// A folder that nobody else writes in.
pub(super) struct Folder {
    pub(super) path: PathBuf,
    /// Where signals grow: empty at first, and removed at the end.
    pub(super) running: PathBuf,
    written: Option<SignalFormat>,
    /// Those of the folder itself and of parts in it.
    arrays: Vec<ArrayFile>,
    _lock: File,
    _temporary: Temporary,
}

impl Folder {
    /// The folder of a sweep, or that of a part in it; without a part, it takes over rows and signals of parts that
    /// are there.
    ///
    /// # Errors
    /// A folder of another sweep, or in which another program sweeps.
    pub(super) fn open(
        path: &Path,
        part: Option<Part>,
        written: Option<SignalFormat>,
        record: &Record,
    ) -> Result<Self> {
        let path = part.map_or(path.to_owned(), |part| path.join(part.folder()));
        fs::create_dir_all(&path).with_context(|| path.display().to_string())?;
        let _lock = lock(&path)?;
        record.claim(&path)?;
        let running = path.join("running");
        // What a sweep has left that was killed.
        let _ = fs::remove_dir_all(&running);
        let made = || fs::create_dir_all(&running).map(|()| running.clone());
        let (_temporary, running) =
            Temporary::made(made, PathBuf::as_path).with_context(|| running.display().to_string())?;
        let part = part.unwrap_or(Part::ALL);
        let mut folder = Self { path, running, written, arrays: Vec::new(), _lock, _temporary };
        if written.is_some() {
            fs::create_dir_all(folder.single()).with_context(|| folder.single().display().to_string())?;
        }
        if written == Some(SignalFormat::Array) {
            folder.arrays.extend(ArrayFile::read(folder.path.join(ARRAY), Of::Part(part))?);
        }
        folder.take_parts(record)?;
        Ok(folder)
    }

    /// Where signals of single runs go.
    fn single(&self) -> PathBuf {
        self.path.join("signals")
    }

    /// Where the user finds signals.
    pub(super) fn signals(&self) -> Option<PathBuf> {
        self.written.map(|written| if written == SignalFormat::Array { self.path.join(ARRAY) } else { self.single() })
    }

    fn file(&self, written: SignalFormat, run: u64) -> PathBuf {
        self.single().join(written.file(&run_name(run)))
    }

    /// Whether the signals of a run that did not fail are wanted and not there.
    pub(super) fn lacks_signals(&self, run: u64) -> bool {
        let is_there = |array: &ArrayFile| array.place(run).is_some();
        self.written.is_some_and(|written| !self.file(written, run).exists() && !self.arrays.iter().any(is_there))
    }

    /// Writes the signals of a run of this scene file if they are wanted, of which the first is the time.
    pub(super) fn write(&self, kept: &Signals, run: u64, rate: f64, scene: &str) -> Result<()> {
        let Some(written) = self.written else { return Ok(()) };
        written.write(kept, &run_name(run), rate, scene, &self.single()).map(drop)
    }

    /// Puts the signals of all `runs` of this folder, of which some have `failed`, into one array if that is wanted and
    /// they are all there, and takes away what it is made of.
    pub(super) fn put_together(&self, runs: &[u64], failed: &BTreeSet<u64>) -> Result<()> {
        if self.written != Some(SignalFormat::Array)
            || runs.iter().any(|run| !failed.contains(run) && self.lacks_signals(*run))
        {
            return Ok(());
        }
        let path = self.path.join(ARRAY);
        let single = |run: &u64| ArrayFile::read(self.file(SignalFormat::Array, *run), Of::Run(*run));
        let singles = runs.iter().map(single).collect::<Result<Vec<_>>>()?;
        let is_whole = |array: &ArrayFile| array.path == path && array.runs == runs.len() as u64;
        if !(singles.iter().all(Option::is_none) && self.arrays.iter().any(is_whole)) {
            let from = |(run, single): (&u64, _)| {
                let in_array = || self.arrays.iter().find(|array| array.place(*run).is_some());
                (*run, Option::or_else(Option::as_ref(single), in_array).filter(|_| !failed.contains(run)))
            };
            let runs: Vec<_> = runs.iter().zip(&singles).map(from).collect();
            ArrayFile::join(&runs, &path)?;
        }
        for array in self.arrays.iter().filter(|array| array.path != path) {
            fs::remove_file(&array.path).with_context(|| array.path.display().to_string())?;
        }
        fs::remove_dir_all(self.single()).with_context(|| self.single().display().to_string())
    }

    /// Adds the rows of all parts in this folder to its journal, which keeps each run once, and moves their signals
    /// here; their arrays are left until they are in this folder's own.
    fn take_parts(&mut self, record: &Record) -> Result<()> {
        for entry in fs::read_dir(&self.path).with_context(|| self.path.display().to_string())? {
            let entry = entry?;
            let Some(part) = entry.file_name().to_str().and_then(Part::of_folder) else { continue };
            let path = entry.path();
            let about = || path.display().to_string();
            let _lock = lock(&path)?;
            record.claim(&path)?;
            for file in fs::read_dir(path.join("signals")).into_iter().flatten() {
                let file = file.with_context(about)?;
                fs::rename(file.path(), self.single().join(file.file_name())).with_context(about)?;
            }
            self.arrays.extend(ArrayFile::read(path.join(ARRAY), Of::Part(part))?);
            let journal = self.path.join(rows::FILE);
            // A row that was torn must not tear another's. Rows that cannot be read are made again.
            let rows = [b"\n", &fs::read(path.join(rows::FILE)).unwrap_or_default()[..], b"\n"].concat();
            let mut out = File::options().create(true).append(true).open(&journal).with_context(about)?;
            out.write_all(&rows).map_err(|error| NotWritten::new(&journal, error))?;
        }
        Ok(())
    }
}

/// Keeps other programs from sweeping in the same folder.
fn lock(folder: &Path) -> Result<File> {
    let path: PathBuf = folder.join("lock");
    let file = File::create(&path).map_err(|error| NotWritten::new(&path, error))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => bail!("{}: another program sweeps in this folder", folder.display()),
        Err(TryLockError::Error(error)) => Err(error).with_context(|| path.display().to_string()),
    }
}
