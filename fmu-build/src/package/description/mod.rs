//! The XML files of an FMU, made from the variable table.

mod exchange;
mod model_description;
mod terminals;
pub mod units;

pub use model_description::model_description;
pub(crate) use model_description::{Listed, causality, listed};
pub use terminals::terminals;
