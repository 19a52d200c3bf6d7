//! The variables' values, set and read by value reference.

use super::life::{Simulation, UpToDate};
use super::state::Ended;
use crate::simulation::interface::table::{Causality, Kind, Variable};
use crate::simulation::interface::{Count, Quantity, value_access};
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
            Kind::Text { .. } => not_real("String", "set_strings"),
        }
    }

    /// Sets reals, a value for each reference; all or none. Inputs at any time, parameters before `initialize`.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), VariableError> {
        as_many(references.len(), values.len())?;
        let writable =
            if self.state.started { value_access::INPUT } else { value_access::INPUT | value_access::PARAMETER };
        let Some(classes) = value_access::can_set(&self.access, writable, references, values) else {
            return references
                .iter()
                .zip(values)
                .try_for_each(|(&reference, &value)| self.check_real(reference, value));
        };
        for (&reference, &value) in references.iter().zip(values) {
            self.state.reals[reference as usize] = value;
        }
        if classes & value_access::INPUT != 0 {
            self.state.ended = Ended::default();
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
        let Some(index) = self.inputs.tolerance.filter(|&index| tolerance < self.state.reals[index]) else {
            return Ok(());
        };
        let least = match self.table[index].kind {
            Kind::Real { min: Some(min), .. } => min,
            _ => 0.0,
        };
        self.set_reals(&[index as u32], &[tolerance.max(least)])
    }

    /// Reads reals, one for each place in `values`. Outputs are computed if something has changed since they were last.
    pub fn reals(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), SimulationError> {
        as_many(references.len(), values.len())?;
        let Some(classes) = value_access::classes(&self.access, references) else {
            return Err(self.not_real(references).into());
        };
        if classes & value_access::AHEAD != 0 {
            self.look_ahead()?;
        }
        if classes & value_access::OUTPUT != 0 {
            self.refresh()?;
        }
        if classes & value_access::STIFFNESS != 0 {
            self.refresh_stiffness();
        }
        for (value, &reference) in values.iter_mut().zip(references) {
            *value = self.state.reals[reference as usize];
        }
        Ok(())
    }

    /// Sets integers (the enumeration `contact.law`); all or none; before `initialize`.
    pub fn set_integers(&mut self, references: &[u32], values: &[i32]) -> Result<(), VariableError> {
        as_many(references.len(), values.len())?;
        for (&reference, &value) in references.iter().zip(values) {
            let variable = self.variable(reference)?;
            let Kind::Enumeration { items, .. } = variable.kind else {
                if variable.kind == Kind::Integer {
                    return Err(not_settable(variable, COMPUTED));
                }
                return Err(wrong_type(variable, "Integer"));
            };
            if self.state.started {
                return Err(not_settable(variable, "parameters are fixed after initialization"));
            }
            if value < 1 || value as usize > items.len() {
                return Err(VariableError::OutOfRange {
                    name: variable.name.clone(),
                    value: value.into(),
                    min: 1.0,
                    max: items.len() as f64,
                });
            }
        }
        for (&reference, &value) in references.iter().zip(values) {
            self.state.integers[reference as usize] = value;
        }
        self.note_set(!references.is_empty());
        Ok(())
    }

    /// Reads integers and enumerations.
    pub fn integers(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), SimulationError> {
        as_many(references.len(), values.len())?;
        let mut outputs = false;
        for &reference in references {
            let variable = self.variable(reference)?;
            if !matches!(variable.kind, Kind::Integer | Kind::Enumeration { .. }) {
                return Err(wrong_type(variable, "Integer").into());
            }
            outputs |= variable.kind == Kind::Integer;
        }
        if outputs {
            self.refresh()?;
        }
        for (value, &reference) in values.iter_mut().zip(references) {
            *value = self.state.integers[reference as usize];
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
            self.counter(reference)?;
        }
        let solves_grids = self.model.solves_grids();
        for (value, &reference) in values.iter_mut().zip(references) {
            *value = self.state.progress.count(self.counter(reference)?, solves_grids);
        }
        Ok(())
    }

    fn counter(&self, reference: u32) -> Result<Count, VariableError> {
        let variable = self.variable(reference)?;
        match self.quantities[reference as usize] {
            Quantity::Count(count) => Ok(count),
            _ => Err(wrong_type(variable, "UInt64")),
        }
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
            let variable = self.variable(reference)?;
            let name = || variable.name.clone();
            if variable.causality != Causality::Input || order < 1 {
                return Err(VariableError::Derivative { name: name(), order });
            }
            let highest = self.quantities[reference as usize].as_input().map_or(0, |input| input.derivatives().0);
            if order > highest {
                return Err(VariableError::UnusedDerivative { name: name(), order, highest });
            }
            if !value.is_finite() {
                return Err(out_of_range(variable, value, f64::MIN, f64::MAX));
            }
        }
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            self.state.input_rates[reference as usize][order as usize - 1] = Some(value);
        }
        Ok(())
    }

    /// The error for the first reference that is unknown or not real.
    fn not_real(&self, references: &[u32]) -> VariableError {
        let error = |&reference: &u32| match self.variable(reference) {
            Ok(variable) if matches!(variable.kind, Kind::Real { .. }) => None,
            Ok(variable) => Some(wrong_type(variable, "Real")),
            Err(error) => Some(error),
        };
        let last = self.table.len() as u32 - 1;
        references.iter().find_map(error).unwrap_or(VariableError::UnknownReference(u32::MAX, last))
    }

    fn check_real(&self, reference: u32, value: f64) -> Result<(), VariableError> {
        let variable = self.variable(reference)?;
        let Kind::Real { min, max, .. } = variable.kind else { return Err(wrong_type(variable, "Real")) };
        match variable.causality {
            Causality::Output | Causality::Local => return Err(not_settable(variable, COMPUTED)),
            Causality::Parameter if self.state.started => {
                return Err(not_settable(variable, "parameters are fixed after initialization"));
            }
            _ => {}
        }
        let (min, max) = (min.unwrap_or(f64::MIN), max.unwrap_or(f64::MAX));
        if value >= min && value <= max { Ok(()) } else { Err(out_of_range(variable, value, min, max)) }
    }

    /// The variable of a reference.
    ///
    /// # Errors
    /// [`VariableError::UnknownReference`].
    pub fn variable(&self, reference: u32) -> Result<&Variable, VariableError> {
        self.table
            .get(reference as usize)
            .ok_or_else(|| VariableError::UnknownReference(reference, self.table.len() as u32 - 1))
    }

    /// Notes that inputs or, if `model`, parameters have been set.
    fn note_set(&mut self, model: bool) {
        self.invalidate(match (model, self.state.started) {
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

/// Refuses a list of another length than that of the value references to which it belongs.
#[inline]
pub(super) fn as_many(references: usize, given: usize) -> Result<(), VariableError> {
    if given == references { Ok(()) } else { Err(VariableError::Lengths { references, given }) }
}

/// Why what is no input and no parameter cannot be set.
const COMPUTED: &str = "it is computed";

pub(super) fn wrong_type(variable: &Variable, wanted: &'static str) -> VariableError {
    VariableError::WrongType { name: variable.name.clone(), reference: variable.reference, wanted }
}

fn not_settable(variable: &Variable, why: &'static str) -> VariableError {
    VariableError::NotSettable { name: variable.name.clone(), why }
}

pub(super) fn out_of_range(variable: &Variable, value: f64, min: f64, max: f64) -> VariableError {
    VariableError::OutOfRange { name: variable.name.clone(), value, min, max }
}
