//! The entry of an element into a spall, in the averaged signal.
//!
//! **Onset.** As the contact leaves the raceway, its force falls and the housing follows smoothly, below the
//! frequencies of impacts and with the opposite sign. When the element's centre stands over the edge, an elastic
//! contact has lost 14 to 16 % of its force (computed with Love's half-space), so the moment at which the excursion
//! reaches 15 % of its first extreme is the edge: later swings are the housing's answer. It is found on the straight
//! line through 25 % and 50 %, which noise hardly reaches.
//!
//! **Silence before.** What still rings of the last passage is predicted from the stretch before and taken off. How
//! well that succeeds is measured in the same stretch, by predictions from earlier moments; where it is worse than
//! taking off nothing, nothing is taken off.

use super::linear_prediction::Ringing;
use crate::{spectrum, statistics};

/// Share of its force that an elastic contact has lost when its centre stands over a sharp edge.
const LOST_AT_EDGE: f64 = 0.15;
/// Widest stretch before the first impact in which an entry is looked for (degrees).
const REACH: f64 = 3.0;
/// Travel after the last impact that is left to what the impact itself forces (degrees).
const AFTER: f64 = 1.0;
/// Points per degree on which ringing is predicted, and samples from which.
const FINENESS: f64 = 10.0;
const ORDER: usize = 24;
/// An excursion counts from this share of the tallest, and from so many standard deviations of what is there before: a
/// swing half as tall as any, or one that is surely there. Where an element needs longer to get free than the housing
/// to answer, the force's fall makes a first swing, and its end a taller one of the other sign.
const COUNTS: [f64; 2] = [0.5, 0.2];
const STANDS_OUT: [f64; 2] = [3.0, 4.0];
/// The same far before a single impact.
const COUNTS_FAR: f64 = 0.2;
const STANDS_OUT_FAR: f64 = 6.0;

/// The entry's excursion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Where the element's centre stands over the leading edge [grid points, with fraction].
    pub at: f64,
    /// From there to half the excursion (grid points).
    pub half_way: f64,
    /// Extreme of the excursion (grid points).
    pub extreme: f64,
    /// Standard uncertainty of `at` from what still rings and from noise (grid points).
    pub uncertainty: f64,
    /// Extreme in standard deviations of what is there before.
    pub clearness: f64,
}

/// The entry before the first impact at grid point `impact` of the averaged signal over one spacing, `degree` grid
/// points being one degree; `span` from first to last impact (grid points).
pub(crate) fn entry(signal: &[f64], impact: f64, span: f64, degree: f64) -> Option<Entry> {
    let smooth = smooth(signal, degree);
    let index = |degrees: f64| (impact + degrees * degree).max(0.0) as usize;
    let (from, to) = (index(-REACH), index(-FLANK).min(smooth.len()));
    let before = smooth.get(index(-5.0 - REACH)..from)?;
    if before.len() < 8 || to < from + 4 {
        return None;
    }
    let plain =
        Silence { base: statistics::median(before), noise: statistics::spread(before), rings: vec![0.0; to - from] };
    let silence = match predicted(&smooth, impact, span, degree, to - from) {
        Some(predicted) if predicted.noise < plain.noise => predicted,
        _ => plain,
    };
    let quiet: Vec<f64> = smooth[from..to].iter().zip(&silence.rings).map(|(x, r)| x - r).collect();
    let away = |i: usize| (quiet[i] - silence.base).abs();
    let tallest = (0..quiet.len()).map(away).fold(0.0, f64::max);
    let limit = [0, 1].map(|k| (COUNTS[k] * tallest).max(STANDS_OUT[k] * silence.noise));
    let limit = limit[0].min(limit[1]);
    let leaves = (0..quiet.len()).find(|&i| away(i) > limit)?;
    let extreme = (leaves..quiet.len() - 1).find(|&i| away(i + 1) <= away(i)).unwrap_or(quiet.len() - 1);
    let entry = rise(&quiet, 0, extreme, silence.base, silence.noise)?;
    Some(Entry { at: entry.at + from as f64, extreme: entry.extreme + from as f64, ..entry })
}

/// What is there without an entry.
struct Silence {
    base: f64,
    /// Standard deviation of what is left.
    noise: f64,
    /// To be taken off, from the reach of the entry on.
    rings: Vec<f64>,
}

/// The last passage's ringing, carried on over `count` grid points before the first impact.
fn predicted(smooth: &[f64], impact: f64, span: f64, degree: f64, count: usize) -> Option<Silence> {
    let n = smooth.len();
    let step = degree / FINENESS;
    // From the last impact of the passage before, around the circle of one spacing, to the reach of the entry.
    let silent = n as f64 - span - (AFTER + REACH) * degree;
    let points = (silent / step).max(0.0) as usize;
    let from = impact - REACH * degree - points as f64 * step;
    let value = |at: f64| {
        let i = at.floor();
        let point = |i: f64| smooth[i.rem_euclid(n as f64) as usize % n];
        point(i) + (at - i) * (point(i + 1.0) - point(i))
    };
    let all: Vec<f64> = (0..points).map(|k| value(from + k as f64 * step)).collect();
    let base = statistics::mean(&all);
    let past: Vec<f64> = all.iter().map(|x| x - base).collect();
    let ringing = Ringing::of(&past, ORDER)?;
    let ahead = (REACH * FINENESS) as usize;
    // The same from earlier moments, whose future is known.
    let tries =
        (0..).map(|k| past.len().checked_sub(ahead + k * ahead / 3)).map_while(|end| end.filter(|&end| end >= ORDER));
    let mut missed = Vec::new();
    for end in tries {
        let guess = ringing.ahead(&past[..end], ahead);
        missed.extend(guess.iter().zip(&past[end..]).map(|(g, x)| g - x));
    }
    let noise = statistics::rms(&missed);
    let rings = ringing.ahead(&past, ahead + 1);
    let at = |i: usize| {
        let sample = (i as f64 / step).min(ahead as f64);
        let k = (sample as usize).min(ahead - 1);
        rings[k] + (sample - k as f64) * (rings[k + 1] - rings[k])
    };
    (!missed.is_empty() && noise.is_finite()).then(|| Silence { base, noise, rings: (0..count).map(at).collect() })
}

/// The entry when there is one impact only, at the exit: the first excursion that leaves the silence before, however
/// early.
pub(crate) fn far_entry(signal: &[f64], impact: f64, degree: f64) -> Option<Entry> {
    let smooth = smooth(signal, degree);
    let to = ((impact - FLANK * degree).max(0.0) as usize).min(smooth.len());
    // The silence: the quietest stretch of three degrees before the impact.
    let stretch = ((3.0 * degree) as usize).max(8);
    let quiet = (0..to.checked_sub(stretch)?)
        .step_by((stretch / 12).max(1))
        .min_by(|&a, &b| spread_from(&smooth, a, stretch).total_cmp(&spread_from(&smooth, b, stretch)))?;
    let before = &smooth[quiet..quiet + stretch];
    let (base, noise) = (statistics::median(before), statistics::deviation(before));
    let away = |i: usize| (smooth[i] - base).abs();
    let tallest = (quiet..to).map(away).fold(0.0, f64::max);
    let limit = (STANDS_OUT_FAR * noise).max(COUNTS_FAR * tallest);
    let leaves = (quiet + stretch..to).find(|&i| away(i) > limit)?;
    let extreme = (leaves..to - 1).find(|&i| away(i + 1) <= away(i))?;
    let far = rise(&smooth, quiet, extreme, base, noise)?;
    // It must also stand out of the ringing that the impact has left, and be where it was.
    let end = extreme as f64 + FLANK * degree;
    let again = entry(signal, end, impact - end, degree)?;
    let same = (again.at - far.at).abs() < degree;
    Some(Entry { clearness: if same { far.clearness.min(again.clearness) } else { 0.0 }, ..far })
}

/// Half the length of the impact's own flank, which begins a filter's length before its steepest point (degrees).
const FLANK: f64 = 0.2;

fn smooth(signal: &[f64], degree: f64) -> Vec<f64> {
    // A tenth of a degree is a fraction of the contact's own length and takes off what noise is left.
    spectrum::gaussian(signal, 0.1 * degree)
}

fn spread_from(signal: &[f64], from: usize, count: usize) -> f64 {
    statistics::deviation(&signal[from..from + count])
}

/// The flank from `base` to the extreme at grid point `extreme`, not before `from`.
fn rise(smooth: &[f64], from: usize, extreme: usize, base: f64, noise: f64) -> Option<Entry> {
    let height = smooth[extreme] - base;
    let share = |i: usize| (smooth[i] - base) / height;
    let crossing = |limit: f64| {
        let i = (from..extreme).rev().find(|&i| share(i) < limit)?;
        Some(i as f64 + (limit - share(i)) / (share(i + 1) - share(i)))
    };
    let (quarter, half) = (crossing(0.25)?, crossing(0.5)?);
    let slope = 0.25 / (half - quarter).max(1e-9);
    let clearness = height.abs() / noise.max(f64::MIN_POSITIVE);
    let at = quarter - (0.25 - LOST_AT_EDGE) / slope;
    Some(Entry { at, half_way: half - at, extreme: extreme as f64, uncertainty: 1.0 / (clearness * slope), clearness })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Random;

    const DEGREE: f64 = 20.0;
    const IMPACT: f64 = 240.0;

    /// A passage of 40 degrees in which the housing swings from 1.8 degrees before the impact on: first by `first`,
    /// 0.9 degrees long, then by 1 with the other sign.
    fn passage(first: f64, noise: f64) -> Vec<f64> {
        let mut random = Random::new(5);
        let swing = |s: f64| -> f64 {
            let half = |from: f64| libm::sin(std::f64::consts::PI * (s - from) / 0.9);
            if s < 0.0 {
                0.0
            } else if s < 0.9 {
                -first * half(0.0)
            } else {
                half(0.9) * libm::exp(-0.5 * (s - 0.9))
            }
        };
        (0..800).map(|i| swing((f64::from(i) - IMPACT) / DEGREE + 1.8) + noise * random.normal()).collect()
    }

    /// Where the entry is found [degrees before the impact].
    fn found(first: f64, noise: f64) -> f64 {
        entry(&passage(first, noise), IMPACT, 60.0, DEGREE).map_or(f64::NAN, |e| (IMPACT - e.at) / DEGREE)
    }

    #[test]
    fn an_entry_begins_with_the_first_swing_even_where_the_next_is_more_than_twice_as_tall() {
        for first in [0.9, 0.45, 0.3] {
            // 15 % of a half-sine 0.9 degrees long come 0.04 degrees after its beginning; smoothing moves that by less
            // than its own 0.1 degrees.
            let onset = found(first, 0.01);
            assert!((onset - 1.8).abs() < 0.15, "{first}: {onset}");
        }
    }

    #[test]
    fn what_does_not_stand_out_of_the_noise_or_is_small_is_no_entry() {
        // In both cases the tall swing's beginning is left, 0.9 degrees later.
        for (first, noise) in [(0.1, 0.01), (0.25, 0.2)] {
            let onset = found(first, noise);
            assert!((onset - 0.9).abs() < 0.15, "{first}, {noise}: {onset}");
        }
    }
}
