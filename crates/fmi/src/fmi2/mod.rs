//! The FMI 2.0 C interface: how a host sees a [`Simulation`](brinell::simulation::Simulation).
//!
//! The 34 functions of a co-simulation FMU are exported, and the 10 of model exchange, which in an instance for
//! co-simulation only say so: some importers look all 44 up before they load an FMU of either kind. Nothing else is
//! exported. Each is one call into `boundary`, which finds the instance behind the handle, checks that the call is
//! allowed in the instance's mode, catches a panic, logs what went wrong and fails that instance alone. What the
//! boundary leans on knows no version of the interface and is in the crate's root. Here are:
//!
//! | file | knows |
//! |---|---|
//! | `types` | the C types of the standard's headers |
//! | `functions` | in which modes each function may be called |
//! | `api` | the exported functions, grouped as the standard groups them |

mod api;
mod functions;
#[cfg(test)]
mod tests;
mod types;

pub use api::*;
pub use brinell::simulation::interface::Category;
pub use types::*;
