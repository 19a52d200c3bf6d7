//! Influence of rows of cells on each other, and its product with the pressures on the cells that are in contact.
//!
//! Entries depend on the difference of columns only: one line of Love's kernel for each pair of rows, with the image of
//! the second row added where front and back mirror each other. Products are asked for on segments of [`SEGMENT`]
//! columns, of whichever rows; the sum for each cell runs over the pressures in a fixed order.

use pulp::{Arch, NullaryFnOnce};

use super::half_space::KernelTable;

/// Columns of a segment.
pub(super) const SEGMENT: usize = 8;
/// Segments treated side by side: a sum that waits for itself leaves room for three others.
const TOGETHER: usize = 4;
/// Zeros behind a line of the kernel, for segments that end beyond it.
const BEYOND: usize = 32;

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

/// Row and column of a cell in a window.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellIndex {
    pub(super) row: usize,
    pub(super) column: i32,
}

/// The influence of a cell on consecutive cells of a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Influence<'a> {
    /// How many of them do not feel it before the first that does.
    pub(super) skip: usize,
    /// On that one and those after it, in the kernel's unit.
    pub(super) values: &'a [f64],
}

/// Active cells, run by run, with their pressures over π E*.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loaded<'a> {
    pub(super) runs: &'a [Run],
    pub(super) pressure: &'a [f64],
}

/// What an edge adds to the influence of cells on each other.
pub(super) trait Image {
    /// Whether a column is of the raceway that ends there.
    fn includes(&self, column: i32) -> bool;

    /// Influence of the cell `source`, which is of that raceway, on `length` cells of a row from `first` on.
    fn on(&self, first: CellIndex, length: usize, source: CellIndex) -> Influence<'_>;
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
    pub(in crate::contact) fn new(kernel: &KernelTable, rows: usize, mirror: Mirror) -> Self {
        let mirrored = mirror.y || mirror.middle_row;
        let reach = kernel.columns();
        let width = 2 * reach - 1 + BEYOND;
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
    pub(in crate::contact) fn reach(&self) -> usize {
        self.reach
    }

    /// Rows.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// K p on segments of columns, given by their first cells, into `out` one segment after the other. `edges` are
    /// those that the window feels.
    pub(super) fn deflect<'a, I: Image + 'a>(
        &self,
        mirror_x: bool,
        edges: impl Iterator<Item = &'a I> + Clone,
        Loaded { runs, pressure }: Loaded,
        segments: &[CellIndex],
        out: &mut [f64],
    ) {
        Arch::new().dispatch(Deflect { pairs: self, mirror_x, edges, runs, pressure, segments, out });
    }

    /// Influence of a cell on the unknowns of `runs` from `from` on, into `out`; beyond the last of them it may write
    /// up to a segment of something else.
    pub(super) fn influence<'a, I: Image + 'a>(
        &self,
        mirror_x: bool,
        edges: impl Iterator<Item = &'a I> + Clone,
        source: CellIndex,
        runs: &[Run],
        from: usize,
        out: &mut [f64],
    ) {
        let middle = self.reach as i32 - 1;
        for target in runs.iter().filter(|target| target.at + target.length > from) {
            let skip = from.saturating_sub(target.at);
            let (to, length) = (target.first + skip as i32, target.length - skip);
            let pair = self.pair(target.row, source.row);
            let out = &mut out[target.at + skip - from..];
            // Segments are copied faster than what is just as long as the run; the next one is written over the rest.
            let direct = pair[(middle + to - source.column) as usize..].chunks_exact(SEGMENT);
            for (out, direct) in out.chunks_exact_mut(SEGMENT).zip(direct).take(length.div_ceil(SEGMENT)) {
                out.copy_from_slice(direct);
            }
            let out = &mut out[..length];
            if mirror_x {
                let images = &pair[(middle + to + source.column + 1) as usize..];
                out.iter_mut().zip(images).for_each(|(out, image)| *out += image);
            }
            for edge in edges.clone().filter(|edge| edge.includes(source.column)) {
                let image = edge.on(CellIndex { row: target.row, column: to }, length, source);
                out[image.skip..].iter_mut().zip(image.values).for_each(|(out, image)| *out += image);
            }
        }
    }

    /// Line of the kernel between two rows; difference 0 is at index `reach` − 1.
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

/// A cell of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressedCell {
    /// Row.
    pub row: usize,
    /// Column on the raceway.
    pub column: i32,
    /// Index of its unknown.
    pub unknown: usize,
    /// Pressure over π E*.
    pub pressure: f64,
}

/// K p on segments of columns.
struct Deflect<'a, E> {
    pairs: &'a RowPairs,
    mirror_x: bool,
    edges: E,
    runs: &'a [Run],
    pressure: &'a [f64],
    segments: &'a [CellIndex],
    out: &'a mut [f64],
}

/// Sums of some segments.
type Sums = [[f64; SEGMENT]; TOGETHER];

impl<'e, I: Image + 'e, E: Iterator<Item = &'e I> + Clone> NullaryFnOnce for Deflect<'_, E> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        let out = std::mem::take(&mut self.out);
        for (some, out) in self.segments.chunks(TOGETHER).zip(out.chunks_mut(TOGETHER * SEGMENT)) {
            // Where there are fewer, the first is treated again and again.
            let segments = std::array::from_fn(|n| *some.get(n).unwrap_or(&some[0]));
            let sums = self.on(segments);
            for (out, sum) in out.chunks_exact_mut(SEGMENT).zip(&sums) {
                out.copy_from_slice(sum);
            }
        }
    }
}

impl<'e, I: Image + 'e, E: Iterator<Item = &'e I> + Clone> Deflect<'_, E> {
    #[inline(always)]
    fn on(&self, segments: [CellIndex; TOGETHER]) -> Sums {
        let middle = self.pairs.reach as i32 - 1;
        let mut sums = Sums::default();
        for run in self.runs {
            let pressure = &self.pressure[run.at..run.at + run.length];
            // What the cells of a segment feel of the run's, from the difference of columns `start` on.
            let lines = |start: &dyn Fn(i32) -> i32| {
                let line = |n: usize| {
                    let CellIndex { row, column } = segments[n];
                    let start = (middle + start(column)) as usize;
                    let line = self.pairs.pair(row, run.row).get(start..start + run.length + SEGMENT - 1);
                    line.unwrap_or(&[]).windows(SEGMENT)
                };
                [line(0), line(1), line(2), line(3)]
            };
            let last = run.first + run.length as i32 - 1;
            let [a, b, c, d] = lines(&|column| column - last);
            accumulate(&mut sums, pressure, [a.rev(), b.rev(), c.rev(), d.rev()]);
            if self.mirror_x {
                accumulate(&mut sums, pressure, lines(&|column| column + run.first + 1));
            }
            for edge in self.edges.clone() {
                for (k, &p) in pressure.iter().enumerate() {
                    let source = CellIndex { row: run.row, column: run.first + k as i32 };
                    if !edge.includes(source.column) {
                        continue;
                    }
                    for (sum, &segment) in sums.iter_mut().zip(&segments) {
                        let image = edge.on(segment, SEGMENT, source);
                        for (sum, image) in sum[image.skip..].iter_mut().zip(image.values) {
                            *sum = image.mul_add(p, *sum);
                        }
                    }
                }
            }
        }
        sums
    }
}

/// Adds the products of pressures with what the segments feel of each.
#[inline(always)]
fn accumulate<'a>(sums: &mut Sums, pressure: &[f64], felt: [impl Iterator<Item = &'a [f64]>; TOGETHER]) {
    let mut sum = *sums;
    let [a, b, c, d] = felt;
    for ((((&p, a), b), c), d) in pressure.iter().zip(a).zip(b).zip(c).zip(d) {
        for (sum, line) in sum.iter_mut().zip([a, b, c, d]) {
            let line: [f64; SEGMENT] = line.first_chunk().copied().unwrap_or_default();
            for l in 0..SEGMENT {
                sum[l] = line[l].mul_add(p, sum[l]);
            }
        }
    }
    *sums = sum;
}
