//! Derivatives of the equations of motion: Jacobian, tangent stiffness, change with an input.

pub mod jacobian;
pub mod variation;

pub use jacobian::{BodyIndices, Fastest, Jacobian};
pub use variation::{ForceChange, Variation};
