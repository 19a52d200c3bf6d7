//! The FMI 3.0 co-simulation C interface: how a host sees a [`Simulation`](brinell::simulation::Simulation).
//!
//! All functions of `fmi3Functions.h` are exported, as the standard asks; those of model exchange, scheduled execution,
//! clocks, events and structural parameters only say that they are not provided. Each is one call into `boundary`, as
//! in FMI 2.0. Variables are the same, by the same names; what every element has is one array. Here are:
//!
//! | file | knows |
//! |---|---|
//! | `types` | the C types of the standard's headers |
//! | `functions` | in which modes each function may be called |
//! | `values` | how scalars and arrays are read and set |
//! | `api_*` | the exported functions, grouped as the standard groups them |

mod api_both_versions;
mod api_dependencies;
mod api_derivatives;
mod api_life;
mod api_not_provided;
mod api_step;
mod api_variables;
mod functions;
#[cfg(test)]
mod tests;
mod types;
mod values;

pub use api_both_versions::*;
pub use api_dependencies::*;
pub use api_derivatives::*;
pub use api_life::*;
pub use api_not_provided::*;
pub use api_step::*;
pub use api_variables::*;
pub use types::*;
