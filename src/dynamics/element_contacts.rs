//! Where an element stands to the two raceways: its gap to the inner one and its approach to the outer one.

use super::model::Model;
use super::raceway::SMOOTH;
use crate::contact::error::ContactError;
use crate::contact::near_defect::OuterApproach;
use crate::numerics::plane::{Vector, turned};

/// An element seen from the inner ring's centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct InnerGap {
    /// δ_i [m]
    pub(super) approach: f64,
    /// n = q/|q|, radial and tangential.
    pub(super) n: Vector,
    /// |q| [m]
    pub(super) distance: f64,
}

impl Model {
    /// Where an element at path `u` in direction `e_r` is seen from the inner ring, whose centre is `offset` before the
    /// outer ring's.
    #[inline]
    pub(super) fn inner_gap(&self, u: f64, offset: Vector, e_r: Vector) -> InnerGap {
        // |q| = √((ρ+p)² + t²), written so that δ_i loses no digits to the radii's 20 mm.
        let (p, t) = (offset.dot(&e_r), offset.dot(&turned(e_r)));
        let q_r = self.outer_centre_radius + u + p;
        let distance = (q_r * q_r + t * t).sqrt();
        let approach = -self.radial_clearance - u - p - t * t / (distance + q_r);
        InnerGap { approach, n: Vector::new(q_r / distance, t / distance), distance }
    }

    /// Approach of element `j` to the outer raceway in a cell of the defect; `None` on the smooth raceway.
    ///
    /// Inlined, so that what its caller does not use is not worked out.
    #[inline(always)]
    pub(super) fn near_defect(
        &self,
        j: usize,
        cell: u32,
        u: f64,
        cage_angle: f64,
        rho: f64,
    ) -> Option<Result<OuterApproach, ContactError>> {
        if cell == SMOOTH {
            return None;
        }
        let defect = self.outer.defect.as_ref()?;
        Some(defect.surface.approach(cell as usize, u, defect.angle(cage_angle + self.element_offset(j)), rho))
    }

    /// As [`Self::near_defect`], the smooth raceway included.
    pub(super) fn outer_approach(&self, j: usize, cell: u32, u: f64, cage_angle: f64, rho: f64) -> OuterApproach {
        match self.near_defect(j, cell, u, cage_angle, rho) {
            None => OuterApproach::smooth(u),
            Some(near) => near.unwrap_or_else(|_| OuterApproach::unsolved()),
        }
    }
}
