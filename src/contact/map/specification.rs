//! What a contact map is made for, and on how many cores.
//!
//! Nodes do not depend on each other: the caller says how they are computed, one after the other or on all cores, and
//! the result is the same to the last bit.

use crate::contact::error::ContactError;
use crate::contact::love::{EdgeSoftness, Resolution};

/// What a map is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapSpecification {
    /// Largest equivalent approach Δ (m) that may be asked for.
    pub largest_approach: f64,
    /// Largest error of either force between nodes, relative to the smooth contact's force at the largest approach.
    pub accuracy: f64,
    /// Error up to which a map that misses the accuracy is still taken; `None` for half more than the accuracy.
    pub tolerated: Option<f64>,
    /// Cells of the grid across Hertz's ellipse at the largest approach.
    pub resolution: Resolution,
    /// Softness of sharp edges; `None` for half-spaces.
    pub edges: Option<EdgeSoftness>,
}

impl MapSpecification {
    /// 0.1 % of full scale on 48 × 32 cells, twice.
    pub fn new(largest_approach: f64) -> Self {
        let resolution = Resolution { columns: 48, rows: 32 };
        Self { largest_approach, accuracy: 1e-3, tolerated: None, resolution, edges: None }
    }

    /// The same for a roller on 48 × 16 cells, of which the rows share its whole length: twice as many change forces at
    /// an edge by 0.1 %, their slope by 0.4 %.
    pub fn of_roller(largest_approach: f64) -> Self {
        Self { resolution: Resolution { columns: 48, rows: 16 }, ..Self::new(largest_approach) }
    }
}

/// Nodes, or errors between them, whichever job was asked for.
type Job<'a, T> = &'a (dyn Fn(usize) -> Result<T, ContactError> + Sync);

/// How independent jobs are run: `run(count, job)` returns `job(0)` … `job(count − 1)` in order.
pub trait Runner {
    /// Runs the jobs; `done` is called after each with the number finished.
    ///
    /// # Errors
    /// The first error of a job.
    fn run<T: Send>(&mut self, count: usize, job: Job<'_, T>) -> Result<Vec<T>, ContactError>;
}

/// One after the other, with a callback (finished, of) for a progress bar.
pub struct Sequential<F: FnMut(usize, usize)>(pub F);

impl<F: FnMut(usize, usize)> Runner for Sequential<F> {
    fn run<T: Send>(&mut self, count: usize, job: Job<'_, T>) -> Result<Vec<T>, ContactError> {
        let mut results = Vec::with_capacity(count);
        for index in 0..count {
            results.push(job(index)?);
            (self.0)(index + 1, count);
        }
        Ok(results)
    }
}
