//! Derivatives of the equations of motion: the Jacobian, and the change with an input or by time.

mod change;
mod fastest;
pub mod jacobian;
mod spatial_jacobian;
mod spatial_variation;
pub mod variation;

pub use change::{ForceChange, Variation};
pub use fastest::{BodyIndices, Fastest};
pub use jacobian::Jacobian;
pub use spatial_jacobian::{SpatialBlock, SpatialJacobian};

pub(in crate::dynamics) use change::Going;
