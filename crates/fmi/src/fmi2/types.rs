//! The C types of the standard's headers `fmi2TypesPlatform.h` and `fmi2FunctionTypes.h` (FMI 2.0.x, platform
//! "default").
//!
//! What a host hands in as an enumeration or a Boolean is a plain C integer here: an out-of-range value must be a
//! number that can be refused, not undefined behaviour.

use libc::{c_char, c_int};

pub use crate::c_interface::{
    AllocateMemoryCallback, CallbackFunctions, Component, ComponentEnvironment, FmiString, FmuState,
    FreeMemoryCallback, LoggerCallback, Status, StepFinishedCallback, ValueReference,
};

/// `fmi2Real`.
pub type Real = f64;
/// `fmi2Integer`.
pub type Integer = c_int;
/// `fmi2Boolean`: [`FALSE`] or [`TRUE`]; every other value counts as true.
pub type Boolean = c_int;
/// `fmi2Byte`.
pub type Byte = c_char;
/// `fmi2Type`.
pub type FmuType = c_int;
/// `fmi2StatusKind`.
pub type StatusKind = c_int;

/// `fmi2False`.
pub const FALSE: Boolean = 0;
/// `fmi2True`.
pub const TRUE: Boolean = 1;

/// `fmi2ModelExchange`.
pub const MODEL_EXCHANGE: FmuType = 0;
/// `fmi2CoSimulation`.
pub const CO_SIMULATION: FmuType = 1;

/// `fmi2DoStepStatus`.
pub const DO_STEP_STATUS: StatusKind = 0;
/// `fmi2PendingStatus`.
pub const PENDING_STATUS: StatusKind = 1;
/// `fmi2LastSuccessfulTime`.
pub const LAST_SUCCESSFUL_TIME: StatusKind = 2;
/// `fmi2Terminated`.
pub const TERMINATED: StatusKind = 3;

/// `fmi2EventInfo`: what an event has changed.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventInfo {
    /// `newDiscreteStatesNeeded`.
    pub new_discrete_states_needed: Boolean,
    /// `terminateSimulation`.
    pub terminate_simulation: Boolean,
    /// `nominalsOfContinuousStatesChanged`.
    pub nominals_of_continuous_states_changed: Boolean,
    /// `valuesOfContinuousStatesChanged`.
    pub values_of_continuous_states_changed: Boolean,
    /// `nextEventTimeDefined`.
    pub next_event_time_defined: Boolean,
    /// `nextEventTime` (s).
    pub next_event_time: Real,
}
