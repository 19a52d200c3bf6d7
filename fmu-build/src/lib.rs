//! Packs Brinell scenes into FMUs, checks them and runs them.
//!
//! A scene becomes an FMU in three steps: [`package::model`] reads it and asks the simulation for its variable table,
//! [`package::description`] and [`package::documentation`] write that table down, [`package::archive`] zips them
//! together with the one compiled [`package::library`] that serves every scene. No compiler is needed for a new
//! bearing.

pub mod cli;
pub mod commands;
mod interrupt;
pub mod package;
pub mod paper;
pub mod platforms;
pub mod run;
pub mod shared;
mod sweep;
