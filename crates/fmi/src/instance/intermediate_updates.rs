//! What a host wants of intermediate updates, and how the one under way fares.

use crate::c_interface::{ComponentEnvironment, IntermediateUpdateCallback};

/// What a host wants of intermediate updates.
#[derive(Debug)]
pub(crate) struct IntermediateUpdates {
    /// Its function.
    pub(crate) callback: IntermediateUpdateCallback,
    /// Its own pointer, handed back.
    pub(crate) environment: ComponentEnvironment,
    /// Whether it can handle an early return.
    pub(crate) early_return: bool,
    /// References of the variables it wants to read or set, ascending.
    pub(crate) required: Vec<u32>,
    /// Whether inputs are among them.
    pub(crate) with_inputs: bool,
    /// Whether inputs may be set in the update under way.
    pub(crate) may_set: bool,
    /// Whether a call in the update under way has failed.
    pub(crate) failed: bool,
}

// SAFETY: the environment is the host's. It is handed back to the host's own function, in calls on this instance only,
// and a host that makes those from one thread after another (the standard allows it) expects it there.
unsafe impl Send for IntermediateUpdates {}

impl IntermediateUpdates {
    /// Whether the host has named this variable.
    pub(crate) fn has(&self, reference: u32) -> bool {
        self.required.binary_search(&reference).is_ok()
    }
}
