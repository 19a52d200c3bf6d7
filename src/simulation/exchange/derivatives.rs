//! How continuous states and their derivatives change with inputs, parameters and states: what
//! [`Simulation::directional_derivative`] has of variables behind the table.

use super::part::{Derivative, Part};
use super::states::Place;
use super::variables::ExchangeRole;
use crate::simulation::{Simulation, VariableError};

impl Simulation {
    /// Refuses a reference behind the table that is no continuous state or derivative of one.
    pub(in crate::simulation) fn check_exchanged_unknown(&self, reference: u32) -> Result<(), VariableError> {
        match self.exchange_role(reference) {
            Some(ExchangeRole::State(_) | ExchangeRole::Derivative(_)) => Ok(()),
            role => Err(self.not_exchanged(reference, role, |name| VariableError::NotAnUnknown { name })),
        }
    }

    /// Refuses a reference behind the table that is no continuous state, or that the start decides on.
    pub(in crate::simulation) fn check_exchanged_known(&self, reference: u32) -> Result<(), VariableError> {
        match self.exchange_role(reference) {
            Some(ExchangeRole::State(_)) if self.run.state.started => Ok(()),
            role => Err(self.not_exchanged(reference, role, |name| VariableError::NotAKnown { name })),
        }
    }

    fn not_exchanged(
        &self,
        reference: u32,
        role: Option<ExchangeRole>,
        why: impl FnOnce(String) -> VariableError,
    ) -> VariableError {
        match role.and_then(|_| self.exchange_name(reference)) {
            Some(name) => why(name),
            None => VariableError::UnknownReference(reference, self.interface.table.len() as u32 - 1),
        }
    }

    /// Adds `by` times the change of a continuous state, known by its reference.
    pub(in crate::simulation) fn along_exchanged(&mut self, known: u32, by: f64) {
        let Some(ExchangeRole::State(number)) = self.exchange_role(known) else { return };
        let Some(place) = self.places().nth(number) else { return };
        let (layout, change) = (self.run.model.layout, &mut self.change);
        let variation = &mut change.variation;
        let i = match place {
            Place::Cage => return variation.cage_angle += by,
            Place::Frame(i) => return variation.frames[i][0] += by,
            Place::Mode(i) => {
                let mut moved = vec![0.0; self.run.model.sensor_modes.state_len()];
                moved[i] = by;
                for (k, shown) in change.by_sensor_modes.iter_mut().enumerate().take(layout.sensor_count) {
                    *shown += self.run.model.sensor_modes.measured(k, 0.0, &moved);
                }
                return change.modes[i] += by;
            }
            Place::Slot(i) => i,
        };
        use Derivative::{Position, Rate};
        match Part::of(&layout, i) {
            Some(Part::Radial(j, Position)) => variation.path[j] += by,
            Some(Part::Radial(j, Rate)) => variation.radial_velocity[j] += by,
            Some(Part::Axial(j, Position)) => variation.axial[j] += by,
            Some(Part::Axial(j, Rate)) => variation.axial_velocity[j] += by,
            Some(Part::Ring(ring, axis, Position)) => variation.rings[ring].position[axis] += by,
            Some(Part::Ring(ring, axis, Rate)) => variation.rings[ring].velocity[axis] += by,
            Some(Part::Sensor(k, of)) => change.sensors[k][usize::from(of == Rate)] += by,
            None => {}
        }
    }

    /// What the change makes of a variable behind the table.
    pub(in crate::simulation) fn exchanged_change(&self, unknown: u32) -> f64 {
        let (rate, number) = match self.exchange_role(unknown) {
            Some(ExchangeRole::State(number)) => (false, number),
            Some(ExchangeRole::Derivative(number)) => (true, number),
            _ => return 0.0,
        };
        let place = self.places().nth(number);
        place.map_or(0.0, |place| if rate { self.changed_rate(place) } else { self.changed_state(place) })
    }

    fn changed_state(&self, place: Place) -> f64 {
        let (change, variation) = (&self.change, &self.change.variation);
        let i = match place {
            Place::Cage => return variation.cage_angle,
            Place::Frame(i) => return variation.frames[i][0],
            Place::Mode(i) => return change.modes[i],
            Place::Slot(i) => i,
        };
        use Derivative::{Position, Rate};
        match Part::of(&self.run.model.layout, i) {
            Some(Part::Radial(j, Position)) => variation.path[j],
            Some(Part::Radial(j, Rate)) => variation.radial_velocity[j],
            Some(Part::Axial(j, Position)) => variation.axial[j],
            Some(Part::Axial(j, Rate)) => variation.axial_velocity[j],
            Some(Part::Ring(ring, axis, Position)) => variation.rings[ring].position[axis],
            Some(Part::Ring(ring, axis, Rate)) => variation.rings[ring].velocity[axis],
            // At rest a sensor is where the housing takes it.
            Some(Part::Sensor(k, Position)) if !self.run.state.started => {
                let along = self.setup.scene.sensors[k].unit_in_space();
                along.iter().zip(variation.rings[1].position).map(|(part, moved)| part * moved).sum()
            }
            Some(Part::Sensor(k, of)) => change.sensors[k][usize::from(of == Rate)],
            None => 0.0,
        }
    }

    fn changed_rate(&self, place: Place) -> f64 {
        let (change, variation) = (&self.change, &self.change.variation);
        let modes = &self.run.model.sensor_modes;
        let i = match place {
            Place::Cage => return variation.cage_speed,
            Place::Frame(i) => return variation.frames[i][1],
            Place::Mode(i) => return modes.slope(i, |sensor| change.sensor_accelerations[sensor], &change.modes),
            Place::Slot(i) => i,
        };
        use Derivative::{Position, Rate};
        match Part::of(&self.run.model.layout, i) {
            Some(Part::Radial(j, Position)) => change.forces.path_rate[j],
            Some(Part::Radial(j, Rate)) => change.forces.radial_acceleration[j],
            Some(Part::Axial(j, Position)) => change.forces.axial_rate[j],
            Some(Part::Axial(j, Rate)) => change.forces.axial_acceleration[j],
            Some(Part::Ring(ring, axis, Position)) => variation.rings[ring].velocity[axis],
            Some(Part::Ring(ring, axis, Rate)) => change.accelerations[ring][axis],
            Some(Part::Sensor(k, Position)) => change.sensors[k][1],
            Some(Part::Sensor(k, Rate)) => change.sensor_accelerations[k],
            None => 0.0,
        }
    }
}
