//! The variables' values, set and read by value reference.

use super::life::{Simulation, UpToDate};
use super::state::Ended;
use crate::simulation::interface::table::{Kind, Variable};
use crate::simulation::interface::{COMPUTED, FIXED, Quantity, as_many, not_settable, value_access, wrong_type};
use crate::simulation::{SimulationError, VariableError};

impl Simulation {
    /// Value of a real variable by its name. In a loop [`reals`](Self::reals) with references from
    /// [`reference`](Self::reference) is faster.
    ///
    /// # Errors
    /// An unknown name; a variable that is not real; before `initialize` an equilibrium that does not exist.
    pub fn get(&mut self, name: &str) -> Result<f64, SimulationError> {
        let reference = self.reference(name)?;
        let variable = self.variable(reference)?;
        let not_real = |kind, call| Err(VariableError::NotReal { name: name.to_owned(), kind, call }.into());
        match variable.kind {
            Kind::Real { .. } => {}
            Kind::Integer => return not_real("Integer", "counts"),
            Kind::Enumeration { .. } => return not_real("Enumeration", "integers"),
            Kind::Whole { .. } => return not_real("Integer", "integers"),
            Kind::Text { .. } => return not_real("String", "strings"),
        }
        let mut value = [0.0];
        self.reals(&[reference], &mut value)?;
        Ok(value[0])
    }

    /// Sets a real input, or before `initialize` a real parameter, by its name.
    ///
    /// # Errors
    /// An unknown name; a variable that is not real, or cannot be set now; a value out of range.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), VariableError> {
        let reference = self.reference(name)?;
        let variable = self.variable(reference)?;
        let not_real = |kind, call| Err(VariableError::NotReal { name: name.to_owned(), kind, call });
        match variable.kind {
            Kind::Real { .. } => self.set_reals(&[reference], &[value]),
            Kind::Integer => Err(not_settable(variable, COMPUTED)),
            Kind::Enumeration { .. } => not_real("Enumeration", "set_integers"),
            Kind::Whole { .. } => not_real("Integer", "set_integers"),
            Kind::Text { .. } => not_real("String", "set_strings"),
        }
    }

    /// Sets reals, a value for each reference; all or none. Inputs at any time, parameters before `initialize`.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), VariableError> {
        as_many(references.len(), values.len())?;
        let state = &mut self.run.state;
        let classes = self.interface.can_set(references, values, state.started)?;
        for (&reference, &value) in references.iter().zip(values) {
            state.reals[reference as usize] = value;
        }
        if classes & value_access::INPUT != 0 {
            state.ended = Ended::default();
        }
        self.note_set(classes & value_access::PARAMETER != 0);
        Ok(())
    }

    /// Makes the relative tolerance of the time integration this one, or the smallest that a scene may have; a smaller
    /// one stays.
    ///
    /// # Errors
    /// After `initialize`, unless the present one stays.
    pub fn tighten_tolerance(&mut self, tolerance: f64) -> Result<(), VariableError> {
        let index = self.interface.inputs.tolerance;
        let Some(index) = index.filter(|&index| tolerance < self.run.state.reals[index]) else {
            return Ok(());
        };
        let least = match self.interface.table[index].kind {
            Kind::Real { min: Some(min), .. } => min,
            _ => 0.0,
        };
        self.set_reals(&[index as u32], &[tolerance.max(least)])
    }

    /// Reads reals, one for each place in `values`. Of outputs those are computed that are asked for.
    pub fn reals(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), SimulationError> {
        as_many(references.len(), values.len())?;
        let classes = self.interface.classes(references)?;
        self.note_wiring(classes);
        if classes & value_access::AHEAD != 0 {
            self.look_ahead()?;
        }
        if classes & value_access::OUTPUT != 0 {
            self.refresh()?;
        }
        if classes & value_access::STIFFNESS != 0 {
            self.refresh_stiffness();
        }
        let (interface, outputs) = (&self.interface, self.present.outputs(&self.run));
        for (value, &reference) in values.iter_mut().zip(references) {
            let i = reference as usize;
            *value = if interface.is_output(i) {
                self.output(&outputs, interface.quantities[i])
            } else {
                interface.set_value(i, &self.run.state.reals)
            };
        }
        Ok(())
    }

    /// Sets integers (enumerations and seeds); all or none; before `initialize`.
    pub fn set_integers(&mut self, references: &[u32], values: &[i32]) -> Result<(), VariableError> {
        as_many(references.len(), values.len())?;
        let state = &mut self.run.state;
        for (&reference, &value) in references.iter().zip(values) {
            self.interface.check_integer(reference, value, state.started)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            state.integers[reference as usize] = value;
        }
        self.note_set(!references.is_empty());
        Ok(())
    }

    /// Reads integers and enumerations.
    pub fn integers(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), SimulationError> {
        as_many(references.len(), values.len())?;
        for &reference in references {
            let variable = self.variable(reference)?;
            if !matches!(variable.kind, Kind::Integer | Kind::Whole { .. } | Kind::Enumeration { .. }) {
                return Err(wrong_type(variable, "Integer").into());
            }
        }
        for (value, &reference) in values.iter_mut().zip(references) {
            let i = reference as usize;
            *value = match self.interface.quantities[i] {
                Quantity::Count(count) => i32::try_from(self.run.count(count)).unwrap_or(i32::MAX),
                _ => self.run.state.integers[i],
            };
        }
        Ok(())
    }

    /// Reads what the solver has counted, as far as it has counted.
    ///
    /// # Errors
    /// Variables that are no counters; not as many values as references.
    pub fn counts(&self, references: &[u32], values: &mut [u64]) -> Result<(), VariableError> {
        as_many(references.len(), values.len())?;
        for &reference in references {
            self.interface.counter(reference)?;
        }
        for (value, &reference) in values.iter_mut().zip(references) {
            *value = self.run.count(self.interface.counter(reference)?);
        }
        Ok(())
    }

    /// Derivatives of real inputs by time, for the next step only; all or none. A variable's description says which
    /// orders act; others are refused.
    ///
    /// A derivative takes the place of the input that would say the same: that of a position of its velocity, that of a
    /// velocity of its acceleration. One that is 0 does so, too.
    pub fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), VariableError> {
        as_many(references.len(), orders.len())?;
        as_many(references.len(), values.len())?;
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            self.interface.check_input_derivative(reference, order, value)?;
        }
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            self.run.state.input_rates[reference as usize][order as usize - 1] = Some(value);
        }
        Ok(())
    }

    /// The variable of a reference.
    ///
    /// # Errors
    /// [`VariableError::UnknownReference`].
    pub fn variable(&self, reference: u32) -> Result<&Variable, VariableError> {
        self.interface.variable(reference)
    }

    /// Notes that inputs or, if `model`, parameters have been set.
    fn note_set(&mut self, model: bool) {
        self.invalidate(match (model, self.run.state.started) {
            (true, _) => UpToDate::Nothing,
            (false, false) => UpToDate::Model,
            (false, true) => UpToDate::State,
        });
    }

    /// Reads strings.
    pub fn strings(&self, references: &[u32]) -> Result<Vec<String>, VariableError> {
        references.iter().map(|&reference| Ok(self.folder(reference)?.to_owned())).collect()
    }

    /// Sets strings; all or none; before `initialize`. Strings are no part of the state: a state that is restored
    /// elsewhere does not write into this host's folder.
    pub fn set_strings(&mut self, references: &[u32], values: &[&str]) -> Result<(), VariableError> {
        as_many(references.len(), values.len())?;
        for &reference in references {
            self.folder(reference)?;
            if self.run.state.started {
                return Err(not_settable(self.variable(reference)?, FIXED));
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
        match (&variable.kind, &self.run.recorder) {
            (Kind::Text { .. }, Some(recorder)) => Ok(&recorder.folder),
            _ => Err(wrong_type(variable, "String")),
        }
    }
}
