//! Outputs, computed when somebody reads them.

use super::table::{Quantity, RingName};
use super::{Simulation, SimulationError};
use crate::dynamics::forces::RingState;

impl Simulation {
    /// Computes all outputs but the stiffness.
    pub(super) fn refresh(&mut self) -> Result<(), SimulationError> {
        if !self.state.started && self.equilibrium_is_stale {
            self.find_equilibrium()?;
        }
        let drive = self.drive(false);
        let progress = &self.state.progress;
        // Outputs must not depend on what was computed before, or a restored state would show other roundings.
        self.model.forget_contacts();
        self.model.derivative(&drive, 0.0, &progress.cells, &progress.state, &mut self.derivative, &mut self.forces);
        if !self.state.started {
            self.rest();
        }
        let progress = &self.state.progress;
        let shaft = self.model.shaft_state(&drive, 0.0, &progress.state);
        let housing = self.model.housing_state(&drive, 0.0, &progress.state);
        let acceleration = [
            self.acceleration(self.model.layout.shaft, drive.shaft.map(|q| q.0[2])),
            self.acceleration(self.model.layout.housing, drive.housing.map(|q| q.0[2])),
        ];
        self.present_acceleration = acceleration[1];
        let torque = self.model.cage_torque(&drive, 0.0, &progress.state, acceleration[1], &self.forces);
        let sensor = self.model.layout.sensor.map_or(0.0, |i| self.derivative[i + 1]);
        let cage_angle = self.state.cage.total();
        let forces = &self.forces;
        let ring = |name: RingName| -> (&RingState, usize) {
            match name {
                RingName::Shaft => (&shaft, 0),
                RingName::Housing => (&housing, 1),
            }
        };
        let solves_grids = self.model.defect.as_ref().is_some_and(|(near, _)| near.solves_grids());
        let ring_force = [forces.shaft, forces.housing];
        let first = self.inputs.count;
        for (i, quantity) in self.quantities.iter().enumerate().skip(first) {
            self.values[i] = match *quantity {
                Quantity::Position(name, axis) => ring(name).0.position[axis],
                Quantity::Velocity(name, axis) => ring(name).0.velocity[axis],
                Quantity::Acceleration(name, axis) => acceleration[ring(name).1][axis],
                Quantity::Force(name, axis) => ring_force[ring(name).1][axis],
                Quantity::MeanForce(name, axis) => progress.mean_force[2 * ring(name).1 + axis],
                Quantity::SensorAcceleration => sensor,
                Quantity::CageAngle => cage_angle,
                Quantity::CageSpeed => drive.cage.0[1],
                Quantity::CageTorque => torque,
                Quantity::ElementAngle(j) => cage_angle + self.model.element_offset(j),
                Quantity::ElementPath(j) => progress.state[j],
                Quantity::ElementInnerForce(j) => forces.inner[j],
                Quantity::ElementOuterForce(j) => forces.outer[j],
                _ => continue,
            };
        }
        for (i, quantity) in self.quantities.iter().enumerate().skip(first) {
            let count = match *quantity {
                Quantity::Steps => progress.steps,
                Quantity::RejectedSteps => progress.rejected_steps,
                Quantity::MapLookups if !solves_grids => progress.defect_lookups,
                Quantity::ContactSolves if solves_grids => progress.defect_lookups,
                Quantity::MapLookups | Quantity::ContactSolves => 0,
                _ => continue,
            };
            self.integers[i] = i32::try_from(count).unwrap_or(i32::MAX);
        }
        self.outputs_are_stale = false;
        Ok(())
    }

    /// The start is a static equilibrium: what rounding leaves of accelerations is none.
    fn rest(&mut self) {
        let layout = &self.model.layout;
        for place in [layout.shaft, layout.housing].into_iter().flatten() {
            self.derivative[place + 2..place + 4].fill(0.0);
        }
        if let Some(place) = layout.sensor {
            self.derivative[place + 1] = 0.0;
        }
    }

    fn acceleration(&self, place: Option<usize>, prescribed: [f64; 2]) -> [f64; 2] {
        place.map_or(prescribed, |i| [self.derivative[i + 2], self.derivative[i + 3]])
    }

    /// Computes the tangent stiffness of the inner ring, −∂F/∂x with the elements in static balance [N/m].
    pub(super) fn refresh_stiffness(&mut self) {
        if self.stiffness_is_stale {
            let drive = self.drive(false);
            let progress = &self.state.progress;
            let shaft = self.model.shaft_state(&drive, 0.0, &progress.state);
            let housing = self.model.housing_state(&drive, 0.0, &progress.state);
            let offset = [0, 1].map(|a| housing.position[a] - shaft.position[a]);
            let jacobian = self.model.ring_jacobian(&progress.state, &progress.cells, offset, drive.cage_angle(0.0));
            for (value, quantity) in self.values.iter_mut().zip(&self.quantities) {
                if let Quantity::Stiffness(row, column) = *quantity {
                    *value = -jacobian[row][column];
                }
            }
            self.stiffness_is_stale = false;
        }
    }
}
