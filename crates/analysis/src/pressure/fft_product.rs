//! Product with the influence matrix on a whole grid, and its cheap approximate inverse, by Fourier transforms.
//!
//! K is a convolution: padded to twice the grid it becomes circular (Hockney's method) and exact. The kernel is even,
//! so its spectrum is real. The approximate inverse, a preconditioner, is that of the kernel wrapped around the
//! unpadded grid, k(i) + k(N − i) in both directions: right except for the influence of the borders. The wrapped kernel
//! has to reach over a whole period: with k(N) left out the spectrum of cells much longer than wide turns negative at
//! high frequencies, and conjugate gradients take ten times as many steps.

use brinell::contact::love::rectangle_kernel;

use crate::spectrum::EvenFilter;

/// K and an approximation of K⁻¹ on one grid.
pub struct FftProduct {
    columns: usize,
    product: EvenFilter,
    inverse: EvenFilter,
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
            columns,
            product: EvenFilter::new(along, &padded, &|eigenvalue, _| eigenvalue),
            // A preconditioner has to be positive; the wrapped kernel's spectrum is, this guards against rounding.
            inverse: EvenFilter::new(near, &wrapped, &|eigenvalue, largest| 1.0 / eigenvalue.max(1e-6 * largest)),
        }
    }

    /// `output` = K `input`.
    pub fn multiply(&mut self, input: &[f64], output: &mut [f64]) {
        self.product.apply(self.columns, input, output);
    }

    /// `output` ≈ K⁻¹ `input`; symmetric and positive definite.
    pub fn approximate_inverse(&mut self, input: &[f64], output: &mut [f64]) {
        self.inverse.apply(self.columns, input, output);
    }
}

/// The smallest length that is at least `least`, a multiple of four, and a product of twos, threes and fives.
fn good_length(least: usize) -> usize {
    let smooth = |length: usize| {
        let without = |rest: usize, prime| {
            std::iter::successors(Some(rest), |rest| Some(rest / prime)).find(|rest| rest % prime != 0).unwrap_or(1)
        };
        [2, 3, 5].into_iter().fold(length, without) == 1
    };
    let mut length = least.max(4).next_multiple_of(4);
    while !smooth(length) {
        length += 4;
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;
    use brinell::contact::love::KernelTable;

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
