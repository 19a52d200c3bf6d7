//! Combs in the envelope's spectrum: whether something in the bearing passes a defect, and how often.
//!
//! Each passage excites resonances anew, so that the envelope of a band that holds one repeats with the passages. The
//! envelope's logarithm is taken, which no single impact can rule, and its spectrum searched near a nominal frequency
//! for the one with the strongest comb of harmonics, each with its sidebands where the load zone or the cage modulates
//! the passages:
//! ```text
//! S(f) = mean over k of ln(1 + [P(k f) + P(k f ± f_side)] / noise near k f),   noise = median of P between (k ± 0.4) f
//! ```
//! Harmonics that fall on the shaft's own comb are left out: a healthy machine has those. Significance is judged by the
//! recording itself, from S at frequencies at which nothing in the bearing happens.

use crate::spectrum;
use crate::spectrum::{Band, Spectrum};
use crate::statistics;
use rayon::prelude::*;

/// Harmonics in the comb. The envelope of two impacts per passage has nulls: one harmonic proves nothing.
const HARMONICS: usize = 10;
/// Height above the noise that counts as much as any: a comb must be there in many harmonics.
const TALLEST: f64 = 1e4;
/// Largest deviation of the ball pass frequency from pure rolling: 3 % slip behind, 2 % ahead by inexact dimensions or
/// speed.
pub(crate) const SLIP: std::ops::RangeInclusive<f64> = -0.02..=0.03;
/// Power that counts as nothing, as a share of the mean: 30 dB down. Signals without noise, as simulations give
/// them, hold all of a bearing's frequencies at some level; what counts is which of them is loud.
pub(crate) const QUIET: f64 = 1e-3;
/// Half the width of a line's main lobe, times the duration: so far from its middle a comb may look as strong.
pub(crate) const LOBE: f64 = 2.5;
/// Standard deviations above the chance level at which a comb is taken to exist.
pub const SIGNIFICANT: f64 = 8.0;

/// A comb to look for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pattern {
    /// Nominal frequency (Hz).
    pub frequency: f64,
    /// Distance of the sidebands that belong to each harmonic (Hz); 0 for none.
    pub sideband: f64,
}

/// The strongest comb near a nominal frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Comb {
    /// Its frequency (Hz).
    pub frequency: f64,
    /// How far it stands above chance, in standard deviations of S elsewhere.
    pub significance: f64,
    /// S of its harmonics alone, without sidebands: by how much they stand above the noise near them (nepers of power).
    pub strength: f64,
    /// The band whose envelope shows it best (Hz).
    pub band: Band,
}

impl Comb {
    /// Whether the comb is more than chance.
    pub fn is_significant(&self) -> bool {
        self.significance >= SIGNIFICANT
    }
}

/// Octaves below the Nyquist frequency, down to a few multiples of the ball pass frequency.
pub(crate) fn bands(rate: f64, bpfo: f64) -> Vec<Band> {
    // The uppermost tenth below Nyquist is the recorder's anti-aliasing filter.
    let mut high = 0.45 * rate;
    let mut bands = Vec::new();
    while 0.5 * high > 6.0 * bpfo && bands.len() < 8 {
        bands.push(Band { low: 0.5 * high, high });
        high *= 0.5;
    }
    bands
}

/// Searches all bands for the strongest comb near each pattern's frequency; the shaft turns at `speed` (Hz), and `bpfo`
/// (Hz) says how low bands go. `envelope` gives the squared envelope of a band with its own rate (Hz): at equal shaft
/// angles, where the speed changes.
pub fn find_combs<const N: usize>(
    envelope: &mut dyn FnMut(Band) -> (Vec<f64>, f64),
    rate: f64,
    patterns: [Pattern; N],
    bpfo: f64,
    speed: f64,
) -> [Comb; N] {
    let mut bands = bands(rate, bpfo);
    if bands.is_empty() {
        bands.push(Band { low: 0.0, high: 0.45 * rate });
    }
    let mut best: [Option<Comb>; N] = std::array::from_fn(|_| None);
    for band in bands {
        let (envelope, rate) = envelope(band);
        let found =
            |pattern| comb_within(&envelope, rate, pattern, [1.0 - SLIP.end(), 1.0 - SLIP.start()], speed, band);
        best.par_iter_mut().zip(&patterns).for_each(|(best, &pattern)| {
            let found = found(pattern);
            if best.as_ref().is_none_or(|best| found.significance >= best.significance) {
                *best = Some(found);
            }
        });
    }
    std::array::from_fn(|k| {
        let none = Band { low: 0.0, high: 0.45 * rate };
        best[k].take().unwrap_or(Comb {
            frequency: patterns[k].frequency,
            significance: 0.0,
            strength: 0.0,
            band: none,
        })
    })
}

/// The strongest comb from half to twice the nominal `bpfo` (Hz), where there is none near it: a wrong speed or rate,
/// or another part of the machine. Only the band of the comb near `bpfo` is searched.
pub(crate) fn find_elsewhere(spectrum: &mut Spectrum, rate: f64, bpfo: f64, speed: f64, band: Band) -> Comb {
    let pattern = Pattern { frequency: bpfo, sideband: 0.0 };
    comb_within(&spectrum.squared_envelope(band), rate, pattern, [0.5, 2.0], speed, band)
}

/// The strongest comb at a frequency within shares of the pattern's.
fn comb_within(
    squared_envelope: &[f64],
    rate: f64,
    pattern: Pattern,
    within: [f64; 2],
    speed: f64,
    band: Band,
) -> Comb {
    let nominal = pattern.frequency;
    // The comb ends at HARMONICS·1.5 times it.
    let lines = Lines::of(squared_envelope, rate, 1.5 * nominal, speed);
    let strength = |frequency: f64| lines.strength(Pattern { frequency, ..pattern }, TALLEST);
    let step = 0.1 / (lines.duration * HARMONICS as f64);
    // Near the outer ring's frequency the shaft's comb may pass; what is sought elsewhere must not be it.
    let far = within[1] - within[0] > 0.5;
    let best = steps(nominal * within[0], nominal * within[1], step)
        .filter(|&f| !(far && lines.of_shaft(f)))
        .map(|f| (f, strength(f)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or((nominal, 0.0));
    // Lines that all stand above the limit are as strong beside their middle as in it: there their height decides.
    let height = |f: f64| lines.strength(Pattern { frequency: f, ..pattern }, f64::INFINITY);
    let frequency = steps(nominal * within[0], nominal * within[1], step)
        .filter(|f| (f - best.0).abs() * lines.duration < LOBE)
        .map(|f| (f, height(f)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(best.0, |highest| highest.0);
    // Elsewhere: far enough not to see the comb itself through the window's main lobe.
    let gap = (0.04 * nominal).max(2.5 / lines.duration);
    let chance: Vec<f64> = steps(0.55 * nominal, 1.45 * nominal, (0.9 * nominal / 600.0).max(step))
        .filter(|f| (f - frequency).abs() > gap && (f - nominal).abs() > gap)
        .map(strength)
        .collect();
    let strength = lines.strength(Pattern { frequency, sideband: 0.0 }, f64::INFINITY);
    Comb { frequency, significance: above(&chance, best.1), strength, band }
}

/// How far a value stands above chance, in standard deviations of the lower half of `chance`: its upper half is widened
/// by combs that share some harmonics with the one that is judged.
pub(crate) fn above(chance: &[f64], value: f64) -> f64 {
    let middle = statistics::median(chance);
    let spread = middle - statistics::quantile(chance, 0.1587).unwrap_or(middle);
    (value - middle) / spread.max(0.05)
}

/// Lines of an envelope's logarithm.
pub(crate) struct Lines {
    power: Vec<f64>,
    /// Hz.
    bin: f64,
    /// Of the recording (s).
    pub(crate) duration: f64,
    /// Of the shaft (Hz), whose harmonics are left out.
    speed: f64,
}

impl Lines {
    /// Those of combs up to a frequency (Hz).
    pub(crate) fn of(squared_envelope: &[f64], rate: f64, highest: f64, speed: f64) -> Self {
        // Means over blocks that keep the band of the comb lose nothing and save time.
        let block = ((rate / (highest * HARMONICS as f64 * 4.0)) as usize).max(1);
        let (envelope, rate) = (log_blocks(squared_envelope, block), rate / block as f64);
        let (power, bin) = spectrum::power(&envelope, rate, 4 * envelope.len());
        Self { power, bin, duration: envelope.len() as f64 / rate, speed }
    }

    /// Whether a comb at this frequency (Hz) is the shaft's.
    pub(crate) fn of_shaft(&self, frequency: f64) -> bool {
        let turns = frequency / self.speed;
        (turns - turns.round()).abs() * self.speed < 0.01 * frequency
    }

    /// S of a pattern; a line counts as if it stood above the noise by at most `tallest`.
    fn strength(&self, pattern: Pattern, tallest: f64) -> f64 {
        let Pattern { frequency, sideband } = pattern;
        let heights = self.heights(frequency, |f| {
            self.at(f) + if sideband > 0.0 { self.at(f - sideband) + self.at(f + sideband) } else { 0.0 }
        });
        statistics::mean(&heights.map(|height| libm::log1p(height.1.min(tallest))).collect::<Vec<_>>())
    }

    /// Harmonics of a frequency that are not the shaft's (Hz), and how high `power` of each stands above the noise near
    /// it.
    pub(crate) fn heights(&self, frequency: f64, power: impl Fn(f64) -> f64) -> impl Iterator<Item = (f64, f64)> {
        let harmonics = (1..=HARMONICS).map(move |k| k as f64 * frequency);
        let near =
            move |f: f64| ((f - 0.4 * frequency) / self.bin) as usize..((f + 0.4 * frequency) / self.bin) as usize;
        harmonics
            .filter(|f| {
                let turns = f / self.speed;
                (turns - turns.round()).abs() * self.speed >= 2.0 / self.duration
            })
            .take_while(move |&f| near(f).end < self.power.len())
            .map(move |f| {
                // A tenth of the bins serve the median as well as all.
                let around = &self.power[near(f)];
                let some: Vec<f64> = around.iter().step_by((around.len() / 60).max(1)).copied().collect();
                let noise = statistics::median(&some);
                (f, if noise > 0.0 { power(f) / noise } else { 0.0 })
            })
    }

    pub(crate) fn at(&self, frequency: f64) -> f64 {
        self.power.get((frequency / self.bin).round() as usize).copied().unwrap_or(0.0)
    }
}

/// Logarithm of the mean over blocks, without its mean.
fn log_blocks(squared_envelope: &[f64], block: usize) -> Vec<f64> {
    let floor = QUIET * statistics::mean(squared_envelope) + f64::MIN_POSITIVE;
    let mut logs: Vec<f64> =
        squared_envelope.chunks_exact(block).map(|c| libm::log(statistics::mean(c) + floor)).collect();
    let mean = statistics::mean(&logs);
    logs.iter_mut().for_each(|x| *x -= mean);
    logs
}

pub(crate) fn steps(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / step).ceil().max(1.0) as usize;
    (0..=count).map(move |i| from + (to - from) * i as f64 / count as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_comb_of_passages_without_noise_stands_where_they_are() {
        let (rate, duration, bpfo, speed) = (8000.0, 3.7, 53.77, 15.0);
        for share in [0.985, 0.9985, 1.0, 1.012] {
            // Two impacts in each passage that decay in the structure, as a simulation without noise has them.
            let passage = |t: f64| {
                let since = |delay: f64| (t * share * bpfo - delay).rem_euclid(1.0) / (share * bpfo);
                libm::exp(-400.0 * since(0.0)) + 0.5 * libm::exp(-400.0 * since(0.1)) + 1e-9
            };
            let envelope: Vec<f64> = (0..(rate * duration) as usize).map(|i| passage(i as f64 / rate)).collect();
            let pattern = Pattern { frequency: bpfo, sideband: 0.0 };
            let [comb] = find_combs(&mut |_| (envelope.clone(), rate), rate, [pattern], bpfo, speed);
            // A twentieth of a passage over the whole recording, which alignment follows with ease.
            let lost = (comb.frequency - share * bpfo) * duration;
            assert!(lost.abs() < 0.05, "{lost:.3} passages of {:.0} at {share}", share * bpfo * duration);
        }
    }
}
