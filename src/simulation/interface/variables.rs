//! The variables of one scene by their references: what they stand for, and what may be asked of them. Nothing of a
//! run.

use super::quantity::{Count, Parameter, Quantity};
use super::value_access::{self, Access};
use super::{Inputs, dependencies, least_stiffness, table};
use crate::scene::{DegreesOfFreedom, Scene};
use crate::simulation::VariableError;
use crate::simulation::interface::table::{Causality, Dependencies, Kind, Variable};
use crate::surface::Surface;
use std::sync::Arc;

/// The variables of one scene; shared by clones, as all follows from the table.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Interface {
    pub(in crate::simulation) table: Arc<[Variable]>,
    pub(in crate::simulation) quantities: Arc<[Quantity]>,
    access: Arc<[Access]>,
    pub(in crate::simulation) inputs: Inputs,
    /// Stiffness (N/m) that a bearing is taken to have at least, where a step is suggested to its host.
    pub(in crate::simulation) least_stiffness: f64,
}

impl Interface {
    /// Those of a scene with these surfaces of its defects.
    pub(in crate::simulation) fn of(scene: &Scene, surfaces: &[Surface]) -> Self {
        let (table, quantities): (Vec<_>, Vec<_>) = table::rows(scene, surfaces).into_iter().unzip();
        let access = table.iter().zip(&quantities).map(|(row, &quantity)| Access::new(row, quantity)).collect();
        let count = table.iter().take_while(|v| v.causality == Causality::Input).count();
        let in_space = scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two;
        let axes = if in_space { 5 } else { 2 };
        let inputs = Inputs { frames: scene.turns() || in_space, axes, ..Inputs::new(&quantities, count) };
        let least_stiffness = inputs.repeated.map_or(0.0, |_| least_stiffness(&scene.bearing));
        Self { table: table.into(), quantities: quantities.into(), access, inputs, least_stiffness }
    }

    /// What each output depends on, in the order of the table.
    pub(in crate::simulation) fn dependencies(&self, scene: &Scene) -> Vec<Dependencies> {
        dependencies::of(&self.table, &self.quantities, scene)
    }

    /// Value reference of the variable of this name.
    pub(in crate::simulation) fn reference(&self, name: &str) -> Result<u32, VariableError> {
        let variable = self.table.iter().find(|variable| variable.name == name);
        variable.map(|variable| variable.reference).ok_or_else(|| VariableError::UnknownName { name: name.to_owned() })
    }

    /// The variable of a reference.
    pub(in crate::simulation) fn variable(&self, reference: u32) -> Result<&Variable, VariableError> {
        let last = self.table.len() as u32 - 1;
        self.table.get(reference as usize).ok_or(VariableError::UnknownReference(reference, last))
    }

    /// The variable, if it is a real output.
    pub(in crate::simulation) fn unknown(&self, reference: u32) -> Result<&Variable, VariableError> {
        let variable = self.variable(reference)?;
        if !matches!(variable.kind, Kind::Real { .. }) || variable.causality != Causality::Output {
            return Err(VariableError::NotAnUnknown { name: variable.name.clone() });
        }
        Ok(variable)
    }

    /// What a variable counts.
    pub(in crate::simulation) fn counter(&self, reference: u32) -> Result<Count, VariableError> {
        let variable = self.variable(reference)?;
        match self.quantities[reference as usize] {
            Quantity::Count(count) => Ok(count),
            _ => Err(wrong_type(variable, "UInt64")),
        }
    }

    /// All classes ([`value_access`]) of the references.
    ///
    /// # Errors
    /// For the first reference that is unknown or not real.
    #[inline]
    pub(in crate::simulation) fn classes(&self, references: &[u32]) -> Result<u8, VariableError> {
        value_access::classes(&self.access, references).ok_or_else(|| self.not_real(references))
    }

    /// Whether the variable of a known reference is a real output.
    #[inline]
    pub(in crate::simulation) fn is_output(&self, index: usize) -> bool {
        self.access[index].is(value_access::OUTPUT)
    }

    /// Value of a real variable of a known index that is no output, by those that are set.
    #[inline]
    pub(in crate::simulation) fn set_value(&self, index: usize, reals: &[f64]) -> f64 {
        if !self.access[index].is(value_access::HALF) {
            return reals[index];
        }
        let clearance = Quantity::Parameter(Parameter::InternalClearance);
        self.quantities.iter().position(|quantity| *quantity == clearance).map_or(0.0, |of| 0.5 * reals[of])
    }

    /// All classes of the references, if reals may be set to these values: inputs, and before the run has `started`
    /// parameters.
    ///
    /// # Errors
    /// For the first that may not.
    #[inline]
    pub(in crate::simulation) fn can_set(
        &self,
        references: &[u32],
        values: &[f64],
        started: bool,
    ) -> Result<u8, VariableError> {
        let writable = if started { value_access::INPUT } else { value_access::INPUT | value_access::PARAMETER };
        if let Some(classes) = value_access::can_set(&self.access, writable, references, values) {
            return Ok(classes);
        }
        let mut pairs = references.iter().zip(values);
        pairs.try_for_each(|(&reference, &value)| self.check_real(reference, value, started)).map(|()| 0)
    }

    fn check_real(&self, reference: u32, value: f64, started: bool) -> Result<(), VariableError> {
        let variable = self.variable(reference)?;
        let Kind::Real { min, max, .. } = variable.kind else { return Err(wrong_type(variable, "Real")) };
        match variable.causality {
            Causality::Output | Causality::Local => return Err(not_settable(variable, COMPUTED)),
            Causality::Parameter if started => return Err(not_settable(variable, FIXED)),
            _ => {}
        }
        let (min, max) = (min.unwrap_or(f64::MIN), max.unwrap_or(f64::MAX));
        if value >= min && value <= max { Ok(()) } else { Err(out_of_range(variable, value, min, max)) }
    }

    /// Refuses an integer that may not be set to this value.
    pub(in crate::simulation) fn check_integer(
        &self,
        reference: u32,
        value: i32,
        started: bool,
    ) -> Result<(), VariableError> {
        let variable = self.variable(reference)?;
        let (min, max) = match variable.kind {
            Kind::Enumeration { items, .. } => (1, items.len() as i32),
            Kind::Whole { .. } => (0, i32::MAX),
            Kind::Integer => return Err(not_settable(variable, COMPUTED)),
            _ => return Err(wrong_type(variable, "Integer")),
        };
        if started {
            return Err(not_settable(variable, FIXED));
        }
        if value < min || value > max {
            return Err(out_of_range(variable, value.into(), min.into(), max.into()));
        }
        Ok(())
    }

    /// Refuses a derivative by time of an input that does not act or has no value.
    pub(in crate::simulation) fn check_input_derivative(
        &self,
        reference: u32,
        order: i32,
        value: f64,
    ) -> Result<(), VariableError> {
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
}

/// Refuses a list of another length than that of the value references to which it belongs.
#[inline]
pub(in crate::simulation) fn as_many(references: usize, given: usize) -> Result<(), VariableError> {
    if given == references { Ok(()) } else { Err(VariableError::Lengths { references, given }) }
}

/// Why what is no input and no parameter cannot be set.
pub(in crate::simulation) const COMPUTED: &str = "it is computed";
/// Why a parameter cannot be set any more.
pub(in crate::simulation) const FIXED: &str = "parameters are fixed after initialization";

pub(in crate::simulation) fn wrong_type(variable: &Variable, wanted: &'static str) -> VariableError {
    VariableError::WrongType { name: variable.name.clone(), reference: variable.reference, wanted }
}

pub(in crate::simulation) fn not_settable(variable: &Variable, why: &'static str) -> VariableError {
    VariableError::NotSettable { name: variable.name.clone(), why }
}

pub(in crate::simulation) fn out_of_range(variable: &Variable, value: f64, min: f64, max: f64) -> VariableError {
    VariableError::OutOfRange { name: variable.name.clone(), value, min, max }
}
