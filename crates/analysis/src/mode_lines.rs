//! Modes over the cage angle, each followed from one angle to the next.
//!
//! A mode is taken to be the one most like it in motion, and close in frequency, at the angle before. Where two
//! frequencies cross closely the motions exchange, and a line goes straight on or turns off, as fine as the angles are.

use super::assembly::Assembly;
use super::modes::{Mode, Modes, ModesError};
use super::stiffness::with_changes;

/// Similarity times closeness below which two modes are not the same.
const SAME: f64 = 0.1;

/// The modes over one element spacing from the cage angle `first` (rad) on: at `count` evenly spaced angles, at the
/// end, and at both sides of each angle between them at which an element begins or ceases to be pressed or to rest.
/// Angles ascend. Modes with a natural frequency have the number of their line, by ascending mean frequency.
///
/// ```
/// use brinell::scene::{Bearing, Scene};
/// use brinell_analysis::assembly::Assembly;
/// use brinell_analysis::mode_lines::sweep;
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
    let mut found = with_changes(first, assembly.period(), count, at, |a, b| a.holds == b.holds)?;
    let mut lines = 0;
    for i in 0..found.len() {
        let (before, here) = found.split_at_mut(i);
        follow(before.last(), &mut here[0], &mut lines);
    }
    sort(&mut found, lines);
    Ok(found)
}

/// Two modes at neighbouring angles that may be one.
struct Candidate {
    nearness: f64,
    /// Index at the angle before.
    old: usize,
    /// Index here.
    new: usize,
}

/// Gives the modes at an angle the lines of those before, and new lines to the rest.
fn follow(before: Option<&Modes>, here: &mut Modes, lines: &mut usize) {
    let mut candidates: Vec<Candidate> = Vec::new();
    for (i, old) in before.iter().flat_map(|modes| modes.modes.iter().enumerate()) {
        for (k, new) in here.modes.iter().enumerate() {
            let nearness = nearness(old, new);
            if nearness > SAME {
                candidates.push(Candidate { nearness, old: i, new: k });
            }
        }
    }
    candidates.sort_by(|a, b| b.nearness.total_cmp(&a.nearness));
    let mut taken = Vec::new();
    for Candidate { old, new, .. } in candidates {
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

/// Numbers the lines by their mean frequency.
fn sort(found: &mut [Modes], lines: usize) {
    let mut means: Vec<(f64, usize)> = (0..lines)
        .map(|line| {
            let modes = found.iter().flat_map(|modes| &modes.modes).filter(|mode| mode.line == Some(line));
            let frequencies: Vec<f64> = modes.filter_map(Mode::undamped_frequency).collect();
            (frequencies.iter().sum::<f64>() / frequencies.len() as f64, line)
        })
        .collect();
    means.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut number = vec![0; lines];
    for (new, (_, old)) in means.into_iter().enumerate() {
        number[old] = new;
    }
    for mode in found.iter_mut().flat_map(|modes| &mut modes.modes) {
        mode.line = mode.line.map(|line| number[line]);
    }
}
