//! Forces and moments on the rings by their positions and tilts, each ball staying in its balance.

use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{Cells, FramedKinematics, Model, RINGS, RingInSpace, Space};

impl Model {
    /// Jacobian of the forces on both rings by both rings' coordinates (N/m, N/rad, N m/m, N m/rad) with the balls in
    /// balance at `balls`, u and v of each; elastic, everything standing where it is.
    pub(in crate::dynamics) fn spatial_tangent(
        &self,
        space: &Space,
        now: &FramedKinematics,
        rings: &[RingInSpace; 2],
        cells: &Cells,
        balls: &[[f64; 2]],
        shortcuts: &mut Shortcuts,
    ) -> [[f64; RINGS]; RINGS] {
        let mut sum = [[0.0; RINGS]; RINGS];
        for (j, &place) in balls.iter().enumerate() {
            let at = self.ball_motion(j, now, rings, shortcuts);
            let found = self.ball_tangent(space, self.cells_of(cells, j), place, &at, shortcuts);
            for (row, by) in sum.iter_mut().zip(found) {
                row.iter_mut().zip(by).for_each(|(sum, by)| *sum += by);
            }
        }
        sum
    }

    /// u and v of each ball in a state.
    pub fn balls_of(&self, state: &[f64]) -> Vec<[f64; 2]> {
        let v = self.layout.axial().map_or(0, |[v, _]| v);
        (0..self.element_count).map(|j| [state[j], state[v + j]]).collect()
    }
}
