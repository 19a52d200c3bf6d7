//! The Jacobian in space: a ball's state (u, v, w, w_z), by the rings' ten coordinates, their velocities and time.

use super::arrow::{ArrowJacobian, ElementToFirstOrder};
use super::fastest::BodyIndices;
use crate::contact::groove::{Axis, Spatial, plus};
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{
    COORDINATES, Cells, Excitation, FramedKinematics, Frames, Model, RINGS, RingInSpace, SPATIAL_BODIES, Space, Turn,
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

/// What all balls share while the Jacobian is put together.
struct Shared {
    rings: [RingInSpace<Changing>; 2],
    axes: [Axis<Changing>; 2],
    frames: Frames<ByMotion>,
    now: FramedKinematics,
    still: [RingInSpace; 2],
}

impl Model {
    /// As [`Model::linearize`] in space; `by_time` is the derivative by time.
    pub(super) fn linearize_in_space<const B: usize>(
        &self,
        space: &Space,
        (excitation, tau): (&Excitation, f64),
        cells: &Cells,
        state: &[f64],
        (jacobian, by_time): (&mut ArrowJacobian<2, RINGS, B>, &mut [f64]),
        shortcuts: &mut Shortcuts,
    ) {
        let shared = self.shared_in_space(excitation, tau, state);
        self.bodies_in_space(space, (excitation, tau), &shared, (jacobian, by_time));
        let inverse_inertia = std::array::from_fn(|i| space.inverse_inertia(i));
        if self.elements_in_balance() {
            let found = self.balls_in_balance_to_first_order(space, (cells, state), &shared, shortcuts);
            for (whole, of_balls) in [&mut jacobian.by_position, &mut jacobian.by_velocity].into_iter().zip(found) {
                for (i, row) in of_balls.iter().enumerate() {
                    (0..RINGS).for_each(|k| whole[(i, k)] += inverse_inertia[i] * row[k]);
                }
            }
            return;
        }
        let [[_, v], [w, w_z]] = jacobian.starts;
        for j in 0..self.element_count {
            let (at, turning) = self.changing_ball(j, &shared, shortcuts);
            let [u, v, w, w_z] =
                [(0, j), (1, v + j), (2, w + j), (3, w_z + j)].map(|(k, i)| Changing::variable(state[i], k));
            let ball = at.ball_between(self, [u, v], Ball::rates(at.e_r, [w, w_z], &at.rings[1]), &shared.axes);
            let time = (&turning, Changing::variable(0.0, TIME));
            let [inner, outer] = self.chained_on_ball(space, self.cells_of(cells, j), time, &ball, shortcuts);
            let [f_r, _, f_z] = plus(inner.force, outer.force);
            let gravity: Spatial<Changing> = [self.gravity.x, self.gravity.y, space.gravity].map(Changing::constant);
            let accelerations = ball.accelerations([f_r, f_z], self.per_mass_of(j), gravity);
            let [shaft, housing] = [ball.on_ring(&inner), ball.on_ring(&outer)];
            let on_rings: [Changing; RINGS] =
                std::array::from_fn(|i| if i < COORDINATES { shaft[i] } else { housing[i - COORDINATES] });
            let time = |of: &Changing| of.by[TIME];
            let going =
                (ball.rates.each_ref().map(time), accelerations.each_ref().map(time), on_rings.each_ref().map(time));
            let found = ElementToFirstOrder { rates: ball.rates, accelerations, on_rings, by_time: going };
            jacobian.put(j, &found, &inverse_inertia, by_time);
        }
    }

    /// Forces of balls in balance on the rings by the rings' positions, their elastic tangent, and by their velocities,
    /// what dampers hand on; as in the plane their part of the derivative by time is left out.
    fn balls_in_balance_to_first_order(
        &self,
        space: &Space,
        (cells, state): (&Cells, &[f64]),
        shared: &Shared,
        shortcuts: &mut Shortcuts,
    ) -> [[[f64; RINGS]; RINGS]; 2] {
        let v = self.layout.axial().map_or(0, |[v, _]| v);
        let [mut by_position, mut by_velocity] = [[[0.0; RINGS]; RINGS]; 2];
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
                for (row, force) in by_velocity.iter_mut().zip(found.forces.on_rings().as_flattened()) {
                    row[k] += force.by[0];
                }
            }
            let tangent =
                self.ball_tangent::<_, { 2 + RINGS }>(space, in_cells, there, &at.standing(), at.omega, shortcuts);
            for (sums, by) in by_position.iter_mut().zip(tangent.by_position) {
                sums.iter_mut().zip(by).for_each(|(sum, by)| *sum += by);
            }
        }
        [by_position, by_velocity]
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
        Shared { rings, axes, frames, now, still }
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

    /// What does not come from contacts: supports, sensors, gyroscopic couples, loads.
    fn bodies_in_space<const B: usize>(
        &self,
        space: &Space,
        (excitation, tau): (&Excitation, f64),
        shared: &Shared,
        (jacobian, by_time): (&mut ArrowJacobian<2, RINGS, B>, &mut [f64]),
    ) {
        let [speeds, speed_rates] = excitation.ring_speeds(tau);
        let (none, nothing) = ([0.0; SPATIAL_BODIES], [0.0; RINGS]);
        for k in 0..B {
            let mut unit = none;
            unit[k] = 1.0;
            let by_position = space.accelerations(&unit, &none, &nothing, [0.0; 2]);
            let by_velocity = space.accelerations(&none, &unit, &nothing, speeds);
            for i in 0..B {
                (jacobian.by_position[(i, k)], jacobian.by_velocity[(i, k)]) = (by_position[i], by_velocity[i]);
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
        let direct = space.accelerations(&moved, &going, &loads, speeds);
        // The gyroscopic couple changes with the speed.
        let [with, without] =
            [speed_rates, [0.0; 2]].map(|rates| space.accelerations(&none, &present, &nothing, rates));
        by_time[2 * self.layout.radial_velocity..].fill(0.0);
        for (i, body) in jacobian.bodies.iter().enumerate() {
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
