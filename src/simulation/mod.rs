//! One bearing that is stepped through time: integrator, variable table, plain state. Does no I/O and reads no clock.

pub mod coupling;
mod derivatives;
mod error;
pub mod exchange;
pub mod integration;
pub mod interface;
pub mod recorder;
pub mod run;
pub mod setup;
mod step_error;

pub use error::{SimulationError, VariableError};
pub use integration::{Method, StepCounts};
pub use run::{Inspection, Simulation, State, StepUnderWay};
pub use step_error::StepError;
