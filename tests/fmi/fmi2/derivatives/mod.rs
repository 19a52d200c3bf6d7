//! Derivatives that hosts ask for: of what, by what, against what they find themselves.

mod by_inputs;
mod by_parameters;
mod of_inputs_by_time;
mod of_outputs_by_time;
