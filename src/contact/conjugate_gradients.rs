//! Iterative solution of one contact on a large grid: constrained conjugate gradients with products by Fourier transforms.
//!
//! On the set of cells under pressure K p = g is solved by preconditioned conjugate gradients; cells that pull leave the set with
//! pressure 0, cells that interpenetrate enter it, and the directions start anew (Polonsky and Keer 1999, with the set changed only when the
//! equation on it is solved better than the set is known). The preconditioner is the inverse of the periodic kernel, restricted to the set. A
//! cold start takes its pressure from the same problem on a grid of half as many cells, and that from a quarter.
//!
//! For reference solutions and large stored problems; inside a simulation `active_set` is faster and has the same bits everywhere.

// `!(a > b)` is true for NaN as well, and is meant to be.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

use super::{
    error::ContactError,
    fft_product::FftProduct,
    grid::{GridContact, GridProblem, GridSolver},
    half_space::KernelTable,
};

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
    active: Vec<bool>,
}

/// The solver for one problem.
pub struct ConjugateGradients<'a> {
    problem: &'a GridProblem,
    tolerance: f64,
    levels: Vec<Level>,
}

impl<'a> ConjugateGradients<'a> {
    /// Prepares kernels and transforms. `tolerance` is the residual to reach, relative to the approach.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for a tolerance that rounding does not allow.
    pub fn new(problem: &'a GridProblem, tolerance: f64) -> Result<Self, ContactError> {
        if !(1e-13..1.0).contains(&tolerance) {
            return Err(ContactError::BadInput {
                quantity: "residual asked for",
                value: tolerance,
                unit: "of the approach",
                limit: "between 1e-13 and 1".to_owned(),
            });
        }
        let mut levels = vec![Level::new(problem.columns(), problem.rows(), problem.kernel(), problem.gap().to_vec())];
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
            levels.push(Level::new(n / 2, m / 2, KernelTable::new(n / 2, m / 2, cell), gap));
        }
        Ok(Self { problem, tolerance, levels })
    }
}

impl GridSolver for ConjugateGradients<'_> {
    fn at_approach(&mut self, approach: f64) -> Result<GridContact, ContactError> {
        let mut solution: Option<(usize, Vec<f64>)> = None;
        let (mut residual, mut iterations) = (0.0, 0);
        for (depth, level) in self.levels.iter_mut().enumerate().rev() {
            level.start(approach, solution.take());
            let limit = if depth == 0 { self.tolerance } else { COARSE_TOLERANCE } * approach.abs();
            (residual, iterations) = level.solve(limit)?;
            if depth > 0 {
                solution = Some((level.columns, level.pressure.clone()));
            }
        }
        let scaled = self.levels[0].pressure.clone();
        self.problem.finish(approach, scaled, residual / approach.abs(), iterations)
    }

    fn first_touch(&self) -> f64 {
        self.problem.first_touch()
    }
}

impl Level {
    fn new(columns: usize, rows: usize, kernel: KernelTable, gap: Vec<f64>) -> Self {
        let zero = vec![0.0; columns * rows];
        Self {
            columns,
            rows,
            fft: FftProduct::new(&kernel, columns, rows),
            gap,
            interference: zero.clone(),
            pressure: zero.clone(),
            deflection: zero.clone(),
            residual: zero.clone(),
            preconditioned: zero.clone(),
            direction: zero.clone(),
            product: zero,
            active: vec![false; columns * rows],
        }
    }

    /// Pressure from the coarser grid, bilinear; or none, with the set of cells whose interference exceeds half the largest.
    fn start(&mut self, approach: f64, coarse: Option<(usize, Vec<f64>)>) {
        for (g, h) in self.interference.iter_mut().zip(&self.gap) {
            *g = approach - h;
        }
        match coarse {
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
                        self.active[j * self.columns + i] = at(i0, j0) > 0.0;
                    }
                }
            }
            None => {
                let largest = self.interference.iter().fold(0.0_f64, |m, &g| m.max(g));
                self.pressure.fill(0.0);
                for (active, &g) in self.active.iter_mut().zip(&self.interference) {
                    *active = g > 0.5 * largest;
                }
            }
        }
        for (p, &active) in self.pressure.iter_mut().zip(&self.active) {
            *p = if active { *p } else { 0.0 };
        }
    }

    /// Residual reached [m] and iterations.
    fn solve(&mut self, limit: f64) -> Result<(f64, usize), ContactError> {
        const MOST: usize = 1000;
        let mut iterations = 0;
        self.fft.multiply(&self.pressure, &mut self.deflection);
        let (mut fresh, mut energy) = (true, 1.0);
        let (mut residual, mut best) = (f64::INFINITY, f64::INFINITY);
        while iterations < MOST {
            let [open, penetration, pull] = self.measure();
            residual = open.max(penetration);
            if residual <= limit && pull == 0.0 {
                return Ok((residual, iterations));
            }
            // The set is changed when its own equation is solved well enough to tell, the better the longer it takes.
            if open <= (0.3 * penetration).max(limit) || (pull > 0.0 && open <= 0.3 * best) {
                best = open.min(best);
                if self.change_set(limit) {
                    self.fft.multiply(&self.pressure, &mut self.deflection);
                    fresh = true;
                }
            }
            iterations += 1;
            self.mask_residual();
            self.fft.approximate_inverse(&self.residual, &mut self.preconditioned);
            for (z, &active) in self.preconditioned.iter_mut().zip(&self.active) {
                *z = if active { *z } else { 0.0 };
            }
            let next = dot(&self.residual, &self.preconditioned);
            let beta = if fresh { 0.0 } else { next / energy };
            (fresh, energy) = (false, next);
            for (d, &z) in self.direction.iter_mut().zip(&self.preconditioned) {
                *d = z + beta * *d;
            }
            self.fft.multiply(&self.direction, &mut self.product);
            let curvature = dot(&self.direction, &self.product);
            if !(curvature > 0.0) {
                break;
            }
            let alpha = next / curvature;
            for (p, &d) in self.pressure.iter_mut().zip(&self.direction) {
                *p += alpha * d;
            }
            for (u, &q) in self.deflection.iter_mut().zip(&self.product) {
                *u += alpha * q;
            }
        }
        Err(ContactError::NotConverged { iterations, residual, limit })
    }

    /// Largest |g − u| on the set, largest g − u outside it, largest pull.
    fn measure(&self) -> [f64; 3] {
        let [mut open, mut penetration, mut pull] = [0.0_f64; 3];
        for (((&g, &u), &p), &active) in
            self.interference.iter().zip(&self.deflection).zip(&self.pressure).zip(&self.active)
        {
            if active {
                open = open.max((g - u).abs());
                pull = pull.max(-p);
            } else {
                penetration = penetration.max(g - u);
            }
        }
        [open, penetration, pull]
    }

    fn change_set(&mut self, limit: f64) -> bool {
        let mut changed = false;
        for (((p, active), &g), &u) in
            self.pressure.iter_mut().zip(&mut self.active).zip(&self.interference).zip(&self.deflection)
        {
            if *active && *p < 0.0 {
                (*p, *active, changed) = (0.0, false, true);
            } else if !*active && g - u > 0.5 * limit {
                (*active, changed) = (true, true);
            }
        }
        changed
    }

    fn mask_residual(&mut self) {
        for (((r, &g), &u), &active) in
            self.residual.iter_mut().zip(&self.interference).zip(&self.deflection).zip(&self.active)
        {
            *r = if active { g - u } else { 0.0 };
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut partial = [0.0_f64; 8];
    for (a, b) in a.chunks(8).zip(b.chunks(8)) {
        for ((sum, &a), &b) in partial.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    partial.iter().sum()
}
