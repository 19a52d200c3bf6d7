//! Why a communication step could not be finished. Every message says where, when, how much, and what to try.

/// Why a communication step could not be finished; the state stays that of the last accepted integration step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// Error control asks for a step that no longer moves time.
    #[error(
        "the integration step fell to {step:.1e} s (limit {limit:.0e} s) {since:.6e} s into the communication step; \
         what resists is {component}: raise solver.tolerance, or look for an extreme load, damping or jump of an input"
    )]
    Underflow {
        /// Step wanted [s].
        step: f64,
        /// Smallest step [s].
        limit: f64,
        /// Time into the communication step [s].
        since: f64,
        /// State with the largest error.
        component: String,
    },
    /// A state or its derivative is infinite or not a number, however short the step.
    #[error(
        "{component} is no longer a finite number {since:.6e} s into the communication step, however short the \
         integration step ({step:.1e} s): look for an extreme input or parameter"
    )]
    NotFinite {
        /// The state.
        component: String,
        /// Shortest step tried [s].
        step: f64,
        /// Time into the communication step [s].
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
        /// Its path u [m].
        path: f64,
        /// Largest path [m].
        limit: f64,
        /// Time into the communication step [s].
        since: f64,
    },
    /// The rings' centres are further apart than any bearing's can be.
    #[error(
        "offset of the rings' centres {offset:.3e} m (limit: an element's radius, {limit:.3e} m) {since:.6e} s into the \
         communication step; check prescribed positions, velocities and accelerations, loads and support stiffness"
    )]
    RingsApart {
        /// Distance of the rings' centres [m].
        offset: f64,
        /// Largest distance [m].
        limit: f64,
        /// Time into the communication step [s].
        since: f64,
    },
    /// Elements go round so fast that time does not pass between one knot of the defect and the next.
    #[error(
        "elements passed {count} edges of the defect at one instant, {since:.6e} s into the communication step: the cage \
         turns too fast for any time to pass between them; check shaft.speed and its derivatives"
    )]
    TooFast {
        /// Passages without any time between them.
        count: usize,
        /// Time into the communication step [s].
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
        /// Time into the communication step [s].
        since: f64,
        /// Step wanted next [s].
        step: f64,
        /// State with the largest error.
        component: String,
    },
}
