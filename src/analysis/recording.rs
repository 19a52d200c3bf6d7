//! A vibration recording at constant shaft speed, checked.
//!
//! A recording with a tachometer is brought to constant speed first: between two pulses (one per shaft turn, rising edge)
//! the shaft is taken to turn uniformly, and the signal is sampled anew at equal shaft angles. Its rate and speed are then
//! those of the mean speed. Invalid where the speed changes much within one turn: resonances keep their frequency in time, not
//! in angle, so that a run-up is smeared.

use super::error::SizingError;
use super::recording_file;
use std::path::Path;

/// Share of samples in runs at an extreme from which a signal counts as clipped [%].
const CLIPPED_PERCENT: f64 = 0.1;
/// Equal samples in a row at the extreme that count as a run: two can be chance in a coarse signal.
const CLIPPED_RUN: usize = 3;

/// Where the shaft's speed comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Speed {
    /// Constant [Hz].
    Constant(f64),
    /// The file's tachometer column, one pulse per shaft turn.
    Tachometer,
}

/// A recording of acceleration, in any unit, at constant shaft speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    name: String,
    samples: Vec<f64>,
    rate: f64,
    speed: f64,
}

impl Recording {
    /// Checks a signal sampled at `rate` [Hz] while the shaft turned at `speed` [Hz].
    ///
    /// # Errors
    /// Rate or speed not positive, samples missing, not finite, constant or clipped.
    pub fn new(name: &str, samples: Vec<f64>, rate: f64, speed: f64) -> Result<Self, SizingError> {
        let name = name.to_owned();
        for (quantity, value) in [("sampling rate", rate), ("shaft speed", speed)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SizingError::NotPositive { name, quantity, value, unit: "Hz" });
            }
        }
        if samples.is_empty() {
            return Err(SizingError::NotPositive { name, quantity: "number of samples", value: 0.0, unit: "" });
        }
        if let Some(index) = samples.iter().position(|x| !x.is_finite()) {
            return Err(SizingError::NotFinite { name, index, value: samples[index] });
        }
        let (low, high) = samples.iter().fold((f64::MAX, f64::MIN), |(l, h), &x| (l.min(x), h.max(x)));
        if low == high {
            return Err(SizingError::Constant { name, count: samples.len(), value: low });
        }
        for value in [low, high] {
            let percent = 100.0 * in_runs_at(&samples, value) as f64 / samples.len() as f64;
            if percent > CLIPPED_PERCENT {
                return Err(SizingError::Clipped { name, percent, value, limit: CLIPPED_PERCENT });
            }
        }
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        let samples = samples.into_iter().map(|x| x - mean).collect();
        Ok(Self { name, samples, rate, speed })
    }

    /// The same with a tachometer column sampled beside the signal.
    ///
    /// # Errors
    /// As [`new`](Self::new), and a tachometer that has not the signal's length or fewer than four pulses.
    pub fn with_tachometer(name: &str, samples: &[f64], tachometer: &[f64], rate: f64) -> Result<Self, SizingError> {
        if tachometer.len() != samples.len() {
            let (tachometer, samples) = (tachometer.len(), samples.len());
            return Err(SizingError::TachometerLength { name: name.to_owned(), tachometer, samples });
        }
        let pulses = rising_edges(tachometer);
        if pulses.len() < MIN_PULSES {
            let (pulses, limit) = (pulses.len(), MIN_PULSES);
            return Err(SizingError::Tachometer { name: name.to_owned(), pulses, limit });
        }
        let turns = (pulses.len() - 1) as f64;
        let samples_per_turn = (pulses[pulses.len() - 1] - pulses[0]) / turns;
        let count = (turns * samples_per_turn) as usize;
        let uniform = (0..count).map(|i| {
            let angle = i as f64 / samples_per_turn;
            let turn = (angle as usize).min(pulses.len() - 2);
            let at = pulses[turn] + (angle - turn as f64) * (pulses[turn + 1] - pulses[turn]);
            value_at(samples, at)
        });
        Self::new(name, uniform.collect(), rate, rate / samples_per_turn)
    }

    /// Reads a `.csv`, `.npy` or `.wav` file; `rate` [Hz] may be left out where the file states it.
    ///
    /// CSV: numbers separated by commas, with or without a header; with one, the signal is the column `sensor.acceleration`
    /// or the first whose name begins with `acceleration`, the tachometer the one that begins with `tach`, and a column that
    /// begins with `time` gives the rate. Without one, as in the other formats, the first column (channel) is the signal
    /// and the second the tachometer.
    ///
    /// # Errors
    /// A file that cannot be read or understood, and those of [`new`](Self::new) and [`with_tachometer`](Self::with_tachometer).
    pub fn read(path: &Path, rate: Option<f64>, speed: Speed) -> Result<Self, SizingError> {
        let columns = recording_file::read(path)?;
        let name = path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned());
        let missing = |why: &str| SizingError::Format { path: path.to_owned(), why: why.to_owned() };
        let rate = rate.or(columns.rate).ok_or_else(|| missing("the file states no sampling rate: give one"))?;
        match (speed, &columns.tachometer) {
            (Speed::Constant(speed), _) => Self::new(&name, columns.signal, rate, speed),
            (Speed::Tachometer, Some(tachometer)) => Self::with_tachometer(&name, &columns.signal, tachometer, rate),
            (Speed::Tachometer, None) => Err(missing("no tachometer column: give the shaft's speed")),
        }
    }

    /// Name for messages: the file's.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The signal without its mean, in the recording's unit.
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// Sampling rate [Hz].
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Shaft speed [Hz].
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Duration [s].
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / self.rate
    }
}

/// Fewest pulses that give a mean speed worth the name.
const MIN_PULSES: usize = 4;

/// Samples that belong to runs at `value`.
fn in_runs_at(samples: &[f64], value: f64) -> usize {
    samples.chunk_by(|a, b| a == b).filter(|run| run[0] == value && run.len() >= CLIPPED_RUN).map(<[f64]>::len).sum()
}

/// Rising edges through the middle of the range, in samples, interpolated; armed anew below a quarter of the range.
fn rising_edges(tachometer: &[f64]) -> Vec<f64> {
    let (low, high) = tachometer.iter().fold((f64::MAX, f64::MIN), |(l, h), &x| (l.min(x), h.max(x)));
    let (middle, arm) = (0.5 * (low + high), 0.75 * low + 0.25 * high);
    let mut armed = false;
    let mut edges = Vec::new();
    for (i, pair) in tachometer.windows(2).enumerate() {
        armed |= pair[0] < arm;
        if armed && pair[1] > middle {
            edges.push(i as f64 + ((middle - pair[0]) / (pair[1] - pair[0])).clamp(0.0, 1.0));
            armed = false;
        }
    }
    edges
}

/// The signal between samples, by the cubic through four neighbours (Catmull–Rom); 0 outside.
pub(super) fn value_at(samples: &[f64], at: f64) -> f64 {
    if !(at >= 0.0 && at <= (samples.len() - 1) as f64) {
        return 0.0;
    }
    let i = (at as usize).min(samples.len().saturating_sub(2));
    let t = at - i as f64;
    let x = |k: usize| samples[k.min(samples.len() - 1)];
    let (a, b, c, d) = (x(i.saturating_sub(1)), x(i), x(i + 1), x(i + 2));
    b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tachometer_makes_a_speed_that_wanders_constant() {
        // Shaft angle in turns: 10 Hz with 3 % of wander at 0.5 Hz. The signal is the 20th order of the shaft.
        let rate = 20_000.0;
        let turns = |t: f64| 10.0 * t + 0.1 * (std::f64::consts::TAU * 0.5 * t).sin();
        let at = |i: u32| turns(f64::from(i) / rate);
        let signal: Vec<f64> = (0..80_000).map(|i| (std::f64::consts::TAU * 20.0 * at(i)).sin()).collect();
        let pulses: Vec<f64> = (0..80_000).map(|i| f64::from(u8::from(at(i).fract() < 0.1))).collect();
        let recording = Recording::with_tachometer("made", &signal, &pulses, rate).unwrap();
        // Ends at the last pulse: the mean speed differs from 10 Hz by what of the wander is left over.
        assert!((recording.speed() - 10.0).abs() < 0.05, "{}", recording.speed());
        // Every turn has 20 periods now: the signal is the same one turn later but for the speed's change within a turn.
        let turn = recording.rate() / recording.speed();
        let x = recording.samples();
        for i in 0..x.len() - turn as usize - 2 {
            assert!((value_at(x, i as f64 + turn) - x[i]).abs() < 0.2, "sample {i}");
        }
    }

    #[test]
    fn a_dead_tachometer_is_refused() {
        let signal: Vec<f64> = (0..100).map(f64::from).collect();
        let dead = Recording::with_tachometer("made", &signal, &[0.0; 100], 1000.0);
        assert!(matches!(dead, Err(SizingError::Tachometer { pulses: 0, .. })));
        let short = Recording::with_tachometer("made", &signal, &[0.0; 99], 1000.0);
        assert!(matches!(short, Err(SizingError::TachometerLength { tachometer: 99, samples: 100, .. })));
    }

    #[test]
    fn the_cubic_passes_through_samples_and_follows_a_parabola() {
        let samples: Vec<f64> = (0..10).map(|i| f64::from(i * i)).collect();
        assert_eq!(value_at(&samples, 4.0), 16.0);
        // Exact for parabolas but for rounding.
        assert!((value_at(&samples, 4.5) - 20.25).abs() < 1e-12);
        assert_eq!(value_at(&samples, -0.1), 0.0);
        assert_eq!(value_at(&samples, 9.1), 0.0);
    }
}
