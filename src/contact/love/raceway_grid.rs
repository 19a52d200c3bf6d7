//! A grid of cells fixed to the surface that has a defect, and the gap between it and the body above it.
//!
//! Gap for zero approach with the element at arc s, circles and not paraboloids (Larizza et al. 2018, eq. 4, corrected:
//! the groove's curvature is added and a depression *opens* the gap):
//!
//! ```text
//! h(x, y; s) = c(r, x−s) ∓ c(R, x−s) + c(r, y) − c(r_g, y) + d(x, y),   c(R, t) = R − √(R² − t²)
//! ```
//!
//! with − for the concave outer raceway and + for the convex inner one, whose sag adds to the element's. Which of the
//! two bodies has the defect does not matter: in the half-space a defect of the element is the same problem as one of
//! the raceway with the same depth over arc.
//!
//! Of a roller the two terms in y give way to its crown's depth, and rows end with its length.
//!
//! d is the exact mean depth of a cell, so a sharp edge counts where it is; cell borders lie on the first and the last
//! sharp edge, because an edge 0.17 cell off costs fifty times the error. The grid does not move with the element: one
//! that does turns its own resolution into a tangential force.

use crate::surface::{Corner, Interval, Surface};

use super::row_pairs::Mirror;
use super::soft_edges::GridEdge;
use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::error::ContactError;

/// Number of cells across Hertz's ellipse at the largest approach.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// Along the raceway.
    pub columns: usize,
    /// Across the raceway.
    pub rows: usize,
}

/// Part of a cell by which a raceway that ends at an edge is continued beyond it. A cell that ends at an edge carries
/// its pressure uniformly, where the true one grows without bound towards the edge: it is too soft by the same force as
/// if the raceway ended this much earlier. Found by comparison with finer grids; it is that of a flat punch, too
/// (`tests/contact/grid.rs`).
const BEYOND_EDGE: f64 = 0.17;

/// Refuses measured points that are farther apart than a cell is long or wide.
fn check_sampling(surface: &Surface, cell: [f64; 2]) -> Result<(), ContactError> {
    for ((interval, cell), direction) in surface.coarsest_intervals().into_iter().zip(cell).zip(["along", "across"]) {
        // Distances of points that were rounded when they were written.
        if let Some(Interval { middle, length }) = interval.filter(|of| of.length > cell * (1.0 + 1e-6)) {
            let (step_um, at_mm, cell_um) = (length * 1e6, middle * 1e3, cell * 1e6);
            return Err(ContactError::TooCoarse { direction, step_um, at_mm, cell_um });
        }
    }
    Ok(())
}

/// An edge is what is steeper than 60°: there the pressure has a peak narrower than any cell.
const STEEP: f64 = 1.732;

/// Consecutive columns.
#[derive(Debug, Clone, Copy)]
pub struct ColumnSpan {
    /// The first.
    pub first: i32,
    /// How many.
    pub count: usize,
}

/// A border between columns that is a sharp edge.
#[derive(Debug, Clone, Copy)]
struct SharpBorder {
    /// The column before which it lies.
    border: i32,
    /// Whether the raceway that ends there has the lower columns.
    below: bool,
}

/// Where columns lie.
struct Columns {
    /// First border of column 0 (m).
    origin: f64,
    /// Length of a column (m).
    length: f64,
    edges: Vec<SharpBorder>,
}

/// Continues the raceway a little beyond its edges, and finds the grid's origin and its cells' length, some
/// `length` (m), for which the first and the last continued edge lie on cell borders.
fn columns_at_edges(surface: &mut Surface, length: f64) -> Columns {
    let drop = BEYOND_EDGE * length;
    let corners = match surface {
        Surface::Profile(profile) => profile.upper_corners(STEEP, drop),
        Surface::Topography(_) => Vec::new(),
    };
    let (Some(&begin), Some(&end), Surface::Profile(profile)) = (corners.first(), corners.last(), &mut *surface) else {
        let (first, last) = surface.extent();
        let whole = ((last - first) / length).ceil().max(1.0);
        return Columns { origin: first, length: (last - first) / whole, edges: Vec::new() };
    };
    let (Corner { arc: first, fall: first_fall }, Corner { arc: last, fall: last_fall }) = (begin, end);
    let (mut cell, mut edges) = (length, vec![SharpBorder { border: 0, below: first_fall > 0.0 }]);
    if last > first {
        let whole = ((last - first) / length).ceil().max(1.0);
        cell = (last - first) / (whole - (last_fall - first_fall) * BEYOND_EDGE);
        edges.push(SharpBorder { border: whole as i32, below: last_fall > 0.0 });
    }
    *profile = profile.with_corners_continued(STEEP, drop, BEYOND_EDGE * cell);
    Columns { origin: first + first_fall * BEYOND_EDGE * cell, length: cell, edges }
}

/// Cells fixed to the raceway.
#[derive(Debug, Clone)]
pub struct RacewayGrid {
    pub(super) element: ElementOnRaceway,
    cell: [f64; 2],
    origin: f64,
    rows: usize,
    mirrored: bool,
    /// Whether the groove's bottom runs along the middle of a row and not between two.
    middle_row: bool,
    /// Where the element is across the raceway (m).
    place: f64,
    /// Gap of each row across the raceway.
    across: Vec<f64>,
    first_column: i32,
    edges: Vec<SharpBorder>,
    /// Depth of each cell from `first_column`; one row for a profile.
    depth: Vec<f64>,
    depth_columns: usize,
    raised: f64,
    deepest: f64,
    surface: Option<Surface>,
}

impl RacewayGrid {
    /// Grid for approaches up to `largest_approach` (m) on `surface`; `None` is the smooth raceway.
    pub fn new(
        element: ElementOnRaceway,
        surface: Option<&Surface>,
        largest_approach: f64,
        resolution: Resolution,
    ) -> Result<Self, ContactError> {
        let element = element.checked()?;
        if !(largest_approach > 0.0 && largest_approach < 0.1 * element.element_radius) {
            return Err(ContactError::BadInput {
                quantity: "largest approach",
                value: largest_approach,
                unit: "m",
                limit: format!("between 0 and a tenth of the element's radius, {:e} m", 0.1 * element.element_radius),
            });
        }
        let [a, b] = element.contact_half_axes(largest_approach);
        let mut cell = [2.0 * a / resolution.columns.max(2) as f64, 2.0 * b / resolution.rows.max(2) as f64];
        let mirrored = !matches!(surface, Some(Surface::Topography(_)));
        let mut surface = surface.cloned();
        let (mut origin, mut edges) = (0.0, Vec::new());
        if let Some(surface) = &mut surface {
            check_sampling(surface, cell)?;
            let columns = columns_at_edges(surface, cell[0]);
            (origin, cell[0], edges) = (columns.origin, columns.length, columns.edges);
        }
        let mut grid = Self {
            element,
            cell,
            origin,
            rows: 0,
            mirrored,
            middle_row: false,
            place: 0.0,
            across: Vec::new(),
            first_column: 0,
            edges,
            depth: Vec::new(),
            depth_columns: 0,
            raised: 0.0,
            deepest: 0.0,
            surface,
        };
        // A ball's contact must end inside: a fifth more than the ellipse, and two rows to see it. A roller's rows end
        // where it does.
        grid.set_rows(match element.length() {
            None => (0.6 * resolution.rows as f64).ceil() as usize + 2,
            Some(_) => resolution.rows.div_ceil(2).max(2),
        });
        Ok(grid)
    }

    /// Changes the number of rows on one side of the groove's bottom.
    pub fn set_rows(&mut self, half_rows: usize) {
        let below = if self.mirrored { 0 } else { half_rows };
        self.rows = below + half_rows + usize::from(self.middle_row && !self.mirrored);
        if let Some(length) = self.element.length() {
            let middle = if self.middle_row { 0.5 } else { 0.0 };
            self.cell[1] = 0.5 * length / (half_rows as f64 + if self.mirrored { -middle } else { middle });
        }
        let (first_row, width) = (self.first_row(), self.cell[1]);
        self.across = (0..self.rows).map(|j| self.element.across(self.row_offset(j))).collect();
        let Some(surface) = &self.surface else { return };
        let (from, to) = surface.extent();
        self.first_column = ((from - self.origin) / self.cell[0]).floor() as i32;
        let last = ((to - self.origin) / self.cell[0]).ceil() as i32;
        self.depth_columns = (last - self.first_column).max(0) as usize;
        let depth_rows = if self.mirrored { 1 } else { self.rows };
        self.depth.clear();
        for j in 0..depth_rows {
            let y = (first_row + j as f64) * width;
            for c in 0..self.depth_columns {
                let x = self.origin + f64::from(self.first_column + c as i32) * self.cell[0];
                self.depth.push(surface.mean_depth([x, x + self.cell[0]], [y, y + width]));
            }
        }
        self.raised = self.depth.iter().fold(0.0_f64, |m, &d| m.max(-d));
        self.deepest = self.depth.iter().fold(0.0_f64, |m, &d| m.max(d));
    }

    /// Lower side of row 0, in rows.
    fn first_row(&self) -> f64 {
        let below = if self.mirrored { 0 } else { self.half_rows() };
        -(below as f64) - if self.middle_row { 0.5 } else { 0.0 }
    }

    /// Distance (m) of the middle of a row from the element's.
    pub(super) fn row_offset(&self, row: usize) -> f64 {
        (self.first_row() + row as f64 + 0.5) * self.cell[1] - self.place
    }

    /// Puts the element at another place across a raceway that is not mirrored (m).
    pub(super) fn move_across(&mut self, place: f64) {
        self.place = place;
        for row in 0..self.rows {
            self.across[row] = self.element.across(self.row_offset(row));
        }
    }

    /// The same cells on the raceway without its defect.
    pub fn without_defect(&self) -> Self {
        let mut grid = Self {
            depth: Vec::new(),
            depth_columns: 0,
            raised: 0.0,
            deepest: 0.0,
            surface: None,
            edges: Vec::new(),
            ..self.clone()
        };
        grid.set_rows(self.half_rows());
        grid
    }

    /// Sharp edges, each with the depth that the surface reaches within a distance (m) beyond it, or `deepest` (m) if
    /// that is less.
    pub(super) fn edges(&self, distance: f64, deepest: f64) -> impl Iterator<Item = GridEdge> {
        let columns = (distance / self.cell[0]).ceil() as i32;
        self.edges.iter().map(move |&SharpBorder { border, below }| {
            let beyond = if below { border..border + columns } else { border - columns..border };
            let depth = beyond.filter_map(|column| self.depth.get(usize::try_from(column - self.first_column).ok()?));
            let depth = depth.fold(0.0, |most: f64, &depth| most.max(depth));
            GridEdge { border, below, depth: depth.min(deepest) }
        })
    }

    /// The same grid with its rows moved by half a row.
    pub fn interlaced(&self) -> Self {
        let mut grid = Self { middle_row: !self.middle_row, ..self.clone() };
        grid.set_rows(self.half_rows());
        grid
    }

    /// Whether more rows make the grid wider: a roller ends where its last row does.
    pub(super) fn can_widen(&self) -> bool {
        self.element.length().is_none()
    }

    /// Rows on one side of the groove's bottom.
    pub fn half_rows(&self) -> usize {
        if self.mirrored { self.rows } else { self.rows / 2 }
    }

    /// Symmetry of the contacts on this grid.
    pub(super) fn mirror(&self) -> Mirror {
        let on_row = self.mirrored && self.middle_row;
        Mirror { x: false, y: self.mirrored && !on_row, middle_row: on_row }
    }

    /// Part of a row's cells that its unknowns stand for: one half where the row lies on the middle of mirrored halves.
    pub(in crate::contact) fn share(&self, row: usize) -> f64 {
        if row == 0 && self.mirrored && self.middle_row { 0.5 } else { 1.0 }
    }

    /// Full sides of a cell (m).
    pub fn cell(&self) -> [f64; 2] {
        self.cell
    }

    /// Rows of unknowns.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether front and back are the same.
    pub fn mirrored(&self) -> bool {
        self.mirrored
    }

    /// Deepest cell (m).
    pub fn deepest(&self) -> f64 {
        self.deepest
    }

    /// Arc (m) of the centre of a column.
    pub fn centre(&self, column: i32) -> f64 {
        self.origin + (f64::from(column) + 0.5) * self.cell[0]
    }

    /// The column whose centre is nearest to arc `s` (m).
    pub fn column_at(&self, s: f64) -> i32 {
        ((s - self.origin) / self.cell[0]).floor() as i32
    }

    /// Columns that can touch at radial path `u` (m): a superset, since circles bend away faster than paraboloids.
    pub fn window(&self, u: f64, s: f64) -> ColumnSpan {
        let reach = (2.0 * (u + self.raised).max(0.0) / self.element.curvatures()[0]).sqrt();
        let (from, to) = (self.column_at(s - reach), self.column_at(s + reach));
        ColumnSpan { first: from, count: (to - from + 1) as usize }
    }

    /// Widest window for paths up to `u` (m).
    pub fn widest(&self, u: f64) -> usize {
        let reach = (2.0 * (u + self.raised).max(0.0) / self.element.curvatures()[0]).sqrt();
        (2.0 * reach / self.cell[0]).ceil() as usize + 2
    }

    fn depth_row(&self, row: usize) -> &[f64] {
        let row = if self.mirrored { 0 } else { row };
        &self.depth[row * self.depth_columns..(row + 1) * self.depth_columns]
    }

    /// Smallest gap for zero path (m): the path at which the element at `s` begins to touch.
    pub fn first_touch(&self, s: f64) -> f64 {
        let middle = self.column_at(s);
        let mut least = f64::INFINITY;
        for step in 0.. {
            let mut nearest = f64::INFINITY;
            for column in [middle - step, middle + step] {
                let along = self.element.along(self.centre(column) - s)[0];
                nearest = nearest.min(along);
                least = least.min(along + self.shallowest(column));
            }
            if !(nearest - self.raised < least) {
                break;
            }
        }
        least
    }

    /// Smallest depth over the rows of a column, the groove's own gap included.
    fn shallowest(&self, column: i32) -> f64 {
        let at = column - self.first_column;
        let inside = at >= 0 && (at as usize) < self.depth_columns;
        let rows = if self.mirrored { 1 } else { self.rows };
        (0..rows).fold(f64::INFINITY, |m, j| {
            m.min(self.across[j] + if inside { self.depth_row(j)[at as usize] } else { 0.0 })
        })
    }

    /// Interference u − h of a window, and the gap's slope by t = x − s for each column.
    pub fn interference(
        &self,
        u: f64,
        s: f64,
        ColumnSpan { first, count: columns }: ColumnSpan,
        out: &mut Vec<f64>,
        slopes: &mut Vec<f64>,
    ) {
        out.clear();
        slopes.clear();
        out.resize(self.rows * columns, 0.0);
        let Some((bottom, others)) = out.split_at_mut_checked(columns) else { return };
        for (k, value) in bottom.iter_mut().enumerate() {
            let [along, slope] = self.element.along(self.centre(first + k as i32) - s);
            *value = u - along;
            slopes.push(slope);
        }
        for (j, row) in others.chunks_exact_mut(columns).enumerate() {
            for (value, &b) in row.iter_mut().zip(bottom.iter()) {
                *value = b - self.across[j + 1];
            }
        }
        for value in bottom.iter_mut() {
            *value -= self.across[0];
        }
        let skip = (self.first_column - first).max(0) as usize;
        let from = (first - self.first_column).max(0) as usize;
        if skip >= columns || from >= self.depth_columns {
            return;
        }
        for (j, row) in out.chunks_exact_mut(columns).enumerate() {
            for (value, d) in row[skip..].iter_mut().zip(&self.depth_row(j)[from..]) {
                *value -= d;
            }
        }
    }
}
