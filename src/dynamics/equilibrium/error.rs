//! Why a static equilibrium is not found.

use crate::contact::error::ContactError;

/// Why no equilibrium was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum EquilibriumError {
    /// The residual did not vanish.
    #[error(
        "no static equilibrium: a net force of {residual:.3e} N stays on the rings (limit {limit:.1e} N); \
         give the internal rings a support stiffness that can carry their load"
    )]
    NotFound { residual: f64, limit: f64 },
    /// An element ends where the contact law near the defect has no answer any more.
    #[error(
        "no static equilibrium: element {element}, {angle_deg:.4} degrees from the defect's centre, finds no balance, \
         {residual:.3e} N are left: {cause}"
    )]
    Contact {
        /// Number of the element, from 1.
        element: usize,
        angle_deg: f64,
        residual: f64,
        cause: ContactError,
    },
    /// A ball that in balance would lie where the contact law near the defect has no answer.
    #[error(
        "no static equilibrium: element {element}, {angle_deg:.4} degrees from the defect's centre, comes to lie where \
         its contact has no answer: {cause}"
    )]
    Unsolved {
        /// Number of the element, from 1.
        element: usize,
        angle_deg: f64,
        cause: ContactError,
    },
    /// An element that nothing holds.
    #[error(
        "no static equilibrium: element {element} finds no balance between the raceways, {force:.3e} N are left on it \
         at a path of \
         {path:.3e} m; nothing carries it, or the contact's damping is more than its force at this speed: start it \
         elsewhere with cage.initial_angle, or load or hold the rings"
    )]
    Element {
        /// Number of the element, from 1.
        element: usize,
        path: f64,
        force: f64,
    },
}
