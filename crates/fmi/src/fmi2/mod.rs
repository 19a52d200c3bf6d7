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
//! | `api_*` | the exported functions, grouped as the standard groups them |

mod api_both_versions;
mod api_derivatives;
mod api_life;
mod api_model_exchange;
mod api_step;
mod api_variables;
mod functions;
#[cfg(test)]
mod tests;
mod types;

pub use api_both_versions::*;
pub use api_derivatives::*;
pub use api_life::*;
pub use api_model_exchange::*;
pub use api_step::*;
pub use api_variables::*;
pub use brinell::simulation::interface::Category;
pub use types::*;
