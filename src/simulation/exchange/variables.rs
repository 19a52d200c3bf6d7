//! The variables that only Model Exchange has: each continuous state, its derivative, each event indicator.
//!
//! They stand behind the variable table: their references begin one after it, which leaves one for the time of FMI 3.0.

use super::part::{Derivative, Part};
use super::states::Place;
use crate::simulation::interface::as_many;
use crate::simulation::interface::table::Unit;
use crate::simulation::{Simulation, SimulationError};

/// What a variable of Model Exchange is, with its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExchangeRole {
    /// A continuous state.
    State(usize),
    /// The derivative of one.
    Derivative(usize),
    /// An event indicator.
    Indicator(usize),
}

/// A variable that only Model Exchange has.
#[derive(Debug, Clone, PartialEq)]
pub struct ExchangeVariable {
    /// Name, as in `state.shaft.x` and `der(state.shaft.x)`.
    pub name: String,
    /// One line for the reader.
    pub description: String,
    /// Value reference.
    pub reference: u32,
    /// What it is.
    pub role: ExchangeRole,
    /// Unit.
    pub unit: Unit,
    /// Order of magnitude.
    pub nominal: f64,
}

impl Simulation {
    /// The first reference behind the table and the time.
    fn first_exchanged(&self) -> u32 {
        self.interface.table.len() as u32 + 1
    }

    /// What a reference behind the table stands for.
    pub fn exchange_role(&self, reference: u32) -> Option<ExchangeRole> {
        let states = self.continuous_state_count();
        let number = reference.checked_sub(self.first_exchanged())? as usize;
        match number {
            _ if number < states => Some(ExchangeRole::State(number)),
            _ if number < 2 * states => Some(ExchangeRole::Derivative(number - states)),
            _ if number < 2 * states + self.event_indicator_count() => {
                Some(ExchangeRole::Indicator(number - 2 * states))
            }
            _ => None,
        }
    }

    /// Value of a variable behind the table; `None` if it is none.
    ///
    /// # Errors
    /// As of [`state_derivatives`](Self::state_derivatives).
    pub fn exchange_value(&mut self, reference: u32) -> Result<Option<f64>, SimulationError> {
        let mut value = [0.0];
        match self.exchange_role(reference) {
            None => Ok(None),
            Some(_) => self.exchange_reals(&[reference], &mut value).map(|()| Some(value[0])),
        }
    }

    /// Reads reals of the table and behind it, one for each place in `values`.
    ///
    /// # Errors
    /// As of [`reals`](Self::reals) and [`exchange_value`](Self::exchange_value).
    pub fn exchange_reals(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), SimulationError> {
        let rows = self.interface.table.len();
        if references.iter().all(|&reference| (reference as usize) < rows) {
            return self.reals(references, values);
        }
        as_many(references.len(), values.len())?;
        let [mut states, mut derivatives, mut indicators] = [const { Vec::new() }; 3];
        for (value, &reference) in values.iter_mut().zip(references) {
            // Each list is filled for the first that is in it.
            *value = match self.exchange_role(reference) {
                Some(ExchangeRole::State(number)) => {
                    if states.is_empty() {
                        states = vec![0.0; self.continuous_state_count()];
                        self.continuous_states(&mut states)?;
                    }
                    states[number]
                }
                Some(ExchangeRole::Derivative(number)) => {
                    if derivatives.is_empty() {
                        derivatives = vec![0.0; self.continuous_state_count()];
                        self.state_derivatives(&mut derivatives)?;
                    }
                    derivatives[number]
                }
                Some(ExchangeRole::Indicator(number)) => {
                    if indicators.is_empty() {
                        indicators = vec![0.0; self.event_indicator_count()];
                        self.event_indicators(&mut indicators)?;
                    }
                    indicators[number]
                }
                None => {
                    self.reals(&[reference], std::slice::from_mut(value))?;
                    continue;
                }
            };
        }
        Ok(())
    }

    /// Name of a variable behind the table; `None` if it is none.
    pub fn exchange_name(&self, reference: u32) -> Option<String> {
        let found = self.exchange_variables().into_iter().find(|variable| variable.reference == reference);
        found.map(|variable| variable.name)
    }

    /// All variables that only Model Exchange has, by reference: states, their derivatives, indicators.
    pub fn exchange_variables(&self) -> Vec<ExchangeVariable> {
        let states: Vec<_> = self.places().map(|place| (self.described(place), self.nominal(place))).collect();
        let mut variables = Vec::new();
        let mut push = |name, description, role, unit, nominal| {
            let reference = self.first_exchanged() + variables.len() as u32;
            variables.push(ExchangeVariable { name, description, reference, role, unit, nominal });
        };
        for (number, ((name, what, unit), nominal)) in states.iter().enumerate() {
            push(format!("state.{name}"), format!("State: {what}"), ExchangeRole::State(number), *unit, *nominal);
        }
        for (number, ((name, what, unit), _)) in states.iter().enumerate() {
            let (unit, nominal) = match unit {
                Unit::Metre => (Unit::MetrePerSecond, 1e-2),
                Unit::MetrePerSecond => (Unit::MetrePerSecondSquared, 10.0),
                Unit::RadianPerSecond => (Unit::RadianPerSecondSquared, 1000.0),
                _ => (Unit::RadianPerSecond, 100.0),
            };
            let role = ExchangeRole::Derivative(number);
            push(format!("der(state.{name})"), format!("Derivative by time of the state: {what}"), role, unit, nominal);
        }
        let count = self.run.model.element_count;
        for number in 0..self.event_indicator_count() {
            let (name, what) = if number < 2 * count {
                let (j, side) = (number % count + 1, ["inner", "outer"][number / count]);
                let what = format!("approach of element {j} and the {side} raceway in µm; 0 where the contact begins");
                (format!("element[{j}].{side}_contact"), what)
            } else {
                let k = number - 2 * count + 1;
                (
                    format!("cell[{k}]"),
                    format!("angle in 0.01 rad that contact {k} has left to the end of its part of a defect"),
                )
            };
            let role = ExchangeRole::Indicator(number);
            push(format!("event.{name}"), format!("Event indicator: {what}"), role, Unit::One, 1.0);
        }
        variables
    }

    /// Name, meaning and unit of a continuous state.
    fn described(&self, place: Place) -> (String, String, Unit) {
        let layout = &self.run.model.layout;
        let i = match place {
            Place::Cage => return ("cage.angle".to_owned(), "angle of the nominal cage".to_owned(), Unit::Radian),
            Place::Frame(i) => {
                let (name, what) = [("shaft", "inner ring"), ("housing", "outer ring"), ("spin", "elements' spin")][i];
                return (format!("{name}.angle"), format!("angle of the {what}"), Unit::Radian);
            }
            Place::Mode(i) => {
                let (name, what, unit) =
                    [("displacement", "displacement", Unit::Metre), ("velocity", "velocity", Unit::MetrePerSecond)]
                        [i % 2];
                let number = i / 2 + 1;
                return (format!("mode[{number}].{name}"), format!("{what} of mode {number} under the sensors"), unit);
            }
            Place::Slot(i) => i,
        };
        let of = |tilts, of| match (tilts, of) {
            (false, Derivative::Position) => Unit::Metre,
            (false, Derivative::Rate) => Unit::MetrePerSecond,
            (true, Derivative::Position) => Unit::Radian,
            (true, Derivative::Rate) => Unit::RadianPerSecond,
        };
        let element = |j: usize, names: [&str; 2], whats: [&str; 2], rate: Derivative| {
            let [name, what] = [names, whats].map(|two| two[usize::from(rate == Derivative::Rate)]);
            (format!("element[{}].{name}", j + 1), format!("{what} of element {}", j + 1), of(false, rate))
        };
        match Part::of(layout, i) {
            Some(Part::Radial(j, rate)) => {
                element(j, ["path", "radial_velocity"], ["radial path", "absolute radial velocity"], rate)
            }
            Some(Part::Axial(j, rate)) => {
                element(j, ["axial", "axial_velocity"], ["axial position", "axial velocity"], rate)
            }
            Some(Part::Sensor(k, rate)) => {
                let what = ["displacement", "velocity"][usize::from(rate == Derivative::Rate)];
                let text = format!("{what} of sensor {} along its direction", k + 1);
                (format!("sensor[{}].{what}", k + 1), text, of(false, rate))
            }
            Some(Part::Ring(_, axis, rate)) => {
                let name = layout.name(i);
                let what = format!("{name} of the equations of motion");
                (name, what, of(axis > 2, rate))
            }
            None => (String::new(), String::new(), Unit::One),
        }
    }
}
