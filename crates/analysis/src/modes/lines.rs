//! Modes over the cage angle, each followed from one angle to the next.
//!
//! A mode is taken to be the one most like it in motion, and close in frequency, at the angle before. Between angles at
//! which one is not close to any, others are added: an element that begins to be pressed is several times as fast a
//! tenth of a degree on, and with it the rings' modes may pass through a peak. Where two frequencies cross closely the
//! motions exchange, and a line goes straight on or turns off.

use super::assembly::Assembly;
use super::eigenmodes::{Mode, Modes, ModesError};
use crate::statics::with_changes;
use std::collections::{BTreeMap, BTreeSet};

/// Similarity times closeness below which two modes are not the same.
const SAME: f64 = 0.1;
/// The same below which a mode is not close to any at the angle before, and angles are added between the two.
const CLOSE: f64 = 0.95;
/// How often the angles beside those of a line's least and greatest values are cut in two.
const CUTS: usize = 2;
/// Width of the bracket in which an element begins or ceases to be pressed or to rest (rad): the stiffness of a contact
/// begins as the root of the approach, and is felt at once beside that of an element that only rested.
const NARROW: f64 = 1e-10;
/// Angles are added until they are this share of the period apart: there two frequencies cross.
const FINEST: f64 = 5e-5;

/// The modes over one element spacing from the cage angle `first` (rad) on: at `count` evenly spaced angles, at the
/// end, at both sides of each angle between them at which an element begins or ceases to be pressed or to rest, where a
/// contact crosses an edge of a ring's defect, and wherever modes change much from one angle to the next; more beside
/// the least and greatest values of each line. Angles ascend. Modes with a natural frequency have the number of their
/// line, by ascending mean frequency over the angle.
///
/// ```
/// use brinell::scene::{Bearing, Scene};
/// use brinell_analysis::modes::Assembly;
/// use brinell_analysis::modes::sweep;
///
/// let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
/// let scene = Scene::builder(bearing).shaft_load([0.0, -1500.0]).build()?;
/// let angles = sweep(&Assembly::new(&scene, None, None)?, 0.0, 8)?;
/// let frequencies = angles[0].modes.iter().filter_map(|mode| mode.undamped_frequency());
/// // Loaded balls vibrate between their raceways at tens of kilohertz.
/// assert!(frequencies.fold(0.0, f64::max) > 2e4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`Assembly::modes`].
pub fn sweep(assembly: &Assembly, first: f64, count: usize) -> Result<Vec<Modes>, ModesError> {
    let at = |angle: f64| assembly.modes(angle);
    let finest = FINEST * assembly.period();
    let mut found = Vec::new();
    let angles = assembly.telling_angles(first, count);
    for next in with_changes(&angles, NARROW, at, |a, b| a.carried == b.carried)? {
        fill(&mut found, &next, finest, &at)?;
        found.push(next);
    }
    follow_all(&mut found);
    for _ in 0..CUTS {
        for i in beside_extremes(&found, finest).into_iter().rev() {
            let between = at(0.5 * (found[i].cage_angle + found[i + 1].cage_angle))?;
            found.insert(i + 1, between);
        }
        follow_all(&mut found);
    }
    Ok(found)
}

/// Adds modes at angles before those at `next`, as long as these are not close to the last ones, and until angles are
/// `finest` (rad) apart.
fn fill(
    found: &mut Vec<Modes>,
    next: &Modes,
    finest: f64,
    at: &impl Fn(f64) -> Result<Modes, ModesError>,
) -> Result<(), ModesError> {
    let Some(last) = found.last() else { return Ok(()) };
    if last.carried != next.carried || next.cage_angle - last.cage_angle < finest || are_close(last, next) {
        return Ok(());
    }
    let between = at(0.5 * (last.cage_angle + next.cage_angle))?;
    fill(found, &between, finest, at)?;
    found.push(between);
    fill(found, next, finest, at)
}

/// Whether each mode with a frequency is close to one before.
fn are_close(before: &Modes, here: &Modes) -> bool {
    let known = |new: &&Mode| new.undamped_frequency().is_some();
    here.modes.iter().filter(known).all(|new| before.modes.iter().any(|old| nearness(old, new) > CLOSE))
}

/// Gives all modes with a natural frequency the numbers of their lines.
fn follow_all(found: &mut [Modes]) {
    found.iter_mut().flat_map(|modes| &mut modes.modes).for_each(|mode| mode.line = None);
    let mut lines = 0;
    for i in 0..found.len() {
        let (before, here) = found.split_at_mut(i);
        follow(before.last(), &mut here[0], &mut lines);
    }
    sort(found, lines);
}

/// Indices of the intervals, each by the angle at which it begins, in which a line's frequency or damping ratio may go
/// beyond its extremes at the angles: those on either side of an extreme that are wider than `finest` (rad) and at both
/// ends of which the same contacts carry.
fn beside_extremes(found: &[Modes], finest: f64) -> BTreeSet<usize> {
    let mut extremes: BTreeMap<(usize, usize), (f64, usize)> = BTreeMap::new();
    for (i, modes) in found.iter().enumerate() {
        for mode in &modes.modes {
            let (Some(line), Some(frequency), Some(ratio)) =
                (mode.line, mode.undamped_frequency(), mode.damping_ratio())
            else {
                continue;
            };
            for (which, value) in [frequency, -frequency, ratio, -ratio].into_iter().enumerate() {
                let most = extremes.entry((line, which)).or_insert((value, i));
                if value > most.0 {
                    *most = (value, i);
                }
            }
        }
    }
    let beside = extremes.into_values().flat_map(|(_, i)| [i.wrapping_sub(1), i]);
    let can_be_cut = |&i: &usize| {
        let Some([here, next]) = found.get(i..i.saturating_add(2)) else { return false };
        here.carried == next.carried && next.cage_angle - here.cage_angle > finest
    };
    beside.filter(can_be_cut).collect()
}

/// The part of the period that each angle stands for (rad): half the way to its neighbours.
pub(crate) fn spans(found: &[Modes]) -> Vec<f64> {
    let angle = |i: usize| found[i].cage_angle;
    let last = found.len().saturating_sub(1);
    (0..found.len()).map(|i| 0.5 * (angle((i + 1).min(last)) - angle(i.saturating_sub(1)))).collect()
}

/// Gives the modes at an angle the lines of those before, and new lines to the rest.
fn follow(before: Option<&Modes>, here: &mut Modes, lines: &mut usize) {
    // How near, and the numbers before and here, of two modes that may be one.
    let mut candidates: Vec<(f64, usize, usize)> = Vec::new();
    for (i, old) in before.iter().flat_map(|modes| modes.modes.iter().enumerate()) {
        for (k, new) in here.modes.iter().enumerate() {
            let nearness = nearness(old, new);
            if nearness > SAME {
                candidates.push((nearness, i, k));
            }
        }
    }
    candidates.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut taken = Vec::new();
    for (_, old, new) in candidates {
        let line = before.and_then(|modes| modes.modes[old].line);
        if here.modes[new].line.is_none() && !taken.contains(&old) {
            here.modes[new].line = line;
            taken.push(old);
        }
    }
    for mode in here.modes.iter_mut().filter(|mode| mode.line.is_none() && mode.undamped_frequency().is_some()) {
        mode.line = Some(*lines);
        *lines += 1;
    }
}

/// Similarity of motion, times how close the frequencies are; 0 of modes that have none.
fn nearness(a: &Mode, b: &Mode) -> f64 {
    let (Some(f), Some(g)) = (a.undamped_frequency(), b.undamped_frequency()) else { return 0.0 };
    a.similarity(b) * (f / g).min(g / f)
}

/// Numbers the lines by their frequency's mean over the angle.
fn sort(found: &mut [Modes], lines: usize) {
    let mut sums = vec![[0.0; 2]; lines];
    for (modes, span) in found.iter().zip(spans(found)) {
        for mode in &modes.modes {
            if let (Some(line), Some(frequency)) = (mode.line, mode.undamped_frequency()) {
                sums[line] = [sums[line][0] + span * frequency, sums[line][1] + span];
            }
        }
    }
    let mut means: Vec<(f64, usize)> = sums.iter().map(|[sum, span]| sum / span).zip(0..).collect();
    means.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut number = vec![0; lines];
    for (new, (_, old)) in means.into_iter().enumerate() {
        number[old] = new;
    }
    for mode in found.iter_mut().flat_map(|modes| &mut modes.modes) {
        mode.line = mode.line.map(|line| number[line]);
    }
}
