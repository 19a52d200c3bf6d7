//! Stiffness over the cage angle: what varies while one element takes the place of the next.
//!
//! All repeats with the element spacing. Between the cage angles at which an element begins or ceases to carry, the
//! stiffness is smooth; there it jumps or has a sharp dip, as a Hertz contact begins without stiffness. A [`sweep`]
//! therefore adds the two sides of each such change to its evenly spaced angles, so that least and greatest are exact.

use super::static_bearing::{Balance, StaticBearing};
use super::study::StaticError;

/// Width of the bracket in which a change is found (rad).
const NARROW: f64 = 1e-7;

/// The balances over one period, the element spacing or a turn of an irregular cage, from the cage angle `first` (rad)
/// on, under the bearing's own load: at `count` evenly spaced angles, at the end, and at both sides of each angle
/// between them at which an element begins or ceases to carry. Angles ascend.
///
/// Of several changes between two evenly spaced angles those are found that do not undo each other.
/// ```
/// use brinell::scene::{Bearing, Scene};
/// use brinell_analysis::statics::StaticBearing;
/// use brinell_analysis::statics::{min_mean_max, sweep};
///
/// let scene = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3)).shaft_load([0.0, -1500.0]).build()?;
/// let balances = sweep(&StaticBearing::new(&scene, None)?, 0.0, 16)?;
/// let [least, mean, greatest] = min_mean_max(&balances, |balance| balance.stiffness[1][1]);
/// assert!(least <= mean && mean <= greatest && greatest < 1.1 * least);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`StaticBearing::balance`].
pub fn sweep(bearing: &StaticBearing, first: f64, count: usize) -> Result<Vec<Balance>, StaticError> {
    let at = |angle: f64| bearing.balance(angle, bearing.load());
    with_changes(&evenly_spaced(first, bearing.period(), count), NARROW, at, same_loaded)
}

/// `count` evenly spaced cage angles from `first` (rad) on over a period, one at least, and its end.
pub(crate) fn evenly_spaced(first: f64, period: f64, count: usize) -> Vec<f64> {
    let count = count.max(1);
    (0..=count).map(|i| first + i as f64 * (period / count as f64)).collect()
}

/// What `at` gives at ascending angles (rad), and at both sides of each angle between them at which it ceases to be the
/// same kind, no more than `narrow` (rad) apart.
pub(crate) fn with_changes<T: Clone, E>(
    angles: &[f64],
    narrow: f64,
    at: impl Fn(f64) -> Result<T, E>,
    same: impl Fn(&T, &T) -> bool,
) -> Result<Vec<T>, E> {
    let mut found: Vec<T> = Vec::with_capacity(angles.len());
    for (i, &angle) in angles.iter().enumerate() {
        let next = at(angle)?;
        let mut from = if i > 0 { angles[i - 1] } else { angle };
        // Several changes between two angles are found one after the other, except for those that undo each other.
        while let Some(last) = found.last()
            && !same(last, &next)
            && angle - from > narrow
        {
            let (mut before, mut after) = (last.clone(), next.clone());
            let (mut low, mut high) = (from, angle);
            while high - low > narrow {
                let middle = 0.5 * (low + high);
                let between = at(middle)?;
                if same(&before, &between) {
                    (low, before) = (middle, between)
                } else {
                    (high, after) = (middle, between)
                }
            }
            found.extend([before, after]);
            from = high;
        }
        found.push(next);
    }
    Ok(found)
}

/// Least, mean over the angle, and greatest of a quantity over a sweep.
pub fn min_mean_max(sweep: &[Balance], quantity: impl Fn(&Balance) -> f64) -> [f64; 3] {
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut area, mut width) = (0.0, 0.0);
    for (i, balance) in sweep.iter().enumerate() {
        let value = quantity(balance);
        (least, greatest) = (least.min(value), greatest.max(value));
        if let Some(next) = sweep.get(i + 1) {
            let step = next.cage_angle - balance.cage_angle;
            area += 0.5 * step * (value + quantity(next));
            width += step;
        }
    }
    [least, area / width, greatest]
}

fn same_loaded(a: &Balance, b: &Balance) -> bool {
    a.elements.iter().zip(&b.elements).all(|(a, b)| (a.inner_force > 0.0) == (b.inner_force > 0.0))
}
