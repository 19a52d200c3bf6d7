//! The recording: the recorder's samples in a file that `numpy.load` reads.
//!
//! One NumPy array with a named field for the time and for each signal ([format 2.0][npy]), so
//! `numpy.load("bearing.npy")["sensor.acceleration"]` is a signal; where a bearing has many elements, with arrays over
//! them ([`Layout`]). The header is written anew with the number of rows after each write, so the file can be read at
//! any time. Samples that a host takes back by restoring a state are written over. A file has one writer (`claim`).
//!
//! [npy]: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

mod claim;
mod error;
mod layout;

pub use error::RecordingError;
pub use layout::Layout;

use std::fs;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::simulation::Simulation;
use crate::simulation::recorder::Samples;
use claim::Claim;

/// Samples that are not in the file yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unstored {
    /// How many.
    pub count: usize,
    /// Time of the first (s).
    pub from: f64,
    /// Time of the last (s).
    pub to: f64,
}

/// A recording that grows.
#[derive(Debug)]
pub struct Recording {
    path: PathBuf,
    claim: Claim,
    layout: Layout,
    /// Length of the header (bytes).
    header: u64,
    /// Number of the first row in the file.
    first: u64,
    rows: u64,
}

/// Values that [`Recording::keep_up`] lets gather before it writes: half a megabyte.
const GATHERED: usize = 1 << 16;

impl Recording {
    /// Begins the recording `<name>.npy` of a simulation, in the folder that its recorder has been given; `None` if
    /// there is none. Characters of `name` that not every file system takes become `_`. The recording of a run that is
    /// over is written over.
    ///
    /// # Errors
    /// A folder that can be neither used nor made, a file that cannot be written or that another instance writes.
    pub fn begin(simulation: &Simulation, name: &str) -> Result<Option<Self>, RecordingError> {
        let Some(recorder) = simulation.recorder() else { return Ok(None) };
        let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        let stem: String = name.trim_start_matches('.').chars().map(plain).collect();
        let path = Path::new(recorder.folder()).join(format!("{stem}.npy"));
        let mut names = vec!["time".to_owned()];
        names.extend(recorder.references().map(|reference| simulation.table()[reference as usize].name.clone()));
        if let Err(cause) = fs::create_dir_all(recorder.folder()) {
            return Err(RecordingError::Unwritable { path, cause });
        }
        let claim = Claim::new(&path, name)?;
        let layout = Layout::of(&names);
        let header = layout.header(0).len() as u64;
        let mut recording = Self { path, claim, layout, header, first: recorder.samples().first, rows: 0 };
        recording.count(0).map_err(|cause| recording.failed(cause))?;
        recording.write(simulation)?;
        Ok(Some(recording))
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Stores the samples of a simulation if many have gathered.
    ///
    /// # Errors
    /// A file that cannot be written. The samples are kept.
    #[inline]
    pub fn keep_up(&mut self, simulation: &mut Simulation) -> Result<(), RecordingError> {
        let gathered = simulation.recorder().map_or(0, |recorder| recorder.samples().values.len());
        if gathered < GATHERED { Ok(()) } else { self.store(simulation) }
    }

    /// Stores the samples of a simulation, all of them.
    ///
    /// # Errors
    /// A file that cannot be written. The samples are kept, and the file holds what it held.
    pub fn store(&mut self, simulation: &mut Simulation) -> Result<(), RecordingError> {
        self.write(simulation)?;
        simulation.forget_samples();
        Ok(())
    }

    fn write(&mut self, simulation: &Simulation) -> Result<(), RecordingError> {
        let Some(recorder) = simulation.recorder() else { return Ok(()) };
        self.put(recorder.samples()).map_err(|cause| self.failed(cause))
    }

    fn failed(&self, cause: io::Error) -> RecordingError {
        RecordingError::Unwritable { path: self.path.clone(), cause }
    }

    fn put(&mut self, samples: Samples) -> io::Result<()> {
        let start = samples.first.saturating_sub(self.first);
        if samples.first < self.first || start < self.rows {
            // Taken back: out of the file before others come in their place, or a full disk would leave both in it.
            self.count(start)?;
        }
        if self.rows == 0 {
            self.first = samples.first;
        }
        if samples.values.is_empty() {
            return Ok(());
        }
        let start = samples.first - self.first;
        let mut bytes = Vec::with_capacity(8 * samples.values.len());
        // Rows that another instance took, if the state came from there: not known here, and said so.
        for _ in self.rows..start {
            bytes.extend(std::iter::repeat_n(f64::NAN.to_le_bytes(), samples.width).flatten());
        }
        for row in samples.values.chunks_exact(samples.width) {
            bytes.extend(self.layout.order().iter().flat_map(|&index| row[index].to_le_bytes()));
        }
        let end = self.end(self.rows);
        let file = &mut self.claim.file;
        if let Err(cause) = file.seek(SeekFrom::Start(end)).and_then(|_| file.write_all(&bytes)) {
            // What fitted is no row that is counted.
            drop(file.set_len(end));
            return Err(cause);
        }
        self.count(start + (samples.values.len() / samples.width) as u64)
    }

    /// Makes the file one of so many rows.
    fn count(&mut self, rows: u64) -> io::Result<()> {
        let file = &mut self.claim.file;
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&self.layout.header(rows))?;
        self.rows = rows;
        let end = self.end(rows);
        self.claim.file.set_len(end)
    }

    /// Length of a file of so many rows (bytes).
    fn end(&self, rows: u64) -> u64 {
        self.header + 8 * self.layout.order().len() as u64 * rows
    }
}

impl Unstored {
    /// The samples of a simulation that its recording has not stored.
    pub fn of(simulation: &Simulation) -> Option<Self> {
        let samples = simulation.recorder()?.samples();
        let mut times = samples.values.iter().step_by(samples.width);
        let from = *times.next()?;
        Some(Self { count: samples.values.len() / samples.width, from, to: *times.next_back().unwrap_or(&from) })
    }
}
