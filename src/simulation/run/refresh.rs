//! Outputs are computed when somebody reads them.

use super::life::{Simulation, UpToDate};
use crate::dynamics::parameters::{Layout, force_slot};
use crate::simulation::error::SimulationError;
use crate::simulation::interface::{Outputs, Quantity, Solution};

impl Simulation {
    /// Computes all outputs but the stiffness, unless they are still those of the values set.
    pub(in crate::simulation) fn refresh(&mut self) -> Result<(), SimulationError> {
        if self.up_to_date >= UpToDate::Outputs {
            return Ok(());
        }
        if !self.state.started && self.up_to_date < UpToDate::State {
            self.find_equilibrium()?;
        }
        let excitation = self.excitation(false);
        self.evaluate(&excitation);
        if !self.state.started {
            self.rest();
        }
        let progress = &self.state.progress;
        let solution = Solution {
            excitation: &excitation,
            tau: 0.0,
            state: &progress.state,
            derivative: &self.derivative,
            sensor_modes: &progress.sensor_modes,
        };
        let outputs = Outputs::new(&self.model, solution, &self.forces, self.state.angles());
        self.present_acceleration = outputs.housing_acceleration();
        let solves_grids = self.model.solves_grids();
        for (i, quantity) in self.quantities.iter().enumerate().skip(self.inputs.count) {
            let value = match *quantity {
                Quantity::MeanForce(ring, axis) => Some(progress.mean_force[force_slot(ring.index(), axis)]),
                Quantity::Count(count) => {
                    let count = progress.count(count, solves_grids);
                    self.state.integers[i] = i32::try_from(count).unwrap_or(i32::MAX);
                    None
                }
                other => outputs.value(other),
            };
            if let Some(value) = value {
                self.state.reals[i] = value;
            }
        }
        self.up_to_date = UpToDate::Outputs;
        Ok(())
    }

    /// The start is a static equilibrium: what rounding leaves of accelerations is none.
    fn rest(&mut self) {
        let layout = &self.model.layout;
        for start in [layout.shaft, layout.housing].into_iter().flatten() {
            for slot in Layout::VELOCITIES.into_iter().take(layout.freedom.count()) {
                self.derivative[start + slot] = 0.0;
            }
        }
        for i in layout.sensor_indices() {
            self.derivative[i + 1] = 0.0;
        }
    }

    /// Computes the tangent stiffness of the inner ring, −∂F/∂x with the elements in static balance (N/m).
    pub(in crate::simulation) fn refresh_stiffness(&mut self) {
        if self.up_to_date < UpToDate::Stiffness {
            let excitation = self.excitation(false);
            let progress = &self.state.progress;
            let now = self.model.kinematics(&excitation, 0.0, &progress.state);
            let cells = &progress.cells;
            let paths = self.forces.contacts.paths(&self.model, &progress.state);
            if let Some(stiffness) = self.model.stiffness_in_space(
                &excitation,
                (cells, &progress.state),
                &self.forces.contacts,
                &mut self.forces.shortcuts,
            ) {
                for (value, quantity) in self.state.reals.iter_mut().zip(self.quantities.iter()) {
                    if let Quantity::Stiffness(row, column) = *quantity {
                        *value = stiffness[row][column];
                    }
                }
                self.up_to_date = UpToDate::Stiffness;
                return;
            }
            let jacobian = self.model.ring_jacobian(paths, cells, &now, &mut self.forces.shortcuts);
            for (value, quantity) in self.state.reals.iter_mut().zip(self.quantities.iter()) {
                if let Quantity::Stiffness(row, column) = *quantity {
                    *value = -jacobian[(row, column)];
                }
            }
            self.up_to_date = UpToDate::Stiffness;
        }
    }
}
