//! The recording: the recorder's samples in a file that `numpy.load` reads.
//!
//! One NumPy array with a named field for the time and for each signal ([format 2.0][npy]), so
//! `numpy.load("bearing.npy")["sensor.acceleration"]` is a signal. The header is written anew with the number of rows
//! after each write, so the file can be read at any time. Samples that a host takes back by restoring a state are
//! written over.
//!
//! [npy]: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::simulation::Simulation;
use crate::simulation::recorder::Samples;

/// What goes wrong with a recording.
#[derive(Debug, thiserror::Error)]
#[error("recording {path}: {cause}. Check the folder given as recorder.folder", path = path.display())]
pub struct RecordingError {
    /// The file.
    path: PathBuf,
    /// What the system says.
    cause: io::Error,
}

/// A recording that grows.
#[derive(Debug)]
pub struct Recording {
    path: PathBuf,
    file: File,
    names: Vec<String>,
    /// Length of the header [bytes].
    header: u64,
    /// Number of the first row in the file.
    first: u64,
    rows: u64,
}

/// Values that [`Recording::keep_up`] lets gather before it writes: half a megabyte.
const GATHERED: usize = 1 << 16;

impl Recording {
    /// Begins the recording `<name>.npy` of a simulation, in the folder that its recorder has been given; `None` if there
    /// is none. Characters of `name` that not every file system takes become `_`.
    ///
    /// # Errors
    /// A folder that can be neither used nor made, a file that cannot be written.
    pub fn begin(simulation: &Simulation, name: &str) -> Result<Option<Self>, RecordingError> {
        let Some(recorder) = simulation.recorder() else { return Ok(None) };
        let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        let stem: String = name.trim_start_matches('.').chars().map(plain).collect();
        let path = Path::new(recorder.folder()).join(format!("{stem}.npy"));
        let mut names = vec!["time".to_owned()];
        names.extend(recorder.references().map(|reference| simulation.table()[reference as usize].name.clone()));
        let create = || {
            fs::create_dir_all(recorder.folder())?;
            File::create(&path)
        };
        let file = match create() {
            Ok(file) => file,
            Err(cause) => return Err(RecordingError { path, cause }),
        };
        let header = header(&names, 0).len() as u64;
        let mut recording = Self { path, file, names, header, first: 0, rows: 0 };
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
    /// A file that cannot be written. The samples are kept.
    pub fn store(&mut self, simulation: &mut Simulation) -> Result<(), RecordingError> {
        self.write(simulation)?;
        simulation.forget_samples();
        Ok(())
    }

    fn write(&mut self, simulation: &Simulation) -> Result<(), RecordingError> {
        let Some(recorder) = simulation.recorder() else { return Ok(()) };
        self.put(recorder.samples()).map_err(|cause| RecordingError { path: self.path.clone(), cause })
    }

    fn put(&mut self, samples: Samples) -> io::Result<()> {
        if self.rows == 0 || samples.first < self.first {
            (self.first, self.rows) = (samples.first, 0);
        }
        let mut bytes = Vec::with_capacity(8 * samples.values.len());
        let start = samples.first - self.first;
        // Rows that another instance took, if the state came from there: not known here, and said so.
        for _ in self.rows..start {
            bytes.extend(std::iter::repeat_n(f64::NAN.to_le_bytes(), samples.width).flatten());
        }
        bytes.extend(samples.values.iter().flat_map(|value| value.to_le_bytes()));
        let row = 8 * samples.width as u64;
        self.file.seek(SeekFrom::Start(self.header + row * self.rows.min(start)))?;
        self.file.write_all(&bytes)?;
        self.rows = start + samples.values.len() as u64 / samples.width as u64;
        self.file.set_len(self.header + row * self.rows)?;
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(&header(&self.names, self.rows))
    }
}

/// The header of an array of `rows` rows; its length does not depend on `rows`.
fn header(names: &[String], rows: u64) -> Vec<u8> {
    let fields: String = names.iter().map(|name| format!("('{name}', '<f8'), ")).collect();
    let shape = format!("({rows},)");
    let mut text = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': {shape:<24}}}");
    // Magic, version and length take 12 bytes; the whole is a multiple of 64 and ends in a new line.
    let length = (12 + text.len() + 1).next_multiple_of(64) - 12;
    text.extend(std::iter::repeat_n(' ', length - 1 - text.len()));
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x02\x00".to_vec();
    bytes.extend((length as u32).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes
}
