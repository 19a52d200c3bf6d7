//! First-order change of forces and accelerations for a small change of state and inputs.
//!
//! All that an element meets is a dual number along the change, and what contacts, balance and tangent stiffness make
//! of it comes out with its derivative: there is no text of their derivatives. An element's path changes at
//! u' = w − e_r·v_o; one in balance has its path where the balance is.
//!
//! With it the derivative of any output follows: by an input at fixed state, by an input through the static
//! equilibrium, and by time along the motion. Derivatives are those of the branch that each contact is in; at the
//! onset of a contact there are two.

use super::small_change::{Changing, ForceChange, Going, Variation, changing};
use crate::dynamics::contacts::{BodyTorque, ContactForces, ElementForces, ElementMotion, Shortcuts};
use crate::dynamics::parameters::{Cells, Excitation, Frame, FramedKinematics, Frames, Model, PathMotion, Turn};
use crate::dynamics::quasi_static::{RingJacobian, Rings, stacked};
use crate::numerics::plane::{Matrix, Vector};

impl Model {
    /// What element `j`, at path and absolute radial velocity of the state, meets as all that changes.
    pub(in crate::dynamics) fn changing_motion(
        &self,
        j: usize,
        state: &[f64],
        now: &FramedKinematics,
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> ElementMotion<Changing> {
        let w = state[self.layout.radial_velocity + j];
        let at = self.element_motion(j, PathMotion { path: state[j], rate: 0.0 }, now, shortcuts);
        let lead = self.lead_with(j, now.cage_angle(), &mut shortcuts.leads);
        let Going { turn, speed, alpha } = Going::of(lead, &now.cage, by);
        let frames = [0, 1, 2].map(|i| {
            let (Turn { angle, speed }, [d_angle, d_speed]) = (at.frames.0[i], by.frames[i]);
            Turn { angle: changing(angle, d_angle), speed: changing(speed, d_speed) }
        });
        let e_r = changing_vector(at.e_r, at.e_t * turn);
        let [inner, outer] = by.in_plane();
        let housing = changing_vector(now.housing.velocity, outer.velocity);
        ElementMotion {
            element: j,
            e_r,
            e_t: changing_vector(at.e_t, at.e_r * -turn),
            angle: changing(at.angle, turn),
            omega: changing(at.omega, speed),
            alpha: changing(at.alpha, alpha),
            path: changing(at.path, by.path[j]),
            path_rate: changing(w, by.radial_velocity[j]) - housing.dot(&e_r),
            offset: changing_vector(at.offset, outer.position - inner.position),
            drift: changing_vector(at.drift, outer.velocity - inner.velocity),
            frames: Frames(frames),
            films: at.films,
            film_speed: changing(at.film_speed, by.film_speed),
            curved: true,
        }
    }

    /// Change of the contact forces under `excitation` at τ = 0 for a small change `by`. `acceleration` is the outer
    /// ring's. Of elements in balance it puts the change of their paths into `by`.
    pub fn vary(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        acceleration: Vector,
        (by, change): (&mut Variation, &mut ForceChange),
        shortcuts: &mut Shortcuts,
    ) {
        if let Some(space) = &self.space {
            return self.vary_in_space(space, excitation, (cells, state), acceleration, (by, change), shortcuts);
        }
        let now = self.kinematics(excitation, 0.0, state);
        let mut rings = Rings::zeros();
        (change.cage_torque, change.shaft_torque, change.torque_by_acceleration) = (0.0, 0.0, Vector::zeros());
        for j in 0..self.element_count {
            let forces = self.changing_forces(j, cells, state, &now, by, shortcuts);
            let housing = changing_vector(now.housing.velocity, by.housing_velocity());
            let (at, ContactForces { inner, outer }) = (&forces.at, forces.forces);
            rings += on_rings(&forces);
            (change.inner[j], change.outer[j]) = (magnitude(&inner), magnitude(&outer));
            change.path_rate[j] = at.path_rate.by[0];
            change.radial_acceleration[j] = self.radial_acceleration(at, forces.forces.radial(), housing).by[0];
            let around = inner.y + outer.y;
            let ElementMotion { e_t, omega, alpha, path, path_rate, .. } = *at;
            let torque = self.torque_on_cage(j, e_t, [omega, alpha], [path, path_rate], around, acceleration);
            change.cage_torque += torque.by[0];
            change.torque_by_acceleration -= e_t.map(|part| part.value * forces.rho.value * self.mass_of(j));
            for BodyTorque { frame, torque } in forces.torques() {
                match frame {
                    Frame::Shaft => change.shaft_torque += torque.by[0],
                    Frame::Spin => change.cage_torque += torque.by[0],
                    Frame::Housing => {}
                }
            }
            if self.elements_in_balance() {
                let w = path_rate + housing.dot(&at.e_r);
                (by.path[j], by.radial_velocity[j]) = (path.by[0], w.by[0]);
            }
        }
        for (i, force) in rings.iter().enumerate() {
            change.rings[i / 2][i % 2] = *force;
        }
    }

    /// Forces on element `j`, in motion or in balance, as all that it meets changes.
    pub(super) fn changing_forces(
        &self,
        j: usize,
        cells: &Cells,
        state: &[f64],
        now: &FramedKinematics,
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> ElementForces<Changing> {
        let at = self.changing_motion(j, state, now, by, shortcuts);
        let cells = self.cells_of(cells, j);
        if self.elements_in_balance() {
            self.in_balance(cells, state[j], &at, shortcuts).element()
        } else {
            self.element_forces(self.own_contacts(j), cells, &at, shortcuts)
        }
    }

    /// Change of the forces on the rings (N), of elements in balance with their paths where these ask for it.
    pub(in crate::dynamics) fn vary_rings(
        &self,
        cells: &Cells,
        state: &[f64],
        now: &FramedKinematics,
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> Rings {
        let elements = 0..self.element_count;
        elements.map(|j| on_rings(&self.changing_forces(j, cells, state, now, by, shortcuts))).sum()
    }

    /// Change of the inner ring's elastic force by its own position, [`Model::ring_jacobian`]'s first block (N/m), for
    /// a small change at the instant τ = 0 of `excitation`.
    pub fn vary_stiffness(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> Matrix {
        let now = self.kinematics(excitation, 0.0, state);
        let mut jacobian = RingJacobian::<Changing>::zeros();
        for j in 0..self.element_count {
            let at = self.changing_motion(j, state, &now, by, shortcuts).standing();
            self.add_balanced(&self.linearized(self.cells_of(cells, j), &at, shortcuts), &mut jacobian);
        }
        Matrix::from_fn(|row, column| jacobian[(row, column)].by[0])
    }
}

pub(super) fn changing_vector(value: Vector, by: Vector) -> Vector<Changing> {
    value.zip_map(&by, changing)
}

/// Change of the forces on the rings (N).
fn on_rings(forces: &ElementForces<Changing>) -> Rings {
    let [shaft, housing] = forces.on_rings();
    stacked(shaft, housing).map(|force| force.by[0])
}

/// Change of a force's magnitude (N).
fn magnitude(force: &Vector<Changing>) -> f64 {
    use crate::numerics::number::Number;
    force.dot(force).sqrt().by[0]
}
