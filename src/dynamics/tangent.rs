//! Elastic tangent stiffness of the bearing, with the elements in static balance between the rings.
//!
//! For one element with q from the inner ring's centre to its own, the inner force on it is Q n and
//! ```text
//! G = ∂(Q n)/∂q = −k n nᵀ + (Q/|q|)(1 − n nᵀ),   k = 1.5 K √δ
//! ```
//! Its radial balance e_r·Q n − F_r(u) + … = 0 gives du = e_rᵀG (dx_i − dx_o)/g with g = e_rᵀ G e_r − ∂F_r/∂u, and so
//! the ring forces depend on the rings' positions alone. Damping and inertia do not enter.

use super::forces::{cos_sin, dot};
use super::model::Model;

/// ∂(force on inner ring, force on outer ring)/∂(position of inner ring, position of outer ring) [N/m].
pub type RingJacobian = [[f64; 4]; 4];

/// Elastic forces in one element's contacts and their derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElasticElement {
    pub(super) e_r: [f64; 2],
    pub(super) e_t: [f64; 2],
    /// Inner contact force on the element [N].
    pub(super) inner: [f64; 2],
    /// ∂(inner)/∂q [N/m], symmetric.
    pub(super) inner_by_q: [[f64; 2]; 2],
    /// Outer contact force on the element, inwards and counter-clockwise [N].
    pub(super) outer: [f64; 2],
    /// ∂(outer)/∂u [N/m].
    pub(super) outer_by_path: [f64; 2],
}

impl ElasticElement {
    /// Radial force on the element from both contacts [N], and its derivative by u.
    pub(super) fn radial(&self) -> (f64, f64) {
        let g_e = times(self.inner_by_q, self.e_r);
        (dot(self.inner, self.e_r) - self.outer[0], dot(self.e_r, g_e) - self.outer_by_path[0])
    }
}

impl Model {
    /// Elastic contact forces of element `j` at path `u`, the rings' centres being `offset` (outer minus inner) apart; the
    /// cage angle comes with its cosine and sine.
    pub(super) fn elastic_element(
        &self,
        j: usize,
        cell: u32,
        u: f64,
        offset: [f64; 2],
        (cage_angle, cage): (f64, (f64, f64)),
    ) -> ElasticElement {
        let e_r = self.direction(j, cage);
        let e_t = [-e_r[1], e_r[0]];
        let rho = self.outer_centre_radius + u;
        let gap = self.inner_gap(u, offset, e_r);
        let n = [0, 1].map(|a| gap.n[0] * e_r[a] + gap.n[1] * e_t[a]);
        let (delta, q) = (gap.approach, gap.distance);
        let (force, k) = (self.inner.elastic(delta), self.inner.elastic_stiffness(delta));
        let across = force / q;
        let mut inner_by_q = [[0.0; 2]; 2];
        for a in 0..2 {
            for b in 0..2 {
                inner_by_q[a][b] = -(k + across) * n[a] * n[b] + if a == b { across } else { 0.0 };
            }
        }
        let near = self.outer_approach(j, cell, u, cage_angle, rho);
        let (outer, k_outer) =
            (self.outer.elastic(near.value), self.outer.elastic_stiffness(near.value) * near.by_path);
        ElasticElement {
            e_r,
            e_t,
            inner: [force * n[0], force * n[1]],
            inner_by_q,
            outer: [outer * near.radial, outer * near.tangential],
            outer_by_path: [
                k_outer * near.radial + outer * near.radial_by_path,
                k_outer * near.tangential + outer * near.tangential_by_path,
            ],
        }
    }

    /// Elastic Jacobian of the ring forces, elements eliminated, at the element paths `u`.
    pub fn ring_jacobian(&self, u: &[f64], cells: &[u32], offset: [f64; 2], cage_angle: f64) -> RingJacobian {
        let mut jacobian = [[0.0; 4]; 4];
        let cage = (cage_angle, cos_sin(cage_angle));
        for j in 0..self.element_count {
            let element = self.elastic_element(j, cells[j], u[j], offset, cage);
            let (_, g) = element.radial();
            let g_e = times(element.inner_by_q, element.e_r);
            // du/dx_i = −du/dx_o; an element without contact does not answer.
            let du = if g == 0.0 { [0.0; 2] } else { [g_e[0] / g, g_e[1] / g] };
            for a in 0..2 {
                let on_housing = element.outer_by_path[0] * element.e_r[a] - element.outer_by_path[1] * element.e_t[a];
                for b in 0..2 {
                    let shaft = element.inner_by_q[a][b] - g_e[a] * du[b];
                    jacobian[a][b] += shaft;
                    jacobian[a][2 + b] -= shaft;
                    jacobian[2 + a][b] += on_housing * du[b];
                    jacobian[2 + a][2 + b] -= on_housing * du[b];
                }
            }
        }
        jacobian
    }
}

#[inline]
pub(super) fn times(matrix: [[f64; 2]; 2], vector: [f64; 2]) -> [f64; 2] {
    [dot(matrix[0], vector), dot(matrix[1], vector)]
}
