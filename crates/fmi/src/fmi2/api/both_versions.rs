//! The exported functions that both versions have: the end of an instance's life, its messages, its saved states.

#![allow(non_snake_case)]

use super::functions;
use super::types::{Boolean, Byte};
use crate::both_versions::*;

crate::both_versions::functions! {
    boolean: Boolean, byte: Byte, logging: switch,
    free_instance: fmi2FreeInstance,
    set_debug_logging: fmi2SetDebugLogging,
    exit_initialization_mode: fmi2ExitInitializationMode,
    terminate: fmi2Terminate,
    reset: fmi2Reset,
    get_state: fmi2GetFMUstate,
    set_state: fmi2SetFMUstate,
    free_state: fmi2FreeFMUstate,
    serialized_state_size: fmi2SerializedFMUstateSize,
    serialize_state: fmi2SerializeFMUstate,
    deserialize_state: fmi2DeSerializeFMUstate,
}
