//! One bearing that is stepped through time: integrator, variable table, plain state. Does no I/O and reads no clock.
//!
//! This is the whole of what `crates/fmi` and `fmu-build` see of the model.

mod access;
mod advance;
mod arrangement;
pub mod arrays;
pub mod arrow;
mod change;
mod contact_changes;
mod crossings;
mod decimation;
mod dependencies;
pub mod derivatives;
pub mod dormand_prince;
mod driving;
pub mod error;
pub mod explicit;
mod failing;
pub mod guid;
mod inputs;
mod instance;
mod kernels;
mod knots;
pub mod log_category;
pub mod outputs;
pub mod pair;
pub mod phase_fitted;
pub mod progress;
pub mod quantity;
pub mod recorder;
mod refresh;
pub mod rodas;
pub mod room;
pub mod samples;
pub mod setup;
mod state;
pub mod state_bytes;
pub mod step_error;
mod step_size;
pub mod stepper;
mod stepping;
pub mod switching;
pub mod table;
mod table_builder;
mod table_parameters;
mod values;
pub mod variables;
pub mod workspace;

pub use error::{SimulationError, VariableError};
pub use instance::Simulation;
pub use progress::StepCounts;
pub use state::State;
pub use stepping::{Inspection, StepUnderWay};
pub use switching::Method;
