//! Derivatives of the equations of motion: the Jacobian, and the change with an input or by time.

pub mod jacobian;
pub mod variation;

pub use jacobian::{BodyIndices, Fastest, Jacobian};
pub use variation::{ForceChange, Variation};
