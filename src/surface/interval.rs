//! An interval between two measured points.

/// An interval between two measured points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Arc or axial coordinate of its middle (m).
    pub middle: f64,
    /// Length (m).
    pub length: f64,
}

impl Interval {
    /// From `low` to `high` (m).
    pub(super) fn new(low: f64, high: f64) -> Self {
        Self { middle: 0.5 * (low + high), length: high - low }
    }

    /// The longest of some.
    pub(super) fn longest(all: impl Iterator<Item = Self>) -> Option<Self> {
        all.max_by(|a, b| a.length.total_cmp(&b.length))
    }
}
