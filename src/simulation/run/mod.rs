//! The life of one bearing: set up, initialized, stepped, saved and restored.

mod derivatives;
mod excitation;
mod life;
mod parameter_derivatives;
mod refresh;
mod running;
mod samples;
mod state;
mod state_bytes;
pub mod stepping;
mod values;

pub use life::Simulation;
pub use samples::{Sample, Samples};
pub use state::State;
pub use stepping::{Inspection, StepUnderWay};
