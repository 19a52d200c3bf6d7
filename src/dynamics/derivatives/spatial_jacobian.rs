//! The Jacobian of the right-hand side in space, damping included, and its derivative by time.
//!
//! A ball couples to the rings and to no other ball: an arrow as in the plane, with blocks of four states (u, v, w,
//! w_z) and the rings' ten coordinates. All derivatives are those of one text over dual numbers: by the ball's states,
//! the rings' positions and velocities, and time.

use super::fastest::{BodyIndices, Fastest};
use crate::contact::groove::{Axis, Spatial, plus};
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{
    COORDINATES, Cells, Excitation, Frames, Layout, Model, RINGS, RingInSpace, SPATIAL_BODIES, Space, SpatialBodies,
    Turn,
};
use crate::dynamics::spatial::{Ball, BallMotion, MOVING, axis_of};
use crate::numerics::number::Dual;
use crate::numerics::plane::turned;
use crate::scene::Motion;

/// Derivatives: by u, v, w and w_z, by the rings' positions, by their velocities, by time.
type Changing = Dual<f64, { 4 + 2 * RINGS + 1 }>;
/// Derivatives by what a contact depends on.
type ByMotion = Dual<f64, MOVING>;
const TIME: usize = 4 + 2 * RINGS;

/// One ball's rows and columns.
#[derive(Debug, Clone, Copy)]
pub struct SpatialBlock {
    /// Direction e_r: u' = w − e_r·ẋ_o, v' = w_z − ż_o.
    pub e_r: [f64; 2],
    /// ∂(w', w_z')/∂(u, v, w, w_z)
    pub by_ball: [[f64; 4]; 2],
    /// ∂(w', w_z')/∂(rings' positions)
    pub by_position: [[f64; RINGS]; 2],
    /// ∂(w', w_z')/∂(rings' velocities)
    pub by_velocity: [[f64; RINGS]; 2],
    /// ∂(rings' accelerations)/∂(u, v, w, w_z)
    pub rings_by_ball: [[f64; 4]; RINGS],
}

/// The Jacobian in its blocks.
#[derive(Debug, Clone)]
pub struct SpatialJacobian {
    /// The balls' blocks; none of balls in balance.
    pub balls: Vec<SpatialBlock>,
    /// Accelerations of the bodies by their positions.
    pub by_position: [SpatialBodies; SPATIAL_BODIES],
    /// Accelerations of the bodies by their velocities.
    pub by_velocity: [SpatialBodies; SPATIAL_BODIES],
    /// Where each body is in the state.
    pub body_indices: [Option<BodyIndices>; SPATIAL_BODIES],
    /// Where v, w and w_z begin in the state.
    pub starts: [usize; 3],
}

impl SpatialBlock {
    const NONE: Self = Self {
        e_r: [0.0; 2],
        by_ball: [[0.0; 4]; 2],
        by_position: [[0.0; RINGS]; 2],
        by_velocity: [[0.0; RINGS]; 2],
        rings_by_ball: [[0.0; 4]; RINGS],
    };

    /// u' and v' by the rings' velocities: e_r·ẋ_o and ż_o, taken off.
    pub fn carried(&self, velocities: &[f64]) -> [f64; 2] {
        let outer = &velocities[COORDINATES..];
        [self.e_r[0] * outer[0] + self.e_r[1] * outer[1], outer[2]]
    }
}

impl SpatialJacobian {
    /// Room for a model's Jacobian.
    pub(super) fn new(model: &Model, space: &Space) -> Self {
        let layout = &model.layout;
        let mut body_indices = [None; SPATIAL_BODIES];
        for (ring, start) in [layout.shaft, layout.housing].into_iter().enumerate() {
            for k in (0..COORDINATES).filter(|k| space.free[COORDINATES * ring + k]) {
                body_indices[COORDINATES * ring + k] = start.map(|start| BodyIndices {
                    position: start + Layout::POSITIONS[k],
                    velocity: start + Layout::VELOCITIES[k],
                });
            }
        }
        for (k, i) in layout.sensor_indices().enumerate() {
            body_indices[RINGS + k] = Some(BodyIndices { position: i, velocity: i + 1 });
        }
        let [v, w_z] = layout.axial().unwrap_or_default();
        let count = if model.elements_in_balance() { 0 } else { model.element_count };
        let none = [[0.0; SPATIAL_BODIES]; SPATIAL_BODIES];
        Self {
            balls: vec![SpatialBlock::NONE; count],
            by_position: none,
            by_velocity: none,
            body_indices,
            starts: [v, layout.radial_velocity, w_z],
        }
    }

    /// As [`Jacobian::fastest`](super::Jacobian::fastest): each ball along and across what its stiffness and its
    /// damping are largest along, and each body.
    pub(super) fn fastest(&self) -> Fastest {
        let mut fastest = Fastest::default();
        for block in &self.balls {
            let part = |from: usize| block.by_ball.map(|row| [row[from], row[from + 1]]);
            let (stiff, damped) = (part(0), part(2));
            for along in [principal(stiff), principal(damped)] {
                for n in [along, [-along[1], along[0]]] {
                    fastest.consider(form(stiff, n), form(damped, n));
                }
            }
        }
        for i in (0..SPATIAL_BODIES).filter(|&i| self.body_indices[i].is_some()) {
            fastest.consider(self.by_own_position(i), self.by_velocity[i][i]);
        }
        fastest
    }

    /// Acceleration of a body by its own position, all else standing still: where the outer ring moves and a ball does
    /// not, its u and v change.
    fn by_own_position(&self, body: usize) -> f64 {
        let alone = self.by_position[body][body];
        if !(COORDINATES..COORDINATES + 3).contains(&body) {
            return alone;
        }
        let mut moved = [0.0; RINGS];
        moved[body] = 1.0;
        self.balls.iter().fold(alone, |sum, block| {
            let ([u, v], row) = (block.carried(&moved), block.rings_by_ball[body]);
            sum - row[0] * u - row[1] * v
        })
    }

    /// The whole matrix ∂(state')/∂(state), rows by columns, of a state of `len` slots; for studies.
    pub(super) fn matrix(&self, len: usize) -> Vec<Vec<f64>> {
        let mut matrix = vec![vec![0.0; len]; len];
        let bodies = || self.body_indices.iter().enumerate().filter_map(|(i, body)| body.map(|body| (i, body)));
        let [v, w, w_z] = self.starts;
        for (j, block) in self.balls.iter().enumerate() {
            let states = [j, v + j, w + j, w_z + j];
            (matrix[j][states[2]], matrix[states[1]][states[3]]) = (1.0, 1.0);
            for k in 0..2 {
                for (column, by) in states.into_iter().zip(block.by_ball[k]) {
                    matrix[states[2 + k]][column] = by;
                }
            }
            for (i, body) in bodies().filter(|(i, _)| *i < RINGS) {
                let mut unit = [0.0; RINGS];
                unit[i] = 1.0;
                for (k, carried) in block.carried(&unit).into_iter().enumerate() {
                    matrix[states[k]][body.velocity] -= carried;
                    matrix[states[2 + k]][body.position] = block.by_position[k][i];
                    matrix[states[2 + k]][body.velocity] = block.by_velocity[k][i];
                }
                for (column, by) in states.into_iter().zip(block.rings_by_ball[i]) {
                    matrix[body.velocity][column] = by;
                }
            }
        }
        for (i, body) in bodies() {
            matrix[body.position][body.velocity] = 1.0;
            for (k, by) in bodies() {
                matrix[body.velocity][by.position] = self.by_position[i][k];
                matrix[body.velocity][by.velocity] = self.by_velocity[i][k];
            }
        }
        matrix
    }
}

/// nᵀ M n
fn form(m: [[f64; 2]; 2], n: [f64; 2]) -> f64 {
    n[0] * (m[0][0] * n[0] + m[0][1] * n[1]) + n[1] * (m[1][0] * n[0] + m[1][1] * n[1])
}

/// Direction along which the symmetric part of a matrix is largest in magnitude.
fn principal(m: [[f64; 2]; 2]) -> [f64; 2] {
    let (mean, half, off) = (0.5 * (m[0][0] + m[1][1]), 0.5 * (m[0][0] - m[1][1]), 0.5 * (m[0][1] + m[1][0]));
    let apart = (half * half + off * off).sqrt();
    // Of the eigenvalues mean ± apart that of the larger magnitude.
    let eigenvalue = if mean >= 0.0 { mean + apart } else { mean - apart };
    let (a, b) = ([off, eigenvalue - m[0][0]], [eigenvalue - m[1][1], off]);
    let n = if form([[1.0, 0.0], [0.0, 1.0]], a) >= form([[1.0, 0.0], [0.0, 1.0]], b) { a } else { b };
    let length = (n[0] * n[0] + n[1] * n[1]).sqrt();
    if length > 0.0 { [n[0] / length, n[1] / length] } else { [1.0, 0.0] }
}

/// What all balls share while the Jacobian is put together.
struct Shared {
    rings: [RingInSpace<Changing>; 2],
    axes: [Axis<Changing>; 2],
    frames: Frames<ByMotion>,
    now: crate::dynamics::parameters::FramedKinematics,
    still: [RingInSpace; 2],
    /// Forces on the rings by the rings' positions, velocities and by time.
    forces: [[f64; 2 * RINGS + 1]; RINGS],
}

impl Model {
    /// As [`Model::linearize`] in space; `by_time` is the derivative by time.
    pub(super) fn linearize_in_space(
        &self,
        space: &Space,
        (excitation, tau): (&Excitation, f64),
        cells: &Cells,
        state: &[f64],
        (jacobian, by_time): (&mut SpatialJacobian, &mut [f64]),
        shortcuts: &mut Shortcuts,
    ) {
        let mut shared = self.shared_in_space(excitation, tau, state);
        if self.elements_in_balance() {
            self.balls_in_balance_to_first_order(space, (cells, state), &mut shared, shortcuts);
            return self.bodies_in_space(space, (excitation, tau), state, &shared, (jacobian, by_time));
        }
        let [v, w, w_z] = jacobian.starts;
        for j in 0..self.element_count {
            let (at, turning) = self.changing_ball(j, &shared, shortcuts);
            let states = [j, v + j, w + j, w_z + j];
            let [u, v, w, w_z] = [0, 1, 2, 3].map(|k| Changing::variable(state[states[k]], k));
            let ball = at.ball_between(self, [u, v], Ball::rates(at.e_r, [w, w_z], &at.rings[1]), &shared.axes);
            let time = (&turning, Changing::variable(0.0, TIME));
            let [inner, outer] = self.chained_on_ball(space, self.cells_of(cells, j), time, &ball, shortcuts);
            let [f_r, _, f_z] = plus(inner.force, outer.force);
            let gravity: Spatial<Changing> = [self.gravity.x, self.gravity.y, space.gravity].map(Changing::constant);
            let rates = ball.accelerations([f_r, f_z], self.per_mass_of(j), gravity);
            let part = |of: &Changing, from: usize| std::array::from_fn(|i| of.by[from + i]);
            let on_rings = [ball.on_ring(&inner), ball.on_ring(&outer)];
            let block = &mut jacobian.balls[j];
            block.e_r = ball.e_r.map(|e| e.value);
            block.by_ball = rates.map(|rate| std::array::from_fn(|i| rate.by[i]));
            block.by_position = rates.map(|rate| part(&rate, 4));
            block.by_velocity = rates.map(|rate| part(&rate, 4 + RINGS));
            for (i, force) in on_rings.as_flattened().iter().enumerate() {
                block.rings_by_ball[i] = std::array::from_fn(|k| space.inverse_inertia(i) * force.by[k]);
                for (sum, by) in shared.forces[i].iter_mut().zip(&force.by[4..]) {
                    *sum += by;
                }
            }
            for (slot, rate) in states.into_iter().zip(ball.rates.into_iter().chain(rates)) {
                by_time[slot] = rate.by[TIME];
            }
        }
        self.bodies_in_space(space, (excitation, tau), state, &shared, (jacobian, by_time));
    }

    /// What balls in balance make of the bodies' part: by positions their elastic tangent, by velocities what dampers
    /// hand on; as in the plane their part of the derivative by time is left out.
    fn balls_in_balance_to_first_order(
        &self,
        space: &Space,
        (cells, state): (&Cells, &[f64]),
        shared: &mut Shared,
        shortcuts: &mut Shortcuts,
    ) {
        let v = self.layout.axial().map_or(0, |[v, _]| v);
        for j in 0..self.element_count {
            let in_cells = self.cells_of(cells, j);
            let at = self.ball_motion(j, &shared.now, &shared.still, shortcuts);
            let mut there = [state[j], state[v + j]];
            // One after the other: with all at once each contact would be a quarter of a megabyte of code.
            for k in 0..RINGS {
                let mut moving = at.lifted::<1>();
                let rate = &mut moving.rings[k / COORDINATES].velocity[k % COORDINATES];
                *rate = Dual::variable(rate.value, 0);
                let still = Dual::constant(0.0);
                let found = self.ball_in_balance(space, in_cells, there, (&moving, still), shortcuts);
                there = found.place.map(|number| number.value);
                for (i, force) in found.forces.on_rings().as_flattened().iter().enumerate() {
                    shared.forces[i][RINGS + k] += force.by[0];
                }
            }
            let tangent =
                self.ball_tangent::<_, { 2 + RINGS }>(space, in_cells, there, &at.standing(), at.omega, shortcuts);
            for (sums, by) in shared.forces.iter_mut().zip(tangent.by_position) {
                sums.iter_mut().zip(by).for_each(|(sum, by)| *sum += by);
            }
        }
    }

    /// Rings and frames with what they change by.
    fn shared_in_space(&self, excitation: &Excitation, tau: f64, state: &[f64]) -> Shared {
        let (now, still) = (self.kinematics(excitation, tau, state), self.rings_in_space(excitation, tau, state, None));
        let mut rings =
            [RingInSpace { position: [Changing::constant(0.0); 5], velocity: [Changing::constant(0.0); 5] }; 2];
        let prescribed = self.prescribed_rates(excitation, tau);
        for ring in 0..2 {
            for k in 0..COORDINATES {
                let i = COORDINATES * ring + k;
                let (mut x, mut v) = (
                    Changing::variable(still[ring].position[k], 4 + i),
                    Changing::variable(still[ring].velocity[k], 4 + RINGS + i),
                );
                (x.by[TIME], v.by[TIME]) = (prescribed[ring].position[k], prescribed[ring].velocity[k]);
                (rings[ring].position[k], rings[ring].velocity[k]) = (x, v);
            }
        }
        let rates = excitation.frame_rates(tau);
        let frames = Frames([0, 1, 2].map(|i| {
            let Turn { angle, speed } = now.frames.0[i];
            Turn { angle: by_time(angle, rates[i][0]), speed: by_time(speed, rates[i][1]) }
        }));
        let axes = [axis_of(&rings[0]), axis_of(&rings[1])];
        Shared { rings, axes, frames, now, still, forces: [[0.0; 2 * RINGS + 1]; RINGS] }
    }

    /// Velocity and acceleration of each ring as the host prescribes them; 0 of one that it does not move.
    fn prescribed_rates(&self, excitation: &Excitation, tau: f64) -> [RingInSpace; 2] {
        [(0, &self.shaft), (1, &self.housing)].map(|(ring, of)| match of.motion {
            Motion::Host => excitation.prescribed_rates(ring, tau),
            Motion::Internal | Motion::Fixed => RingInSpace::default(),
        })
    }

    /// Ball `j` as all changes, and what turns with time as contacts are to know it.
    fn changing_ball(
        &self,
        j: usize,
        shared: &Shared,
        shortcuts: &mut Shortcuts,
    ) -> (BallMotion<Changing>, BallMotion<ByMotion>) {
        let at = self.ball_motion(j, &shared.now, &shared.still, shortcuts);
        let lead = self.lead_with(j, shared.now.cage_angle(), &mut shortcuts.leads);
        let [omega, alpha] = lead.speed(&shared.now.cage);
        let e_t = turned(at.e_r.into());
        let changing = BallMotion {
            e_r: [by_time(at.e_r[0], e_t.x * omega), by_time(at.e_r[1], e_t.y * omega)],
            omega: by_time(omega, alpha),
            rings: shared.rings,
            ..at.lifted()
        };
        let (angle, omega) = (by_time(at.angle, omega), by_time(omega, alpha));
        (changing, BallMotion { angle, omega, frames: shared.frames, ..at.lifted() })
    }

    /// The bodies' own part, once the balls' forces are there.
    fn bodies_in_space(
        &self,
        space: &Space,
        (excitation, tau): (&Excitation, f64),
        state: &[f64],
        shared: &Shared,
        (jacobian, by_time): (&mut SpatialJacobian, &mut [f64]),
    ) {
        let [speeds, speed_rates] = excitation.ring_speeds(tau);
        let (none, nothing) = ([0.0; SPATIAL_BODIES], [0.0; RINGS]);
        for k in 0..SPATIAL_BODIES {
            let mut unit = none;
            unit[k] = 1.0;
            let column =
                |from: usize| std::array::from_fn(|i| if k < RINGS { shared.forces[i][from + k] } else { 0.0 });
            let by_position = space.accelerations(&unit, &none, &column(0), [0.0; 2]);
            let by_velocity =
                space.accelerations(&none, &unit, &if k < RINGS { column(RINGS) } else { nothing }, speeds);
            for i in 0..SPATIAL_BODIES {
                (jacobian.by_position[i][k], jacobian.by_velocity[i][k]) = (by_position[i], by_velocity[i]);
            }
        }
        let prescribed = self.prescribed_rates(excitation, tau);
        let (mut moved, mut going, mut present) = (none, none, none);
        for (ring, rates) in prescribed.iter().enumerate() {
            moved[COORDINATES * ring..][..COORDINATES].copy_from_slice(&rates.position);
            going[COORDINATES * ring..][..COORDINATES].copy_from_slice(&rates.velocity);
            present[COORDINATES * ring..][..COORDINATES].copy_from_slice(&shared.still[ring].velocity);
        }
        let [_, loads] = excitation.loads_in_space(tau);
        let acting = std::array::from_fn(|i| loads[i] + shared.forces[i][2 * RINGS]);
        let direct = space.accelerations(&moved, &going, &acting, speeds);
        // The gyroscopic couple changes with the speed.
        let [with, without] =
            [speed_rates, [0.0; 2]].map(|rates| space.accelerations(&none, &present, &nothing, rates));
        by_time[2 * self.layout.radial_velocity..state.len()].fill(0.0);
        for (i, body) in jacobian.body_indices.iter().enumerate() {
            if let Some(BodyIndices { velocity, .. }) = *body {
                by_time[velocity] = direct[i] + (with[i] - without[i]);
            }
        }
    }
}

/// A number that changes by time alone, the last of what it might change by.
fn by_time<const K: usize>(value: f64, rate: f64) -> Dual<f64, K> {
    let mut found = Dual::constant(value);
    found.by[K - 1] = rate;
    found
}
