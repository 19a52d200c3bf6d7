//! The exported functions that both versions have: the end of an instance's life, its messages, its saved states.

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
