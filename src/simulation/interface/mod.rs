//! What a host sees: the variables, their values, and their derivatives.

pub(in crate::simulation) mod access;
mod change;
pub(in crate::simulation) mod dependencies;
mod inputs;
mod log_category;
mod outputs;
mod quantity;
pub mod table;

pub use log_category::Category;
pub use outputs::{Angles, Outputs, Solution};
pub use quantity::{Count, Parameter, Quantity, RingName};

pub(in crate::simulation) use access::Access;
pub(in crate::simulation) use change::Change;
pub(in crate::simulation) use inputs::{Inputs, RingInputs};
pub(in crate::simulation) use quantity::Input;
