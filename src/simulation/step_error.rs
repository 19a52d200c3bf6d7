//! Why a communication step could not be finished. Every message says where, when, how much, and what to try.

use crate::contact::error::ContactError;

/// Smallest step (s); the fastest real mode of a steel bearing's element lasts 1e-8 s.
pub(in crate::simulation) const SMALLEST_STEP: f64 = 1e-15;

/// Why a communication step could not be finished; the state stays that of the last accepted integration step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum StepError {
    /// Error control asks for a step that no longer moves time.
    #[error(
        "the integration step fell to {step:.1e} s (limit {limit:.0e} s) {since:.6e} s into the communication step; \
         what resists is {component}: raise solver.tolerance, or look for an extreme load, damping or jump of an input"
    )]
    Underflow { step: f64, limit: f64, since: f64, component: String },
    /// A state or its derivative is infinite or not a number, however short the step.
    #[error(
        "{component} leaves all bounds {since:.6e} s into the communication step, however short the integration step \
         ({step:.1e} s): it was {value:.6e} and changes by {rate:.1e} a second, in SI units; look for an extreme input \
         or parameter"
    )]
    NotFinite { component: String, value: f64, rate: f64, step: f64, since: f64 },
    /// The contact law has no answer for a contact near the defect, however short the step.
    #[error(
        "element {element}, {angle_deg:.4} degrees from the defect's centre, {since:.6e} s into the communication \
         step: {cause}. The outer ring's centre is at ({:.3e}, {:.3e}) m from the inner's", offset[0], offset[1]
    )]
    Contact {
        /// Number of the element, from 1.
        element: usize,
        angle_deg: f64,
        offset: [f64; 2],
        since: f64,
        cause: ContactError,
    },
    /// A contact near the defect under a larger force than its map is made for.
    #[error(
        "contact force of element {element}, {angle_deg:.4} degrees from the defect's centre, {since:.6e} s into the \
         communication step: {force:.0} N (limit of the contact map: {limit:.0} N); if the load is that large set \
         contact.largest_force_n = {force:.0} in the scene and build anew, else check positions, velocities and masses \
         of hosted rings"
    )]
    BeyondMap {
        /// Number of the element, from 1.
        element: usize,
        angle_deg: f64,
        force: f64,
        limit: f64,
        since: f64,
    },
    /// An element left the space between the rings.
    #[error(
        "element {element} has left the bearing {since:.6e} s into the communication step: its path is {path:.3e} m, \
         the limit is its radius, {limit:.3e} m; check ring positions and loads"
    )]
    ThrownOut {
        /// Number of the element, from 1.
        element: usize,
        path: f64,
        limit: f64,
        since: f64,
    },
    /// The rings' centres are further apart than any bearing's can be.
    #[error(
        "offset of the rings' centres {offset:.3e} m (limit: an element's radius, {limit:.3e} m) {since:.6e} s into \
         the communication step: shaft at ({:.3e}, {:.3e}) m, housing at ({:.3e}, {:.3e}) m; check prescribed \
         positions, velocities and accelerations, loads and support \
         stiffness", shaft[0], shaft[1], housing[0], housing[1]
    )]
    RingsApart { shaft: [f64; 2], housing: [f64; 2], offset: f64, limit: f64, since: f64 },
    /// The rings are further apart along the axis than their grooves reach.
    #[error(
        "distance of the rings along z {distance:.3e} m (limit: that of the grooves' centres, {limit:.3e} m) \
         {since:.6e} s into the communication step; check prescribed positions, axial loads and axial stiffness"
    )]
    AxialDistance { distance: f64, limit: f64, since: f64 },
    /// A ball that has climbed out of its groove.
    #[error(
        "contact angle of element {element} {angle_deg:.2} degrees (limit {limit_deg} degrees) {since:.6e} s into the \
         communication step: the ball is on the shoulder of its groove, which is not modelled; more axial load, less \
         load across, less tilt or clearance keep it in the groove"
    )]
    TooSteep {
        /// Number of the element, from 1.
        element: usize,
        angle_deg: f64,
        limit_deg: f64,
        since: f64,
    },
    /// Elements go round so fast that time does not pass between one knot of the defect and the next.
    #[error(
        "elements passed {count} edges of the defect at one instant, {since:.6e} s into the communication step: the \
         cage turns too fast for any time to pass between them; check shaft.speed and its derivatives"
    )]
    TooFast { count: usize, since: f64 },
    /// More integration steps than allowed in one communication step.
    #[error(
        "{steps} integration steps (limit solver.max_steps = {limit}) did not finish the communication step: \
         {since:.6e} s are done, the step is {step:.1e} s and what limits it is {component}; \
         raise solver.tolerance or solver.max_steps, or take shorter communication steps"
    )]
    TooManySteps { steps: u64, limit: u64, since: f64, step: f64, component: String },
}
