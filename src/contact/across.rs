//! A surface that varies across the groove, as balls at a contact angle meet it: beside the groove's bottom, at the
//! place η, its arc from there, which grows with z.
//!
//! The equivalent approach has a third variable then, Δ(u, s, η). Its energy W stays one function of place, so that its
//! gradient conserves energy: one more force acts on the ball, −∂W/∂η per metre of the groove's arc.
//! ```text
//! η̇ = ±(r_g/d) t·v     F = ∓(r_g/d) ∂W/∂η t          upper sign inside; d, t: `groove`
//! ```
//! r_g/d is some 26: the contact runs so many times as far as the ball's centre.
//!
//! Law `map` looks Δ up at slices, places beside each other for each of which there is a map, and lays cubics through
//! them whose slopes at a slice are those of the line through its neighbours. Δ is C¹ in all of its variables, so that
//! nothing is lost whatever the slices' distance. At the first and the last slice the slope is 0, and beyond them Δ is
//! what it is there: no force acts across. Of a single slice that is so everywhere.

use std::sync::Arc;

use super::error::ContactError;
use super::map::ContactMap;
use crate::numerics::number::Scalar;

/// Δ (m) with its derivatives by path, arc and place across.
pub(super) type ByPlace<T> = [T; 4];

/// Step (m) of the differences that stand for third derivatives of an approach.
pub(super) const STEP: f64 = 1e-9;

/// Maps of one surface at places across the groove that are equally far apart.
#[derive(Debug, Clone)]
pub struct Slices {
    maps: Vec<Arc<ContactMap>>,
    /// First and last place (m), and how many of their distances make a metre.
    ends: [f64; 2],
    per_metre: f64,
}

impl Slices {
    /// Of maps from the first place on, this `distance` (m) apart; there is one at least. `ends` are the first and the
    /// last place (m), or those between which the one map holds.
    pub fn new(maps: Vec<Arc<ContactMap>>, ends: [f64; 2], distance: f64) -> Self {
        Self { maps, ends, per_metre: 1.0 / distance }
    }

    /// First and last place (m) for which it is made.
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Δ in one of the maps' cells; `curved` as in [`NearDefect::approach`](super::near_defect::NearDefect::approach).
    pub(super) fn approach<T: Scalar>(
        &self,
        cell: usize,
        [u, s, across]: [T; 3],
        curved: bool,
    ) -> Result<ByPlace<T>, ContactError> {
        let last = self.maps.len() - 1;
        let along = (across - T::Plain::from(self.ends[0])) * T::Plain::from(self.per_metre);
        let along = if along.value() <= 0.0 {
            T::from(0.0)
        } else if along.value() >= last as f64 {
            T::from(last as f64)
        } else {
            along
        };
        let from = (along.value() as usize).min(last.saturating_sub(1));
        let q = along - T::from(from as f64);
        let mut sum = [T::from(0.0); 4];
        for (k, weight, slope) in weights(q, from, last) {
            let found = of_map(&self.maps[k], cell, [u, s], curved)?;
            (0..3).for_each(|i| sum[i] += weight * found[i]);
            sum[3] += slope * T::Plain::from(self.per_metre) * found[0];
        }
        Ok(sum)
    }
}

/// Δ, Δ_u and Δ_s of one map.
#[inline(always)]
pub(super) fn of_map<T: Scalar>(
    map: &ContactMap,
    cell: usize,
    at: [T; 2],
    curved: bool,
) -> Result<[T; 3], ContactError> {
    let found = map.lookup_in(cell, at[0].value(), at[1].value())?;
    let second = &mut |[u, s]: [f64; 2]| match curved {
        true => map.second_derivatives_in(cell, u, s).map(|of| of.rows()),
        false => Ok([found.duu, found.dus, 0.0]),
    };
    T::surface(at, [found.value, found.du, found.ds], STEP, second)
}

/// Slices by which Δ is made up at q between the slices `from` and `from` + 1 of those up to `last`, with the weight of
/// each and its slope by q.
fn weights<T: Scalar>(q: T, from: usize, last: usize) -> impl Iterator<Item = (usize, T, T)> {
    let [zero, one, half] = [0.0, 1.0, 0.5].map(T::from);
    let [two, three, six] = [2.0, 3.0, 6.0].map(T::from);
    // Cubics of Hermite for value and slope at 0 and at 1, with their own slopes.
    let r = one - q;
    let value = [(r * r * (one + two * q), -(six * q * r)), (q * q * (three - two * q), six * q * r)];
    let slope = [(q * r * r, r * (one - three * q)), (-(q * q * r), q * (three * q - two))];
    // Half the difference of a slice's neighbours is its slope; the first and the last have none.
    let mut made = [(zero, zero); 4];
    let mut add = |slice: usize, (weight, by_q): (T, T), part: T| {
        let (sum, sum_by_q) = made[slice];
        made[slice] = (sum + weight * part, sum_by_q + by_q * part);
    };
    add(1, value[0], one);
    if last > 0 {
        add(2, value[1], one);
    }
    if from > 0 {
        add(0, slope[0], -half);
        add(2, slope[0], half);
    }
    if from + 1 < last {
        add(1, slope[1], -half);
        add(3, slope[1], half);
    }
    made.into_iter().enumerate().filter_map(move |(k, (weight, by_q))| {
        let slice = (from + k).checked_sub(1).filter(|&slice| slice <= last)?;
        Some((slice, weight, by_q))
    })
}

/// A function of three numbers and its derivatives by them, of which the values are `first`. `second` gives its second
/// derivatives anywhere near; third derivatives are central differences of these.
///
/// # Errors
/// Those of `second`.
pub(super) fn of_three<T: Scalar>(
    at: [T; 3],
    first: ByPlace<f64>,
    second: &mut impl FnMut([f64; 3]) -> Result<[[f64; 3]; 3], ContactError>,
) -> Result<ByPlace<T>, ContactError> {
    let mut found = first.map(T::from);
    if T::DEPTH == 0 {
        return Ok(found);
    }
    // What is left of a number without its value vanishes in a power above the depth of its derivatives: Taylor's
    // series ends.
    let values = at.map(T::value);
    let change = [0, 1, 2].map(|i: usize| at[i] - T::from(values[i]));
    let here = second(values)?;
    for i in 0..3 {
        found[0] += change[i] * T::from(first[1 + i]);
        for j in 0..3 {
            found[0] += change[i] * change[j] * T::from(0.5 * here[i][j]);
            found[1 + i] += change[j] * T::from(here[i][j]);
        }
    }
    for k in (0..3).filter(|_| T::DEPTH > 1) {
        let mut moved = |by: f64| {
            let mut at = values;
            at[k] += by;
            second(at)
        };
        let (after, before) = (moved(STEP)?, moved(-STEP)?);
        for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
            let third = (after[i][j] - before[i][j]) / (2.0 * STEP);
            found[1 + i] += change[j] * change[k] * T::from(0.5 * third);
        }
    }
    Ok(found)
}
