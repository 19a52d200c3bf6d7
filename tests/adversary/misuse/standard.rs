//! What the standard allows, written down from its table (FMI 2.0.x, section 4.2.4, co-simulation) and from nothing of
//! Brinell.
//!
//! States that cannot occur here have no letter: *step in progress* and *step canceled* need a step in the background,
//! *step failed* a step that is discarded, *fatal* condemns other instances.

use brinell_fmi::fmi2::Status;

/// Where an instance is. The letters are those of [`TABLE`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// I
    Instantiated,
    /// Z
    Initialization,
    /// C
    StepComplete,
    /// T
    Terminated,
    /// E
    Error,
}

pub(super) const LETTERS: &str = "IZCTE";

/// Each function of the standard, and the states in which it may be called. S is *start and end*: no instance.
pub(super) const TABLE: [(&str, &str); 34] = [
    ("fmi2GetTypesPlatform", "SIZCTE"),
    ("fmi2GetVersion", "SIZCTE"),
    ("fmi2SetDebugLogging", "IZCTE"),
    ("fmi2Instantiate", "S"),
    ("fmi2FreeInstance", "IZCTE"),
    ("fmi2SetupExperiment", "I"),
    ("fmi2EnterInitializationMode", "I"),
    ("fmi2ExitInitializationMode", "Z"),
    ("fmi2Terminate", "C"),
    ("fmi2Reset", "IZCTE"),
    ("fmi2GetReal", "ZCTE"),
    ("fmi2GetInteger", "ZCTE"),
    ("fmi2GetBoolean", "ZCTE"),
    ("fmi2GetString", "ZCTE"),
    ("fmi2SetReal", "IZC"),
    ("fmi2SetInteger", "IZC"),
    ("fmi2SetBoolean", "IZC"),
    ("fmi2SetString", "IZC"),
    ("fmi2GetFMUstate", "IZCTE"),
    ("fmi2SetFMUstate", "IZCTE"),
    ("fmi2FreeFMUstate", "IZCTE"),
    ("fmi2SerializedFMUstateSize", "IZCTE"),
    ("fmi2SerializeFMUstate", "IZCTE"),
    ("fmi2DeSerializeFMUstate", "IZCTE"),
    ("fmi2GetDirectionalDerivative", "ZCTE"),
    ("fmi2SetRealInputDerivatives", "IZC"),
    ("fmi2GetRealOutputDerivatives", "CTE"),
    ("fmi2DoStep", "C"),
    ("fmi2CancelStep", ""),
    ("fmi2GetStatus", "CT"),
    ("fmi2GetRealStatus", "CT"),
    ("fmi2GetIntegerStatus", "CT"),
    ("fmi2GetBooleanStatus", "CT"),
    ("fmi2GetStringStatus", "CT"),
];

/// Index of a function in the table.
pub(super) fn row(function: &str) -> usize {
    TABLE.iter().position(|(name, _)| *name == function).unwrap()
}

pub(super) fn allows(function: &str, state: State) -> bool {
    TABLE[row(function)].1.as_bytes().contains(&LETTERS.as_bytes()[state as usize])
}

/// Statuses that a call may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Statuses(u8);

pub(super) const OK: Statuses = Statuses(1);
pub(super) const WARNING: Statuses = Statuses(2);
pub(super) const DISCARD: Statuses = Statuses(4);
pub(super) const ERROR: Statuses = Statuses(8);

impl Statuses {
    pub(super) const fn or(self, other: Statuses) -> Self {
        Self(self.0 | other.0)
    }

    pub(super) fn has(self, status: Status) -> bool {
        self.0 & 1 << status as u8 != 0
    }
}
