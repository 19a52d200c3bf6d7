//! How far a [`ContactMap`] is off its grid: points of cells at which the grid was solved, and errors there.

use std::collections::BTreeMap;

use super::cells::Key;
use super::lookup::{Accuracy, ContactMap};
use crate::contact::equivalent::EquivalentApproach;
use crate::contact::error::ContactError;

/// Errors of both forces relative to full scale at one point of a cell.
pub(super) type Error = [f64; 2];

/// A point of a cell at which the map is compared with the grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Check {
    /// Radial path and arc (m).
    pub(in crate::contact) u: f64,
    pub(super) s: f64,
    /// What the grid says.
    pub(super) exact: EquivalentApproach,
}

impl Check {
    /// Error of a map for approaches up to `largest` (m); `None` without contact. `grown` is the smooth contact's force
    /// at an approach, except for a factor.
    pub(super) fn error(
        &self,
        map: &ContactMap,
        largest: f64,
        grown: &dyn Fn(f64) -> f64,
    ) -> Result<Option<Error>, ContactError> {
        let full_scale = grown(largest);
        let found = match map.lookup(self.u, self.s) {
            Ok(found) => found,
            // Cells still too large may hold anything between their corners: as wrong as can be, so they are cut.
            Err(ContactError::OutOfRange { .. }) => return Ok(Some([1.0; 2])),
            Err(error) => return Err(error),
        };
        if self.exact.value <= 0.0 && found.value <= 0.0 {
            return Ok(None);
        }
        let [found, exact] = [found, self.exact].map(|at| at.forces(grown));
        Ok(Some([(found[0] - exact[0]) / full_scale, (found[1] - exact[1]) / full_scale]))
    }
}

/// Figures over all points with contact; a point weighs as much as its cell is large.
pub(super) fn summary(errors: &BTreeMap<(usize, Key), Vec<Error>>) -> Accuracy {
    let mut accuracy = Accuracy::default();
    let (mut squares, mut weights) = ([0.0; 2], 0.0);
    for ((_, key), found) in errors {
        let weight = 0.25_f64.powi(key.level as i32);
        let weight = weight / found.len().max(1) as f64;
        for [normal, tangential] in found {
            accuracy.max_normal = accuracy.max_normal.max(normal.abs());
            accuracy.max_tangential = accuracy.max_tangential.max(tangential.abs());
            squares[0] += weight * normal * normal;
            squares[1] += weight * tangential * tangential;
            weights += weight;
            accuracy.points += 1;
        }
    }
    if weights > 0.0 {
        accuracy.rms_normal = (squares[0] / weights).sqrt();
        accuracy.rms_tangential = (squares[1] / weights).sqrt();
    }
    accuracy
}
