//! The life of one bearing: set up, initialized, stepped, saved and restored.

mod excitation;
mod life;
mod look_ahead;
mod refresh;
mod running;
mod samples;
mod state;
mod state_bytes;
pub mod stepping;
mod values;

pub use life::Simulation;
pub(in crate::simulation) use life::UpToDate;
pub(in crate::simulation) use running::{Present, Run};
pub use samples::Sample;
pub use state::State;
pub use stepping::{Inspection, StepUnderWay};
