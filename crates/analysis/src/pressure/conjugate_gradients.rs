//! Iterative solution of one contact on a large grid: constrained conjugate gradients with products by Fourier
//! transforms.
//!
//! On the set of cells under pressure K p = g is solved by preconditioned conjugate gradients; cells that pull leave
//! the set with pressure 0, cells that interpenetrate enter it, and the directions start anew (Polonsky and Keer 1999,
//! with the set changed only when the equation on it is solved better than the set is known). The preconditioner is the
//! inverse of the periodic kernel, restricted to the set. A cold start takes its pressure from the same problem on a
//! grid of half as many cells, and that from a quarter.
//!
//! With a limit H of the pressure, 0 ≤ p ≤ H, cells above it leave the set with pressure H, and come back where the gap
//! would open: what is left of the interference there is the depth of a dent that stays. That is perfect plasticity of
//! the surface, without hardening and without material piled up; H is the indentation hardness, three times the yield
//! stress.
//!
//! For pressures under one element and reference solutions; last digits depend on the machine's registers.

use brinell::contact::error::ContactError;

use super::fft_product::FftProduct;
use super::grid::{GridContact, GridProblem};

/// Grids smaller than this in one direction are not coarsened any more.
const COARSEST: usize = 16;
/// Residual to which a coarser grid is solved: its own error is larger.
const COARSE_TOLERANCE: f64 = 1e-2;

/// One grid of the cascade with its workspace.
struct Level {
    columns: usize,
    rows: usize,
    fft: FftProduct,
    gap: Vec<f64>,
    interference: Vec<f64>,
    pressure: Vec<f64>,
    deflection: Vec<f64>,
    residual: Vec<f64>,
    preconditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
    /// One on cells of the set, zero elsewhere.
    active: Vec<f64>,
    /// Largest pressure over π E*.
    highest: f64,
}

/// The solver for one problem.
pub struct ConjugateGradients<'a> {
    problem: &'a GridProblem,
    tolerance: f64,
    levels: Vec<Level>,
}

impl<'a> ConjugateGradients<'a> {
    /// Prepares kernels and transforms. `tolerance` is the residual to reach, relative to the approach; `highest` the
    /// largest pressure (Pa), infinite of bodies that stay elastic.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for a tolerance that rounding does not allow, and a pressure that is not above 0.
    pub fn new(problem: &'a GridProblem, tolerance: f64, highest: f64) -> Result<Self, ContactError> {
        if !(highest > 0.0) {
            return Err(ContactError::BadInput {
                quantity: "pressure limit",
                value: highest,
                unit: "Pa",
                limit: "above 0".to_owned(),
            });
        }
        let highest = problem.scaled(highest);
        if !(1e-13..1.0).contains(&tolerance) {
            return Err(ContactError::BadInput {
                quantity: "residual asked for",
                value: tolerance,
                unit: "of the approach",
                limit: "between 1e-13 and 1".to_owned(),
            });
        }
        let (n, m) = (problem.columns(), problem.rows());
        let mut levels = vec![Level::new([n, m], problem.cell(), problem.gap().to_vec(), highest)];
        let mut cell = problem.cell();
        while let Some(fine) = levels.last() {
            let (n, m) = (fine.columns, fine.rows);
            if n < 2 * COARSEST || m < 2 * COARSEST || n % 2 == 1 || m % 2 == 1 {
                break;
            }
            cell = [2.0 * cell[0], 2.0 * cell[1]];
            let mut gap = Vec::with_capacity(n * m / 4);
            for j in (0..m).step_by(2) {
                for i in (0..n).step_by(2) {
                    let g = &fine.gap;
                    gap.push(
                        0.25 * ((g[j * n + i] + g[j * n + i + 1]) + (g[(j + 1) * n + i] + g[(j + 1) * n + i + 1])),
                    );
                }
            }
            levels.push(Level::new([n / 2, m / 2], cell, gap, highest));
        }
        Ok(Self { problem, tolerance, levels })
    }

    /// Solves at the approach δ (m); a contact may reach the grid's border ([`GridProblem::check_border`]).
    ///
    /// # Errors
    /// When the iteration does not end.
    pub fn at_approach(&mut self, approach: f64) -> Result<GridContact, ContactError> {
        let mut coarser: Option<(usize, Vec<f64>)> = None;
        let mut residual = 0.0;
        for (depth, level) in self.levels.iter_mut().enumerate().rev() {
            level.start(approach, coarser.take());
            let limit = if depth == 0 { self.tolerance } else { COARSE_TOLERANCE } * approach.abs();
            residual = level.solve(limit)?;
            if depth > 0 {
                coarser = Some((level.columns, level.pressure.clone()));
            }
        }
        let finest = &self.levels[0];
        let mut contact = self.problem.contact(approach, finest.pressure.clone(), residual / approach.abs());
        contact.dent = finest.dent();
        Ok(contact)
    }
}

impl Level {
    fn new([columns, rows]: [usize; 2], cell: [f64; 2], gap: Vec<f64>, highest: f64) -> Self {
        let zero = vec![0.0; columns * rows];
        Self {
            columns,
            rows,
            fft: FftProduct::new(columns, rows, cell),
            gap,
            interference: zero.clone(),
            pressure: zero.clone(),
            deflection: zero.clone(),
            residual: zero.clone(),
            preconditioned: zero.clone(),
            direction: zero.clone(),
            product: zero.clone(),
            active: zero,
            highest,
        }
    }

    /// What is left of the interference where the pressure is the largest allowed; nothing where there is no limit.
    fn dent(&self) -> Vec<f64> {
        if self.highest.is_infinite() {
            return Vec::new();
        }
        let left = self.interference.iter().zip(&self.deflection).map(|(g, u)| (g - u).max(0.0));
        left.zip(&self.pressure).map(|(left, &p)| if p >= self.highest { left } else { 0.0 }).collect()
    }

    /// Pressure from the coarser grid of so many columns, bilinear; or none, with the set of cells whose interference
    /// exceeds half the largest.
    fn start(&mut self, approach: f64, coarser: Option<(usize, Vec<f64>)>) {
        for (g, h) in self.interference.iter_mut().zip(&self.gap) {
            *g = approach - h;
        }
        match coarser {
            Some((n, p)) => {
                let m = p.len() / n;
                let at = |i: usize, j: usize| p[j * n + i];
                let near = |k: usize, count: usize| {
                    let other = if k % 2 == 1 { (k / 2 + 1).min(count - 1) } else { (k / 2).saturating_sub(1) };
                    (k / 2, other)
                };
                for j in 0..self.rows {
                    let (j0, j1) = near(j, m);
                    for i in 0..self.columns {
                        let (i0, i1) = near(i, n);
                        let value = 0.5625 * at(i0, j0) + 0.1875 * (at(i1, j0) + at(i0, j1)) + 0.0625 * at(i1, j1);
                        self.pressure[j * self.columns + i] = value;
                        self.active[j * self.columns + i] = f64::from(at(i0, j0) > 0.0);
                    }
                }
            }
            None => {
                let largest = self.interference.iter().fold(0.0_f64, |m, &g| m.max(g));
                self.pressure.fill(0.0);
                for (active, &g) in self.active.iter_mut().zip(&self.interference) {
                    *active = f64::from(g > 0.5 * largest);
                }
            }
        }
        for (p, active) in self.pressure.iter_mut().zip(&mut self.active) {
            if *p >= self.highest {
                (*p, *active) = (self.highest, 0.0);
            } else {
                *p *= *active;
            }
        }
    }

    fn multiply_pressure(&mut self) {
        self.fft.multiply(&self.pressure, &mut self.deflection);
    }

    /// Residual (m) that is reached.
    fn solve(&mut self, limit: f64) -> Result<f64, ContactError> {
        const MOST: usize = 1000;
        let mut iterations = 0;
        self.multiply_pressure();
        let (mut restarts, mut energy) = (true, 1.0);
        let (mut residual, mut best) = (f64::INFINITY, f64::INFINITY);
        let mut step = 0.0;
        while iterations < MOST {
            let [open, penetration, pull] = self.advance(step);
            residual = open.max(penetration);
            if residual <= limit && pull == 0.0 {
                return Ok(residual);
            }
            let mut new_set = false;
            // The set is changed when its own equation is solved well enough to tell, the better the longer it takes.
            if open <= penetration.max(limit) || (pull > 0.0 && open <= 0.3 * best) {
                best = open.min(best);
                new_set = self.change_set(limit);
                restarts |= new_set;
            }
            iterations += 1;
            self.fft.approximate_inverse(&self.residual, &mut self.preconditioned);
            let next = dot(&self.residual, &self.preconditioned);
            let beta = if restarts { 0.0 } else { next / energy };
            (restarts, energy) = (false, next);
            for ((d, &z), &active) in self.direction.iter_mut().zip(&self.preconditioned).zip(&self.active) {
                *d = active * (z + beta * *d);
            }
            self.fft.multiply(&self.direction, &mut self.product);
            let curvature = dot(&self.direction, &self.product);
            if !(curvature > 0.0) {
                // All that was in the set came to the limit: what interpenetrates now enters it.
                if new_set && self.highest.is_finite() {
                    (step, restarts) = (0.0, true);
                    continue;
                }
                break;
            }
            step = next / curvature;
        }
        Err(ContactError::NotConverged { iterations, residual, limit })
    }

    /// Goes a step along the direction; largest |g − u| on the set, largest g − u outside it or u − g where the
    /// pressure is at its limit, and by how much one pulls or is above that.
    fn advance(&mut self, step: f64) -> [f64; 3] {
        let [mut open, mut penetration, mut pull] = [0.0_f64; 3];
        for c in 0..self.pressure.len() {
            self.pressure[c] += step * self.direction[c];
            self.deflection[c] += step * self.product[c];
            let gap = self.interference[c] - self.deflection[c];
            self.residual[c] = self.active[c] * gap;
            open = open.max(self.residual[c].abs());
            let outside = gap - self.residual[c];
            penetration = penetration.max(if self.pressure[c] >= self.highest { -outside } else { outside });
            pull = pull.max(-self.pressure[c]).max(self.active[c] * (self.pressure[c] - self.highest));
        }
        [open, penetration, pull]
    }

    /// Drops cells that pull or are above the limit, and adds cells that interpenetrate, or that the limit would leave
    /// open; whether there were any.
    fn change_set(&mut self, limit: f64) -> bool {
        let (mut dropped, mut added) = (false, false);
        for (((p, active), &g), &u) in
            self.pressure.iter_mut().zip(&mut self.active).zip(&self.interference).zip(&self.deflection)
        {
            if *p < 0.0 {
                (*p, *active, dropped) = (0.0, 0.0, true);
            } else if *active != 0.0 && *p > self.highest {
                (*p, *active, dropped) = (self.highest, 0.0, true);
            } else if *active == 0.0 && (if *p >= self.highest { u - g } else { g - u }) > 0.5 * limit {
                (*active, added) = (1.0, true);
            }
        }
        if dropped {
            self.multiply_pressure();
        }
        if dropped || added {
            for (((r, &g), &u), &active) in
                self.residual.iter_mut().zip(&self.interference).zip(&self.deflection).zip(&self.active)
            {
                *r = active * (g - u);
            }
        }
        dropped || added
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
