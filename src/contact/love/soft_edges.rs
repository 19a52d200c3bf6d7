//! What the edges of a raceway add to the influence of cells on each other, on a grid whose cell borders lie on them.
//!
//! Two cells on the same side of an edge, on the raceway that it ends, feel each other's image: by s, the sum of their
//! distances from it, which is a whole number of cells. One edge knows nothing of the other.

use std::sync::Arc;

use super::edge_softness::StepImage;
use super::half_space::KernelTable;
use super::row_pairs::{CellIndex, Image, Influence, Mirror, RowPairs};

/// An edge of the raceway on a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GridEdge {
    /// It lies before this column.
    pub(super) border: i32,
    /// Whether the raceway that ends there has the lower columns.
    pub(super) below: bool,
    /// Depth of the step (m).
    pub(in crate::contact) depth: f64,
}

/// An edge that makes the raceway softer.
#[derive(Debug, Clone)]
pub(super) struct SoftEdge {
    edge: GridEdge,
    /// Columns from the edge beyond which it is not felt.
    felt: i32,
    pairs: Arc<RowPairs>,
}

/// An edge and the window under way.
#[derive(Debug, Clone)]
pub(super) struct WindowEdge {
    pub(super) soft: SoftEdge,
    /// Whether the window feels it.
    pub(super) is_felt: bool,
}

/// Sizes of the largest window, in cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindowSize {
    pub(super) columns: usize,
    /// Rows of unknowns.
    pub(super) rows: usize,
    /// Rows of the kernel.
    pub(super) kernel_rows: usize,
}

impl SoftEdge {
    /// The edge for windows of up to this size.
    pub(in crate::contact) fn new(
        edge: GridEdge,
        factor: f64,
        cell: [f64; 2],
        WindowSize { columns, rows, kernel_rows }: WindowSize,
        mirror: Mirror,
    ) -> Self {
        let felt = (StepImage::reach(edge.depth) / cell[0]).ceil() as usize;
        // A window whose nearest cell is felt may end a window's length farther on.
        let reach = 2 * (felt + columns) + 1;
        let image = StepImage { depth: edge.depth, factor, cell };
        let table =
            KernelTable::from_function(
                reach,
                kernel_rows,
                cell,
                |x, y| {
                    if x > 0.0 { image.influence(x, y) } else { 0.0 }
                },
            );
        Self { edge, felt: felt as i32, pairs: Arc::new(RowPairs::new(&table, rows, mirror)) }
    }

    /// Whether cells of a window feel it.
    pub(super) fn is_felt(&self, first: i32, columns: usize) -> bool {
        let (last, border) = (first + columns as i32 - 1, self.edge.border);
        if self.edge.below {
            first < border && border - last <= self.felt
        } else {
            last >= border && first - border <= self.felt
        }
    }
}

impl Image for SoftEdge {
    #[inline(always)]
    fn includes(&self, column: i32) -> bool {
        (column < self.edge.border) == self.edge.below
    }

    #[inline(always)]
    fn on(&self, first: CellIndex, length: usize, source: CellIndex) -> Influence<'_> {
        let (border, to, from) = (self.edge.border, first.column, source.column);
        let inside = (border - to).clamp(0, length as i32) as usize;
        let (skip, end) = if self.edge.below { (0, inside) } else { (inside, length) };
        let middle = self.pairs.reach() as i32 - 1;
        let start = (middle + to + skip as i32 + from + 1 - 2 * border) as usize;
        let pair = self.pairs.pair(first.row, source.row);
        Influence { skip, values: pair.get(start..start + (end - skip)).unwrap_or(&[]) }
    }
}
