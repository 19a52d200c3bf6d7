//! In which modes each function of FMI 3.0 may be called: a transcription of sections 2.3, 3.2 and 4.2 of FMI 3.0.2 for
//! model exchange, except for the functions of that alone, and for co-simulation without events. Functions that make an
//! instance, and `fmi3GetVersion`, have no row; those that are not provided fail in every mode.

use crate::instance::Mode::{
    ContinuousTime, Error, Event, Initialization, Instantiated, IntermediateUpdate, StepComplete, Terminated,
};
use crate::instance::{Function, Modes, Version, modes};

/// Every mode but inside a step.
pub(super) const ALWAYS: Modes =
    modes([Instantiated, Initialization, StepComplete, Event, ContinuousTime, Terminated, Error]);
const READ: Modes =
    modes([Instantiated, Initialization, StepComplete, IntermediateUpdate, Event, ContinuousTime, Terminated, Error]);
const WRITE: Modes = modes([Instantiated, Initialization, StepComplete, IntermediateUpdate, Event, ContinuousTime]);
const DERIVE: Modes = modes([Initialization, StepComplete, Event, ContinuousTime, Terminated, Error]);

macro_rules! functions {
    ($($row:ident $name:literal $allowed:expr;)*) => {
        $(pub(super) const $row: Function = Function { name: $name, version: Version::Fmi3, allowed: $allowed };)*
        /// Every row of the table.
        #[cfg(test)]
        pub(super) const FUNCTIONS: &[Function] = &[$($row),*];
    };
}

functions! {
    SET_DEBUG_LOGGING           "fmi3SetDebugLogging"                   ALWAYS;
    FREE_INSTANCE               "fmi3FreeInstance"                      ALWAYS;
    ENTER_INITIALIZATION_MODE   "fmi3EnterInitializationMode"           modes([Instantiated]);
    EXIT_INITIALIZATION_MODE    "fmi3ExitInitializationMode"            modes([Initialization]);
    TERMINATE                   "fmi3Terminate"                         modes([StepComplete, Event, ContinuousTime]);
    RESET                       "fmi3Reset"                             ALWAYS;
    GET_FLOAT64                 "fmi3GetFloat64"                        READ;
    GET_INT64                   "fmi3GetInt64"                          READ;
    GET_UINT64                  "fmi3GetUInt64"                         READ;
    GET_STRING                  "fmi3GetString"                         READ;
    SET_FLOAT64                 "fmi3SetFloat64"                        WRITE;
    SET_INT64                   "fmi3SetInt64"                          WRITE;
    SET_UINT64                  "fmi3SetUInt64"                         WRITE;
    SET_STRING                  "fmi3SetString"                         WRITE;
    NUMBER_OF_DEPENDENCIES      "fmi3GetNumberOfVariableDependencies"   READ;
    DEPENDENCIES                "fmi3GetVariableDependencies"           READ;
    GET_FMU_STATE               "fmi3GetFMUState"                       ALWAYS;
    SET_FMU_STATE               "fmi3SetFMUState"                       ALWAYS;
    FREE_FMU_STATE              "fmi3FreeFMUState"                      ALWAYS;
    SERIALIZED_FMU_STATE_SIZE   "fmi3SerializedFMUStateSize"            ALWAYS;
    SERIALIZE_FMU_STATE         "fmi3SerializeFMUState"                 ALWAYS;
    DESERIALIZE_FMU_STATE       "fmi3DeserializeFMUState"               ALWAYS;
    GET_DIRECTIONAL_DERIVATIVE  "fmi3GetDirectionalDerivative"          DERIVE;
    GET_ADJOINT_DERIVATIVE      "fmi3GetAdjointDerivative"              DERIVE;
    GET_OUTPUT_DERIVATIVES      "fmi3GetOutputDerivatives"
        modes([StepComplete, IntermediateUpdate, Terminated, Error]);
    DO_STEP                     "fmi3DoStep"                            modes([StepComplete]);
}

/// The row of a function that reads variables of a type of which there are none.
pub(super) const fn reading(name: &'static str) -> Function {
    Function { name, version: Version::Fmi3, allowed: READ }
}

/// The row of a function that sets variables of a type of which there are none.
pub(super) const fn setting(name: &'static str) -> Function {
    Function { name, version: Version::Fmi3, allowed: WRITE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_error_one_may_only_read_reset_restore_or_free_under_fmi_3() {
        let allowed: Vec<_> = FUNCTIONS.iter().filter(|f| f.allowed.contains(Error)).map(|f| f.name).collect();
        for name in &allowed {
            let harmless = ["Get", "Free", "Serialize", "Deserialize"].iter().any(|verb| name[4..].starts_with(verb))
                || ["fmi3Reset", "fmi3SetFMUState", "fmi3SetDebugLogging"].contains(name);
            assert!(harmless, "{name}");
        }
        assert!(allowed.contains(&"fmi3SetFMUState") && allowed.contains(&"fmi3Reset"));
    }

    #[test]
    fn inside_a_step_nothing_may_be_called_that_could_end_the_instance_or_move_it() {
        let allowed: Vec<_> =
            FUNCTIONS.iter().filter(|f| f.allowed.contains(IntermediateUpdate)).map(|f| f.name).collect();
        let expected = [
            "fmi3GetFloat64",
            "fmi3GetInt64",
            "fmi3GetUInt64",
            "fmi3GetString",
            "fmi3SetFloat64",
            "fmi3SetInt64",
            "fmi3SetUInt64",
            "fmi3SetString",
            "fmi3GetNumberOfVariableDependencies",
            "fmi3GetVariableDependencies",
            "fmi3GetOutputDerivatives",
        ];
        assert_eq!(allowed, expected);
    }
}
