//! Values, derivatives and Model Exchange: what both versions' functions for them do with an instance.

use super::failure::Failure;
use super::life::Instance;
use super::mode::{Function, Mode, Modes, Version};
use crate::c_interface::ValueReference;
use brinell::simulation::exchange::ExchangeRole;
use brinell::simulation::{Simulation, SimulationError, VariableError};

/// Why not, in FMI 3.0.
const ONLY_CO_SIMULATION: &str = "is for co-simulation: step it with fmi3DoStep; it has no event mode, as \
     modelDescription.xml says with hasEventMode=\"false\"";

/// A list of the host's that has one place for each of something.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PerItem {
    States,
    Derivatives,
    Nominals,
    Indicators,
}

impl Instance {
    /// Refuses a function of Model Exchange in an instance for co-simulation, and out of the modes that it is for.
    pub(crate) fn exchanges(&self, function: &'static Function, within: &'static Modes) -> Result<(), Failure> {
        match (self.exchange, function.version) {
            (false, Version::Fmi2) => Err(Failure::ModelExchange),
            (false, Version::Fmi3) => Err(Failure::NotProvided(ONLY_CO_SIMULATION)),
            (true, _) if within.contains(self.mode) => Ok(()),
            (true, _) => Err(Failure::OutOfMode { mode: self.mode, function }),
        }
    }

    /// Reads reals of the table, and behind it if the FMU lists them.
    #[inline]
    pub(crate) fn reals(&mut self, references: &[ValueReference], values: &mut [f64]) -> Result<(), Failure> {
        if self.lists_exchange {
            let of_kind = if self.exchange { in_a_trial } else { Failure::from };
            return self.simulation.exchange_reals(references, values).map_err(of_kind);
        }
        Ok(self.simulation.reals(references, values)?)
    }

    /// Fills one of the lists.
    pub(crate) fn fill(&mut self, list: PerItem, values: &mut [f64]) -> Result<(), Failure> {
        let needed = self.count_of(list);
        if values.len() != needed {
            return Err(Failure::ValueCount { name: "nx", given: values.len(), needed });
        }
        let simulation = &mut self.simulation;
        match list {
            PerItem::States => simulation.continuous_states(values)?,
            PerItem::Derivatives => simulation.state_derivatives(values).map_err(in_a_trial)?,
            PerItem::Indicators => simulation.event_indicators(values)?,
            PerItem::Nominals => simulation.state_nominals(values),
        }
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(index) => Err(Failure::Trial(format!("number {} of {list:?} is {}", index + 1, values[index]))),
        }
    }

    /// Number of places in one of the lists.
    pub(crate) fn count_of(&self, list: PerItem) -> usize {
        match list {
            PerItem::Indicators => self.simulation.event_indicator_count(),
            PerItem::States | PerItem::Derivatives | PerItem::Nominals => self.simulation.continuous_state_count(),
        }
    }

    /// Sets the continuous states.
    pub(crate) fn set_states(&mut self, values: &[f64]) -> Result<(), Failure> {
        let needed = self.count_of(PerItem::States);
        if values.len() != needed {
            return Err(Failure::ValueCount { name: "nx", given: values.len(), needed });
        }
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            return Err(Failure::Trial(format!("state number {} is {}", index + 1, values[index])));
        }
        self.simulation.set_continuous_states(values);
        Ok(())
    }

    /// Sets the time.
    pub(crate) fn set_time(&mut self, time: f64) -> Result<(), Failure> {
        let clock = self.clock.as_mut().ok_or(Failure::NotSetUp)?;
        clock.move_to(time)?;
        self.simulation.set_time(time);
        Ok(())
    }

    /// Takes the states as they are, at this time.
    pub(crate) fn accept_states(&mut self) -> Result<(), Failure> {
        self.clock.ok_or(Failure::NotSetUp)?.check_taken()?;
        Ok(self.simulation.accept_states()?)
    }

    /// Handles an event, after which nothing is left to be iterated.
    pub(crate) fn handle_event(&mut self) -> Result<(), Failure> {
        self.simulation.handle_event()?;
        Ok(())
    }

    /// Sets reals as FMI 2.0 has it: of continuous-time mode continuous states as well (3.2.3, note 5).
    #[inline]
    pub(crate) fn set_reals(&mut self, references: &[ValueReference], values: &[f64]) -> Result<(), Failure> {
        let rows = self.simulation.table().len();
        if self.mode != Mode::ContinuousTime || references.iter().all(|&reference| (reference as usize) < rows) {
            return Ok(self.simulation.set_reals(references, values)?);
        }
        let mut states = vec![0.0; self.count_of(PerItem::States)];
        self.simulation.continuous_states(&mut states)?;
        let (mut of_table, mut reals) = (Vec::new(), Vec::new());
        for (&reference, &value) in references.iter().zip(values) {
            match self.simulation.exchange_role(reference) {
                Some(ExchangeRole::State(number)) => states[number] = value,
                _ => (of_table.push(reference), reals.push(value)).1,
            }
        }
        // All or none: what is refused is so before anything is set.
        if let Some(index) = states.iter().position(|value| !value.is_finite()) {
            return Err(Failure::Trial(format!("state number {} is {}", index + 1, states[index])));
        }
        self.simulation.set_reals(&of_table, &reals)?;
        self.simulation.set_continuous_states(&states);
        Ok(())
    }

    /// Refuses references behind the table unless the FMU lists what they stand for.
    pub(crate) fn check_listed(&self, references: &[ValueReference]) -> Result<(), Failure> {
        let rows = self.simulation.table().len();
        match references.iter().find(|&&reference| !self.lists_exchange && reference as usize >= rows) {
            None => Ok(()),
            Some(&reference) => Err(VariableError::UnknownReference(reference, rows as u32 - 1).into()),
        }
    }
}

/// Value of a variable behind the table.
pub(crate) fn value(simulation: &mut Simulation, reference: ValueReference) -> Result<f64, Failure> {
    let found = simulation.exchange_value(reference).map_err(in_a_trial)?;
    found.ok_or(Failure::UnknownReference(reference))
}

/// A state without an answer is what an integrator tries and takes back.
fn in_a_trial(error: SimulationError) -> Failure {
    match error {
        SimulationError::Step { cause, .. } => Failure::Trial(cause.to_string()),
        other => other.into(),
    }
}
