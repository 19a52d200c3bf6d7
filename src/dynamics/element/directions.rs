//! Directions of elements, several of them at a time.

use crate::dynamics::parameters::{ElementBlock, Model};
use crate::numerics::lanes::{Lanes, WIDEST, Wide};
use crate::numerics::plane::Vector;

/// Offset of the rings' centres per distance of the elements' below which the series hold to rounding: their next terms
/// are 0.4 of its sixth power.
const SERIES: f64 = 2e-3;

impl Model {
    /// Whether the rings, this far apart, are so nearly concentric that their gaps are series in t/q_r
    /// ([`Shifted`](super::Shifted)).
    #[inline(always)]
    pub(in crate::dynamics) fn nearly_concentric(&self, offset: Vector) -> bool {
        let limit = SERIES * self.outer_centre_radius;
        offset.dot(&offset) <= limit * limit
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
