//! The integration methods, one step of each.

mod arrow;
pub(in crate::simulation) mod dormand_prince;
pub(in crate::simulation) mod explicit;
mod pair;
pub mod phase_fitted;
pub(in crate::simulation) mod rodas;
mod room;

pub use arrow::Arrow;
pub use explicit::{LAST, RightHandSide, largest_error};
pub use pair::Pair;
pub use room::Room;
