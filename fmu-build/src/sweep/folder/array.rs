//! Signals of many runs in one NumPy file: runs × samples × sensors (m/s²), without times.
//!
//! A single run is an array of one. That of a sweep or of a part of it is put together of single ones when all are
//! there; one with n runs has the first n of its part, so that a longer sweep takes them from it.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::run::signals::Signals;
use crate::shared::whole_file;
use crate::sweep::design::Part;

/// Bytes before the numbers, enough for any shape.
const HEADER: usize = 128;
/// NumPy's, with version 1.0 of the format and the length of what follows.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00\x76\x00";
const DESCRIPTION: &str = "{'descr': '<f8', 'fortran_order': False, 'shape': (";

/// Whose runs an array has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// One run.
    Run(u64),
    /// The first of a part, or of all.
    Part(Part),
}

/// An array that is there.
#[derive(Debug)]
pub(super) struct ArrayFile {
    pub(super) path: PathBuf,
    pub(super) of: Of,
    /// How many.
    pub(super) runs: u64,
    samples: u64,
    sensors: u64,
}

impl ArrayFile {
    /// The array of a file; `None` if there is no such file.
    ///
    /// # Errors
    /// A file that no sweep has written.
    pub(super) fn read(path: PathBuf, of: Of) -> Result<Option<Self>> {
        let mut file = match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            file => file.with_context(|| path.display().to_string())?,
        };
        let (mut head, length) = (vec![0; HEADER], file.metadata()?.len());
        let shape = file.read_exact(&mut head).ok().and_then(|()| shape(&head));
        match shape {
            Some([runs, samples, sensors]) if length == HEADER as u64 + 8 * runs * samples * sensors => {
                Ok(Some(Self { path, of, runs, samples, sensors }))
            }
            _ => bail!("{} is no array that a sweep has written: take it away", path.display()),
        }
    }

    /// Writes that of one run of these signals, of which the first is the time.
    pub(super) fn write(signals: &Signals, path: &Path) -> Result<()> {
        whole_file::write_with(path, |out| {
            out.write_all(&header([1, signals.rows(), signals.names().len() as u64 - 1]))?;
            signals.each_row(|row| Ok(row[1..].iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))?))
        })
    }

    /// Where a run stands, if it is here.
    pub(super) fn place(&self, run: u64) -> Option<u64> {
        let place = match self.of {
            Of::Run(only) => (only == run).then_some(0),
            Of::Part(part) => part.place(run),
        };
        place.filter(|place| *place < self.runs)
    }

    /// Writes the array of runs, each with its number and the array that it is taken from; those without one have
    /// failed and are not numbers.
    ///
    /// # Errors
    /// A run that has other samples or sensors than those before.
    pub(super) fn join(runs: &[(u64, Option<&Self>)], path: &Path) -> Result<()> {
        let mut there = runs.iter().filter_map(|(run, array)| Some((run, (*array)?)));
        let Some((first, like)) = there.next() else { return Ok(()) };
        if let Some((run, other)) =
            there.find(|(_, array)| (array.samples, array.sensors) != (like.samples, like.sensors))
        {
            bail!(
                "run {run} has {} samples of {} sensors, and run {first} has {} of {}: in one array all must have as \
                 many; --signals npy writes a file for each",
                other.samples,
                other.sensors,
                like.samples,
                like.sensors
            );
        }
        let size = 8 * like.samples * like.sensors;
        let missing = f64::NAN.to_le_bytes().repeat((size / 8) as usize);
        whole_file::write_with(path, |out| {
            out.write_all(&header([runs.len() as u64, like.samples, like.sensors]))?;
            // Neighbours often stand in one file.
            let mut open: Option<(&Path, File)> = None;
            for (run, array) in runs {
                let Some((array, place)) = array.and_then(|array| Some((array, array.place(*run)?))) else {
                    out.write_all(&missing)?;
                    continue;
                };
                let about = || array.path.display().to_string();
                let mut file = match open.take() {
                    Some((path, file)) if path == array.path => file,
                    _ => File::open(&array.path).with_context(about)?,
                };
                file.seek(SeekFrom::Start(HEADER as u64 + place * size)).with_context(about)?;
                let copied = io::copy(&mut (&mut file).take(size), out)?;
                if copied != size {
                    bail!("{} ends within run {run}", about());
                }
                open = Some((&array.path, file));
            }
            Ok(())
        })
    }
}

fn header([runs, samples, sensors]: [u64; 3]) -> Vec<u8> {
    let text = format!("{DESCRIPTION}{runs}, {samples}, {sensors}), }}");
    let mut bytes = [MAGIC, text.as_bytes()].concat();
    bytes.resize(HEADER - 1, b' ');
    bytes.push(b'\n');
    bytes
}

/// Runs, samples and sensors of a header.
fn shape(head: &[u8]) -> Option<[u64; 3]> {
    let text = std::str::from_utf8(head.strip_prefix(MAGIC)?).ok()?;
    let (shape, _) = text.strip_prefix(DESCRIPTION)?.split_once(')')?;
    let numbers: Vec<u64> = shape.split(", ").map(|number| number.parse().ok()).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn single(folder: &Path, run: u64, samples: usize) -> ArrayFile {
        let path = folder.join(format!("{run}.npy"));
        let numbers = (0..samples).flat_map(|k| (run as f64 + k as f64 / 8.0).to_le_bytes());
        std::fs::write(&path, [header([1, samples as u64, 1]), numbers.collect()].concat()).unwrap();
        ArrayFile::read(path, Of::Run(run)).unwrap().unwrap()
    }

    #[test]
    fn runs_stand_in_their_order_and_those_that_failed_are_not_numbers() {
        let folder = tempfile::tempdir().unwrap();
        let [one, two] = [1, 4].map(|run| single(folder.path(), run, 3));
        let part = folder.path().join("part.npy");
        let second: Part = "2/3".parse().unwrap();
        ArrayFile::join(&[(1, Some(&one)), (4, Some(&two))], &part).unwrap();
        let part = ArrayFile::read(part, Of::Part(second)).unwrap().unwrap();
        assert_eq!([0, 1, 4, 7].map(|run| part.place(run)), [None, Some(0), Some(1), None]);
        let whole = folder.path().join("whole.npy");
        let [zero, three] = [0, 3].map(|run| single(folder.path(), run, 3));
        ArrayFile::join(&[(0, Some(&zero)), (1, Some(&part)), (2, None), (3, Some(&three)), (4, Some(&part))], &whole)
            .unwrap();
        let bytes = std::fs::read(&whole).unwrap();
        let numbers: Vec<f64> =
            bytes[HEADER..].chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect();
        let run = |run: f64| [run, run + 0.125, run + 0.25];
        assert_eq!([&numbers[..6], &numbers[9..]].concat(), [0.0, 1.0, 3.0, 4.0].map(run).concat());
        assert!(numbers[6..9].iter().all(|number| number.is_nan()));
        assert!(String::from_utf8_lossy(&bytes[..HEADER]).contains("'shape': (5, 3, 1)"));
    }

    #[test]
    fn runs_of_unequal_length_and_files_of_others_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let [long, short] = [(0, 5), (7, 4)].map(|(run, samples)| single(folder.path(), run, samples));
        let why = ArrayFile::join(&[(0, Some(&long)), (7, Some(&short))], &folder.path().join("all.npy")).unwrap_err();
        assert!(why.to_string().contains("run 7 has 4 samples of 1 sensors, and run 0 has 5 of 1"), "{why}");
        assert!(!folder.path().join("all.npy").exists());
        let path = folder.path().join("others.npy");
        for bytes in [&b"mine"[..], &header([2, 2, 2])] {
            std::fs::write(&path, bytes).unwrap();
            let why = ArrayFile::read(path.clone(), Of::Run(0)).unwrap_err().to_string();
            assert!(why.contains("others.npy is no array that a sweep has written"), "{why}");
        }
    }
}
