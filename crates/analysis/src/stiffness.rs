//! Stiffness over the cage angle: what varies while one element takes the place of the next.
//!
//! All repeats with the element spacing. Between the cage angles at which an element begins or ceases to carry, the
//! stiffness is smooth; there it jumps or has a sharp dip, as a Hertz contact begins without stiffness. A [`sweep`]
//! therefore adds the two sides of each such change to its evenly spaced angles, so that least and greatest are exact.

use super::static_bearing::{Balance, StaticBearing, StaticError};

/// Half the width of the bracket in which a change is found [rad].
const NARROW: f64 = 1e-7;

/// The balances over one element spacing from the cage angle `first` [rad] on, under the bearing's own load: at `count`
/// evenly spaced angles, at the end, and at both sides of each angle between them at which an element begins or ceases
/// to carry. Angles ascend.
///
/// Of several changes between two evenly spaced angles at least one is found.
///
/// # Errors
/// Those of [`StaticBearing::balance`].
pub fn sweep(bearing: &StaticBearing, first: f64, count: usize) -> Result<Vec<Balance>, StaticError> {
    let count = count.max(1);
    let step = bearing.spacing() / count as f64;
    let at = |angle: f64| bearing.balance(angle, bearing.load());
    let mut balances = vec![at(first)?];
    for i in 1..=count {
        let next = at(first + i as f64 * step)?;
        let last = &balances[balances.len() - 1];
        if !same_loaded(last, &next) {
            let (mut before, mut after) = (last.clone(), next.clone());
            while after.cage_angle - before.cage_angle > NARROW {
                let middle = at(0.5 * (before.cage_angle + after.cage_angle))?;
                if same_loaded(&before, &middle) { before = middle } else { after = middle }
            }
            balances.extend([before, after]);
        }
        balances.push(next);
    }
    Ok(balances)
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
