//! Solves (s − J) x = b for the arrow-shaped Jacobian J of the equations of motion, s > 0, in O(Z).
//!
//! Each element's two unknowns follow from the velocities V of the rings by its own 2×2 block,
//! ```text
//! s u − w + e_r·v_o = b_u,   s w − a u − c w − g·(x_o − x_i) − … = b_w,   determinant s(s − c) − a
//! ```
//! and each position from its velocity, x = (v + b_x)/s. What is left are the velocities of rings and sensors, by
//! elimination with row pivoting. Rows of bodies without state are those of the unit matrix; with one sensor at most,
//! only the rows that there may be are worked with.

use super::spatial_arrow::SpatialArrow;
use nalgebra::{Const, LU, SMatrix};

use crate::dynamics::derivatives::{BodyIndices, Jacobian};
use crate::dynamics::parameters::{BODIES, Bodies, FEW_BODIES, Model};
use crate::dynamics::quasi_static::{Rings, stacked};
use crate::numerics::plane::{Matrix, Vector};

/// Unknowns that elements see: velocities of the inner, then the outer ring.
const RINGS: usize = 4;

/// The eliminated matrix s − J; holds nothing between steps that matters.
#[derive(Debug, Clone)]
pub struct Arrow {
    shift: f64,
    elements: Vec<Eliminated>,
    bodies: Factors,
    /// That of rings in space, in place of all else.
    space: Option<Box<SpatialArrow>>,
}

/// Factors of the bodies' matrix.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "the few are in every step, the box of the many is for the rare scene")]
enum Factors {
    /// No body has a state.
    None,
    /// Rings, and one sensor at most.
    Few(LU<f64, Const<FEW_BODIES>, Const<FEW_BODIES>>),
    /// More sensors. The box is made once, with the arrow.
    Many(Box<LU<f64, Const<BODIES>, Const<BODIES>>>),
}

impl Factors {
    /// Solves for the first bodies of `b` in place; false where the matrix is singular.
    fn solve(&self, b: &mut Bodies) -> bool {
        match self {
            Self::None => true,
            Self::Few(lu) => lu.solve_mut(&mut b.fixed_rows_mut::<FEW_BODIES>(0)),
            Self::Many(lu) => lu.solve_mut(b),
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
    /// Room for a model's elements and bodies.
    pub fn new(model: &Model) -> Self {
        let many = model.supports.size() == BODIES;
        let bodies =
            if many { Factors::Many(Box::new(SMatrix::<f64, BODIES, BODIES>::identity().lu())) } else { Factors::None };
        let space = model.space.as_ref().map(|_| Box::new(SpatialArrow::new(model.element_count)));
        Self { shift: 1.0, elements: vec![Eliminated::default(); model.element_count], bodies, space }
    }

    /// Eliminates `shift` − `jacobian`.
    pub fn factor(&mut self, jacobian: &Jacobian, shift: f64) {
        if let (Some(arrow), Some(jacobian)) = (&mut self.space, &jacobian.space) {
            return arrow.factor(jacobian, shift);
        }
        self.shift = shift;
        if jacobian.by_position.nrows() == BODIES {
            let factors = self.eliminated::<BODIES>(jacobian).lu();
            if let Factors::Many(bodies) = &mut self.bodies {
                **bodies = factors;
            }
        } else {
            let matrix = self.eliminated::<FEW_BODIES>(jacobian);
            let coupled = jacobian.body_indices.iter().any(Option::is_some);
            self.bodies = if coupled { Factors::Few(matrix.lu()) } else { Factors::None };
        }
    }

    /// The first bodies' matrix, once the elements are eliminated.
    fn eliminated<const N: usize>(&mut self, jacobian: &Jacobian) -> SMatrix<f64, N, N> {
        let (shift, inverse_shift) = (self.shift, 1.0 / self.shift);
        let free = jacobian.body_indices.map(|body| body.is_some());
        let coupled = free.contains(&true);
        let by_velocity = jacobian.by_velocity.fixed_view::<N, N>(0, 0);
        let by_position = jacobian.by_position.fixed_view::<N, N>(0, 0);
        let mut matrix = SMatrix::from_diagonal_element(shift) - by_velocity - by_position * inverse_shift;
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
        for i in (0..N).filter(|&i| !free[i]) {
            matrix.row_mut(i).fill(0.0);
            matrix.column_mut(i).fill(0.0);
            matrix[(i, i)] = 1.0;
        }
        matrix
    }

    /// Puts x into `b`, for the `jacobian` that was eliminated last.
    pub fn solve(&self, jacobian: &Jacobian, b: &mut [f64]) {
        if let (Some(arrow), Some(jacobian)) = (&self.space, &jacobian.space) {
            return arrow.solve(jacobian, b);
        }
        let start = jacobian.radial_velocity;
        let inverse_shift = 1.0 / self.shift;
        // What the positions' right-hand sides alone would move.
        let shifted = jacobian.body_indices.map(|body| body.map_or(0.0, |body| b[body.position] * inverse_shift));
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
        let (mut v, size) = (Bodies::zeros(), jacobian.by_position.nrows());
        v.rows_mut(0, size).gemv(1.0, &jacobian.by_position, &Bodies::from(shifted).rows(0, size), 0.0);
        let mut of_rings = v.fixed_rows_mut::<RINGS>(0);
        of_rings += rings;
        for (v, body) in v.iter_mut().zip(&jacobian.body_indices) {
            *v = body.map_or(0.0, |body| *v + b[body.velocity]);
        }
        if !self.bodies.solve(&mut v) {
            // Error control takes a step back whose result is NaN.
            v.fill(f64::NAN);
        }
        for (i, body) in jacobian.body_indices.iter().enumerate() {
            if let Some(BodyIndices { position, velocity }) = *body {
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
    use crate::dynamics::contacts::Shortcuts;
    use crate::dynamics::derivatives::jacobian::tests::{DAMPINGS, MOTIONS, lively, moving, noise};

    #[test]
    fn the_solution_satisfies_the_whole_system() {
        for (case, (motions, damping)) in
            MOTIONS.into_iter().flat_map(|m| DAMPINGS.into_iter().map(move |d| (m, d))).enumerate()
        {
            let (model, excitation) = lively(motions, damping, -1.58);
            let (state, cells) = moving(&model, &excitation, case as u64);
            let len = model.layout.len;
            let mut jacobian = Jacobian::new(&model);
            model.linearize(&excitation, 0.0, &cells, &state, &mut jacobian, &mut Shortcuts::default());
            let matrix = jacobian.matrix(len);
            let mut arrow = Arrow::new(&model);
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
