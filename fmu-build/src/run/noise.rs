//! Noise of a measuring chain: normal, white or pink, as strong as a ratio to each signal says, with a floor that a
//! silent machine has as well.
//!
//! A sample's noise depends on the seed, the signal and the sample's number alone, so equal runs get equal noise to the
//! bit. The ratio is 20 log₁₀ of the signal's root mean square over the whole run, without its mean, over the noise's;
//! squares of ratio and floor add up.
//!
//! Pink noise has equal power in all octaves. It is a sum of random numbers that last for 1, 2, 4 … samples ([Voss and
//! Clarke 1978](https://doi.org/10.1121/1.381721)), down to 2⁻¹⁶ of the rate, and white below that.

use std::fmt;

use anyhow::{Result, bail};
use brinell::numerics::counter_noise::{bits, gaussian};

use super::signals::Signals;

/// Ratios beyond these are no measurement (dB).
pub(crate) const RATIOS: std::ops::RangeInclusive<f64> = -60.0..=200.0;

/// Floors beyond these are none of an accelerometer (m/s²).
pub(crate) const FLOORS: std::ops::RangeInclusive<f64> = 1e-9..=1e6;
/// Octaves of pink noise.
const OCTAVES: u64 = 16;

/// How noise is spread over frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Color {
    /// The same power in each hertz.
    #[default]
    White,
    /// The same power in each octave.
    Pink,
}

impl Color {
    /// Sample `row` of the noise of a stream, of mean square 1.
    fn sample(self, seed: u64, stream: u64, row: i64) -> f64 {
        match self {
            Self::White => gaussian(seed, stream, row),
            Self::Pink => {
                let octaves = (0..OCTAVES).map(|k| gaussian(seed, bits(seed, stream, k as i64), row >> k));
                octaves.sum::<f64>() / (OCTAVES as f64).sqrt()
            }
        }
    }
}

/// How much noise, and which.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Ratio of each signal to its noise (dB).
    pub(crate) ratio: Option<f64>,
    /// Root mean square of what every signal has (m/s²).
    pub(crate) floor: Option<f64>,
    pub(crate) color: Color,
    pub(crate) seed: u64,
}

/// Limits between which the runs of a sweep draw their noise.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct NoiseLimits {
    /// Limits of the signal-to-noise ratio (dB).
    pub(crate) ratio: Option<[f64; 2]>,
    /// Limits of the floor's root mean square (m/s²).
    pub(crate) floor: Option<[f64; 2]>,
    pub(crate) color: Color,
}

impl fmt::Display for Noise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ratio = self.ratio.unwrap_or(f64::INFINITY);
        write!(f, "sensors have noise {ratio} dB below their signal, seed {}", self.seed)
    }
}

impl Noise {
    /// White noise at a ratio (dB).
    ///
    /// # Errors
    /// A ratio beyond the limits.
    pub fn new(ratio: f64, seed: u64) -> Result<Self> {
        if !RATIOS.contains(&ratio) {
            bail!("signal-to-noise ratio {ratio} dB: it must be from {} to {}", RATIOS.start(), RATIOS.end());
        }
        Ok(Self { ratio: Some(ratio), floor: None, color: Color::White, seed })
    }

    /// Adds it to the signals at these indices. `file` distinguishes files that are measured with different noise.
    ///
    /// # Errors
    /// A signal that does not move: no noise has a ratio to it.
    pub fn add(&self, signals: &Signals, indices: &[usize], file: u64) -> Result<()> {
        if self.ratio.is_none() && self.floor.is_none() {
            return Ok(());
        }
        let mut sums = vec![[0.0; 2]; indices.len()];
        // About the first value: accelerations have no large mean, but others may.
        let mut first = Vec::new();
        signals.each_row(|row| {
            if first.is_empty() {
                first = indices.iter().map(|&index| row[index]).collect();
            }
            for ((sum, &index), first) in sums.iter_mut().zip(indices).zip(&first) {
                let value = row[index] - first;
                *sum = [sum[0] + value, sum[1] + value * value];
            }
            Ok(())
        })?;
        let count = signals.rows() as f64;
        let mut levels = Vec::with_capacity(indices.len());
        for (&index, [sum, squares]) in indices.iter().zip(sums) {
            let rms = (squares / count - (sum / count) * (sum / count)).max(0.0).sqrt();
            if let Some(ratio) = self.ratio.filter(|_| !(rms > 0.0)) {
                bail!("{} does not move: noise of {ratio} dB to it is none", signals.names()[index]);
            }
            let by_ratio = self.ratio.map_or(0.0, |ratio| rms * libm::pow(10.0, -ratio / 20.0));
            levels.push(libm::hypot(by_ratio, self.floor.unwrap_or(0.0)));
        }
        signals.change(|row, values| {
            for (k, (&index, level)) in indices.iter().zip(&levels).enumerate() {
                values[index] += level * self.color.sample(self.seed, (file << 32) + k as u64, row as i64);
            }
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::super::signals::Growing;
    use super::*;

    fn signals(folder: &std::path::Path, name: &str) -> Signals {
        let names = ["time", "a", "b"].map(str::to_owned).to_vec();
        let mut growing = Growing::create(&folder.join(name), names, 50_000).unwrap();
        for i in 0..50_000 {
            let t = f64::from(i);
            growing.push(&[t, 7.0 + 3.0 * libm::sin(0.37 * t), 1.0]).unwrap();
        }
        growing.end().unwrap()
    }

    #[test]
    fn noise_is_as_strong_as_the_ratio_says_white_and_the_same_for_the_same_seed() {
        let folder = tempfile::tempdir().unwrap();
        let noisy = |name: &str, seed: u64, course: u64| {
            let signals = signals(folder.path(), name);
            let clean = signals.column(1).unwrap();
            Noise::new(14.0, seed).unwrap().add(&signals, &[1], course).unwrap();
            let noise: Vec<f64> = signals.column(1).unwrap().iter().zip(clean).map(|(a, b)| a - b).collect();
            noise
        };
        let noise = noisy("one", 1, 0);
        let of = |f: &dyn Fn(usize) -> f64| (0..noise.len() - 1).map(f).sum::<f64>() / (noise.len() - 1) as f64;
        let rms = of(&|i| noise[i] * noise[i]).sqrt();
        // 3/√2 less 14 dB; four standard errors of 50 000 draws are 1.3 %.
        let expected = 3.0 / std::f64::consts::SQRT_2 * libm::pow(10.0, -0.7);
        assert!((rms / expected - 1.0).abs() < 0.013, "{rms} {expected}");
        // Neighbours know nothing of each other: four standard errors.
        assert!((of(&|i| noise[i] * noise[i + 1]) / (rms * rms)).abs() < 0.018);
        assert_eq!(noise, noisy("two", 1, 0));
        for other in [noisy("three", 2, 0), noisy("four", 1, 1)] {
            assert!(noise.iter().zip(&other).all(|(a, b)| a != b));
        }
    }

    #[test]
    fn a_floor_is_there_under_a_silent_signal_and_adds_its_square_to_the_ratios() {
        let folder = tempfile::tempdir().unwrap();
        let rms = |name: &str, index: usize, ratio: Option<f64>| {
            let signals = signals(folder.path(), name);
            let clean = signals.column(index).unwrap();
            Noise { ratio, floor: Some(0.5), color: Color::White, seed: 3 }.add(&signals, &[index], 0).unwrap();
            let noisy = signals.column(index).unwrap();
            (noisy.iter().zip(&clean).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / clean.len() as f64).sqrt()
        };
        // Four standard errors of 50 000 draws.
        assert!((rms("still", 2, None) / 0.5 - 1.0).abs() < 0.013);
        // 3/√2 less 14 dB, and the floor.
        let both = (3.0 / std::f64::consts::SQRT_2 * libm::pow(10.0, -0.7)).hypot(0.5);
        assert!((rms("both", 1, Some(14.0)) / both - 1.0).abs() < 0.013);
    }

    #[test]
    fn pink_noise_has_the_same_power_in_all_octaves() {
        // Of noise with 1/f the variance of differences between neighbouring means does not depend on how many samples
        // each is of; white noise's falls with 1/m.
        let pink: Vec<f64> = (0..1 << 18).map(|i| Color::Pink.sample(1, 0, i)).collect();
        let allan = |m: usize| {
            let means: Vec<f64> = pink.chunks_exact(m).map(|part| part.iter().sum::<f64>() / m as f64).collect();
            let squares = means.windows(2).map(|w| 0.5 * (w[1] - w[0]) * (w[1] - w[0]));
            squares.sum::<f64>() / (means.len() - 1) as f64
        };
        let middle = allan(32);
        // Steps of two make a ripple of a few per cent; four standard errors of 2^18/512 differences are 18 %.
        for m in [4, 8, 16, 64, 128, 256] {
            assert!((allan(m) / middle - 1.0).abs() < 0.25, "{m}: {} {middle}", allan(m));
        }
        let square = pink.iter().map(|x| x * x).sum::<f64>() / pink.len() as f64;
        // The slowest of 16 octaves has 8 independent values only: two standard errors of all together.
        assert!((square - 1.0).abs() < 0.15, "{square}");
    }

    #[test]
    fn a_signal_that_stands_and_a_ratio_beyond_the_limits_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let still = Noise::new(20.0, 1).unwrap().add(&signals(folder.path(), "s"), &[2], 0);
        assert!(still.unwrap_err().to_string().contains("b does not move"));
        assert!([f64::NAN, f64::INFINITY, -61.0, 201.0].iter().all(|&ratio| Noise::new(ratio, 1).is_err()));
    }
}
