//! One element's contacts to first order: the one source of their derivatives.
//!
//! From it are assembled the [Jacobian](super::jacobian) of stiff steps, the elements' and rings' balance of the
//! [start](super::equilibrium) and how that [moves](super::equilibrium_variation), the [tangent
//! stiffness](super::tangent), and the derivatives of [outputs](super::variation).
//!
//! With f the inner contact's force on the element,
//! ```text
//! f = Q(δ, δ̇) n,   q = x_o + ρ e_r − x_i,   q̇ = v_o + u' e_r + ρ ω e_t − v_i,   δ̇ = −n·q̇
//! G = ∂f/∂q = −n (Q_δ nᵀ + Q_δ̇ q̇ᵀP/|q|) + Q P/|q|,   P = 1 − n nᵀ
//! D = ∂f/∂q̇ = −Q_δ̇ n nᵀ
//! ```
//! and, d standing for a small change of all that an element sees,
//! ```text
//! dq  = dx_o − dx_i + e_r du + ρ e_t dθ
//! dq̇  = dv_o − dv_i + e_r du' + (u' e_t − ρ ω e_r) dθ + e_t (ω du + ρ dω)
//! df  = G dq + D dq̇
//! dF  = (Q_Δ dΔ + Q_Δ̇ dΔ̇) (radial, tangential) + Q d(radial, tangential)
//! dΔ  = Δ_u du + Δ_ψ dθ              dΔ̇ = Δ_u du' + Δ_ψ dω + (Δ_uu u' + Δ_uψ ω) du + (Δ_uψ u' + Δ_ψψ ω) dθ
//! ```
//! F is the outer contact's force, inwards and counter-clockwise, at the equivalent approach Δ(u, ψ). Where Δ is not u itself,
//! its second derivatives and derivatives of the direction by the angle are central differences over [`DIFFERENCE`],
//! wrong by less than 1e-6 of themselves.
//!
//! Derivatives are those of the branch that each contact is in; at the onset of a contact there are two. At rest all of
//! it is elastic: G is symmetric, and no damping enters.

use super::drive::{Cubic, Drive};
use super::forces::{SMOOTH, cos_sin, dot};
use super::model::Model;
use super::rings::RingState;
use crate::contact::near_defect::OuterApproach;
use crate::scene::Motion;

/// How far apart along path and raceway the approach near the defect is looked at for its second derivatives [m].
pub(super) const DIFFERENCE: f64 = 1e-9;

/// What all elements share at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Instant {
    pub(super) cage: (f64, f64),
    pub(super) cage_angle: f64,
    pub(super) omega: f64,
    pub(super) alpha: f64,
    pub(super) shaft: RingState,
    pub(super) housing: RingState,
    /// Prescribed velocity and acceleration of the rings; zero where the state has them.
    pub(super) shaft_moves: [[f64; 2]; 2],
    pub(super) housing_moves: [[f64; 2]; 2],
}

/// Whether second derivatives of the outer approach are wanted, which the change of path or place needs while something
/// moves; each costs four more looks at the defect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bends {
    /// They are.
    Wanted,
    /// They count for nothing, or an approximate derivative will do.
    LeftOut,
}

/// One element's contacts to first order. Vectors are in x and y unless they say otherwise.
#[derive(Debug, Clone, Copy)]
pub(super) struct Linearized {
    pub(super) e_r: [f64; 2],
    pub(super) e_t: [f64; 2],
    pub(super) rho: f64,
    pub(super) omega: f64,
    pub(super) path_rate: f64,
    /// Force of the inner contact on the element [N], and its derivatives G, D.
    pub(super) inner: [f64; 2],
    pub(super) by_q: [[f64; 2]; 2],
    pub(super) by_q_rate: [[f64; 2]; 2],
    /// Force of the outer contact on the element, inwards and counter-clockwise [N].
    pub(super) outer: [f64; 2],
    /// Direction of the outer force, inwards and counter-clockwise, and its derivatives by path and angle.
    direction: [f64; 2],
    direction_by_path: [f64; 2],
    direction_by_angle: [f64; 2],
    /// Outer force per unit of direction, and its derivatives by u, u', cage angle and cage speed.
    amount: f64,
    by_path: f64,
    by_path_rate: f64,
    by_angle: f64,
    by_speed: f64,
}

/// A small change of what one element sees.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ElementVariation {
    /// Of the outer ring's position less that of the inner.
    pub(super) offset: [f64; 2],
    /// Of the outer ring's velocity less that of the inner.
    pub(super) drift: [f64; 2],
    pub(super) path: f64,
    pub(super) path_rate: f64,
    pub(super) cage_angle: f64,
    pub(super) cage_speed: f64,
}

/// Change of one element's contact forces, in the directions of [`Linearized::inner`] and [`Linearized::outer`].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ElementChange {
    pub(super) inner: [f64; 2],
    pub(super) outer: [f64; 2],
}

/// Second derivatives of an approach, and of its direction by the angle.
#[derive(Debug, Clone, Copy, Default)]
struct Bend {
    path_path: f64,
    path_angle: f64,
    angle_angle: f64,
    direction_by_angle: [f64; 2],
}

impl Instant {
    /// Nothing moves; the outer ring's centre is `offset` from the inner's.
    pub(super) fn at_rest(cage_angle: f64, offset: [f64; 2]) -> Self {
        let housing = RingState { position: offset, ..RingState::default() };
        Self {
            cage: cos_sin(cage_angle),
            cage_angle,
            omega: 0.0,
            alpha: 0.0,
            shaft: RingState::default(),
            housing,
            shaft_moves: [[0.0; 2]; 2],
            housing_moves: [[0.0; 2]; 2],
        }
    }
}

impl ElementVariation {
    /// Of the path alone.
    pub(super) fn of_path() -> Self {
        Self { path: 1.0, ..Self::default() }
    }

    /// Of u' alone.
    pub(super) fn of_path_rate() -> Self {
        Self { path_rate: 1.0, ..Self::default() }
    }

    /// Of the rings' offset along one axis alone.
    pub(super) fn of_offset(axis: usize) -> Self {
        let mut offset = [0.0; 2];
        offset[axis] = 1.0;
        Self { offset, ..Self::default() }
    }
}

impl Linearized {
    /// The forces' change.
    #[inline]
    pub(super) fn change(&self, by: &ElementVariation) -> ElementChange {
        let Self { e_r, e_t, rho, omega, .. } = *self;
        let turned = rho * by.cage_angle;
        let radial = by.path_rate - rho * omega * by.cage_angle;
        let around = self.path_rate * by.cage_angle + omega * by.path + rho * by.cage_speed;
        let q = [0, 1].map(|a| by.offset[a] + e_r[a] * by.path + e_t[a] * turned);
        let q_rate = [0, 1].map(|a| by.drift[a] + e_r[a] * radial + e_t[a] * around);
        let (by_q, by_rate) = (times(self.by_q, q), times(self.by_q_rate, q_rate));
        let (amount, turn) = self.outer_change(by);
        ElementChange {
            inner: [by_q[0] + by_rate[0], by_q[1] + by_rate[1]],
            outer: [0, 1].map(|a| amount * self.direction[a] + self.amount * turn[a]),
        }
    }

    /// The change of the outer force's magnitude [N].
    pub(super) fn outer_amount(&self, by: &ElementVariation) -> f64 {
        let (amount, turn) = self.outer_change(by);
        let length = dot(self.direction, self.direction).sqrt().max(f64::MIN_POSITIVE);
        amount * length + self.amount * dot(self.direction, turn) / length
    }

    /// Change of the outer force per unit of direction, and of the direction.
    #[inline]
    fn outer_change(&self, by: &ElementVariation) -> (f64, [f64; 2]) {
        let amount = self.by_path * by.path
            + self.by_path_rate * by.path_rate
            + self.by_angle * by.cage_angle
            + self.by_speed * by.cage_speed;
        let turn = [0, 1].map(|a| self.direction_by_path[a] * by.path + self.direction_by_angle[a] * by.cage_angle);
        (amount, turn)
    }
}

impl Model {
    /// What elements share at `tau`.
    pub(super) fn instant(&self, drive: &Drive, tau: f64, state: &[f64]) -> Instant {
        let cage_angle = drive.cage_angle(tau);
        let moves = |motion: Motion, place: &[Cubic; 2]| {
            if motion == Motion::Host {
                [place.map(|q| q.rate_at(tau)), place.map(|q| q.second_at(tau))]
            } else {
                [[0.0; 2]; 2]
            }
        };
        Instant {
            cage: cos_sin(cage_angle),
            cage_angle,
            omega: drive.cage.rate_at(tau),
            alpha: drive.cage.0[2],
            shaft: self.shaft_state(drive, tau, state),
            housing: self.housing_state(drive, tau, state),
            shaft_moves: moves(self.shaft.motion, &drive.shaft),
            housing_moves: moves(self.housing.motion, &drive.housing),
        }
    }

    /// Element `j` at path `u` and absolute radial velocity `w`.
    pub(super) fn linearized(&self, j: usize, cell: u32, (u, w): (f64, f64), at: &Instant, bends: Bends) -> Linearized {
        let path_rate = w - dot(at.housing.velocity, self.direction(j, at.cage));
        self.linearized_at(j, cell, (u, path_rate), at, bends)
    }

    /// Element `j` at path and path rate `(u, u')`.
    pub(super) fn linearized_at(
        &self,
        j: usize,
        cell: u32,
        (u, path_rate): (f64, f64),
        at: &Instant,
        bends: Bends,
    ) -> Linearized {
        let e_r = self.direction(j, at.cage);
        let e_t = [-e_r[1], e_r[0]];
        let (rho, omega) = (self.outer_centre_radius + u, at.omega);

        let offset = [0, 1].map(|a| at.housing.position[a] - at.shaft.position[a]);
        let gap = self.inner_gap(u, offset, e_r);
        let n = [0, 1].map(|a| gap.n[0] * e_r[a] + gap.n[1] * e_t[a]);
        let q_rate =
            [0, 1].map(|a| at.housing.velocity[a] - at.shaft.velocity[a] + path_rate * e_r[a] + rho * omega * e_t[a]);
        let rate = -dot(n, q_rate);
        let force = self.inner.with_derivatives(gap.approach, rate);
        // P q̇/|q| and Q/|q|
        let turn = [0, 1].map(|a| (q_rate[a] + rate * n[a]) / gap.distance);
        let across = force.value / gap.distance;
        let (mut by_q, mut by_q_rate) = ([[0.0; 2]; 2], [[0.0; 2]; 2]);
        for a in 0..2 {
            for b in 0..2 {
                let diagonal = if a == b { across } else { 0.0 };
                by_q[a][b] = diagonal - n[a] * ((force.by_approach + across) * n[b] + force.by_rate * turn[b]);
                by_q_rate[a][b] = -force.by_rate * n[a] * n[b];
            }
        }

        let bent = bends == Bends::Wanted && cell != SMOOTH;
        let bend = if bent { self.bend(j, cell, u, at.cage_angle) } else { Bend::default() };
        let near = self.outer_approach(j, cell, u, at.cage_angle, rho);
        let law = self.outer.with_derivatives(near.value, near.by_path * path_rate + near.by_angle * omega);
        let direction = [near.radial, near.tangential];
        Linearized {
            e_r,
            e_t,
            rho,
            omega,
            path_rate,
            inner: n.map(|n| force.value * n),
            by_q,
            by_q_rate,
            outer: direction.map(|d| law.value * d),
            direction,
            direction_by_path: [near.radial_by_path, near.tangential_by_path],
            direction_by_angle: bend.direction_by_angle,
            amount: law.value,
            by_path: law.by_approach * near.by_path
                + law.by_rate * (bend.path_path * path_rate + bend.path_angle * omega),
            by_path_rate: law.by_rate * near.by_path,
            by_angle: law.by_approach * near.by_angle
                + law.by_rate * (bend.path_angle * path_rate + bend.angle_angle * omega),
            by_speed: law.by_rate * near.by_angle,
        }
    }

    /// Second derivatives of the approach of element `j`, which is near the defect.
    fn bend(&self, j: usize, cell: u32, u: f64, cage_angle: f64) -> Bend {
        let look = |u: f64, angle: f64| self.outer_approach(j, cell, u, angle, self.outer_centre_radius + u);
        let angle = DIFFERENCE / self.outer_centre_radius;
        let (inside, outside) = (look(u - DIFFERENCE, cage_angle), look(u + DIFFERENCE, cage_angle));
        let (behind, ahead) = (look(u, cage_angle - angle), look(u, cage_angle + angle));
        let by_path = |of: fn(&OuterApproach) -> f64| (of(&outside) - of(&inside)) / (2.0 * DIFFERENCE);
        let by_angle = |of: fn(&OuterApproach) -> f64| (of(&ahead) - of(&behind)) / (2.0 * angle);
        Bend {
            path_path: by_path(|near| near.by_path),
            path_angle: by_path(|near| near.by_angle),
            angle_angle: by_angle(|near| near.by_angle),
            direction_by_angle: [by_angle(|near| near.radial), by_angle(|near| near.tangential)],
        }
    }
}

#[inline]
pub(super) fn times(matrix: [[f64; 2]; 2], vector: [f64; 2]) -> [f64; 2] {
    [dot(matrix[0], vector), dot(matrix[1], vector)]
}
