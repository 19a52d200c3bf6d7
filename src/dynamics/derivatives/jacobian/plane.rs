//! The Jacobian in the plane: an element's state (u, w), by the rings' four coordinates, and their velocities.

use crate::dynamics::contacts::{ElementMotion, Shortcuts};
use crate::dynamics::derivatives::arrow::{ArrowJacobian, ElementToFirstOrder};
use crate::dynamics::derivatives::small_change::Changing;
use crate::dynamics::parameters::{Cells, Excitation, FramedKinematics, Model, PLANE_RINGS, PathMotion};
use crate::dynamics::quasi_static::{RingJacobian, add_by_offset, stacked};
use crate::numerics::lanes::{Kernel, Wide, dispatch};
use crate::numerics::number::Dual;
use crate::numerics::plane::Vector;

/// Derivatives: by u and w, by the rings' positions, by their velocities.
type ByState = Dual<f64, { 2 + 2 * PLANE_RINGS }>;

impl Model {
    /// As [`Model::linearize`] in the plane.
    pub(super) fn linearize_in_plane<const B: usize>(
        &self,
        (excitation, tau): (&Excitation, f64),
        cells: &Cells,
        state: &[f64],
        jacobian: &mut ArrowJacobian<1, PLANE_RINGS, B>,
        shortcuts: &mut Shortcuts,
    ) {
        let [by_position, by_velocity] = self.supports.accelerations_by_motion();
        jacobian.by_position.copy_from(by_position);
        jacobian.by_velocity.copy_from(by_velocity);
        let now = self.kinematics(excitation, tau, state);
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
        dispatch(Assembly { model: self, cells, state, now: &now, inverse_masses, jacobian, shortcuts });
    }

    /// Forces of elements in balance at every instant on the rings, by the rings' positions and velocities: their
    /// elastic tangent, and what dampers hand on. That damping changes as rings move, by χ δ̇ of the tangent, is left
    /// out: it is for the stability of explicit steps, and at rest, for the modes, there is none.
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
                add_by_offset(&mut by_velocity, axis, &stacked(shaft, housing).map(|force| force.by[0]));
                if axis == 1 {
                    self.add_balanced(&found.elastic.values(), &mut by_position);
                }
                at.path = found.path.value;
            }
        }
        [by_position, by_velocity]
    }
}

/// Elements in motion one after the other: the chain rule and the arrow in the machine's registers.
struct Assembly<'a, const B: usize> {
    model: &'a Model,
    cells: &'a Cells,
    state: &'a [f64],
    now: &'a FramedKinematics,
    inverse_masses: [f64; PLANE_RINGS],
    jacobian: &'a mut ArrowJacobian<1, PLANE_RINGS, B>,
    shortcuts: &'a mut Shortcuts,
}

impl<const B: usize> Kernel for Assembly<'_, B> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, _: S) {
        let Self { model, cells, state, now, inverse_masses, jacobian, shortcuts } = self;
        let variable = |of: Vector, first: usize| Vector::from_fn(|axis, _| ByState::variable(of[axis], first + axis));
        let [(x_i, v_i), (x_o, v_o)] = [(&now.shaft, 2), (&now.housing, 4)]
            .map(|(ring, k)| (variable(ring.position, k), variable(ring.velocity, PLANE_RINGS + k)));
        for j in 0..model.element_count {
            let still = model.element_motion(j, PathMotion::at_rest(state[j]), now, shortcuts);
            let w = ByState::variable(state[model.layout.radial_velocity + j], 1);
            let path_rate = w - (v_o.x * still.e_r.x + v_o.y * still.e_r.y);
            let at = ElementMotion { path_rate, offset: x_o - x_i, drift: v_o - v_i, ..still.by_path() };
            let moving = still.on_path(state[j], path_rate.value);
            let forces = model.linearized(model.cells_of(cells, j), &moving, shortcuts).chained(&at);
            let [shaft, housing] = forces.on_rings(&at);
            let found = ElementToFirstOrder {
                rates: [path_rate],
                accelerations: [model.radial_acceleration(&at, forces.radial(), v_o)],
                on_rings: [shaft.x, shaft.y, housing.x, housing.y],
            };
            jacobian.put(j, &found, &inverse_masses);
        }
    }
}
