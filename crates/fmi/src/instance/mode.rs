//! The modes of an instance, and in which of them a function may be called.
//!
//! FMI 3.0 calls *step mode* what FMI 2.0 calls *step complete*; *intermediate update* is its own.
//!
//! Modes that cannot occur here are left out: *step in progress* and *step canceled* need a step that runs in the
//! background, *step failed* needs a step that is discarded, *fatal* condemns other instances.
//!
//! Every error leads to [`Mode::Error`]. What may still be read there helps debugging and no more.

use std::fmt;

/// Mode of an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Mode {
    /// After instantiation or a reset: parameters and inputs may be set.
    Instantiated = 1,
    /// During initialization: outputs may also be read.
    Initialization = 2,
    /// At a communication point.
    StepComplete = 4,
    /// After termination: results may be read.
    Terminated = 8,
    /// After an error.
    Error = 16,
    /// Inside a step, while the host learns how far it has come.
    IntermediateUpdate = 32,
    /// Model exchange: at an event.
    Event = 64,
    /// Model exchange: between events.
    ContinuousTime = 128,
}

impl Mode {
    /// All modes, in the order of a run.
    pub(super) const ALL: [Mode; 8] = [
        Mode::Instantiated,
        Mode::Initialization,
        Mode::StepComplete,
        Mode::IntermediateUpdate,
        Mode::Event,
        Mode::ContinuousTime,
        Mode::Terminated,
        Mode::Error,
    ];

    /// The mode with this number, if there is one in which a state can be saved.
    pub(super) fn from_number(number: u8) -> Option<Mode> {
        Mode::ALL.into_iter().find(|mode| *mode as u8 == number && *mode != Mode::IntermediateUpdate)
    }

    /// Its name in a version of the standard.
    pub(crate) fn name(self, version: Version) -> &'static str {
        match self {
            Mode::Instantiated => "instantiated",
            Mode::Initialization => "initialization mode",
            Mode::StepComplete if version == Version::Fmi3 => "step mode",
            Mode::StepComplete => "step complete",
            Mode::IntermediateUpdate => "intermediate update mode",
            Mode::Event => "event mode",
            Mode::ContinuousTime => "continuous-time mode",
            Mode::Terminated => "terminated",
            Mode::Error => "error",
        }
    }
}

/// A version of the standard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Version {
    /// 2.0.
    Fmi2,
    /// 3.0.
    Fmi3,
}

/// A set of modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Modes(u8);

impl Modes {
    /// Whether the set has this mode.
    #[inline]
    pub(crate) const fn contains(self, mode: Mode) -> bool {
        self.0 & mode as u8 != 0
    }

    /// The set with this mode as well.
    pub(crate) const fn and(self, mode: Mode) -> Self {
        Self(self.0 | mode as u8)
    }
}

/// An exported function and where it may be called: one row of the table of its version.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Function {
    /// Its name in C.
    pub(crate) name: &'static str,
    /// Version of the standard that it belongs to.
    pub(crate) version: Version,
    /// Modes in which it may be called.
    pub(crate) allowed: Modes,
}

/// The modes in which it may be called, in words.
impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for mode in Mode::ALL.into_iter().filter(|mode| self.allowed.contains(*mode)) {
            write!(f, "{separator}{}", mode.name(self.version))?;
            separator = ", ";
        }
        if separator.is_empty() { f.write_str("no mode, for no step runs in the background") } else { Ok(()) }
    }
}

pub(crate) const fn modes<const N: usize>(list: [Mode; N]) -> Modes {
    let mut bits = 0;
    let mut index = 0;
    while index < N {
        bits |= list[index] as u8;
        index += 1;
    }
    Modes(bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mode_survives_its_number_unless_no_state_is_saved_in_it() {
        for mode in Mode::ALL.into_iter().filter(|mode| *mode != Mode::IntermediateUpdate) {
            assert_eq!(Mode::from_number(mode as u8), Some(mode));
        }
        assert_eq!(Mode::from_number(Mode::IntermediateUpdate as u8), None);
        assert_eq!(Mode::from_number(3), None);
    }
}
