//! Influence of rows of cells on each other, and its product with the pressures on the cells that are in contact.
//!
//! Entries depend on the difference of columns only: one line of Love's kernel for each pair of rows, with the image of
//! the second row added where front and back mirror each other. Sums run over cells in a fixed order, for [`BLOCK`]
//! columns side by side.

use pulp::{Arch, NullaryFnOnce};

use super::half_space::KernelTable;

/// Columns treated together in a product.
pub(super) const BLOCK: usize = 32;

/// Which halves of the contact mirror each other, so that only one of them is unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Mirror {
    /// Left and right: column 0 is right of the middle.
    pub x: bool,
    /// Front and back: row 0 is behind the middle.
    pub y: bool,
    /// Front and back, and the middle runs along row 0, of which one half is an unknown: its interference is to be
    /// halved.
    pub middle_row: bool,
}

impl Mirror {
    /// How many cells of the whole contact one unknown stands for.
    pub fn images(self) -> f64 {
        f64::from((1 + u8::from(self.x)) * (1 + u8::from(self.y)))
    }
}

/// What an edge adds to the influence of cells on each other.
pub(super) trait Image {
    /// Whether a column is of the raceway that ends there.
    fn bears(&self, column: i32) -> bool;

    /// Influence of a cell in row `source` and column `from`, which is of that raceway, on those of row `target` from
    /// column `to` on: which of `length` of them is the first that feels it, and how much it and those after it do.
    fn on(&self, target: (usize, i32, usize), source: (usize, i32)) -> (usize, &[f64]);
}

/// Influence of rows of cells on each other, the mirrored half added.
#[derive(Debug, Clone)]
pub(super) struct RowPairs {
    reach: usize,
    rows: usize,
    mirrored: bool,
    width: usize,
    values: Vec<f64>,
}

impl RowPairs {
    /// Pairs of `rows` rows.
    pub(super) fn new(kernel: &KernelTable, rows: usize, mirror: Mirror) -> Self {
        let mirrored = mirror.y || mirror.middle_row;
        let reach = kernel.columns();
        let width = 2 * reach - 1 + BLOCK;
        let pairs = if mirrored { rows * rows } else { rows };
        let mut values = vec![0.0; pairs * width];
        for (index, out) in values.chunks_exact_mut(width).enumerate() {
            if mirrored {
                let (j, k) = (index / rows, index % rows);
                let other = if mirror.middle_row { j + k } else { j + k + 1 };
                // Halves of a row in the middle: of both its force and its image.
                let part = match (j, k) {
                    (0, 0) if mirror.middle_row => 0.25,
                    (0, _) | (_, 0) if mirror.middle_row => 0.5,
                    _ => 1.0,
                };
                for ((out, direct), image) in out.iter_mut().zip(kernel.row(j.abs_diff(k))).zip(kernel.row(other)) {
                    *out = part * (direct + image);
                }
            } else {
                out[..2 * reach - 1].copy_from_slice(kernel.row(index));
            }
        }
        Self { reach, rows, mirrored, width, values }
    }

    /// Columns of the kernel's table.
    pub(super) fn reach(&self) -> usize {
        self.reach
    }

    /// Rows.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// K p on consecutive cells of one row: `at` is the row and the first of the columns, which fill `out`. `edges` are
    /// those that the window feels.
    pub(super) fn deflect<'a, I: Image + 'a>(
        &self,
        (mirror_x, edges): (bool, impl Iterator<Item = &'a I> + Clone),
        (runs, pressure): (&[Run], &[f64]),
        at: (usize, i32),
        out: &mut [f64],
    ) {
        let (row, first) = at;
        Arch::new().dispatch(Deflect { pairs: self, mirror_x, edges, runs, pressure, row, first, out });
    }

    /// Line of the kernel between two rows; difference 0 is at place `reach` − 1.
    #[inline(always)]
    pub(super) fn pair(&self, j: usize, k: usize) -> &[f64] {
        let index = if self.mirrored { j * self.rows + k } else { j.abs_diff(k) };
        &self.values[index * self.width..(index + 1) * self.width]
    }
}

/// Consecutive active cells of one row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// Row.
    pub row: usize,
    /// Column of the first cell.
    pub first: i32,
    /// Number of cells.
    pub length: usize,
    /// Index of the first cell's unknown.
    pub at: usize,
}

/// K p on consecutive cells of one row.
struct Deflect<'a, E> {
    pairs: &'a RowPairs,
    mirror_x: bool,
    edges: E,
    runs: &'a [Run],
    pressure: &'a [f64],
    row: usize,
    first: i32,
    out: &'a mut [f64],
}

impl<'e, I: Image + 'e, E: Iterator<Item = &'e I> + Clone> NullaryFnOnce for Deflect<'_, E> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let middle = self.pairs.reach as i32 - 1;
        for (b, out) in self.out.chunks_exact_mut(BLOCK).enumerate() {
            let mut sum = [0.0_f64; BLOCK];
            let first = self.first + (b * BLOCK) as i32;
            for run in self.runs {
                let pair = self.pairs.pair(self.row, run.row);
                let pressure = &self.pressure[run.at..run.at + run.length];
                for (k, &p) in pressure.iter().enumerate() {
                    let from = run.first + k as i32;
                    accumulate(&mut sum, pair, middle + first - from, p);
                    if self.mirror_x {
                        accumulate(&mut sum, pair, middle + first + from + 1, p);
                    }
                    for edge in self.edges.clone().filter(|edge| edge.bears(from)) {
                        let (skip, image) = edge.on((self.row, first, BLOCK), (run.row, from));
                        for (sum, image) in sum[skip..].iter_mut().zip(image) {
                            *sum = image.mul_add(p, *sum);
                        }
                    }
                }
            }
            out.copy_from_slice(&sum);
        }
    }
}

#[inline(always)]
fn accumulate(sum: &mut [f64; BLOCK], pair: &[f64], start: i32, p: f64) {
    // Cells of the last block beyond the table are nobody's: they stay as they are.
    if let Some(k) = pair.get(start as usize..start as usize + BLOCK) {
        for l in 0..BLOCK {
            sum[l] = k[l].mul_add(p, sum[l]);
        }
    }
}
