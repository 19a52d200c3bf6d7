//! What differs from element to element, eight of them at a time.

use crate::numerics::lanes::{WIDEST, padded};
use crate::numerics::sin_cos;

/// What differs between elements, for eight of them; where there is none, all zeros.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(in crate::dynamics) struct ElementBlock {
    /// cos and sin of the element's angle ahead of the nominal cage.
    pub(in crate::dynamics) cos: [f64; WIDEST],
    pub(in crate::dynamics) sin: [f64; WIDEST],
    /// 1 where there is an element.
    pub(in crate::dynamics) present: [f64; WIDEST],
    /// 1/mass (1/kg).
    pub(in crate::dynamics) per_mass: [f64; WIDEST],
    /// Constant K of the inner contact (N/m^n), n = 3/2 of balls and 10/9 of rollers.
    pub(in crate::dynamics) inner: [f64; WIDEST],
    /// That of the outer contact on the smooth rigid raceway; 0 for an element that is not on it.
    pub(in crate::dynamics) outer: [f64; WIDEST],
    /// Acceleration of w by an outer contact that is not on it (m/s²).
    pub(in crate::dynamics) other: [f64; WIDEST],
    /// Angle of the element ahead of its position in an even cage (rad).
    pub(in crate::dynamics) lead: [f64; WIDEST],
    /// Angular speed of the element about the outer ring's centre by that of the nominal cage.
    pub(in crate::dynamics) pace: [f64; WIDEST],
    /// How that changes with the nominal cage's angle (1/rad).
    pub(in crate::dynamics) pace_by_angle: [f64; WIDEST],
}

/// All elements of a bearing at these angles (rad) ahead of the cage, of mass 1/`per_mass` (kg)
/// and with these constants of the inner and the outer contact (N/m^n).
pub(super) fn blocks(offsets: &[f64], per_mass: f64, [inner, outer]: [f64; 2]) -> Vec<ElementBlock> {
    let count = offsets.len();
    let mut blocks = vec![ElementBlock::default(); padded(count) / WIDEST];
    for (j, &offset) in offsets.iter().enumerate() {
        let (sin, cos) = sin_cos(offset);
        let (block, i) = (&mut blocks[j / WIDEST], j % WIDEST);
        (block.cos[i], block.sin[i], block.present[i], block.pace[i]) = (cos, sin, 1.0, 1.0);
        (block.per_mass[i], block.inner[i], block.outer[i]) = (per_mass, inner, outer);
    }
    blocks
}
