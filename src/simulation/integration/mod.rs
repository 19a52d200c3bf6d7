//! One communication step: from its start to its end in integration steps with controlled error.

mod advance;
mod failing;
mod kernels;
pub mod landing;
pub mod methods;
mod progress;
mod step_size;
mod stepper;
mod switching;
mod workspace;

pub use advance::Advance;
pub(in crate::simulation) use failing::check_rings;
pub use progress::{Progress, StepCounts};
pub use stepper::{Control, Stepper};
pub use switching::{Choice, Method};
pub use workspace::{Evaluation, Problem, Span, Workspace};
