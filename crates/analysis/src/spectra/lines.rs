//! Lines in the spectrum of an envelope's logarithm, as shares of its variance.
//!
//! Each passage over a defect excites resonances anew, so that the envelope of a band that holds one repeats with the
//! passages. Its logarithm is taken, which no single impact can rule. Of a comb at f counts
//! ```text
//! share(f) = Σ over k of Σ over |ν − k f| ≤ w of max(P(ν) − N(ν), 0) / Σ P,   w = max(2/T, 0.004 k f)
//! ```
//! with P the power, N the noise near it and T the duration: the part of the variance that repeats at f. It does not
//! grow with the duration, as a significance does. w holds a line as wide as a wandering cage makes it, and a line of
//! the window. Lines of the shaft and of the mains are cut out of the windows: a healthy machine has those, and they
//! are what is strongest in one.
//!
//! A single line is no comb: it may be of anything that turns. So the strongest line of a comb counts up to
//! [`SUPPORTED`] times what the others hold, together with its sidebands where the damaged part turns through the load.

use crate::spectrum::Band;
use crate::{spectrum, statistics};
use std::f64::consts::LN_2;

/// Harmonics of a comb. The envelope of two impacts per passage has nulls: one harmonic proves nothing.
pub(crate) const HARMONICS: usize = 6;
/// Harmonics by which the frequency of a comb is placed: the higher, the finer.
const FINE: usize = 10;
/// Half the width of a line, as a share of its frequency: passages of recorded cages scatter by less.
const WIDTH: f64 = 0.004;
/// Half the width of a line's main lobe, times the duration: so far from its middle a comb may look as strong.
pub(crate) const LOBE: f64 = 2.5;
/// Half the width of what is cut out for a line of the shaft or of the mains, times the duration: Hann's lobe but for a
/// hundredth of its power.
const CUT: f64 = 1.5;
/// Frequencies of mains (Hz), and how far they may be from them, as a share.
const MAINS: [f64; 2] = [50.0, 60.0];
const MAINS_OFF: f64 = 1e-3;
/// Difference, as a share, up to which a comb cannot be told from that of the mains: it is then not cut out.
const IS_MAINS: f64 = 0.01;
/// Times what supports it that the strongest line of a comb counts: with 3, healthy machines have at most 4 % at the
/// frequencies of bearings that they do not have, where all that repeats makes 36 %.
const SUPPORTED: f64 = 3.0;
/// Power that counts as nothing, as a share of the mean: 30 dB down. Signals without noise, as simulations give
/// them, hold all of a bearing's frequencies at some level; what counts is which of them is loud.
const QUIET: f64 = 1e-3;
/// Sidebands of a comb that are taken for its own, on each side.
const SIDEBANDS: i32 = 2;

/// Lines of one band's envelope.
#[derive(Debug, Clone)]
pub(crate) struct Lines {
    /// The band (Hz).
    pub(crate) band: Band,
    /// Of the recording (s).
    pub(crate) duration: f64,
    /// Share of the variance of each bin.
    power: Vec<f64>,
    /// What of it is above the noise.
    excess: Vec<f64>,
    /// Sums of excess and of noise over all bins before.
    sums: Vec<f64>,
    noise: Vec<f64>,
    /// Hz.
    bin: f64,
    /// Of the shaft (Hz), whose harmonics are left out.
    speed: f64,
}

impl Lines {
    /// Those of combs up to a frequency (Hz), in the squared envelope of a band.
    pub(crate) fn of(squared_envelope: &[f64], rate: f64, band: Band, highest: f64, speed: f64) -> Self {
        // Means over blocks that keep the band of the comb lose nothing and save time.
        let top = highest * HARMONICS as f64;
        let block = ((rate / (4.0 * top)) as usize).max(1);
        let (envelope, rate) = (log_blocks(squared_envelope, block), rate / block as f64);
        let (mut power, bin) = spectrum::power(&envelope, rate, 4 * envelope.len());
        let counted = (0.5 * speed / bin) as usize..((top / bin) as usize).min(power.len());
        let total = power.get(counted).map_or(0.0, |counted| counted.iter().sum::<f64>()).max(f64::MIN_POSITIVE);
        power.iter_mut().for_each(|p| *p /= total);
        let noise = noise(&power, (speed / bin) as usize);
        let mut excess: Vec<f64> = power.iter().zip(&noise).map(|(p, n)| (p - n).max(0.0)).collect();
        let duration = envelope.len() as f64 / rate;
        for turn in 1..=(top / speed) as usize + 1 {
            let at = |side: f64| ((turn as f64 * speed + side * CUT / duration) / bin).max(0.0) as usize;
            let end = (at(1.0) + 1).min(excess.len());
            excess[at(-1.0).min(end)..end].fill(0.0);
        }
        Self { band, duration, power, sums: sums(&excess), noise: sums(&noise), excess, bin, speed }
    }

    /// Whether a comb at this frequency (Hz) is the shaft's.
    pub(crate) fn of_shaft(&self, frequency: f64) -> bool {
        self.off_shaft(frequency) < 0.01 * frequency
    }

    /// Distance from the nearest harmonic of the shaft (Hz).
    fn off_shaft(&self, frequency: f64) -> f64 {
        let turns = frequency / self.speed;
        (turns - turns.round()).abs() * self.speed
    }

    /// Share of the variance that repeats at a frequency (Hz), where no line stands alone; `beside` is the distance
    /// (Hz) of sidebands that support it.
    pub(crate) fn share(&self, frequency: f64, beside: Option<f64>) -> f64 {
        let lines: [f64; HARMONICS] = std::array::from_fn(|k| self.in_window((k + 1) as f64 * frequency, frequency));
        let strongest = lines.iter().copied().fold(0.0, f64::max);
        let rest = lines.iter().sum::<f64>() - strongest;
        let pair = |k: f64, distance: f64| {
            let side = |f: f64| self.between(&self.sums, f, self.half_width(f).min(0.4 * distance));
            side(k * frequency - distance) + side(k * frequency + distance)
        };
        let sidebands = beside.map_or(0.0, |distance| pair(1.0, distance).max(pair(2.0, distance)));
        strongest.min(SUPPORTED * (rest + sidebands)) + rest
    }

    /// What of it is in harmonics that are no multiples of `parts`: nothing where the comb is that of as many times
    /// the frequency.
    pub(crate) fn share_between(&self, frequency: f64, parts: usize) -> f64 {
        let own = (1..=HARMONICS).filter(|k| !k.is_multiple_of(parts));
        own.map(|k| self.in_window(k as f64 * frequency, frequency)).sum()
    }

    /// What noise alone has in the windows of such a comb.
    pub(crate) fn noise(&self, frequency: f64) -> f64 {
        (1..=HARMONICS).map(|k| k as f64 * frequency).map(|f| self.between(&self.noise, f, self.half_width(f))).sum()
    }

    /// What is above the noise at a harmonic (Hz) of a comb (Hz), without the lines of the mains.
    fn in_window(&self, f: f64, comb: f64) -> f64 {
        let width = self.half_width(f);
        let mut mains = MAINS.map(|base| nearest(base, f));
        if mains[0] == mains[1] {
            mains[1] = 0.0;
        }
        let is_mains = is_mains(comb);
        let cut = |&line: &f64| {
            let half = CUT / self.duration + MAINS_OFF * line;
            let (low, high) = ((line - half).max(f - width), (line + half).min(f + width));
            if is_mains || low >= high { 0.0 } else { self.between(&self.sums, 0.5 * (low + high), 0.5 * (high - low)) }
        };
        (self.between(&self.sums, f, width) - mains.iter().map(cut).sum::<f64>()).max(0.0)
    }

    /// Of sums over bins what is around a frequency (Hz).
    fn between(&self, sums: &[f64], f: f64, width: f64) -> f64 {
        let sum = |f: f64| sums[((f / self.bin).round().max(0.0) as usize).min(sums.len() - 1)];
        sum(f + width + self.bin) - sum(f - width)
    }

    fn half_width(&self, frequency: f64) -> f64 {
        (WIDTH * frequency).max(2.0 / self.duration)
    }

    /// Takes out the lines of a comb with sidebands at a distance (Hz): what is left of another comb is its own.
    pub(crate) fn without(&mut self, frequency: f64, sideband: f64) {
        // Half as wide again: the window's skirts and the wings of a wandering cage.
        for harmonic in (1..=2 * HARMONICS).map(|k| k as f64 * frequency) {
            let width = 1.5 * self.half_width(harmonic).max(LOBE / self.duration);
            for side in -SIDEBANDS..=SIDEBANDS {
                let middle = harmonic + f64::from(side) * sideband;
                let bins = ((middle - width) / self.bin).max(0.0) as usize..((middle + width) / self.bin) as usize + 1;
                let end = bins.end.min(self.excess.len());
                self.excess[bins.start.min(end)..end].fill(0.0);
            }
        }
        self.sums = sums(&self.excess);
    }

    /// Mean of ln(1 + height above the noise near it) over a comb's harmonics that are not the shaft's: sharpest in the
    /// middle of its lines.
    pub(crate) fn sharpness(&self, frequency: f64) -> f64 {
        let near = |f: f64| ((f - 0.4 * frequency) / self.bin) as usize..((f + 0.4 * frequency) / self.bin) as usize;
        let height = |f: f64| {
            let power = self.power.get((f / self.bin).round() as usize).copied().unwrap_or(0.0);
            let noise = some_median(&self.power[near(f)]);
            if noise > 0.0 { power / noise } else { 0.0 }
        };
        let harmonics = (1..=FINE).map(|k| k as f64 * frequency);
        let own = harmonics
            .filter(|&f| self.off_shaft(f) >= 2.0 / self.duration)
            .take_while(|&f| near(f).end < self.power.len());
        statistics::mean(&own.map(|f| libm::log1p(height(f))).collect::<Vec<_>>())
    }
}

/// The multiple of a frequency (Hz) that is nearest.
fn nearest(base: f64, f: f64) -> f64 {
    (f / base).round().max(1.0) * base
}

/// Whether a comb at this frequency (Hz) cannot be told from that of the mains.
pub(crate) fn is_mains(frequency: f64) -> bool {
    MAINS.iter().any(|&base| (nearest(base, frequency) / frequency - 1.0).abs() < IS_MAINS)
}

/// Mean power of the noise in each bin, from medians within `half` bins on both sides: the power of noise is
/// distributed exponentially, and its median is ln 2 of its mean.
fn noise(power: &[f64], half: usize) -> Vec<f64> {
    let half = half.max(16);
    let step = (half / 4).max(1);
    let median = |k: usize| {
        let middle = k * step;
        some_median(&power[middle.saturating_sub(half).min(power.len())..(middle + half).min(power.len())]) / LN_2
    };
    let medians: Vec<f64> = (0..=power.len() / step + 1).map(median).collect();
    let between = |i: usize| {
        let (k, rest) = (i / step, (i % step) as f64 / step as f64);
        medians[k] + rest * (medians[k + 1] - medians[k])
    };
    (0..power.len()).map(between).collect()
}

/// Median of a tenth of the bins, which serve as well as all.
fn some_median(bins: &[f64]) -> f64 {
    let some: Vec<f64> = bins.iter().step_by((bins.len() / 60).max(1)).copied().collect();
    statistics::median(&some)
}

/// Sum of all values before each, and of all.
fn sums(values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let all = values.iter().map(|x| {
        sum += x;
        sum
    });
    std::iter::once(0.0).chain(all).collect()
}

/// Logarithm of the mean over blocks, without its mean.
pub(super) fn log_blocks(squared_envelope: &[f64], block: usize) -> Vec<f64> {
    let floor = QUIET * statistics::mean(squared_envelope) + f64::MIN_POSITIVE;
    let mut logs: Vec<f64> =
        squared_envelope.chunks_exact(block).map(|c| libm::log(statistics::mean(c) + floor)).collect();
    let mean = statistics::mean(&logs);
    logs.iter_mut().for_each(|x| *x -= mean);
    logs
}

/// Values from one to another, at most a step apart.
pub(crate) fn steps(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / step).ceil().max(1.0) as usize;
    (0..=count).map(move |i| from + (to - from) * i as f64 / count as f64)
}
