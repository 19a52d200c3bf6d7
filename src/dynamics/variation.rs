//! First-order change of forces and accelerations for a small change of state and inputs.
//!
//! An element's contacts change with everything they see by the one rule of [`super::linearized`], where
//! ```text
//! u' = w − e_r·v_o                  du' = dw − e_r·dv_o − e_t·v_o dθ
//! ```
//! With it the derivative of any output follows: by an input at fixed state, by an input through the static
//! equilibrium, and by time along the motion. Derivatives are those of the branch that each contact is in; at the
//! onset of a contact there are two.

use super::drive::Drive;
use super::forces::{SMOOTH, dot};
use super::linearized::{Bends, DIFFERENCE, ElementVariation, Instant, Linearized, times};
use super::model::Model;
use super::rings::RingState;

/// A small change of state and inputs.
#[derive(Debug, Clone, Default)]
pub struct Variation {
    /// Of the cage angle [rad].
    pub cage_angle: f64,
    /// Of the cage speed [rad/s].
    pub cage_speed: f64,
    /// Of the inner ring.
    pub shaft: RingState,
    /// Of the outer ring.
    pub housing: RingState,
    /// Of the element paths u [m].
    pub path: Vec<f64>,
    /// Of the elements' absolute radial velocities w [m/s].
    pub radial_velocity: Vec<f64>,
}

/// What contact forces make of a [`Variation`].
#[derive(Debug, Clone, Default)]
pub struct ForceChange {
    /// Of each inner contact's force [N].
    pub inner: Vec<f64>,
    /// Of each outer contact's force [N].
    pub outer: Vec<f64>,
    /// Of the force on the inner ring [N].
    pub shaft: [f64; 2],
    /// Of the force on the outer ring [N].
    pub housing: [f64; 2],
    /// Of the cage torque [N m] while the outer ring's acceleration does not change.
    pub cage_torque: f64,
    /// Cage torque by the outer ring's acceleration [kg m].
    pub torque_by_acceleration: [f64; 2],
}

impl Variation {
    /// No change, with room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { path: vec![0.0; count], radial_velocity: vec![0.0; count], ..Self::default() }
    }

    /// Makes it no change again; allocates nothing.
    pub fn clear(&mut self) {
        (self.cage_angle, self.cage_speed) = (0.0, 0.0);
        (self.shaft, self.housing) = (RingState::default(), RingState::default());
        self.path.fill(0.0);
        self.radial_velocity.fill(0.0);
    }

    /// Of the outer ring's position less that of the inner [m].
    pub(super) fn offset(&self) -> [f64; 2] {
        [0, 1].map(|a| self.housing.position[a] - self.shaft.position[a])
    }
}

impl ForceChange {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { inner: vec![0.0; count], outer: vec![0.0; count], ..Self::default() }
    }
}

impl Model {
    /// Change of the contact forces under `drive` at τ = 0 for a small change. `acceleration` is the outer ring's.
    pub fn vary(
        &self,
        drive: &Drive,
        cells: &[u32],
        state: &[f64],
        acceleration: [f64; 2],
        by: &Variation,
        change: &mut ForceChange,
    ) {
        let z = self.element_count;
        let at = self.instant(drive, 0.0, state);
        let drift = [0, 1].map(|a| by.housing.velocity[a] - by.shaft.velocity[a]);
        (change.shaft, change.housing, change.torque_by_acceleration) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        change.cage_torque = 0.0;
        let moves = by.cage_angle != 0.0;
        for j in 0..z {
            let bends = if moves || by.path[j] != 0.0 { Bends::Wanted } else { Bends::LeftOut };
            let place = (state[j], state[self.layout.radial_velocity + j]);
            let element = self.linearized(j, cells[j], place, &at, bends);
            let Linearized { e_r, e_t, rho, omega, .. } = element;
            let path_rate =
                by.radial_velocity[j] - dot(by.housing.velocity, e_r) - dot(at.housing.velocity, e_t) * by.cage_angle;
            let seen = ElementVariation {
                offset: by.offset(),
                drift,
                path: by.path[j],
                path_rate,
                cage_angle: by.cage_angle,
                cage_speed: by.cage_speed,
            };
            let d = element.change(&seen);
            let amount = dot(element.inner, element.inner).sqrt();
            change.inner[j] = if amount > 0.0 { dot(element.inner, d.inner) / amount } else { 0.0 };
            change.outer[j] = element.outer_amount(&seen);
            let turn = by.cage_angle;
            for a in 0..2 {
                change.shaft[a] -= d.inner[a];
                change.housing[a] +=
                    (d.outer[0] + element.outer[1] * turn) * e_r[a] + (element.outer[0] * turn - d.outer[1]) * e_t[a];
                change.torque_by_acceleration[a] -= rho * self.element_mass * e_t[a];
            }
            let body = [0, 1].map(|a| self.gravity[a] - acceleration[a]);
            let inertia = dot(body, e_t) - 2.0 * element.path_rate * omega - rho * at.alpha;
            let force = dot(element.inner, e_t) + element.outer[1] + self.element_mass * inertia;
            let inertia_change = -dot(body, e_r) * turn
                - 2.0 * (path_rate * omega + element.path_rate * by.cage_speed)
                - by.path[j] * at.alpha;
            let force_change =
                dot(d.inner, e_t) - dot(element.inner, e_r) * turn + d.outer[1] + self.element_mass * inertia_change;
            change.cage_torque += by.path[j] * force + rho * force_change;
        }
    }

    /// Change of the inner ring's elastic force by its own position, [`Model::ring_jacobian`]'s first block [N/m], for a
    /// small change at the cage angle of `drive` at τ = 0.
    pub fn vary_stiffness(&self, drive: &Drive, cells: &[u32], state: &[f64], by: &Variation) -> [[f64; 2]; 2] {
        let cage_angle = drive.cage_angle(0.0);
        let (shaft, housing) = (self.shaft_state(drive, 0.0, state), self.housing_state(drive, 0.0, state));
        let offset = [0, 1].map(|a| housing.position[a] - shaft.position[a]);
        let (mut sum, at) = ([[0.0; 2]; 2], Instant::at_rest(cage_angle, offset));
        for j in 0..self.element_count {
            let (cell, u, turn) = (cells[j], state[j], by.cage_angle);
            let rho = self.outer_centre_radius + u;
            let element = self.linearized_at(j, cell, (u, 0.0), &at, Bends::LeftOut);
            let (_, radial) = self.radial_balance(&element);
            if radial == 0.0 {
                continue;
            }
            let Linearized { e_r, e_t, by_q: g, .. } = element;
            let q = by.offset();
            let q = [0, 1].map(|a| q[a] + e_r[a] * by.path[j] + rho * e_t[a] * turn);
            let dg = self.vary_inner_stiffness(u, offset, e_r, q);
            let across = times(g, e_r);
            let (moved, turned) = (times(dg, e_r), times(g, e_t));
            let d_across = [0, 1].map(|a| moved[a] + turned[a] * turn);
            let d_radial = dot(e_t, across) * turn + dot(e_r, d_across)
                - self.vary_outer_stiffness(j, cell, u, cage_angle, (by.path[j], turn));
            for a in 0..2 {
                for b in 0..2 {
                    sum[a][b] += dg[a][b] - (d_across[a] * across[b] + across[a] * d_across[b]) / radial
                        + across[a] * across[b] * d_radial / (radial * radial);
                }
            }
        }
        sum
    }

    /// Change of G = −(k + Q/|q|) n nᵀ + Q/|q| of an inner contact when the element moves by `q` from the inner ring.
    fn vary_inner_stiffness(&self, u: f64, offset: [f64; 2], e_r: [f64; 2], q: [f64; 2]) -> [[f64; 2]; 2] {
        let gap = self.inner_gap(u, offset, e_r);
        if gap.approach <= 0.0 {
            return [[0.0; 2]; 2];
        }
        let n = [gap.n[0] * e_r[0] - gap.n[1] * e_r[1], gap.n[0] * e_r[1] + gap.n[1] * e_r[0]];
        let away = dot(n, q);
        let (force, k) = (self.inner.elastic(gap.approach), self.inner.elastic_stiffness(gap.approach));
        let c = force / gap.distance;
        let dk = -0.75 * self.inner.stiffness / gap.approach.sqrt() * away;
        let dc = -(k + c) * away / gap.distance;
        let dn = [0, 1].map(|a| (q[a] - n[a] * away) / gap.distance);
        let mut change = [[0.0; 2]; 2];
        for a in 0..2 {
            for b in 0..2 {
                change[a][b] =
                    -(dk + dc) * n[a] * n[b] - (k + c) * (dn[a] * n[b] + n[a] * dn[b]) + if a == b { dc } else { 0.0 };
            }
        }
        change
    }

    /// Change of an outer contact's radial tangent stiffness by path [m] and cage angle [rad]; near the defect and where the
    /// raceway yields by central differences, like the second derivatives of the approach.
    fn vary_outer_stiffness(&self, j: usize, cell: u32, u: f64, cage_angle: f64, by: (f64, f64)) -> f64 {
        if cell == SMOOTH && self.outer.compliance == 0.0 {
            return if u > 0.0 { 0.75 * self.outer.contact.stiffness / u.sqrt() * by.0 } else { 0.0 };
        }
        let radial = |u: f64, angle: f64| {
            // Nothing moves and the rings' offset does not matter to the outer contact.
            let at = Instant::at_rest(angle, [0.0; 2]);
            self.linearized_at(j, cell, (u, 0.0), &at, Bends::LeftOut).change(&ElementVariation::of_path()).outer[0]
        };
        let mut change = 0.0;
        if by.0 != 0.0 {
            let (inside, outside) = (radial(u - DIFFERENCE, cage_angle), radial(u + DIFFERENCE, cage_angle));
            change += (outside - inside) / (2.0 * DIFFERENCE) * by.0;
        }
        if by.1 != 0.0 && cell != SMOOTH {
            let step = DIFFERENCE / self.outer_centre_radius;
            let (behind, ahead) = (radial(u, cage_angle - step), radial(u, cage_angle + step));
            change += (ahead - behind) / (2.0 * step) * by.1;
        }
        change
    }
}
