//! Analytic Jacobian of the right-hand side, damping included, and its derivative by time.
//!
//! An element couples to the rings and to no other element, so the matrix is an arrow: one 2×2 block per element, its
//! coupling to the rings, and the rings' own block. With f the inner contact's force on the element,
//! ```text
//! f = Q(δ, δ̇) n,   q = x_o + ρ e_r − x_i,   q̇ = v_o + u' e_r + ρ ω e_t − v_i,   δ̇ = −n·q̇
//! G = ∂f/∂q = −n (Q_δ nᵀ + Q_δ̇ q̇ᵀP/|q|) + Q P/|q|,   P = 1 − n nᵀ
//! D = ∂f/∂q̇ = −Q_δ̇ n nᵀ
//! ```
//! and, because u' = w − e_r·v_o,
//! ```text
//! ∂f/∂u = G e_r + D e_t ω    ∂f/∂w = D e_r    ∂f/∂x_o = −∂f/∂x_i = G    ∂f/∂v_i = −D    ∂f/∂v_o = D e_t e_tᵀ
//! ```
//! The outer contact's force (F_r, F_t) = Q(Δ, Δ̇)(radial, tangential) with Δ̇ = Δ_u u' + Δ_ψ ω depends on u and u'
//! alone, and on time through the cage angle. Where Δ is not u itself, second derivatives of Δ and derivatives of the
//! direction by the angle are central differences over [`DIFFERENCE`], wrong by less than 1e-6 of themselves.
//!
//! By time, at constant state: ė_r = ω e_t, ė_t = −ω e_r, ω' the cage's acceleration, and prescribed rings and loads as
//! the drive says.
//!
//! The derivatives are those of the branch that the state is in; at the onset of a contact there are two.

use super::drive::Drive;
use super::forces::{RingState, SMOOTH, cos_sin, dot};
use super::model::{Layout, Model};
use super::tangent::times;
use crate::contact::near_defect::OuterApproach;
use crate::scene::Motion;

/// Bodies beside the elements that have a velocity: inner ring x, y, outer ring x, y, sensor.
pub const BODIES: usize = 5;

/// How far apart along path and raceway the approach near the defect is looked at for its second derivatives [m].
pub(super) const DIFFERENCE: f64 = 1e-9;

/// Rows and columns of one element.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ElementBlock {
    /// Radial direction; ∂u'/∂v_o is its negative, ∂u'/∂w is 1.
    pub e_r: [f64; 2],
    /// ∂w'/∂u [1/s²]
    pub by_path: f64,
    /// ∂w'/∂w [1/s]
    pub by_velocity: f64,
    /// ∂w'/∂x_o = −∂w'/∂x_i [1/s²]
    pub by_offset: [f64; 2],
    /// ∂w'/∂v_i [1/s]
    pub by_shaft_velocity: [f64; 2],
    /// ∂w'/∂v_o [1/s]
    pub by_housing_velocity: [f64; 2],
    /// ∂(v_i', v_o')/∂u [1/s²]
    pub rings_by_path: [f64; 4],
    /// ∂(v_i', v_o')/∂w [1/s]
    pub rings_by_velocity: [f64; 4],
}

/// The Jacobian in its blocks.
#[derive(Debug, Clone)]
pub struct Jacobian {
    /// The elements' blocks.
    pub elements: Vec<ElementBlock>,
    /// Accelerations of the bodies by their positions [1/s²].
    pub by_position: [[f64; BODIES]; BODIES],
    /// Accelerations of the bodies by their velocities [1/s].
    pub by_velocity: [[f64; BODIES]; BODIES],
    /// Where position and velocity of each body stand in the state; `None` for a body without state, whose rows and
    /// columns count for nothing.
    pub places: [Option<(usize, usize)>; BODIES],
    /// Where the elements' velocities begin in the state.
    pub radial_velocity: usize,
}

/// One element's contacts to first order. Vectors are in x and y.
pub(super) struct Linearized {
    pub(super) e_r: [f64; 2],
    pub(super) e_t: [f64; 2],
    /// f and its derivatives G, D.
    pub(super) inner: [f64; 2],
    pub(super) by_q: [[f64; 2]; 2],
    pub(super) by_q_rate: [[f64; 2]; 2],
    /// (F_r, F_t), and by u, u' and time.
    outer: [f64; 2],
    outer_by_path: [f64; 2],
    outer_by_rate: [f64; 2],
    outer_by_time: [f64; 2],
    pub(super) path_rate: f64,
    path_rate_by_time: f64,
}

/// What all elements share at one instant.
pub(super) struct Instant {
    pub(super) cage: (f64, f64),
    pub(super) cage_angle: f64,
    pub(super) omega: f64,
    pub(super) alpha: f64,
    pub(super) shaft: RingState,
    pub(super) housing: RingState,
    /// Prescribed velocity and acceleration of the rings; zero where the state has them.
    shaft_moves: [[f64; 2]; 2],
    housing_moves: [[f64; 2]; 2],
}

impl Jacobian {
    /// Room for a model's Jacobian.
    pub fn new(model: &Model) -> Self {
        Self {
            elements: vec![ElementBlock::default(); model.element_count],
            by_position: [[0.0; BODIES]; BODIES],
            by_velocity: [[0.0; BODIES]; BODIES],
            places: places(&model.layout),
            radial_velocity: model.layout.radial_velocity,
        }
    }

    /// One element alone that is damped with `rate` [1/s].
    #[cfg(test)]
    pub fn with_fastest(rate: f64) -> Self {
        Self {
            elements: vec![ElementBlock { by_velocity: -rate, ..ElementBlock::default() }],
            by_position: [[0.0; BODIES]; BODIES],
            by_velocity: [[0.0; BODIES]; BODIES],
            places: [None; BODIES],
            radial_velocity: 1,
        }
    }

    /// Largest eigenvalue magnitude [1/s] of the elements and bodies, each taken alone, and the damping ratio (0 to 1)
    /// of the one that has it. Neighbours that move too shift it by less than a factor of two.
    pub fn fastest(&self) -> (f64, f64) {
        let mut fastest = (0.0, 0.0);
        let mut consider = |by_position: f64, by_velocity: f64| {
            // λ² = by_velocity λ + by_position
            let half = 0.5 * by_velocity;
            let square = half * half + by_position;
            let root = if square >= 0.0 { half.abs() + square.sqrt() } else { (-by_position).sqrt() };
            if root > fastest.0 {
                fastest = (root, (-half / root).clamp(0.0, 1.0));
            }
        };
        for block in &self.elements {
            consider(block.by_path, block.by_velocity);
        }
        for i in (0..BODIES).filter(|&i| self.places[i].is_some()) {
            consider(self.by_position[i][i], self.by_velocity[i][i]);
        }
        fastest
    }
}

impl Model {
    /// The Jacobian at `tau`, and the derivative of the right-hand side by time at constant state.
    pub fn linearize(
        &self,
        drive: &Drive,
        tau: f64,
        cells: &[u32],
        state: &[f64],
        jacobian: &mut Jacobian,
        by_time: &mut [f64],
    ) {
        let start = self.layout.radial_velocity;
        let at = self.instant(drive, tau, state);
        let per_mass = 1.0 / self.element_mass;
        let per_ring =
            [&self.shaft, &self.housing].map(|r| if r.motion == Motion::Internal { 1.0 / r.mass } else { 0.0 });
        self.support(drive, tau, &at, per_ring, jacobian, by_time);
        for j in 0..self.element_count {
            let (u, w) = (state[j], state[start + j]);
            let rho = self.outer_centre_radius + u;
            let element = self.linearized(j, cells[j], u, w, &at);
            let Linearized { e_r, e_t, by_q, by_q_rate, .. } = &element;
            let omega = at.omega;

            let swing = times(*by_q_rate, *e_t);
            let g_e = times(*by_q, *e_r);
            let inner_by_path = [0, 1].map(|a| g_e[a] + omega * swing[a]);
            let inner_by_rate = times(*by_q_rate, *e_r);
            let inner_by_time = self.inner_by_time(&element, rho, &at);
            // e_rᵀ G and e_rᵀ D: D is symmetric, G with damping is not.
            let row = |m: &[[f64; 2]; 2]| [0, 1].map(|b| e_r[0] * m[0][b] + e_r[1] * m[1][b]);
            let (row_g, row_d) = (row(by_q), row(by_q_rate));
            let across = dot(row_d, *e_t);

            let block = &mut jacobian.elements[j];
            block.e_r = *e_r;
            block.by_path = (dot(inner_by_path, *e_r) - element.outer_by_path[0]) * per_mass + omega * omega;
            block.by_velocity = (dot(inner_by_rate, *e_r) - element.outer_by_rate[0]) * per_mass;
            for a in 0..2 {
                block.by_offset[a] = row_g[a] * per_mass;
                block.by_shaft_velocity[a] = -row_d[a] * per_mass;
                block.by_housing_velocity[a] =
                    (across * e_t[a] + element.outer_by_rate[0] * e_r[a]) * per_mass + omega * e_t[a];
                let on_housing = |f: [f64; 2]| per_ring[1] * (f[0] * e_r[a] - f[1] * e_t[a]);
                block.rings_by_path[a] = -per_ring[0] * inner_by_path[a];
                block.rings_by_velocity[a] = -per_ring[0] * inner_by_rate[a];
                block.rings_by_path[2 + a] = on_housing(element.outer_by_path);
                block.rings_by_velocity[2 + a] = on_housing(element.outer_by_rate);
                for b in 0..2 {
                    let (g, d) = (per_ring[0] * by_q[a][b], per_ring[0] * by_q_rate[a][b]);
                    jacobian.by_position[a][b] += g;
                    jacobian.by_position[a][2 + b] -= g;
                    jacobian.by_velocity[a][b] += d;
                    jacobian.by_velocity[a][2 + b] -= per_ring[0] * swing[a] * e_t[b];
                    jacobian.by_velocity[2 + a][2 + b] -= on_housing(element.outer_by_rate) * e_r[b];
                }
            }

            let along = dot(at.housing.velocity, *e_t);
            by_time[j] = element.path_rate_by_time;
            by_time[start + j] =
                (dot(inner_by_time, *e_r) + omega * dot(element.inner, *e_t) - element.outer_by_time[0]) * per_mass
                    + omega * dot(self.gravity, *e_t)
                    + at.alpha * (along + 2.0 * rho * omega)
                    + omega * (dot(at.housing_moves[1], *e_t) - omega * dot(at.housing.velocity, *e_r));
            let (outer, outer_by_time) = (element.outer, element.outer_by_time);
            for a in 0..2 {
                if let Some((_, place)) = jacobian.places[a] {
                    by_time[place] -= per_ring[0] * inner_by_time[a];
                }
                if let Some((_, place)) = jacobian.places[2 + a] {
                    by_time[place] += per_ring[1]
                        * ((outer_by_time[0] + omega * outer[1]) * e_r[a]
                            + (omega * outer[0] - outer_by_time[1]) * e_t[a]);
                }
            }
        }
    }

    pub(super) fn instant(&self, drive: &Drive, tau: f64, state: &[f64]) -> Instant {
        let cage_angle = drive.cage_angle(tau);
        let moves = |motion: Motion, place: &[super::drive::Quadratic; 2]| {
            if motion == Motion::Host { [place.map(|q| q.rate_at(tau)), place.map(|q| q.0[2])] } else { [[0.0; 2]; 2] }
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

    /// Starts `jacobian` and `by_time` with what does not come from contacts: supports, sensor, loads.
    fn support(
        &self,
        drive: &Drive,
        tau: f64,
        at: &Instant,
        per_ring: [f64; 2],
        jacobian: &mut Jacobian,
        by_time: &mut [f64],
    ) {
        (jacobian.by_position, jacobian.by_velocity) = ([[0.0; BODIES]; BODIES], [[0.0; BODIES]; BODIES]);
        by_time[2 * self.layout.radial_velocity..].fill(0.0);
        for (ring, support, load) in [(0, &self.shaft, &drive.shaft_load), (1, &self.housing, &drive.housing_load)] {
            for axis in 0..2 {
                let i = 2 * ring + axis;
                jacobian.by_position[i][i] = -support.stiffness * per_ring[ring];
                jacobian.by_velocity[i][i] = -support.damping * per_ring[ring];
                if let Some((_, place)) = jacobian.places[i] {
                    by_time[place] = per_ring[ring] * load[axis].rate_at(tau);
                }
            }
        }
        let (Some(sensor), Some((_, place))) = (&self.sensor, jacobian.places[4]) else { return };
        for (matrix, value) in
            [(&mut jacobian.by_position, sensor.stiffness), (&mut jacobian.by_velocity, sensor.damping)]
        {
            matrix[3][3] -= value * per_ring[1];
            matrix[3][4] += value * per_ring[1];
            matrix[4][3] += value / sensor.mass;
            matrix[4][4] -= value / sensor.mass;
        }
        let [velocity, acceleration] = at.housing_moves;
        by_time[place] = (sensor.stiffness * velocity[1] + sensor.damping * acceleration[1]) / sensor.mass;
    }

    pub(super) fn linearized(&self, j: usize, cell: u32, u: f64, w: f64, at: &Instant) -> Linearized {
        let e_r = self.direction(j, at.cage);
        let e_t = [-e_r[1], e_r[0]];
        let rho = self.outer_centre_radius + u;
        let path_rate = w - dot(at.housing.velocity, e_r);
        let path_rate_by_time = -at.omega * dot(at.housing.velocity, e_t) - dot(at.housing_moves[1], e_r);

        let offset = [0, 1].map(|a| at.housing.position[a] - at.shaft.position[a]);
        let gap = self.inner_gap(u, offset, e_r);
        let n = [0, 1].map(|a| gap.n[0] * e_r[a] + gap.n[1] * e_t[a]);
        let q_rate = [0, 1]
            .map(|a| at.housing.velocity[a] - at.shaft.velocity[a] + path_rate * e_r[a] + rho * at.omega * e_t[a]);
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

        let bend = if cell == SMOOTH { Bend::default() } else { self.bend(j, cell, u, at.cage_angle) };
        let near = self.outer_approach(j, cell, u, at.cage_angle, rho);
        let outer = self.outer.with_derivatives(near.value, near.by_path * path_rate + near.by_angle * at.omega);
        let direction = [near.radial, near.tangential];
        let direction_by_path = [near.radial_by_path, near.tangential_by_path];
        let by_path = outer.by_approach * near.by_path
            + outer.by_rate * (bend.path_path * path_rate + bend.path_angle * at.omega);
        let by_time = outer.by_approach * near.by_angle * at.omega
            + outer.by_rate
                * (bend.path_angle * at.omega * path_rate
                    + near.by_path * path_rate_by_time
                    + bend.angle_angle * at.omega * at.omega
                    + near.by_angle * at.alpha);
        Linearized {
            e_r,
            e_t,
            inner: n.map(|n| force.value * n),
            by_q,
            by_q_rate,
            outer: direction.map(|d| outer.value * d),
            outer_by_path: [0, 1].map(|a| by_path * direction[a] + outer.value * direction_by_path[a]),
            outer_by_rate: direction.map(|d| outer.by_rate * near.by_path * d),
            outer_by_time: [0, 1].map(|a| by_time * direction[a] + outer.value * at.omega * bend.direction_by_angle[a]),
            path_rate,
            path_rate_by_time,
        }
    }

    /// ∂f/∂t at constant state: G q_t + D q̇_t.
    fn inner_by_time(&self, element: &Linearized, rho: f64, at: &Instant) -> [f64; 2] {
        let Linearized { e_r, e_t, path_rate, path_rate_by_time, .. } = element;
        let (omega, alpha) = (at.omega, at.alpha);
        let [shaft, housing] = [at.shaft_moves, at.housing_moves];
        let q = [0, 1].map(|a| housing[0][a] - shaft[0][a] + rho * omega * e_t[a]);
        let q_rate = [0, 1].map(|a| {
            housing[1][a] - shaft[1][a]
                + (path_rate_by_time - rho * omega * omega) * e_r[a]
                + (path_rate * omega + rho * alpha) * e_t[a]
        });
        let (by_q, by_rate) = (times(element.by_q, q), times(element.by_q_rate, q_rate));
        [by_q[0] + by_rate[0], by_q[1] + by_rate[1]]
    }

    /// Second derivatives of the approach of element `j`, which is near the defect.
    pub(super) fn bend(&self, j: usize, cell: u32, u: f64, cage_angle: f64) -> Bend {
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

/// Second derivatives of an approach, and of its direction by the angle.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Bend {
    pub(super) path_path: f64,
    pub(super) path_angle: f64,
    pub(super) angle_angle: f64,
    pub(super) direction_by_angle: [f64; 2],
}

fn places(layout: &Layout) -> [Option<(usize, usize)>; BODIES] {
    let ring = |start: Option<usize>, axis: usize| start.map(|i| (i + axis, i + 2 + axis));
    [
        ring(layout.shaft, 0),
        ring(layout.shaft, 1),
        ring(layout.housing, 0),
        ring(layout.housing, 1),
        layout.sensor.map(|i| (i, i + 1)),
    ]
}

#[cfg(test)]
pub(crate) mod tests;
