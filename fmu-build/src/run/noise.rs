//! Noise of a measuring chain: white, normal, and as strong as a ratio to each signal says.
//!
//! A sample's noise depends on the seed, the signal and the sample's number alone, so equal runs get equal noise to the
//! bit. The ratio is 20 log₁₀ of the signal's root mean square over the whole run, without its mean, over the noise's.

use std::fmt;

use anyhow::{Result, bail};
use brinell::numerics::counter_noise::gaussian;

use super::signals::Signals;

/// Ratios beyond these are no measurement (dB).
pub(crate) const RATIOS: std::ops::RangeInclusive<f64> = -60.0..=200.0;

/// How much noise, and which.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    ratio: f64,
    seed: u64,
}

impl fmt::Display for Noise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sensors have noise {} dB below their signal, seed {}", self.ratio, self.seed)
    }
}

impl Noise {
    /// Noise at a ratio (dB).
    ///
    /// # Errors
    /// A ratio beyond the limits.
    pub fn new(ratio: f64, seed: u64) -> Result<Self> {
        if !RATIOS.contains(&ratio) {
            bail!("signal-to-noise ratio {ratio} dB: it must be from {} to {}", RATIOS.start(), RATIOS.end());
        }
        Ok(Self { ratio, seed })
    }

    /// Adds it to the signals at these indices. `course` tells apart files that are measured with different noise.
    ///
    /// # Errors
    /// A signal that does not move: no noise has a ratio to it.
    pub fn add(&self, signals: &Signals, indices: &[usize], course: u64) -> Result<()> {
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
            if !(rms > 0.0) {
                bail!("{} does not move: noise of {} dB to it is none", signals.names()[index], self.ratio);
            }
            levels.push(rms * libm::pow(10.0, -self.ratio / 20.0));
        }
        signals.change(|row, values| {
            for (k, (&index, level)) in indices.iter().zip(&levels).enumerate() {
                values[index] += level * gaussian(self.seed, (course << 32) + k as u64, row as i64);
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
    fn a_signal_that_stands_and_a_ratio_beyond_the_limits_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let still = Noise::new(20.0, 1).unwrap().add(&signals(folder.path(), "s"), &[2], 0);
        assert!(still.unwrap_err().to_string().contains("b does not move"));
        for ratio in [f64::NAN, f64::INFINITY, -61.0, 201.0] {
            let why = Noise::new(ratio, 1).unwrap_err().to_string();
            assert!(why.contains(&ratio.to_string()) && why.contains("from -60 to 200"), "{why}");
        }
    }
}
