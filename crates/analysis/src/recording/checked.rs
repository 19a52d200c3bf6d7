//! A vibration recording at constant shaft speed, checked.
//!
//! A recording with a tachometer is brought to constant speed first: between two pulses (rising edges) the shaft is
//! taken to turn uniformly, and the signal is sampled anew at equal shaft angles; likewise with the speed given at
//! every sample. Its rate and speed are then those of the mean speed. Invalid where the speed changes much within one
//! turn: resonances keep their frequency in time, not in angle, so that a run-up is smeared.

use super::error::SizingError;
use super::stated::Stated;
use crate::statistics;

/// Smallest range and largest magnitude of a signal: sums of squares stay numbers.
const SMALLEST: f64 = 1e-100;
const LARGEST: f64 = 1e100;
/// Share of samples in runs at an extreme from which a signal counts as clipped (%).
const CLIPPED_PERCENT: f64 = 0.1;
/// Equal samples in a row at the extreme that count as a run: two can be chance in a coarse signal.
const CLIPPED_RUN: usize = 3;
/// Samples that are only nearly equal, because noise was added to what was clipped: within this share of the range
/// from the extreme, with second differences of at most that share of the usual ones, so many times in a row. On the
/// crest of a loud hum the signal goes on as lively as elsewhere.
const NEARLY: f64 = 0.01;
const STILL: f64 = 0.1;
const STILL_RUN: usize = 3;

/// A recording of acceleration, in any unit, at constant shaft speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    name: String,
    samples: Vec<f64>,
    rate: f64,
    speed: f64,
    stated_speed: Option<Stated>,
    remarks: Vec<String>,
}

impl Recording {
    /// Checks a signal sampled at `rate` (Hz) while the shaft turned at `speed` (Hz).
    ///
    /// # Errors
    /// Rate or speed not positive, samples missing, not finite, constant or clipped.
    pub fn new(name: &str, samples: Vec<f64>, rate: f64, speed: f64) -> Result<Self, SizingError> {
        check_positive(name, "sampling rate", rate)?;
        check_positive(name, "shaft speed", speed)?;
        let name = name.to_owned();
        check_samples(&name, &samples)?;
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        let samples = samples.into_iter().map(|x| x - mean).collect();
        Ok(Self { name, samples, rate, speed, stated_speed: None, remarks: Vec::new() })
    }

    /// The same with a tachometer sampled beside the signal, of so many pulses per shaft turn.
    ///
    /// # Errors
    /// As [`new`](Self::new), and a tachometer that has not the signal's length or fewer than four pulses.
    pub fn with_tachometer(
        name: &str,
        samples: &[f64],
        tachometer: &[f64],
        pulses_per_turn: u32,
        rate: f64,
    ) -> Result<Self, SizingError> {
        check_beside(name, samples, tachometer)?;
        let pulses = rising_edges(tachometer);
        if pulses.len() < MIN_PULSES {
            let (pulses, limit) = (pulses.len(), MIN_PULSES);
            return Err(SizingError::Tachometer { name: name.to_owned(), pulses, limit });
        }
        let pulses_per_turn = f64::from(pulses_per_turn.max(1));
        let turns: Vec<f64> = (0..pulses.len()).map(|k| k as f64 / pulses_per_turn).collect();
        Self::at_equal_angles(name, samples, &pulses, &turns, rate)
    }

    /// The same with the shaft's speed (Hz) at every sample.
    ///
    /// # Errors
    /// As [`new`](Self::new), and speeds that are not above 0 or vary too much.
    pub fn with_speeds(name: &str, samples: &[f64], speeds: &[f64], rate: f64) -> Result<Self, SizingError> {
        check_beside(name, samples, speeds)?;
        speeds.iter().try_for_each(|&speed| check_positive(name, "shaft speed", speed))?;
        let at: Vec<f64> = (0..samples.len()).map(|i| i as f64).collect();
        Self::at_equal_angles(name, samples, &at, &turned(speeds, rate), rate)
    }

    /// The signal at equal shaft angles, `turns` of which were reached at the samples `at`.
    fn at_equal_angles(name: &str, samples: &[f64], at: &[f64], turns: &[f64], rate: f64) -> Result<Self, SizingError> {
        check_samples(name, samples)?;
        let all = turns[turns.len() - 1];
        let speeds = (1..at.len()).map(|k| (turns[k] - turns[k - 1]) * rate / (at[k] - at[k - 1]));
        let [low, high] = statistics::extent(speeds);
        if high > WIDEST_SPEED_RANGE * low {
            let (name, limit) = (name.to_owned(), WIDEST_SPEED_RANGE);
            return Err(SizingError::SpeedRange { name, low, high, limit });
        }
        let samples_per_turn = (at[at.len() - 1] - at[0]) / all;
        let equal = equal_turns(turns, samples_per_turn).take((all * samples_per_turn) as usize);
        let uniform = equal.map(|(k, share)| value_at(samples, at[k] + share * (at[k + 1] - at[k])));
        Self::new(name, uniform.collect(), rate, rate / samples_per_turn)
    }

    /// The same with what its file says beside the signal.
    pub(super) fn with_file(self, stated_speed: Option<Stated>, remarks: Vec<String>) -> Self {
        Self { stated_speed, remarks, ..self }
    }

    /// The same of a shaft at another speed (Hz).
    ///
    /// # Errors
    /// A speed that is not positive.
    pub fn at_speed(self, speed: f64) -> Result<Self, SizingError> {
        check_positive(&self.name, "shaft speed", speed)?;
        Ok(Self { speed, ..self })
    }

    /// Name for messages: the file's.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The signal without its mean, in the recording's unit.
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// Sampling rate (Hz).
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Shaft speed (Hz).
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// The shaft's speed as its file states it, by a number that stands beside the signal.
    pub fn stated_speed(&self) -> Option<&Stated> {
        self.stated_speed.as_ref()
    }

    /// What a user must know of how its file was read.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Duration (s).
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / self.rate
    }
}

/// Fastest over slowest speed beyond which a recording is a run-up: resonances and events would smear.
const WIDEST_SPEED_RANGE: f64 = 1.5;
/// Fewest pulses that give a mean speed worth the name.
const MIN_PULSES: usize = 4;

fn check_beside(name: &str, samples: &[f64], other: &[f64]) -> Result<(), SizingError> {
    if other.len() == samples.len() {
        return Ok(());
    }
    Err(SizingError::OtherLength { name: name.to_owned(), other: other.len(), samples: samples.len() })
}

/// Refuses a frequency (Hz) that is not above 0.
pub(super) fn check_positive(name: &str, quantity: &'static str, value: f64) -> Result<(), SizingError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(SizingError::NotPositive { name: name.to_owned(), quantity, value, unit: "Hz" })
}

fn check_samples(name: &str, samples: &[f64]) -> Result<(), SizingError> {
    let name = name.to_owned();
    if samples.is_empty() {
        return Err(SizingError::NotPositive { name, quantity: "number of samples", value: 0.0, unit: "" });
    }
    if let Some(index) = samples.iter().position(|x| !x.is_finite()) {
        return Err(SizingError::NotFinite { name, index, value: samples[index] });
    }
    let [low, high] = statistics::extent(samples.iter().copied());
    if low == high {
        return Err(SizingError::Constant { name, count: samples.len(), value: low });
    }
    if high - low < SMALLEST || low < -LARGEST || high > LARGEST {
        return Err(SizingError::Magnitude { name, low, high, lowest: SMALLEST, highest: LARGEST });
    }
    let differences: Vec<f64> = samples.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs()).collect();
    let still = STILL * statistics::median(&differences);
    for value in [low, high] {
        let near = |w: &[f64]| w.iter().all(|x| (x - value).abs() <= NEARLY * (high - low));
        let kept: Vec<bool> =
            samples.windows(3).zip(&differences).map(|(w, &second)| second <= still && near(w)).collect();
        let runs = kept.chunk_by(|a, b| a == b).filter(|run| run[0] && run.len() >= STILL_RUN);
        let nearly: usize = runs.map(|run| run.len() + 2).sum();
        let percent = 100.0 * in_runs_at(samples, value).max(nearly) as f64 / samples.len() as f64;
        if percent > CLIPPED_PERCENT {
            return Err(SizingError::Clipped { name, percent, value, limit: CLIPPED_PERCENT });
        }
    }
    Ok(())
}

/// Samples that belong to runs at `value`.
fn in_runs_at(samples: &[f64], value: f64) -> usize {
    samples.chunk_by(|a, b| a == b).filter(|run| run[0] == value && run.len() >= CLIPPED_RUN).map(<[f64]>::len).sum()
}

/// Rising edges through the middle of the range, in samples, interpolated; armed anew below a quarter of the range.
fn rising_edges(tachometer: &[f64]) -> Vec<f64> {
    let [low, high] = statistics::extent(tachometer.iter().copied());
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

/// Turns of a shaft since the first of evenly spaced instants, `rate` a second, at which its speeds (Hz) are known.
pub(crate) fn turned(speeds: &[f64], rate: f64) -> Vec<f64> {
    let mut turns = vec![0.0; speeds.len()];
    for k in 1..speeds.len() {
        turns[k] = turns[k - 1] + 0.5 * (speeds[k] + speeds[k - 1]).abs() / rate;
    }
    turns
}

/// Where equal angles lie among ascending `turns`, `per_turn` to a turn: behind which of these, and by which share of
/// the way to the next.
pub(crate) fn equal_turns(turns: &[f64], per_turn: f64) -> impl Iterator<Item = (usize, f64)> {
    let mut k = 0;
    (0..).map(move |i| {
        let turn = f64::from(i) / per_turn;
        while k + 2 < turns.len() && turns[k + 1] <= turn {
            k += 1;
        }
        (k, (turn - turns[k]) / (turns[k + 1] - turns[k]))
    })
}

/// The signal between samples, by the cubic through four neighbours (Catmull–Rom); 0 outside.
pub(crate) fn value_at(samples: &[f64], at: f64) -> f64 {
    if !(at >= 0.0 && at <= (samples.len() - 1) as f64) {
        return 0.0;
    }
    let i = (at as usize).min(samples.len().saturating_sub(2));
    let t = at - i as f64;
    let [a, b, c, d] = match i.checked_sub(1).and_then(|first| samples[first..].first_chunk()) {
        Some(&four) => four,
        None => {
            let x = |k: usize| samples[k.min(samples.len() - 1)];
            [x(i.saturating_sub(1)), x(i), x(i + 1), x(i + 2)]
        }
    };
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
        let recording = Recording::with_tachometer("made", &signal, &pulses, 1, rate).unwrap();
        // Ends at the last pulse: the mean speed differs from 10 Hz by what of the wander is left over.
        assert!((recording.speed() - 10.0).abs() < 0.05, "{}", recording.speed());
        // Every turn has 20 periods now: the signal is the same one turn later except for the speed's change within a
        // turn.
        let turn = recording.rate() / recording.speed();
        let x = recording.samples();
        for i in 0..x.len() - turn as usize - 2 {
            assert!((value_at(x, i as f64 + turn) - x[i]).abs() < 0.2, "sample {i}");
        }
    }

    #[test]
    fn speeds_beside_the_signal_do_the_same_and_a_run_up_is_refused() {
        let rate = 20_000.0;
        let speed = |t: f64| 10.0 + 0.3 * (std::f64::consts::TAU * 0.5 * t).cos();
        let turns = |t: f64| 10.0 * t + 0.3 / std::f64::consts::PI * (std::f64::consts::TAU * 0.5 * t).sin();
        let time = |i: u32| f64::from(i) / rate;
        let signal: Vec<f64> = (0..80_000).map(|i| (std::f64::consts::TAU * 20.0 * turns(time(i))).sin()).collect();
        let speeds: Vec<f64> = (0..80_000).map(|i| speed(time(i))).collect();
        let recording = Recording::with_speeds("made", &signal, &speeds, rate).unwrap();
        let period = recording.rate() / recording.speed() / 20.0;
        let x = recording.samples();
        for i in 0..x.len() - period as usize - 2 {
            // One period of 1/20 turn later: the trapezoid and the cubic leave 1e-6 each at 100 samples per period.
            assert!((value_at(x, i as f64 + period) - x[i]).abs() < 1e-4, "sample {i}");
        }
        let run_up: Vec<f64> = (0..80_000).map(|i| 5.0 + time(i)).collect();
        let refused = Recording::with_speeds("made", &signal, &run_up, rate);
        assert!(matches!(refused, Err(SizingError::SpeedRange { .. })));
    }

    #[test]
    fn a_dead_tachometer_is_refused() {
        let signal: Vec<f64> = (0..100).map(f64::from).collect();
        let dead = Recording::with_tachometer("made", &signal, &[0.0; 100], 1, 1000.0);
        assert!(matches!(dead, Err(SizingError::Tachometer { pulses: 0, .. })));
        let short = Recording::with_tachometer("made", &signal, &[0.0; 99], 1, 1000.0);
        assert!(matches!(short, Err(SizingError::OtherLength { other: 99, samples: 100, .. })));
    }

    #[test]
    fn the_cubic_passes_through_samples_and_follows_a_parabola() {
        let samples: Vec<f64> = (0..10).map(|i| f64::from(i * i)).collect();
        assert_eq!(value_at(&samples, 4.0), 16.0);
        // Exact for parabolas, except for rounding.
        assert!((value_at(&samples, 4.5) - 20.25).abs() < 1e-12);
        assert_eq!(value_at(&samples, -0.1), 0.0);
        assert_eq!(value_at(&samples, 9.1), 0.0);
    }
}
