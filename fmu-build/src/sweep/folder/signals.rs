//! What signals of a sweep's runs are written as.

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::ValueEnum;

use super::array::ArrayFile;
use crate::run::signals::Signals;
use crate::run::table::{self, Format};
use crate::run::wav::Wav;
use crate::shared::{NotWritten, whole_file};

/// What each run's signals are written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SignalFormat {
    /// NumPy's file, a field for the time and for each sensor
    Npy,
    /// Apache Parquet, packed
    Parquet,
    /// Sound, a channel for each sensor; 1 is 1 m/s²
    Wav,
    /// One NumPy file of all runs, signals.npy: runs × samples × sensors
    Array,
}

impl SignalFormat {
    /// Name of the file of a run.
    pub(super) fn file(self, name: &str) -> String {
        let ending = match self {
            Self::Npy | Self::Array => "npy",
            Self::Parquet => "parquet",
            Self::Wav => "wav",
        };
        format!("{name}.{ending}")
    }

    /// Writes the signals of a run of this scene file, of which the first is the time (s) and the others are sensors'
    /// (m/s²), beside where they grew, and moves them to `folder` when they are whole: a program that is ended leaves
    /// nothing there.
    pub(super) fn write(self, kept: &Signals, name: &str, rate: f64, scene: &str, folder: &Path) -> Result<PathBuf> {
        let unit = |k: usize| if k == 0 { "s" } else { "m/s2" };
        let columns: Vec<_> = (0..kept.names().len()).map(|index| table::Column { index, unit: unit(index) }).collect();
        let whole = kept.path().with_file_name(self.file(name));
        match self {
            Self::Npy => std::fs::rename(kept.path(), &whole).map_err(|error| NotWritten::new(&whole, error))?,
            Self::Parquet => Format::Parquet.write(kept, &columns, &table::origin(scene), &whole)?,
            Self::Wav => {
                let sensors: Vec<usize> = (1..kept.names().len()).collect();
                Wav { rate: Some(rate), scale: 1.0 }.write(kept, &sensors, rate, &whole)?;
            }
            Self::Array => ArrayFile::write(kept, &whole)?,
        }
        whole_file::take_out(&whole, folder)
    }
}
