//! What is saved of an instance.

use super::c_types::Status;
use super::clock::Clock;
use super::mode::Mode;
use brinell::simulation::State;

/// Everything that an instance's future depends on. Logging is not part of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Snapshot {
    /// Mode.
    pub(super) mode: Mode,
    /// Time.
    pub(super) clock: Option<Clock>,
    /// Status of the last step.
    pub(super) last_step: Status,
    /// The bearing.
    pub(super) simulation: State,
}
