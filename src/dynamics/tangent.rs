//! Forces on the rings by the rings' positions, each element staying in its radial balance.
//!
//! Element j is in balance where R_j = f·e_r − F_r + m (g·e_r + ρ ω²) = 0. What the rings do moves it by
//! du_j = −dR_j/(∂R_j/∂u_j), so that the forces on the rings depend on the rings alone: the arrow of all positions, its
//! elements eliminated. At rest that is the elastic tangent stiffness of the bearing.
//!
//! An element that nothing touches does not answer.

use super::forces::dot;
use super::linearized::{Bends, ElementChange, ElementVariation, Instant, Linearized};
use super::model::Model;

/// ∂(force on inner ring, force on outer ring)/∂(position of inner ring, position of outer ring) [N/m].
pub type RingJacobian = [[f64; 4]; 4];

/// Change of one element's path [m] and of the forces on the rings [N], its balance kept.
pub(super) struct Balanced {
    pub(super) path: f64,
    pub(super) rings: [f64; 4],
}

impl Model {
    /// Radial force R on an element [N], inertia of the turning cage and gravity included, and its derivative by u [N/m].
    #[inline]
    pub(super) fn radial_balance(&self, element: &Linearized) -> (f64, f64) {
        let Linearized { e_r, rho, omega, .. } = *element;
        let body = dot(self.gravity, e_r) + rho * omega * omega;
        let contacts = dot(element.inner, e_r) - element.outer[0];
        let along = radial(element, &element.change(&ElementVariation::of_path()));
        (contacts + self.element_mass * body, along + self.element_mass * omega * omega)
    }

    /// What a change does to an element that keeps its balance, and through it to the rings.
    pub(super) fn balanced(&self, element: &Linearized, by: &ElementVariation) -> Balanced {
        let Linearized { e_r, e_t, rho, omega, .. } = *element;
        let along = element.change(&ElementVariation::of_path());
        let direct = element.change(by);
        let stiffness = radial(element, &along) + self.element_mass * omega * omega;
        let push = radial(element, &direct) + 2.0 * self.element_mass * rho * omega * by.cage_speed;
        let path = if stiffness == 0.0 { 0.0 } else { -push / stiffness };
        let outer = [0, 1].map(|i| direct.outer[i] + path * along.outer[i]);
        let mut rings = [0.0; 4];
        for a in 0..2 {
            rings[a] = -(direct.inner[a] + path * along.inner[a]);
            rings[2 + a] = outer[0] * e_r[a] - outer[1] * e_t[a];
        }
        Balanced { path, rings }
    }

    /// Adds an element in balance to the Jacobian of the rings' forces.
    pub(super) fn add_balanced(&self, element: &Linearized, jacobian: &mut RingJacobian) {
        for axis in 0..2 {
            let rings = self.balanced(element, &ElementVariation::of_offset(axis)).rings;
            for i in 0..4 {
                jacobian[i][axis] -= rings[i];
                jacobian[i][2 + axis] += rings[i];
            }
        }
    }

    /// Elastic Jacobian of the rings' forces at the element paths `u`, the rings' centres being `offset` (outer minus inner)
    /// apart.
    pub fn ring_jacobian(&self, u: &[f64], cells: &[u32], offset: [f64; 2], cage_angle: f64) -> RingJacobian {
        let (mut jacobian, at) = ([[0.0; 4]; 4], Instant::at_rest(cage_angle, offset));
        for j in 0..self.element_count {
            self.add_balanced(&self.linearized_at(j, cells[j], (u[j], 0.0), &at, Bends::LeftOut), &mut jacobian);
        }
        jacobian
    }
}

/// Change of the radial force of both contacts [N].
#[inline]
fn radial(element: &Linearized, change: &ElementChange) -> f64 {
    dot(change.inner, element.e_r) - change.outer[0]
}
