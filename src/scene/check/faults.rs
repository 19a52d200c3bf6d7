//! What is wrong with a scene, gathered: a reader mends all of it at once, not one fault after the other.

use crate::scene::SceneError;

/// The faults found so far.
#[derive(Default)]
pub(super) struct Faults(Vec<SceneError>);

impl Faults {
    /// Whether a check has passed; if not, keeps why.
    pub(super) fn passes(&mut self, checked: Result<(), SceneError>) -> bool {
        self.take(checked).is_some()
    }

    /// What there is, or keeps why there is nothing.
    pub(super) fn take<T>(&mut self, found: Result<T, SceneError>) -> Option<T> {
        found.map_err(|error| self.0.extend(error.each())).ok()
    }

    /// An error where there was a fault.
    pub(super) fn into_result(self) -> Result<(), SceneError> {
        if self.0.is_empty() { Ok(()) } else { Err(self.into_error()) }
    }

    /// The one fault as it is, or all of several.
    pub(super) fn into_error(mut self) -> SceneError {
        match self.0.pop() {
            Some(only) if self.0.is_empty() => only,
            last => {
                self.0.extend(last);
                SceneError::Several(self.0)
            }
        }
    }
}
