//! The outer contact of an element near the defect, whatever the contact law.
//!
//! Each law gives an *equivalent approach* Δ(u, ψ): the force law of the smooth contact applied to Δ gives the normal
//! force, and a direction says how it acts on the element. On the smooth raceway Δ = u and the direction is radial.
//! The raceway around the defect is cut at knots into cells inside which Δ is smooth.

use std::cell::RefCell;
use std::sync::Arc;

use super::equivalent::EquivalentApproach;
use super::error::ContactError;
use super::love::LoveContact;
use super::map::ContactMap;
use super::rigid_path::RigidPath;

/// Equivalent approach of one element to the outer raceway, and the direction of the contact force on the element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OuterApproach {
    /// Δ [m]; negative when there is a gap.
    pub value: f64,
    /// ∂Δ/∂u
    pub by_path: f64,
    /// ∂Δ/∂ψ [m/rad]
    pub by_angle: f64,
    /// Radial part of the direction, inwards.
    pub radial: f64,
    /// Tangential part of the direction, counter-clockwise.
    pub tangential: f64,
    /// ∂(radial)/∂u [1/m]
    pub radial_by_path: f64,
    /// ∂(tangential)/∂u [1/m]
    pub tangential_by_path: f64,
}

impl OuterApproach {
    /// That of the smooth raceway at radial path `u` [m].
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

    /// No number at all: an integration that meets it takes the step back.
    pub fn unsolved() -> Self {
        Self { value: f64::NAN, radial: f64::NAN, tangential: f64::NAN, ..Self::smooth(f64::NAN) }
    }

    /// From a potential's Δ(u, s): forces are its gradient. Per turning angle s = R_o ψ, and the tangential force acts
    /// at ρ.
    fn of(approach: &EquivalentApproach, raceway_radius: f64, rho: f64) -> Self {
        let lever = raceway_radius / rho;
        Self {
            value: approach.value,
            by_path: approach.du,
            by_angle: approach.ds * raceway_radius,
            radial: approach.du,
            tangential: -approach.ds * lever,
            radial_by_path: approach.duu,
            tangential_by_path: lever * (approach.ds / rho - approach.dus),
        }
    }
}

/// The raceway near the defect under one contact law.
#[derive(Debug, Clone)]
pub enum NearDefect {
    /// The earlier model: a rigid element's path.
    Hertz(RigidPath),
    /// Love's half-space, looked up.
    Map(NearMap),
    /// Love's half-space, solved.
    Love(Box<NearLove>),
}

/// A contact map on its raceway.
#[derive(Debug, Clone)]
pub struct NearMap {
    map: Arc<ContactMap>,
    raceway_radius: f64,
    knots: Vec<f64>,
}

impl NearMap {
    /// A map for a raceway of this radius [m].
    pub fn new(map: Arc<ContactMap>, raceway_radius: f64) -> Self {
        let knots = map.knots().iter().map(|arc| arc / raceway_radius).collect();
        Self { map, raceway_radius, knots }
    }
}

/// A grid on its raceway, solved where the raceway is neither smooth nor flat.
#[derive(Debug, Clone)]
pub struct NearLove {
    /// The last contact is where the solution of the next one starts, and nothing else.
    contact: RefCell<LoveContact>,
    raceway_radius: f64,
    knots: Vec<f64>,
    /// Depth of each cell that is flat.
    flats: Vec<Option<f64>>,
}

impl NearLove {
    /// A grid for a raceway of this radius [m]. Between the ascending arcs `knots` [m] the raceway is flat at a depth
    /// [m] or the grid is solved.
    pub fn new(contact: LoveContact, knots: &[f64], flats: Vec<Option<f64>>, raceway_radius: f64) -> Self {
        let knots = knots.iter().map(|arc| arc / raceway_radius).collect();
        Self { contact: RefCell::new(contact), raceway_radius, knots, flats }
    }

    fn solve(&self, cell: usize, u: f64, s: f64) -> Result<EquivalentApproach, ContactError> {
        match self.flats[cell] {
            Some(depth) => Ok(EquivalentApproach::flat(u, depth)),
            None => self.contact.borrow_mut().solve(u, s),
        }
    }
}

impl NearDefect {
    /// Ascending angles [rad] from the defect's centre at which the approach is not smooth. Cell `i` lies between knots
    /// `i` and `i + 1`; outside the first and last the raceway is smooth.
    pub fn knots(&self) -> &[f64] {
        match self {
            Self::Hertz(path) => path.knots(),
            Self::Map(near) => &near.knots,
            Self::Love(near) => &near.knots,
        }
    }

    /// Approach in `cell` for radial path `u` [m] at `angle` [rad] from the defect's centre, which may lie slightly
    /// beyond the cell's ends; `rho` [m] is the distance of the element's centre from the outer ring's.
    ///
    /// # Errors
    /// Where the law was not prepared for so large an approach, or the grid cannot be solved.
    #[inline(always)]
    pub fn approach(&self, cell: usize, u: f64, angle: f64, rho: f64) -> Result<OuterApproach, ContactError> {
        match self {
            Self::Map(near) => Ok(OuterApproach::of(
                &near.map.lookup_in(cell, u, angle * near.raceway_radius)?,
                near.raceway_radius,
                rho,
            )),
            Self::Love(near) => {
                Ok(OuterApproach::of(&near.solve(cell, u, angle * near.raceway_radius)?, near.raceway_radius, rho))
            }
            Self::Hertz(path) => {
                let point = path.at(cell, angle);
                let tan = point.slope / rho;
                let radial = 1.0 / (1.0 + tan * tan).sqrt();
                let tangential = tan * radial;
                Ok(OuterApproach {
                    value: u - point.path,
                    by_path: 1.0,
                    by_angle: -point.slope,
                    radial,
                    tangential,
                    // κ = atan(P′/ρ): ∂κ/∂u = −sin κ cos κ/ρ
                    radial_by_path: tangential * tangential * radial / rho,
                    tangential_by_path: -tangential * radial * radial / rho,
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
