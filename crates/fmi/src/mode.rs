//! The modes of an instance, and in which of them a function may be called.
//!
//! Modes that cannot occur here are left out: *step in progress* and *step canceled* need a step that runs in the
//! background, *step failed* needs a step that is discarded, *fatal* condemns other instances.
//!
//! Every error leads to [`Mode::Error`]. What may still be read there helps debugging and no more.

use std::fmt;

/// Mode of an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Mode {
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

pub(super) const fn modes<const N: usize>(list: [Mode; N]) -> Modes {
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
    fn a_mode_survives_its_number() {
        for mode in Mode::ALL {
            assert_eq!(Mode::from_number(mode as u8), Some(mode));
        }
        assert_eq!(Mode::from_number(3), None);
    }
}
