//! What can go wrong in a call: the status that the host gets, and the line that tells its user what to do.
//!
//! An error condemns the instance until it is reset or restored. Discarding is kept for what a host can put right by
//! itself: a value outside its variable's range, a status that is not known here, a derivative that does not exist,
//! is not given or would have no effect.

use crate::c_interface::Status;
use crate::instance::blob::BlobError;
use crate::instance::clock::ClockError;
use crate::instance::mode::{Function, Mode, Version};
use brinell::recording::{RecordingError, Unstored};
use brinell::simulation::{SimulationError, VariableError};
use libc::c_int;

/// What went wrong in a call.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The function may not be called in this mode.
    #[error("not allowed in mode \"{}\", only in: {function}", .mode.name(function.version))]
    OutOfMode { mode: Mode, function: &'static Function },
    /// A null pointer where there must be none.
    #[error("argument {0} is NULL")]
    NullPointer(&'static str),
    /// A pointer that no array of this type can have.
    #[error("argument {0} is not aligned for its type")]
    Misaligned(&'static str),
    /// A saved state where its address belongs.
    #[error("argument {0} is a state, not the address of one")]
    NotAnAddress(&'static str),
    /// An array longer than any that makes sense.
    #[error("argument {name} has {count} elements, at most {limit} are accepted")]
    TooLong { name: &'static str, count: usize, limit: usize },
    /// An array to be written lies over one to be read.
    #[error("input and output arrays overlap")]
    Overlap,
    /// A string that is not UTF-8.
    #[error("argument {0} is not UTF-8")]
    NotUtf8(&'static str),
    /// A function of the other kind of FMU.
    #[error("this FMU is for co-simulation: step it with fmi2DoStep")]
    ModelExchange,
    /// A recording where somebody else integrates.
    #[error(
        "recorder.folder is set: the recorder samples inside steps of the FMU's own; use the FMU for co-simulation"
    )]
    NoRecorder,
    /// A state of the other kind.
    #[error("the FMU state is one of the other kind: model exchange and co-simulation do not share states")]
    OtherKind,
    /// A state that an integrator tries.
    #[error("{0}: take a shorter step")]
    Trial(String),
    /// A function that belongs to a capability which is not declared.
    #[error("this FMU {0}")]
    NotProvided(&'static str),
    /// A reference of no variable.
    #[error("value reference {0} is unknown: modelDescription.xml lists those of this model")]
    UnknownReference(u32),
    /// Another number of values than the variables have.
    #[error("{name} = {given}: the variables referred to have {needed} values")]
    ValueCount { name: &'static str, given: usize, needed: usize },
    /// Arrays of another length than there are dependencies.
    #[error("{name} = {given}: the variable has {needed} dependencies now")]
    DependencyCount { name: &'static str, given: usize, needed: usize },
    /// A variable that an intermediate update may not touch.
    #[error("variable {name} cannot be {what} in an intermediate update: {why}")]
    NotIntermediate { name: String, what: &'static str, why: &'static str },
    /// The host's function for intermediate updates has unwound.
    #[error("intermediateUpdate did not return: {0}; the step is lost")]
    UpdateUnwound(String),
    /// The step has ended without its instance.
    #[error("intermediateUpdate returned while another call was in the instance; the step is lost")]
    GivenUp,
    /// A call within the host's intermediate update that has not ended with it.
    #[error(
        "intermediateUpdate returned before this call within it did: the step is lost; end calls in other threads \
         before intermediateUpdate returns"
    )]
    OutlivesUpdate,
    /// A call in the host's intermediate update has failed.
    #[error("a call inside the intermediate update at {0:?} s has failed; the step is lost")]
    FailedInUpdate(f64),
    /// A time for an early return that lies outside the step.
    #[error("earlyReturnTime {at:?} s: it must lie between {from:?} s and {to:?} s, the ends of the step")]
    EarlyReturnTime { at: f64, from: f64, to: f64 },
    /// Initialization without an experiment.
    #[error("call fmi2SetupExperiment first")]
    NotSetUp,
    /// A tolerance that is none.
    #[error("tolerance {0}: it must be finite and above 0")]
    Tolerance(f64),
    /// A time or a step that is refused.
    #[error(transparent)]
    Clock(#[from] ClockError),
    /// A variable was addressed wrongly or given an impossible value.
    #[error(transparent)]
    Variable(#[from] VariableError),
    /// The model could not do what was asked.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// A recording that cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Samples that could not be stored when a run ended.
    #[error("{cause}. {} {fate}", unstored(.samples))]
    Unstored { cause: RecordingError, samples: Option<Unstored>, fate: &'static str },
    /// A result that is not a number, or infinite.
    #[error("variable {name} is {value}; it is not handed out. Check the inputs and the step size")]
    NotFinite { name: String, value: f64 },
    /// A handle of a state that this instance did not give out, or that was freed.
    #[error(
        "the FMU state is not one of this instance's: initialise the variable to NULL before a state is saved to it, \
         and take a state to another instance in serialized form"
    )]
    UnknownState,
    /// Bytes that are not a state of this model.
    #[error(transparent)]
    Blob(#[from] BlobError),
    /// A buffer of another size than the state needs.
    #[error("size {given}: the serialized state has {needed} bytes")]
    Size { given: usize, needed: usize },
    /// A status that cannot be asked for here.
    #[error("status kind {0} is not known to this function")]
    UnknownStatus(c_int),
    /// Logging categories that do not exist.
    #[error("unknown category \"{0}\"; the known ones among the others are set")]
    UnknownCategory(String),
    /// A bug in Brinell.
    #[error("internal error: {0}. Please report it")]
    Panic(String),
}

impl Failure {
    /// The status that the host gets.
    pub(crate) fn status(&self) -> Status {
        match self {
            Failure::UnknownCategory(_) | Failure::Unstored { .. } => Status::Warning,
            Failure::UnknownStatus(_)
            | Failure::Trial(_)
            | Failure::Variable(VariableError::OutOfRange { .. } | VariableError::UnusedDerivative { .. })
            | Failure::Simulation(
                SimulationError::NoDerivative
                | SimulationError::NoDerivativeBySize(_)
                | SimulationError::Variable(
                    VariableError::OutOfRange { .. }
                    | VariableError::NotAKnown { .. }
                    | VariableError::NotAnUnknown { .. },
                ),
            ) => Status::Discard,
            _ => Status::Error,
        }
    }

    /// Whether the line is sent even if its category is off: whoever wants no debugging still wants to know what was
    /// lost.
    pub(crate) fn must_be_told(&self) -> bool {
        matches!(self, Failure::Unstored { .. })
    }

    /// What the host can do after this.
    pub(crate) fn advice(&self, version: Version) -> &'static str {
        match (self.status(), version) {
            (Status::Warning, _) => "",
            (Status::Discard, _) => " Nothing was changed; the run can go on.",
            (_, Version::Fmi2) => {
                " The instance is in error: call fmi2Reset, restore a saved state with fmi2SetFMUstate, \
                 or call fmi2FreeInstance."
            }
            (_, Version::Fmi3) => {
                " The instance is in error: call fmi3Reset, restore a saved state with fmi3SetFMUState, \
                 or call fmi3FreeInstance."
            }
        }
    }
}

fn unstored(samples: &Option<Unstored>) -> String {
    match samples {
        Some(Unstored { count, from, to }) => format!("{count} samples from {from:.6} s to {to:.6} s"),
        None => "Samples that were taken back are still in the file and".to_owned(),
    }
}
