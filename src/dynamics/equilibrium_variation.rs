//! How the static equilibrium moves when an input does: the implicit function theorem.
//!
//! At the start each element is in radial balance, R_j = f·e_r − F_r + m (g·e_r + ρ ω²) = 0 with u' = 0, and so is each
//! internal ring. A change of inputs and rings moves each path by du_j = −dR_j/(∂R_j/∂u_j), and the internal rings by the
//! solution of what is then left of their balance, four equations at most.
//!
//! An element that nothing touches and nothing moves keeps its place. Rings without any stiffness against them have no
//! equilibrium of their own; their derivative does not exist.

use super::drive::Drive;
use super::forces::dot;
use super::model::Model;
use super::variation::{ElementChange, ElementVariation, Variation, VaryingElement};
use crate::numerics::linear::solve4;
use crate::scene::Motion;

/// Change of one element's path and of the forces on the rings, its balance kept.
struct Balanced {
    path: f64,
    rings: [f64; 4],
}

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
        let z = self.element_count;
        let at = self.instant(drive, 0.0, state);
        let free = [self.shaft.motion, self.shaft.motion, self.housing.motion, self.housing.motion]
            .map(|motion| motion == Motion::Internal);
        let given = ElementVariation {
            offset: [0, 1].map(|a| by.housing.position[a] - by.shaft.position[a]),
            drift: [0, 1].map(|a| by.housing.velocity[a] - by.shaft.velocity[a]),
            cage_speed: by.cage_speed,
            ..ElementVariation::default()
        };
        let by_ring = [0, 1, 2, 3].map(|k: usize| {
            let mut offset = [0.0; 2];
            offset[k % 2] = if k < 2 { -1.0 } else { 1.0 };
            ElementVariation { offset, ..ElementVariation::default() }
        });
        let mut matrix = [[0.0; 4]; 4];
        let mut force = loads;
        for j in 0..z {
            let element = self.varying(j, cells[j], (state[j], state[self.layout.radial_velocity + j]), &at, true);
            add(&mut force, self.balanced(&element, &given).rings);
            for k in (0..4).filter(|&k| free[k]) {
                let rings = self.balanced(&element, &by_ring[k]).rings;
                for i in 0..4 {
                    matrix[i][k] -= rings[i];
                }
            }
        }
        for i in 0..4 {
            let support = if i < 2 { self.shaft.stiffness } else { self.housing.stiffness };
            if free[i] {
                matrix[i][i] += support;
            } else {
                (matrix[i], force[i]) = ([0.0; 4], 0.0);
                matrix[i][i] = 1.0;
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
        let whole = ElementVariation { offset: [0, 1].map(|a| by.housing.position[a] - by.shaft.position[a]), ..given };
        for j in 0..z {
            let element = self.varying(j, cells[j], (state[j], state[self.layout.radial_velocity + j]), &at, true);
            by.path[j] = self.balanced(&element, &whole).path;
            by.radial_velocity[j] = dot(by.housing.velocity, element.e_r);
        }
        Some(())
    }

    fn balanced(&self, element: &VaryingElement, by: &ElementVariation) -> Balanced {
        let (rho, omega) = (element.rho, element.omega);
        let radial = |d: &ElementChange| dot(d.inner, element.e_r) - d.outer[0];
        let along = element.change(&ElementVariation { path: 1.0, ..ElementVariation::default() });
        let direct = element.change(by);
        let stiffness = radial(&along) + self.element_mass * omega * omega;
        let push = radial(&direct) + 2.0 * self.element_mass * rho * omega * by.cage_speed;
        let path = if stiffness == 0.0 { 0.0 } else { -push / stiffness };
        let mut rings = [0.0; 4];
        for a in 0..2 {
            rings[a] = -(direct.inner[a] + path * along.inner[a]);
            let outer = [0, 1].map(|i| direct.outer[i] + path * along.outer[i]);
            rings[2 + a] = outer[0] * element.e_r[a] - outer[1] * element.e_t[a];
        }
        Balanced { path, rings }
    }
}

fn add(sum: &mut [f64; 4], part: [f64; 4]) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += part;
    }
}
