//! The variables that only Model Exchange has: each continuous state, its derivative, each event indicator.
//!
//! They stand behind the variable table: their references begin one after it, which leaves one for the time of FMI 3.0.

use super::states::Place;
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
    /// Unit; `None` for the derivative of what has none of the table.
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
        let Some(role) = self.exchange_role(reference) else { return Ok(None) };
        let (count, number) = match role {
            ExchangeRole::State(number) | ExchangeRole::Derivative(number) => (self.continuous_state_count(), number),
            ExchangeRole::Indicator(number) => (self.event_indicator_count(), number),
        };
        let mut values = vec![0.0; count];
        match role {
            ExchangeRole::State(_) => self.continuous_states(&mut values)?,
            ExchangeRole::Derivative(_) => self.state_derivatives(&mut values)?,
            ExchangeRole::Indicator(_) => self.event_indicators(&mut values)?,
        }
        Ok(Some(values[number]))
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
                _ => (Unit::RadianPerSecond, 100.0),
            };
            let role = ExchangeRole::Derivative(number);
            push(format!("der(state.{name})"), format!("Derivative by time of the state: {what}"), role, unit, nominal);
        }
        let count = self.run.model.element_count;
        for number in 0..self.event_indicator_count() {
            let (name, what, unit, nominal) = if number < 2 * count {
                let (j, side) = (number % count + 1, ["inner", "outer"][number / count]);
                let what = format!("approach of element {j} and the {side} raceway; 0 where the contact begins");
                (format!("element[{j}].{side}_contact"), what, Unit::Metre, 1e-6)
            } else {
                let k = number - 2 * count + 1;
                (
                    format!("cell[{k}]"),
                    format!("angle that contact {k} has left to the end of its part of a defect"),
                    Unit::Radian,
                    1e-2,
                )
            };
            let role = ExchangeRole::Indicator(number);
            push(format!("event.{name}"), format!("Event indicator: {what}"), role, unit, nominal);
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
        let unit = if layout.is_position(i) { Unit::Metre } else { Unit::MetrePerSecond };
        let w = layout.radial_velocity;
        let (name, what) = if i < w {
            (format!("element[{}].path", i + 1), format!("radial path of element {}", i + 1))
        } else if i < 2 * w {
            let j = i - w + 1;
            (format!("element[{j}].radial_velocity"), format!("absolute radial velocity of element {j}"))
        } else if let Some(k) = layout.sensor_indices().position(|start| i == start || i == start + 1) {
            let what = if layout.is_position(i) { "displacement" } else { "velocity" };
            (format!("sensor[{}].{what}", k + 1), format!("{what} of sensor {} along its direction", k + 1))
        } else {
            let name = layout.name(i);
            let what = format!("{name} of the equations of motion");
            (name, what)
        };
        (name, what, unit)
    }
}
