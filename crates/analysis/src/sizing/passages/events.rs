//! The impacts of one passage, read from passages laid over each other.
//!
//! **Impact.** A jump of the high-frequency envelope: the mean level over a short window after a moment against that
//! before it. The energy that appears there, not the level, ranks it: what is left of an earlier impact does not count.

use crate::statistics;

/// An impact brings at least this share of the strongest impact's energy; below are echoes and noise.
const WEAKEST_IMPACT: f64 = 0.12;
/// On a raceway that turns through the load zone one edge may be struck much harder than the other: then this share is
/// enough, if the jump is steep.
const WEAKEST_STEEP: f64 = 0.03;
/// An impact jumps at least by this share of the steepest impact's jump (dB): it rises out of silence, or over a
/// decaying impact, while an echo or a beat rises over what it is a part of.
const LOWEST_JUMP: f64 = 0.3;
/// A jump that no late echo makes (dB).
const STEEP: f64 = 8.0;
/// Correlation of loudness over the passages from which a rise is an echo of the impact before: two edges are hit each
/// by its own force.
const SAME_CAUSE: f64 = 0.6;
/// Time after which echoes have died down (s): 1 m of housing at the 1 km/s of slow bending waves. Later ones do not
/// rise by [`STEEP`].
const DIED_DOWN: f64 = 1e-3;
/// Passages below which such a correlation may be chance: 0.6 of 20 passages is three standard deviations.
const FEWEST_TO_COMPARE: usize = 20;

/// An impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Where the envelope rises fastest [grid points, with fraction].
    pub at: f64,
    /// Jump of the envelope (dB).
    pub jump: f64,
    /// Energy that appears, as a share of the strongest's.
    pub energy: f64,
}

/// Impacts of a passage in the order of the circle of one spacing, that after the longest silence first.
///
/// `level` is the averaged envelope (dB) over one spacing, `width` the window (grid points) of the jump, `smallest` the
/// least jump that is no accident (dB), `turns` whether the raceway turns with the shaft.
pub(crate) fn impacts(level: &[f64], width: usize, smallest: f64, turns: bool) -> Vec<Impact> {
    let n = level.len();
    if n < 4 * width {
        return Vec::new();
    }
    let jumps = jumps(level, width);
    let power: Vec<f64> = level.iter().map(|&l| libm::exp10(l / 10.0)).collect();
    let mut found: Vec<Impact> = (0..n)
        .filter(|&i| jumps[i] >= smallest)
        .filter(|&i| (1..=width).all(|k| jumps[(i + k) % n] <= jumps[i] && jumps[(i + n - k) % n] < jumps[i]))
        .map(|i| {
            let peak = (0..2 * width).map(|k| power[(i + k) % n]).fold(0.0, f64::max);
            Impact { at: i as f64 + vertex(&jumps, i), jump: jumps[i], energy: peak - power[(i + n - width) % n] }
        })
        .collect();
    let strongest = found.iter().map(|impact| impact.energy).fold(0.0, f64::max);
    let steepest = found.iter().map(|impact| impact.jump).fold(0.0, f64::max);
    let weakest = |impact: &Impact| if turns && impact.jump >= STEEP { WEAKEST_STEEP } else { WEAKEST_IMPACT };
    found.retain(|impact| impact.energy >= weakest(impact) * strongest && impact.jump >= LOWEST_JUMP * steepest);
    found.iter_mut().for_each(|impact| impact.energy /= strongest);
    after_the_longest_silence(found, n)
}

/// Impacts and echoes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Classified {
    /// Those that are no echoes, that after the longest silence first.
    pub impacts: Vec<Impact>,
    /// Those that look like echoes, but come when all echoes have died down: they may be impacts too.
    pub doubtful: Vec<Impact>,
}

/// Separates echoes: rises that are loud whenever an earlier impact is loud, passage by passage, and that are
/// not both late and steep. Where the raceway turns with the shaft, all is loud under load, and steep is enough.
///
/// `envelopes` is one row per passage on the grid of the impacts, of which those `chosen` count; `rate` its points per
/// second.
pub(crate) fn classify_echoes(
    impacts: Vec<Impact>,
    envelopes: &[Vec<f64>],
    chosen: &[usize],
    width: usize,
    rate: f64,
    turns: bool,
) -> Classified {
    let Some(n) = envelopes.first().map(Vec::len).filter(|_| chosen.len() >= FEWEST_TO_COMPARE) else {
        return Classified { impacts, doubtful: Vec::new() };
    };
    let loudness = |impact: &Impact| -> Vec<f64> {
        let from = n + impact.at.max(0.0) as usize - width / 2;
        // The loudest window near the impact: a peak depends on where between two samples it falls, a fixed window on
        // how well the passage is aligned, and both edges share that.
        let loudest = |row: &Vec<f64>| {
            let mean = |k: usize| (0..width).map(|i| row[(from + k + i) % n]).sum::<f64>() / width as f64;
            (0..=width).map(mean).fold(f64::MIN_POSITIVE, f64::max)
        };
        chosen.iter().map(|&k| libm::log(loudest(&envelopes[k]))).collect()
    };
    let all: Vec<Vec<f64>> = impacts.iter().map(loudness).collect();
    let loud_together = |i: usize, j: usize| statistics::correlation(&all[i], &all[j]) > SAME_CAUSE;
    let late = |i: usize, j: usize| (impacts[i].at - impacts[j].at).rem_euclid(n as f64) > DIED_DOWN * rate;
    let steep = |i: usize, j: usize| (turns || late(i, j)) && impacts[i].jump >= STEEP;
    let echo = |i: &usize| (0..*i).any(|j| loud_together(*i, j) && !steep(*i, j));
    let (echoes, others): (Vec<usize>, Vec<usize>) = (0..impacts.len()).partition(echo);
    let doubtful = echoes.into_iter().filter(|&i| (0..i).all(|j| late(i, j))).map(|i| impacts[i]).collect();
    let impacts = others.into_iter().map(|i| impacts[i]).collect();
    Classified { impacts: after_the_longest_silence(impacts, n), doubtful }
}

/// Impacts around a circle of `n` points, that after the longest silence first.
fn after_the_longest_silence(mut impacts: Vec<Impact>, n: usize) -> Vec<Impact> {
    let silence = |i: usize| {
        let before = impacts[(i + impacts.len() - 1) % impacts.len()].at;
        (impacts[i].at - before).rem_euclid(n as f64)
    };
    if impacts.len() > 1
        && let Some(first) = (0..impacts.len()).max_by(|&a, &b| silence(a).total_cmp(&silence(b)))
    {
        impacts.rotate_left(first);
    }
    impacts
}

/// Where, within `reach` grid points of `near`, the envelope jumps most.
pub(crate) fn jump_near(level: &[f64], width: usize, near: f64, reach: usize) -> f64 {
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
    statistics::vertex([values[(i + n - 1) % n], values[i], values[(i + 1) % n]]).clamp(-0.5, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Random;

    /// Points of a passage, and per second.
    const POINTS: usize = 800;
    const RATE: f64 = 20_000.0;
    const WIDTH: usize = 6;

    /// Impacts classified in 60 passages: one at point 200, and one `later`, to which the level rises by 6 dB, that is
    /// as loud as the first passage by passage if they are `alike`.
    fn classified(later: usize, alike: bool) -> Classified {
        let mut random = Random::new(3);
        let mut row = || -> Vec<f64> {
            let loud = libm::exp(0.3 * random.normal());
            let second = if alike { loud } else { libm::exp(0.3 * random.normal()) };
            let mut row = vec![0.01; POINTS];
            row[200..200 + later].fill(loud);
            row[200 + later..500].fill(2.0 * second);
            row
        };
        let rows: Vec<Vec<f64>> = (0..60).map(|_| row()).collect();
        let chosen: Vec<usize> = (0..60).collect();
        let mean = crate::sizing::passages::fold::average(chosen.iter().map(|&k| &rows[k]));
        let level: Vec<f64> = mean.iter().map(|x| 20.0 * libm::log10(*x)).collect();
        // The first impact rises by 40 dB, and what follows must by a third of the steepest: 6 dB is not enough.
        let impacts = impacts(&level, WIDTH, 3.0, false);
        assert_eq!(impacts.len(), 1);
        let second = Impact { at: (200 + later) as f64, jump: 6.0, energy: 0.7 };
        classify_echoes([impacts, vec![second]].concat(), &rows, &chosen, WIDTH, RATE, false)
    }

    #[test]
    fn a_rise_as_loud_as_the_impact_before_is_its_echo_up_to_a_millisecond_and_in_doubt_later() {
        let count = |classified: Classified| (classified.impacts.len(), classified.doubtful.len());
        // 0.6 ms, then 5 ms.
        assert_eq!(count(classified(12, true)), (1, 0));
        assert_eq!(count(classified(100, true)), (1, 1));
        assert_eq!(count(classified(12, false)), (2, 0));
        assert_eq!(count(classified(100, false)), (2, 0));
    }
}
