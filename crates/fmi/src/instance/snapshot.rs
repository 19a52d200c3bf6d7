//! What is saved of an instance.

use super::clock::Clock;
use super::mode::Mode;
use crate::c_interface::Status;
use brinell::simulation::State;

/// Everything that an instance's future depends on. Logging is not part of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Snapshot {
    /// Mode.
    pub(crate) mode: Mode,
    /// Time.
    pub(crate) clock: Option<Clock>,
    /// Status of the last step.
    pub(crate) last_step: Status,
    /// The bearing.
    pub(crate) simulation: State,
}
