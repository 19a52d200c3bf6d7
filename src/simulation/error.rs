//! What goes wrong in setting up or stepping a bearing.

use crate::contact::error::ContactError;
use crate::dynamics::equilibrium::EquilibriumError;
use crate::scene::{ContactLaw, Plain, SceneError};
use crate::simulation::step_error::StepError;
use crate::surface::SurfaceError;

/// What goes wrong in setting up or stepping a bearing. Each message names the quantity, its value and the limit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum SimulationError {
    /// A variable was addressed wrongly or given a value that it cannot have. Nothing was changed.
    #[error(transparent)]
    Variable(#[from] VariableError),
    /// The scene is impossible, perhaps only with the parameters set since.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The defect's profile cannot be used.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// No load distribution to start from.
    #[error(transparent)]
    Equilibrium(#[from] EquilibriumError),
    /// A contact near the defect cannot be computed, or the stored map not be used.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The contact law cannot be used with this surface.
    #[error("contact.law = {law:?} takes a profile along the raceway only: use map or love for a topography")]
    LawNotAvailable { law: ContactLaw },
    /// The balls' gyroscopic couple where the outer ring turns.
    #[error("bearing.gyroscopic is of an outer ring that stands: leave it out, or housing.speed_hz")]
    CoupleOfTurningHousing,
    /// What is modelled only of rings that stay in their plane.
    #[error("{what} is modelled with bearing.degrees_of_freedom = 2 only, not with {given}")]
    NotInSpace { what: &'static str, given: usize },
    /// A topography beside which balls run.
    #[error(
        "defect.profile: the topography of the {body} reaches from {:.4} to {:.4} mm across (axial_mm), and elements \
         run {}: rows must reach there; axial_mm 0 is the bottom of the groove, the middle of a roller",
        rows_mm[0], rows_mm[1], between(*track_mm)
    )]
    OffTopography { body: &'static str, track_mm: [f64; 2], rows_mm: [f64; 2] },
    /// A communication step that cannot be taken. Nothing was changed.
    #[error("communication step {} s: it must be finite and above 0", Plain(*.0))]
    CommunicationStep(f64),
    /// A start time that is no instant. Nothing was changed.
    #[error("start time {0} s: it must be finite")]
    StartTime(f64),
    /// Rings that nothing holds: how the equilibrium moves with the inputs is not defined.
    #[error("the initial equilibrium has no derivative: an internal ring touches nothing and has no support stiffness")]
    NoDerivative,
    /// A derivative by a size of a spall whose contacts are those of Love's half-space.
    #[error(
        "no derivative by {0}: a contact map is solved for each size of a spall and is exact to 1e-3; contact.law \
         hertz has one, or take the difference of two starts"
    )]
    NoDerivativeBySize(String),
    /// A state that names cells of a raceway which this model does not have.
    #[error("the state is not of this model: it has an element in a part of the defect that is not there")]
    ForeignState,
    /// Waves so short that a contact averages them.
    #[error(
        "number of waves around a body (waviness.order) is {order}: it must be at most {limit}, five lengths of the \
         contact of {contact_mm:.3} mm at {force} N to a wave, or the contact averages them; give shorter ones as a \
         defect with defect.profile"
    )]
    ShortWaves { order: u32, limit: f64, contact_mm: f64, force: f64 },
    /// Oil films so thick that they press the contacts beyond the elastic range.
    #[error(
        "oil films of {films_um:.3} um at {speed_hz} Hz leave a radial clearance of {clearance_um:.3} um: it must be \
         at least {limit_um:.3} um"
    )]
    ThickFilms { films_um: f64, speed_hz: f64, clearance_um: f64, limit_um: f64 },
    /// A step was asked for before initialization.
    #[error("a step was asked for before initialization was finished")]
    NotInitialized,
    /// The integration failed; the state is that of the last accepted integration step.
    #[error("at {time:.6e} s: {cause}")]
    Step { time: f64, cause: StepError },
}

/// A variable was addressed wrongly or given a value that it cannot have. Nothing was changed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum VariableError {
    /// No such reference.
    #[error("value reference {0} is unknown: this model's references are 0 to {1}")]
    UnknownReference(u32, u32),
    /// No such name.
    #[error("this model has no variable {name}")]
    UnknownName { name: String },
    /// A list that does not have as many entries as there are value references.
    #[error("{references} value references with a list of {given} for them: there must be as many of both")]
    Lengths { references: usize, given: usize },
    /// The variable has another type.
    #[error("variable {name} (value reference {reference}) is not of type {wanted}")]
    WrongType { name: String, reference: u32, wanted: &'static str },
    /// A variable that is not real was read or set by its name, as only a real one can be.
    #[error("variable {name} is of type {kind}: use {call}, with its reference")]
    NotReal { name: String, kind: &'static str, call: &'static str },
    /// An output, or a parameter after initialization.
    #[error("variable {name} cannot be set: {why}")]
    NotSettable { name: String, why: &'static str },
    /// A value outside its range, or not finite.
    #[error("variable {name}: {} is outside {} … {}", Plain(*value), Plain(*min), Plain(*max))]
    OutOfRange { name: String, value: f64, min: f64, max: f64 },
    /// Derivatives are taken of inputs only, and their orders begin at 1.
    #[error(
        "derivative of order {order} of {name}: only real inputs have derivatives that can be set, of order 1 and above"
    )]
    Derivative { name: String, order: i32 },
    /// A derivative that the motion within a step has no use for.
    #[error("derivative of order {order} of {name} would have no effect: orders up to {highest} act")]
    UnusedDerivative { name: String, order: i32, highest: i32 },
    /// Derivatives are given of real outputs.
    #[error("derivative of {name}: it is no real output")]
    NotAnUnknown { name: String },
    /// Directional derivatives are taken by real inputs, and before the start by real parameters.
    #[error("directional derivative by {name}: it is no real input, nor a real parameter before the start")]
    NotAKnown { name: String },
    /// Derivatives by time are given of order 1.
    #[error("derivative of order {order} of {name} by time: only order 1 is given")]
    OutputDerivative { name: String, order: i32 },
}

/// A place, or two between which it is.
fn between([first, last]: [f64; 2]) -> String {
    if first == last { format!("at {first:.4} mm") } else { format!("from {first:.4} to {last:.4} mm") }
}
