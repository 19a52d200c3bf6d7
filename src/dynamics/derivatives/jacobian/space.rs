//! The Jacobian in space: a ball's state (u, v, w, w_z), by the rings' ten coordinates and their velocities.

use super::smooth_balls::SmoothBalls;
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::derivatives::arrow::{ArrowJacobian, ElementToFirstOrder};
use crate::dynamics::element::views;
use crate::dynamics::parameters::{
    COORDINATES, Cells, Excitation, FramedKinematics, Model, RINGS, RingInSpace, SMOOTH, SPATIAL_BODIES, Space,
};
use crate::dynamics::spatial::{BallMotion, MOVING, accelerations, rates};
use crate::numerics::lanes::dispatch;
use crate::numerics::number::Dual;

/// Derivatives: by u, v, w and w_z, by the rings' positions, by their velocities.
type ByState = Dual<f64, { 4 + 2 * RINGS }>;

impl Model {
    /// As [`Model::linearize`] in space.
    pub(super) fn linearize_in_space<const B: usize>(
        &self,
        space: &Space,
        (excitation, tau): (&Excitation, f64),
        cells: &Cells,
        state: &[f64],
        jacobian: &mut ArrowJacobian<2, RINGS, B>,
        shortcuts: &mut Shortcuts,
    ) {
        bodies_in_space(space, excitation.ring_speeds(tau)[0], jacobian);
        let (now, still) = (self.kinematics(excitation, tau, state), self.rings_in_space(excitation, tau, state, None));
        let inverse_inertia = std::array::from_fn(|i| space.inverse_inertia(i));
        if self.elements_in_balance() {
            let found = self.balls_in_balance_to_first_order(space, (cells, state), (&now, &still), shortcuts);
            for (whole, of_balls) in [&mut jacobian.by_position, &mut jacobian.by_velocity].into_iter().zip(found) {
                for (i, row) in of_balls.iter().enumerate() {
                    (0..RINGS).for_each(|k| whole[(i, k)] += inverse_inertia[i] * row[k]);
                }
            }
            return;
        }
        let outer_tilts = still[1].position[3..] != [0.0; 2] || still[1].velocity[3..] != [0.0; 2];
        let is_smooth = |j: usize| !outer_tilts && self.cells_of(cells, j) == [[SMOOTH; 2]; 2];
        dispatch(SmoothBalls {
            model: self,
            space,
            now: &now,
            rings: &still,
            state,
            is_smooth: &is_smooth,
            inverse_inertia: &inverse_inertia,
            jacobian,
            shortcuts,
        });
        let variable =
            |of: &[f64; COORDINATES], first: usize| std::array::from_fn(|k| ByState::variable(of[k], first + k));
        let rings = [0, 1].map(|ring: usize| RingInSpace {
            position: variable(&still[ring].position, 4 + COORDINATES * ring),
            velocity: variable(&still[ring].velocity, 4 + RINGS + COORDINATES * ring),
        });
        let views = views(&rings);
        let gravity = [self.gravity.x, self.gravity.y, space.gravity].map(ByState::constant);
        let [[_, v], [w, w_z]] = jacobian.starts;
        for j in (0..self.element_count).filter(|&j| !is_smooth(j)) {
            let (at, _) = self.ball_motion(j, &now, &still, shortcuts);
            let moving = BallMotion { rings, ..at.lifted() };
            let slots = [j, v + j, w + j, w_z + j];
            let [u, v, w, w_z] = [0, 1, 2, 3].map(|k: usize| ByState::variable(state[slots[k]], k));
            let rates = rates(moving.e_r, [w, w_z], &rings[1]);
            let ball = moving.ball_moving(self, [u, v], rates);
            let in_cells = self.cells_of(cells, j);
            let [inner, outer] = self.chained_on_ball::<_, MOVING, _>(space, in_cells, &at, (&views, &ball), shortcuts);
            let total = [0, 2].map(|i: usize| inner.force[i] + outer.force[i]);
            let accelerations = accelerations(&ball, &rings[1], total, self.per_mass_of(j), gravity);
            let [shaft, housing] = [inner.on_ring(ball.e_r), outer.on_ring(ball.e_r)];
            let on_rings = std::array::from_fn(|i| if i < COORDINATES { shaft[i] } else { housing[i - COORDINATES] });
            jacobian.put(j, &ElementToFirstOrder { rates, accelerations, on_rings }, &inverse_inertia);
        }
    }

    /// Forces of balls in balance on the rings by the rings' positions, their elastic tangent, and by their velocities,
    /// what dampers hand on.
    fn balls_in_balance_to_first_order(
        &self,
        space: &Space,
        (cells, state): (&Cells, &[f64]),
        (now, rings): (&FramedKinematics, &[RingInSpace; 2]),
        shortcuts: &mut Shortcuts,
    ) -> [[[f64; RINGS]; RINGS]; 2] {
        let v = self.layout.axial().map_or(0, |[v, _]| v);
        let [mut by_position, mut by_velocity] = [[[0.0; RINGS]; RINGS]; 2];
        for j in 0..self.element_count {
            let in_cells = self.cells_of(cells, j);
            let (at, alpha) = self.ball_motion(j, now, rings, shortcuts);
            let mut there = [state[j], state[v + j]];
            // One after the other: with all at once each contact would be a quarter of a megabyte of code.
            for k in 0..RINGS {
                let mut moving = at.lifted::<1>();
                let rate = &mut moving.rings[k / COORDINATES].velocity[k % COORDINATES];
                *rate = Dual::variable(rate.value, 0);
                let alpha = Dual::constant(alpha);
                let found = self.ball_in_balance(space, in_cells, there, (&moving, alpha), shortcuts);
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
}

/// What does not come from contacts: supports, sensors, and the gyroscopic couples of rings that turn at these speeds
/// (rad/s).
fn bodies_in_space<const B: usize>(space: &Space, speeds: [f64; 2], jacobian: &mut ArrowJacobian<2, RINGS, B>) {
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
}
