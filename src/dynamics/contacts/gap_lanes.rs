//! Where elements are as seen from the inner ring, several of them at a time.

use crate::dynamics::parameters::{ElementBlock, Model};
use crate::numerics::lanes::{Lanes, WIDEST, Wide};
use crate::numerics::plane::Vector;

/// Offset of the rings' centres per distance of the elements' below which the series hold to rounding: their next terms
/// are 0.4 of its sixth power.
const SERIES: f64 = 2e-3;

impl Model {
    /// Whether the rings, this far apart, are so nearly concentric that [`Distance`] is a series in t/q_r.
    #[inline(always)]
    pub(in crate::dynamics) fn nearly_concentric(&self, offset: Vector) -> bool {
        let limit = SERIES * self.outer_centre_radius;
        offset.dot(&offset) <= limit * limit
    }
}

/// Distance and direction of elements from the inner ring's centre: of the vector q.
#[derive(Clone, Copy)]
pub(in crate::dynamics) struct Distance<S: Wide> {
    /// |q| − q_r (m)
    pub(in crate::dynamics) longer: Lanes<S>,
    /// q/|q|, its radial and its tangential part.
    pub(in crate::dynamics) n: [Lanes<S>; 2],
}

impl<S: Wide> Distance<S> {
    /// Of elements with q_r (m) along e_r and t (m) across it: |q| = √(q_r² + t²), written so that δ_i loses no digits
    /// to the radii's 20 mm. `series`: |q| − q_r = t (t/q_r)/2 − … and the direction of q are series in t/q_r.
    #[inline(always)]
    pub(in crate::dynamics) fn of(simd: S, q_r: Lanes<S>, t: Lanes<S>, series: bool) -> Self {
        let number = |number: f64| Lanes::splat(simd, number);
        if series {
            let slope = t / q_r;
            let x = slope * slope;
            let n_r = number(1.0) - x * (number(0.5) - number(0.375) * x);
            let longer = t * slope * (number(0.5) - x * (number(0.125) - number(0.0625) * x));
            Self { longer, n: [n_r, slope * n_r] }
        } else {
            let square = t * t;
            let distance = (q_r * q_r + square).sqrt();
            let per_distance = number(1.0) / distance;
            Self { longer: square / (distance + q_r), n: [q_r * per_distance, t * per_distance] }
        }
    }
}

/// Direction e_r of elements from the outer ring's centre, the cage's being `cage`.
#[inline(always)]
pub(in crate::dynamics) fn radial<S: Wide>(
    simd: S,
    cage: Vector,
    block: &ElementBlock,
    of: impl Fn(&[f64; WIDEST]) -> Lanes<S>,
) -> [Lanes<S>; 2] {
    let (cos, sin) = (of(&block.cos), of(&block.sin));
    let (cage_cos, cage_sin) = (Lanes::splat(simd, cage.x), Lanes::splat(simd, cage.y));
    [cage_cos * cos - cage_sin * sin, cage_sin * cos + cage_cos * sin]
}

/// a·e with the same vector for all lanes.
#[inline(always)]
pub(in crate::dynamics) fn dot<S: Wide>(simd: S, a: Vector, e: [Lanes<S>; 2]) -> Lanes<S> {
    Lanes::splat(simd, a.x) * e[0] + Lanes::splat(simd, a.y) * e[1]
}
