//! Direct solution of one frictionless contact on a grid of loaded rectangles.
//!
//! Find p ≥ 0 with K p ≥ g, complementary, where g = δ − h is the interference of the undeformed bodies and K Love's
//! kernel. A primal–dual active set (Hintermüller, Ito and Kunisch 2002): solve K p = g on the set, drop cells that
//! pull, add cells that interpenetrate, until nothing changes; Cholesky in between. Since K⁻¹ has no positive
//! off-diagonal terms, starting from *all* interfering cells and only dropping also ends at the solution; that slower
//! path is the fallback. Dropping without adding from any other start is wrong: `tests/contact/grid.rs` shows how much
//! force it loses.
//!
//! The next contact starts from the last set, and the last factor is kept while the set stays the same, so a warm
//! contact costs two triangular solutions and one product. Cells are addressed by their column on the raceway; only
//! their differences enter K.

use std::sync::Arc;

use super::cholesky::{BLOCK, Cholesky, NotPositiveDefinite};
use super::half_space::KernelTable;
use super::row_pairs::{CellIndex, Loaded, Mirror, PressedCell, RowPairs, Run, SEGMENT};
use super::soft_edges::{SoftEdge, WindowEdge};
use crate::contact::error::ContactError;

/// Interpenetration below this part of the largest interference counts as touching; rounding of K p is far below.
const TOUCHING: f64 = 1e-13;
/// Sets tried at most.
const MOST_SETS: usize = 100;

/// Interference g = δ − h of the undeformed bodies (m) in a window of the grid.
#[derive(Debug, Clone, Copy)]
pub struct Window<'a> {
    /// Column of the window's first cell.
    pub first: i32,
    /// Columns.
    pub columns: usize,
    /// `interference[row × columns + column]`.
    pub interference: &'a [f64],
}

/// Effort spent on one contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Effort {
    /// Sets tried.
    pub iterations: usize,
    /// Factorisations among them.
    pub factorisations: usize,
}

/// What the iteration thinks of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Open,
    Active,
    /// Left the set just now. Its pull is still in K p, so that it is not judged before the next solution.
    Dropped,
}

/// The solver with its workspace and the last set.
#[derive(Debug, Clone)]
pub struct ActiveSet {
    /// Shared by copies of a solver.
    pairs: Arc<RowPairs>,
    mirror: Mirror,
    edges: Vec<WindowEdge>,
    factor: Cholesky,
    factored: Vec<Run>,
    /// The factor holds for this position only.
    factored_there: bool,
    /// A column of the matrix.
    column: Vec<f64>,
    runs: Vec<Run>,
    state: Vec<State>,
    pressure: Vec<f64>,
    /// First cells of the segments in which cells may penetrate, and what K p is there.
    segments: Vec<CellIndex>,
    deflection: Vec<f64>,
}

impl ActiveSet {
    /// Solver for `rows` rows of unknowns. The table must hold the largest offset that can occur: all columns of a
    /// window (twice as many with left and right mirrored) and all `rows` (twice as many with front and back mirrored).
    pub fn new(kernel: &KernelTable, rows: usize, mirror: Mirror) -> Result<Self, ContactError> {
        let needed = if mirror.y || mirror.middle_row { 2 * rows } else { rows };
        if kernel.rows() < needed {
            return Err(ContactError::WrongLength {
                quantity: "kernel table, rows",
                length: kernel.rows(),
                expected: needed,
            });
        }
        let mut solver = Self {
            pairs: Arc::new(RowPairs::new(kernel, rows, mirror)),
            mirror,
            edges: Vec::new(),
            factor: Cholesky::default(),
            factored: Vec::new(),
            factored_there: false,
            column: Vec::new(),
            runs: Vec::new(),
            state: Vec::new(),
            pressure: Vec::new(),
            segments: Vec::new(),
            deflection: Vec::new(),
        };
        solver.make_room();
        Ok(solver)
    }

    /// Makes room for every window, so that later contacts allocate nothing unless they are the largest so far. A copy
    /// has none except for what is filled.
    pub(super) fn make_room(&mut self) {
        let (rows, columns) = (self.pairs.rows(), self.pairs.reach());
        self.factored.reserve(4 * rows);
        self.column.reserve(rows * columns + 2 * BLOCK);
        self.runs.reserve(4 * rows);
        self.state.reserve(rows * columns);
        self.segments.reserve(rows * columns.div_ceil(SEGMENT));
        self.deflection.reserve(rows * columns.next_multiple_of(SEGMENT));
    }

    /// With edges that make the raceway softer.
    pub(super) fn with_edges(self, edges: Vec<SoftEdge>) -> Self {
        Self { edges: edges.into_iter().map(|soft| WindowEdge { soft, is_felt: false }).collect(), ..self }
    }

    /// Forgets the last contact.
    pub fn forget(&mut self) {
        self.runs.clear();
    }

    /// Active cells of the last contact.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// Pressures over π E* of the last contact, in the order of the runs.
    pub fn pressure(&self) -> &[f64] {
        let count = self.runs.last().map_or(0, |run| run.at + run.length);
        &self.pressure[..count]
    }

    /// Active cells of the last contact.
    pub fn cells(&self) -> impl Iterator<Item = PressedCell> + '_ {
        let cell = |run: &Run, k: usize| {
            let unknown = run.at + k;
            PressedCell { row: run.row, column: run.first + k as i32, unknown, pressure: self.pressure[unknown] }
        };
        self.runs.iter().flat_map(move |run| (0..run.length).map(move |k| cell(run, k)))
    }

    /// Largest |gap| where pressed and penetration where not, over the window just solved (m).
    pub fn residual(&mut self, window: Window<'_>) -> f64 {
        let mut worst = 0.0_f64;
        let mut deflection = vec![0.0; window.columns.next_multiple_of(SEGMENT)];
        for row in 0..self.pairs.rows() {
            let cell = |k: usize| CellIndex { row, column: window.first + k as i32 };
            let segments: Vec<CellIndex> = (0..window.columns).step_by(SEGMENT).map(cell).collect();
            let loaded = Loaded { runs: &self.runs, pressure: &self.pressure };
            self.pairs.deflect(self.mirror.x, felt(&self.edges), loaded, &segments, &mut deflection);
            let cells = row * window.columns..(row + 1) * window.columns;
            for ((&g, &state), &u) in window.interference[cells.clone()].iter().zip(&self.state[cells]).zip(&deflection)
            {
                let open = g - u;
                worst = worst.max(if state == State::Active { open.abs() } else { open });
            }
        }
        worst
    }

    /// Replaces `b` by K⁻¹ b on the last set; `b` must have been sized with [`ActiveSet::right_hand_side`].
    pub fn apply_inverse(&self, b: &mut [f64]) {
        self.factor.solve(b);
    }

    /// Makes `b` a right-hand side for [`ActiveSet::apply_inverse`], all zero.
    pub fn right_hand_side(&self, b: &mut Vec<f64>) {
        b.clear();
        b.resize(self.factor.solve_length(), 0.0);
    }

    /// Solves the contact; starts from the last set unless it was forgotten.
    ///
    /// # Errors
    /// [`ContactError::WrongLength`] for a window wider than the kernel's table, [`ContactError::Cycles`] when the set
    /// does not settle, [`ContactError::NotPositiveDefinite`] when rounding spoils the matrix of a set.
    pub fn solve(&mut self, window: Window<'_>) -> Result<Effort, ContactError> {
        let Window { first, columns, interference } = window;
        let widest = if self.mirror.x { self.pairs.reach() / 2 } else { self.pairs.reach() };
        if columns > widest || interference.len() != columns * self.pairs.rows() {
            return Err(ContactError::WrongLength {
                quantity: "contact window, columns",
                length: columns,
                expected: widest,
            });
        }
        let largest = interference.iter().fold(0.0_f64, |m, &g| m.max(g));
        for edge in &mut self.edges {
            edge.is_felt = edge.soft.is_felt(first, columns);
        }
        self.start(first, columns, interference, largest);
        let mut effort = Effort::default();
        let mut only_drop = false;
        loop {
            self.collect_runs(first, columns);
            if self.runs.is_empty() && largest <= 0.0 {
                return Ok(effort);
            }
            effort.iterations += 1;
            effort.factorisations += usize::from(self.refactor()?);
            self.gather(first, columns, interference);
            let dropped = self.drop_pulling(first, columns);
            let added = !(only_drop && dropped) && self.add_penetrating(window, TOUCHING * largest);
            if !(dropped || added) {
                return Ok(effort);
            }
            if effort.iterations == 20 {
                // From all interfering cells the set only shrinks: slow, and sure.
                for (state, &g) in self.state.iter_mut().zip(interference) {
                    *state = if g > 0.0 { State::Active } else { State::Open };
                }
                only_drop = true;
            }
            if effort.iterations == MOST_SETS {
                return Err(ContactError::Cycles { cells: self.factor.order(), limit: MOST_SETS });
            }
        }
    }

    fn start(&mut self, first: i32, columns: usize, interference: &[f64], largest: f64) {
        self.state.clear();
        self.state.resize(interference.len(), State::Open);
        let mut any = false;
        for run in &self.runs {
            for k in 0..run.length {
                let column = run.first + k as i32 - first;
                if column >= 0 && (column as usize) < columns {
                    let at = run.row * columns + column as usize;
                    if interference[at] > 0.0 {
                        self.state[at] = State::Active;
                        any = true;
                    }
                }
            }
        }
        if !any {
            // On paraboloids the contact is where the interference exceeds about half its largest value.
            for (state, &g) in self.state.iter_mut().zip(interference) {
                if g > 0.5 * largest {
                    *state = State::Active;
                }
            }
        }
    }

    fn collect_runs(&mut self, first: i32, columns: usize) {
        self.runs.clear();
        let mut at = 0;
        for (row, states) in self.state.chunks_exact_mut(columns.max(1)).enumerate() {
            let mut column = 0;
            while column < columns {
                if states[column] == State::Active {
                    let start = column;
                    while column < columns && states[column] == State::Active {
                        column += 1;
                    }
                    let length = column - start;
                    self.runs.push(Run { row, first: first + start as i32, length, at });
                    at += length;
                } else {
                    states[column] = State::Open;
                    column += 1;
                }
            }
        }
    }

    /// How many of the first unknowns have the place in the factor that they had in the last one. That of another
    /// position serves as well: only differences of columns matter, unless there is a left and a right, or an edge is
    /// felt.
    fn kept(&self) -> usize {
        let (Some(a), Some(b)) = (self.runs.first(), self.factored.first()) else { return 0 };
        let shift = a.first - b.first;
        let there = self.factored_there || felt(&self.edges).next().is_some();
        if shift != 0 && (self.mirror.x || there) {
            return 0;
        }
        let mut kept = 0;
        for (a, b) in self.runs.iter().zip(&self.factored) {
            if (a.row, a.first) != (b.row, b.first + shift) {
                break;
            }
            kept += a.length.min(b.length);
            if a.length != b.length {
                break;
            }
        }
        kept
    }

    fn refactor(&mut self) -> Result<bool, ContactError> {
        let kept = self.kept();
        let count = self.runs.last().map_or(0, |run| run.at + run.length);
        if kept == count && self.factor.order() == count {
            return Ok(false);
        }
        self.factored.clear();
        self.factor.resize(count);
        // Whole blocks of the factor are kept.
        let kept = kept - kept % BLOCK;
        let mut column = std::mem::take(&mut self.column);
        column.resize(count + 2 * BLOCK, 0.0);
        for (n, run) in self.runs.iter().enumerate() {
            for k in 0..run.length {
                let unknown = run.at + k;
                let from = unknown.max(kept);
                let first = from - from % BLOCK;
                let source = CellIndex { row: run.row, column: run.first + k as i32 };
                let out = &mut column[from - first..];
                self.pairs.influence(self.mirror.x, felt(&self.edges), source, &self.runs[n..], from, out);
                column[count - first..].fill(0.0);
                self.factor.set_column(unknown, from, &column);
            }
        }
        self.column = column;
        self.factor
            .factor(kept)
            .map_err(|NotPositiveDefinite { pivot }| ContactError::NotPositiveDefinite { pivot, cells: count })?;
        self.factored.clone_from(&self.runs);
        self.factored_there = felt(&self.edges).next().is_some();
        Ok(true)
    }

    fn gather(&mut self, first: i32, columns: usize, interference: &[f64]) {
        let mut pressure = std::mem::take(&mut self.pressure);
        self.right_hand_side(&mut pressure);
        for run in &self.runs {
            let start = run.row * columns + (run.first - first) as usize;
            pressure[run.at..run.at + run.length].copy_from_slice(&interference[start..start + run.length]);
        }
        self.factor.solve(&mut pressure);
        self.pressure = pressure;
    }

    fn drop_pulling(&mut self, first: i32, columns: usize) -> bool {
        let mut changed = false;
        for run in &self.runs {
            let start = run.row * columns + (run.first - first) as usize;
            for k in 0..run.length {
                if self.pressure[run.at + k] < 0.0 {
                    self.state[start + k] = State::Dropped;
                    changed = true;
                }
            }
        }
        changed
    }

    fn add_penetrating(&mut self, window: Window<'_>, touching: f64) -> bool {
        let columns = window.columns;
        let open = |g: f64, state: State| g > touching && state == State::Open;
        // Beside the contact, and not in its middle: there all cells are active.
        self.segments.clear();
        for row in 0..self.pairs.rows() {
            let g = &window.interference[row * columns..(row + 1) * columns];
            let state = &self.state[row * columns..(row + 1) * columns];
            let mut column = 0;
            while column < columns {
                let open = open(g[column], state[column]);
                if open {
                    self.segments.push(CellIndex { row, column: window.first + column as i32 });
                }
                column += if open { SEGMENT } else { 1 };
            }
        }
        self.deflection.clear();
        self.deflection.resize(SEGMENT * self.segments.len(), 0.0);
        let loaded = Loaded { runs: &self.runs, pressure: &self.pressure };
        self.pairs.deflect(self.mirror.x, felt(&self.edges), loaded, &self.segments, &mut self.deflection);
        let mut changed = false;
        for (first, deflection) in self.segments.iter().zip(self.deflection.chunks_exact(SEGMENT)) {
            let (start, end) =
                (first.row * columns + (first.column - window.first) as usize, (first.row + 1) * columns);
            for (c, &u) in (start..end).zip(deflection) {
                let g = window.interference[c];
                if open(g, self.state[c]) && g - u > touching {
                    self.state[c] = State::Active;
                    changed = true;
                }
            }
        }
        changed
    }
}

/// The edges that the window under way feels.
fn felt(edges: &[WindowEdge]) -> impl Iterator<Item = &SoftEdge> + Clone {
    edges.iter().filter(|edge| edge.is_felt).map(|edge| &edge.soft)
}
