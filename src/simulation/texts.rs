//! String variables. No scene has one yet, so only empty requests succeed.

use super::{Simulation, VariableError, wrong_type};

impl Simulation {
    /// Reads strings.
    pub fn strings(&self, references: &[u32]) -> Result<Vec<String>, VariableError> {
        self.no_text(references)?;
        Ok(Vec::new())
    }

    /// Sets strings; all or none; before `initialize`.
    pub fn set_strings(&mut self, references: &[u32], _values: &[&str]) -> Result<(), VariableError> {
        self.no_text(references)
    }

    fn no_text(&self, references: &[u32]) -> Result<(), VariableError> {
        match references.first() {
            Some(&reference) => Err(wrong_type(self.variable(reference)?, "String")),
            None => Ok(()),
        }
    }
}
