//! A recording's file as named columns, and which of them is what.
//!
//! Columns are chosen by name or by number from 1. Left to itself, the signal is the only column whose name begins with
//! `sensor.acceleration`, else with `sensor[`, `acc`, `vib` or `signal`, else the only one that does not count time or
//! samples. Where several are left, none is taken.
//!
//! Time is a column that is called so, or has a unit of time and rises, or an unnamed first column beside others that
//! rises like time. It must be even ([`sampling_times`]). A column of any other name that
//! ticks from sample to sample, as counters and angles do, must have no holes.

use super::error::SizingError;
use super::formats::{self, Contents, TextFormat};
use super::sampling_times::{self, Clock, Uneven};
use std::path::Path;

/// Names of time.
const TIME: [&str; 9] = ["t", "time", "times", "timestamp", "zeit", "temps", "tiempo", "tempo", "tijd"];
/// What LabVIEW calls it.
const LABVIEW_TIME: &str = "x_value";
/// Units of time in seconds. The one before last is a micro sign in a coding that is not known.
const TIME_UNITS: [(&str, f64); 16] = [
    ("s", 1.0),
    ("sec", 1.0),
    ("second", 1.0),
    ("seconds", 1.0),
    ("ms", 1e-3),
    ("msec", 1e-3),
    ("milliseconds", 1e-3),
    ("us", 1e-6),
    ("usec", 1e-6),
    ("microseconds", 1e-6),
    ("\u{b5}s", 1e-6),
    ("\u{3bc}s", 1e-6),
    ("ns", 1e-9),
    ("min", 60.0),
    ("\u{fffd}s", 1e-6),
    ("h", 3600.0),
];
/// How the names of signals begin; where one is in use, those behind it are not.
const SIGNALS: [&str; 5] = ["sensor.acceleration", "sensor[", "acc", "vib", "signal"];
/// Most columns that a message lists.
const LISTED: usize = 100;
/// Rates that a column of seconds may have (Hz).
const PLAUSIBLE: std::ops::RangeInclusive<f64> = 500.0..=1e7;

/// What a file holds.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Table {
    /// Headings; empty where the file has none.
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    /// Whether each column counts time or samples.
    clocks: Vec<bool>,
    /// Sampling rate (Hz), where times or the format's own place for it tell it.
    pub(super) rate: Option<f64>,
    /// Single numbers by their names.
    pub(super) numbers: Vec<(String, f64)>,
    /// The column of times that does not say when each sample was, and how.
    pub(super) no_clock: Option<(String, Uneven)>,
}

impl Table {
    /// Reads what a file of this path holds.
    ///
    /// # Errors
    /// Bytes that are not what the path's ending says, times that are not even.
    pub(crate) fn read(path: &Path, bytes: &[u8], text: TextFormat) -> Result<Self, SizingError> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let refuse = |why: String| SizingError::Format { path: path.to_owned(), why };
        let contents = formats::contents(&ending, bytes, text).map_err(refuse)?;
        if contents.columns.is_empty() {
            return Err(refuse("no signal: it holds no array of numbers".to_owned()));
        }
        Self::new(contents).map_err(|(column, why)| SizingError::Times {
            path: path.to_owned(),
            column,
            why: Box::new(why),
        })
    }

    /// # Errors
    /// Which column is uneven, and how.
    fn new(contents: Contents) -> Result<Self, (String, Uneven)> {
        let Contents { names, columns, numbers, rate: by_format } = contents;
        let called = |i: usize| names.get(i).cloned().unwrap_or_else(|| format!("column {}", i + 1));
        let time = time_column(&names, &columns);
        let mut clocks = vec![false; columns.len()];
        let (mut rate, mut no_clock) = (by_format, None);
        for (i, column) in columns.iter().enumerate() {
            if let Some((_, unit)) = time.filter(|&(time, _)| time == i) {
                clocks[i] = true;
                let clock = Clock::new(column, unit).map_err(|why| (called(i), why))?;
                match clock.check() {
                    Err(why @ Uneven::Coarse { .. }) => no_clock = Some((called(i), why)),
                    // Microseconds of a second begin anew.
                    Err(why @ Uneven::Backward { .. }) if clock.check_for_holes().is_ok() => {
                        no_clock = Some((called(i), why));
                    }
                    Err(why) => return Err((called(i), why)),
                    Ok(()) => {
                        let by_times = sampling_times::mean_rate(column);
                        rate = by_times.map(|rate| rate / seconds(unit).unwrap_or(1.0)).or(by_format);
                    }
                }
            } else if let Some(clock) = Clock::hidden_in(column) {
                clock.check_for_holes().map_err(|why| (called(i), why))?;
                clocks[i] = true;
            }
        }
        Ok(Self { names, columns, clocks, rate, numbers, no_clock })
    }

    /// The column of this name or number; without either, the only one that can be a signal, and is none of `others`.
    pub(super) fn signal(&self, choice: Option<&str>, others: &[&str]) -> Result<usize, String> {
        if let Some(choice) = choice {
            return self.chosen(choice);
        }
        let others: Vec<usize> = others.iter().filter_map(|other| self.position(other)).collect();
        let left = || (0..self.columns.len()).filter(|i| !others.contains(i));
        let begin = |with: &str| -> Vec<usize> {
            left().filter(|&i| self.names.get(i).is_some_and(|name| bare(name).starts_with(with))).collect()
        };
        let named = SIGNALS.into_iter().map(begin).find(|columns| !columns.is_empty());
        let no_clocks = || left().filter(|&i| !self.clocks[i] || self.columns.len() == 1).collect();
        match named.unwrap_or_else(no_clocks)[..] {
            [one] => Ok(one),
            _ => Err(format!("{}: which is the signal? Choose one by name or number with --channel", self.listed())),
        }
    }

    /// Heading and values of the column of this name or number.
    pub(super) fn column(&self, choice: &str) -> Result<(&str, &[f64]), String> {
        self.chosen(choice).map(|at| (self.name(at), self.values(at)))
    }

    /// Heading of a column; empty where there is none.
    pub(super) fn name(&self, at: usize) -> &str {
        self.names.get(at).map_or("", String::as_str)
    }

    pub(super) fn values(&self, at: usize) -> &[f64] {
        &self.columns[at]
    }

    /// That the rate is not known, and what may tell it.
    pub(super) fn without_rate(&self, signal: Option<usize>) -> String {
        let mut said = "the file states no sampling rate: give one (rate, Hz)".to_owned();
        let count = signal.map(|signal| self.columns[signal].len());
        let ticks = (0..self.columns.len()).filter(|&i| self.clocks[i] && Some(self.columns[i].len()) == count);
        let rates = ticks.filter_map(|i| Some((i, sampling_times::mean_rate(&self.columns[i])?)));
        if let Some((i, rate)) = rates.into_iter().find(|(_, rate)| PLAUSIBLE.contains(rate)) {
            said +=
                &format!("; {} has {rate:.6} numbers to one, which is the rate if it counts seconds", self.called(i));
        }
        if !self.numbers.is_empty() {
            let listed: Vec<String> =
                self.numbers.iter().take(LISTED).map(|(name, value)| format!("{name} = {value}")).collect();
            said += &format!("; beside its columns it has {}", listed.join(", "));
        }
        said
    }

    fn called(&self, at: usize) -> String {
        self.names.get(at).cloned().unwrap_or_else(|| format!("column {}", at + 1))
    }

    fn chosen(&self, choice: &str) -> Result<usize, String> {
        self.position(choice).ok_or_else(|| format!("no column '{choice}' among {}", self.listed()))
    }

    fn position(&self, choice: &str) -> Option<usize> {
        let wanted = choice.trim().to_lowercase();
        // Behind a name within the file its path stands in brackets.
        let path = |name: &str| {
            name.strip_suffix(')').and_then(|name| name.rsplit_once(" (")).map(|(_, path)| path.to_owned())
        };
        let same = |name: &String| {
            let name = name.to_lowercase();
            name == wanted
                || bare(&name) == wanted
                || path(&name).is_some_and(|path| path.contains('.') && path == wanted)
        };
        let number = || wanted.parse::<usize>().ok()?.checked_sub(1).filter(|&i| i < self.columns.len());
        self.names.iter().position(same).or_else(number)
    }

    fn listed(&self) -> String {
        match (&self.names[..], self.columns.len()) {
            ([], count) => {
                let first: Vec<String> = self.columns.iter().take(LISTED).map(|column| column[0].to_string()).collect();
                format!("{count} columns without names, the first row {}", first.join(" "))
            }
            (names, count) if count > LISTED => format!("{count} columns from {}", names[..LISTED].join(", ")),
            (names, _) => format!("columns {}", names.join(", ")),
        }
    }
}

/// Which column is time, and its unit.
fn time_column<'a>(names: &'a [String], columns: &[Vec<f64>]) -> Option<(usize, &'a str)> {
    let rises = |i: usize| sampling_times::rises(&columns[i]);
    if names.is_empty() {
        // One that counts samples does not tell the rate.
        return (columns.len() > 1 && rises(0) && !sampling_times::counts(&columns[0])).then_some((0, "s"));
    }
    let called: Vec<(usize, &str)> =
        names.iter().enumerate().filter_map(|(i, name)| Some((i, unit_of_time(name)?))).collect();
    // A clock that goes back is refused, and no signal. Accelerations of a well-known collection are called
    // X097_DE_time.
    let signal = |i: usize| names[i].to_lowercase().ends_with("_time");
    let clock = called.iter().find(|&&(i, _)| rises(i)).or(called.iter().find(|&&(i, _)| !signal(i)));
    let by_name = clock.copied();
    by_name.or_else(|| {
        // Some programs write units alone above the numbers.
        let mut units = names.iter().enumerate().map(|(i, name)| (i, unit(name).unwrap_or(name)));
        units.find(|&(i, unit)| seconds(unit).is_some() && rises(i))
    })
}

/// The unit of a column that is called time; none if it is not, or is not in a unit of time.
fn unit_of_time(name: &str) -> Option<&str> {
    let bare = bare(name);
    let words: Vec<&str> = bare.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let (first, last) = (words.first()?, words.last()?);
    let called = [first, last].into_iter().any(|word| TIME.contains(word)) || bare == LABVIEW_TIME;
    let unit = unit(name).or_else(|| TIME_UNITS.iter().find(|(unit, _)| unit == last).map(|(unit, _)| *unit));
    (called && unit.is_none_or(|unit| seconds(unit).is_some())).then(|| unit.unwrap_or("s"))
}

/// A heading without its unit, in small letters.
fn bare(name: &str) -> String {
    name.split(['[', '(']).next().unwrap_or_default().trim().to_lowercase()
}

/// What stands in brackets.
fn unit(name: &str) -> Option<&str> {
    let (_, rest) = name.split_once(['[', '('])?;
    Some(rest.split([']', ')']).next().unwrap_or_default().trim())
}

/// A unit of time in seconds.
fn seconds(unit: &str) -> Option<f64> {
    let unit = unit.to_lowercase();
    TIME_UNITS.iter().find(|(name, _)| *name == unit).map(|(_, seconds)| *seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signal(table: &Table, choice: Option<&str>, others: &[&str]) -> Result<Vec<f64>, String> {
        table.signal(choice, others).map(|at| table.values(at).to_vec())
    }

    fn csv(text: &str) -> Table {
        let ending = if text.contains(',') { "csv" } else { "txt" };
        Table::new(formats::contents(ending, text.as_bytes(), TextFormat::default()).unwrap()).unwrap()
    }

    #[test]
    fn the_signal_is_found_by_name_and_time_gives_the_rate() {
        let table =
            csv("time [s],cage.angle [rad],sensor.acceleration [m/s2],tacho\n0.0,9,1,0\n0.5,9,2,5\n1.0,9,3,0\n");
        assert_eq!((signal(&table, None, &[]).unwrap(), table.rate), (vec![1.0, 2.0, 3.0], Some(2.0)));
        assert_eq!(table.column("tacho").unwrap(), ("tacho", [0.0, 5.0, 0.0].as_slice()));
        assert_eq!(table.column("Cage.Angle").unwrap().1, [9.0; 3]);
        assert_eq!(signal(&table, Some("4"), &[]).unwrap(), [0.0, 5.0, 0.0]);
        assert_eq!(csv("Time (ms),x\n0,7\n1,8\n2,9\n").rate, Some(1e3));
    }

    #[test]
    fn a_first_column_without_name_that_rises_evenly_is_time() {
        let table = csv("0.0 5\n0.25 6\n0.5 3\n");
        assert_eq!((signal(&table, None, &[]).unwrap(), table.rate), (vec![5.0, 6.0, 3.0], Some(4.0)));
        // Alone it is a signal, and one that goes up and down is one too.
        assert_eq!(signal(&csv("0.0\n0.25\n0.5\n"), None, &[]).unwrap(), [0.0, 0.25, 0.5]);
        assert!(signal(&csv("1 5\n-1 6\n2 3\n"), None, &[]).is_err_and(|why| why.contains("the first row 1 5")));
    }

    #[test]
    fn a_choice_that_cannot_be_met_lists_the_columns() {
        let table = csv("left,right\n1,2\n3,4\n");
        assert!(signal(&table, None, &[]).is_err_and(|e| e.contains("left, right") && e.contains("--channel")));
        // Beside a tachometer one signal is left; of two accelerations none is taken.
        assert_eq!(signal(&table, None, &["right"]).unwrap(), [1.0, 3.0]);
        assert!(signal(&csv("acc x,acc y\n1,2\n3,4\n"), None, &[]).is_err());
        assert!(signal(&csv("sensor[1].acceleration,sensor[2].acceleration\n1,2\n3,4\n"), None, &[]).is_err());
        assert!(table.column("middle").is_err_and(|e| e.contains("left, right")));
        assert!(table.column("3").is_err() && table.column("0").is_err());
        assert_eq!(table.column("2").unwrap().1, [2.0, 4.0]);
    }
}
