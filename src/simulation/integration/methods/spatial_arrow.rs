//! Solves (s − J) x = b for the arrow of rings in space, s > 0, in O(Z).
//!
//! With positions eliminated, x = (v + b_x)/s, a ball has the two unknowns r = (w, w_z), and the rings' velocities V
//! remain:
//! ```text
//! p = (b_p + r − E V)/s                                        p = (u, v), E V = (e_r·ẋ_o, ż_o)
//! (s − C − A/s) r = b_r + A (b_p − E V)/s + G_x (V + b_X)/s + G_v V
//! s V = D V + P (V + b_X)/s + Σ (B_p p + B_r r) + b_V
//! ```
//! Rows of bodies without state are those of the unit matrix.

use crate::dynamics::derivatives::{BodyIndices, SpatialBlock, SpatialJacobian};
use crate::dynamics::parameters::{RINGS, SPATIAL_BODIES};
use nalgebra::{Const, LU, SMatrix, SVector};

type Bodies = SVector<f64, SPATIAL_BODIES>;

/// The eliminated matrix.
#[derive(Debug, Clone)]
pub(super) struct SpatialArrow {
    shift: f64,
    balls: Vec<Eliminated>,
    bodies: Option<LU<f64, Const<SPATIAL_BODIES>, Const<SPATIAL_BODIES>>>,
}

/// One ball's block, solved.
#[derive(Debug, Clone, Copy)]
struct Eliminated {
    /// (s − C − A/s)⁻¹
    inverse: [[f64; 2]; 2],
    /// ∂r/∂V
    by_rings: [[f64; RINGS]; 2],
}

/// A·x of two by two.
fn product(a: [[f64; 2]; 2], x: [f64; 2]) -> [f64; 2] {
    a.map(|row| row[0] * x[0] + row[1] * x[1])
}

fn stiffness(block: &SpatialBlock) -> [[f64; 2]; 2] {
    block.by_ball.map(|row| [row[0], row[1]])
}

impl SpatialArrow {
    /// Room for so many balls.
    pub(super) fn new(count: usize) -> Self {
        let none = Eliminated { inverse: [[0.0; 2]; 2], by_rings: [[0.0; RINGS]; 2] };
        Self { shift: 1.0, balls: vec![none; count], bodies: None }
    }

    /// Eliminates `shift` − `jacobian`.
    pub(super) fn factor(&mut self, jacobian: &SpatialJacobian, shift: f64) {
        self.shift = shift;
        let per_shift = 1.0 / shift;
        let mut matrix = SMatrix::<f64, SPATIAL_BODIES, SPATIAL_BODIES>::from_fn(|i, k| {
            let own = if i == k { shift } else { 0.0 };
            own - jacobian.by_velocity[i][k] - jacobian.by_position[i][k] * per_shift
        });
        for (block, solved) in jacobian.balls.iter().zip(&mut self.balls) {
            let m = [0, 1].map(|i: usize| {
                [0, 1].map(|k: usize| {
                    let own = if i == k { shift } else { 0.0 };
                    own - block.by_ball[i][2 + k] - block.by_ball[i][k] * per_shift
                })
            });
            let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
            solved.inverse = [[m[1][1], -m[0][1]], [-m[1][0], m[0][0]]].map(|row| row.map(|part| part / determinant));
            for i in 0..RINGS {
                let carried = product(stiffness(block), unit_carried(block, i));
                let right =
                    [0, 1].map(|k: usize| (block.by_position[k][i] - carried[k]) * per_shift + block.by_velocity[k][i]);
                let [w, w_z] = product(solved.inverse, right);
                (solved.by_rings[0][i], solved.by_rings[1][i]) = (w, w_z);
            }
            for (i, row) in block.rings_by_ball.iter().enumerate() {
                let [b_w, b_z] = [0, 1].map(|k: usize| row[k] * per_shift + row[2 + k]);
                for k in 0..RINGS {
                    let [u, v] = unit_carried(block, k);
                    matrix[(i, k)] -= b_w * solved.by_rings[0][k] + b_z * solved.by_rings[1][k]
                        - (row[0] * u + row[1] * v) * per_shift;
                }
            }
        }
        for i in (0..SPATIAL_BODIES).filter(|&i| jacobian.body_indices[i].is_none()) {
            matrix.row_mut(i).fill(0.0);
            matrix.column_mut(i).fill(0.0);
            matrix[(i, i)] = 1.0;
        }
        self.bodies = Some(matrix.lu());
    }

    /// Puts x into `b`, for the `jacobian` that was eliminated last.
    pub(super) fn solve(&self, jacobian: &SpatialJacobian, b: &mut [f64]) {
        let per_shift = 1.0 / self.shift;
        let [v, w, w_z] = jacobian.starts;
        let shifted = jacobian.body_indices.map(|body| body.map_or(0.0, |body| b[body.position] * per_shift));
        let mut right = Bodies::zeros();
        for (i, body) in jacobian.body_indices.iter().enumerate() {
            let Some(BodyIndices { velocity, .. }) = *body else { continue };
            let moved: f64 = jacobian.by_position[i].iter().zip(&shifted).map(|(by, x)| by * x).sum();
            right[i] = b[velocity] + moved;
        }
        for (j, (block, solved)) in jacobian.balls.iter().zip(&self.balls).enumerate() {
            let b_p = [b[j] * per_shift, b[v + j] * per_shift];
            let pushed = product(stiffness(block), b_p);
            let along = block.by_position.map(|row| row.iter().zip(&shifted).map(|(by, x)| by * x).sum::<f64>());
            let r = product(solved.inverse, [b[w + j] + pushed[0] + along[0], b[w_z + j] + pushed[1] + along[1]]);
            (b[w + j], b[w_z + j]) = (r[0], r[1]);
            for (i, row) in block.rings_by_ball.iter().enumerate() {
                if jacobian.body_indices[i].is_some() {
                    right[i] += row[0] * (b_p[0] + r[0] * per_shift)
                        + row[1] * (b_p[1] + r[1] * per_shift)
                        + row[2] * r[0]
                        + row[3] * r[1];
                }
            }
        }
        if !self.bodies.as_ref().is_some_and(|bodies| bodies.solve_mut(&mut right)) {
            // Error control takes a step back whose result is NaN.
            right.fill(f64::NAN);
        }
        for (i, body) in jacobian.body_indices.iter().enumerate() {
            match *body {
                Some(BodyIndices { position, velocity }) => {
                    b[velocity] = right[i];
                    b[position] = (right[i] + b[position]) * per_shift;
                }
                None => right[i] = 0.0,
            }
        }
        for (j, (block, solved)) in jacobian.balls.iter().zip(&self.balls).enumerate() {
            for (slot, row) in [w + j, w_z + j].into_iter().zip(&solved.by_rings) {
                b[slot] += row.iter().zip(right.iter()).map(|(by, velocity)| by * velocity).sum::<f64>();
            }
            let carried = block.carried(right.as_slice());
            b[j] = (b[j] + b[w + j] - carried[0]) * per_shift;
            b[v + j] = (b[v + j] + b[w_z + j] - carried[1]) * per_shift;
        }
    }
}

/// E's column of one ring coordinate.
fn unit_carried(block: &SpatialBlock, coordinate: usize) -> [f64; 2] {
    let mut unit = [0.0; RINGS];
    unit[coordinate] = 1.0;
    block.carried(&unit)
}
