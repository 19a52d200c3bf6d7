//! The XML files of an FMU, written from the variable table.

pub mod fmi2;
pub mod fmi3;
pub mod terminals;
pub mod units;

pub use fmi2::{CAPABILITIES, Capabilities, causality};
