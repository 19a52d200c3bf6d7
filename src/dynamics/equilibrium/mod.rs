//! The static equilibrium in which a run begins, and how it changes with an input.

mod error;
mod limits;
mod resting;
pub mod search;
mod spatial_search;
mod spatial_variation;
pub mod variation;

pub use search::EquilibriumError;
