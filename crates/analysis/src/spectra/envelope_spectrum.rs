//! The envelope's spectrum, with the bearing's characteristic frequencies beside it.
//!
//! Each passage over a defect rings resonances anew; the envelope of a band that holds one repeats with the passages,
//! and its spectrum has lines where the kind of defect says. The squared envelope is taken (its spectrum holds no lines
//! that were not there, unlike that of its root), without its mean:
//! ```text
//! A(f) = 2/Σw |Σ w (e² − mean) exp(−2πi f t)| / mean,   w Hann's window
//! ```
//! A line of amplitude 1 is a full modulation. The band is the octave in which the strongest comb stands out, of the
//! three that a defect can make. Signals too short for eight passages, in which a line is half as wide as
//! BPFO, or too coarse, have none.

use super::combs;
use super::combs::Combs;
use super::order_spectrum::EvenAngles;
use crate::spectrum::{Band, Spectrum};
use crate::{spectrum, statistics};
use brinell::geometry::kinematics::Frequencies;

/// Fewest passages over the outer raceway that make a spectrum: a line is then half as wide as BPFO.
pub const FEWEST_PASSAGES: f64 = 8.0;
/// Range (in BPFI) that is kept: three harmonics with their sidebands.
const RANGE: f64 = 3.6;
/// Times as fine as the resolution that points lie: lines are then drawn at their height.
const FINENESS: usize = 8;

/// Spectrum of a signal's squared envelope.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvelopeSpectrum {
    /// The band whose envelope was taken (Hz).
    pub band: Band,
    /// Width of a line (Hz): that of the window's main lobe, 4 over the duration.
    pub line_width: f64,
    /// Frequencies (Hz).
    pub frequency: Vec<f64>,
    /// Amplitudes, as shares of the envelope's mean.
    pub amplitude: Vec<f64>,
}

impl EnvelopeSpectrum {
    /// Of a signal sampled at `rate` (Hz) on a bearing whose shaft turns at `speed` (Hz).
    pub fn of(signal: &[f64], rate: f64, characteristic: Frequencies, speed: f64) -> Option<Self> {
        Self::at(signal, rate, characteristic, speed, &|squared| (squared, rate))
    }

    /// The same of a shaft whose speed changes: the envelope is taken in time, where a resonance stays in its band, and
    /// then at equal shaft angles. Frequencies are those of a shaft that turns at the mean speed, as `characteristic`
    /// must be.
    pub fn of_changing_speed(
        signal: &[f64],
        rate: f64,
        characteristic: Frequencies,
        angles: &EvenAngles,
    ) -> Option<Self> {
        let (speed, even_rate) = (angles.mean_speed(), angles.per_turn() * angles.mean_speed());
        Self::at(signal, rate, characteristic, speed, &|squared| (angles.resampled(&squared), even_rate))
    }

    /// `even` gives a squared envelope at equal times or angles, and its rate (Hz).
    fn at(
        signal: &[f64],
        rate: f64,
        characteristic: Frequencies,
        speed: f64,
        even: &dyn Fn(Vec<f64>) -> (Vec<f64>, f64),
    ) -> Option<Self> {
        let top = RANGE * characteristic.bpfi;
        let bands = combs::bands(rate, characteristic.bpfo);
        if signal.len() as f64 / rate * characteristic.bpfo < FEWEST_PASSAGES || bands.is_empty() {
            return None;
        }
        let mut spectrum = Spectrum::of(signal, rate);
        let mut envelope = |band| even(spectrum.squared_envelope(band));
        let band = Combs::find_of(&mut envelope, rate, characteristic, speed).strongest().band;
        let (squared, rate) = envelope(band);
        let duration = squared.len() as f64 / rate;
        let mean = statistics::mean(&squared);
        if mean <= 0.0 {
            return None;
        }
        let relative: Vec<f64> = squared.iter().map(|x| x / mean - 1.0).collect();
        let (power, bin) = spectrum::power(&relative, rate, FINENESS * relative.len());
        // Hann's window sums to half of its length.
        let scale = 4.0 / squared.len() as f64;
        let count = ((top / bin) as usize + 1).min(power.len());
        Some(Self {
            band,
            line_width: 4.0 / duration,
            frequency: (0..count).map(|k| k as f64 * bin).collect(),
            amplitude: power[..count].iter().map(|p| scale * p.sqrt()).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_modulated_resonance_has_its_line_where_and_as_high_as_it_was_modulated() {
        let characteristic = Frequencies { bpfo: 35.8, bpfi: 54.2, bsf: 23.6, ftf: 3.98 };
        let (rate, modulated) = (51_200.0, 54.2);
        let sample = |i: usize| {
            let t = i as f64 / rate;
            (1.0 + 0.25 * libm::cos(TAU * modulated * t)) * libm::sin(TAU * 9000.0 * t)
        };
        let signal: Vec<f64> = (0..51_200).map(sample).collect();
        let found = EnvelopeSpectrum::of(&signal, rate, characteristic, 10.0).unwrap();
        assert!(found.band.low < 9000.0 && found.band.high > 9000.0, "{:?}", found.band);
        let peak =
            (0..found.amplitude.len()).max_by(|&a, &b| found.amplitude[a].total_cmp(&found.amplitude[b])).unwrap();
        assert!((found.frequency[peak] - modulated).abs() < 0.1, "{}", found.frequency[peak]);
        // (1 + m cos)² = 1 + m²/2 + 2m cos + …: 0.5 of a mean of 1.03125. The window's points are 0.04 lobes apart.
        assert!((found.amplitude[peak] - 0.5 / 1.03125).abs() < 0.005, "{}", found.amplitude[peak]);
        assert!(*found.frequency.last().unwrap() < 3.7 * 54.2);
        assert_eq!(EnvelopeSpectrum::of(&signal[..11_000], rate, characteristic, 10.0), None);
    }
}
