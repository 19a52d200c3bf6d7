//! First-order change of forces for a small change of state and inputs, of rings in space: all that a ball meets is a
//! dual number along the change.

use super::small_change::{Changing, ForceChange, Going, Variation, changing};
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{
    COORDINATES, Cells, Excitation, Frame, FramedKinematics, Frames, Model, RINGS, RingInSpace, Space, Turn,
};
use crate::dynamics::spatial::{BallForces, BallMotion, accelerations};
use crate::numerics::number::Scalar;
use crate::numerics::plane::{Vector, turned};

impl Model {
    /// What ball `j` meets as all that changes.
    pub(in crate::dynamics) fn changing_ball_motion(
        &self,
        j: usize,
        now: &FramedKinematics,
        rings: &[RingInSpace; 2],
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> (BallMotion<Changing>, Changing) {
        let (at, alpha) = self.ball_motion(j, now, rings, shortcuts);
        let lead = self.lead_with(j, now.cage_angle(), &mut shortcuts.leads);
        let going = Going::of(lead, &now.cage, by);
        let e_t = turned(Vector::from(at.e_r));
        let frame = |i: usize| {
            let Turn { angle, speed } = at.frames.0[i];
            Turn { angle: changing(angle, by.frames[i][0]), speed: changing(speed, by.frames[i][1]) }
        };
        let change = &by.rings;
        let ring = |i: usize| RingInSpace {
            position: std::array::from_fn(|k| changing(rings[i].position[k], change[i].position[k])),
            velocity: std::array::from_fn(|k| changing(rings[i].velocity[k], change[i].velocity[k])),
        };
        let motion = BallMotion {
            element: j,
            e_r: [changing(at.e_r[0], e_t.x * going.turn), changing(at.e_r[1], e_t.y * going.turn)],
            angle: changing(at.angle, going.turn),
            omega: changing(at.omega, going.speed),
            rings: [ring(0), ring(1)],
            frames: Frames([0, 1, 2].map(frame)),
            curved: true,
            tried: false,
        };
        (motion, changing(alpha, going.alpha))
    }

    /// As [`Model::vary`] in space.
    pub(super) fn vary_in_space(
        &self,
        space: &Space,
        excitation: &Excitation,
        (cells, state): (&Cells, &[f64]),
        acceleration: Vector,
        (by, change): (&mut Variation, &mut ForceChange),
        shortcuts: &mut Shortcuts,
    ) {
        let now = self.kinematics(excitation, 0.0, state);
        let rings = self.rings_in_space(excitation, 0.0, state, None);
        let mut sums = [[0.0; COORDINATES]; 2];
        (change.cage_torque, change.shaft_torque, change.torque_by_acceleration) = (0.0, 0.0, Vector::zeros());
        for j in 0..self.element_count {
            let (at, alpha) = self.changing_ball_motion(j, &now, &rings, by, shortcuts);
            let found = self.changing_ball_forces(space, (cells, state), (&at, alpha), by, shortcuts);
            for (sums, forces) in sums.iter_mut().zip(found.on_rings()) {
                sums.iter_mut().zip(forces).for_each(|(sum, force)| *sum += force.by[0]);
            }
            let [inner, outer] = &found.contacts;
            (change.inner[j], change.outer[j]) = (inner.magnitude.by[0], outer.magnitude.by[0]);
            for side in 0..2 {
                let pushes = found.contacts[side].magnitude.value > 0.0;
                let meridian = found.contacts[side].normal;
                // The angle turns with the direction, whichever way that is counted.
                change.contact_angles[side][j] = if pushes { Changing::angle_of(meridian).by[0] } else { 0.0 };
            }
            let [f_r, _, f_z] = found.force();
            let [g_x, g_y] = [self.gravity.x, self.gravity.y].map(Changing::constant);
            let (per_mass, g_z) = (self.per_mass_of(j), Changing::constant(space.gravity));
            let [radial, axial] = accelerations(&found.ball, &at.rings[1], [f_r, f_z], per_mass, [g_x, g_y, g_z]);
            (change.path_rate[j], change.axial_rate[j]) = (found.ball.rate[0].by[0], found.ball.rate[1].by[0]);
            (change.radial_acceleration[j], change.axial_acceleration[j]) = (radial.by[0], axial.by[0]);
            let e_t = turned(Vector::from(at.e_r));
            let torque = self.torque_on_cage(
                j,
                e_t,
                [at.omega, alpha],
                [found.ball.at[0], found.ball.rate[0]],
                found.force()[1],
                acceleration,
            );
            change.cage_torque += torque.by[0];
            change.torque_by_acceleration -= e_t.map(|part| part.value * found.ball.rho.value * self.element_mass);
            for (frame, torque) in found.torques() {
                match frame {
                    Frame::Shaft => change.shaft_torque += torque.by[0],
                    Frame::Spin => change.cage_torque += torque.by[0],
                    Frame::Housing => {}
                }
            }
        }
        change.rings = sums;
    }

    /// Forces of a ball as all that it meets changes; of one in balance `by` is given the change of its place.
    pub(super) fn changing_ball_forces(
        &self,
        space: &Space,
        (cells, state): (&Cells, &[f64]),
        (at, alpha): (&BallMotion<Changing>, Changing),
        by: &mut Variation,
        shortcuts: &mut Shortcuts,
    ) -> BallForces<Changing> {
        let (j, [v, w_z]) = (at.element, self.layout.axial().unwrap_or_default());
        if self.elements_in_balance() {
            let place = [state[j], state[v + j]];
            let found = self.ball_in_balance(space, self.cells_of(cells, j), place, (at, alpha), shortcuts);
            let outer = &at.rings[1].velocity;
            let carried = at.e_r[0] * outer[0] + at.e_r[1] * outer[1];
            (by.path[j], by.axial[j]) = (found.place[0].by[0], found.place[1].by[0]);
            by.radial_velocity[j] = (found.rates[0] + carried).by[0];
            by.axial_velocity[j] = (found.rates[1] + outer[2]).by[0];
            return found.forces;
        }
        let ball = [
            changing(state[j], by.path[j]),
            changing(state[v + j], by.axial[j]),
            changing(state[self.layout.radial_velocity + j], by.radial_velocity[j]),
            changing(state[w_z + j], by.axial_velocity[j]),
        ];
        let ball = at.ball(self, ball);
        self.ball_forces(space, self.cells_of(cells, j), at, &ball, shortcuts)
    }

    /// Change of the forces on both rings by coordinates, of balls in balance.
    pub(in crate::dynamics) fn vary_rings_in_space(
        &self,
        space: &Space,
        (now, rings): (&FramedKinematics, &[RingInSpace; 2]),
        (cells, state): (&Cells, &[f64]),
        by: &mut Variation,
        shortcuts: &mut Shortcuts,
    ) -> [f64; RINGS] {
        let mut sums = [0.0; RINGS];
        for j in 0..self.element_count {
            let (at, alpha) = self.changing_ball_motion(j, now, rings, by, shortcuts);
            let found = self.changing_ball_forces(space, (cells, state), (&at, alpha), by, shortcuts);
            for (sum, force) in sums.iter_mut().zip(found.on_rings().as_flattened()) {
                *sum += force.by[0];
            }
        }
        sums
    }

    /// Change of the inner ring's tangent stiffness by its own coordinates, −1 times, for a small change at the instant
    /// τ = 0 of `excitation`; `None` in the plane.
    pub fn vary_stiffness_in_space(
        &self,
        excitation: &Excitation,
        (cells, state): (&Cells, &[f64]),
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> Option<[[f64; COORDINATES]; COORDINATES]> {
        let space = self.space.as_ref()?;
        let now = self.kinematics(excitation, 0.0, state);
        let rings = self.rings_in_space(excitation, 0.0, state, None);
        let [v, _] = self.layout.axial()?;
        let mut sum = [[0.0; COORDINATES]; COORDINATES];
        for j in 0..self.element_count {
            let (at, _) = self.changing_ball_motion(j, &now, &rings, by, shortcuts);
            let place = [changing(state[j], by.path[j]), changing(state[v + j], by.axial[j])];
            let (in_cells, omega) = (self.cells_of(cells, j), at.omega);
            let tangent =
                self.ball_tangent::<_, { 2 + COORDINATES }>(space, in_cells, place, &at.standing(), omega, shortcuts);
            for (row, by) in sum.iter_mut().zip(tangent.by_position) {
                row.iter_mut().zip(by).for_each(|(sum, by)| *sum += by.by[0]);
            }
        }
        Some(sum)
    }
}
