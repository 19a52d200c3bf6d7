//! Directional derivatives of outputs and state derivatives by inputs and continuous states, everything else as it is.

use super::states::Place;
use super::variables::ExchangeRole;
use crate::dynamics::parameters::Layout;
use crate::simulation::{Simulation, SimulationError, VariableError};

/// Row and column of a ring's slot: which ring, whether it is a velocity, which axis.
fn ring_slot(layout: &Layout, i: usize) -> Option<(usize, bool, usize)> {
    let of = |start: Option<usize>, ring| {
        start.filter(|&start| i >= start && i < start + 4).map(|start| (ring, i - start >= 2, (i - start) % 2))
    };
    of(layout.shaft, 0).or_else(|| of(layout.housing, 1))
}

impl Simulation {
    /// The change of `unknowns`, real outputs and state derivatives, for a change `seed` of `knowns`, real inputs and
    /// continuous states, by their references in Model Exchange.
    ///
    /// # Errors
    /// Variables of another kind; before `initialize`.
    pub fn exchange_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        values: &mut [f64],
    ) -> Result<(), SimulationError> {
        if !self.run.state.started {
            return Err(SimulationError::NotInitialized);
        }
        let rows = self.interface.table.len() as u32;
        let places: Vec<Place> = self.places().collect();
        let (of_table, of_states): (Vec<_>, Vec<_>) =
            knowns.iter().copied().zip(seed.iter().copied()).partition(|(known, _)| *known < rows);
        let (inputs, weights): (Vec<u32>, Vec<f64>) = of_table.into_iter().unzip();
        let outputs: Vec<u32> = unknowns.iter().copied().filter(|unknown| *unknown < rows).collect();
        for &output in &outputs {
            self.interface.unknown(output)?;
        }
        let acceleration = self.along_knowns(&inputs, &weights)?;
        for (known, weight) in of_states {
            match self.exchange_role(known) {
                Some(ExchangeRole::State(number)) => self.along_state(places[number], weight),
                _ => return Err(self.not_exchanged(known, false)),
            }
        }
        self.finish_change(&outputs, acceleration, self.present.excitation);
        for (value, &unknown) in values.iter_mut().zip(unknowns) {
            *value = if unknown < rows {
                self.changed(self.interface.quantities[unknown as usize])
            } else {
                match self.exchange_role(unknown) {
                    Some(ExchangeRole::Derivative(number)) => self.changed_rate(places[number]),
                    _ => return Err(self.not_exchanged(unknown, true)),
                }
            };
        }
        Ok(())
    }

    /// What a change of each of `knowns` adds to the sum of `unknowns` weighted by `seed`, as
    /// [`adjoint_derivative`](Self::adjoint_derivative).
    ///
    /// # Errors
    /// As [`exchange_derivative`](Self::exchange_derivative).
    pub fn exchange_adjoint(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        values: &mut [f64],
    ) -> Result<(), SimulationError> {
        self.left_product(Self::exchange_derivative, [unknowns, knowns], seed, values)
    }

    fn not_exchanged(&self, reference: u32, unknown: bool) -> SimulationError {
        let found = self.exchange_variables().into_iter().find(|variable| variable.reference == reference);
        match found {
            Some(variable) if unknown => VariableError::NotAnUnknown { name: variable.name }.into(),
            Some(variable) => VariableError::NotAKnown { name: variable.name }.into(),
            None => VariableError::UnknownReference(reference, self.interface.table.len() as u32 - 1).into(),
        }
    }

    /// Adds the change of a continuous state.
    fn along_state(&mut self, place: Place, by: f64) {
        let (layout, change) = (self.run.model.layout, &mut self.change);
        match place {
            Place::Cage => change.variation.cage_angle += by,
            Place::Frame(i) => change.variation.frames[i][0] += by,
            Place::Mode(i) => {
                let mut moved = vec![0.0; self.run.model.sensor_modes.state_len()];
                moved[i] = by;
                for (k, shown) in change.by_sensor_modes.iter_mut().enumerate().take(layout.sensor_count) {
                    *shown += self.run.model.sensor_modes.measured(k, 0.0, &moved);
                }
                change.modes[i] += by;
            }
            Place::Slot(i) if i < layout.radial_velocity => change.variation.path[i] += by,
            Place::Slot(i) if i < 2 * layout.radial_velocity => {
                change.variation.radial_velocity[i - layout.radial_velocity] += by;
            }
            Place::Slot(i) => match ring_slot(&layout, i) {
                Some((ring, true, axis)) => change.variation.rings[ring].velocity[axis] += by,
                Some((ring, false, axis)) => change.variation.rings[ring].position[axis] += by,
                None => {
                    if let Some(k) = layout.sensor_indices().position(|start| i == start || i == start + 1) {
                        change.sensors[k][usize::from(!layout.is_position(i))] += by;
                    }
                }
            },
        }
    }

    /// What the change makes of the derivative of a continuous state.
    fn changed_rate(&self, place: Place) -> f64 {
        let (layout, change) = (self.run.model.layout, &self.change);
        let variation = &change.variation;
        match place {
            Place::Cage => variation.cage_speed,
            Place::Frame(i) => variation.frames[i][1],
            Place::Mode(i) => {
                self.run.model.sensor_modes.slope(i, |sensor| change.sensor_accelerations[sensor], &change.modes)
            }
            Place::Slot(i) if i < layout.radial_velocity => change.forces.path_rate[i],
            Place::Slot(i) if i < 2 * layout.radial_velocity => {
                change.forces.radial_acceleration[i - layout.radial_velocity]
            }
            Place::Slot(i) => match ring_slot(&layout, i) {
                Some((ring, true, axis)) => change.accelerations[ring][axis],
                Some((ring, false, axis)) => variation.rings[ring].velocity[axis],
                None => {
                    let sensor = layout.sensor_indices().position(|start| i == start || i == start + 1);
                    sensor.map_or(0.0, |k| {
                        if layout.is_position(i) { change.sensors[k][1] } else { change.sensor_accelerations[k] }
                    })
                }
            },
        }
    }
}
