//! The FMI 3.0 C interface: how a host sees a [`Simulation`](brinell::simulation::Simulation).
//!
//! All functions of `fmi3Functions.h` are exported, as the standard asks; those of scheduled execution, clocks and
//! structural parameters only say that they are not provided, those of model exchange in an instance for co-simulation.
//! Each is one call into `boundary`, as in FMI 2.0. Variables are the same, by the same names; what every element has
//! is one array. Here are:
//!
//! | file | knows |
//! |---|---|
//! | `types` | the C types of the standard's headers |
//! | `functions` | in which modes each function may be called |
//! | `values` | how scalars and arrays are read and set |
//! | `api` | the exported functions, grouped as the standard groups them |

mod api;
mod functions;
#[cfg(test)]
mod tests;
mod types;
mod values;

pub use api::*;
pub use types::*;
