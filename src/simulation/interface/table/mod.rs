//! The variable table: name, reference, causality, unit and start value of everything a host can see.

mod builder;
mod coordinates;
pub mod guid;
mod parameters;
mod rows;
mod variables;

pub use guid::guid;
pub use rows::rows;
pub use variables::{Causality, Dependencies, Kind, Unit, Variability, Variable};
