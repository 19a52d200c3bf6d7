//! Combs of the three kinds of fault beside each other, each by the share of the envelope's variance that repeats.
//!
//! A recording is cut into octaves. A comb counts by the mean of the two octaves in which its share is largest, at one
//! frequency for both: impacts excite more than one, while a healthy raceway hums in one. Of the strongest comb all
//! lines with their sidebands are then taken out, and what is left of the two others is theirs alone: BPFO + BPFI =
//! Z f_shaft, three harmonics of BPFO lie within 1 % of two of BPFI and four within 2 % of three of 2 BSF, so that the
//! comb of one kind shows in those of the others.

use super::lines::{LOBE, Lines, is_mains, steps};
use crate::spectrum::{Band, Spectrum};
use brinell::geometry::kinematics::Frequencies;
use serde::Serialize;

/// Largest deviation of the ball pass frequency from pure rolling: 3 % slip behind, 2 % ahead by inexact dimensions or
/// speed.
pub(crate) const SLIP: std::ops::RangeInclusive<f64> = -0.02..=0.03;
/// The same where the shaft's own lines say how fast it turns: dimensions that are inexact, a contact angle, slip under
/// load.
const SLIP_OF_KNOWN: std::ops::RangeInclusive<f64> = -0.012..=0.02;
/// Difference of frequencies, as a share, up to which they are of one comb.
const SAME: f64 = 0.01;
/// Multiples of a comb's frequency at which it has many of its lines, too.
const RELATED: [f64; 7] = [1.0, 2.0, 3.0, 0.5, 1.5, 1.0 / 3.0, 2.0 / 3.0];
/// Difference from these, as a share, from which a comb is another one, where a line's lobe is not wider.
const OTHER: f64 = 0.02;
/// Octaves whose mean counts.
const COUNTED: usize = 2;

/// A comb of harmonics in the envelope's spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Comb {
    /// Its frequency (Hz).
    #[serde(rename = "frequency_hz")]
    pub frequency: f64,
    /// Share of the variance of the envelope's logarithm that repeats at it, mean of the two octaves with most; a
    /// single line without others or sidebands counts little.
    pub share: f64,
    /// The same without the lines of the strongest comb; equal for that one itself.
    pub alone: f64,
    /// What noise alone has there.
    #[serde(skip)]
    pub noise: f64,
    /// The band whose envelope shows it best (Hz).
    #[serde(skip)]
    pub band: Band,
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

/// The strongest comb of each kind of fault.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Combs {
    /// Near BPFO.
    pub outer: Comb,
    /// Near BPFI.
    pub inner: Comb,
    /// Near 2 BSF.
    pub element: Comb,
    /// The strongest comb at half to twice these frequencies that is not related to the strongest of the three.
    #[serde(skip)]
    pub(crate) elsewhere: Comb,
    /// Of the share of the strongest of the three what harmonics hold that are no multiples of 2, and of 3.
    #[serde(skip)]
    pub(crate) between_multiples: [f64; 2],
    /// The strongest at half or a third of that one's frequency, of what is left without it.
    #[serde(skip)]
    pub(crate) between: Comb,
    /// Turns of the shaft in the recording.
    #[serde(skip)]
    pub(crate) turns: f64,
}

impl Combs {
    /// Searches a recording of a shaft that turns at `speed` (Hz) near the nominal frequencies, both of the stated
    /// speed; `shaft` is the shaft's speed by its own lines (Hz), where they show it.
    pub(crate) fn find(
        spectrum: &mut Spectrum,
        rate: f64,
        nominal: Frequencies,
        speed: f64,
        shaft: Option<f64>,
    ) -> Self {
        let ratio = shaft.map_or(1.0, |shaft| shaft / speed);
        let [bpfo, bpfi, bsf, ftf] = [nominal.bpfo, nominal.bpfi, nominal.bsf, nominal.ftf].map(|f| ratio * f);
        let nominal = Frequencies { bpfo, bpfi, bsf, ftf };
        let slip = if shaft.is_some() { SLIP_OF_KNOWN } else { SLIP };
        Self::near(&mut |band| (spectrum.squared_envelope(band), rate), rate, nominal, ratio * speed, slip)
    }

    /// The same in the squared envelopes that `envelope` gives of a band, each with its own rate (Hz): at equal shaft
    /// angles, where the speed changes.
    pub fn find_of(
        envelope: &mut dyn FnMut(Band) -> (Vec<f64>, f64),
        rate: f64,
        nominal: Frequencies,
        speed: f64,
    ) -> Self {
        Self::near(envelope, rate, nominal, speed, SLIP)
    }

    fn near(
        envelope: &mut dyn FnMut(Band) -> (Vec<f64>, f64),
        rate: f64,
        nominal: Frequencies,
        speed: f64,
        slip: std::ops::RangeInclusive<f64>,
    ) -> Self {
        let mut bands = bands(rate, nominal.bpfo);
        if bands.is_empty() {
            bands.push(Band { low: 0.0, high: 0.45 * rate });
        }
        let lines = |band| {
            let (envelope, rate) = envelope(band);
            Lines::of(&envelope, rate, band, nominal.bpfi * (1.0 - SLIP.start()), speed)
        };
        let mut all: Vec<Lines> = bands.into_iter().map(lines).collect();
        let frequencies = [nominal.bpfo, nominal.bpfi, 2.0 * nominal.bsf];
        // What turns through the load zone has sidebands.
        let beside = [None, Some(speed), Some(nominal.ftf)];
        let near = |all: &[Lines], kind: usize| {
            let f = frequencies[kind];
            strongest(all, [f * (1.0 - slip.end()), f * (1.0 - slip.start())], beside[kind], |_| true)
        };
        let mut three = [0, 1, 2].map(|kind| near(&all, kind));
        let leader = (0..3).max_by(|&a, &b| three[a].share.total_cmp(&three[b].share)).unwrap_or(0);
        let own = three[leader].frequency;
        let lobes = 2.0 * LOBE / all[0].duration;
        let is_related = |f: f64| RELATED.iter().any(|times| (f - times * own).abs() <= (OTHER * f).max(lobes));
        let other = |f: f64| !all[0].of_shaft(f) && !is_mains(f) && !is_related(f);
        let elsewhere = strongest(&all, [0.5 * nominal.bpfo, 2.0 * nominal.bpfi], None, other);
        let between_multiples = [2, 3].map(|parts| mean_of_best(&all, |lines| lines.share_between(own, parts)));
        let sideband = [speed, speed, nominal.ftf][leader];
        all.iter_mut().for_each(|lines| lines.without(own, sideband));
        for other in (0..3).filter(|&other| other != leader) {
            // Its own comb, wherever in the range that is; and no more than there was.
            let own = near(&all, other);
            three[other].alone = own.share.min(three[other].share);
            if own.share > 0.5 * three[other].share {
                three[other] = Comb { share: three[other].share, alone: three[other].alone, ..own };
            }
        }
        let part = |parts: f64| {
            let middle = own / parts;
            strongest(&all, [middle * (1.0 - SAME), middle * (1.0 + SAME)], None, |_| true)
        };
        let [half, third] = [2.0, 3.0].map(part);
        let between = if half.share > third.share { half } else { third };
        let [outer, inner, element] = three;
        let turns = all[0].duration * speed;
        Self { outer, inner, element, elsewhere, between_multiples, between, turns }
    }
}

/// The strongest comb between two frequencies (Hz), of those that are asked for, with sidebands at a distance (Hz).
fn strongest(all: &[Lines], [low, high]: [f64; 2], beside: Option<f64>, asked: impl Fn(f64) -> bool) -> Comb {
    let duration = all[0].duration;
    // Windows of the sixth harmonic overlap to nine tenths from step to step.
    let step = (0.1 / duration).max(4e-4 * low);
    let tried =
        steps(low, high, step).filter(|&f| asked(f)).map(|f| (f, mean_of_best(all, |lines| lines.share(f, beside))));
    let (rough, share) = tried.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((low, 0.0));
    // Within the windows all frequencies have the same share: there the lines' height decides, and which band shows
    // them in most harmonics.
    let within = (0.004 * rough).max(LOBE / duration);
    let sharpest = |lines: &Lines, step: f64| {
        let tried = steps((rough - within).max(low), (rough + within).min(high), step / duration);
        tried.map(|f| (f, lines.sharpness(f))).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((rough, 0.0))
    };
    let by_band = all.iter().map(|lines| (lines, sharpest(lines, 0.2).1));
    let best = by_band.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(&all[0], |best| best.0);
    let frequency = sharpest(best, 0.02).0;
    Comb { frequency, share, alone: share, noise: mean_of_best(all, |lines| lines.noise(rough)), band: best.band }
}

/// Mean of the largest [`COUNTED`] values over all bands.
fn mean_of_best(all: &[Lines], value: impl Fn(&Lines) -> f64) -> f64 {
    let mut values: Vec<f64> = all.iter().map(value).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    crate::statistics::mean(&values[..values.len().min(COUNTED)])
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOMINAL: Frequencies = Frequencies { bpfo: 53.77, bpfi: 81.23, bsf: 35.35, ftf: 5.97 };

    fn found(envelope: &[f64], rate: f64) -> Combs {
        Combs::find_of(&mut |_| (envelope.to_vec(), rate), rate, NOMINAL, 15.0)
    }

    #[test]
    fn the_comb_of_passages_without_noise_stands_where_they_are() {
        let (rate, duration) = (8000.0, 3.7);
        for share in [0.985, 0.9985, 1.0, 1.012] {
            // Two impacts in each passage that decay in the structure, as a simulation without noise has them.
            let passage = |t: f64| {
                let bpfo = share * NOMINAL.bpfo;
                let since = |delay: f64| (t * bpfo - delay).rem_euclid(1.0) / bpfo;
                libm::exp(-400.0 * since(0.0)) + 0.5 * libm::exp(-400.0 * since(0.1)) + 1e-9
            };
            let envelope: Vec<f64> = (0..(rate * duration) as usize).map(|i| passage(i as f64 / rate)).collect();
            let comb = found(&envelope, rate).outer;
            // A twentieth of a passage over the whole recording, which alignment follows with ease.
            let lost = (comb.frequency - share * NOMINAL.bpfo) * duration;
            assert!(lost.abs() < 0.05, "{lost:.3} passages of {:.0} at {share}", share * NOMINAL.bpfo * duration);
        }
    }

    #[test]
    fn the_share_that_repeats_does_not_grow_with_the_duration() {
        let (rate, mut random) = (8000.0, crate::statistics::Random::new(4));
        let mut sample = |i: usize| {
            let since = (i as f64 / rate * NOMINAL.bpfi).rem_euclid(1.0) / NOMINAL.bpfi;
            // An envelope of noise has a square that is distributed exponentially.
            (1.0 + 4.0 * libm::exp(-400.0 * since)) * -libm::log(1.0 - random.uniform())
        };
        let envelope: Vec<f64> = (0..(16.0 * rate) as usize).map(&mut sample).collect();
        let [short, long] = [2.0, 16.0].map(|seconds| found(&envelope[..(seconds * rate) as usize], rate));
        // The scatter of the noise in the windows over two seconds.
        assert!((long.inner.share / short.inner.share - 1.0).abs() < 0.15, "{short:?} {long:?}");
        for other in [&long.outer, &long.element, &short.outer, &short.element] {
            assert!(other.alone < 0.2 * long.inner.share, "{other:?}");
        }
    }
}
