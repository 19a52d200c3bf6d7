//! What the standard allows.

use super::TABLE;
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

/// Index of a function in the table.
pub(super) fn row(function: &str) -> usize {
    TABLE.iter().position(|(name, ..)| *name == function).unwrap()
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
