//! Derivatives of the equations of motion: the Jacobian, and the change with an input or by time.

mod arrow;
mod by_time;
mod elimination;
mod fastest;
pub mod jacobian;
mod small_change;
mod spatial_variation;
pub mod variation;

pub use fastest::{BodyIndices, Fastest};
pub use jacobian::Jacobian;
pub(crate) use small_change::Going;
pub use small_change::{ForceChange, Variation};
