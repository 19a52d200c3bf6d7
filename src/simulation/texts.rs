//! String variables. There is one: the folder of the recorder.

use super::values::{not_settable, wrong_type};
use super::variables::Kind;
use super::{Simulation, VariableError};

impl Simulation {
    /// Reads strings.
    pub fn strings(&self, references: &[u32]) -> Result<Vec<String>, VariableError> {
        references.iter().map(|&reference| Ok(self.folder(reference)?.to_owned())).collect()
    }

    /// Sets strings; all or none; before `initialize`. Strings are no part of the state: a state that is restored
    /// elsewhere does not write into this host's folder.
    pub fn set_strings(&mut self, references: &[u32], values: &[&str]) -> Result<(), VariableError> {
        for &reference in references {
            self.folder(reference)?;
            if self.state.started {
                return Err(not_settable(self.variable(reference)?, "parameters are fixed after initialization"));
            }
        }
        // The folder is the only string, so the last value holds.
        if let Some(value) = values.last() {
            self.record_into(value);
        }
        Ok(())
    }

    fn folder(&self, reference: u32) -> Result<&str, VariableError> {
        let variable = self.variable(reference)?;
        match (&variable.kind, &self.recorder) {
            (Kind::Text { .. }, Some(recorder)) => Ok(&recorder.folder),
            _ => Err(wrong_type(variable, "String")),
        }
    }
}
