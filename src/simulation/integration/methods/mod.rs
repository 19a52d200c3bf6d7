//! The integration methods, one step of each.

pub(in crate::simulation) mod dormand_prince;
pub(in crate::simulation) mod explicit;
mod explicit_methods;
pub mod phase_fitted;
pub(in crate::simulation) mod rodas;
mod stage_buffers;

pub use explicit::{LAST, RightHandSide, largest_error};
pub use explicit_methods::ExplicitMethod;
pub use stage_buffers::StageBuffers;
