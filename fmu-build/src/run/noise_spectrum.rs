//! Noise by a spectrum that was measured: a table of densities, from which as much is drawn as they say.
//!
//! White noise is transformed, each of its frequencies multiplied, and transformed back: independent numbers of mean
//! square 1 have the one-sided density 2/rate. It is drawn for twice as long as it is used, so that its end, which
//! goes on with its beginning, is never near it. A sample depends on the table, the seed, the signal, the sample's
//! number and how many there are.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};
use brinell::numerics::counter_noise::gaussian;
use brinell_analysis::spectrum::Spectrum;

use super::signals::Signals;
use crate::shared::csv;

/// An amplitude's density, or a power's: its square.
const HEADINGS: [[&str; 2]; 2] =
    [["frequency_hz", "amplitude_m_s2_per_sqrt_hz"], ["frequency_hz", "power_m2_s4_per_hz"]];
/// Largest amplitude's density (m/s²/√Hz): one of an accelerometer is a millionth of it.
const LARGEST: f64 = 1e3;
/// Streams of random numbers that other noise has not.
const STREAM: u64 = (u32::MAX as u64) << 32;

/// A one-sided density of power over the frequency.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NoiseSpectrum {
    /// Frequencies (Hz), which ascend, and densities ((m/s²)²/Hz).
    rows: Vec<[f64; 2]>,
}

impl NoiseSpectrum {
    /// Reads a file for signals of so many samples per second (Hz).
    ///
    /// # Errors
    /// What is no such table, with the line, the value and what it must be.
    pub(crate) fn read(path: &Path, rate: f64) -> Result<Self> {
        let about = || path.display().to_string();
        let text = fs::read_to_string(path).with_context(about)?;
        Self::parse(&text, rate).with_context(about)
    }

    fn parse(text: &str, rate: f64) -> Result<Self> {
        let (which, pairs) = csv::pairs(text, "a spectrum of noise", &HEADINGS)?;
        let (of_power, name) = (which == 1, HEADINGS[which][1]);
        let largest = if of_power { LARGEST * LARGEST } else { LARGEST };
        let mut rows: Vec<[f64; 2]> = Vec::with_capacity(pairs.len());
        for (line, [frequency, density]) in pairs {
            if frequency < 0.0 {
                bail!("line {line}: frequency_hz is {frequency}: it must be at least 0");
            }
            if !(0.0..=largest).contains(&density) {
                bail!("line {line}: {name} is {density}: it must be from 0 to {largest}");
            }
            rows.push([frequency, if of_power { density } else { density * density }]);
        }
        let [lowest, _] = rows[0];
        if lowest >= 0.5 * rate {
            bail!("frequency_hz begins with {lowest}: it must be below {}, half of rate_hz", 0.5 * rate);
        }
        if rows.iter().all(|[_, density]| *density == 0.0) {
            bail!("{name} is 0 in all rows: it must be above 0 in one at least");
        }
        Ok(Self { rows })
    }

    /// Density ((m/s²)²/Hz) at a frequency (Hz): straight between rows in logarithms of both, plainly straight from and
    /// to zeros, and none beyond the rows.
    fn density(&self, frequency: f64) -> f64 {
        let after = self.rows.partition_point(|[of_row, _]| *of_row < frequency);
        let Some(&[above, high]) = self.rows.get(after) else { return 0.0 };
        if frequency == above {
            return high;
        }
        let Some(&[below, low]) = after.checked_sub(1).and_then(|before| self.rows.get(before)) else { return 0.0 };
        if below > 0.0 && low > 0.0 && high > 0.0 {
            let share = libm::log(frequency / below) / libm::log(above / below);
            return low * libm::pow(high / low, share);
        }
        low + (high - low) * (frequency - below) / (above - below)
    }

    /// Adds its noise to the signals at these indices, sampled at `rate` (Hz).
    pub(crate) fn add(&self, signals: &Signals, indices: &[usize], rate: f64, seed: u64) -> Result<()> {
        let drawn: Vec<Vec<f64>> =
            (0..indices.len() as u64).map(|k| self.draw(signals.rows(), rate, seed, k)).collect();
        signals.change(|row, values| {
            for (&index, drawn) in indices.iter().zip(&drawn) {
                values[index] += drawn[row as usize];
            }
        })
    }

    /// So many samples, of which as many again are left out.
    fn draw(&self, count: u64, rate: f64, seed: u64, signal: u64) -> Vec<f64> {
        let count = (2 * count).next_power_of_two();
        let white: Vec<f64> = (0..count).map(|row| gaussian(seed, STREAM + signal, row as i64)).collect();
        Spectrum::of(&white, rate).shaped(&|frequency| (0.5 * rate * self.density(frequency)).sqrt())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// As on a data sheet, with a line of the mains'.
    const TABLE: &str = "frequency_hz,amplitude_m_s2_per_sqrt_hz\n10,1e-2\n48,1e-3\n\n50,0.1\n52,1e-3\n# flat\n\
                         1000,1e-3\n5000,4e-3\n";
    const RATE: f64 = 20_000.0;

    #[test]
    fn what_is_drawn_has_the_density_of_the_table_and_none_beyond_it() {
        let spectrum = NoiseSpectrum::parse(TABLE, RATE).unwrap();
        let drawn = &spectrum.draw(1 << 19, RATE, 7, 0)[..1 << 19];
        // Mean squares of what a band has, against the integral of the table's density over it.
        let mut of = Spectrum::of(drawn, RATE);
        for (low, high) in [(10.0, 30.0), (49.0, 51.0), (100.0, 200.0), (900.0, 1100.0), (2000.0, 4900.0)] {
            let within = of.shaped(&|frequency| f64::from(u8::from((low..high).contains(&frequency))));
            let power = within.iter().map(|x| x * x).sum::<f64>() / within.len() as f64;
            let steps = 10_000;
            let width = (high - low) / f64::from(steps);
            let middles = (0..steps).map(|k| low + width * (f64::from(k) + 0.5));
            let expected = middles.map(|frequency| spectrum.density(frequency) * width).sum::<f64>();
            // (high − low) T independent squares of two numbers each; four standard errors, and the edges' leakage.
            let squares = (high - low) * drawn.len() as f64 / RATE;
            assert!((power / expected - 1.0).abs() < 4.0 / squares.sqrt() + 0.02, "{low}: {power} {expected}");
        }
        let beyond = of.shaped(&|frequency| f64::from(u8::from(!(9.0..5010.0).contains(&frequency))));
        let all = drawn.iter().map(|x| x * x).sum::<f64>();
        // What is cut out of a longer signal leaks a little.
        assert!(beyond.iter().map(|x| x * x).sum::<f64>() < 1e-3 * all);
    }

    #[test]
    fn densities_lie_on_lines_of_logarithms_and_squares_of_amplitudes_are_powers() {
        let spectrum = NoiseSpectrum::parse(TABLE, RATE).unwrap();
        // From 1 to 4 mm/s²/√Hz over a factor of 5: twice at √5 kHz.
        for (frequency, amplitude) in [(10.0, 1e-2), (50.0, 0.1), (500.0, 1e-3), (1e3 * 5f64.sqrt(), 2e-3), (5e3, 4e-3)]
        {
            assert!((spectrum.density(frequency).sqrt() / amplitude - 1.0).abs() < 1e-12, "{frequency}");
        }
        assert_eq!([0.0, 9.99, 5001.0].map(|frequency| spectrum.density(frequency)), [0.0; 3]);
        let power = NoiseSpectrum::parse("frequency_hz,power_m2_s4_per_hz\n0,0\n10,1e-4\n20,0\n", RATE).unwrap();
        for (frequency, density) in [(0.0, 0.0), (5.0, 5e-5), (10.0, 1e-4), (15.0, 5e-5)] {
            assert!((power.density(frequency) - density).abs() < 1e-18, "{frequency}");
        }
    }

    #[test]
    fn seeds_and_signals_have_noise_of_their_own_and_equal_ones_equal_bits() {
        let spectrum = NoiseSpectrum::parse(TABLE, RATE).unwrap();
        let drawn = spectrum.draw(1000, RATE, 1, 0);
        assert_eq!(drawn, spectrum.draw(1000, RATE, 1, 0));
        for other in [spectrum.draw(1000, RATE, 2, 0), spectrum.draw(1000, RATE, 1, 1)] {
            assert!(drawn.iter().zip(&other).all(|(a, b)| a != b));
        }
    }
}
