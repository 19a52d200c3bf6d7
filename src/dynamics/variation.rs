//! First-order change of forces and accelerations for a small change of state and inputs.
//!
//! An element's contacts change with everything they see; d stands for the change:
//! ```text
//! q   = x_o − x_i + ρ e_r            dq  = dx_o − dx_i + e_r du + ρ e_t dθ
//! u'  = w − e_r·v_o                  du' = dw − e_r·dv_o − e_t·v_o dθ
//! q̇   = v_o − v_i + u' e_r + ρ ω e_t   dq̇ = dv_o − dv_i + e_r du' + (u' e_t − ρ ω e_r) dθ + e_t (ω du + ρ dω)
//! df  = G dq + D dq̇                  with G, D of `jacobian`
//! dF  = (Q_Δ dΔ + Q_Δ̇ dΔ̇) (radial, tangential) + Q d(radial, tangential)
//! dΔ  = Δ_u du + Δ_ψ dθ              dΔ̇ = Δ_u du' + Δ_ψ dω + (Δ_uu u' + Δ_uψ ω) du + (Δ_uψ u' + Δ_ψψ ω) dθ
//! ```
//! With this one rule the derivative of any output follows: by an input at fixed state, by an input through the static
//! equilibrium, and by time along the motion. Derivatives are those of the branch that each contact is in; at the
//! onset of a contact there are two.

use super::drive::Drive;
use super::forces::{RingState, SMOOTH, cos_sin, dot};
use super::jacobian::{Bend, DIFFERENCE, Instant};
use super::model::Model;
use super::tangent::{ElasticElement, times};

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

/// Change of one element's contact forces.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ElementChange {
    /// Force of the inner contact on the element, x and y [N].
    pub(super) inner: [f64; 2],
    /// Force of the outer contact on the element, inwards and counter-clockwise [N].
    pub(super) outer: [f64; 2],
    /// Amount of the outer force [N].
    pub(super) outer_amount: f64,
}

/// Change of what one element sees.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ElementVariation {
    pub(super) offset: [f64; 2],
    pub(super) drift: [f64; 2],
    pub(super) path: f64,
    pub(super) path_rate: f64,
    pub(super) cage_angle: f64,
    pub(super) cage_speed: f64,
}

/// One element's contacts as far as their changes need them.
pub(super) struct VaryingElement {
    pub(super) e_r: [f64; 2],
    pub(super) e_t: [f64; 2],
    /// Force of the inner contact on the element, x and y [N].
    pub(super) inner: [f64; 2],
    /// Force of the outer contact on the element, inwards and counter-clockwise [N].
    pub(super) outer: [f64; 2],
    pub(super) path_rate: f64,
    pub(super) rho: f64,
    pub(super) omega: f64,
    by_q: [[f64; 2]; 2],
    by_q_rate: [[f64; 2]; 2],
    /// Direction, and its derivatives by path and angle.
    direction: [f64; 2],
    direction_by_path: [f64; 2],
    direction_by_angle: [f64; 2],
    /// Amount of the outer force per unit of direction, and its derivatives.
    amount: f64,
    by_path: f64,
    by_path_rate: f64,
    by_angle: f64,
    by_speed: f64,
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

    fn offset(&self) -> [f64; 2] {
        [0, 1].map(|a| self.housing.position[a] - self.shaft.position[a])
    }
}

impl ForceChange {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { inner: vec![0.0; count], outer: vec![0.0; count], ..Self::default() }
    }
}

impl VaryingElement {
    pub(super) fn change(&self, by: &ElementVariation) -> ElementChange {
        let Self { e_r, e_t, rho, omega, .. } = *self;
        let turned = rho * by.cage_angle;
        let radial = by.path_rate - rho * omega * by.cage_angle;
        let around = self.path_rate * by.cage_angle + omega * by.path + rho * by.cage_speed;
        let q = [0, 1].map(|a| by.offset[a] + e_r[a] * by.path + e_t[a] * turned);
        let q_rate = [0, 1].map(|a| by.drift[a] + e_r[a] * radial + e_t[a] * around);
        let (by_q, by_rate) = (times(self.by_q, q), times(self.by_q_rate, q_rate));
        let amount = self.by_path * by.path
            + self.by_path_rate * by.path_rate
            + self.by_angle * by.cage_angle
            + self.by_speed * by.cage_speed;
        let turn = [0, 1].map(|a| self.direction_by_path[a] * by.path + self.direction_by_angle[a] * by.cage_angle);
        let length = dot(self.direction, self.direction).sqrt().max(f64::MIN_POSITIVE);
        ElementChange {
            inner: [by_q[0] + by_rate[0], by_q[1] + by_rate[1]],
            outer: [0, 1].map(|a| amount * self.direction[a] + self.amount * turn[a]),
            outer_amount: amount * length + self.amount * dot(self.direction, turn) / length,
        }
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
            let bends = moves || by.path[j] != 0.0;
            let element = self.varying(j, cells[j], (state[j], state[self.layout.radial_velocity + j]), &at, bends);
            let VaryingElement { e_r, e_t, rho, omega, .. } = element;
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
            change.outer[j] = d.outer_amount;
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

    /// Contacts of element `j` at path and radial velocity `(u, w)`. Second derivatives of the outer approach are worked
    /// out only if something `bends` it: path or place.
    pub(super) fn varying(&self, j: usize, cell: u32, (u, w): (f64, f64), at: &Instant, bends: bool) -> VaryingElement {
        let rho = self.outer_centre_radius + u;
        // The smooth cell leaves the outer contact out, which is worked out here.
        let inner = self.linearized(j, SMOOTH, u, w, at);
        let near = self.outer_approach(j, cell, u, at.cage_angle, rho);
        let bend = if bends && cell != SMOOTH { self.bend(j, cell, u, at.cage_angle) } else { Bend::default() };
        let (p, omega) = (inner.path_rate, at.omega);
        let law = self.outer.with_derivatives(near.value, near.by_path * p + near.by_angle * omega);
        let direction = [near.radial, near.tangential];
        VaryingElement {
            e_r: inner.e_r,
            e_t: inner.e_t,
            inner: inner.inner,
            outer: direction.map(|d| law.value * d),
            path_rate: p,
            rho,
            omega,
            by_q: inner.by_q,
            by_q_rate: inner.by_q_rate,
            direction,
            direction_by_path: [near.radial_by_path, near.tangential_by_path],
            direction_by_angle: bend.direction_by_angle,
            amount: law.value,
            by_path: law.by_approach * near.by_path + law.by_rate * (bend.path_path * p + bend.path_angle * omega),
            by_path_rate: law.by_rate * near.by_path,
            by_angle: law.by_approach * near.by_angle + law.by_rate * (bend.path_angle * p + bend.angle_angle * omega),
            by_speed: law.by_rate * near.by_angle,
        }
    }

    /// Change of the inner ring's elastic force by its own position, [`Model::ring_jacobian`]'s first block [N/m], for a
    /// small change at the cage angle of `drive` at τ = 0.
    pub fn vary_stiffness(&self, drive: &Drive, cells: &[u32], state: &[f64], by: &Variation) -> [[f64; 2]; 2] {
        let cage_angle = drive.cage_angle(0.0);
        let (shaft, housing) = (self.shaft_state(drive, 0.0, state), self.housing_state(drive, 0.0, state));
        let offset = [0, 1].map(|a| housing.position[a] - shaft.position[a]);
        let (mut sum, cage) = ([[0.0; 2]; 2], cos_sin(cage_angle));
        for j in 0..self.element_count {
            let (cell, u, turn) = (cells[j], state[j], by.cage_angle);
            let rho = self.outer_centre_radius + u;
            let element = self.elastic_element(j, cell, u, offset, (cage_angle, cage));
            let (_, radial) = element.radial();
            if radial == 0.0 {
                continue;
            }
            let ElasticElement { e_r, e_t, inner_by_q: g, .. } = element;
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
            let near = self.outer_approach(j, cell, u, angle, self.outer_centre_radius + u);
            self.outer.elastic_stiffness(near.value) * near.by_path * near.radial
                + self.outer.elastic(near.value) * near.radial_by_path
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
