//! Lines that the shaft itself makes in a signal.
//!
//! Unbalance and misalignment make lines at the harmonics of the shaft's speed, in the signal and not in an envelope.
//! Each counts by ln(1 + height above the noise near it). In the mean of five they decide between two speeds. Among
//! many speeds some catch one or two tall lines of another one: there the weakest three of the five count.

use super::lines::steps;
use crate::{spectrum, statistics};

/// Harmonics of the shaft that are sought.
pub(super) const SHAFT: usize = 5;
/// Of these the weakest that must be there.
const WEAKEST: usize = 3;
/// Height from which lines are a shaft's own (nepers of power): those of recorded machines have 3.4 and more, what
/// simulations without noise have between their lines 2.3.
pub(super) const THERE: f64 = 3.0;
/// By how much lines at one speed must be higher than those at another one to decide (nepers of power).
pub(super) const CONFIRMS: f64 = 1.0;
/// Decibels of a neper of power.
pub(super) const DECIBELS: f64 = 4.343;
/// Power that counts as nothing, as a share of the signal's mean: 60 dB down. Recordings have 1e-6 and more of noise
/// near these lines. What simulations without noise hold there are aliases: harmonics of the passages beyond half the
/// sampling rate, which fold to any low frequency.
const FAINT: f64 = 1e-6;
/// Difference of the shaft's speed from the stated one at which its lines are sought, as a share.
const NEAR: f64 = 0.015;

/// Spectrum of a signal in which the shaft's own lines are sought.
pub(crate) struct ShaftLines {
    power: Vec<f64>,
    /// Least power that counts as noise.
    faint: f64,
    /// Hz.
    bin: f64,
    /// Distance of two speeds whose highest harmonics are in one line (Hz).
    step: f64,
}

impl ShaftLines {
    pub(crate) fn of(signal: &[f64], rate: f64) -> Self {
        let (power, bin) = spectrum::power(signal, rate, signal.len());
        let faint = FAINT * statistics::mean(&power);
        Self { power, faint, bin, step: rate / (signal.len() * SHAFT) as f64 }
    }

    /// Mean height of the lines of a speed (Hz), the most near it.
    pub(super) fn height(&self, speed: f64) -> f64 {
        self.highest(speed).1
    }

    /// The speed (Hz) near another one whose lines stand out, if any do.
    pub(crate) fn speed_near(&self, speed: f64) -> Option<f64> {
        let (speed, height) = self.highest(speed);
        (height >= THERE).then_some(speed)
    }

    /// The speed (Hz) near another one whose lines are highest, and how high.
    fn highest(&self, speed: f64) -> (f64, f64) {
        let of = |speed: f64| (speed, statistics::mean(&self.lines(speed)));
        let tried = steps(speed * (1.0 - NEAR), speed * (1.0 + NEAR), self.step).map(of);
        tried.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((speed, 0.0))
    }

    /// Speeds from one to another (Hz), and the mean height of the weakest of their lines.
    pub(super) fn weakest(&self, low: f64, high: f64) -> Vec<(f64, f64)> {
        let of = |speed: f64| {
            let mut lines = self.lines(speed);
            lines.sort_by(f64::total_cmp);
            (speed, statistics::mean(&lines[..WEAKEST]))
        };
        steps(low, high, self.step).map(of).collect()
    }

    /// Heights of the first harmonics of a speed (Hz).
    fn lines(&self, speed: f64) -> [f64; SHAFT] {
        std::array::from_fn(|k| self.line((k + 1) as f64 * speed, speed))
    }

    fn line(&self, f: f64, speed: f64) -> f64 {
        let at = |f: f64| ((f / self.bin).max(0.0) as usize).min(self.power.len());
        // The main lobe of a line that lies between bins, too.
        let line = self.power[at(f - self.bin)..at(f + 2.0 * self.bin)].iter().copied().fold(0.0, f64::max);
        let noise = statistics::median(&self.power[at(f - 0.4 * speed)..at(f + 0.4 * speed)]).max(self.faint);
        if noise > 0.0 { libm::log1p(line / noise) } else { 0.0 }
    }
}
