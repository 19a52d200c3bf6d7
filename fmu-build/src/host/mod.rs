//! The command `check`: an FMU tried through its C interface as an importer would.

pub mod check;
pub mod fmi2;
pub mod fmi3;

pub use check::command;
pub use fmi2::{SavedState, Slave, SlaveError};
pub use fmi3::{Slave3, Stepped};
