//! Solves (s − J) x = b for the arrow-shaped Jacobian J of the equations of motion, s > 0, in O(Z).
//!
//! Each element's two unknowns follow from the velocities V of the rings by its own 2×2 block,
//! ```text
//! s u − w + e_r·v_o = b_u,   s w − a u − c w − g·(x_o − x_i) − … = b_w,   determinant s(s − c) − a
//! ```
//! and each position from its velocity, x = (v + b_x)/s. What is left are the velocities of rings and sensor, five at
//! most, by elimination with row pivoting. Rows of bodies without state are those of the unit matrix.

use crate::dynamics::jacobian::{BODIES, Jacobian};

/// Unknowns that elements see: velocities of the inner, then the outer ring.
const RINGS: usize = 4;

/// The eliminated matrix s − J; holds nothing between steps that matters.
#[derive(Debug, Clone)]
pub struct Arrow {
    shift: f64,
    elements: Vec<Eliminated>,
    /// Factors of the bodies' matrix, and the row swapped into each place.
    factors: [[f64; BODIES]; BODIES],
    pivots: [usize; BODIES],
    /// Whether any body has a state.
    coupled: bool,
}

/// One element's block, solved.
#[derive(Debug, Clone, Copy, Default)]
struct Eliminated {
    /// Inverse of the 2×2 block.
    inverse: [[f64; 2]; 2],
    /// ∂(u, w)/∂V
    by_rings: [[f64; RINGS]; 2],
}

impl Arrow {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self {
            shift: 1.0,
            elements: vec![Eliminated::default(); count],
            factors: [[0.0; BODIES]; BODIES],
            pivots: [0; BODIES],
            coupled: false,
        }
    }

    /// Eliminates `shift` − `jacobian`.
    pub fn factor(&mut self, jacobian: &Jacobian, shift: f64) {
        self.shift = shift;
        let inverse_shift = 1.0 / shift;
        let free = jacobian.places.map(|place| place.is_some());
        self.coupled = free.contains(&true);
        let mut matrix = [[0.0; BODIES]; BODIES];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (k, value) in row.iter_mut().enumerate() {
                *value = -jacobian.by_velocity[i][k] - inverse_shift * jacobian.by_position[i][k];
            }
            row[i] += shift;
        }
        for (block, solved) in jacobian.elements.iter().zip(&mut self.elements) {
            let (a, c) = (block.by_path, block.by_velocity);
            let per_determinant = 1.0 / (shift * (shift - c) - a);
            let inverse =
                [[(shift - c) * per_determinant, per_determinant], [a * per_determinant, shift * per_determinant]];
            solved.inverse = inverse;
            if !self.coupled {
                continue;
            }
            for k in 0..RINGS {
                let (along, velocity, sign) = if k < 2 {
                    (0.0, block.by_shaft_velocity[k], -1.0)
                } else {
                    (-block.e_r[k - 2], block.by_housing_velocity[k - 2], 1.0)
                };
                let radial = velocity + sign * inverse_shift * block.by_offset[k % 2];
                for (row, inverse) in solved.by_rings.iter_mut().zip(inverse) {
                    row[k] = inverse[0] * along + inverse[1] * radial;
                }
            }
            for i in 0..RINGS {
                for k in 0..RINGS {
                    matrix[i][k] -= block.rings_by_path[i] * solved.by_rings[0][k]
                        + block.rings_by_velocity[i] * solved.by_rings[1][k];
                }
            }
        }
        for i in (0..BODIES).filter(|&i| !free[i]) {
            for k in 0..BODIES {
                (matrix[i][k], matrix[k][i]) = (0.0, 0.0);
            }
            matrix[i][i] = 1.0;
        }
        self.factors = matrix;
        if self.coupled {
            self.eliminate();
        }
    }

    fn eliminate(&mut self) {
        let a = &mut self.factors;
        for i in 0..BODIES {
            let pivot = (i..BODIES).fold(i, |best, k| if a[k][i].abs() > a[best][i].abs() { k } else { best });
            a.swap(i, pivot);
            self.pivots[i] = pivot;
            let pivot_row = a[i];
            let inverse = 1.0 / pivot_row[i];
            for row in a.iter_mut().skip(i + 1) {
                let factor = row[i] * inverse;
                row[i] = factor;
                for k in i + 1..BODIES {
                    row[k] -= factor * pivot_row[k];
                }
            }
        }
    }

    /// Puts x into `b`, for the `jacobian` that was eliminated last.
    pub fn solve(&self, jacobian: &Jacobian, b: &mut [f64]) {
        let start = jacobian.radial_velocity;
        let inverse_shift = 1.0 / self.shift;
        // What the positions' right-hand sides alone would move.
        let shifted = jacobian.places.map(|place| place.map_or(0.0, |(position, _)| b[position] * inverse_shift));
        let offset = [shifted[2] - shifted[0], shifted[3] - shifted[1]];
        let mut v = [0.0; BODIES];
        for (j, (block, solved)) in jacobian.elements.iter().zip(&self.elements).enumerate() {
            let (b_u, b_w) = (b[j], b[start + j] + block.by_offset[0] * offset[0] + block.by_offset[1] * offset[1]);
            let [to_u, to_w] = solved.inverse;
            let (u, w) = (to_u[0] * b_u + to_u[1] * b_w, to_w[0] * b_u + to_w[1] * b_w);
            (b[j], b[start + j]) = (u, w);
            for i in 0..RINGS {
                v[i] += block.rings_by_path[i] * u + block.rings_by_velocity[i] * w;
            }
        }
        if !self.coupled {
            return;
        }
        for i in 0..BODIES {
            let Some((_, velocity)) = jacobian.places[i] else {
                v[i] = 0.0;
                continue;
            };
            v[i] += b[velocity];
            for k in 0..BODIES {
                v[i] += jacobian.by_position[i][k] * shifted[k];
            }
        }
        self.substitute(&mut v);
        for (i, place) in jacobian.places.iter().enumerate() {
            if let Some((position, velocity)) = *place {
                b[velocity] = v[i];
                b[position] = (v[i] + b[position]) * inverse_shift;
            }
        }
        for (j, solved) in self.elements.iter().enumerate() {
            for (place, row) in [(j, solved.by_rings[0]), (start + j, solved.by_rings[1])] {
                for k in 0..RINGS {
                    b[place] += row[k] * v[k];
                }
            }
        }
    }

    fn substitute(&self, v: &mut [f64; BODIES]) {
        for (i, &pivot) in self.pivots.iter().enumerate() {
            v.swap(i, pivot);
        }
        for i in 0..BODIES {
            for k in i + 1..BODIES {
                v[k] -= self.factors[k][i] * v[i];
            }
        }
        for i in (0..BODIES).rev() {
            for k in i + 1..BODIES {
                v[i] -= self.factors[i][k] * v[k];
            }
            v[i] /= self.factors[i][i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::jacobian::tests::{DAMPINGS, MOTIONS, lively, moving, noise, whole};

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
            let matrix = whole(&jacobian, len);
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
