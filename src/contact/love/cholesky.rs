//! Dense Cholesky factorisation A = L Lᵀ of one symmetric positive definite matrix, in storage that is used again and
//! again.
//!
//! Rows lie in blocks of eight, each block column by column: what an inner loop reads is consecutive, and a matrix with
//! the first rows of the last one keeps their part of the factor. Every entry is formed by fused multiply-adds in
//! ascending order of the summation index and every dot product by eight fixed partial sums, so the bits depend neither
//! on what is kept nor on the vector width of the machine, by which nalgebra's and faer's choose their order of sums;
//! these allocate, too. Nothing is allocated here once the storage has met its largest matrix.

use pulp::{Arch, NullaryFnOnce, Simd, WithSimd};

/// Rows of a block, and columns eliminated together.
pub(super) const BLOCK: usize = 8;
/// Entries of a square block.
const SQUARE: usize = BLOCK * BLOCK;

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
    blocks: usize,
    /// Block after block of rows, up to the square on the diagonal.
    entries: Vec<f64>,
    inverse_diagonal: Vec<f64>,
}

/// Where a block of rows begins.
fn start(block: usize) -> usize {
    SQUARE * (block * (block + 1) / 2)
}

impl Cholesky {
    /// Makes room for a matrix of this order; its columns are then to be set with [`Cholesky::set_column`].
    pub fn resize(&mut self, order: usize) {
        self.order = order;
        self.blocks = order.div_ceil(BLOCK);
        let needed = start(self.blocks);
        if self.entries.len() < needed {
            self.entries.resize(needed, 0.0);
            self.inverse_diagonal.resize(BLOCK * self.blocks, 0.0);
        }
        // The padding is the identity, so that every block is full.
        for c in order..BLOCK * self.blocks {
            let column = needed - BLOCK * (BLOCK * self.blocks - c);
            self.entries[column..column + BLOCK].fill(0.0);
            self.entries[column + c % BLOCK] = 1.0;
        }
    }

    /// Order of the matrix.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Sets a column of the matrix, whole blocks of rows from the one on that `row` is in; what is above the diagonal
    /// does not count, and what is below the matrix is to be 0.
    pub fn set_column(&mut self, column: usize, row: usize, values: &[f64]) {
        for (block, values) in (row / BLOCK..self.blocks).zip(values.chunks_exact(BLOCK)) {
            let at = start(block) + BLOCK * column;
            self.entries[at..at + BLOCK].copy_from_slice(values);
        }
    }

    /// Replaces the matrix by its factor. The first `kept` rows hold that of a matrix with the same ones.
    pub fn factor(&mut self, kept: usize) -> Result<(), NotPositiveDefinite> {
        Arch::new().dispatch(Factor(self, kept / BLOCK))
    }

    /// Replaces `b` by A⁻¹ b. `b` has [`Cholesky::solve_length`] entries, those beyond the order are zero.
    pub fn solve(&self, b: &mut [f64]) {
        Arch::new().dispatch(Solve(self, b));
    }

    /// Length of a right-hand side with its padding.
    pub fn solve_length(&self) -> usize {
        BLOCK * self.blocks
    }

    /// A square of the factor: rows of block `i`, columns of block `j`.
    #[inline(always)]
    fn square(&self, i: usize, j: usize) -> &[f64] {
        &self.entries[start(i) + SQUARE * j..start(i) + SQUARE * (j + 1)]
    }
}

/// Factorisation from a block of rows on.
struct Factor<'a>(&'a mut Cholesky, usize);

impl WithSimd for Factor<'_> {
    type Output = Result<(), NotPositiveDefinite>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        // As many sums as there are registers for.
        if S::F64_LANES < BLOCK { self.by_columns::<4>() } else { self.by_columns::<BLOCK>() }
    }
}

impl Factor<'_> {
    #[inline(always)]
    fn by_columns<const C: usize>(self) -> Result<(), NotPositiveDefinite> {
        let Self(m, kept) = self;
        for j in 0..m.blocks {
            let (above, rest) = m.entries.split_at_mut(start(j + 1));
            let (done, diagonal) = above[start(j)..].split_at_mut(SQUARE * j);
            if j >= kept {
                update::<C>(diagonal, done, done);
                factor_diagonal(diagonal, &mut m.inverse_diagonal[BLOCK * j..], BLOCK * j)?;
            }
            let inverse = row::<BLOCK>(&m.inverse_diagonal, BLOCK * j);
            for i in kept.max(j + 1)..m.blocks {
                let rows = &mut rest[start(i) - start(j + 1)..];
                let (left, square) = rows.split_at_mut(SQUARE * j);
                let square = &mut square[..SQUARE];
                update::<C>(square, left, done);
                solve_square(square, diagonal, &inverse);
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

/// A square −= L(its rows, k) L(its columns, k) over all finished columns k, C of its columns at once.
#[inline(always)]
fn update<const C: usize>(square: &mut [f64], rows: &[f64], columns: &[f64]) {
    for from in (0..BLOCK).step_by(C) {
        let mut sum: [[f64; BLOCK]; C] = std::array::from_fn(|c| row(square, BLOCK * (from + c)));
        for (a, b) in rows.chunks_exact(BLOCK).zip(columns.chunks_exact(BLOCK)) {
            let (a, b) = (row::<BLOCK>(a, 0), row::<C>(b, from));
            for c in 0..C {
                let minus = -b[c];
                for r in 0..BLOCK {
                    sum[c][r] = a[r].mul_add(minus, sum[c][r]);
                }
            }
        }
        for (column, sum) in square[BLOCK * from..].chunks_exact_mut(BLOCK).zip(&sum) {
            column.copy_from_slice(sum);
        }
    }
}

/// The square on the diagonal, of which the upper triangle is never read; `before` pivots were found.
#[inline(always)]
fn factor_diagonal(square: &mut [f64], inverse_diagonal: &mut [f64], before: usize) -> Result<(), NotPositiveDefinite> {
    for c in 0..BLOCK {
        let pivot = square[BLOCK * c + c];
        if pivot.is_nan() || pivot <= 0.0 {
            return Err(NotPositiveDefinite { pivot: before + c + 1 });
        }
        let root = pivot.sqrt();
        let inverse = 1.0 / root;
        inverse_diagonal[c] = inverse;
        square[BLOCK * c + c] = root;
        for r in c + 1..BLOCK {
            square[BLOCK * c + r] *= inverse;
        }
        for next in c + 1..BLOCK {
            let factor = -square[BLOCK * c + next];
            for r in next..BLOCK {
                square[BLOCK * next + r] = square[BLOCK * c + r].mul_add(factor, square[BLOCK * next + r]);
            }
        }
    }
    Ok(())
}

/// A square below the one on the diagonal: X Lᵀ = A.
#[inline(always)]
fn solve_square(square: &mut [f64], diagonal: &[f64], inverse: &[f64; BLOCK]) {
    let mut x = [[0.0_f64; BLOCK]; BLOCK];
    for c in 0..BLOCK {
        let mut column = row::<BLOCK>(square, BLOCK * c);
        for (k, solved) in x.iter().enumerate().take(c) {
            let minus = -diagonal[BLOCK * k + c];
            for r in 0..BLOCK {
                column[r] = solved[r].mul_add(minus, column[r]);
            }
        }
        for value in &mut column {
            *value *= inverse[c];
        }
        x[c] = column;
        square[BLOCK * c..BLOCK * (c + 1)].copy_from_slice(&column);
    }
}

struct Solve<'a, 'b>(&'a Cholesky, &'b mut [f64]);

impl NullaryFnOnce for Solve<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Solve(m, b) = self;
        for j in 0..m.blocks {
            let diagonal = m.square(j, j);
            let mut x = row::<BLOCK>(b, BLOCK * j);
            for c in 0..BLOCK {
                x[c] *= m.inverse_diagonal[BLOCK * j + c];
                let value = x[c];
                for r in c + 1..BLOCK {
                    x[r] = diagonal[BLOCK * c + r].mul_add(-value, x[r]);
                }
            }
            b[BLOCK * j..BLOCK * (j + 1)].copy_from_slice(&x);
            for i in j + 1..m.blocks {
                let square = m.square(i, j);
                let mut sum = row::<BLOCK>(b, BLOCK * i);
                for c in 0..BLOCK {
                    let l = row::<BLOCK>(square, BLOCK * c);
                    for r in 0..BLOCK {
                        sum[r] = l[r].mul_add(-x[c], sum[r]);
                    }
                }
                b[BLOCK * i..BLOCK * (i + 1)].copy_from_slice(&sum);
            }
        }
        for j in (0..m.blocks).rev() {
            let mut partial = [[0.0; BLOCK]; BLOCK];
            for i in j + 1..m.blocks {
                let (square, y) = (m.square(i, j), row::<BLOCK>(b, BLOCK * i));
                for c in 0..BLOCK {
                    let l = row::<BLOCK>(square, BLOCK * c);
                    for r in 0..BLOCK {
                        partial[c][r] = l[r].mul_add(y[r], partial[c][r]);
                    }
                }
            }
            let diagonal = m.square(j, j);
            let mut x = row::<BLOCK>(b, BLOCK * j);
            for c in (0..BLOCK).rev() {
                let p = &partial[c];
                let mut sum = x[c] - (((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7])));
                for r in c + 1..BLOCK {
                    sum = diagonal[BLOCK * c + r].mul_add(-x[r], sum);
                }
                x[c] = sum * m.inverse_diagonal[BLOCK * j + c];
            }
            b[BLOCK * j..BLOCK * (j + 1)].copy_from_slice(&x);
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

    /// Sets the columns of a matrix from row `kept` on.
    fn set(m: &mut Cholesky, order: usize, kept: usize, of: impl Fn(usize, usize) -> f64) {
        m.resize(order);
        for c in 0..order {
            let from = c.max(kept);
            let rows = from - from % BLOCK..order.next_multiple_of(BLOCK);
            let values: Vec<f64> = rows.map(|r| if r < order { of(r, c) } else { 0.0 }).collect();
            m.set_column(c, from, &values);
        }
    }

    #[test]
    fn solution_satisfies_the_system_at_every_order_around_the_panel_width() {
        let mut m = Cholesky::default();
        for order in [1, 2, 7, 8, 9, 16, 23, 24, 25, 61, 200, 5] {
            set(&mut m, order, 0, entry);
            assert_eq!(m.factor(0), Ok(()));
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
            set(&mut m, order, 0, entry);
            m
        };
        let (mut native, mut plain) = (filled(), filled());
        assert_eq!((native.factor(0), Arch::Scalar.dispatch(Factor(&mut plain, 0))), (Ok(()), Ok(())));
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
    fn a_factor_that_keeps_its_first_rows_has_the_bits_of_one_made_anew() {
        for (before, order, kept) in [(61, 61, 40), (30, 61, 24), (61, 32, 32), (24, 21, 8)] {
            let other = |r: usize, c: usize| entry(r, c) + if r == c && r >= kept { 0.25 } else { 0.0 };
            let (mut anew, mut known) = (Cholesky::default(), Cholesky::default());
            set(&mut anew, order, 0, other);
            set(&mut known, before, 0, entry);
            assert_eq!((anew.factor(0), known.factor(0)), (Ok(()), Ok(())));
            set(&mut known, order, kept, other);
            assert_eq!(known.factor(kept), Ok(()));
            let solution = |m: &Cholesky| -> Vec<u64> {
                let mut b = vec![0.0; m.solve_length()];
                (0..order).for_each(|i| b[i] = (i as f64).sqrt());
                m.solve(&mut b);
                b.into_iter().map(f64::to_bits).collect()
            };
            assert_eq!(solution(&known), solution(&anew), "{before} {order} {kept}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let mut m = Cholesky::default();
        m.resize(2);
        m.set_column(0, 0, &[1.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        m.set_column(1, 1, &[2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(m.factor(0), Err(NotPositiveDefinite { pivot: 2 }));
    }
}
