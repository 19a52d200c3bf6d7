//! How the static equilibrium in space moves when an input does: the implicit function theorem, as in the plane
//! ([`super::variation`]).

use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::derivatives::Variation;
use crate::dynamics::parameters::{COORDINATES, Cells, Excitation, Model, RINGS, Space};
use crate::numerics::number::Dual;
use nalgebra::{DMatrix, DVector};

impl Model {
    /// As [`Model::vary_equilibrium`] in space; `loads` are the changes of the external loads by coordinates.
    pub(super) fn vary_spatial_equilibrium(
        &self,
        space: &Space,
        excitation: &Excitation,
        (cells, state): (&Cells, &[f64]),
        loads: &[[f64; COORDINATES]; 2],
        by: &mut Variation,
        shortcuts: &mut Shortcuts,
    ) -> Option<()> {
        let now = self.kinematics(excitation, 0.0, state);
        let rings = self.rings_in_space(excitation, 0.0, state, None);
        if self.elements_in_balance() {
            // Their places follow in `Model::vary`.
            let mut force = self.vary_rings_in_space(space, (&now, &rings), (cells, state), by, shortcuts);
            force.iter_mut().zip(loads.as_flattened()).for_each(|(force, load)| *force += load);
            let mut jacobian = [[0.0; RINGS]; RINGS];
            for k in 0..RINGS {
                let (mut moved, mut unit) = (Variation::in_space(self.element_count), [0.0; RINGS]);
                unit[k] = 1.0;
                moved.move_in_space(&unit);
                let column = self.vary_rings_in_space(space, (&now, &rings), (cells, state), &mut moved, shortcuts);
                for (row, by) in jacobian.iter_mut().zip(column) {
                    row[k] = by;
                }
            }
            by.move_in_space(&balancing_motion(space, &jacobian, &force)?);
            return Some(());
        }
        let [v, _] = self.layout.axial()?;
        let (mut force, mut jacobian) = ([0.0; RINGS], [[0.0; RINGS]; RINGS]);
        force.copy_from_slice(loads.as_flattened());
        let mut answers = Vec::with_capacity(self.element_count);
        for j in 0..self.element_count {
            let (in_cells, place) = (self.cells_of(cells, j), [state[j], state[v + j]]);
            let (at, _) = self.ball_motion(j, &now, &rings, shortcuts);
            let tangent = self.ball_tangent::<_, { 2 + RINGS }>(space, in_cells, place, &at, at.omega, shortcuts);
            let (changing, _) = self.changing_ball_motion(j, &now, &rings, by, shortcuts);
            let place = place.map(Dual::<f64, 1>::from);
            let (residual, found) = self.ball_residual(space, in_cells, &changing, place, changing.omega, shortcuts);
            let direct = tangent.answer(residual.map(|of| of.by[0]));
            for (i, of) in found.on_rings().as_flattened().iter().enumerate() {
                force[i] += of.by[0] + tangent.by_ball[i][0] * direct[0] + tangent.by_ball[i][1] * direct[1];
            }
            for (row, by) in jacobian.iter_mut().zip(tangent.by_position) {
                row.iter_mut().zip(by).for_each(|(sum, by)| *sum += by);
            }
            answers.push((direct, tangent));
        }
        let motion = balancing_motion(space, &jacobian, &force)?;
        by.move_in_space(&motion);
        for (j, (direct, tangent)) in answers.into_iter().enumerate() {
            let follows = |row: usize| tangent.ball[row].iter().zip(motion).map(|(by, x)| by * x).sum::<f64>();
            (by.path[j], by.axial[j]) = (direct[0] + follows(0), direct[1] + follows(1));
            let e_r = self.ball_motion(j, &now, &rings, shortcuts).0.e_r;
            let [x, y, z, ..] = by.rings[1].velocity;
            (by.radial_velocity[j], by.axial_velocity[j]) = (x * e_r[0] + y * e_r[1], z);
        }
        Some(())
    }
}

/// Where the free coordinates go until the bearing balances a change of forces; `None` without stiffness against it.
fn balancing_motion(space: &Space, jacobian: &[[f64; RINGS]; RINGS], force: &[f64; RINGS]) -> Option<[f64; RINGS]> {
    let free: Vec<usize> = (0..RINGS).filter(|&i| space.free[i]).collect();
    let matrix = DMatrix::from_fn(free.len(), free.len(), |row, column| {
        let own = if row == column { space.support_stiffness(free[row]) } else { 0.0 };
        own - jacobian[free[row]][free[column]]
    });
    let right = DVector::from_iterator(free.len(), free.iter().map(|&i| force[i]));
    let solved = if free.is_empty() { right } else { matrix.lu().solve(&right)? };
    let mut motion = [0.0; RINGS];
    for (&i, &moved) in free.iter().zip(solved.iter()) {
        motion[i] = moved;
    }
    motion.iter().all(|value| value.is_finite()).then_some(motion)
}
