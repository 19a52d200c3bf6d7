//! How the static equilibrium moves when an input does: the implicit function theorem.
//!
//! At the start each element is in radial balance with u' = 0, and so is each internal ring. A change of inputs and
//! rings moves each path as its balance asks, and the internal rings by the solution of what is then left of theirs,
//! four equations at most.
//!
//! An element that nothing touches and nothing moves stays where it is. Rings without any stiffness against them have
//! no equilibrium of their own; their derivative does not exist.

use crate::dynamics::contacts::{ElementMotion, Linearized, Shortcuts};
use crate::dynamics::derivatives::Variation;
use crate::dynamics::parameters::{COORDINATES, Cells, Excitation, FramedKinematics, Model};
use crate::dynamics::quasi_static::{Balanced, RingJacobian, in_plane};
use crate::numerics::number::Dual;

impl Model {
    /// Completes a change of inputs at the equilibrium `state` by what it does to rings and elements. `by` comes with
    /// the changes of prescribed rings and of the cage speed; `loads` are those of the external loads (N) and moments
    /// (N m) on both rings. `None` if the rings have no stiffness against them.
    pub fn vary_equilibrium(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        loads: &[[f64; COORDINATES]; 2],
        by: &mut Variation,
        shortcuts: &mut Shortcuts,
    ) -> Option<()> {
        if let Some(space) = &self.space {
            return self.vary_spatial_equilibrium(space, excitation, (cells, state), loads, by, shortcuts);
        }
        let loads = in_plane(loads);
        let now = self.kinematics(excitation, 0.0, state);
        if self.elements_in_balance() {
            // Their paths follow in `Model::vary`.
            let force = loads + self.vary_rings(cells, state, &now, by, shortcuts);
            let mut jacobian = RingJacobian::zeros();
            for axis in 0..2 {
                let mut moved = Variation::new(self.element_count);
                moved.rings[1].position[axis] = 1.0;
                let by_offset = self.vary_rings(cells, state, &now, &moved, shortcuts);
                jacobian.set_column(axis, &-by_offset);
                jacobian.set_column(2 + axis, &by_offset);
            }
            by.move_rings(&self.balancing_motion(&jacobian, force)?);
            return Some(());
        }
        let (mut jacobian, mut force) = (RingJacobian::zeros(), loads);
        for j in 0..self.element_count {
            let element = self.at_start(j, cells, state, &now, shortcuts);
            self.add_balanced(&element, &mut jacobian);
            force += self.balanced_change(&element, state, &now, by, shortcuts).rings;
        }
        by.move_rings(&self.balancing_motion(&jacobian, force)?);
        for j in 0..self.element_count {
            let element = self.at_start(j, cells, state, &now, shortcuts);
            by.path[j] = self.balanced_change(&element, state, &now, by, shortcuts).path;
            by.radial_velocity[j] = by.housing_velocity().dot(&element.at.e_r);
        }
        Some(())
    }

    /// What a change does to an element that keeps its balance and stands on its path.
    fn balanced_change(
        &self,
        element: &Linearized,
        state: &[f64],
        now: &FramedKinematics,
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> Balanced<f64> {
        let changing = self.changing_motion(element.at.element, state, now, by, shortcuts);
        let at = changing.mapped(|number| Dual { value: number.value, by: [0.0, number.by[0]] });
        let (path, path_rate) = (Dual::variable(element.at.path, 0), Dual::constant(0.0));
        let [_, change] = self.balanced(element, &ElementMotion { path, path_rate, ..at });
        change
    }

    /// An element at the start; of one whose balance lies between two paths, at the path at which more touches it.
    fn at_start(
        &self,
        j: usize,
        cells: &Cells,
        state: &[f64],
        now: &FramedKinematics,
        shortcuts: &mut Shortcuts,
    ) -> Linearized {
        let (cells, path) = (self.cells_of(cells, j), state[j]);
        let element = self.at_rest(j, cells, path, now, shortcuts);
        if self.radial_force(&element).force.abs() <= self.no_force(&element) {
            return element;
        }
        let found = self.balanced_element(j, cells, path, now, shortcuts);
        if found.nearer.is_some() { self.at_rest(j, cells, found.path, now, shortcuts) } else { element }
    }
}
