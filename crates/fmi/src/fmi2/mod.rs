//! The FMI 2.0 co-simulation C interface: how a host sees a [`Simulation`](brinell::simulation::Simulation).
//!
//! The 34 functions of a co-simulation FMU are exported, and the 10 of model exchange, which only say that they are not provided: some
//! importers look all 44 up before they load an FMU of either kind. Nothing else is exported. Each is one call into `boundary`, which
//! finds the instance behind the handle, checks that the call is allowed in the instance's mode, catches a panic,
//! logs what went wrong and fails that instance alone. The rest of the module is what the boundary leans on:
//!
//! | file | knows |
//! |---|---|
//! | `types` | the C types of the standard's headers |
//! | `state` | the modes of an instance, and in which of them each function may be called |
//! | `handles` | which handles are alive; a stale or invented one is refused without being dereferenced |
//! | `arguments` | how an argument from C becomes a slice or a string |
//! | `failure` | what can go wrong, with which status and which advice |
//! | `logger` | the host's logger and its categories |
//! | `uri`, `resources` | where the scene lies, and how it is read |
//! | `shared_models` | the models read, one for all instances that have the same resources |
//! | `clock` | communication points and steps |
//! | `instance` | one instance: model, clock, mode |
//! | `snapshots`, `blob` | saved states as handles and as bytes |
//! | `api_*` | the exported functions, grouped as the standard groups them |
//!
//! This is the only module with `unsafe` code. It touches no floating-point control state, starts no thread, keeps
//! nothing in thread-local storage and prints nothing.

#![allow(unsafe_code)]

mod api_derivatives;
mod api_life;
mod api_model_exchange;
mod api_state;
mod api_step;
mod api_variables;
mod arguments;
mod blob;
mod boundary;
mod clock;
mod failure;
mod handles;
mod instance;
mod logger;
mod resources;
mod shared_models;
mod snapshots;
mod state;
#[cfg(test)]
mod tests;
mod types;
mod uri;

pub use api_derivatives::*;
pub use api_life::*;
pub use api_model_exchange::*;
pub use api_state::*;
pub use api_step::*;
pub use api_variables::*;
pub use brinell::simulation::log_category::Category;
pub use types::*;
