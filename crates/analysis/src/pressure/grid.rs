//! One contact on a regular grid: an undeformed gap, pressed together by a given approach or force.
//!
//! u_i = Σ_j p_j k(i − j)/(π E*), p ≥ 0, u + h − δ ≥ 0, complementary; k is Love's kernel, cells are loaded uniformly
//! and matched at their centres. Beyond the grid nothing touches: whoever
//! asks for bodies that go on there checks that a contact does not reach the border ([`GridProblem::check_border`]).

use brinell::contact::error::ContactError;

/// Gap of two undeformed bodies on a grid, and their elasticity.
#[derive(Debug, Clone, PartialEq)]
pub struct GridProblem {
    columns: usize,
    rows: usize,
    cell: [f64; 2],
    effective_modulus: f64,
    gap: Vec<f64>,
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
}

/// The contact under a force (N), which is positive, of bodies that `solve` presses to an approach (m), to a relative
/// `limit` of the force: secants on F^(2/3), which Hertz makes a straight line, kept between approaches that are known
/// to be too small and too large.
///
/// # Errors
/// Those of `solve`, and a force that is not met.
pub fn at_force(
    mut solve: impl FnMut(f64) -> Result<GridContact, ContactError>,
    force: f64,
    guess: f64,
    limit: f64,
) -> Result<GridContact, ContactError> {
    const MOST: usize = 60;
    let root = |force: f64| libm::cbrt(force * force);
    let target = root(force);
    let (mut low, mut high) = ([0.0, 0.0], f64::INFINITY);
    let (mut last, mut at, mut residual) = ([0.0, 0.0], guess, f64::NAN);
    for _ in 0..MOST {
        let contact = solve(at)?;
        residual = contact.force / force - 1.0;
        if residual.abs() < limit {
            return Ok(contact);
        }
        let here = [at, root(contact.force)];
        if residual < 0.0 {
            low = here
        } else {
            high = at
        }
        let slope = (here[1] - last[1]) / (here[0] - last[0]);
        let secant = at + (target - here[1]) / slope;
        last = here;
        let most = if high.is_finite() { high } else { 4.0 * at };
        at = if secant > low[0] && secant < most { secant } else { 0.5 * (low[0] + most) };
    }
    Err(ContactError::NotConverged { iterations: MOST, residual, limit })
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
        Ok(Self { columns, rows, cell, effective_modulus, gap })
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
        Self::new(columns, rows, cell, effective_modulus, (0..columns * rows).map(at).collect())
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

    /// A pressure (Pa) over π E*.
    pub(super) fn scaled(&self, pressure: f64) -> f64 {
        pressure / (std::f64::consts::PI * self.effective_modulus)
    }

    /// Turns pressures over π E* into a contact.
    pub fn contact(&self, approach: f64, scaled: Vec<f64>, residual: f64) -> GridContact {
        let scale = std::f64::consts::PI * self.effective_modulus;
        let mut pressure = scaled;
        let mut sum = 0.0;
        for p in &mut pressure {
            *p *= scale;
            sum += *p;
        }
        let force = sum * self.cell[0] * self.cell[1];
        GridContact { approach, pressure, force, dent: Vec::new(), residual }
    }

    /// Refuses a contact at the grid's border, where bodies that go on beyond it are cut off.
    ///
    /// # Errors
    /// [`ContactError::ReachesEdge`].
    pub fn check_border(&self, contact: &GridContact) -> Result<(), ContactError> {
        let (n, m) = (self.columns, self.rows);
        let on_border = |c: &usize| c.is_multiple_of(n) || c % n == n - 1 || c / n == 0 || c / n == m - 1;
        match (0..n * m).find(|c| contact.pressure[*c] > 0.0 && on_border(c)) {
            Some(c) => Err(ContactError::ReachesEdge { column: c % n, row: c / n, approach: contact.approach }),
            None => Ok(()),
        }
    }
}
