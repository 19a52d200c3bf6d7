//! A raceway as an element meets it: the contact on its smooth part, and a defect placed at an angle.
//!
//! Around a defect the surface is cut at knots into cells, inside each of which the approach is smooth. How an
//! element's angle, the knots and the cells belong together stands here and nowhere else. All angles are in radians
//! from the defect's centre, counter-clockwise, within half a turn.

use crate::contact::compliant::CompliantContact;
use crate::contact::near_defect::NearDefect;
use crate::numerics::wrap;
use std::f64::consts::TAU;

/// Cell of an element on the smooth raceway, away from the defect.
pub const SMOOTH: u32 = u32::MAX;

/// A raceway.
#[derive(Debug, Clone)]
pub struct Raceway {
    /// Contact on its smooth part, which may yield.
    pub contact: CompliantContact,
    /// Its defect, if it has one.
    pub defect: Option<Placed>,
}

/// The surface of a raceway around a defect, and where on the ring it is.
#[derive(Debug, Clone)]
pub struct Placed {
    /// The surface under the scene's contact law.
    pub surface: NearDefect,
    /// Angle of the defect's centre [rad], counter-clockwise from +x.
    pub centre: f64,
}

/// The next knot on an element's way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ahead {
    /// Angle to it [rad]; by rounding it may be a little below 0.
    pub angle: f64,
    /// The cell beyond it.
    pub beyond: u32,
}

impl Placed {
    /// Angle from the centre of an element at `element_angle` [rad] from +x.
    #[inline]
    pub fn angle(&self, element_angle: f64) -> f64 {
        wrap(element_angle - self.centre)
    }

    /// Ends of the cells, ascending.
    pub fn knots(&self) -> &[f64] {
        self.surface.knots()
    }

    /// Cell at an angle.
    pub fn cell_at(&self, angle: f64) -> u32 {
        let knots = self.knots();
        match knots.partition_point(|&k| k <= angle) {
            0 => SMOOTH,
            above if above == knots.len() => SMOOTH,
            above => (above - 1) as u32,
        }
    }

    /// Whether there is such a cell.
    pub fn has_cell(&self, cell: u32) -> bool {
        cell == SMOOTH || (cell as usize) + 1 < self.knots().len()
    }

    /// The knot that an element in `cell` at `angle` meets next, counter-clockwise if `forward`.
    pub fn ahead(&self, cell: u32, angle: f64, forward: bool) -> Ahead {
        let knots = self.knots();
        let last = knots.len() - 1;
        let (angle, beyond) = match (cell == SMOOTH, forward) {
            (true, true) => (around(knots[0] - angle), 0),
            (true, false) => (around(angle - knots[last]), last as u32 - 1),
            (false, true) => {
                let next = cell + 1;
                (knots[next as usize] - angle, if next as usize == last { SMOOTH } else { next })
            }
            (false, false) => (angle - knots[cell as usize], if cell == 0 { SMOOTH } else { cell - 1 }),
        };
        Ahead { angle, beyond }
    }
}

/// An angle [rad] brought into [0, 2π); one that falls short of 0 by rounding is 0.
fn around(angle: f64) -> f64 {
    let within = angle.rem_euclid(TAU);
    if within > TAU - 1e-9 { 0.0 } else { within }
}
