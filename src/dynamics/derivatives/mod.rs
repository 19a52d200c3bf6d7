//! Derivatives of the equations of motion: the Jacobian, and the change with an input or by time.

mod arrow;
mod by_time;
mod change;
mod elimination;
mod fastest;
pub mod jacobian;
mod plane_jacobian;
mod spatial_jacobian;
mod spatial_variation;
pub mod variation;

pub(crate) use change::Going;
pub use change::{ForceChange, Variation};
pub use fastest::{BodyIndices, Fastest};
pub use jacobian::Jacobian;
