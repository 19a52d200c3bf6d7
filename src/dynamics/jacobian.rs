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
const DIFFERENCE: f64 = 1e-9;

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
}

/// One element's contacts to first order. Vectors are in x and y.
struct Linearized {
    e_r: [f64; 2],
    e_t: [f64; 2],
    /// f and its derivatives G, D.
    inner: [f64; 2],
    by_q: [[f64; 2]; 2],
    by_q_rate: [[f64; 2]; 2],
    /// (F_r, F_t), and by u, u' and time.
    outer: [f64; 2],
    outer_by_path: [f64; 2],
    outer_by_rate: [f64; 2],
    outer_by_time: [f64; 2],
    path_rate: f64,
    path_rate_by_time: f64,
}

/// What all elements share at one instant.
struct Instant {
    cage: (f64, f64),
    cage_angle: f64,
    omega: f64,
    alpha: f64,
    shaft: RingState,
    housing: RingState,
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
        let z = self.element_count;
        let at = self.instant(drive, tau, state);
        let per_mass = 1.0 / self.element_mass;
        let per_ring =
            [&self.shaft, &self.housing].map(|r| if r.motion == Motion::Internal { 1.0 / r.mass } else { 0.0 });
        self.support(drive, tau, &at, per_ring, jacobian, by_time);
        for j in 0..z {
            let (u, w) = (state[j], state[z + j]);
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
            by_time[z + j] = (dot(inner_by_time, *e_r) + omega * dot(element.inner, *e_t) - element.outer_by_time[0])
                * per_mass
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

    fn instant(&self, drive: &Drive, tau: f64, state: &[f64]) -> Instant {
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
        by_time[2 * self.element_count..].fill(0.0);
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

    fn linearized(&self, j: usize, cell: u32, u: f64, w: f64, at: &Instant) -> Linearized {
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

/// Second derivatives of an approach, and of its direction by the angle.
#[derive(Debug, Clone, Copy, Default)]
struct Bend {
    path_path: f64,
    path_angle: f64,
    angle_angle: f64,
    direction_by_angle: [f64; 2],
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
pub(crate) mod tests {
    use super::*;
    use crate::contact::near_defect::NearDefect;
    use crate::contact::rigid_path::RigidPath;
    use crate::dynamics::drive::Quadratic;
    use crate::dynamics::forces::Forces;
    use crate::scene::{Damping, Scene};

    /// A model with a defect, its rings moved as `motions` say, and something at work in everything that depends on time.
    pub(crate) fn lively(motions: [Motion; 2], damping: Damping, cage_angle: f64) -> (Model, Drive) {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/er16k-tb1.toml");
        let mut scene = Scene::from_toml(&std::fs::read_to_string(path).unwrap()).unwrap();
        scene.contact.damping = damping;
        for (ring, motion) in [&mut scene.shaft, &mut scene.housing].into_iter().zip(motions) {
            ring.motion = motion;
        }
        let profile = [(-2.7e-3, 0.0), (-2.6e-3, 1e-4), (2.0e-3, 1e-4), (2.7e-3, 0.0)];
        let (radius, raceway) = (0.5 * scene.bearing.element_diameter, scene.bearing.outer_raceway_radius());
        let model = Model::new(&scene, Some(NearDefect::Hertz(RigidPath::new(&profile, radius, raceway))));
        let place = |start: f64| [Quadratic([start, 2e-3, -3.0]), Quadratic([-start, -1e-3, 5.0])];
        let load = |start: f64| [Quadratic([start, 2e4, 1e6]), Quadratic([-900.0, -4e4, 2e6])];
        let drive = Drive {
            cage_start: cage_angle,
            cage: Quadratic([0.0, 250.0, 3e4]),
            shaft: place(-1e-6),
            housing: place(12e-6),
            shaft_load: load(100.0),
            housing_load: load(-30.0),
        };
        (model, drive)
    }

    /// Numbers between −1 and 1, always the same.
    pub(crate) fn noise(seed: u64) -> impl FnMut() -> f64 {
        let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        move || {
            (x ^= x << 13, x ^= x >> 7, x ^= x << 17);
            (x >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    /// A state in motion, the inner ring pushed 20 µm against the elements below.
    pub(crate) fn moving(model: &Model, drive: &Drive, seed: u64) -> (Vec<f64>, Vec<u32>) {
        let mut noise = noise(seed);
        let z = model.element_count;
        let mut state: Vec<f64> =
            (0..model.layout.len).map(|i| if model.layout.is_position(i) { 1e-6 } else { 2e-2 } * noise()).collect();
        let cells: Vec<u32> = (0..z).map(|j| model.cell_at(j, drive.cage_angle(0.0))).collect();
        if let Some(i) = model.layout.shaft {
            state[i + 1] -= 20e-6;
        }
        for j in 0..z {
            let rho = model.outer_centre_radius;
            let floor = -model.outer_approach(j, cells[j], 0.0, drive.cage_angle(0.0), rho).value;
            state[j] += floor + 6e-6;
        }
        (state, cells)
    }

    /// The whole matrix, rows by columns.
    pub(crate) fn whole(jacobian: &Jacobian, len: usize) -> Vec<Vec<f64>> {
        let z = jacobian.elements.len();
        let mut matrix = vec![vec![0.0; len]; len];
        let places = jacobian.places;
        for (j, block) in jacobian.elements.iter().enumerate() {
            matrix[j][z + j] = 1.0;
            (matrix[z + j][j], matrix[z + j][z + j]) = (block.by_path, block.by_velocity);
            for a in 0..2 {
                if let Some((x, v)) = places[a] {
                    (matrix[z + j][x], matrix[z + j][v]) = (-block.by_offset[a], block.by_shaft_velocity[a]);
                    (matrix[v][j], matrix[v][z + j]) = (block.rings_by_path[a], block.rings_by_velocity[a]);
                }
                if let Some((x, v)) = places[2 + a] {
                    (matrix[z + j][x], matrix[z + j][v]) = (block.by_offset[a], block.by_housing_velocity[a]);
                    (matrix[v][j], matrix[v][z + j]) = (block.rings_by_path[2 + a], block.rings_by_velocity[2 + a]);
                    matrix[j][v] = -block.e_r[a];
                }
            }
        }
        for i in 0..BODIES {
            let Some((x, v)) = places[i] else { continue };
            matrix[x][v] = 1.0;
            for k in 0..BODIES {
                let Some((x_k, v_k)) = places[k] else { continue };
                (matrix[v][x_k], matrix[v][v_k]) = (jacobian.by_position[i][k], jacobian.by_velocity[i][k]);
            }
        }
        matrix
    }

    pub(crate) const MOTIONS: [[Motion; 2]; 4] = [
        [Motion::Internal, Motion::Internal],
        [Motion::Host, Motion::Internal],
        [Motion::Internal, Motion::Host],
        [Motion::Host, Motion::Host],
    ];

    pub(crate) const DAMPINGS: [Damping; 3] =
        [Damping::HuntCrossley(0.0), Damping::HuntCrossley(5.0), Damping::Proportional(1e-5)];

    /// Which contacts push, which are derivatives' branches.
    fn branch(forces: &Forces) -> Vec<bool> {
        forces.inner_pushing.iter().chain(&forces.outer_pushing).map(|&p| p > 0.0).collect()
    }

    #[test]
    fn jacobian_and_time_derivative_equal_difference_quotients() {
        let (mut compared, mut left_out, mut near_defect) = (0, 0, 0);
        for (case, (motions, damping)) in
            MOTIONS.into_iter().flat_map(|m| DAMPINGS.into_iter().map(move |d| (m, d))).enumerate()
        {
            for angle in [-1.66, -1.58, -1.5, 0.3] {
                let (model, drive) = lively(motions, damping, angle);
                let (state, cells) = moving(&model, &drive, case as u64 + 1);
                near_defect += cells.iter().filter(|&&c| c != SMOOTH).count();
                let len = model.layout.len;
                let (mut jacobian, mut by_time) = (Jacobian::new(&model), vec![0.0; len]);
                let tau = 1e-5;
                model.linearize(&drive, tau, &cells, &state, &mut jacobian, &mut by_time);
                let matrix = whole(&jacobian, len);
                let mut forces = Forces::new(model.element_count);
                let mut at = |tau: f64, state: &[f64]| {
                    let mut out = vec![0.0; len];
                    model.derivative(&drive, tau, &cells, state, &mut out, &mut forces);
                    (out, branch(&forces))
                };
                let (here, pushing) = at(tau, &state);
                let largest = here.iter().fold(0.0f64, |m, f| m.max(f.abs()));
                for k in 0..=len {
                    let h = if k == len {
                        1e-9
                    } else if model.layout.is_position(k) {
                        3e-11
                    } else {
                        1e-6
                    };
                    let moved = |sign: f64| {
                        let mut moved = state.clone();
                        if k < len {
                            moved[k] += sign * h;
                        }
                        (tau + if k == len { sign * h } else { 0.0 }, moved)
                    };
                    let ((t_a, a), (t_b, b)) = (moved(-1.0), moved(1.0));
                    let ((before, branch_before), (after, branch_after)) = (at(t_a, &a), at(t_b, &b));
                    if branch_before != pushing || branch_after != pushing {
                        left_out += 1;
                        continue;
                    }
                    for i in 0..len {
                        let quotient = (after[i] - before[i]) / (2.0 * h);
                        let found = if k == len { by_time[i] } else { matrix[i][k] };
                        // Rounding of the largest terms over the difference; truncation (h/δ)² and second derivatives 1e-6.
                        let rounding = 1e-14 * largest / h;
                        assert!(
                            (found - quotient).abs() <= 2e-6 * quotient.abs() + rounding,
                            "{motions:?} {damping:?} at {angle}: ∂({})/∂({}) = {found:e}, quotient {quotient:e}",
                            model.layout.name(i),
                            if k == len { "t".to_owned() } else { model.layout.name(k) },
                        );
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 10_000 && left_out < 20 && near_defect > 30, "{compared} {left_out} {near_defect}");
    }
}
