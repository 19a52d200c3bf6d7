//! The events of one passage: the entry's onset and the blows, read from passages laid over each other.
//!
//! **Blow.** A jump of the high-frequency envelope: the mean level over a short window after a moment against that before it.
//! The energy that appears there, not the level, ranks it: what is left of an earlier blow does not count.
//! **Onset.** As the contact leaves the raceway, its force falls and the housing follows smoothly, below the frequencies of
//! blows and with the opposite sign. When the element's centre stands over the edge, an elastic contact has lost 14 to 16 % of its
//! force (computed with Love's half-space), so the moment at which the excursion reaches 15 % of its extreme is the edge. It is
//! found on the straight line through 25 % and 50 %, which noise and what still rings of the last passage hardly reach.

use super::spectrum;
use super::statistics;

/// Share of its force that an elastic contact has lost when its centre stands over a sharp edge.
const LOST_AT_EDGE: f64 = 0.15;
/// A blow brings at least this share of the strongest blow's energy; below are echoes and noise.
const WEAKEST_BLOW: f64 = 0.12;
/// A blow jumps at least by this share of the steepest blow's jump [dB]: it rises out of silence, or over a decaying blow, while an echo
/// or a beat rises over what it is a part of.
const LOWEST_JUMP: f64 = 0.3;
/// A jump that no echo makes [dB].
const STEEP: f64 = 8.0;
/// Correlation of loudness over the passages from which a rise is an echo of the blow before: two edges are hit each in its own way.
const SAME_CAUSE: f64 = 0.6;
/// Passages below which such a correlation may be chance: 0.6 of 20 passages is three standard deviations.
const FEWEST_TO_COMPARE: usize = 20;
/// Widest stretch before the first blow in which an entry is looked for [degrees].
const ENTRY_REACH: f64 = 3.0;

/// A blow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blow {
    /// Where the envelope rises fastest [grid points, with fraction].
    pub at: f64,
    /// Jump of the envelope [dB].
    pub jump: f64,
    /// Energy that appears, as a share of the strongest's.
    pub energy: f64,
}

/// The entry's excursion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Where the element's centre stands over the leading edge [grid points, with fraction].
    pub at: f64,
    /// From there to half the excursion [grid points].
    pub half_way: f64,
    /// Extreme of the excursion [grid points].
    pub extreme: f64,
    /// Standard uncertainty of `at` from what still rings and from noise [grid points].
    pub uncertainty: f64,
    /// Extreme in standard deviations of what is there before.
    pub clearness: f64,
}

/// Blows of a passage in the order of the circle of one spacing, that after the longest silence first.
///
/// `level` is the averaged envelope [dB] over one spacing, `width` the window [grid points] of the jump, `smallest` the least
/// jump that is no accident [dB].
pub fn blows(level: &[f64], width: usize, smallest: f64) -> Vec<Blow> {
    let n = level.len();
    if n < 4 * width {
        return Vec::new();
    }
    let jumps = jumps(level, width);
    let power: Vec<f64> = level.iter().map(|&l| libm::exp10(l / 10.0)).collect();
    let mut found: Vec<Blow> = (0..n)
        .filter(|&i| jumps[i] >= smallest)
        .filter(|&i| (1..=width).all(|k| jumps[(i + k) % n] <= jumps[i] && jumps[(i + n - k) % n] < jumps[i]))
        .map(|i| {
            let peak = (0..2 * width).map(|k| power[(i + k) % n]).fold(0.0, f64::max);
            Blow { at: i as f64 + vertex(&jumps, i), jump: jumps[i], energy: peak - power[(i + n - width) % n] }
        })
        .collect();
    let strongest = found.iter().map(|b| b.energy).fold(0.0, f64::max);
    let steepest = found.iter().map(|b| b.jump).fold(0.0, f64::max);
    found.retain(|b| b.energy >= WEAKEST_BLOW * strongest && b.jump >= LOWEST_JUMP * steepest);
    found.iter_mut().for_each(|b| b.energy /= strongest);
    after_the_longest_silence(found, n)
}

/// The blows without echoes: rises that are loud whenever an earlier blow is loud, passage by passage, and not steep by themselves.
///
/// `envelopes` is one row per passage on the grid of the blows.
pub fn without_echoes(mut blows: Vec<Blow>, envelopes: &[Vec<f64>], width: usize) -> Vec<Blow> {
    let Some(n) = envelopes.first().map(Vec::len).filter(|_| envelopes.len() >= FEWEST_TO_COMPARE) else {
        return blows;
    };
    let loudness = |blow: &Blow| -> Vec<f64> {
        let from = blow.at.max(0.0) as usize;
        let loudest = |row: &Vec<f64>| (0..width).map(|k| row[(from + k) % n]).fold(f64::MIN_POSITIVE, f64::max);
        envelopes.iter().map(|row| libm::log(loudest(row))).collect()
    };
    let all: Vec<Vec<f64>> = blows.iter().map(loudness).collect();
    let echo =
        |i: usize| blows[i].jump < STEEP && (0..i).any(|j| statistics::correlation(&all[i], &all[j]) > SAME_CAUSE);
    let kept: Vec<bool> = (0..blows.len()).map(|i| !echo(i)).collect();
    let mut kept = kept.into_iter();
    blows.retain(|_| kept.next().unwrap_or(true));
    after_the_longest_silence(blows, n)
}

/// Blows around a circle of `n` points, that after the longest silence first.
fn after_the_longest_silence(mut blows: Vec<Blow>, n: usize) -> Vec<Blow> {
    let silence = |i: usize| {
        let before = blows[(i + blows.len() - 1) % blows.len()].at;
        (blows[i].at - before).rem_euclid(n as f64)
    };
    if blows.len() > 1
        && let Some(first) = (0..blows.len()).max_by(|&a, &b| silence(a).total_cmp(&silence(b)))
    {
        blows.rotate_left(first);
    }
    blows
}

/// Where, within `reach` grid points of `near`, the envelope jumps most.
pub fn jump_near(level: &[f64], width: usize, near: f64, reach: usize) -> f64 {
    let n = level.len();
    let jumps = jumps(level, width);
    let from = near.round() as isize - reach as isize;
    let best = (0..=2 * reach)
        .map(|k| (from + k as isize).rem_euclid(n as isize) as usize)
        .max_by(|&a, &b| jumps[a].total_cmp(&jumps[b]))
        .unwrap_or(0);
    best as f64 + vertex(&jumps, best)
}

/// Mean level over `width` points after each point less that before it, around the circle.
fn jumps(level: &[f64], width: usize) -> Vec<f64> {
    let n = level.len();
    let mut sum: f64 = (0..width).map(|k| level[(1 + k) % n] - level[n - 1 - k]).sum();
    (0..n)
        .map(|i| {
            let jump = sum / width as f64;
            sum += level[(i + 1 + width) % n] - level[(i + 1) % n] - level[i] + level[(i + n - width) % n];
            jump
        })
        .collect()
}

fn vertex(values: &[f64], i: usize) -> f64 {
    let n = values.len();
    let (a, b, c) = (values[(i + n - 1) % n], values[i], values[(i + 1) % n]);
    let bend = a - 2.0 * b + c;
    if bend < 0.0 { (0.5 * (a - c) / bend).clamp(-0.5, 0.5) } else { 0.0 }
}

/// The entry before the first blow at grid point `blow` of the averaged signal, `degree` grid points being one degree.
pub fn entry(signal: &[f64], blow: f64, degree: f64) -> Option<Entry> {
    let smooth = smooth(signal, degree);
    let index = |degrees: f64| (blow + degrees * degree).max(0.0) as usize;
    let (from, to) = (index(-ENTRY_REACH), index(-FLANK).min(smooth.len()));
    let before = smooth.get(index(-5.0 - ENTRY_REACH)..from)?;
    if before.len() < 8 || to < from + 4 {
        return None;
    }
    let base = statistics::median(before);
    let extreme = (from..to).max_by(|&a, &b| (smooth[a] - base).abs().total_cmp(&(smooth[b] - base).abs()))?;
    rise(&smooth, from, extreme, base, statistics::spread(before))
}

/// The entry when there is one blow only, at the exit: the first excursion that leaves the silence before, however early.
pub fn far_entry(signal: &[f64], blow: f64, degree: f64) -> Option<Entry> {
    let smooth = smooth(signal, degree);
    let to = ((blow - FLANK * degree).max(0.0) as usize).min(smooth.len());
    // The silence: the quietest stretch of three degrees before the blow.
    let stretch = ((3.0 * degree) as usize).max(8);
    let quiet = (0..to.checked_sub(stretch)?)
        .step_by((stretch / 12).max(1))
        .min_by(|&a, &b| spread_from(&smooth, a, stretch).total_cmp(&spread_from(&smooth, b, stretch)))?;
    let before = &smooth[quiet..quiet + stretch];
    let (base, noise) = (statistics::median(before), statistics::deviation(before));
    let away = |i: usize| (smooth[i] - base).abs();
    let tallest = (quiet..to).map(away).fold(0.0, f64::max);
    // Half of the tallest swing is surely entry and ringing, not what is left of the last passage.
    let limit = (6.0 * noise).max(0.4 * tallest);
    let leaves = (quiet + stretch..to).find(|&i| away(i) > limit)?;
    let extreme = (leaves..to - 1).find(|&i| away(i + 1) <= away(i))?;
    rise(&smooth, quiet, extreme, base, noise)
}

/// Half the length of the blow's own flank, which begins a filter's length before its steepest point [degrees].
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
