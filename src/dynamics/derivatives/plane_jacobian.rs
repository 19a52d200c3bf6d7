//! The Jacobian in the plane: an element's state (u, w), by the rings' four coordinates, their velocities and time.

use super::arrow::{ArrowJacobian, ElementToFirstOrder};
use super::change::Changing;
use super::fastest::BodyIndices;
use crate::dynamics::contacts::{ElementMotion, Shortcuts};
use crate::dynamics::parameters::{
    Bodies, Cells, Excitation, FramedKinematics, Frames, Kinematics, Model, PLANE_RINGS, PathMotion, RingState, Turn,
    prescribed_rate,
};
use crate::dynamics::quasi_static::{RingJacobian, stacked};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::Vector;
use crate::scene::{MOST_SENSORS, Motion};

/// Derivatives: by u and w, by the rings' positions, by their velocities, by time.
type ByState = Dual<f64, { 2 + 2 * PLANE_RINGS + 1 }>;
const TIME: usize = 2 + 2 * PLANE_RINGS;

/// What all elements share while the Jacobian is put together.
struct Shared {
    now: FramedKinematics,
    /// Positions and velocities of the rings, the inner first.
    positions: [Vector<ByState>; 2],
    velocities: [Vector<ByState>; 2],
    frames: Frames<ByState>,
    /// Rate of the speed that oil films follow (rad/s²).
    film_rate: f64,
}

impl Model {
    /// As [`Model::linearize`] in the plane; `by_time` is the derivative by time.
    pub(super) fn linearize_in_plane<const B: usize>(
        &self,
        (excitation, tau): (&Excitation, f64),
        cells: &Cells,
        state: &[f64],
        (jacobian, by_time): (&mut ArrowJacobian<1, PLANE_RINGS, B>, &mut [f64]),
        shortcuts: &mut Shortcuts,
    ) {
        let host = |motion: Motion, prescribed| {
            if motion == Motion::Host { prescribed_rate(prescribed, tau) } else { RingState::default() }
        };
        let prescribed = [host(self.shaft.motion, &excitation.shaft), host(self.housing.motion, &excitation.housing)];
        let shared = self.shared_in_plane(excitation, tau, state, &prescribed);
        self.bodies_in_plane((excitation, tau), &shared.now, prescribed, (jacobian, by_time));
        let masses = self.supports.inverse_masses();
        let inverse_masses = std::array::from_fn(|i| masses[i]);
        if self.elements_in_balance() {
            let found = self.elements_in_balance_to_first_order(cells, state, &shared.now, shortcuts);
            for (whole, of_elements) in [&mut jacobian.by_position, &mut jacobian.by_velocity].into_iter().zip(found) {
                let mut corner = whole.fixed_view_mut::<PLANE_RINGS, PLANE_RINGS>(0, 0);
                corner += RingJacobian::from_diagonal(&inverse_masses.into()) * of_elements;
            }
            return;
        }
        let w = self.layout.radial_velocity;
        for j in 0..self.element_count {
            let at = self.moving_element(j, [state[j], state[w + j]], &shared, shortcuts);
            let in_cells = self.cells_of(cells, j);
            let forces = self.linearized(in_cells, &at.mapped(ByState::value), shortcuts).chained(&at);
            let [shaft, housing] = forces.on_rings(&at);
            let acceleration = self.radial_acceleration(&at, forces.radial(), shared.velocities[1]);
            let on_rings = [shaft.x, shaft.y, housing.x, housing.y];
            let found = ElementToFirstOrder { rates: [at.path_rate], accelerations: [acceleration], on_rings };
            jacobian.put(j, &found, &inverse_masses, by_time);
        }
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

    /// Rings and frames with what they change by; `prescribed` are their rates where a host moves them.
    fn shared_in_plane(&self, excitation: &Excitation, tau: f64, state: &[f64], prescribed: &[RingState; 2]) -> Shared {
        let now = self.kinematics(excitation, tau, state);
        let (rings, rates) = ([&now.shaft, &now.housing], excitation.frame_rates(tau));
        let vector = |value: Vector, first: usize, rate: Vector| {
            Vector::from_fn(|axis, _| {
                let mut number = ByState::variable(value[axis], first + axis);
                number.by[TIME] = rate[axis];
                number
            })
        };
        let frame = |i: usize| {
            let (Turn { angle, speed }, [angle_rate, speed_rate]) = (now.frames.0[i], rates[i]);
            Turn { angle: by_time(angle, angle_rate), speed: by_time(speed, speed_rate) }
        };
        Shared {
            positions: [0, 1].map(|i: usize| vector(rings[i].position, 2 + 2 * i, prescribed[i].position)),
            velocities: [0, 1]
                .map(|i: usize| vector(rings[i].velocity, 2 + PLANE_RINGS + 2 * i, prescribed[i].velocity)),
            frames: Frames([0, 1, 2].map(frame)),
            film_rate: excitation.relative_speed.rate_at(tau),
            now,
        }
    }

    /// Element `j` at path `u` and absolute radial velocity `w` as all that changes.
    #[inline(always)]
    fn moving_element(
        &self,
        j: usize,
        [u, w]: [f64; 2],
        shared: &Shared,
        shortcuts: &mut Shortcuts,
    ) -> ElementMotion<ByState> {
        let Shared { now, positions, velocities, frames, film_rate } = shared;
        let at = self.element_motion(j, PathMotion::at_rest(u), now, shortcuts);
        let turning = |vector: Vector, rate: Vector| vector.zip_map(&rate, by_time);
        let e_r = turning(at.e_r, at.e_t * at.omega);
        ElementMotion {
            element: j,
            e_r,
            e_t: turning(at.e_t, at.e_r * -at.omega),
            angle: by_time(at.angle, at.omega),
            omega: by_time(at.omega, at.alpha),
            alpha: ByState::constant(at.alpha),
            path: ByState::variable(u, 0),
            path_rate: ByState::variable(w, 1) - velocities[1].dot(&e_r),
            offset: positions[1] - positions[0],
            drift: velocities[1] - velocities[0],
            frames: *frames,
            films: at.films,
            film_speed: by_time(at.film_speed, *film_rate),
            curved: at.curved,
        }
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

/// A number that changes by time alone.
fn by_time(value: f64, rate: f64) -> ByState {
    let mut found = ByState::constant(value);
    found.by[TIME] = rate;
    found
}
