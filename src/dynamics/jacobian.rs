//! Analytic Jacobian of the right-hand side, damping included, and its derivative by time.
//!
//! An element couples to the rings and to no other element, so the matrix is an arrow: one 2×2 block per element, its
//! coupling to the rings, and the rings' own block. The contacts' derivatives are those of [`super::linearized`], with f, G and
//! D as there; because u' = w − e_r·v_o,
//! ```text
//! ∂f/∂u = G e_r + D e_t ω    ∂f/∂w = D e_r    ∂f/∂x_o = −∂f/∂x_i = G    ∂f/∂v_i = −D    ∂f/∂v_o = D e_t e_tᵀ
//! ```
//! The outer contact's force depends on u and u' alone, and on time through the cage angle.
//!
//! By time, at constant state: ė_r = ω e_t, ė_t = −ω e_r, ω' the cage's acceleration, and prescribed rings and loads as
//! the drive says.
//!
//! The derivatives are those of the branch that the state is in; at the onset of a contact there are two.

use super::drive::Drive;
use super::forces::dot;
use super::linearized::{Bends, ElementVariation, Instant, Linearized, times};
use super::model::{Layout, Model};
use crate::scene::Motion;

/// Bodies beside the elements that have a velocity: inner ring x, y, outer ring x, y, sensor.
pub const BODIES: usize = 5;

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
            // Two real eigenvalues, or a pair of magnitude √(−by_position).
            let (root, damping) = if square >= 0.0 {
                (half.abs() + square.sqrt(), 1.0)
            } else {
                ((-by_position).sqrt(), -half / (-by_position).sqrt())
            };
            if root > fastest.0 {
                fastest = (root, damping.clamp(0.0, 1.0));
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
            let element = self.linearized(j, cells[j], (u, w), &at, Bends::Wanted);
            let Linearized { e_r, e_t, rho, omega, by_q, by_q_rate, .. } = &element;
            let (rho, omega) = (*rho, *omega);

            let swing = times(*by_q_rate, *e_t);
            let by_path = element.change(&ElementVariation::of_path());
            let by_rate = element.change(&ElementVariation::of_path_rate());
            let path_rate_by_time = -omega * dot(at.housing.velocity, *e_t) - dot(at.housing_moves[1], *e_r);
            let with_time = element.change(&ElementVariation {
                offset: [0, 1].map(|a| at.housing_moves[0][a] - at.shaft_moves[0][a]),
                drift: [0, 1].map(|a| at.housing_moves[1][a] - at.shaft_moves[1][a]),
                path: 0.0,
                path_rate: path_rate_by_time,
                cage_angle: omega,
                cage_speed: at.alpha,
            });
            // e_rᵀ G and e_rᵀ D: D is symmetric, G with damping is not.
            let row = |m: &[[f64; 2]; 2]| [0, 1].map(|b| e_r[0] * m[0][b] + e_r[1] * m[1][b]);
            let (row_g, row_d) = (row(by_q), row(by_q_rate));
            let across = dot(row_d, *e_t);

            let block = &mut jacobian.elements[j];
            block.e_r = *e_r;
            block.by_path = (dot(by_path.inner, *e_r) - by_path.outer[0]) * per_mass + omega * omega;
            block.by_velocity = (dot(by_rate.inner, *e_r) - by_rate.outer[0]) * per_mass;
            for a in 0..2 {
                block.by_offset[a] = row_g[a] * per_mass;
                block.by_shaft_velocity[a] = -row_d[a] * per_mass;
                block.by_housing_velocity[a] =
                    (across * e_t[a] + by_rate.outer[0] * e_r[a]) * per_mass + omega * e_t[a];
                let on_housing = |f: [f64; 2]| per_ring[1] * (f[0] * e_r[a] - f[1] * e_t[a]);
                block.rings_by_path[a] = -per_ring[0] * by_path.inner[a];
                block.rings_by_velocity[a] = -per_ring[0] * by_rate.inner[a];
                block.rings_by_path[2 + a] = on_housing(by_path.outer);
                block.rings_by_velocity[2 + a] = on_housing(by_rate.outer);
                for b in 0..2 {
                    let (g, d) = (per_ring[0] * by_q[a][b], per_ring[0] * by_q_rate[a][b]);
                    jacobian.by_position[a][b] += g;
                    jacobian.by_position[a][2 + b] -= g;
                    jacobian.by_velocity[a][b] += d;
                    jacobian.by_velocity[a][2 + b] -= per_ring[0] * swing[a] * e_t[b];
                    jacobian.by_velocity[2 + a][2 + b] -= on_housing(by_rate.outer) * e_r[b];
                }
            }

            let along = dot(at.housing.velocity, *e_t);
            by_time[j] = path_rate_by_time;
            by_time[start + j] = (dot(with_time.inner, *e_r) + omega * dot(element.inner, *e_t) - with_time.outer[0])
                * per_mass
                + omega * dot(self.gravity, *e_t)
                + at.alpha * (along + 2.0 * rho * omega)
                + omega * (dot(at.housing_moves[1], *e_t) - omega * dot(at.housing.velocity, *e_r));
            let (outer, outer_by_time) = (element.outer, with_time.outer);
            for a in 0..2 {
                if let Some((_, place)) = jacobian.places[a] {
                    by_time[place] -= per_ring[0] * with_time.inner[a];
                }
                if let Some((_, place)) = jacobian.places[2 + a] {
                    by_time[place] += per_ring[1]
                        * ((outer_by_time[0] + omega * outer[1]) * e_r[a]
                            + (omega * outer[0] - outer_by_time[1]) * e_t[a]);
                }
            }
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
