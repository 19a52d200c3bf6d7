//! How forces, torques and paths change with state and inputs where elements are in balance at every instant: central
//! differences along the change, every element in balance on either side of it.
//!
//! Everything that an element exerts follows from rings, cage and frames at one instant, damping included, so that one
//! rule covers every change. Differences are over a nanometre; what they leave out is (1 nm/δ)², 1e-7 for a contact of
//! 5 µm, and what rounding leaves is 1e-9.

use crate::dynamics::contacts::Linearized;
use crate::dynamics::derivatives::variation::{ForceChange, Variation};
use crate::dynamics::parameters::{CageState, Cells, Excitation, Frame, FramedKinematics, Model};
use crate::dynamics::quasi_static::{BodyTorque, InBalance, RingJacobian, Rings, stacked};
use crate::numerics::plane::{Vector, turned};

/// Farthest that rings are moved apart (m), and the way along the raceway by which cage and frames are turned (m).
const WAY: f64 = 1e-9;
/// Largest change of velocities (m/s), of rings and along the raceway.
const VELOCITY: f64 = 1e-4;

/// What is exerted at one instant, and where elements are.
struct Sample {
    rings: Rings,
    cage_torque: f64,
    shaft_torque: f64,
    /// Inner force, outer force, path and radial velocity of each element.
    elements: Vec<[f64; 4]>,
}

impl Model {
    /// As [`Model::vary`] of elements in balance; puts the change of their paths into `by`.
    pub fn vary_in_balance(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        acceleration: Vector,
        by: &mut Variation,
        change: &mut ForceChange,
    ) {
        let now = self.kinematics(excitation, 0.0, state);
        let found = self.difference(cells, state, &now, acceleration, by);
        change.shaft = Vector::new(found.rings[0], found.rings[1]);
        change.housing = Vector::new(found.rings[2], found.rings[3]);
        (change.cage_torque, change.shaft_torque) = (found.cage_torque, found.shaft_torque);
        change.torque_by_acceleration = Vector::zeros();
        for (j, &[inner, outer, path, radial_velocity]) in found.elements.iter().enumerate() {
            (change.inner[j], change.outer[j]) = (inner, outer);
            (by.path[j], by.radial_velocity[j]) = (path, radial_velocity);
            let u = self.balanced_path(j, self.cells_of(cells, j), state[j], &now).path;
            let e_t = turned(self.direction(j, &now.cage));
            change.torque_by_acceleration -= e_t * ((self.outer_centre_radius + u) * self.element_mass);
        }
    }

    /// As [`Model::vary_equilibrium`] of elements in balance, whose paths follow in [`Model::vary_in_balance`].
    pub(in crate::dynamics) fn vary_equilibrium_in_balance(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        loads: Rings,
        by: &mut Variation,
    ) -> Option<()> {
        let now = self.kinematics(excitation, 0.0, state);
        let none = Vector::zeros();
        let force = loads + self.difference(cells, state, &now, none, by).rings;
        let mut jacobian = RingJacobian::zeros();
        for axis in 0..2 {
            let mut moved = Variation::new(self.element_count);
            moved.housing.position[axis] = 1.0;
            let by_offset = self.difference(cells, state, &now, none, &moved).rings;
            jacobian.set_column(axis, &-by_offset);
            jacobian.set_column(2 + axis, &by_offset);
        }
        by.move_rings(&self.balancing_motion(&jacobian, force)?);
        Some(())
    }

    /// The change by central differences.
    fn difference(
        &self,
        cells: &Cells,
        state: &[f64],
        now: &FramedKinematics,
        acceleration: Vector,
        by: &Variation,
    ) -> Sample {
        let share = self.share_of(by);
        let mut sample = self.sample(cells, state, &moved(now, by, share), acceleration);
        let before = self.sample(cells, state, &moved(now, by, -share), acceleration);
        let per = 1.0 / (2.0 * share);
        sample.rings = (sample.rings - before.rings) * per;
        sample.cage_torque = (sample.cage_torque - before.cage_torque) * per;
        sample.shaft_torque = (sample.shaft_torque - before.shaft_torque) * per;
        for (after, before) in sample.elements.as_flattened_mut().iter_mut().zip(before.elements.as_flattened()) {
            *after = (*after - before) * per;
        }
        sample
    }

    /// The share of a change that moves nothing farther than differences may.
    fn share_of(&self, by: &Variation) -> f64 {
        let turns = by.frames.iter().map(|turn| turn[0].abs()).fold(by.cage_angle.abs(), f64::max);
        let speeds = by.frames.iter().map(|turn| turn[1].abs()).fold(by.cage_speed.abs(), f64::max);
        let way = by.offset().amax().max(turns * self.outer_centre_radius);
        let velocity = by.drift().amax().max(by.housing.velocity.amax()).max(speeds * self.outer_centre_radius);
        let most = (way / WAY).max(velocity / VELOCITY);
        if most > 0.0 { 1.0 / most } else { 1.0 }
    }

    /// What is exerted where rings, cage and frames are as they are `now`, the outer ring having this acceleration.
    fn sample(&self, cells: &Cells, state: &[f64], now: &FramedKinematics, acceleration: Vector) -> Sample {
        let count = self.element_count;
        let (rings, elements) = (Rings::zeros(), Vec::with_capacity(count));
        let mut sample = Sample { rings, cage_torque: 0.0, shaft_torque: 0.0, elements };
        for j in 0..count {
            let found = self.in_balance(j, self.cells_of(cells, j), state[j], now);
            let exerted = found.exerted();
            let [shaft, housing] = exerted.rings;
            sample.rings += stacked(shaft, housing);
            sample.cage_torque += self.torque_on_cage(j, &found, now, acceleration);
            for BodyTorque { frame, torque } in exerted.torques {
                match frame {
                    Frame::Shaft => sample.shaft_torque += torque,
                    Frame::Spin => sample.cage_torque += torque,
                    Frame::Housing => {}
                }
            }
            let radial_velocity = found.path_rate + now.housing.velocity.dot(&found.elastic.e_r);
            sample.elements.push([found.inner.norm(), found.outer.norm(), found.path, radial_velocity]);
        }
        sample
    }

    /// As [`Model::cage_torque`], of one element and without the torque about its own axis.
    fn torque_on_cage(&self, j: usize, found: &InBalance, now: &FramedKinematics, acceleration: Vector) -> f64 {
        let Linearized { e_t, rho, omega, .. } = found.elastic;
        let [_, alpha] = self.element_speed(j, &now.cage);
        let inertia = (acceleration - self.gravity).dot(&e_t) + 2.0 * found.path_rate * omega + rho * alpha;
        rho * (found.inner.dot(&e_t) + found.outer.y - self.element_mass * inertia)
    }
}

/// Rings, cage and frames after a share of a change.
fn moved(now: &FramedKinematics, by: &Variation, share: f64) -> FramedKinematics {
    let mut moved = *now;
    let cage = &now.cage;
    moved.cage = CageState {
        speed: cage.speed + share * by.cage_speed,
        acceleration: cage.acceleration,
        tau: cage.tau,
        ..CageState::at_rest(cage.angle + share * by.cage_angle)
    };
    for (ring, by) in [(&mut moved.motion.shaft, &by.shaft), (&mut moved.motion.housing, &by.housing)] {
        ring.position += by.position * share;
        ring.velocity += by.velocity * share;
    }
    for (turn, by) in moved.frames.0.iter_mut().zip(by.frames) {
        turn.angle += share * by[0];
        turn.speed += share * by[1];
    }
    moved
}
