//! One stored contact problem: an undeformed gap on a regular grid, pressed together by a given approach or force.
//!
//! u_i = Σ_j p_j k(i − j)/(π E*), p ≥ 0, u + h − δ ≥ 0, complementary; k is Love's kernel, cells are loaded uniformly
//! and matched at their centres. Beyond the grid nothing touches: a contact that reaches the border is refused unless
//! the grid is said to be the whole body.

use libm::pow;

use brinell::contact::error::ContactError;
use brinell::contact::love::{ActiveSet, KernelTable, Mirror, PressedCell, Window};

/// What lies beyond the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Border {
    /// More of the same bodies: a contact at the border is cut off, hence an error.
    #[default]
    Window,
    /// Nothing: the body ends there, as a punch does.
    Body,
}

/// Gap of two undeformed bodies on a grid, and their elasticity.
#[derive(Debug, Clone, PartialEq)]
pub struct GridProblem {
    columns: usize,
    rows: usize,
    cell: [f64; 2],
    effective_modulus: f64,
    gap: Vec<f64>,
    border: Border,
}

/// A solved contact.
#[derive(Debug, Clone, PartialEq)]
pub struct GridContact {
    /// Approach δ (m).
    pub approach: f64,
    /// Pressure (Pa), `[row × columns + column]`.
    pub pressure: Vec<f64>,
    /// Total force (N).
    pub force: f64,
    /// Depth (m) of what stays dented where the pressure is at its limit; empty of bodies that stay elastic.
    pub dent: Vec<f64>,
    /// Largest of: |gap| where pressed, penetration where not; over the approach.
    pub residual: f64,
    /// Iterations of the solver.
    pub iterations: usize,
}

impl GridContact {
    /// Largest pressure (Pa).
    pub fn max_pressure(&self) -> f64 {
        self.pressure.iter().fold(0.0, |m, &p| m.max(p))
    }
}

/// Anything that solves a [`GridProblem`] at a prescribed approach.
pub trait GridSolver {
    /// Solves at the approach δ (m).
    ///
    /// # Errors
    /// When the contact reaches the border of a [`Border::Window`] or the iteration does not end.
    fn at_approach(&mut self, approach: f64) -> Result<GridContact, ContactError>;

    /// Smallest gap (m), the approach at which the contact begins.
    fn first_touch(&self) -> f64;

    /// Solves at the force `force` (N), to a relative 1e-11, by the secant rule on F^(2/3), which Hertz makes a
    /// straight line.
    ///
    /// # Errors
    /// As [`GridSolver::at_approach`], and for a force that is not positive.
    fn at_force(&mut self, force: f64, guess: f64) -> Result<GridContact, ContactError> {
        let limit = || "positive".to_owned();
        if !(force > 0.0 && force.is_finite()) {
            return Err(ContactError::BadInput { quantity: "contact force", value: force, unit: "N", limit: limit() });
        }
        let touch = self.first_touch();
        if !(guess > touch) {
            return Err(ContactError::BadInput {
                quantity: "approach to start from",
                value: guess,
                unit: "m",
                limit: limit(),
            });
        }
        let target = pow(force, 2.0 / 3.0);
        let (mut x0, mut y0, mut x1) = (touch, 0.0, guess);
        let mut residual = f64::NAN;
        for _ in 0..40 {
            let contact = self.at_approach(x1)?;
            residual = contact.force / force - 1.0;
            if residual.abs() < 1e-11 {
                return Ok(contact);
            }
            let y1 = pow(contact.force, 2.0 / 3.0);
            let slope = (y1 - y0) / (x1 - x0);
            if !(slope > 0.0) {
                break;
            }
            (x0, y0) = (x1, y1);
            x1 += (target - y1) / slope;
        }
        Err(ContactError::NotConverged { iterations: 40, residual, limit: 1e-11 })
    }
}

impl GridProblem {
    /// A problem from its gap h (m), `gap[row × columns + column]`, cells of the full sides `cell` (m) and E* (Pa).
    ///
    /// # Errors
    /// For a gap of the wrong length and numbers that are not finite or not positive.
    pub fn new(
        columns: usize,
        rows: usize,
        cell: [f64; 2],
        effective_modulus: f64,
        gap: Vec<f64>,
        border: Border,
    ) -> Result<Self, ContactError> {
        if gap.len() != columns * rows || gap.is_empty() {
            return Err(ContactError::WrongLength {
                quantity: "gap",
                length: gap.len(),
                expected: (columns * rows).max(1),
            });
        }
        let positive = [
            ("cell length", cell[0], "m"),
            ("cell width", cell[1], "m"),
            ("effective modulus", effective_modulus, "Pa"),
        ];
        for (quantity, value, unit) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ContactError::BadInput { quantity, value, unit, limit: "positive and finite".to_owned() });
            }
        }
        if let Some(&value) = gap.iter().find(|h| !h.is_finite()) {
            return Err(ContactError::BadInput { quantity: "gap", value, unit: "m", limit: "finite".to_owned() });
        }
        Ok(Self { columns, rows, cell, effective_modulus, gap, border })
    }

    /// A problem from its gap h(x, y) (m), a function of the position relative to the grid's middle (m); the rest as
    /// for [`GridProblem::new`].
    ///
    /// A cell's gap is halfway between that at its centre and its mean over the cell (four points of Gauss's rule).
    /// With the centre's, the force on a paraboloid of contact radius a is 0.06 (cell/a)² too high, with the mean 0.065
    /// (cell/a)² too low; halfway only the scatter is left of how cells lie under the border.
    ///
    /// # Errors
    /// As [`GridProblem::new`].
    pub fn sampled(
        columns: usize,
        rows: usize,
        cell: [f64; 2],
        effective_modulus: f64,
        gap: impl Fn(f64, f64) -> f64,
        border: Border,
    ) -> Result<Self, ContactError> {
        // Half the distance of Gauss's two points, 1/√3 of half a cell.
        const NODE: f64 = 0.288_675_134_594_812_9;
        let at = |c: usize| {
            let x = ((c % columns) as f64 + 0.5 - 0.5 * columns as f64) * cell[0];
            let y = ((c / columns) as f64 + 0.5 - 0.5 * rows as f64) * cell[1];
            let (dx, dy) = (NODE * cell[0], NODE * cell[1]);
            let mean =
                0.25 * ((gap(x - dx, y - dy) + gap(x + dx, y + dy)) + (gap(x - dx, y + dy) + gap(x + dx, y - dy)));
            0.5 * (gap(x, y) + mean)
        };
        Self::new(columns, rows, cell, effective_modulus, (0..columns * rows).map(at).collect(), border)
    }

    /// Columns, along x.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Rows, along y.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Full sides of a cell (m).
    pub fn cell(&self) -> [f64; 2] {
        self.cell
    }

    /// Gap h (m), row by row.
    pub fn gap(&self) -> &[f64] {
        &self.gap
    }

    /// Smallest gap (m).
    pub fn first_touch(&self) -> f64 {
        self.gap.iter().fold(f64::INFINITY, |m, &h| m.min(h))
    }

    /// Love's kernel for this grid.
    pub fn kernel(&self) -> KernelTable {
        KernelTable::new(self.columns, self.rows, self.cell)
    }

    /// Which halves of the gap mirror each other to rounding.
    pub fn mirror(&self) -> Mirror {
        let (n, m) = (self.columns, self.rows);
        let rounding = 8.0 * f64::EPSILON * self.gap.iter().fold(0.0_f64, |a, h| a.max(h.abs()));
        let same = |a: usize, b: usize| (self.gap[a] - self.gap[b]).abs() <= rounding;
        let all = |test: &dyn Fn(usize, usize) -> bool| (0..m).all(|j| (0..n).all(|i| test(i, j)));
        Mirror {
            x: n.is_multiple_of(2) && all(&|i, j| same(j * n + i, j * n + n - 1 - i)),
            y: m.is_multiple_of(2) && all(&|i, j| same(j * n + i, (m - 1 - j) * n + i)),
            middle_row: false,
        }
    }

    /// A pressure (Pa) over π E*.
    pub(super) fn scaled(&self, pressure: f64) -> f64 {
        pressure / (std::f64::consts::PI * self.effective_modulus)
    }

    /// Turns pressures over π E* into a contact, after the check of the border.
    pub(super) fn finish(
        &self,
        approach: f64,
        scaled: Vec<f64>,
        residual: f64,
        iterations: usize,
    ) -> Result<GridContact, ContactError> {
        let (n, m) = (self.columns, self.rows);
        if self.border == Border::Window {
            let on_border = |c: &usize| c.is_multiple_of(n) || c % n == n - 1 || c / n == 0 || c / n == m - 1;
            if let Some(c) = (0..n * m).find(|c| scaled[*c] > 0.0 && on_border(c)) {
                return Err(ContactError::ReachesEdge { column: c % n, row: c / n, approach });
            }
        }
        let scale = std::f64::consts::PI * self.effective_modulus;
        let mut pressure = scaled;
        let mut sum = 0.0;
        for p in &mut pressure {
            *p *= scale;
            sum += *p;
        }
        let force = sum * self.cell[0] * self.cell[1];
        Ok(GridContact { approach, pressure, force, dent: Vec::new(), residual, iterations })
    }
}

/// [`ActiveSet`] on a [`GridProblem`].
pub struct GridActiveSet<'a> {
    problem: &'a GridProblem,
    solver: ActiveSet,
    mirror: Mirror,
    warm: bool,
    interference: Vec<f64>,
}

/// The part of a grid that is unknown: all of it, half or a quarter.
struct Unknowns {
    first_column: usize,
    first_row: usize,
    columns: usize,
    rows: usize,
}

impl<'a> GridActiveSet<'a> {
    /// Prepares the solver. With `warm` each contact starts from the one before.
    ///
    /// # Errors
    /// None for a problem that exists.
    pub fn new(problem: &'a GridProblem, warm: bool) -> Result<Self, ContactError> {
        let mirror = problem.mirror();
        let rows = if mirror.y { problem.rows / 2 } else { problem.rows };
        let solver = ActiveSet::new(&problem.kernel(), rows, mirror)?;
        Ok(Self { problem, solver, mirror, warm, interference: Vec::new() })
    }

    fn unknowns(&self) -> Unknowns {
        let (n, m) = (self.problem.columns, self.problem.rows);
        let (i0, j0) = (if self.mirror.x { n / 2 } else { 0 }, if self.mirror.y { m / 2 } else { 0 });
        Unknowns { first_column: i0, first_row: j0, columns: n - i0, rows: m - j0 }
    }
}

impl GridSolver for GridActiveSet<'_> {
    fn at_approach(&mut self, approach: f64) -> Result<GridContact, ContactError> {
        let Unknowns { first_column: i0, first_row: j0, columns, rows } = self.unknowns();
        let n = self.problem.columns;
        self.interference.clear();
        for j in 0..rows {
            let start = (j0 + j) * n + i0;
            self.interference.extend(self.problem.gap[start..start + columns].iter().map(|h| approach - h));
        }
        if !self.warm {
            self.solver.forget();
        }
        let window = Window { first: 0, columns, interference: &self.interference };
        let effort = self.solver.solve(window)?;
        let residual = self.solver.residual(window) / approach.abs().max(f64::MIN_POSITIVE);
        let mut scaled = vec![0.0; self.problem.gap.len()];
        let m = self.problem.rows;
        for PressedCell { row, column, pressure: p, .. } in self.solver.cells() {
            let (i, j) = (i0 + column as usize, j0 + row);
            let (left, front) = (if self.mirror.x { n - 1 - i } else { i }, if self.mirror.y { m - 1 - j } else { j });
            for (i, j) in [(i, j), (left, j), (i, front), (left, front)] {
                scaled[j * n + i] = p;
            }
        }
        self.problem.finish(approach, scaled, residual, effort.iterations)
    }

    fn first_touch(&self) -> f64 {
        self.problem.first_touch()
    }
}
