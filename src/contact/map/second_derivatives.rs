//! Second derivatives of law `map`: those of the cubics that a lookup reads, exactly.

use super::lookup::{ContactMap, Patch, Place, Stretch, along_path, slope_at, value_at};
use crate::contact::equivalent::SecondDerivatives;
use crate::contact::error::ContactError;

impl ContactMap {
    /// Second derivatives where [`ContactMap::lookup_in`] has value and slopes: theirs, exactly. Δ is C¹ only: they
    /// step from one cell to the next, and at the lowest and highest nodes, beyond which ∂²Δ/∂u² is 0.
    ///
    /// # Errors
    /// As [`ContactMap::lookup`].
    pub fn second_derivatives_in(&self, stretch: usize, u: f64, s: f64) -> Result<SecondDerivatives, ContactError> {
        let by_path = self.lookup_in(stretch, u, s)?.du;
        match self.stretches.get(stretch) {
            Some(Stretch::Patch(patch)) => patch.second_derivatives(u, s, by_path).ok_or_else(|| self.out_of_range(u)),
            _ => Ok(SecondDerivatives::default()),
        }
    }
}

impl Patch {
    /// Second derivatives where ∂Δ/∂u = f_u is `by_path`.
    fn second_derivatives(&self, u: f64, s: f64, by_path: f64) -> Option<SecondDerivatives> {
        let Place { leaf, q, t, per_arc, per_path, beyond, slope, second } = self.place(u, s)?;
        let [value, by_t, by_tt] = along_path(leaf, t);
        let f_us = slope_at(&by_t, q) * per_path * per_arc;
        let mut f_ss = second_at(&value, q) * per_arc * per_arc;
        let mut f_uu = value_at(&by_tt, q) * per_path * per_path;
        if beyond != 0.0 {
            // f = f(nodes) + f_u(nodes) × distance from them.
            f_ss += second_at(&by_t, q) * per_path * per_arc * per_arc * (beyond * self.size[1]);
            f_uu = 0.0;
        }
        // Δ(u, s) = f(u − T(s), s)
        Some(SecondDerivatives {
            uu: f_uu,
            us: f_us - f_uu * slope,
            ss: f_ss - 2.0 * f_us * slope + f_uu * slope * slope - by_path * second,
        })
    }
}

/// Second derivative of a cubic at q.
fn second_at(p: &[f64; 4], q: f64) -> f64 {
    2.0 * p[2] + 6.0 * q * p[3]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::contact::map::lookup::{Accuracy, Cell, Cubic, Strip};

    /// Side lengths of a coarse cell and arc of the first (m).
    const SIZE: [f64; 2] = [80e-6, 2e-6];
    const START: f64 = -3e-3;

    /// Two strips two cells high: whole ones, one cut in four, and one of which a quarter is cut once more. Neither
    /// cells nor references continue each other, which shows which of them is read.
    fn patch() -> ContactMap {
        let mut seed = 5u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / (1u64 << 30) as f64 - 1.0
        };
        let strips = [0, 2].map(|first| {
            let reference = std::array::from_fn(|_| 3e-6 * random());
            Strip { reference, first, rows: 2.0 }
        });
        let leaves: Vec<Cubic> =
            (0..9).map(|_| std::array::from_fn(|_| std::array::from_fn(|_| 1e-6 * random()))).collect();
        let leaf = Cell::Leaf;
        let coarse = [leaf(0), Cell::Divided([4, 5, 6, 7]), Cell::Divided([5, 8, 6, 7]), leaf(1)];
        let cut = [leaf(2), leaf(3), leaf(4), leaf(5), Cell::Divided([4, 5, 6, 7])];
        let cells = coarse.into_iter().chain(cut).collect();
        ContactMap {
            knots: vec![START, START + 2.0 * SIZE[0], 0.0],
            stretches: vec![
                Stretch::Patch(Patch::new(START, SIZE, 0.5, strips.to_vec(), cells, leaves)),
                Stretch::Flat(100e-6),
            ],
            nodes: 0,
            largest_approach: 1.0,
            accuracy: Accuracy::default(),
            fingerprint: 0,
        }
    }

    /// Central difference, extrapolated from steps of h and h/2.
    fn difference(h: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        let mut over = |h: f64| (f(h) - f(-h)) / (2.0 * h);
        (4.0 * over(0.5 * h) - over(h)) / 3.0
    }

    #[test]
    fn second_derivatives_are_those_of_the_slopes_in_every_kind_of_cell() {
        let map = patch();
        // Arc in coarse cells from the start and height in them above the lowest nodes: in whole cells, beyond both
        // ends, below and above the nodes, in quarters, in sixteenths, and below and above of these.
        let whole = [[0.3, 0.6], [1.7, 1.2], [-0.01, 0.4], [2.01, 1.3], [0.3, -0.8], [0.6, -0.2], [1.4, 2.7]];
        let parts = [[0.2, 1.3], [0.8, 1.4], [0.3, 1.9], [0.7, 1.6], [0.2, 2.3], [0.8, 3.1], [1.2, 0.3], [1.6, 0.1]];
        let quarters = [[1.9, 0.1], [1.6, 0.4], [1.9, 0.4], [1.6, -0.3], [1.9, -1.2], [1.2, 0.8], [1.1, -0.6]];
        for [along, height] in whole.into_iter().chain(parts).chain(quarters) {
            let s = START + along * SIZE[0];
            let Some(Stretch::Patch(patch)) = map.stretches.first() else { unreachable!() };
            let q = along - along.floor().clamp(0.0, 1.0);
            let [c0, c1, c2, c3] = patch.strips[along.floor().clamp(0.0, 1.0) as usize].reference;
            let u = c0 + q * (c1 + q * (c2 + q * c3)) + (height + 0.5) * SIZE[1];
            let found = map.second_derivatives_in(0, u, s).unwrap();
            let at = |u: f64, s: f64| map.lookup_in(0, u, s).unwrap();
            // Up to 0.003 of the smallest cells, in which slopes are polynomials.
            let [by_u, by_s] = [1e-3 * SIZE[1], 1e-3 * SIZE[0]];
            let [uu, su] = [difference(by_u, |h| at(u + h, s).du), difference(by_u, |h| at(u + h, s).ds)];
            let [us, ss] = [difference(by_s, |h| at(u, s + h).du), difference(by_s, |h| at(u, s + h).ds)];
            // Slopes of up to 10, rounded, over the steps; per metre of path and of arc.
            let (per_path, per_arc) = (1e-14 / by_u, 1e-14 / by_s);
            for (found, expected, rounding) in
                [(found.uu, uu, per_path), (found.us, su, per_path), (found.us, us, per_arc), (found.ss, ss, per_arc)]
            {
                let limit = 10.0 * rounding + 1e-9 * found.abs();
                assert!((found - expected).abs() < limit, "at {along} {height}: {found:e} {expected:e} {limit:e}");
            }
            assert!(found.ss.abs() > 1.0 && found.us.abs() > 1.0, "{found:?}");
            assert_eq!(found.uu == 0.0, !(0.0..=2.0).contains(&height), "{height}: {found:?}");
        }
    }

    #[test]
    fn flat_stretches_have_no_second_derivatives_and_what_a_lookup_refuses_is_refused() {
        let map = patch();
        assert_eq!(map.second_derivatives_in(1, 105e-6, -1e-3), Ok(SecondDerivatives::default()));
        assert_eq!(map.second_derivatives_in(usize::MAX, 5e-6, -4e-3), Ok(SecondDerivatives::default()));
        // Below all that the patch holds: every place is beyond it.
        let map = ContactMap { largest_approach: -1.0, ..map };
        let (refused, lookup) = (map.second_derivatives_in(0, 0.0, START), map.lookup_in(0, 0.0, START));
        assert!(matches!(refused, Err(ContactError::OutOfRange { .. })), "{refused:?}");
        assert_eq!(refused.err(), lookup.err());
    }
}
