//! Derivatives of the equations of motion: Jacobian, tangent stiffness, change with an input.

pub mod jacobian;
mod linearized;
pub mod tangent;
pub mod variation;

pub use jacobian::{BodyIndices, Fastest, Jacobian};
pub use tangent::{RingJacobian, Rings};
pub use variation::{ForceChange, Variation};

pub(crate) use tangent::stacked;

pub(in crate::dynamics) use linearized::{Bends, ElementChange, ElementVariation, Linearized};
pub(in crate::dynamics) use tangent::RadialForce;
