//! The Jacobian in the plane: an element's state (u, w), by the rings' four coordinates, their velocities and time.

use super::arrow::{ArrowJacobian, ElementToFirstOrder};
use super::change::{Changing, Variation};
use super::fastest::BodyIndices;
use super::variation::changing_vector;
use crate::dynamics::contacts::{ElementMotion, Linearized, Shortcuts};
use crate::dynamics::parameters::{
    Bodies, Cells, Excitation, FramedKinematics, Kinematics, Model, PLANE_RINGS, PathMotion, RingState, prescribed_rate,
};
use crate::dynamics::quasi_static::{RingJacobian, stacked};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::Vector;
use crate::scene::{MOST_SENSORS, Motion};
use std::ops::{Add, Mul};

/// Derivatives: by u and w, by the rings' positions, by their velocities.
type ByState = Dual<f64, { 2 + 2 * PLANE_RINGS }>;
/// u', w' and the forces on the rings.
type Rates<const K: usize> = ([Dual<f64, K>; 1], [Dual<f64, K>; 1], [Dual<f64, K>; PLANE_RINGS]);

impl Model {
    /// As [`Model::linearize`] in the plane; `by_time` is the derivative by time.
    pub(super) fn linearize_in_plane<const B: usize>(
        &self,
        (excitation, tau): (&Excitation, f64),
        cells: &Cells,
        state: &[f64],
        (jacobian, by_time, time): (&mut ArrowJacobian<1, PLANE_RINGS, B>, &mut [f64], &mut Variation),
        shortcuts: &mut Shortcuts,
    ) {
        let host = |motion: Motion, prescribed| {
            if motion == Motion::Host { prescribed_rate(prescribed, tau) } else { RingState::default() }
        };
        let prescribed = [host(self.shaft.motion, &excitation.shaft), host(self.housing.motion, &excitation.housing)];
        let now = self.kinematics(excitation, tau, state);
        self.bodies_in_plane((excitation, tau), &now, prescribed, (jacobian, by_time));
        let masses = self.supports.inverse_masses();
        let inverse_masses = std::array::from_fn(|i| masses[i]);
        if self.elements_in_balance() {
            let found = self.elements_in_balance_to_first_order(cells, state, &now, shortcuts);
            for (whole, of_elements) in [&mut jacobian.by_position, &mut jacobian.by_velocity].into_iter().zip(found) {
                let mut corner = whole.fixed_view_mut::<PLANE_RINGS, PLANE_RINGS>(0, 0);
                corner += RingJacobian::from_diagonal(&inverse_masses.into()) * of_elements;
            }
            return;
        }
        let variable = |of: Vector, first: usize| Vector::from_fn(|axis, _| ByState::variable(of[axis], first + axis));
        let [(x_i, v_i), (x_o, v_o)] = [(&now.shaft, 2), (&now.housing, 4)]
            .map(|(ring, k)| (variable(ring.position, k), variable(ring.velocity, PLANE_RINGS + k)));
        time.go_on(&now, excitation, tau, prescribed);
        let prescribed = changing_vector(now.housing.velocity, time.housing.velocity);
        for j in 0..self.element_count {
            let going = self.changing_motion(j, state, &now, time, shortcuts);
            let at = going.mapped(Changing::value);
            let element = self.linearized(self.cells_of(cells, j), &at, shortcuts);
            let w = ByState::variable(state[self.layout.radial_velocity + j], 1);
            let path_rate = w - (v_o.x * at.e_r.x + v_o.y * at.e_r.y);
            let moving = ElementMotion { path_rate, offset: x_o - x_i, drift: v_o - v_i, ..at.by_path() };
            let (rates, accelerations, on_rings) = self.rates_to_first_order(&element, &moving, v_o);
            let going = self.rates_to_first_order(&element, &going, prescribed);
            let by_time_of = (going.0.map(|of| of.by[0]), going.1.map(|of| of.by[0]), going.2.map(|of| of.by[0]));
            let found = ElementToFirstOrder { rates, accelerations, on_rings, by_time: by_time_of };
            jacobian.put(j, &found, &inverse_masses, by_time);
        }
    }

    /// What an element does that moves like this, as the outer ring goes at `housing` (m/s).
    #[inline(always)]
    fn rates_to_first_order<const K: usize, E: Scalar>(
        &self,
        element: &Linearized,
        at: &ElementMotion<Dual<f64, K>, E>,
        housing: Vector<Dual<f64, K>>,
    ) -> Rates<K>
    where
        Dual<f64, K>: Mul<E, Output = Dual<f64, K>> + Add<E, Output = Dual<f64, K>>,
    {
        let forces = element.chained(at);
        let [shaft, housing_force] = forces.on_rings(at);
        let acceleration = self.radial_acceleration(at, forces.radial(), housing);
        ([at.path_rate], [acceleration], [shaft.x, shaft.y, housing_force.x, housing_force.y])
    }

    /// Forces of elements in balance at every instant on the rings, by the rings' positions and velocities: their
    /// elastic tangent, and what dampers hand on. That damping changes as rings move, by χ δ̇ of the tangent, is left
    /// out, and so is what elements make of the derivative by time: it is for the stability of explicit steps, and at
    /// rest, for the modes, there is none of either.
    fn elements_in_balance_to_first_order(
        &self,
        cells: &Cells,
        state: &[f64],
        now: &FramedKinematics,
        shortcuts: &mut Shortcuts,
    ) -> [RingJacobian; 2] {
        let (mut by_position, mut by_velocity) = (RingJacobian::zeros(), RingJacobian::zeros());
        for j in 0..self.element_count {
            let in_cells = self.cells_of(cells, j);
            let mut at = self.element_motion(j, PathMotion::at_rest(state[j]), now, shortcuts);
            for axis in 0..2 {
                let mut moving = at.mapped(Changing::constant);
                moving.drift[axis] = Changing::variable(at.drift[axis], 0);
                let found = self.in_balance(in_cells, at.path, &moving, shortcuts);
                let [shaft, housing] = found.element().on_rings();
                let rings = stacked(shaft, housing).map(|force| force.by[0]);
                by_velocity.column_mut(axis).zip_apply(&rings, |sum, force| *sum -= force);
                by_velocity.column_mut(2 + axis).zip_apply(&rings, |sum, force| *sum += force);
                if axis == 1 {
                    self.add_balanced(&found.elastic.values(), &mut by_position);
                }
                at.path = found.path.value;
            }
        }
        [by_position, by_velocity]
    }

    /// What does not come from contacts: supports, sensors, loads.
    fn bodies_in_plane<const B: usize>(
        &self,
        (excitation, tau): (&Excitation, f64),
        now: &FramedKinematics,
        [shaft, housing]: [RingState; 2],
        (jacobian, by_time): (&mut ArrowJacobian<1, PLANE_RINGS, B>, &mut [f64]),
    ) {
        let [by_position, by_velocity] = self.supports.accelerations_by_motion();
        jacobian.by_position.copy_from(by_position);
        jacobian.by_velocity.copy_from(by_velocity);
        by_time[2 * self.layout.radial_velocity..].fill(0.0);
        // Prescribed rings move the sensor; on the rings themselves nothing but their loads depends on time.
        let [velocity, acceleration] = Kinematics { shaft, housing, ..**now }.bodies();
        let loads = excitation.shaft_load.iter().chain(&excitation.housing_load).map(|load| load.rate_at(tau));
        let loads = Bodies::from_iterator(loads.chain([0.0; MOST_SENSORS]));
        let forces = self.supports.forces(&velocity, &acceleration) + loads;
        let rates = forces.component_mul(&self.supports.inverse_masses());
        for (body, rate) in jacobian.bodies.iter().zip(&rates) {
            if let Some(BodyIndices { velocity, .. }) = *body {
                by_time[velocity] = *rate;
            }
        }
    }
}
