//! The passages of elements over the defect, found one by one and laid over each other.
//!
//! The cage is not a clock: slip and the elements' play in their pockets move a passage by tenths of a degree, which
//! would blur an average taken at the mean period. Each passage is therefore shifted until the rises of its envelope
//! agree best with the mean of all (cross-correlation, repeated), near the shift of its neighbours. Where even passages
//! make the averaged signal stronger, the shifts were noise and even passages are kept.
//!
//! Angles are degrees of element travel: one ball pass period is one element spacing.

use crate::recording::value_at;
use crate::{spectrum, statistics};

/// Points per element spacing at which shifts are sought; parabolas refine them.
pub(crate) const GRID: usize = 400;
/// Resamplings of the passages from which the uncertainty of a length is read.
pub(crate) const RESAMPLINGS: usize = 60;
/// Largest distance of a passage from its neighbours' (grid points).
const NEAR: isize = 20;
/// Largest shift when they are known already (grid points).
const CLOSE: isize = 8;
/// Largest shift at first (grid points).
const FAR: isize = 50;
/// Single passages from which the alignment begins, besides the mean of all.
const BEGINNINGS: usize = 6;
/// Passages up to which the envelope's spectrum may be too coarse for their period.
const FEW: usize = 150;
/// Gain of contrast from which shifts are true ones: those that follow noise raise it a little.
const CLEARER: f64 = 1.05;
/// Passages used at most: more do not sharpen the average and cost time.
pub(crate) const MOST: usize = 1200;
/// The same where no length is read from events.
pub(crate) const MOST_WITHOUT_EVENTS: usize = 400;

/// When elements pass the defect.
#[derive(Debug, Clone, PartialEq)]
pub struct Passages {
    /// Start of each passage's period (samples).
    pub starts: Vec<f64>,
    /// Samples per passage, mean over the recording.
    pub period: f64,
    /// Which passages of the recording these are.
    index: Vec<usize>,
}

impl Passages {
    /// Even passages, `most` of them, before anything is known of them. `period` is the ball pass period (samples) as
    /// the envelope's spectrum gives it.
    pub fn even(samples: usize, period: f64, most: usize) -> Self {
        // One period at each end is lost to the filters' ends and to shifts.
        let count = ((samples as f64 / period) as usize).saturating_sub(2).min(most);
        let index: Vec<usize> = (0..count).collect();
        Self { starts: evenly(&index, period), period, index }
    }

    /// Those at these indices.
    pub fn chosen(&self, indices: &[usize]) -> Self {
        let of = |k: &usize| (self.starts[*k], self.index[*k]);
        let (starts, index) = indices.iter().map(of).unzip();
        Self { starts, index, ..*self }
    }

    /// Finds even passages where they are. `squared_envelope` is that of a band which shows them, `signal` the raw
    /// signal; `follow` where they may drift far from even ones, as those over a ring that turns with the shaft do.
    pub fn found(self, signal: &[f64], squared_envelope: &[f64], follow: bool) -> Self {
        let Self { starts: even, period, index, .. } = self;
        let log = rises(squared_envelope, period);
        let line = |starts: &[f64]| line(starts, &index);
        let aligned = align(&log, &even, period, follow);
        let power = |starts: &[f64]| power(signal, starts, period);
        // A cage that runs like a clock is best met by a straight line through the shifts, or, where the envelope is
        // too smooth to give them, by the period that makes the average strongest; then by the shifts of the signal
        // itself.
        let mut candidates = vec![line(&aligned), clock(signal, &index, period)];
        for k in 0..candidates.len() {
            let mut follows = candidates[k].clone();
            for _ in 0..3 {
                follows = line(&round(signal, &follows, period, CLOSE));
            }
            candidates.push(follows);
        }
        candidates.push(even);
        let best = if follow {
            // What turns with the shaft turns its sign in the signal too: only the envelope shows it.
            let contrast = |starts: &[f64]| statistics::deviation(&template(&log, starts, period));
            let best = candidates.into_iter().max_by(|a, b| contrast(a).total_cmp(&contrast(b)));
            best.filter(|best| contrast(&aligned) < CLEARER * contrast(best)).or(Some(aligned))
        } else {
            candidates.push(aligned);
            candidates.into_iter().max_by(|a, b| power(a).total_cmp(&power(b)))
        };
        Self::from_starts(best.unwrap_or_default(), period, index)
    }

    /// The same passages, aligned anew by the envelope of the impacts' band, if that makes the averaged envelope
    /// steeper. The averaged signal must not suffer.
    pub fn refined(self, signal: &[f64], squared_envelope: &[f64]) -> Self {
        let log = rises(squared_envelope, self.period);
        let mut shifted = self.starts.clone();
        for _ in 0..3 {
            shifted = round(&log, &shifted, self.period, CLOSE);
        }
        let contrast = |starts: &[f64]| statistics::deviation(&mean(&log, starts, self.period, GRID));
        // Shifts that follow noise raise the contrast a little; true ones raise it clearly.
        let kept = power(signal, &shifted, self.period) / power(signal, &self.starts, self.period);
        if kept > 0.98 && contrast(&shifted) > 1.02 * contrast(&self.starts) {
            Self::from_starts(shifted, self.period, self.index)
        } else {
            self
        }
    }

    /// How far the passages' mean stands out, by the rises of an envelope.
    pub fn contrast(&self, squared_envelope: &[f64]) -> f64 {
        statistics::deviation(&template(&rises(squared_envelope, self.period), &self.starts, self.period))
    }

    /// The same passages with their periods beginning `share` of a period later.
    pub fn later(&self, share: f64) -> Self {
        let starts = self.starts.iter().map(|s| s + share * self.period).collect();
        Self { starts, ..self.clone() }
    }

    fn from_starts(starts: Vec<f64>, period: f64, index: Vec<usize>) -> Self {
        let even = line(&starts, &index);
        let mean_period = match (index.first(), index.last()) {
            (Some(&first), Some(&last)) if last > first => (even[even.len() - 1] - even[0]) / (last - first) as f64,
            _ => period,
        };
        Self { starts, period: mean_period, index }
    }
}

fn evenly(index: &[usize], period: f64) -> Vec<f64> {
    index.iter().map(|&i| (0.5 + i as f64) * period).collect()
}

/// Even passages at the period near `period` which makes the average strongest. Many passages have no need of it: the
/// envelope's spectrum resolves their period.
fn clock(signal: &[f64], index: &[usize], period: f64) -> Vec<f64> {
    let count = index.len();
    let even = |period: f64| evenly(index, period);
    if count > FEW {
        return even(period);
    }
    // Steps of a quarter of a degree, at 40° spacing, over all passages; up to 1.5 %, which is 1/(10·8) of the fewest.
    let step = 1.0 / (160.0 * count as f64);
    let steps = (0.015 / step) as i32;
    let strength = |period: f64| -> f64 { mean(signal, &even(period), period, 128).iter().map(|x| x * x).sum() };
    let tried = (-steps..=steps).map(|k| period * (1.0 + step * f64::from(k))).map(|p| (p, strength(p)));
    even(tried.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(period, |best| best.0))
}

/// Power of the signal averaged over the passages: what agrees from passage to passage.
fn power(signal: &[f64], starts: &[f64], period: f64) -> f64 {
    mean(signal, starts, period, GRID).iter().map(|x| x * x).sum()
}

/// Even passages on the straight line that fits best.
fn line(starts: &[f64], index: &[usize]) -> Vec<f64> {
    let middle = index.iter().sum::<usize>() as f64 / index.len().max(1) as f64;
    let mean = statistics::mean(starts);
    let (mut xy, mut xx) = (0.0, 0.0);
    for (&i, s) in index.iter().zip(starts) {
        let x = i as f64 - middle;
        xy += x * (s - mean);
        xx += x * x;
    }
    let period = if xx > 0.0 { xy / xx } else { 0.0 };
    index.iter().map(|&i| mean + (i as f64 - middle) * period).collect()
}

/// `count` values of a signal, the first at `from`, each `step` after the one before.
fn spread(signal: &[f64], from: f64, step: f64, count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| value_at(signal, from + step * i as f64))
}

/// One row of `points` values per passage, spread evenly over its period.
pub fn cut(signal: &[f64], starts: &[f64], period: f64, points: usize) -> Vec<Vec<f64>> {
    let step = period / points as f64;
    starts.iter().map(|&start| spread(signal, start, step, points).collect()).collect()
}

/// Mean of the rows that [`cut`] gives, point by point; without passages nothing.
pub fn mean(signal: &[f64], starts: &[f64], period: f64, points: usize) -> Vec<f64> {
    let step = period / points as f64;
    let mut mean = vec![0.0; if starts.is_empty() { 0 } else { points }];
    for &start in starts {
        for (sum, value) in mean.iter_mut().zip(spread(signal, start, step, points)) {
            *sum += value;
        }
    }
    mean.iter_mut().for_each(|sum| *sum /= starts.len() as f64);
    mean
}

/// Mean of the rows, point by point; there is at least one.
pub fn average<'a>(rows: impl IntoIterator<Item = &'a Vec<f64>>) -> Vec<f64> {
    let (mut sum, mut count) = (Vec::new(), 0.0);
    for row in rows {
        sum.resize(row.len(), 0.0);
        sum.iter_mut().zip(row).for_each(|(s, x)| *s += x);
        count += 1.0;
    }
    sum.iter_mut().for_each(|s| *s /= count);
    sum
}

/// What passages are aligned by: how fast the envelope's logarithm rises, over a quarter of a degree at 40° spacing;
/// where it falls, 0. Impacts rise steeply; the decay after them, with its beats, is long and would align their echoes
/// as gladly.
fn rises(squared: &[f64], period: f64) -> Vec<f64> {
    let smooth = spectrum::running_mean(squared, (period / 640.0) as usize);
    let floor = statistics::quantile(&smooth, 0.05).unwrap_or(0.0) + f64::MIN_POSITIVE;
    let log: Vec<f64> = smooth.iter().map(|&x| libm::log(x.max(floor))).collect();
    let width = ((period / 160.0) as usize).max(1);
    let half = width / 2;
    let level = spectrum::running_mean(&log, half);
    let reach = half + 1;
    (0..level.len())
        .map(|i| {
            let (before, after) = (i.saturating_sub(reach), (i + reach).min(level.len() - 1));
            (level[after] - level[before]).max(0.0)
        })
        .collect()
}

/// Aligns from several beginnings and keeps the result with the most contrast: from the blurred mean alone, the
/// passages can settle in two groups, an impact's echo of one lying on the impact of the other.
fn align(log: &[f64], even: &[f64], period: f64, follow: bool) -> Vec<f64> {
    let beginnings = (1..=BEGINNINGS).map(|k| k * even.len() / (BEGINNINGS + 1)).filter(|&k| k < even.len());
    let mut aligned = vec![align_from(log, even, period, template(log, even, period), None)];
    for k in beginnings {
        let single = template(log, &[even[k]], period);
        if follow {
            aligned.push(align_from(log, even, period, single.clone(), Some(k)));
        }
        aligned.push(align_from(log, even, period, single, None));
    }
    let contrast = |starts: &[f64]| statistics::deviation(&template(log, starts, period));
    aligned.into_iter().max_by(|a, b| contrast(a).total_cmp(&contrast(b))).unwrap_or_else(|| even.to_vec())
}

/// Shifts passages to agree with a template, each near its neighbours; the first time anywhere near even passages, or
/// following them one by one from passage `from` on.
fn align_from(log: &[f64], even: &[f64], period: f64, beginning: Vec<f64>, from: Option<usize>) -> Vec<f64> {
    let step = period / GRID as f64;
    let mut shifted = even.to_vec();
    let mut template_now = beginning;
    for pass in 0..5 {
        if let Some(from) = from.filter(|_| pass == 0) {
            shifted = followed(log, even, step, &template_now, from);
        } else {
            // What the neighbours need is the better guess for each, until each is found by itself.
            let shifts: Vec<f64> = shifted.iter().zip(even).map(|(s, e)| (s - e) / step).collect();
            let expected: Vec<f64> = running_median(&shifts, 4).iter().zip(even).map(|(d, e)| e + d * step).collect();
            let reach = if pass == 0 { FAR } else { NEAR };
            shifted = expected.iter().map(|&s| s + step * best_shift(log, s, step, &template_now, reach)).collect();
        }
        recentre(&mut shifted, even);
        template_now = template(log, &shifted, period);
    }
    shifted
}

/// Passages found one after the other, forwards and backwards from one of them, each near the last few.
fn followed(log: &[f64], even: &[f64], step: f64, template: &[f64], from: usize) -> Vec<f64> {
    let mut shifts = vec![0.0; even.len()];
    let mut follow = |passages: &mut dyn Iterator<Item = usize>| {
        let mut last = [0.0; 5];
        for (count, k) in passages.enumerate() {
            let near = statistics::median(&last);
            let at = even[k] + near * step;
            shifts[k] = near + best_shift(log, at, step, template, NEAR);
            last[count % last.len()] = shifts[k];
        }
    };
    follow(&mut (from + 1..even.len()));
    follow(&mut (0..from).rev());
    shifts.iter().zip(even).map(|(d, e)| e + d * step).collect()
}

/// One round of shifting each passage by at most `reach` to the mean of all.
fn round(log: &[f64], starts: &[f64], period: f64, reach: isize) -> Vec<f64> {
    let step = period / GRID as f64;
    let template = template(log, starts, period);
    let mut shifted: Vec<f64> = starts.iter().map(|&s| s + step * best_shift(log, s, step, &template, reach)).collect();
    recentre(&mut shifted, starts);
    shifted
}

fn template(log: &[f64], starts: &[f64], period: f64) -> Vec<f64> {
    let mut template = mean(log, starts, period, GRID);
    let mean = statistics::mean(&template);
    template.iter_mut().for_each(|x| *x -= mean);
    template
}

/// Takes out the mean shift, which has no meaning and would drift.
fn recentre(shifted: &mut [f64], from: &[f64]) {
    let mean = statistics::mean(shifted) - statistics::mean(from);
    shifted.iter_mut().for_each(|s| *s -= mean);
}

/// Shift (grid points) at which the log envelope from `start` on agrees best with the template.
fn best_shift(log: &[f64], start: f64, step: f64, template: &[f64], reach: isize) -> f64 {
    let width = template.len() + 2 * reach as usize;
    let from = start - reach as f64 * step;
    let row: Vec<f64> = spread(log, from, step, width).collect();
    // All shifts side by side: the sum of one alone would wait for itself at each point.
    let mut fits = vec![0.0; 2 * reach as usize + 1];
    for (skipped, b) in template.iter().enumerate() {
        for (fit, a) in fits.iter_mut().zip(&row[skipped..]) {
            *fit += a * b;
        }
    }
    let best = (0..fits.len()).max_by(|&a, &b| fits[a].total_cmp(&fits[b])).unwrap_or(reach as usize);
    if best == 0 || best + 1 == fits.len() {
        // No maximum inside: this passage is lost in noise, let it go with its neighbours.
        return 0.0;
    }
    best as f64 - reach as f64 + statistics::vertex([fits[best - 1], fits[best], fits[best + 1]])
}

fn running_median(values: &[f64], half: usize) -> Vec<f64> {
    (0..values.len())
        .map(|i| statistics::median(&values[i.saturating_sub(half)..(i + half + 1).min(values.len())]))
        .collect()
}
