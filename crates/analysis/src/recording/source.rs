//! From a file to a recording: which columns, at which rate, at which speed.

use super::checked::{Recording, check_positive};
use super::error::SizingError;
use super::file::Table;
use super::formats::TextFormat;
use super::stated;
use std::path::Path;

/// Largest relative difference between a rate that is given and the file's own.
const SAME_RATE: f64 = 0.01;

/// Where the shaft's speed comes from. Columns are chosen by name, or by number from 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Speed {
    /// Constant (Hz).
    Constant(f64),
    /// A tachometer column and its pulses per shaft turn.
    Tachometer(String, u32),
    /// A column of the speed at every sample, in Hz unless its heading says rpm, rev/min, 1/min or rad/s.
    Column(String),
    /// Not said: the file's own is offered in the error.
    Unknown,
}

/// Which part of a file is the recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// Sampling rate (Hz); may be left out where the file states it.
    pub rate: Option<f64>,
    /// Shaft speed.
    pub speed: Speed,
    /// Column of the signal, by name or number; without it, the only one that can be one.
    pub signal: Option<String>,
    /// How a text's numbers are written.
    pub text: TextFormat,
}

impl Recording {
    /// Reads a `.csv`, `.tsv`, `.txt`, `.lvm`, `.npy`, `.npz`, `.mat` or `.wav` file, or one of another name that says
    /// by its first bytes what it is, or is a text.
    ///
    /// # Errors
    /// A file that cannot be read or understood, a rate that contradicts the file's own, and those of
    /// [`new`](Self::new), [`with_tachometer`](Self::with_tachometer) and [`with_speeds`](Self::with_speeds).
    pub fn read(path: &Path, source: &Source) -> Result<Self, SizingError> {
        let bytes = std::fs::read(path).map_err(|cause| SizingError::File { path: path.to_owned(), cause })?;
        Self::of_file(path, &bytes, source)
    }

    /// The same from what the file holds; its path says by its ending what that is.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn of_file(path: &Path, bytes: &[u8], source: &Source) -> Result<Self, SizingError> {
        let table = Table::read(path, bytes, source.text)?;
        let name = path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned());
        let refuse = |why: String| SizingError::Format { path: path.to_owned(), why };
        let mut remarks = Vec::new();
        if let Some((column, why)) = &table.no_clock {
            // Whoever names the signal and its rate needs no clock.
            if source.rate.is_none() || source.signal.is_none() {
                let (path, column, why) = (path.to_owned(), column.clone(), Box::new(why.clone()));
                return Err(SizingError::Times { path, column, why });
            }
            remarks.push(format!("{name}: {column} does not say when each sample was and is left out"));
        }
        let beside = match &source.speed {
            Speed::Constant(_) | Speed::Unknown => None,
            Speed::Tachometer(column, _) | Speed::Column(column) => Some(&**column),
        };
        let signal = table.signal(source.signal.as_deref(), beside.as_slice());
        let channel = signal.as_ref().map_or("", |&signal| table.name(signal));
        let rate = rate(&name, &table, source, channel, &mut remarks)?;
        let rate = rate.ok_or_else(|| refuse(table.without_rate(signal.as_ref().ok().copied())))?;
        let stated_speed = stated::speed(&table.numbers, channel);
        let signal = table.values(signal.map_err(refuse)?);
        let read = match &source.speed {
            Speed::Constant(speed) => Self::new(&name, signal.to_vec(), rate, *speed),
            Speed::Tachometer(column, pulses) => {
                let (_, tachometer) = table.column(column).map_err(refuse)?;
                Self::with_tachometer(&name, signal, tachometer, *pulses, rate)
            }
            Speed::Column(column) => {
                let (heading, speeds) = table.column(column).map_err(refuse)?;
                let unit = speed_unit(heading);
                let hertz: Vec<f64> = speeds.iter().map(|speed| speed * unit).collect();
                Self::with_speeds(&name, signal, &hertz, rate)
            }
            Speed::Unknown => Err(SizingError::SpeedNotSaid { name, offer: stated_speed.clone() }),
        };
        read.map(|recording| recording.with_file(stated_speed, remarks))
    }
}

/// The rate that is given, or else the file's own.
fn rate(
    name: &str,
    table: &Table,
    source: &Source,
    channel: &str,
    remarks: &mut Vec<String>,
) -> Result<Option<f64>, SizingError> {
    // Before it is compared: 0 is no other rate, but none.
    source.rate.map_or(Ok(()), |rate| check_positive(name, "sampling rate", rate))?;
    let number = stated::rate(&table.numbers, channel);
    let by_number = number.as_ref().map(|stated| stated.hertz);
    let contradicts = |given: f64, stated: f64| !((given / stated - 1.0).abs() <= SAME_RATE);
    let other_rate = |given: f64, stated: f64, by: String| SizingError::OtherRate {
        name: name.to_owned(),
        given,
        stated,
        by,
        limit: 100.0 * SAME_RATE,
    };
    let by = || number.as_ref().map_or(String::new(), |stated| format!(" by {} = {}", stated.name, stated.value));
    match (source.rate, table.rate, by_number) {
        (Some(given), Some(stated), _) if contradicts(given, stated) => Err(other_rate(given, stated, String::new())),
        (Some(given), None, Some(stated)) if contradicts(given, stated) => Err(other_rate(given, stated, by())),
        (None, None, Some(stated)) => {
            remarks.push(format!("{name}: {stated} Hz{}", by()));
            Ok(Some(stated))
        }
        (given, by_times, _) => Ok(given.or(by_times)),
    }
}

/// Hz per unit of a column's heading.
fn speed_unit(heading: &str) -> f64 {
    let heading = heading.to_lowercase();
    if ["rpm", "rev/min", "1/min"].iter().any(|unit| heading.contains(unit)) {
        1.0 / 60.0
    } else if heading.contains("rad/s") {
        1.0 / std::f64::consts::TAU
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::speed_unit;
    use std::f64::consts::TAU;

    #[test]
    fn speeds_are_hertz_unless_their_heading_says_otherwise() {
        assert_eq!([speed_unit("shaft.speed [rad/s]") * TAU, speed_unit("n [rpm]") * 60.0, speed_unit("n")], [1.0; 3]);
    }
}
