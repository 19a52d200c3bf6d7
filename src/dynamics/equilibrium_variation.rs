//! How the static equilibrium moves when an input does: the implicit function theorem.
//!
//! At the start each element is in radial balance with u' = 0, and so is each internal ring. A change of inputs and rings
//! moves each path as its [balance](super::tangent) asks, and the internal rings by the solution of what is then left of
//! theirs, four equations at most.
//!
//! An element that nothing touches and nothing moves keeps its place. Rings without any stiffness against them have no
//! equilibrium of their own; their derivative does not exist.

use super::drive::Drive;
use super::forces::dot;
use super::linearized::{Bends, ElementVariation, Instant, Linearized};
use super::model::Model;
use super::variation::Variation;
use crate::numerics::linear::solve4;
use crate::scene::Motion;

impl Model {
    /// Completes a change of inputs at the equilibrium `state` by what it does to rings and elements. `by` comes with the
    /// changes of prescribed rings and of the cage speed; `loads` are those of the external loads on both rings [N].
    /// `None` if the rings have no stiffness against them.
    pub fn vary_equilibrium(
        &self,
        drive: &Drive,
        cells: &[u32],
        state: &[f64],
        loads: [f64; 4],
        by: &mut Variation,
    ) -> Option<()> {
        let at = self.instant(drive, 0.0, state);
        let given = ElementVariation {
            offset: by.offset(),
            drift: [0, 1].map(|a| by.housing.velocity[a] - by.shaft.velocity[a]),
            cage_speed: by.cage_speed,
            ..ElementVariation::default()
        };
        let (mut jacobian, mut force) = ([[0.0; 4]; 4], loads);
        for j in 0..self.element_count {
            let element = self.at_start(j, cells[j], state, &at);
            self.add_balanced(&element, &mut jacobian);
            let rings = self.balanced(&element, &given).rings;
            for i in 0..4 {
                force[i] += rings[i];
            }
        }
        let mut matrix = [[0.0; 4]; 4];
        let rings = [&self.shaft, &self.shaft, &self.housing, &self.housing];
        let free = rings.map(|ring| ring.motion == Motion::Internal);
        for i in 0..4 {
            if free[i] {
                for k in (0..4).filter(|&k| free[k]) {
                    matrix[i][k] = -jacobian[i][k];
                }
                matrix[i][i] += rings[i].stiffness;
            } else {
                (matrix[i][i], force[i]) = (1.0, 0.0);
            }
        }
        let moved = solve4(matrix, force);
        if moved.iter().any(|value| !value.is_finite()) {
            return None;
        }
        for a in 0..2 {
            by.shaft.position[a] += moved[a];
            by.housing.position[a] += moved[2 + a];
        }
        let whole = ElementVariation { offset: by.offset(), ..given };
        for j in 0..self.element_count {
            let element = self.at_start(j, cells[j], state, &at);
            by.path[j] = self.balanced(&element, &whole).path;
            by.radial_velocity[j] = dot(by.housing.velocity, element.e_r);
        }
        Some(())
    }

    fn at_start(&self, j: usize, cell: u32, state: &[f64], at: &Instant) -> Linearized {
        self.linearized(j, cell, (state[j], state[self.layout.radial_velocity + j]), at, Bends::Wanted)
    }
}
