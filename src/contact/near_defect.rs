//! The outer contact of an element near the defect, whatever the contact law.
//!
//! Each law gives an *equivalent approach* Δ(u, ψ): the force law of the smooth contact applied to Δ gives the normal
//! force, and a direction says how it acts on the element. On the smooth raceway Δ = u and the direction is radial.
//! The raceway around the defect is cut at knots into cells inside which Δ is smooth.

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
}

/// The raceway near the defect under one contact law.
#[derive(Debug, Clone)]
pub enum NearDefect {
    /// The earlier model: a rigid element's path.
    Hertz(RigidPath),
}

impl NearDefect {
    /// Ascending angles [rad] from the defect's centre at which the approach is not smooth. Cell `i` lies between knots
    /// `i` and `i + 1`; outside the first and last the raceway is smooth.
    pub fn knots(&self) -> &[f64] {
        match self {
            Self::Hertz(path) => path.knots(),
        }
    }

    /// Approach in `cell` for radial path `u` [m] at `angle` [rad] from the defect's centre, which may lie slightly
    /// beyond the cell's ends; `rho` [m] is the distance of the element's centre from the outer ring's.
    #[inline]
    pub fn approach(&self, cell: usize, u: f64, angle: f64, rho: f64) -> OuterApproach {
        match self {
            Self::Hertz(path) => {
                let point = path.at(cell, angle);
                let tan = point.slope / rho;
                let radial = 1.0 / (1.0 + tan * tan).sqrt();
                let tangential = tan * radial;
                OuterApproach {
                    value: u - point.path,
                    by_path: 1.0,
                    by_angle: -point.slope,
                    radial,
                    tangential,
                    // κ = atan(P′/ρ): ∂κ/∂u = −sin κ cos κ/ρ
                    radial_by_path: tangential * tangential * radial / rho,
                    tangential_by_path: -tangential * radial * radial / rho,
                }
            }
        }
    }
}
