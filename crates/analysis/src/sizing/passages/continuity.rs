//! Whether the passages of a recording follow one another without a break, and at the ball pass frequency itself.
//!
//! A piece that is missing, where no column of times shows it, moves the passages after it by the rest of a period.
//! Where as many lie before it as behind, their average shows each event twice, and the travel from the first to the
//! last means nothing. The averages of stretches of the recording are therefore laid beside each other: whole
//! recordings agree best where they are. A cage that skids does the same, with the same consequence.
//!
//! Passages at twice the ball pass frequency share every harmonic with it. Then the two halves of a period look
//! alike: rate or speed are wrong, or there are two spalls.

use super::fold;
use crate::statistics;

/// Stretches that are compared, fine ones that meet a break sharply and coarse ones for weak passages; and fewest
/// passages in one.
const STRETCHES: [usize; 2] = [8, 4];
const FEWEST: usize = 4;
/// Shift that is looked for (share of a passage): 2 degrees at 40° spacing, which alignment does not follow.
const SHIFT: f64 = 0.05;
/// Correlation of two stretches at that shift from which they are the same passages, and share of it that is left
/// without the shift.
const SAME: f64 = 0.65;
const LEFT: f64 = 0.5;

/// Correlation of a part of the period with the next one, as a share of that of the same parts in two stretches, from
/// which they are alike.
const ALIKE: f64 = 0.9;
/// Most parts that are looked for: with five of them, two of ten harmonics are left, and the comb is hardly one.
const MOST_PARTS: usize = 4;

/// Where passages are shifted against those before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Break {
    /// About the first passage behind it.
    pub(crate) passage: usize,
    /// Shift (share of a passage), from −0.5 to 0.5.
    pub(crate) shift: f64,
    /// By how many passages it may lie earlier or later.
    pub(crate) within: usize,
}

/// The first break in passages whose envelopes are `rows`, all of one length.
pub(crate) fn find_break(rows: &[Vec<f64>]) -> Option<Break> {
    STRETCHES.into_iter().filter(|count| count * FEWEST <= rows.len()).find_map(|count| {
        let start = |k: usize| k * rows.len() / count;
        let levels: Vec<Vec<f64>> = (0..count).map(|k| level(&rows[start(k)..start(k + 1)])).collect();
        // Beside the next but one: the break itself may lie in the next.
        let mut pairs = (1..count).flat_map(|k| [(k - 1, k), (k.saturating_sub(2), k)]);
        pairs.find_map(|(a, b)| {
            let shift = shift(&levels[a], &levels[b])?;
            Some(Break { passage: (start(a + 1) + start(b)) / 2, shift, within: rows.len().div_ceil(count) })
        })
    })
}

/// How many times the same passes within a period, if it is more than once.
pub(crate) fn times_a_period(rows: &[Vec<f64>]) -> Option<usize> {
    // Odd and even passages: noise in the one is none in the other.
    let every_other = |k: usize| level(rows.iter().skip(k).step_by(2));
    let (a, b) = (every_other(0), every_other(1));
    let same = correlation(&a, &b, 0);
    let alike = |parts: &usize| (1..*parts).all(|k| correlation(&a, &b, k * a.len() / parts) > ALIKE * same);
    (2..=MOST_PARTS).rev().find(alike).filter(|_| same > SAME)
}

/// The mean envelope's logarithm, normalized to mean 0 and mean square 1.
fn level<'a>(rows: impl IntoIterator<Item = &'a Vec<f64>>) -> Vec<f64> {
    let mut level = fold::average(rows);
    level.iter_mut().for_each(|x| *x = libm::log(x.max(f64::MIN_POSITIVE)));
    let (middle, deviation) = (statistics::mean(&level), statistics::deviation(&level));
    level.iter_mut().for_each(|x| *x = if deviation > 0.0 { (*x - middle) / deviation } else { 0.0 });
    level
}

/// How far `b` is shifted against `a`, if it is.
fn shift(a: &[f64], b: &[f64]) -> Option<f64> {
    let n = a.len();
    let (lag, best) = (0..n).map(|lag| (lag, correlation(a, b, lag))).max_by(|x, y| x.1.total_cmp(&y.1))?;
    let share = if 2 * lag > n { lag as f64 / n as f64 - 1.0 } else { lag as f64 / n as f64 };
    (share.abs() > SHIFT && best > SAME && correlation(a, b, 0) < LEFT * best).then_some(share)
}

/// Correlation of `a` with `b` moved back by `lag` points, round and round.
fn correlation(a: &[f64], b: &[f64], lag: usize) -> f64 {
    a.iter().zip(b.iter().cycle().skip(lag)).map(|(x, y)| x * y).sum::<f64>() / a.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Random;

    /// Passages of an event and a second one, of which those from `from` on are shifted by `shift` points of 400.
    fn rows(count: usize, from: usize, shift: usize, noise: f64) -> Vec<Vec<f64>> {
        let mut random = Random::new(2);
        let event = |i: usize| libm::exp(-((i % 400) as f64 - 100.0) / 20.0) * f64::from(u8::from((i % 400) >= 100));
        let row = |k: usize| {
            let d = if k >= from { 400 - shift } else { 0 };
            (0..400).map(|i| 0.05 + event(i + d) + 0.7 * event(i + d + 350) + noise * random.uniform()).collect()
        };
        (0..count).map(row).collect()
    }

    #[test]
    fn a_break_is_found_wherever_it_is_and_nothing_else_is() {
        for (count, from) in [(140, 70), (140, 62), (140, 20), (140, 118), (20, 10), (16, 9)] {
            for shift in [25, 60, 200, 390] {
                let found = find_break(&rows(count, from, shift, 0.3));
                let expected = if shift > 200 { shift as f64 / 400.0 - 1.0 } else { shift as f64 / 400.0 };
                match found {
                    // Half of a passage is as much forwards as backwards. 390 is 10 points back, which alignment
                    // follows.
                    Some(found) if shift == 200 => assert!((found.shift.abs() - 0.5).abs() < 0.01),
                    Some(found) => {
                        assert!(shift < 390 && (found.shift - expected).abs() < 0.01, "{found:?}");
                        let near = found.passage.abs_diff(from);
                        assert!(near <= found.within, "{found:?} for {from} of {count}");
                    }
                    None => assert!(shift == 390, "{shift} points from {from} of {count}"),
                }
            }
            assert_eq!(find_break(&rows(count, count, 0, 0.3)), None);
        }
        assert_eq!(find_break(&rows(140, 70, 60, 30.0)), None);
        assert_eq!(find_break(&[]), None);
    }

    #[test]
    fn what_passes_twice_or_thrice_a_period_is_counted() {
        let faster = |parts: usize| -> Vec<Vec<f64>> {
            let rows = rows(120, 120, 0, 0.3);
            let row = |k: usize| (0..400).map(|i| rows[(parts * k + parts * i / 400) % 120][parts * i % 400]).collect();
            (0..120).map(row).collect()
        };
        assert_eq!([1, 2, 3].map(|parts| times_a_period(&faster(parts))), [None, Some(2), Some(3)]);
        assert_eq!(times_a_period(&rows(120, 120, 0, 30.0)), None);
        assert_eq!(times_a_period(&[]), None);
    }
}
