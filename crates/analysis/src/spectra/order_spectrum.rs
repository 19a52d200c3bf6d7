//! The order spectrum: a signal at equal shaft angles, and the amplitudes of what repeats so many times per turn.
//!
//! In a run whose speed changes, a defect's line smears over all frequencies that it passes; counted per turn it stays
//! where it is. The angle is the speed's integral by trapezia. Between samples the signal is taken from the cubic
//! through four of them. As many samples are taken per turn as there are at the slowest speed, so that nothing is
//! folded; slower parts than an eighth of the fastest are left out, or their few turns would ask for very many.
//! ```text
//! A(o) = 2/Σw |Σ w x exp(−2πi o θ/2π)|,   w Hann's window over the turns
//! ```

use crate::recording::{equal_turns, turned, value_at};
use crate::{spectrum, statistics};

/// Slowest speed over the fastest that is used.
const SLOWEST: f64 = 0.125;
/// Fewest turns: a line is then two orders wide.
const FEWEST_TURNS: f64 = 2.0;
/// Times as fine as the resolution that points lie.
const FINENESS: usize = 4;
/// Samples per turn over the highest order that is shown, as analysers have it.
const PER_ORDER: f64 = 2.56;

/// Where equal shaft angles lie among the samples of a signal.
#[derive(Debug, Clone, PartialEq)]
pub struct EvenAngles {
    /// Indices among the samples, with fractions.
    at: Vec<f64>,
    per_turn: f64,
    mean_speed: f64,
}

impl EvenAngles {
    /// Of a signal at each of whose samples the shaft's speed (Hz) is known; `rate` in samples per second. `None` where
    /// the shaft stands or makes less than two turns in one sense.
    pub fn of(speeds: &[f64], rate: f64) -> Option<Self> {
        let fastest = speeds.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        let fast_enough = |speed: &f64| speed * fastest.signum() >= SLOWEST * fastest.abs();
        let (mut from, mut best) = (0, 0..0);
        for run in speeds.chunk_by(|a, b| fast_enough(a) == fast_enough(b)) {
            if fast_enough(&run[0]) && run.len() > best.len() {
                best = from..from + run.len();
            }
            from += run.len();
        }
        let used = &speeds[best.clone()];
        let turns = turned(used, rate);
        let all = *turns.last()?;
        if !(all >= FEWEST_TURNS) {
            return None;
        }
        let slowest = used.iter().fold(f64::MAX, |least, speed| least.min(speed.abs()));
        let per_turn = rate / slowest;
        let equal = equal_turns(&turns, per_turn).take((all * per_turn) as usize + 1);
        let at = equal.map(|(k, share)| (best.start + k) as f64 + share.min(1.0));
        Some(Self { at: at.collect(), per_turn, mean_speed: all * rate / (used.len() - 1) as f64 })
    }

    /// Samples per turn.
    pub fn per_turn(&self) -> f64 {
        self.per_turn
    }

    /// Mean speed of the part that is used (Hz).
    pub fn mean_speed(&self) -> f64 {
        self.mean_speed
    }

    /// First and last sample of the part that is used.
    pub fn used(&self) -> (f64, f64) {
        (self.at[0], self.at[self.at.len() - 1])
    }

    /// A signal at equal angles.
    pub fn resampled(&self, signal: &[f64]) -> Vec<f64> {
        self.at.iter().map(|&at| value_at(signal, at)).collect()
    }
}

/// Amplitudes over orders.
#[derive(Debug, Clone, PartialEq)]
pub struct OrderSpectrum {
    /// Orders: times per turn.
    pub order: Vec<f64>,
    /// Amplitudes in the signal's unit.
    pub amplitude: Vec<f64>,
    /// Width of a line in orders: that of the window's main lobe, 4 over the turns.
    pub line_width: f64,
}

impl OrderSpectrum {
    /// Of a signal up to the order `highest`, or to that which its samples show.
    /// ```
    /// use brinell_analysis::spectra::{EvenAngles, OrderSpectrum};
    ///
    /// // Run up from 10 to 20 Hz in 10 s; three waves of 2 m/s² per turn.
    /// let (rate, count) = (2000.0, 20_000);
    /// let speeds: Vec<f64> = (0..count).map(|k| 10.0 + 10.0 * k as f64 / count as f64).collect();
    /// let turns = speeds.iter().scan(0.0, |turns, speed| {
    ///     let now = *turns;
    ///     *turns += speed / rate;
    ///     Some(now)
    /// });
    /// let signal: Vec<f64> = turns.map(|turns| 2.0 * (std::f64::consts::TAU * 3.0 * turns).sin()).collect();
    /// let spectrum = OrderSpectrum::of(&signal, &EvenAngles::of(&speeds, rate).unwrap(), 10.0);
    /// let (k, largest) = spectrum.amplitude.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
    /// assert!((spectrum.order[k] - 3.0).abs() < spectrum.line_width && (largest / 2.0 - 1.0).abs() < 0.02);
    /// ```
    pub fn of(signal: &[f64], angles: &EvenAngles, highest: f64) -> Self {
        let mut even = angles.resampled(signal);
        let mean = statistics::mean(&even);
        even.iter_mut().for_each(|x| *x -= mean);
        let (power, bin) = spectrum::power(&even, angles.per_turn, FINENESS * even.len());
        let top = highest.min(angles.per_turn / PER_ORDER);
        let count = ((top / bin) as usize + 1).min(power.len());
        // Hann's window sums to half of its length.
        let scale = 4.0 / even.len() as f64;
        Self {
            order: (0..count).map(|k| k as f64 * bin).collect(),
            amplitude: power[..count].iter().map(|p| scale * p.sqrt()).collect(),
            line_width: 4.0 * angles.per_turn / even.len() as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const RATE: f64 = 20_000.0;

    /// A run-up from 10 to 40 Hz in 2 s: 50 turns. Speed and angle (turns) at a sample.
    fn run_up(i: usize) -> (f64, f64) {
        let t = i as f64 / RATE;
        (10.0 + 15.0 * t, t * (10.0 + 7.5 * t))
    }

    #[test]
    fn what_repeats_per_turn_has_its_line_whatever_the_speed_does() {
        let speeds: Vec<f64> = (0..40_000).map(|i| run_up(i).0).collect();
        let signal: Vec<f64> = (0..40_000).map(|i| 3.0 * libm::sin(TAU * 3.585 * run_up(i).1)).collect();
        let angles = EvenAngles::of(&speeds, RATE).unwrap();
        assert!((angles.mean_speed() - 25.0).abs() < 1e-3, "{}", angles.mean_speed());
        assert_eq!(angles.per_turn(), 2000.0);
        let found = OrderSpectrum::of(&signal, &angles, 20.0);
        let top = (0..found.order.len()).max_by(|&a, &b| found.amplitude[a].total_cmp(&found.amplitude[b])).unwrap();
        // A grid eight times finer than the line is wide; a Hann line is 0.6 % lower between two of its points.
        assert!((found.order[top] - 3.585).abs() < 0.5 * found.line_width / 8.0, "{}", found.order[top]);
        assert!((found.amplitude[top] / 3.0 - 1.0).abs() < 0.01, "{}", found.amplitude[top]);
        assert!((found.line_width - 4.0 / 50.0).abs() < 1e-4, "{}", found.line_width);
        assert!(*found.order.last().unwrap() <= 20.0);
        // In time the same signal is spread over 36 to 143 Hz.
        let (power, bin) = spectrum::power(&signal, RATE, 4 * signal.len());
        let highest = power.iter().fold(0.0f64, |high, p| high.max(p.sqrt())) * 4.0 / signal.len() as f64;
        assert!(highest < 0.5 && bin < 0.2, "{highest}");
    }

    #[test]
    fn a_constant_speed_takes_every_sample_as_it_is() {
        let angles = EvenAngles::of(&[25.0; 4000], RATE).unwrap();
        let signal: Vec<f64> = (0..4000).map(|i| libm::sin(0.1 * i as f64)).collect();
        let even = angles.resampled(&signal);
        assert!(even.len() >= 3999 && even.iter().zip(&signal).all(|(a, b)| (a - b).abs() < 1e-9));
        assert_eq!(angles.per_turn(), 800.0);
    }

    #[test]
    fn standing_and_slow_parts_are_left_out_and_too_few_turns_have_none() {
        let speeds: Vec<f64> = (0..60_000).map(|i| if i < 20_000 { 0.0 } else { -20.0 }).collect();
        let angles = EvenAngles::of(&speeds, RATE).unwrap();
        assert!(angles.used().0 >= 20_000.0 && (angles.mean_speed() - 20.0).abs() < 1e-9);
        assert_eq!(EvenAngles::of(&[0.0; 100], RATE), None);
        assert_eq!(EvenAngles::of(&[25.0; 1500], RATE), None);
        assert_eq!(EvenAngles::of(&[], RATE), None);
    }
}
