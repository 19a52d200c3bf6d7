//! A recording's file as named columns, and which of them is what.
//!
//! Text ([`recording_csv`](super::recording_csv)), NumPy ([`recording_npy`](super::recording_npy)) and WAV, which goes through
//! `hound`. Columns are chosen by name or by number from 1. Left to itself, the signal is the column whose name begins with
//! `sensor.acceleration`, else with `acc`, `vib` or `signal`, else the only one, else, where columns have no names, the first that
//! is no time. Time is a column whose name begins with `time` or `t` alone, or an unnamed first column beside others that rises evenly.

use super::error::SizingError;
use super::{recording_csv, recording_npy};
use std::path::Path;

/// What a file holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Table {
    /// Headings; empty where the file has none.
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    time: Option<usize>,
    /// Sampling rate [Hz], where the file states it.
    pub(super) rate: Option<f64>,
}

impl Table {
    /// Reads a file.
    pub(super) fn read(path: &Path) -> Result<Self, SizingError> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let refuse = |why: String| SizingError::Format { path: path.to_owned(), why };
        let bytes = || std::fs::read(path).map_err(|source| SizingError::File { path: path.to_owned(), source });
        match ending.as_str() {
            "csv" | "txt" => recording_csv::columns(&String::from_utf8_lossy(&bytes()?))
                .map(|(names, columns)| Self::new(names, columns))
                .map_err(refuse),
            "npy" => recording_npy::columns(&bytes()?).map(|columns| Self::new(Vec::new(), columns)).map_err(refuse),
            "wav" => wav(&bytes()?).map_err(refuse),
            _ => Err(refuse(format!("ending '{ending}': recordings are .csv, .txt, .npy or .wav"))),
        }
    }

    fn new(names: Vec<String>, columns: Vec<Vec<f64>>) -> Self {
        let time = if names.is_empty() {
            (columns.len() > 1 && rises_evenly(&columns[0])).then_some(0)
        } else {
            names.iter().map(|name| bare(name)).position(|name| name == "t" || name.starts_with("time"))
        };
        let rate = time.and_then(|time| rate_of(&columns[time])).map(|rate| {
            let in_milliseconds = names.get(time.unwrap_or_default()).is_some_and(|name| name.contains("ms"));
            if in_milliseconds { 1e3 * rate } else { rate }
        });
        Self { names, columns, time, rate }
    }

    /// The column of this name or number; without either, the one that is a signal by itself.
    pub(super) fn signal(&self, choice: Option<&str>) -> Result<Vec<f64>, String> {
        if let Some(choice) = choice {
            return self.column(choice).map(|(_, column)| column.to_vec());
        }
        let begins = |with: &str| self.names.iter().position(|name| bare(name).starts_with(with));
        let by_name = ["sensor.acceleration", "acc", "vib", "signal"].into_iter().find_map(begins);
        let mut others = (0..self.columns.len()).filter(|&i| Some(i) != self.time);
        let found = by_name.or_else(|| {
            let first = others.next();
            if self.names.is_empty() || others.next().is_none() { first } else { None }
        });
        match found {
            Some(found) => Ok(self.columns[found].clone()),
            None => Err(format!("{}: which is the signal? Choose one", self.listed())),
        }
    }

    /// Heading and values of the column of this name or number.
    pub(super) fn column(&self, choice: &str) -> Result<(&str, &[f64]), String> {
        let wanted = choice.trim().to_lowercase();
        let same = |name: &String| name.to_lowercase() == wanted || bare(name) == wanted;
        let number = || wanted.parse::<usize>().ok()?.checked_sub(1).filter(|&i| i < self.columns.len());
        let found = self.names.iter().position(same).or_else(number);
        let found = found.ok_or_else(|| format!("no column '{choice}' among {}", self.listed()))?;
        Ok((self.names.get(found).map_or("", String::as_str), &self.columns[found]))
    }

    fn listed(&self) -> String {
        match (&self.names[..], self.columns.len()) {
            ([], count) => format!("{count} columns without names"),
            (names, count) if count > 12 => format!("{count} columns from {}", names[..12].join(", ")),
            (names, _) => format!("columns {}", names.join(", ")),
        }
    }
}

/// A heading without its unit, in small letters.
fn bare(name: &str) -> String {
    name.split(['[', '(']).next().unwrap_or_default().trim().to_lowercase()
}

fn rate_of(time: &[f64]) -> Option<f64> {
    let span = time.last()? - time.first()?;
    let rate = (time.len() - 1) as f64 / span;
    (rate.is_finite() && rate > 0.0).then_some(rate)
}

/// Whether every step is the mean step within half of it: printed times are rounded.
fn rises_evenly(column: &[f64]) -> bool {
    let Some(rate) = rate_of(column) else { return false };
    column.windows(2).all(|pair| ((pair[1] - pair[0]) * rate - 1.0).abs() < 0.5)
}

fn wav(bytes: &[u8]) -> Result<Table, String> {
    let mut reader = hound::WavReader::new(bytes).map_err(|e| e.to_string())?;
    let spec = reader.spec();
    let samples: Result<Vec<f64>, _> = match spec.sample_format {
        hound::SampleFormat::Float => reader.samples::<f32>().map(|s| s.map(f64::from)).collect(),
        hound::SampleFormat::Int => reader.samples::<i32>().map(|s| s.map(f64::from)).collect(),
    };
    let columns = deinterleaved(&samples.map_err(|e| e.to_string())?, spec.channels as usize);
    Ok(Table { names: Vec::new(), columns, time: None, rate: Some(f64::from(spec.sample_rate)) })
}

/// Channels out of samples that take turns.
pub(super) fn deinterleaved(samples: &[f64], channels: usize) -> Vec<Vec<f64>> {
    (0..channels.max(1)).map(|k| samples.iter().skip(k).step_by(channels.max(1)).copied().collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn csv(text: &str) -> Table {
        let (names, columns) = recording_csv::columns(text).unwrap();
        Table::new(names, columns)
    }

    #[test]
    fn the_signal_is_found_by_name_and_time_gives_the_rate() {
        let table =
            csv("time [s],cage.angle [rad],sensor.acceleration [m/s2],tacho\n0.0,9,1,0\n0.5,9,2,5\n1.0,9,3,0\n");
        assert_eq!((table.signal(None).unwrap(), table.rate), (vec![1.0, 2.0, 3.0], Some(2.0)));
        assert_eq!(table.column("tacho").unwrap(), ("tacho", [0.0, 5.0, 0.0].as_slice()));
        assert_eq!(table.column("Cage.Angle").unwrap().1, [9.0; 3]);
        assert_eq!(table.signal(Some("4")).unwrap(), [0.0, 5.0, 0.0]);
        assert_eq!(csv("Time (ms),x\n0,7\n1,8\n2,9\n").rate, Some(1e3));
    }

    #[test]
    fn a_first_column_without_name_that_rises_evenly_is_time() {
        let table = csv("0.0 5\n0.25 6\n0.5 3\n");
        assert_eq!((table.signal(None).unwrap(), table.rate), (vec![5.0, 6.0, 3.0], Some(4.0)));
        // Alone it is a signal, and one that goes up and down is one too.
        assert_eq!(csv("0.0\n0.25\n0.5\n").signal(None).unwrap(), [0.0, 0.25, 0.5]);
        assert_eq!(csv("1 5\n-1 6\n2 3\n").signal(None).unwrap(), [1.0, -1.0, 2.0]);
    }

    #[test]
    fn a_choice_that_cannot_be_met_lists_the_columns() {
        let table = csv("left,right\n1,2\n3,4\n");
        assert!(table.signal(None).is_err_and(|e| e.contains("left, right")));
        assert!(table.column("middle").is_err_and(|e| e.contains("left, right")));
        assert!(table.column("3").is_err() && table.column("0").is_err());
        assert_eq!(table.column("2").unwrap().1, [2.0, 4.0]);
    }

    #[test]
    fn wav_gives_channels_and_rate() {
        let spec = hound::WavSpec {
            channels: 2,
            sample_rate: 48_000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut writer = hound::WavWriter::new(&mut bytes, spec).unwrap();
        for sample in [1i16, 7, -2, 8] {
            writer.write_sample(sample).unwrap();
        }
        writer.finalize().unwrap();
        let table = wav(bytes.get_ref()).unwrap();
        assert_eq!((table.signal(None).unwrap(), table.rate), (vec![1.0, -2.0], Some(48_000.0)));
        assert_eq!(table.column("2").unwrap().1, [7.0, 8.0]);
    }
}
