//! The recorder: outputs sampled inside the step, filtered and decimated.

mod decimation;
mod sampling;

pub use sampling::{Due, Recorder, Samples};
