//! What a [`ContactMap`] is made for, how it is made, and the fingerprint that ties it to its inputs.
//!
//! Nodes do not depend on each other: the caller says how they are computed, one after the other or on all cores, and the
//! result is the same to the last bit.

use std::hash::Hasher;

use crate::numerics::checksum::Checksum;
use crate::surface::Surface;

use super::{
    error::ContactError,
    map::ContactMap,
    map_plan::MapPlan,
    raceway_grid::{ElementOnRaceway, Resolution},
};

/// What a map is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapSpecification {
    /// Largest equivalent approach Δ [m] that may be asked for.
    pub largest_approach: f64,
    /// Largest error of either force between nodes, relative to the smooth contact's force at the largest approach.
    pub accuracy: f64,
    /// Error up to which a map that misses the accuracy is still taken; `None` for half more than the accuracy.
    pub tolerated: Option<f64>,
    /// Cells of the grid across Hertz's ellipse at the largest approach.
    pub resolution: Resolution,
}

impl MapSpecification {
    /// 0.1 % of full scale on 48 × 32 cells, twice.
    pub fn new(largest_approach: f64) -> Self {
        Self { largest_approach, accuracy: 1e-3, tolerated: None, resolution: Resolution { columns: 48, rows: 32 } }
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

/// The map follows the grid, and the grid's own steps may be larger than the accuracy: a map is refused when its error is
/// so many times what was asked for, unless the specification tolerates more.
const REFUSED: f64 = 1.5;

impl ContactMap {
    /// Map for an element over `surface`.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for impossible inputs, [`ContactError::MapNotAccurate`] when even the finest nodes miss the
    /// accuracy by more than is tolerated; what was reached is in [`ContactMap::accuracy`].
    pub fn build(
        surface: &Surface,
        element: ElementOnRaceway,
        specification: MapSpecification,
        runner: &mut impl Runner,
    ) -> Result<Self, ContactError> {
        let map = MapPlan::new(surface, element, specification)?.build(runner)?;
        if map.accuracy.max() > specification.tolerated.unwrap_or(REFUSED * specification.accuracy) {
            return Err(ContactError::MapNotAccurate {
                achieved: map.accuracy.max(),
                requested: specification.accuracy,
                nodes: map.nodes(),
            });
        }
        Ok(map)
    }

    /// Fingerprint of all inputs: a stored map with another one belongs to something else.
    pub fn fingerprint_of(surface: &Surface, element: ElementOnRaceway, specification: MapSpecification) -> u64 {
        let mut hash = Checksum::default();
        hash.write(env!("CARGO_PKG_VERSION").as_bytes());
        let mut number = |value: f64| hash.write(&value.to_bits().to_le_bytes());
        for value in [element.element_radius, element.raceway_radius, element.groove_radius] {
            number(value);
        }
        number(specification.largest_approach);
        number(specification.accuracy);
        number(specification.resolution.columns as f64);
        number(specification.resolution.rows as f64);
        match surface {
            Surface::Profile(profile) => {
                for &(arc, depth) in profile.points() {
                    number(arc);
                    number(depth);
                }
            }
            Surface::Topography(topography) => {
                let (arcs, axials, depths) = topography.grid();
                for values in [arcs, axials, depths] {
                    number(values.len() as f64);
                    for &value in values {
                        number(value);
                    }
                }
            }
        }
        hash.finish()
    }
}
