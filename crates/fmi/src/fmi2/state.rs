//! The modes of an instance, and in which of them each function may be called.
//!
//! Transcribes the table of section 4.2.4 of FMI 2.0.x for co-simulation. Modes that cannot occur here are left out:
//! *step in progress* and *step canceled* need a step that runs in the background, *step failed* needs a step that is
//! discarded, *fatal* condemns other instances. `fmi2Instantiate`, `fmi2GetTypesPlatform` and `fmi2GetVersion` take
//! no instance, so they have no row.
//!
//! Every `fmi2Error` leads to [`Mode::Error`]. What may still be read there helps debugging and no more.

use std::fmt;

/// Mode of an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Mode {
    /// After `fmi2Instantiate` or `fmi2Reset`: parameters and inputs may be set.
    Instantiated = 1,
    /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`: outputs may also be read.
    Initialization = 2,
    /// At a communication point.
    StepComplete = 4,
    /// After `fmi2Terminate`: results may be read.
    Terminated = 8,
    /// After an `fmi2Error`.
    Error = 16,
}

impl Mode {
    /// All modes, in the order of a run.
    pub(super) const ALL: [Mode; 5] =
        [Mode::Instantiated, Mode::Initialization, Mode::StepComplete, Mode::Terminated, Mode::Error];

    /// The mode with this number, if there is one.
    pub(super) fn from_number(number: u8) -> Option<Mode> {
        Mode::ALL.into_iter().find(|mode| *mode as u8 == number)
    }
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Mode::Instantiated => "instantiated",
            Mode::Initialization => "initialization mode",
            Mode::StepComplete => "step complete",
            Mode::Terminated => "terminated",
            Mode::Error => "error",
        })
    }
}

/// A set of modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Modes(u8);

impl Modes {
    /// Whether the set has this mode.
    #[inline]
    pub(super) const fn contains(self, mode: Mode) -> bool {
        self.0 & mode as u8 != 0
    }
}

impl fmt::Display for Modes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for mode in Mode::ALL.into_iter().filter(|mode| self.contains(*mode)) {
            write!(f, "{separator}{mode}")?;
            separator = ", ";
        }
        if separator.is_empty() { f.write_str("no mode, for no step runs in the background") } else { Ok(()) }
    }
}

/// An exported function and where it may be called: one row of the table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Function {
    /// Its name in C.
    pub(super) name: &'static str,
    /// Modes in which it may be called.
    pub(super) allowed: Modes,
}

const fn modes<const N: usize>(list: [Mode; N]) -> Modes {
    let mut bits = 0;
    let mut index = 0;
    while index < N {
        bits |= list[index] as u8;
        index += 1;
    }
    Modes(bits)
}

use Mode::{Error, Initialization, Instantiated, StepComplete, Terminated};

/// Every mode.
pub(super) const ALWAYS: Modes = modes([Instantiated, Initialization, StepComplete, Terminated, Error]);
const BEFORE: Modes = modes([Instantiated]);
const READ: Modes = modes([Initialization, StepComplete, Terminated, Error]);
const READ_RESULT: Modes = modes([StepComplete, Terminated, Error]);
const WRITE: Modes = modes([Instantiated, Initialization, StepComplete]);
const QUERY: Modes = modes([StepComplete, Terminated]);

macro_rules! functions {
    ($($row:ident $name:literal $allowed:expr;)*) => {
        $(pub(super) const $row: Function = Function { name: $name, allowed: $allowed };)*
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
    TERMINATE                   "fmi2Terminate"                 modes([StepComplete]);
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
    SET_REAL_INPUT_DERIVATIVES  "fmi2SetRealInputDerivatives"   WRITE;
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

    #[test]
    fn a_mode_survives_its_number() {
        for mode in Mode::ALL {
            assert_eq!(Mode::from_number(mode as u8), Some(mode));
        }
        assert_eq!(Mode::from_number(3), None);
    }
}
