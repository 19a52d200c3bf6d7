//! In which modes each function of FMI 2.0 may be called: a transcription of the tables of sections 3.2.3 and 4.2.4 of
//! FMI 2.0.x, except for the functions of model exchange alone. `fmi2Instantiate`, `fmi2GetTypesPlatform` and
//! `fmi2GetVersion` take no instance, so they have no row.

use crate::instance::Mode::{ContinuousTime, Error, Event, Initialization, Instantiated, StepComplete, Terminated};
use crate::instance::{Function, Modes, Version, modes};

/// Every mode.
pub(super) const ALWAYS: Modes =
    modes([Instantiated, Initialization, StepComplete, Event, ContinuousTime, Terminated, Error]);
const BEFORE: Modes = modes([Instantiated]);
const READ: Modes = modes([Initialization, StepComplete, Event, ContinuousTime, Terminated, Error]);
const READ_RESULT: Modes = modes([StepComplete, Terminated, Error]);
const WRITE: Modes = modes([Instantiated, Initialization, StepComplete, Event, ContinuousTime]);
const STEP: Modes = modes([Instantiated, Initialization, StepComplete]);
const QUERY: Modes = modes([StepComplete, Terminated]);

macro_rules! functions {
    ($($row:ident $name:literal $allowed:expr;)*) => {
        $(pub(super) const $row: Function = Function { name: $name, version: Version::Fmi2, allowed: $allowed };)*
        /// Every row of the table.
        #[cfg(test)]
        pub(super) const FUNCTIONS: &[Function] = &[$($row),*];
    };
}

functions! {
    SET_DEBUG_LOGGING           "fmi2SetDebugLogging"           ALWAYS;
    FREE_INSTANCE               "fmi2FreeInstance"              ALWAYS;
    SETUP_EXPERIMENT            "fmi2SetupExperiment"           BEFORE;
    ENTER_INITIALIZATION_MODE   "fmi2EnterInitializationMode"   BEFORE;
    EXIT_INITIALIZATION_MODE    "fmi2ExitInitializationMode"    modes([Initialization]);
    TERMINATE                   "fmi2Terminate"                 modes([StepComplete, Event, ContinuousTime]);
    RESET                       "fmi2Reset"                     ALWAYS;
    GET_REAL                    "fmi2GetReal"                   READ;
    GET_INTEGER                 "fmi2GetInteger"                READ;
    GET_BOOLEAN                 "fmi2GetBoolean"                READ;
    GET_STRING                  "fmi2GetString"                 READ;
    SET_REAL                    "fmi2SetReal"                   WRITE;
    SET_INTEGER                 "fmi2SetInteger"                WRITE;
    SET_BOOLEAN                 "fmi2SetBoolean"                WRITE;
    SET_STRING                  "fmi2SetString"                 WRITE;
    GET_FMU_STATE               "fmi2GetFMUstate"               ALWAYS;
    SET_FMU_STATE               "fmi2SetFMUstate"               ALWAYS;
    FREE_FMU_STATE              "fmi2FreeFMUstate"              ALWAYS;
    SERIALIZED_FMU_STATE_SIZE   "fmi2SerializedFMUstateSize"    ALWAYS;
    SERIALIZE_FMU_STATE         "fmi2SerializeFMUstate"         ALWAYS;
    DESERIALIZE_FMU_STATE       "fmi2DeSerializeFMUstate"       ALWAYS;
    GET_DIRECTIONAL_DERIVATIVE  "fmi2GetDirectionalDerivative"  READ;
    SET_REAL_INPUT_DERIVATIVES  "fmi2SetRealInputDerivatives"   STEP;
    GET_REAL_OUTPUT_DERIVATIVES "fmi2GetRealOutputDerivatives"  READ_RESULT;
    DO_STEP                     "fmi2DoStep"                    modes([StepComplete]);
    CANCEL_STEP                 "fmi2CancelStep"                modes([]);
    GET_STATUS                  "fmi2GetStatus"                 QUERY;
    GET_REAL_STATUS             "fmi2GetRealStatus"             QUERY;
    GET_INTEGER_STATUS          "fmi2GetIntegerStatus"          QUERY;
    GET_BOOLEAN_STATUS          "fmi2GetBooleanStatus"          QUERY;
    GET_STRING_STATUS           "fmi2GetStringStatus"           QUERY;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_a_row_for_every_function_that_takes_an_instance() {
        // 34 functions, less Instantiate, GetTypesPlatform and GetVersion.
        assert_eq!(FUNCTIONS.len(), 31);
    }

    #[test]
    fn in_error_one_may_only_read_reset_restore_or_free() {
        let allowed: Vec<_> = FUNCTIONS.iter().filter(|f| f.allowed.contains(Error)).map(|f| f.name).collect();
        for name in &allowed {
            let harmless = ["Get", "Free", "Serialize", "DeSerialize"].iter().any(|verb| name[4..].starts_with(verb))
                || ["fmi2Reset", "fmi2SetFMUstate", "fmi2SetDebugLogging"].contains(name);
            assert!(harmless, "{name}");
        }
        assert!(allowed.contains(&"fmi2SetFMUstate") && allowed.contains(&"fmi2Reset"));
    }
}
