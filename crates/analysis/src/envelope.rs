//! Whether elements that pass a defect of the outer raceway can be heard, and how often one passes.
//!
//! Each passage excites resonances anew, so that the envelope of a band that holds one repeats with the ball pass
//! frequency. The envelope's logarithm is taken, which no single impact can rule, and its spectrum searched near the
//! nominal BPFO for the frequency with the strongest comb of harmonics:
//! ```text
//! S(f) = mean over k of ln(1 + P(k f) / noise near k f),   noise = median of P between (k ± 0.4) f
//! ```
//! Harmonics that fall on the shaft's own comb are left out: a healthy machine has those. Significance is judged by the
//! recording itself, from S at frequencies at which nothing in the bearing happens.

use super::spectrum::{self, Band, Spectrum};
use super::statistics;

/// Harmonics in the comb. The envelope of two impacts per passage has nulls: one harmonic proves nothing.
const HARMONICS: usize = 10;
/// Largest deviation of the ball pass frequency from pure rolling: 3 % slip behind, 2 % ahead by inexact dimensions or
/// speed.
const SLIP: std::ops::RangeInclusive<f64> = -0.02..=0.03;
/// Standard deviations above the chance level at which a comb is taken to exist.
pub const SIGNIFICANT: f64 = 8.0;

/// The strongest comb near the BPFO.
#[derive(Debug, Clone, PartialEq)]
pub struct Comb {
    /// Its frequency [Hz].
    pub frequency: f64,
    /// How far it stands above chance, in standard deviations of S elsewhere.
    pub significance: f64,
    /// The band whose envelope shows it best [Hz].
    pub band: Band,
}

impl Comb {
    /// Whether the comb is more than chance.
    pub fn is_significant(&self) -> bool {
        self.significance >= SIGNIFICANT
    }
}

/// Octaves below the Nyquist frequency, down to a few multiples of the ball pass frequency.
pub fn bands(rate: f64, bpfo: f64) -> Vec<Band> {
    // The uppermost tenth below Nyquist is the recorder's anti-aliasing filter.
    let mut high = 0.45 * rate;
    let mut bands = Vec::new();
    while 0.5 * high > 6.0 * bpfo && bands.len() < 8 {
        bands.push(Band { low: 0.5 * high, high });
        high *= 0.5;
    }
    bands
}

/// Searches all bands for the strongest comb near the nominal `bpfo` [Hz] of a shaft that turns at `speed` [Hz].
pub fn find_comb(spectrum: &mut Spectrum, rate: f64, bpfo: f64, speed: f64) -> Comb {
    let whole = Band { low: 0.0, high: 0.45 * rate };
    bands(rate, bpfo)
        .into_iter()
        .map(|band| comb_in(&spectrum.squared_envelope(band), rate, bpfo, speed, band))
        .max_by(|a, b| a.significance.total_cmp(&b.significance))
        .unwrap_or_else(|| comb_in(&spectrum.squared_envelope(whole), rate, bpfo, speed, whole))
}

/// The strongest comb from half to twice the nominal `bpfo` [Hz], where there is none near it: a wrong speed or rate,
/// or another part of the bearing. Only the band of the comb near `bpfo` is searched.
pub fn find_elsewhere(spectrum: &mut Spectrum, rate: f64, bpfo: f64, speed: f64, band: Band) -> Comb {
    comb_within(&spectrum.squared_envelope(band), rate, bpfo, [0.5, 2.0], speed, band)
}

fn comb_in(squared_envelope: &[f64], rate: f64, bpfo: f64, speed: f64, band: Band) -> Comb {
    comb_within(squared_envelope, rate, bpfo, [1.0 - SLIP.end(), 1.0 - SLIP.start()], speed, band)
}

/// The strongest comb at a frequency within shares of `bpfo`.
fn comb_within(squared_envelope: &[f64], rate: f64, bpfo: f64, within: [f64; 2], speed: f64, band: Band) -> Comb {
    // The comb ends at HARMONICS·1.5 BPFO: means over blocks that keep that band lose nothing and save time.
    let block = ((rate / (bpfo * HARMONICS as f64 * 6.0)) as usize).max(1);
    let (envelope, rate) = (log_blocks(squared_envelope, block), rate / block as f64);
    let duration = envelope.len() as f64 / rate;
    let (power, bin) = spectrum::power(&envelope, rate, 4 * envelope.len());
    let strength = |frequency: f64| comb_strength(&power, bin, frequency, speed, duration);
    let step = 0.1 / (duration * HARMONICS as f64);
    // Near the outer ring's frequency the shaft's comb may pass; what is sought elsewhere must not be it.
    let far = within[1] - within[0] > 0.5;
    let of_shaft = |f: f64| (f / speed - (f / speed).round()).abs() * speed < 0.01 * f;
    let best = steps(bpfo * within[0], bpfo * within[1], step)
        .filter(|&f| !(far && of_shaft(f)))
        .map(|f| (f, strength(f)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or((bpfo, 0.0));
    // Elsewhere: far enough not to see the comb itself through the window's main lobe.
    let gap = (0.04 * bpfo).max(2.5 / duration);
    let chance: Vec<f64> = steps(0.55 * bpfo, 1.45 * bpfo, (0.9 * bpfo / 600.0).max(step))
        .filter(|f| (f - best.0).abs() > gap && (f - bpfo).abs() > gap)
        .map(strength)
        .collect();
    // Its upper half is widened by combs that share some harmonics with the BPFO's: take the lower half's spread.
    let middle = statistics::median(&chance);
    let spread = middle - statistics::quantile(&chance, 0.1587).unwrap_or(middle);
    Comb { frequency: best.0, significance: (best.1 - middle) / spread.max(0.05), band }
}

fn comb_strength(power: &[f64], bin: f64, frequency: f64, speed: f64, duration: f64) -> f64 {
    let at = |f: f64| power.get((f / bin).round() as usize).copied().unwrap_or(0.0);
    let mut sum = 0.0;
    let mut count = 0.0;
    for k in 1..=HARMONICS {
        let f = k as f64 * frequency;
        let turns = f / speed;
        if (turns - turns.round()).abs() * speed < 2.0 / duration {
            continue;
        }
        let (from, to) = (((f - 0.4 * frequency) / bin) as usize, ((f + 0.4 * frequency) / bin) as usize);
        if to >= power.len() {
            break;
        }
        // A tenth of the bins serve the median as well as all.
        let around: Vec<f64> = power[from..to].iter().step_by(((to - from) / 60).max(1)).copied().collect();
        let noise = statistics::median(&around);
        sum += libm::log1p(if noise > 0.0 { (at(f) / noise).min(1e4) } else { 0.0 });
        count += 1.0;
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

/// Logarithm of the mean over blocks, without its mean.
fn log_blocks(squared_envelope: &[f64], block: usize) -> Vec<f64> {
    let floor = 1e-6 * statistics::mean(squared_envelope) + f64::MIN_POSITIVE;
    let mut logs: Vec<f64> =
        squared_envelope.chunks_exact(block).map(|c| libm::log(statistics::mean(c) + floor)).collect();
    let mean = statistics::mean(&logs);
    logs.iter_mut().for_each(|x| *x -= mean);
    logs
}

fn steps(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = ((to - from) / step).ceil().max(1.0) as usize;
    (0..=count).map(move |i| from + (to - from) * i as f64 / count as f64)
}
