//! The product K p on a whole grid by Fourier transforms, and its cheap approximate inverse.
//!
//! K is a convolution: padded to twice the grid it becomes circular (Hockney's method) and exact. The kernel is even, so its spectrum is
//! real. Without padding and divided by the same spectrum, sampled at every other frequency, the transform inverts K up to the
//! influence of the borders: the preconditioner. Not used inside a simulation: the library's transforms choose their
//! instructions by machine, so the last bits differ between machines.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex, num_complex::Complex};
use rustfft::{Fft, FftPlanner};

use super::half_space::KernelTable;

type C = Complex<f64>;

/// A filter on a real grid, by its real spectrum.
struct Filter {
    columns: usize,
    rows: usize,
    padded_columns: usize,
    padded_rows: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    down: Arc<dyn Fft<f64>>,
    up: Arc<dyn Fft<f64>>,
    /// Spectrum over the normalisation, `[frequency x × padded_rows + frequency y]`.
    spectrum: Vec<f64>,
    line: Vec<f64>,
    by_rows: Vec<C>,
    by_columns: Vec<C>,
    scratch: Vec<C>,
}

impl Filter {
    fn new(columns: usize, rows: usize, padded_columns: usize, padded_rows: usize) -> Self {
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let forward = real.plan_fft_forward(padded_columns);
        let backward = real.plan_fft_inverse(padded_columns);
        let down = complex.plan_fft_forward(padded_rows);
        let up = complex.plan_fft_inverse(padded_rows);
        let half = padded_columns / 2 + 1;
        let zero = C::new(0.0, 0.0);
        let scratch = [
            forward.get_scratch_len(),
            backward.get_scratch_len(),
            down.get_inplace_scratch_len(),
            up.get_inplace_scratch_len(),
        ];
        Self {
            columns,
            rows,
            padded_columns,
            padded_rows,
            spectrum: vec![0.0; half * padded_rows],
            line: vec![0.0; padded_columns],
            by_rows: vec![zero; half * padded_rows.max(rows)],
            by_columns: vec![zero; half * padded_rows],
            scratch: vec![zero; scratch.into_iter().max().unwrap_or(0)],
            forward,
            backward,
            down,
            up,
        }
    }

    fn half(&self) -> usize {
        self.padded_columns / 2 + 1
    }

    fn rows_forward(&mut self, input: &[f64], rows: usize, columns: usize) {
        let half = self.half();
        for (row, out) in input.chunks_exact(columns).take(rows).zip(self.by_rows.chunks_exact_mut(half)) {
            self.line[..columns].copy_from_slice(row);
            self.line[columns..].fill(0.0);
            // The only error is a wrong length, and the lengths are this filter's own.
            let _ = self.forward.process_with_scratch(&mut self.line, out, &mut self.scratch);
        }
    }

    fn columns_forward(&mut self, rows: usize) {
        let (half, padded) = (self.half(), self.padded_rows);
        transpose(&self.by_rows, half, rows, &mut self.by_columns, padded);
        for column in self.by_columns.chunks_exact_mut(padded) {
            column[rows..].fill(C::new(0.0, 0.0));
        }
        self.down.process_with_scratch(&mut self.by_columns, &mut self.scratch);
    }

    fn apply(&mut self, input: &[f64], output: &mut [f64]) {
        let (half, padded) = (self.half(), self.padded_rows);
        self.rows_forward(input, self.rows, self.columns);
        self.columns_forward(self.rows);
        for (value, &factor) in self.by_columns.iter_mut().zip(&self.spectrum) {
            *value *= factor;
        }
        self.up.process_with_scratch(&mut self.by_columns, &mut self.scratch);
        transpose_back(&self.by_columns, padded, half, &mut self.by_rows, self.rows);
        for (spectrum, out) in self.by_rows.chunks_exact_mut(half).zip(output.chunks_exact_mut(self.columns)) {
            spectrum[0].im = 0.0;
            if self.padded_columns.is_multiple_of(2) {
                spectrum[half - 1].im = 0.0;
            }
            let _ = self.backward.process_with_scratch(spectrum, &mut self.line, &mut self.scratch);
            out.copy_from_slice(&self.line[..self.columns]);
        }
    }
}

/// `to[column × stride + row] = from[row × columns + column]`, in blocks that fit the cache.
fn transpose(from: &[C], columns: usize, rows: usize, to: &mut [C], stride: usize) {
    const SIDE: usize = 8;
    for row in (0..rows).step_by(SIDE) {
        for column in (0..columns).step_by(SIDE) {
            for c in column..(column + SIDE).min(columns) {
                for r in row..(row + SIDE).min(rows) {
                    to[c * stride + r] = from[r * columns + c];
                }
            }
        }
    }
}

/// The inverse of [`transpose`], for the first `rows` rows.
fn transpose_back(from: &[C], stride: usize, columns: usize, to: &mut [C], rows: usize) {
    const SIDE: usize = 8;
    for row in (0..rows).step_by(SIDE) {
        for column in (0..columns).step_by(SIDE) {
            for r in row..(row + SIDE).min(rows) {
                for c in column..(column + SIDE).min(columns) {
                    to[r * columns + c] = from[c * stride + r];
                }
            }
        }
    }
}

/// K and an approximation of K⁻¹ on one grid.
pub struct FftProduct {
    product: Filter,
    inverse: Filter,
}

impl FftProduct {
    /// Product on `columns` × `rows` cells. The table holds at least as many offsets.
    pub fn new(kernel: &KernelTable, columns: usize, rows: usize) -> Self {
        let mut product = Filter::new(columns, rows, 2 * columns, 2 * rows);
        let mut wrapped = vec![0.0; 4 * columns * rows];
        for j in 0..2 * rows {
            for i in 0..2 * columns {
                let (di, dj) = (i.min(2 * columns - i), j.min(2 * rows - j));
                if di < columns && dj < rows {
                    wrapped[j * 2 * columns + i] = kernel.row(dj)[kernel.columns() - 1 + di];
                }
            }
        }
        product.rows_forward(&wrapped, 2 * rows, 2 * columns);
        product.columns_forward(2 * rows);
        let cells = (4 * columns * rows) as f64;
        for (out, value) in product.spectrum.iter_mut().zip(&product.by_columns) {
            *out = value.re / cells;
        }
        let mut inverse = Filter::new(columns, rows, columns, rows);
        let largest = product.spectrum.iter().fold(0.0_f64, |m, &v| m.max(v)) * cells;
        for i in 0..columns / 2 + 1 {
            for j in 0..rows {
                let eigenvalue = product.spectrum[2 * i * 2 * rows + 2 * j] * cells;
                // The truncated kernel's spectrum may ring; a preconditioner has to stay positive.
                let safe = eigenvalue.max(1e-6 * largest);
                inverse.spectrum[i * rows + j] = 1.0 / (safe * (columns * rows) as f64);
            }
        }
        Self { product, inverse }
    }

    /// `output` = K `input`.
    pub fn multiply(&mut self, input: &[f64], output: &mut [f64]) {
        self.product.apply(input, output);
    }

    /// `output` ≈ K⁻¹ `input`; symmetric and positive definite.
    pub fn approximate_inverse(&mut self, input: &[f64], output: &mut [f64]) {
        self.inverse.apply(input, output);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn product_equals_the_direct_sum() {
        let (columns, rows) = (12, 9);
        let kernel = KernelTable::new(columns, rows, [1.0, 3.0]);
        let mut fft = FftProduct::new(&kernel, columns, rows);
        let p: Vec<f64> = (0..columns * rows).map(|i| ((i * 37) % 11) as f64 - 3.0).collect();
        let mut u = vec![0.0; p.len()];
        fft.multiply(&p, &mut u);
        for j in 0..rows {
            for i in 0..columns {
                let mut sum = 0.0;
                for l in 0..rows {
                    for k in 0..columns {
                        sum += kernel.row(j.abs_diff(l))[columns - 1 + i.abs_diff(k)] * p[l * columns + k];
                    }
                }
                // Rounding of a sum of 108 terms of order 10.
                assert!((sum - u[j * columns + i]).abs() < 1e-11, "{i} {j}: {sum} {}", u[j * columns + i]);
            }
        }
    }
}
