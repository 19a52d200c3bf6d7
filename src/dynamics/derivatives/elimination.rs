//! Solves (s − J) x = b for the arrow-shaped Jacobian J, s > 0, in O(Z).
//!
//! With the bodies' positions eliminated, X = (V + b_X)/s, letters as [there](super::arrow), each element follows from
//! the velocities V by its own block, and V by elimination with row pivoting:
//! ```text
//! M = s (s − C) − A       c_p = b_p − E V      c_r = b_r + G_x X + G_v V
//! M p = c_r + (s − C) c_p      M r = s c_r + A c_p
//! s V = D V + P X + Σ (B_p p + B_r r) + b_V
//! ```
//! Rows of bodies without state are those of the unit matrix.

use super::arrow::{ArrowJacobian, Block};
use super::fastest::BodyIndices;
use nalgebra::{Const, DimMin, LU, SMatrix, SVector};

/// The eliminated matrix s − J; holds nothing between steps that matters.
#[derive(Debug, Clone)]
pub(super) struct Elimination<const N: usize, const R: usize, const B: usize>
where
    Const<B>: DimMin<Const<B>, Output = Const<B>>,
{
    shift: f64,
    elements: Vec<Eliminated<N, R>>,
    /// `None` where no body has a state.
    bodies: Option<LU<f64, Const<B>, Const<B>>>,
}

/// One element's block, solved.
#[derive(Debug, Clone, Copy)]
struct Eliminated<const N: usize, const R: usize> {
    /// M⁻¹
    inverse: SMatrix<f64, N, N>,
    /// ∂p/∂V and ∂r/∂V
    by_rings: [SMatrix<f64, N, R>; 2],
}

impl<const N: usize, const R: usize, const B: usize> Elimination<N, R, B>
where
    Const<B>: DimMin<Const<B>, Output = Const<B>>,
{
    /// Room for so many elements.
    pub(super) fn new(count: usize) -> Self {
        let none = Eliminated { inverse: SMatrix::zeros(), by_rings: [SMatrix::zeros(); 2] };
        Self { shift: 1.0, elements: vec![none; count], bodies: None }
    }

    /// Eliminates `shift` − `jacobian`.
    pub(super) fn factor(&mut self, jacobian: &ArrowJacobian<N, R, B>, shift: f64) {
        self.shift = shift;
        let per_shift = 1.0 / shift;
        let coupled = jacobian.bodies.iter().any(Option::is_some);
        let mut matrix = SMatrix::<f64, B, B>::from_diagonal_element(shift)
            - jacobian.by_velocity
            - jacobian.by_position * per_shift;
        for (block, solved) in jacobian.elements.iter().zip(&mut self.elements) {
            let Block { carried, by_place, .. } = block;
            let undamped = undamped(block, shift);
            solved.inverse = inverse(undamped * shift - by_place);
            if coupled {
                let pushed = block.by_position * per_shift + block.by_velocity;
                solved.by_rings = [pushed - undamped * carried, pushed * shift - by_place * carried]
                    .map(|pushed| solved.inverse * pushed);
                let [places, rates] = &solved.by_rings;
                let mut rings = matrix.fixed_view_mut::<R, R>(0, 0);
                rings -= block.rings_by_place * places + block.rings_by_rate * rates;
            }
        }
        for i in (0..B).filter(|&i| jacobian.bodies[i].is_none()) {
            matrix.row_mut(i).fill(0.0);
            matrix.column_mut(i).fill(0.0);
            matrix[(i, i)] = 1.0;
        }
        self.bodies = coupled.then(|| matrix.lu());
    }

    /// Puts x into `b`, for the `jacobian` that was eliminated last.
    pub(super) fn solve(&self, jacobian: &ArrowJacobian<N, R, B>, b: &mut [f64]) {
        let per_shift = 1.0 / self.shift;
        let [places, rates] = jacobian.starts;
        // What the positions' right-hand sides alone would move.
        let shifted: SVector<f64, B> =
            jacobian.bodies.map(|body| body.map_or(0.0, |body| b[body.position] * per_shift)).into();
        let shifted_rings = shifted.fixed_rows::<R>(0);
        let mut right = jacobian.by_position * shifted;
        for (j, (block, solved)) in jacobian.elements.iter().zip(&self.elements).enumerate() {
            let of = |starts: [usize; N]| SVector::<f64, N>::from(starts.map(|start| b[start + j]));
            let (b_p, c_r) = (of(places), of(rates) + block.by_position * shifted_rings);
            let p = solved.inverse * (c_r + undamped(block, self.shift) * b_p);
            let r = solved.inverse * (c_r * self.shift + block.by_place * b_p);
            for n in 0..N {
                (b[places[n] + j], b[rates[n] + j]) = (p[n], r[n]);
            }
            let mut rings = right.fixed_rows_mut::<R>(0);
            rings += block.rings_by_place * p + block.rings_by_rate * r;
        }
        for (right, body) in right.iter_mut().zip(&jacobian.bodies) {
            *right = body.map_or(0.0, |body| *right + b[body.velocity]);
        }
        if self.bodies.as_ref().is_some_and(|bodies| !bodies.solve_mut(&mut right)) {
            // Error control takes a step back whose result is NaN.
            right.fill(f64::NAN);
        }
        for (velocity_found, body) in right.iter().zip(&jacobian.bodies) {
            if let Some(BodyIndices { position, velocity }) = *body {
                b[velocity] = *velocity_found;
                b[position] = (velocity_found + b[position]) * per_shift;
            }
        }
        let velocities = right.fixed_rows::<R>(0);
        for (j, solved) in self.elements.iter().enumerate() {
            let [p, r] = solved.by_rings.map(|by| by * velocities);
            for n in 0..N {
                b[places[n] + j] += p[n];
                b[rates[n] + j] += r[n];
            }
        }
    }
}

/// s − C
fn undamped<const N: usize, const R: usize>(block: &Block<N, R>, shift: f64) -> SMatrix<f64, N, N> {
    SMatrix::from_diagonal_element(shift) - block.by_rate
}

/// The inverse of a matrix of one or two rows; not finite of a singular one.
fn inverse<const N: usize>(m: SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
    if N < 2 {
        return m.map(|only| 1.0 / only);
    }
    let determinant = m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)];
    SMatrix::from_fn(|i, k| if i == k { m[(1 - i, 1 - i)] } else { -m[(i, k)] } / determinant)
}
