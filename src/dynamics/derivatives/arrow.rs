//! The Jacobian of the right-hand side in its blocks. An element couples to the rings and to no other element, so that
//! the matrix is an arrow. With p an element's places, r their absolute rates, X and V the coordinates of rings and
//! sensors and their velocities,
//! ```text
//! p' = r − E V    r' = A p + C r + G_x X + G_v V        X' = V    V' = P X + D V + Σ (B_p p + B_r r)
//! ```

use super::fastest::{BodyIndices, Fastest};
use crate::numerics::number::Dual;
use nalgebra::SMatrix;

/// The Jacobian of elements with `N` places, of rings with `R` coordinates and of `B` coordinates in all.
#[derive(Debug, Clone)]
pub(super) struct ArrowJacobian<const N: usize, const R: usize, const B: usize> {
    /// The elements' blocks; none of elements in balance.
    pub(super) elements: Vec<Block<N, R>>,
    /// P: accelerations of the bodies by their coordinates.
    pub(super) by_position: SMatrix<f64, B, B>,
    /// D: by their velocities.
    pub(super) by_velocity: SMatrix<f64, B, B>,
    /// Where each coordinate is in the state; `None` of one without state, whose rows and columns count for nothing.
    pub(super) bodies: [Option<BodyIndices>; B],
    /// Where the elements' places and their rates begin in the state.
    pub(super) starts: [[usize; N]; 2],
}

/// One element's rows and columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Block<const N: usize, const R: usize> {
    /// E = −∂p'/∂V
    pub(super) carried: SMatrix<f64, N, R>,
    /// A = ∂r'/∂p (1/s²)
    pub(super) by_place: SMatrix<f64, N, N>,
    /// C = ∂r'/∂r (1/s)
    pub(super) by_rate: SMatrix<f64, N, N>,
    /// G_x = ∂r'/∂X
    pub(super) by_position: SMatrix<f64, N, R>,
    /// G_v = ∂r'/∂V
    pub(super) by_velocity: SMatrix<f64, N, R>,
    /// B_p = ∂V'/∂p
    pub(super) rings_by_place: SMatrix<f64, R, N>,
    /// B_r = ∂V'/∂r
    pub(super) rings_by_rate: SMatrix<f64, R, N>,
}

/// What an element does, with derivatives by its places, by their rates, by the rings' coordinates and by their
/// velocities.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElementToFirstOrder<const N: usize, const R: usize, const K: usize> {
    /// p'
    pub(super) rates: [Dual<f64, K>; N],
    /// r'
    pub(super) accelerations: [Dual<f64, K>; N],
    /// Forces on the rings.
    pub(super) on_rings: [Dual<f64, K>; R],
}

impl<const N: usize, const R: usize> Block<N, R> {
    /// Of an element that nothing moves.
    pub(super) fn none() -> Self {
        let (square, wide, high) = (SMatrix::zeros(), SMatrix::zeros(), SMatrix::zeros());
        Self {
            carried: wide,
            by_place: square,
            by_rate: square,
            by_position: wide,
            by_velocity: wide,
            rings_by_place: high,
            rings_by_rate: high,
        }
    }
}

impl<const N: usize, const R: usize, const B: usize> ArrowJacobian<N, R, B> {
    /// Room for so many elements.
    pub(super) fn new(count: usize, bodies: [Option<BodyIndices>; B], starts: [[usize; N]; 2]) -> Self {
        let none = SMatrix::zeros();
        Self { elements: vec![Block::none(); count], by_position: none, by_velocity: none, bodies, starts }
    }

    /// Puts element `j` in; its part of the bodies' accelerations is added.
    #[inline(always)]
    pub(super) fn put<const K: usize>(
        &mut self,
        j: usize,
        of: &ElementToFirstOrder<N, R, K>,
        inverse_inertia: &[f64; R],
    ) {
        let [positions, velocities] = [2 * N, 2 * N + R];
        let block = &mut self.elements[j];
        for n in 0..N {
            let (rate, acceleration) = (&of.rates[n].by, &of.accelerations[n].by);
            for m in 0..N {
                block.by_place[(n, m)] = acceleration[m];
                block.by_rate[(n, m)] = acceleration[N + m];
            }
            for i in 0..R {
                block.carried[(n, i)] = -rate[velocities + i];
                block.by_position[(n, i)] = acceleration[positions + i];
                block.by_velocity[(n, i)] = acceleration[velocities + i];
            }
        }
        for i in 0..R {
            let (inverse, force) = (inverse_inertia[i], &of.on_rings[i].by);
            for n in 0..N {
                block.rings_by_place[(i, n)] = inverse * force[n];
                block.rings_by_rate[(i, n)] = inverse * force[N + n];
            }
            for k in 0..R {
                self.by_position[(i, k)] += inverse * force[positions + k];
                self.by_velocity[(i, k)] += inverse * force[velocities + k];
            }
        }
    }

    /// As [`Jacobian::fastest`](super::Jacobian::fastest).
    pub(super) fn fastest(&self) -> Fastest {
        let mut fastest = Fastest::default();
        for block in &self.elements {
            for directions in [principal(&block.by_place), principal(&block.by_rate)] {
                for n in directions.column_iter() {
                    let form = |matrix: &SMatrix<f64, N, N>| n.dot(&(matrix * n));
                    fastest.consider(form(&block.by_place), form(&block.by_rate));
                }
            }
        }
        for i in (0..B).filter(|&i| self.bodies[i].is_some()) {
            fastest.consider(self.by_own_position(i), self.by_velocity[(i, i)]);
        }
        fastest
    }

    /// Acceleration of a coordinate by itself, all else standing still: places are seen from the outer ring, and where
    /// that moves and an element does not, its places change.
    fn by_own_position(&self, i: usize) -> f64 {
        let alone = self.by_position[(i, i)];
        if i >= R {
            return alone;
        }
        self.elements.iter().fold(alone, |sum, block| {
            (0..N).fold(sum, |sum, n| sum - block.rings_by_place[(i, n)] * block.carried[(n, i)])
        })
    }

    /// The whole matrix ∂(state')/∂(state), rows by columns, of a state of `len` slots.
    pub(super) fn matrix(&self, len: usize) -> Vec<Vec<f64>> {
        let mut matrix = vec![vec![0.0; len]; len];
        let bodies = || self.bodies.iter().enumerate().filter_map(|(i, body)| body.map(|body| (i, body)));
        for (j, block) in self.elements.iter().enumerate() {
            let [places, rates] = self.starts.map(|starts| starts.map(|start| start + j));
            for n in 0..N {
                matrix[places[n]][rates[n]] = 1.0;
                for m in 0..N {
                    matrix[rates[n]][places[m]] = block.by_place[(n, m)];
                    matrix[rates[n]][rates[m]] = block.by_rate[(n, m)];
                }
                for (i, body) in bodies().filter(|(i, _)| *i < R) {
                    matrix[places[n]][body.velocity] = -block.carried[(n, i)];
                    matrix[rates[n]][body.position] = block.by_position[(n, i)];
                    matrix[rates[n]][body.velocity] = block.by_velocity[(n, i)];
                    matrix[body.velocity][places[n]] = block.rings_by_place[(i, n)];
                    matrix[body.velocity][rates[n]] = block.rings_by_rate[(i, n)];
                }
            }
        }
        for (i, body) in bodies() {
            matrix[body.position][body.velocity] = 1.0;
            for (k, by) in bodies() {
                matrix[body.velocity][by.position] = self.by_position[(i, k)];
                matrix[body.velocity][by.velocity] = self.by_velocity[(i, k)];
            }
        }
        matrix
    }
}

/// Directions, in columns, along which the symmetric part of a matrix of one or two rows is largest in magnitude and
/// smallest.
fn principal<const N: usize>(m: &SMatrix<f64, N, N>) -> SMatrix<f64, N, N> {
    let mut directions = SMatrix::identity();
    if N < 2 {
        return directions;
    }
    let (a, d, off) = (m[(0, 0)], m[(1, 1)], 0.5 * (m[(0, 1)] + m[(1, 0)]));
    let (mean, half) = (0.5 * (a + d), 0.5 * (a - d));
    let apart = (half * half + off * off).sqrt();
    // Of the eigenvalues mean ± apart that of the larger magnitude.
    let eigenvalue = if mean >= 0.0 { mean + apart } else { mean - apart };
    let square = |[x, y]: [f64; 2]| x * x + y * y;
    let (one, other) = ([off, eigenvalue - a], [eigenvalue - d, off]);
    let n = if square(one) >= square(other) { one } else { other };
    let length = square(n).sqrt();
    if length > 0.0 {
        let [x, y] = n.map(|part| part / length);
        (directions[(0, 0)], directions[(1, 0)], directions[(0, 1)], directions[(1, 1)]) = (x, y, -y, x);
    }
    directions
}
