//! Dense Cholesky factorisation A = L Lᵀ of one symmetric positive definite matrix, in storage that is used again and
//! again.
//!
//! Left-looking in panels of eight columns. Every entry is formed by fused multiply-adds in ascending order of the
//! summation index and every dot product by eight fixed partial sums, so the bits do not depend on the vector width of
//! the machine: nalgebra's and faer's choose their order of sums by it, and allocate. Nothing is allocated once the
//! storage has met its largest matrix.

use pulp::{Arch, NullaryFnOnce};

/// Columns eliminated together.
const PANEL: usize = 8;
/// Rows updated together. Measured: sixteen spill the registers.
const TILE: usize = 8;

/// The matrix is not positive definite to working precision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotPositiveDefinite {
    /// Number of the first pivot that is not above 0, from 1.
    pub pivot: usize,
}

/// Storage of one factor.
#[derive(Debug, Clone, Default)]
pub struct Cholesky {
    order: usize,
    padded: usize,
    stride: usize,
    entries: Vec<f64>,
    inverse_diagonal: Vec<f64>,
    packed: Vec<f64>,
}

impl Cholesky {
    /// Makes room for a matrix of this order; its columns are then to be written with [`Cholesky::column_mut`].
    pub fn resize(&mut self, order: usize) {
        self.order = order;
        self.padded = order.next_multiple_of(PANEL);
        self.stride = self.padded + TILE;
        let needed = self.stride * (self.padded + 1);
        if self.entries.len() < needed {
            self.entries.resize(needed, 0.0);
            self.inverse_diagonal.resize(self.padded, 0.0);
            self.packed.resize(self.padded * PANEL, 0.0);
        }
        // The padding is the identity, so that every panel is full.
        for c in order..self.padded {
            let start = c * self.stride;
            self.entries[start + c..start + self.stride].fill(0.0);
            self.entries[start + c] = 1.0;
        }
    }

    /// Order of the matrix.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Rows `c`… of column `c` of the matrix, to be filled before [`Cholesky::factor`].
    pub fn column_mut(&mut self, c: usize) -> &mut [f64] {
        let start = c * self.stride;
        self.entries[start + self.order..start + self.stride].fill(0.0);
        &mut self.entries[start + c..start + self.order]
    }

    /// Replaces the matrix by its factor.
    pub fn factor(&mut self) -> Result<(), NotPositiveDefinite> {
        Arch::new().dispatch(Factor(self))
    }

    /// Replaces `b` by A⁻¹ b. `b` has [`Cholesky::solve_length`] entries, those beyond the order are zero.
    pub fn solve(&self, b: &mut [f64]) {
        Arch::new().dispatch(Solve(self, b));
    }

    /// Length of a right-hand side with its padding.
    pub fn solve_length(&self) -> usize {
        self.stride
    }
}

struct Factor<'a>(&'a mut Cholesky);

impl NullaryFnOnce for Factor<'_> {
    type Output = Result<(), NotPositiveDefinite>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let m = self.0;
        let (stride, padded) = (m.stride, m.padded);
        for first in (0..padded).step_by(PANEL) {
            let (done, rest) = m.entries.split_at_mut(first * stride);
            for (k, packed) in m.packed.chunks_exact_mut(PANEL).take(first).enumerate() {
                packed.copy_from_slice(&done[k * stride + first..k * stride + first + PANEL]);
            }
            let packed = &m.packed[..first * PANEL];
            // The diagonal block lies in the first tile; its upper triangle is written but never read.
            update_tile::<PANEL>(done, rest, stride, first, packed);
            factor_diagonal(rest, stride, first, &mut m.inverse_diagonal)?;
            let block = diagonal_block(rest, stride, first);
            let inverse = row::<PANEL>(&m.inverse_diagonal, first);
            for row in (first + PANEL..padded).step_by(TILE) {
                update_tile::<TILE>(done, rest, stride, row, packed);
                solve_tile(rest, stride, row, &block, &inverse);
            }
        }
        Ok(())
    }
}

/// Copy of R consecutive entries; the slice is always long enough, shorter ones would be read as zero.
#[inline(always)]
fn row<const R: usize>(entries: &[f64], start: usize) -> [f64; R] {
    let mut out = [0.0; R];
    if let Some(source) = entries.get(start..start + R) {
        out.copy_from_slice(source);
    }
    out
}

/// Panel columns of rows `row`… `row + R` −= L(rows, k) L(panel, k) over all finished columns k.
#[inline(always)]
fn update_tile<const R: usize>(done: &[f64], panel: &mut [f64], stride: usize, row_index: usize, packed: &[f64]) {
    let mut sum = [[0.0_f64; R]; PANEL];
    for (c, column) in sum.iter_mut().enumerate() {
        *column = row::<R>(panel, c * stride + row_index);
    }
    for (column, factors) in done.chunks_exact(stride).zip(packed.chunks_exact(PANEL)) {
        let a = row::<R>(column, row_index);
        let b = row::<PANEL>(factors, 0);
        for c in 0..PANEL {
            let minus = -b[c];
            for r in 0..R {
                sum[c][r] = a[r].mul_add(minus, sum[c][r]);
            }
        }
    }
    for (c, column) in sum.iter().enumerate() {
        panel[c * stride + row_index..c * stride + row_index + R].copy_from_slice(column);
    }
}

#[inline(always)]
fn factor_diagonal(
    panel: &mut [f64],
    stride: usize,
    first: usize,
    inverse_diagonal: &mut [f64],
) -> Result<(), NotPositiveDefinite> {
    for c in 0..PANEL {
        let column = c * stride + first;
        let pivot = panel[column + c];
        if pivot.is_nan() || pivot <= 0.0 {
            return Err(NotPositiveDefinite { pivot: first + c + 1 });
        }
        let root = pivot.sqrt();
        let inverse = 1.0 / root;
        inverse_diagonal[first + c] = inverse;
        panel[column + c] = root;
        for r in c + 1..PANEL {
            panel[column + r] *= inverse;
        }
        for next in c + 1..PANEL {
            let factor = -panel[column + next];
            for r in next..PANEL {
                let target = next * stride + first + r;
                panel[target] = panel[column + r].mul_add(factor, panel[target]);
            }
        }
    }
    Ok(())
}

#[inline(always)]
fn diagonal_block(panel: &[f64], stride: usize, first: usize) -> [[f64; PANEL]; PANEL] {
    let mut block = [[0.0; PANEL]; PANEL];
    for (c, column) in block.iter_mut().enumerate() {
        *column = row::<PANEL>(panel, c * stride + first);
    }
    block
}

/// Rows below the diagonal block: X Lᵀ = A, one tile of rows.
#[inline(always)]
fn solve_tile(
    panel: &mut [f64],
    stride: usize,
    row_index: usize,
    block: &[[f64; PANEL]; PANEL],
    inverse: &[f64; PANEL],
) {
    let mut x = [[0.0_f64; TILE]; PANEL];
    for c in 0..PANEL {
        let mut column = row::<TILE>(panel, c * stride + row_index);
        for (k, solved) in x.iter().enumerate().take(c) {
            let minus = -block[k][c];
            for r in 0..TILE {
                column[r] = solved[r].mul_add(minus, column[r]);
            }
        }
        for value in &mut column {
            *value *= inverse[c];
        }
        x[c] = column;
        panel[c * stride + row_index..c * stride + row_index + TILE].copy_from_slice(&column);
    }
}

struct Solve<'a, 'b>(&'a Cholesky, &'b mut [f64]);

impl NullaryFnOnce for Solve<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Solve(m, b) = self;
        let (stride, padded) = (m.stride, m.padded);
        for first in (0..padded).step_by(PANEL) {
            let panel = &m.entries[first * stride..(first + PANEL) * stride];
            let mut x = row::<PANEL>(b, first);
            for c in 0..PANEL {
                x[c] *= m.inverse_diagonal[first + c];
                let value = x[c];
                for r in c + 1..PANEL {
                    x[r] = panel[c * stride + first + r].mul_add(-value, x[r]);
                }
            }
            b[first..first + PANEL].copy_from_slice(&x);
            for at in (first + PANEL..padded).step_by(PANEL) {
                let mut sum = row::<PANEL>(b, at);
                for c in 0..PANEL {
                    let l = row::<PANEL>(panel, c * stride + at);
                    for r in 0..PANEL {
                        sum[r] = l[r].mul_add(-x[c], sum[r]);
                    }
                }
                b[at..at + PANEL].copy_from_slice(&sum);
            }
        }
        for first in (0..padded).step_by(PANEL).rev() {
            let panel = &m.entries[first * stride..(first + PANEL) * stride];
            let mut partial = [[0.0; PANEL]; PANEL];
            for at in (first + PANEL..padded).step_by(PANEL) {
                let y = row::<PANEL>(b, at);
                for c in 0..PANEL {
                    let l = row::<PANEL>(panel, c * stride + at);
                    for r in 0..PANEL {
                        partial[c][r] = l[r].mul_add(y[r], partial[c][r]);
                    }
                }
            }
            let mut x = row::<PANEL>(b, first);
            for c in (0..PANEL).rev() {
                let p = &partial[c];
                let mut sum = x[c] - (((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7])));
                for r in c + 1..PANEL {
                    sum = panel[c * stride + first + r].mul_add(-x[r], sum);
                }
                x[c] = sum * m.inverse_diagonal[first + c];
            }
            b[first..first + PANEL].copy_from_slice(&x);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A kernel-like matrix: 1/(1 + distance), positive definite.
    fn entry(i: usize, j: usize) -> f64 {
        1.0 / (1.0 + i.abs_diff(j) as f64) + if i == j { 0.5 } else { 0.0 }
    }

    #[test]
    fn solution_satisfies_the_system_at_every_order_around_the_panel_width() {
        let mut m = Cholesky::default();
        for order in [1, 2, 7, 8, 9, 16, 23, 24, 25, 61, 200, 5] {
            m.resize(order);
            for c in 0..order {
                for (r, value) in m.column_mut(c).iter_mut().enumerate() {
                    *value = entry(c + r, c);
                }
            }
            assert_eq!(m.factor(), Ok(()));
            let exact: Vec<f64> = (0..order).map(|i| 1.0 + (i % 7) as f64).collect();
            let mut b = vec![0.0; m.solve_length()];
            for i in 0..order {
                b[i] = (0..order).map(|j| entry(i, j) * exact[j]).sum();
            }
            m.solve(&mut b);
            for i in 0..order {
                // Condition number below 100, so rounding stays below 100 × order × 2⁻⁵³.
                assert!((b[i] - exact[i]).abs() < 1e-11, "order {order}, entry {i}: {} {}", b[i], exact[i]);
            }
        }
    }

    #[test]
    fn every_processor_factors_and_solves_to_the_same_bits() {
        // Without vector instructions `mul_add` is a call into Rust's runtime, which emulates it for want of an
        // instruction.
        let order = 61;
        let filled = || {
            let mut m = Cholesky::default();
            m.resize(order);
            for c in 0..order {
                m.column_mut(c).iter_mut().enumerate().for_each(|(r, value)| *value = entry(c + r, c));
            }
            m
        };
        let (mut native, mut plain) = (filled(), filled());
        assert_eq!((native.factor(), Arch::Scalar.dispatch(Factor(&mut plain))), (Ok(()), Ok(())));
        let right = |m: &Cholesky| -> Vec<f64> {
            (0..m.solve_length()).map(|i| if i < order { (i as f64).sqrt() } else { 0.0 }).collect()
        };
        let (mut by_native, mut by_plain) = (right(&native), right(&plain));
        native.solve(&mut by_native);
        Arch::Scalar.dispatch(Solve(&plain, &mut by_plain));
        let bits = |solution: &[f64]| solution.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&by_native), bits(&by_plain));
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let mut m = Cholesky::default();
        m.resize(2);
        m.column_mut(0).copy_from_slice(&[1.0, 2.0]);
        m.column_mut(1).copy_from_slice(&[1.0]);
        assert_eq!(m.factor(), Err(NotPositiveDefinite { pivot: 2 }));
    }
}
