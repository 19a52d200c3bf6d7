//! What random loads, supports and defects are drawn against.

use crate::case::On;

/// A bearing while it is drawn.
pub(super) struct Scale {
    pub(super) r: f64,
    pub(super) rollers: bool,
    pub(super) raceway: f64,
    pub(super) inner: f64,
    pub(super) approach: f64,
    /// Tangent stiffness of the two contacts in series and of both beside each other (N/m).
    pub(super) stiffness: f64,
    pub(super) mass: f64,
    /// Angular frequency of an element between its raceways (rad/s).
    pub(super) omega: f64,
}

impl Scale {
    /// Radius of the body with a defect (m).
    pub(super) fn bearer(&self, on: On) -> f64 {
        match on {
            On::Outer => self.raceway,
            On::Inner => self.inner,
            On::Element { .. } => self.r,
        }
    }
}
