//! The contact of an element near a defect, whatever the contact law and whichever surface bears the defect.
//!
//! Each law gives an *equivalent approach* Δ(u, ψ): the force law of the smooth contact applied to Δ gives the normal
//! force, and a direction says how it acts on the element. On the smooth raceway Δ = u and the direction is radial.
//! Here u is the approach of the element to the smooth raceway, on which side ever, and ψ the direction in which the
//! two bodies touch, seen in the frame of the one that bears the defect, from the defect's centre. The surface around
//! the defect is cut at knots into cells inside which Δ is smooth.

use std::cell::RefCell;
use std::sync::Arc;

use super::equivalent::EquivalentApproach;
use super::error::ContactError;
use crate::contact::love::LoveContact;
use crate::contact::map::{ContactMap, Unmapped};
use crate::contact::rolled_path::RigidPath;

/// Equivalent approach of one element to a raceway, and the direction of the contact force on the element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// Δ (m); negative when there is a gap.
    pub value: f64,
    /// ∂Δ/∂u
    pub by_path: f64,
    /// ∂Δ/∂ψ (m/rad)
    pub by_angle: f64,
    /// Part of the direction away from the raceway: inwards from the outer one, outwards from the inner one.
    pub radial: f64,
    /// Tangential part of the direction, counter-clockwise.
    pub tangential: f64,
    /// ∂(radial)/∂u (1/m)
    pub radial_by_path: f64,
    /// ∂(tangential)/∂u (1/m)
    pub tangential_by_path: f64,
}

impl Approach {
    /// That of the smooth raceway at approach `u` (m).
    pub fn smooth(u: f64) -> Self {
        Self {
            value: u,
            by_path: 1.0,
            by_angle: 0.0,
            radial: 1.0,
            tangential: 0.0,
            radial_by_path: 0.0,
            tangential_by_path: 0.0,
        }
    }

    /// NaN: an integration that meets it takes the step back.
    pub fn unsolved() -> Self {
        Self { value: f64::NAN, radial: f64::NAN, tangential: f64::NAN, ..Self::smooth(f64::NAN) }
    }

    /// From a potential's Δ(u, s): forces are its gradient. Per turning angle s = B ψ, B the radius of the body that
    /// bears the defect, and the tangential force acts at the lever.
    fn of(approach: &EquivalentApproach, bearer_radius: f64, lever: Lever) -> Self {
        let share = bearer_radius / lever.distance;
        Self {
            value: approach.value,
            by_path: approach.du,
            by_angle: approach.ds * bearer_radius,
            radial: approach.du,
            tangential: -approach.ds * share,
            radial_by_path: approach.duu,
            tangential_by_path: share * (lever.by_approach * approach.ds / lever.distance - approach.dus),
        }
    }
}

/// Distance of an element's centre from that of a ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lever {
    /// Distance (m).
    pub distance: f64,
    /// Its change with the approach: 1 outside, where it grows, and −1 inside.
    pub by_approach: f64,
}

/// A surface near its defect under one contact law.
#[derive(Debug, Clone)]
pub enum NearDefect {
    /// The earlier model: a rigid element's path.
    Hertz(RigidPath),
    /// Love's half-space, looked up.
    Map(NearMap),
    /// Love's half-space, solved.
    Love(Box<NearLove>),
}

/// A contact map on its surface.
#[derive(Debug, Clone)]
pub struct NearMap {
    map: Arc<ContactMap>,
    bearer_radius: f64,
    knots: Vec<f64>,
}

impl NearMap {
    /// A map for a defect on a body of this radius (m).
    pub fn new(map: Arc<ContactMap>, bearer_radius: f64) -> Self {
        let knots = map.knots().iter().map(|arc| arc / bearer_radius).collect();
        Self { map, bearer_radius, knots }
    }
}

/// A grid on its surface, solved where that is neither smooth nor flat.
#[derive(Debug, Clone)]
pub struct NearLove {
    /// The last contact is where the solution of the next one starts, and nothing else.
    contact: RefCell<LoveContact>,
    bearer_radius: f64,
    knots: Vec<f64>,
    /// Depth of each cell that is flat.
    flats: Vec<Option<f64>>,
}

impl NearLove {
    /// A grid for a defect on a body of this radius (m).
    pub fn new(Unmapped { contact, knots, flats }: Unmapped, bearer_radius: f64) -> Self {
        let knots = knots.into_iter().map(|arc| arc / bearer_radius).collect();
        Self { contact: RefCell::new(contact), bearer_radius, knots, flats }
    }

    fn solve(&self, cell: usize, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        match self.flats[cell] {
            Some(depth) => Ok(EquivalentApproach::flat(u, depth)),
            None => self.contact.borrow_mut().solve(u, s),
        }
    }
}

impl NearDefect {
    /// Ascending angles (rad) from the defect's centre at which the approach is not smooth. Cell `i` lies between knots
    /// `i` and `i + 1`; outside the first and last the raceway is smooth.
    pub fn knots(&self) -> &[f64] {
        match self {
            Self::Hertz(path) => path.knots(),
            Self::Map(near) => &near.knots,
            Self::Love(near) => &near.knots,
        }
    }

    /// Approach in `cell` at the approach `u` (m) to the smooth raceway and at `angle` (rad) from the defect's centre,
    /// which may lie slightly beyond the cell's ends; `lever` is that of the element about the ring's centre.
    ///
    /// # Errors
    /// Where the law was not prepared for so large an approach, or the grid cannot be solved.
    #[inline(always)]
    pub fn approach(&self, cell: usize, u: f64, angle: f64, lever: Lever) -> Result<Approach, ContactError> {
        match self {
            Self::Map(near) => {
                let found = near.map.lookup_in(cell, u, angle * near.bearer_radius)?;
                Ok(Approach::of(&found, near.bearer_radius, lever))
            }
            Self::Love(near) => {
                Ok(Approach::of(&near.solve(cell, u, angle * near.bearer_radius)?, near.bearer_radius, lever))
            }
            Self::Hertz(path) => {
                let point = path.at(cell, angle);
                let tan = point.slope / lever.distance;
                let radial = 1.0 / (1.0 + tan * tan).sqrt();
                let tangential = tan * radial;
                Ok(Approach {
                    value: u - point.path,
                    by_path: 1.0,
                    by_angle: -point.slope,
                    radial,
                    tangential,
                    // κ = atan(P′/ρ): ∂κ/∂u = −sin κ cos κ/ρ outside, where ρ grows with u
                    radial_by_path: lever.by_approach * (tangential * tangential * radial / lever.distance),
                    tangential_by_path: lever.by_approach * (-tangential * radial * radial / lever.distance),
                })
            }
        }
    }

    /// Forgets what was solved before, so that the next answers do not depend on it even in their rounding.
    pub fn forget(&self) {
        if let Self::Love(near) = self {
            near.contact.borrow_mut().forget();
        }
    }

    /// Whether contacts are solved on a grid inside the step.
    pub fn solves_grids(&self) -> bool {
        matches!(self, Self::Love(_))
    }
}
