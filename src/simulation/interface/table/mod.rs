//! The variable table: name, reference, causality, unit and start value of everything a host can see.

mod between_runs;
mod builder;
mod coordinates;
mod coupling;
pub mod guid;
mod parameters;
mod rows;
mod variables;

pub use guid::guid;
pub use rows::rows;
pub use variables::{Causality, Dependencies, Kind, Unit, Variability, Variable};
