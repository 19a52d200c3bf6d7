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
//! | `api_*` | the exported functions, grouped as the standard groups them |

mod api_dependencies;
mod api_derivatives;
mod api_life;
mod api_model_exchange;
mod api_not_provided;
mod api_step;
mod api_variables;
mod functions;
#[cfg(test)]
mod tests;
mod types;
mod values;

pub use api_dependencies::*;
pub use api_derivatives::*;
pub use api_life::*;
pub use api_model_exchange::*;
pub use api_not_provided::*;
pub use api_step::*;
pub use api_variables::*;
pub use both_versions::*;
pub use types::*;

/// The exported functions that both versions have: the end of an instance's life, its messages, its saved states.
mod both_versions {
    #![allow(non_snake_case)]

    use super::functions;
    use super::types::Bool;
    use crate::both_versions::*;

    crate::both_versions::functions! {
        boolean: Bool, byte: u8, logging: turn,
        free_instance: fmi3FreeInstance,
        set_debug_logging: fmi3SetDebugLogging,
        exit_initialization_mode: fmi3ExitInitializationMode,
        terminate: fmi3Terminate,
        reset: fmi3Reset,
        get_state: fmi3GetFMUState,
        set_state: fmi3SetFMUState,
        free_state: fmi3FreeFMUState,
        serialized_state_size: fmi3SerializedFMUStateSize,
        serialize_state: fmi3SerializeFMUState,
        deserialize_state: fmi3DeserializeFMUState,
    }
}
