//! What can go wrong in a contact.

/// A range (m) that may have no lower end.
fn prepared(lower: f64, upper: f64) -> String {
    if lower.is_finite() { format!("{lower:.6e} to {upper:.6e} m") } else { format!("up to {upper:.6e} m") }
}

/// Why a contact could not be solved or a map not be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum ContactError {
    /// An input is not a finite number, or out of its range.
    #[error("{quantity} is {value:e} {unit}, it must be {limit}")]
    BadInput { quantity: &'static str, value: f64, unit: &'static str, limit: String },
    /// Measured points farther apart than the grid's cells: what the grid would resolve was never measured.
    #[error(
        "defect profile: points are {step_um:.2} um apart {direction} the raceway at {at_mm:.4} mm, the limit is a \
         cell of the contact grid, {cell_um:.2} um: measure more finely, make cells longer with contact.cells, or add \
         points on lines that are meant to be straight"
    )]
    TooCoarse { direction: &'static str, step_um: f64, at_mm: f64, cell_um: f64 },
    /// Softness of edges is asked for, and there is none.
    #[error(
        "contact.edge = \"step\": the defect has no edge steeper than 60 degrees, and no other is softer than a \
         half-space; leave contact.edge out"
    )]
    NoEdge,
    /// A defect whose two ends are so close together, the long way round the raceway, that one contact feels both.
    #[error(
        "defect: it is {length_mm:.4} mm long, it must be below {limit_mm:.4} mm: elements feel it to {reach_mm:.4} mm \
         beyond either end, {why}, and the outer raceway is only {circumference_mm:.4} mm around"
    )]
    EndsMeet { length_mm: f64, limit_mm: f64, reach_mm: f64, why: &'static str, circumference_mm: f64 },
    /// A rigid element that lies so deep beside a wall that only its side meets the edge: its path leaps there.
    #[error(
        "defect: {at_mm:.4} mm from its middle an element of radius {radius_mm:.4} mm lies {depth_mm:.4} mm deep \
         beside an edge that it meets with its side; the limit is {limit_mm:.4} mm, from deeper down no rigid element \
         rolls out: make the defect shallower or its flank gentler"
    )]
    NoWayOut { at_mm: f64, depth_mm: f64, limit_mm: f64, radius_mm: f64 },
    /// An array has the wrong length.
    #[error("{quantity} has {length} values, {expected} are needed")]
    WrongLength { quantity: &'static str, length: usize, expected: usize },
    /// The contact touches the border of its window, so part of it may lie outside.
    #[error(
        "the contact reaches the window's edge at column {column}, row {row}: the window is too small for approach \
         {approach:e} m"
    )]
    ReachesEdge { column: usize, row: usize, approach: f64 },
    /// The iteration did not come to an end.
    #[error("contact not solved after {iterations} iterations: residual {residual:e}, limit {limit:e}")]
    NotConverged { iterations: usize, residual: f64, limit: f64 },
    /// The stiffness matrix of the pressed cells cannot be factored.
    #[error(
        "contact not solved: pivot {pivot} of the stiffness matrix of its {cells} pressed cells is not above 0, where \
         that of a positive definite matrix is; other cells (contact.cells) may help"
    )]
    NotPositiveDefinite {
        /// Number of the pivot, from 1.
        pivot: usize,
        cells: usize,
    },
    /// The set of pressed cells comes back to what it was.
    #[error(
        "contact not solved: its set of {cells} pressed cells still changes after {limit} sets, which is the limit; \
         other cells (contact.cells) may help"
    )]
    Cycles { cells: usize, limit: usize },
    /// Outside the range the law was prepared for.
    #[error(
        "{quantity} is {value:.6e} m, the range prepared is {}; contact.largest_force_n says how large forces near the \
         defect may be",
        prepared(*lower, *upper)
    )]
    OutOfRange { quantity: &'static str, value: f64, lower: f64, upper: f64 },
    /// Stored map that cannot be trusted.
    #[error("contact map refused: {reason}")]
    MapRefused { reason: String },
    /// The map did not reach the accuracy asked for.
    #[error(
        "contact map: error {achieved:e} of full scale with {nodes} nodes, {requested:e} was asked for: more cells \
         (contact.cells) or a larger error (contact.map_accuracy) may help"
    )]
    MapNotAccurate { achieved: f64, requested: f64, nodes: usize },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_without_a_lower_end_is_told_by_its_upper_one() {
        let beyond = |lower: f64| ContactError::OutOfRange { quantity: "approach", value: 2e-5, lower, upper: 1e-5 };
        let said = beyond(f64::NEG_INFINITY).to_string();
        assert!(said.starts_with("approach is 2.000000e-5 m, the range prepared is up to 1.000000e-5 m;"), "{said}");
        assert!(beyond(-1e-6).to_string().contains("is -1.000000e-6 to 1.000000e-5 m;"));
    }

    #[test]
    fn a_set_of_cells_that_fails_is_reported_without_a_residual_that_is_nan() {
        let matrix = ContactError::NotPositiveDefinite { pivot: 7, cells: 50 }.to_string();
        assert!(matrix.contains("pivot 7 ") && matrix.contains(" 50 pressed cells is not above 0"), "{matrix}");
        let cycle = ContactError::Cycles { cells: 50, limit: 100 }.to_string();
        assert!(cycle.contains(" 50 pressed cells still changes after 100 sets"), "{cycle}");
        assert!(!(matrix + &cycle).contains("NaN"));
    }
}
