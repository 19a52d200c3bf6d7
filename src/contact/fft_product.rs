//! Product with the influence matrix on a whole grid, and its cheap approximate inverse, by Fourier transforms.
//!
//! K is a convolution: padded to twice the grid it becomes circular (Hockney's method) and exact. The kernel is even,
//! so its spectrum is real. The approximate inverse, a preconditioner, is that of the kernel wrapped around the
//! unpadded grid, k(i) + k(N − i) in both directions: right but for the influence of the borders. The wrapped kernel
//! has to reach over a whole period: with k(N) left out the spectrum of cells much longer than wide turns negative at
//! high frequencies, and conjugate gradients take ten times as many steps.
//!
//! Rows are transformed in pairs, one as the real and one as the imaginary part, eight pairs side by side; columns
//! eight frequencies side by side. Several times as fast as transforms one after the other by a library
//! (`docs/contact.md`), and the bits are the same on every machine.

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::{
    batched_fft::{BatchedFft, Eight, LANES, good_length, scale},
    half_space::rectangle_kernel,
};

/// Rows transformed together: real and imaginary parts of all lanes.
const ROWS: usize = 2 * LANES;

/// A real, even filter on a real grid.
struct Filter {
    columns: usize,
    rows: usize,
    along: BatchedFft,
    across: BatchedFft,
    /// Slots of each frequency along the rows and of its negative, in the order of the slots: neighbours in memory
    /// are worked on together.
    pairs: Vec<[(usize, usize); LANES]>,
    /// Over the normalisation: `[eight pairs x × length y + slot y]`.
    spectrum: Vec<[f64; LANES]>,
    /// `[(sixteen rows) × length x + slot x]`.
    by_rows: Vec<Eight>,
    /// Eight frequencies x over all rows.
    by_columns: Vec<Eight>,
}

impl Filter {
    /// A filter of yet empty spectrum on `columns` × `rows` values, of the periods `along` × `across`.
    fn new(columns: usize, rows: usize, along: usize, across: usize) -> Self {
        let along = BatchedFft::new(along);
        let (length, slots) = (along.length(), along.slots());
        let mut list: Vec<_> = (0..=length / 2)
            .map(|f| (slots[f], slots[(length - f) % length]))
            .map(|(a, b)| (a.min(b), a.max(b)))
            .collect();
        list.sort_unstable();
        // The last one again and again where lanes are left over: harmless.
        let pairs = list.chunks(LANES).map(|some| std::array::from_fn(|l| some[l.min(some.len() - 1)])).collect();
        Self {
            columns,
            rows,
            along,
            pairs,
            across: BatchedFft::new(across),
            spectrum: Vec::new(),
            by_rows: vec![Eight::default(); length * rows.div_ceil(ROWS)],
            by_columns: vec![Eight::default(); across.max(rows.next_multiple_of(ROWS))],
        }
    }

    /// Filter whose answer to a unit at the origin is `kernel[j × along + i]`, even and periodic; `shape` turns its
    /// spectrum into the filter's.
    fn of(columns: usize, rows: usize, along: usize, kernel: &[f64], shape: impl Fn(f64, f64) -> f64) -> Self {
        let across = kernel.len() / along;
        let mut whole = Self::new(along, across, along, across);
        let mut spectrum = Vec::new();
        whole.rows_forward::<_, false>(Scalar::new(), kernel);
        for block in 0..whole.pairs.len() {
            whole.gather(block);
            whole.across.forward::<_, false>(Scalar::new(), &mut whole.by_columns[..across]);
            spectrum.extend(whole.by_columns[..across].iter().map(|value| value.re));
        }
        // The halves left out where pairs of rows are told apart, here once and in `apply` twice.
        let largest = 0.5 * spectrum.iter().flatten().fold(0.0_f64, |m, &v| m.max(v));
        let scale = 0.5 / kernel.len() as f64;
        for value in spectrum.iter_mut().flatten() {
            *value = scale * shape(0.5 * *value, largest);
        }
        Self { spectrum, ..Self::new(columns, rows, along, across) }
    }

    #[inline(always)]
    fn rows_forward<S: Simd, const HALF: bool>(&mut self, simd: S, input: &[f64]) {
        let length = self.along.length();
        for (block, out) in self.by_rows.chunks_exact_mut(length).enumerate() {
            // Missing rows are nought; `scatter` leaves waste in them.
            let whole = (block + 1) * ROWS <= self.rows;
            out[if whole { self.columns } else { 0 }..].fill(Eight::default());
            // In tiles, so that a line of the cache is filled at once.
            for first in (0..self.columns).step_by(LANES) {
                let last = (first + LANES).min(self.columns);
                for lane in 0..ROWS.min(self.rows - (block * ROWS).min(self.rows)) {
                    let start = (block * ROWS + lane) * self.columns;
                    for (out, &value) in out[first..last].iter_mut().zip(&input[start + first..start + last]) {
                        if lane < LANES { out.re[lane] = value } else { out.im[lane - LANES] = value }
                    }
                }
            }
            self.along.forward::<S, HALF>(simd, out);
        }
    }

    #[inline(always)]
    fn rows_backward<S: Simd, const HALF: bool>(&mut self, simd: S, output: &mut [f64]) {
        let length = self.along.length();
        for (block, data) in self.by_rows.chunks_exact_mut(length).enumerate() {
            self.along.backward::<S, HALF>(simd, data);
            for first in (0..self.columns).step_by(LANES) {
                let last = (first + LANES).min(self.columns);
                for lane in 0..ROWS.min(self.rows - (block * ROWS).min(self.rows)) {
                    let start = (block * ROWS + lane) * self.columns;
                    for (out, value) in output[start + first..start + last].iter_mut().zip(&data[first..last]) {
                        *out = if lane < LANES { value.re[lane] } else { value.im[lane - LANES] };
                    }
                }
            }
        }
    }

    /// Eight frequencies of all rows, twice: a pair of real rows z = a + ib gives 2A = Z(f) + Z*(−f), 2iB = Z(f) −
    /// Z*(−f).
    #[inline(always)]
    fn gather(&mut self, block: usize) {
        let length = self.along.length();
        for (data, out) in self.by_rows.chunks_exact(length).zip(self.by_columns.chunks_exact_mut(ROWS)) {
            let (first, second) = out.split_at_mut(LANES);
            for (lane, &(plus, minus)) in self.pairs[block].iter().enumerate() {
                let (z, w) = (&data[plus], &data[minus]);
                for row in 0..LANES {
                    first[row].re[lane] = z.re[row] + w.re[row];
                    first[row].im[lane] = z.im[row] - w.im[row];
                    second[row].re[lane] = z.im[row] + w.im[row];
                    second[row].im[lane] = w.re[row] - z.re[row];
                }
            }
        }
    }

    /// The inverse of [`Filter::gather`] without its factor.
    #[inline(always)]
    fn scatter(&mut self, block: usize) {
        let length = self.along.length();
        for (data, from) in self.by_rows.chunks_exact_mut(length).zip(self.by_columns.chunks_exact(ROWS)) {
            let (first, second) = from.split_at(LANES);
            // Rows outside: strided stores are cheaper than strided loads, for which compilers use gather instructions.
            for (row, (a, b)) in first.iter().zip(second).enumerate() {
                for (lane, &(plus, minus)) in self.pairs[block].iter().enumerate() {
                    let out = &mut data[plus];
                    out.re[row] = a.re[lane] - b.im[lane];
                    out.im[row] = a.im[lane] + b.re[lane];
                    let out = &mut data[minus];
                    out.re[row] = a.re[lane] + b.im[lane];
                    out.im[row] = b.re[lane] - a.im[lane];
                }
            }
        }
    }
}

/// One application; with `HALF` the grid is at most half the period.
struct Apply<'a, const HALF: bool>(&'a mut Filter, &'a [f64], &'a mut [f64]);

impl<const HALF: bool> WithSimd for Apply<'_, HALF> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Apply(filter, input, output) = self;
        filter.rows_forward::<S, HALF>(simd, input);
        let length = filter.across.length();
        let filled = filter.rows.next_multiple_of(ROWS).min(length);
        for block in 0..filter.pairs.len() {
            filter.gather(block);
            let data = &mut filter.by_columns[..length];
            data[filled..].fill(Eight::default());
            filter.across.forward::<S, HALF>(simd, data);
            scale(simd, data, &filter.spectrum[block * length..(block + 1) * length]);
            filter.across.backward::<S, HALF>(simd, data);
            // Waste in the padding is no transform of real rows, and would spoil the row that shares its lane.
            data[filter.rows.min(filled)..filled].fill(Eight::default());
            filter.scatter(block);
        }
        filter.rows_backward::<S, HALF>(simd, output);
    }
}

/// K and an approximation of K⁻¹ on one grid.
pub struct FftProduct {
    product: Filter,
    inverse: Filter,
}

impl FftProduct {
    /// Product on `columns` × `rows` cells of the full sides `cell` (m).
    pub fn new(columns: usize, rows: usize, cell: [f64; 2]) -> Self {
        let (along, across) = (good_length(2 * columns), good_length(2 * rows));
        let (near, far) = (good_length(columns), good_length(rows));
        let (width, height) = (along / 2 + 1, across / 2 + 1);
        let (width, height) = (width.max(near + 1), height.max(far + 1));
        let mut kernel = vec![0.0; width * height];
        for (c, value) in kernel.iter_mut().enumerate() {
            let (x, y) = ((c % width) as f64 * cell[0], (c / width) as f64 * cell[1]);
            *value = rectangle_kernel(x, y, 0.5 * cell[0], 0.5 * cell[1]);
        }
        let at = |i: usize, j: usize| kernel[j * width + i];
        // Offsets between the grid's cells end before half a period: what stands beyond them is never used.
        let padded: Vec<f64> = (0..along * across)
            .map(|c| at((c % along).min(along - c % along), (c / along).min(across - c / along)))
            .collect();
        let wrapped: Vec<f64> = (0..near * far)
            .map(|c| {
                let (i, j) = (c % near, c / near);
                (at(i, j) + at(near - i, far - j)) + (at(near - i, j) + at(i, far - j))
            })
            .collect();
        Self {
            product: Filter::of(columns, rows, along, &padded, |eigenvalue, _| eigenvalue),
            // A preconditioner has to be positive; the wrapped kernel's spectrum is, this guards against rounding.
            inverse: Filter::of(columns, rows, near, &wrapped, |eigenvalue, largest| {
                1.0 / eigenvalue.max(1e-6 * largest)
            }),
        }
    }

    /// `output` = K `input`.
    pub fn multiply(&mut self, input: &[f64], output: &mut [f64]) {
        Arch::new().dispatch(Apply::<true>(&mut self.product, input, output));
    }

    /// `output` ≈ K⁻¹ `input`; symmetric and positive definite.
    pub fn approximate_inverse(&mut self, input: &[f64], output: &mut [f64]) {
        Arch::new().dispatch(Apply::<false>(&mut self.inverse, input, output));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::half_space::KernelTable;

    #[test]
    fn product_equals_the_direct_sum() {
        for (columns, rows) in [(12, 9), (17, 33), (40, 16)] {
            let kernel = KernelTable::new(columns, rows, [1.0, 3.0]);
            let mut fft = FftProduct::new(columns, rows, [1.0, 3.0]);
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
                    // Rounding of sums of up to 640 terms of order 10.
                    assert!(
                        (sum - u[j * columns + i]).abs() < 1e-10,
                        "{columns} × {rows}, {i} {j}: {sum} {}",
                        u[j * columns + i]
                    );
                }
            }
        }
    }

    #[test]
    fn bits_do_not_depend_on_the_instructions_of_the_machine() {
        let (columns, rows) = (24, 17);
        let mut fft = FftProduct::new(columns, rows, [1.0, 3.0]);
        let p: Vec<f64> = (0..columns * rows).map(|i| 0.1 + ((i * 37) % 11) as f64 / 7.0).collect();
        let [mut plain, mut wide] = [vec![0.0; p.len()], vec![0.0; p.len()]];
        Apply::<true>(&mut fft.product, &p, &mut plain).with_simd(Scalar::new());
        fft.multiply(&p, &mut wide);
        assert_eq!(plain, wide);
    }

    #[test]
    fn approximate_inverse_is_positive_definite_and_near_the_inverse_inside() {
        // Cells twelve times as wide as long: without the kernel at a whole period this one is off by far more than
        // itself.
        for cell in [[1.0, 1.0], [1.0, 12.0], [12.0, 1.0]] {
            let n = 32;
            let mut fft = FftProduct::new(n, n, cell);
            let (mut p, mut u, mut back) = (vec![0.0; n * n], vec![0.0; n * n], vec![0.0; n * n]);
            p[16 * n + 16] = 1.0;
            fft.multiply(&p, &mut u);
            fft.approximate_inverse(&u, &mut back);
            // A rough figure is all that a preconditioner needs.
            assert!((back[16 * n + 16] - 1.0).abs() < 0.2, "{cell:?}: {}", back[16 * n + 16]);
            fft.approximate_inverse(&p, &mut back);
            assert!(back[16 * n + 16] > 0.0);
        }
    }
}
