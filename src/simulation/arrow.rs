//! Solves (s − J) x = b for the arrow-shaped Jacobian J of the equations of motion, s > 0, in O(Z).
//!
//! Each element's two unknowns follow from the velocities V of the rings by its own 2×2 block,
//! ```text
//! s u − w + e_r·v_o = b_u,   s w − a u − c w − g·(x_o − x_i) − … = b_w,   determinant s(s − c) − a
//! ```
//! and each position from its velocity, x = (v + b_x)/s. What is left are the velocities of rings and sensors, by
//! elimination with row pivoting. Rows of bodies without state are those of the unit matrix; with one sensor at most,
//! only the rows that there may be are worked with.

use nalgebra::{Const, DimMin, LU};

use crate::dynamics::jacobian::Jacobian;
use crate::dynamics::supports::{BODIES, Bodies, BodyMatrix, FEW_BODIES};
use crate::dynamics::tangent::{Rings, stacked};
use crate::numerics::plane::{Matrix, Vector};

/// Unknowns that elements see: velocities of the inner, then the outer ring.
const RINGS: usize = 4;

/// The eliminated matrix s − J; holds nothing between steps that matters.
#[derive(Debug, Clone)]
pub struct Arrow {
    shift: f64,
    elements: Vec<Eliminated>,
    bodies: Factors,
}

/// Factors of the bodies' matrix.
///
/// In place, though one is much larger: a box would be allocated within the step.
#[allow(clippy::large_enum_variant)]
#[derive(Debug, Clone)]
enum Factors {
    /// No body has a state.
    None,
    /// Rings, and one sensor at most.
    Few(LU<f64, Const<FEW_BODIES>, Const<FEW_BODIES>>),
    /// More sensors.
    Many(LU<f64, Const<BODIES>, Const<BODIES>>),
}

impl Factors {
    /// Solves for the first bodies of `b` in place; false where the matrix is singular.
    fn solve(&self, b: &mut Bodies) -> bool {
        fn first<const N: usize>(lu: &LU<f64, Const<N>, Const<N>>, b: &mut Bodies) -> bool
        where
            Const<N>: DimMin<Const<N>, Output = Const<N>>,
        {
            lu.solve_mut(&mut b.rows_mut(0, N))
        }
        match self {
            Self::None => true,
            Self::Few(lu) => first(lu, b),
            Self::Many(lu) => first(lu, b),
        }
    }
}

/// One element's block, solved.
#[derive(Debug, Clone, Copy, Default)]
struct Eliminated {
    /// Inverse of the 2×2 block.
    inverse: Matrix,
    /// ∂u/∂V and ∂w/∂V
    by_rings: [Rings; 2],
}

impl Arrow {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { shift: 1.0, elements: vec![Eliminated::default(); count], bodies: Factors::None }
    }

    /// Eliminates `shift` − `jacobian`.
    pub fn factor(&mut self, jacobian: &Jacobian, shift: f64) {
        self.shift = shift;
        let inverse_shift = 1.0 / shift;
        let free = jacobian.places.map(|place| place.is_some());
        let coupled = free.contains(&true);
        let mut matrix =
            BodyMatrix::from_diagonal_element(shift) - jacobian.by_velocity - jacobian.by_position * inverse_shift;
        for (block, solved) in jacobian.elements.iter().zip(&mut self.elements) {
            let (a, c) = (block.by_path, block.by_velocity);
            solved.inverse = Matrix::new(shift - c, 1.0, a, shift) / (shift * (shift - c) - a);
            if !coupled {
                continue;
            }
            let moved = block.by_offset * inverse_shift;
            let radial = stacked(block.by_shaft_velocity - moved, block.by_housing_velocity + moved);
            let along = stacked(Vector::zeros(), -block.e_r);
            solved.by_rings = [0, 1].map(|i| along * solved.inverse[(i, 0)] + radial * solved.inverse[(i, 1)]);
            let [u, w] = &solved.by_rings;
            let through = block.rings_by_path * u.transpose() + block.rings_by_velocity * w.transpose();
            let mut rings = matrix.fixed_view_mut::<RINGS, RINGS>(0, 0);
            rings -= through;
        }
        for i in (0..BODIES).filter(|&i| !free[i]) {
            matrix.row_mut(i).fill(0.0);
            matrix.column_mut(i).fill(0.0);
            matrix[(i, i)] = 1.0;
        }
        let many = free[FEW_BODIES..].contains(&true);
        self.bodies = match (coupled, many) {
            (false, _) => Factors::None,
            (true, false) => Factors::Few(matrix.fixed_view::<FEW_BODIES, FEW_BODIES>(0, 0).into_owned().lu()),
            (true, true) => Factors::Many(matrix.lu()),
        };
    }

    /// Puts x into `b`, for the `jacobian` that was eliminated last.
    pub fn solve(&self, jacobian: &Jacobian, b: &mut [f64]) {
        let start = jacobian.radial_velocity;
        let inverse_shift = 1.0 / self.shift;
        // What the positions' right-hand sides alone would move.
        let shifted = jacobian.places.map(|place| place.map_or(0.0, |(position, _)| b[position] * inverse_shift));
        let offset = Vector::new(shifted[2] - shifted[0], shifted[3] - shifted[1]);
        let mut rings = Rings::zeros();
        for (j, (block, solved)) in jacobian.elements.iter().zip(&self.elements).enumerate() {
            let moved = solved.inverse * Vector::new(b[j], b[start + j] + block.by_offset.dot(&offset));
            (b[j], b[start + j]) = (moved.x, moved.y);
            rings += block.rings_by_path * moved.x + block.rings_by_velocity * moved.y;
        }
        if matches!(self.bodies, Factors::None) {
            return;
        }
        let mut v = jacobian.by_position * Bodies::from(shifted);
        let mut of_rings = v.fixed_rows_mut::<RINGS>(0);
        of_rings += rings;
        for (v, place) in v.iter_mut().zip(&jacobian.places) {
            *v = place.map_or(0.0, |(_, velocity)| *v + b[velocity]);
        }
        if !self.bodies.solve(&mut v) {
            // Error control takes a step back whose result is no number.
            v.fill(f64::NAN);
        }
        for (i, place) in jacobian.places.iter().enumerate() {
            if let Some((position, velocity)) = *place {
                b[velocity] = v[i];
                b[position] = (v[i] + b[position]) * inverse_shift;
            }
        }
        let v = Rings::new(v[0], v[1], v[2], v[3]);
        for (j, solved) in self.elements.iter().enumerate() {
            b[j] += solved.by_rings[0].dot(&v);
            b[start + j] += solved.by_rings[1].dot(&v);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::jacobian::tests::{DAMPINGS, MOTIONS, lively, moving, noise};

    #[test]
    fn the_solution_satisfies_the_whole_system() {
        for (case, (motions, damping)) in
            MOTIONS.into_iter().flat_map(|m| DAMPINGS.into_iter().map(move |d| (m, d))).enumerate()
        {
            let (model, drive) = lively(motions, damping, -1.58);
            let (state, cells) = moving(&model, &drive, case as u64);
            let len = model.layout.len;
            let (mut jacobian, mut by_time) = (Jacobian::new(&model), vec![0.0; len]);
            model.linearize(&drive, 0.0, &cells, &state, &mut jacobian, &mut by_time);
            let matrix = jacobian.matrix(len);
            let mut arrow = Arrow::new(model.element_count);
            for shift in [1e2, 1e5, 1e9] {
                arrow.factor(&jacobian, shift);
                let mut noise = noise(7);
                let b: Vec<f64> = (0..len).map(|i| if model.layout.is_used(i) { noise() } else { 0.0 }).collect();
                let mut x = b.clone();
                arrow.solve(&jacobian, &mut x);
                for i in (0..len).filter(|&i| model.layout.is_used(i)) {
                    let (mut sum, mut size) = (shift * x[i], (shift * x[i]).abs() + b[i].abs());
                    for k in 0..len {
                        sum -= matrix[i][k] * x[k];
                        size += (matrix[i][k] * x[k]).abs();
                    }
                    // Rounding of the largest terms, and some growth in the elimination.
                    assert!((sum - b[i]).abs() < 1e-12 * size, "{motions:?} {damping:?} row {i}: {sum} for {}", b[i]);
                }
            }
        }
    }
}
