//! A filter on a grid by its answer to a unit at the origin: a periodic convolution in two directions.

use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

use crate::keep_ends_real;

/// A filter whose answer is real and even in both directions, so that its spectrum is real.
pub struct EvenFilter {
    period: [usize; 2],
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    across: [Arc<dyn Fft<f64>>; 2],
    /// Over the normalisation: `[frequency along × rows of a period + frequency across]`.
    spectrum: Vec<f64>,
    /// In the order of the spectrum.
    values: Vec<Complex<f64>>,
    row: Vec<f64>,
    lines: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl EvenFilter {
    /// Filter whose answer to a unit at the origin is `kernel[row × along + column]`, which repeats itself with the
    /// period `along` in columns and that of its rows; `shape` turns its spectrum, of which it is given each value and
    /// the largest, into the filter's.
    pub fn new(along: usize, kernel: &[f64], shape: &dyn Fn(f64, f64) -> f64) -> Self {
        let rows = kernel.len() / along;
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        let (forward, backward) = (real.plan_fft_forward(along), real.plan_fft_inverse(along));
        let across = [complex.plan_fft_forward(rows), complex.plan_fft_inverse(rows)];
        let scratch = [forward.get_scratch_len(), backward.get_scratch_len()].into_iter();
        let scratch = scratch.chain(across.iter().map(|fft| fft.get_inplace_scratch_len())).max().unwrap_or(0);
        let zero = Complex::new(0.0, 0.0);
        let width = along / 2 + 1;
        let mut filter = Self {
            period: [along, rows],
            forward,
            backward,
            across,
            spectrum: Vec::new(),
            values: vec![zero; width * rows],
            row: vec![0.0; along],
            lines: vec![zero; width],
            scratch: vec![zero; scratch],
        };
        filter.transform(along, kernel);
        let largest = filter.values.iter().fold(0.0_f64, |most, value| most.max(value.re));
        let scale = 1.0 / kernel.len() as f64;
        filter.spectrum = filter.values.iter().map(|value| scale * shape(value.re, largest)).collect();
        filter
    }

    /// `output` is the filter's answer to `input`, both `[row × columns + column]`, of at most a period; what is left
    /// of the period counts as zero.
    pub fn apply(&mut self, columns: usize, input: &[f64], output: &mut [f64]) {
        self.transform(columns, input);
        let rows = self.period[1];
        for (line, factors) in self.values.chunks_exact_mut(rows).zip(self.spectrum.chunks_exact(rows)) {
            for (value, factor) in line.iter_mut().zip(factors) {
                *value *= factor;
            }
            self.across[1].process_with_scratch(line, &mut self.scratch);
        }
        for (j, out) in output.chunks_exact_mut(columns).enumerate() {
            for (line, values) in self.lines.iter_mut().zip(self.values.chunks_exact(rows)) {
                *line = values[j];
            }
            keep_ends_real(&mut self.lines, self.period[0]);
            // Lengths are those of the plan.
            let _ = self.backward.process_with_scratch(&mut self.lines, &mut self.row, &mut self.scratch);
            out.copy_from_slice(&self.row[..columns]);
        }
    }

    /// The spectrum of `input` into `values`.
    fn transform(&mut self, columns: usize, input: &[f64]) {
        let rows = self.period[1];
        self.values.fill(Complex::new(0.0, 0.0));
        for (j, row) in input.chunks_exact(columns).enumerate() {
            self.row[..columns].copy_from_slice(row);
            self.row[columns..].fill(0.0);
            // Lengths are those of the plan.
            let _ = self.forward.process_with_scratch(&mut self.row, &mut self.lines, &mut self.scratch);
            for (line, values) in self.lines.iter().zip(self.values.chunks_exact_mut(rows)) {
                values[j] = *line;
            }
        }
        for line in self.values.chunks_exact_mut(rows) {
            self.across[0].process_with_scratch(line, &mut self.scratch);
        }
    }
}
