//! Derivatives of the equations of motion: the Jacobian, and the change with an input or by time.

pub mod jacobian;
mod spatial_jacobian;
mod spatial_variation;
pub mod variation;

pub use jacobian::{BodyIndices, Fastest, Jacobian};
pub use spatial_jacobian::{SpatialBlock, SpatialJacobian};
pub use variation::{ForceChange, Variation};
