//! What is wrong with a scene file, all at once, and what in it is to be asked about.

mod all_tables;
mod key_fault;
mod keys;
mod locations;
mod not_modelled;
mod reading;
mod repaired;
mod toml_fault;
mod toml_kinds;
mod values;

pub use key_fault::{Hint, KeyFault, SceneFileError};
pub(crate) use reading::{scene_of, unit_questions};
pub use toml_fault::toml_fault;
