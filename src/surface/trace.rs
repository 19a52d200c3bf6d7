//! A measured trace of a surface: `arc_mm`, `depth_um`.
//!
//! Depths are taken as they are, positive into the ring, or as [`measured`](super::measured) makes them. The middle of
//! the arc's range is put at the defect's angle, whatever the origin of the measurement.

use super::measured::treat;
use super::{Profile, SurfaceError, csv};
use crate::scene::Measured;

/// Column of the arc.
pub(super) const ARC: &str = "arc_mm";
/// Column of the depth.
pub(super) const DEPTH: &str = "depth_um";

impl Profile {
    /// Reads a trace: a header `arc_mm,depth_um`, then one point a line with growing arc; `#` begins a comment line.
    ///
    /// # Errors
    /// An empty file, missing or unknown columns, values that are no finite numbers, fewer than two points, an arc that
    /// does not grow.
    pub fn from_csv(text: &str) -> Result<Self, SurfaceError> {
        Self::measured(text, &Measured::default())
    }

    /// The same with what is to be done to its depths.
    ///
    /// # Errors
    /// Those of [`from_csv`](Self::from_csv); a trace too short for a circle.
    pub fn measured(text: &str, of: &Measured) -> Result<Self, SurfaceError> {
        let rows = csv::read(text, [ARC, DEPTH])?;
        let [Some(first), Some(last)] = [rows.first(), rows.last()] else {
            return Err(SurfaceError::TooFewPoints { found: 0, column: ARC });
        };
        let middle = 0.5 * (first.values[0] + last.values[0]);
        for pair in rows.windows(2) {
            let (previous_mm, arc_mm) = (pair[0].values[0], pair[1].values[0]);
            if arc_mm <= previous_mm {
                return Err(SurfaceError::NotAscending { line: pair[1].line, arc_mm, previous_mm });
            }
        }
        let arcs: Vec<f64> = rows.iter().map(|row| (row.values[0] - middle) / 1e3).collect();
        let mut depths: Vec<f64> = rows.iter().map(|row| row.values[1] / 1e6).collect();
        if arcs.len() > 1 {
            treat(&arcs, &mut depths, of)?;
        }
        Ok(Self::from_points(arcs.into_iter().zip(depths).collect())?.into_samples())
    }
}
