//! Why a communication step could not be finished. Every message says where, when, how much, and what to try.

use crate::contact::error::ContactError;

/// Smallest step (s); the fastest real mode of a steel bearing's element lasts 1e-8 s.
pub(in crate::simulation) const SMALLEST_STEP: f64 = 1e-15;

/// Why a communication step could not be finished; the state stays that of the last accepted integration step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// Error control asks for a step that no longer moves time.
    #[error(
        "the integration step fell to {step:.1e} s (limit {limit:.0e} s) {since:.6e} s into the communication step; \
         what resists is {component}: raise solver.tolerance, or look for an extreme load, damping or jump of an input"
    )]
    Underflow {
        /// Step wanted (s).
        step: f64,
        /// Smallest step (s).
        limit: f64,
        /// Time into the communication step (s).
        since: f64,
        /// State with the largest error.
        component: String,
    },
    /// A state or its derivative is infinite or not a number, however short the step.
    #[error(
        "{component} leaves all bounds {since:.6e} s into the communication step, however short the integration step \
         ({step:.1e} s): it was {value:.6e} and changes by {rate:.1e} a second, in SI units; look for an extreme input \
         or parameter"
    )]
    NotFinite {
        /// What changes fastest, by the measure of error control.
        component: String,
        /// Its last value [SI unit].
        value: f64,
        /// Its rate [SI unit per second].
        rate: f64,
        /// Shortest step tried (s).
        step: f64,
        /// Time into the communication step (s).
        since: f64,
    },
    /// The contact law has no answer for a contact near the defect, however short the step.
    #[error(
        "element {element}, {angle_deg:.4} degrees from the defect's centre, {since:.6e} s into the communication \
         step: {cause}. The outer ring's centre is at ({:.3e}, {:.3e}) m from the inner's", offset[0], offset[1]
    )]
    Contact {
        /// Number of the element, from 1.
        element: usize,
        /// Its angle from the defect's centre (°).
        angle_deg: f64,
        /// Position of the outer ring's centre seen from the inner's (m).
        offset: [f64; 2],
        /// Time into the communication step (s).
        since: f64,
        /// Why there is no answer.
        cause: ContactError,
    },
    /// An element left the space between the rings.
    #[error(
        "element {element} has left the bearing {since:.6e} s into the communication step: its path is {path:.3e} m, \
         the limit is its radius, {limit:.3e} m; check ring positions and loads"
    )]
    ThrownOut {
        /// Number of the element, from 1.
        element: usize,
        /// Its path u (m).
        path: f64,
        /// Largest path (m).
        limit: f64,
        /// Time into the communication step (s).
        since: f64,
    },
    /// The rings' centres are further apart than any bearing's can be.
    #[error(
        "offset of the rings' centres {offset:.3e} m (limit: an element's radius, {limit:.3e} m) {since:.6e} s into \
         the communication step: shaft at ({:.3e}, {:.3e}) m, housing at ({:.3e}, {:.3e}) m; check prescribed \
         positions, velocities and accelerations, loads and support \
         stiffness", shaft[0], shaft[1], housing[0], housing[1]
    )]
    RingsApart {
        /// Position of the inner ring's centre (m).
        shaft: [f64; 2],
        /// Position of the outer ring's centre (m).
        housing: [f64; 2],
        /// Distance of the rings' centres (m).
        offset: f64,
        /// Largest distance (m).
        limit: f64,
        /// Time into the communication step (s).
        since: f64,
    },
    /// The rings are further apart along the axis than their grooves reach.
    #[error(
        "distance of the rings along z {apart:.3e} m (limit: that of the grooves' centres, {limit:.3e} m) \
         {since:.6e} s into the communication step; check prescribed positions, axial loads and axial stiffness"
    )]
    RingsApartAxially {
        /// z of the outer ring less that of the inner (m).
        apart: f64,
        /// Largest distance (m).
        limit: f64,
        /// Time into the communication step (s).
        since: f64,
    },
    /// A ball that has climbed out of its groove.
    #[error(
        "contact angle of element {element} {angle_deg:.2} degrees (limit {limit_deg} degrees) {since:.6e} s into the \
         communication step: no groove reaches there; check axial loads, tilts and prescribed positions"
    )]
    TooSteep {
        /// Number of the element, from 1.
        element: usize,
        /// Its contact angle (°).
        angle_deg: f64,
        /// Largest angle (°).
        limit_deg: f64,
        /// Time into the communication step (s).
        since: f64,
    },
    /// Elements go round so fast that time does not pass between one knot of the defect and the next.
    #[error(
        "elements passed {count} edges of the defect at one instant, {since:.6e} s into the communication step: the \
         cage turns too fast for any time to pass between them; check shaft.speed and its derivatives"
    )]
    TooFast {
        /// Passages without any time between them.
        count: usize,
        /// Time into the communication step (s).
        since: f64,
    },
    /// More integration steps than allowed in one communication step.
    #[error(
        "{steps} integration steps (limit solver.max_steps = {limit}) did not finish the communication step: \
         {since:.6e} s are done, the step is {step:.1e} s and what limits it is {component}; \
         raise solver.tolerance or solver.max_steps, or take shorter communication steps"
    )]
    TooManySteps {
        /// Steps taken, the rejected ones included.
        steps: u64,
        /// The limit.
        limit: u64,
        /// Time into the communication step (s).
        since: f64,
        /// Step wanted next (s).
        step: f64,
        /// State with the largest error.
        component: String,
    },
}
