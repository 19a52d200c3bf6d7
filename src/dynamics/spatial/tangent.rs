//! Forces and moments on the rings by their positions and tilts, each ball staying in its balance.

use super::ball::BallMotion;
use crate::dynamics::contacts::{Record, Shortcuts};
use crate::dynamics::parameters::{COORDINATES, Cells, Excitation, FramedKinematics, Model, RINGS, RingInSpace, Space};

/// Where balls are in balance, and who asks.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Balls<'a> {
    /// u and v of each (m).
    pub(in crate::dynamics) places: &'a [[f64; 2]],
    /// Whether a search does: without curvatures along surfaces and with contacts as [tried](BallMotion::tried).
    pub(in crate::dynamics) searched: bool,
}

impl Model {
    /// Jacobian of the forces on both rings by both rings' coordinates (N/m, N/rad, N m/m, N m/rad) with the balls in
    /// balance; elastic, everything standing where it is. By the first coordinates of the rings alone, two fewer than
    /// `K`.
    pub(in crate::dynamics) fn spatial_tangent<const K: usize>(
        &self,
        space: &Space,
        now: &FramedKinematics,
        rings: &[RingInSpace; 2],
        cells: &Cells,
        Balls { places, searched }: Balls,
        shortcuts: &mut Shortcuts,
    ) -> [[f64; RINGS]; RINGS] {
        let mut sum = [[0.0; RINGS]; RINGS];
        for (j, &place) in places.iter().enumerate() {
            let (at, _) = self.ball_motion(j, now, rings, shortcuts);
            let at = BallMotion { curved: !searched, tried: searched, ..at };
            let (omega, in_cells) = (at.omega, self.cells_of(cells, j));
            let found = self.ball_tangent::<f64, K>(space, in_cells, place, &at.standing(), omega, shortcuts);
            for (row, by) in sum.iter_mut().zip(found.by_position) {
                row.iter_mut().zip(by).for_each(|(sum, by)| *sum += by);
            }
        }
        sum
    }

    /// Tangent stiffness of the inner ring by its own coordinates, −∂(F, M)/∂(x, φ) with the balls in balance, at the
    /// communication point; `None` in the plane.
    pub fn stiffness_in_space(
        &self,
        excitation: &Excitation,
        (cells, state): (&Cells, &[f64]),
        contacts: &Record,
        shortcuts: &mut Shortcuts,
    ) -> Option<[[f64; COORDINATES]; COORDINATES]> {
        let space = self.space.as_ref()?;
        let rings = self.rings_in_space(excitation, 0.0, state, None);
        let now = self.kinematics(excitation, 0.0, state);
        let places = self.balls_of(contacts.paths(self, state));
        let balls = Balls { places: &places, searched: false };
        let tangent = self.spatial_tangent::<{ 2 + COORDINATES }>(space, &now, &rings, cells, balls, shortcuts);
        Some(std::array::from_fn(|row| std::array::from_fn(|column| -tangent[row][column])))
    }

    /// u and v of each ball in a state.
    pub fn balls_of(&self, state: &[f64]) -> Vec<[f64; 2]> {
        let v = self.layout.axial().map_or(0, |[v, _]| v);
        (0..self.element_count).map(|j| [state[j], state[v + j]]).collect()
    }
}
