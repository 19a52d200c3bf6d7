//! The equations of motion: the state in, its derivative by time out.

mod balanced_derivative;
mod body_rates;
mod dense_output;
mod right_hand_side;

pub(crate) use dense_output::{Between, Known};
