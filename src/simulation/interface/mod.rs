//! What a host sees: the variables, their values, and their derivatives.

mod arrays;
pub(in crate::simulation) mod dependencies;
mod inputs;
mod log_category;
mod output_change;
mod outputs;
mod quantity;
mod suggested_step;
pub mod table;
pub(in crate::simulation) mod value_access;
mod variables;

pub use arrays::{ElementArray, of_all_elements};
pub use log_category::Category;
pub use outputs::{Angles, Outputs};
pub use quantity::{Count, Parameter, Quantity, RingName};

pub(in crate::simulation) use dependencies::{starts_from, turns};
pub(in crate::simulation) use inputs::{Inputs, RingInputs};
pub(in crate::simulation) use output_change::Change;
pub(in crate::simulation) use quantity::Input;
pub(in crate::simulation) use suggested_step::{Wiring, least_stiffness, of_first_order, suggested_step};
pub(in crate::simulation) use variables::{COMPUTED, FIXED, Interface, as_many, not_settable, wrong_type};
