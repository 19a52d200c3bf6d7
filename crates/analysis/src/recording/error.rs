//! What a recording can be refused for. Each message names the quantity, its value and the limit.

use crate::recording::{Stated, Uneven};
use std::path::PathBuf;

/// A recording that cannot be read or cannot be sized, whatever the bearing's state.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum SizingError {
    /// The file could not be read. The message includes the cause, which is therefore no `source`: whoever prints the
    /// chain would tell it twice.
    #[error("{path}: {cause}")]
    File { path: PathBuf, cause: std::io::Error },
    /// The file is not what its ending says, or of a kind that is not read.
    #[error("{path}: {why}")]
    Format { path: PathBuf, why: String },
    /// The column that counts time or samples is uneven.
    #[error("{path}: {column}: {why}")]
    Times { path: PathBuf, column: String, why: Box<Uneven> },
    /// No recordings were given.
    #[error("0 recordings: at least 1 is needed")]
    NoRecordings,
    /// A recording was given twice.
    #[error("{name} and {other} have equal samples: a recording counts once")]
    Twice { name: String, other: String },
    /// A quantity that must be positive and finite is not.
    #[error("{name}: {quantity} {value} {unit}: it must be finite and above 0")]
    NotPositive { name: String, quantity: &'static str, value: f64, unit: &'static str },
    /// A sample is not a number.
    #[error("{name}: sample {index} is {value}: samples must be finite")]
    NotFinite {
        name: String,
        /// Index of the sample, from 0.
        index: usize,
        value: f64,
    },
    /// All samples are equal.
    #[error("{name}: all {count} samples are {value}: a constant carries no vibration")]
    Constant { name: String, count: usize, value: f64 },
    /// Squares of the samples would overflow or vanish.
    #[error(
        "{name}: samples from {low:e} to {high:e}: they must differ by {lowest:e} at least and stay within \
         ±{highest:e}; choose another unit"
    )]
    Magnitude { name: String, low: f64, high: f64, lowest: f64, highest: f64 },
    /// The signal sits at its limits.
    #[error("{name}: {percent:.2} % of the samples sit in runs at the extreme value {value}: clipped; limit {limit} %")]
    Clipped { name: String, percent: f64, value: f64, limit: f64 },
    /// Too few elements pass the defect during the recording.
    #[error(
        "{name}: {duration:.3} s hold {passages:.1} passages at a ball pass frequency of {bpfo:.3} Hz: at least \
         {limit} are needed"
    )]
    TooShort { name: String, duration: f64, passages: f64, bpfo: f64, limit: usize },
    /// The ball pass frequency is too high for the sampling rate: rate or speed are wrong.
    #[error(
        "{name}: {samples:.1} samples per passage ({rate:.1} Hz at a ball pass frequency of {bpfo:.3} Hz): at least \
         {limit} are needed; is the rate or the speed of {speed} Hz wrong?"
    )]
    TooCoarse { name: String, samples: f64, rate: f64, bpfo: f64, speed: f64, limit: usize },
    /// The tachometer column gives no speed.
    #[error("{name}: {pulses} tachometer pulses: at least {limit} are needed")]
    Tachometer { name: String, pulses: usize, limit: usize },
    /// The column beside the signal is not as long.
    #[error("{name}: {other} samples of tachometer or speed beside {samples} of the signal: they must be equally many")]
    OtherLength { name: String, other: usize, samples: usize },
    /// The speed varies too much.
    #[error("{name}: shaft speed from {low:.3} to {high:.3} Hz: the fastest may be at most {limit} times the slowest")]
    SpeedRange { name: String, low: f64, high: f64, limit: f64 },
    /// The signal does not say how fast the shaft turns.
    #[error("{name}: {why}; give the speed, or other limits for it")]
    NoSpeed { name: String, why: String },
    /// The rate contradicts the file.
    #[error("{name}: sampling rate {given} Hz, but the file states {stated:.3} Hz{by}: they may differ by {limit} %")]
    OtherRate { name: String, given: f64, stated: f64, by: String, limit: f64 },
    /// Nobody has said how fast the shaft turns.
    #[error(
        "{name}: the shaft's speed is not said: give --speed 29.2 or 1752rpm, --speed 20..30 to have it sought (the \
         second less than 1.9 times the first), --tacho or --speed-column{}",
        offered(.offer)
    )]
    SpeedNotSaid { name: String, offer: Option<Stated> },
}

fn offered(stated: &Option<Stated>) -> String {
    let line = |s: &Stated| format!("; the file has {} = {}: --speed {}", s.name, s.value, s.as_speed());
    stated.as_ref().map_or_else(String::new, line)
}
