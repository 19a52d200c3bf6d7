//! Outputs, computed when somebody reads them.

use super::table::{Quantity, RingName};
use super::{Simulation, SimulationError};
use crate::dynamics::drive::Drive;
use crate::dynamics::forces::Forces;
use crate::dynamics::kinematics::RingState;
use crate::dynamics::model::Model;
use crate::numerics::plane::Vector;

/// All that the outputs of one instant are computed from.
#[derive(Debug)]
pub struct Outputs<'a> {
    state: &'a [f64],
    forces: &'a Forces,
    ring: [RingState; 2],
    acceleration: [Vector; 2],
    sensor: f64,
    cage_angle: f64,
    model: &'a Model,
    drive: &'a Drive,
    tau: f64,
}

impl<'a> Outputs<'a> {
    /// Those of the instant `tau` [s] after the communication point. `derivative` and `forces` are the model's for `state`;
    /// `cage_start` is the cage angle at the communication point [rad], all turns counted.
    pub fn new(
        model: &'a Model,
        (drive, tau): (&'a Drive, f64),
        (state, derivative): (&'a [f64], &[f64]),
        forces: &'a Forces,
        cage_start: f64,
    ) -> Self {
        Self {
            state,
            forces,
            ring: [model.shaft_state(drive, tau, state), model.housing_state(drive, tau, state)],
            acceleration: model.ring_rates(drive, tau, derivative).map(|ring| ring.velocity),
            sensor: model.layout.sensor.map_or(0.0, |i| derivative[i + 1]),
            cage_angle: cage_start + drive.cage.at(tau),
            model,
            drive,
            tau,
        }
    }

    /// Value of an output; `None` for what does not belong to an outputs.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        Some(match quantity {
            Quantity::Position(ring, axis) => self.ring[place(ring)].position[axis],
            Quantity::Velocity(ring, axis) => self.ring[place(ring)].velocity[axis],
            Quantity::Acceleration(ring, axis) => self.acceleration[place(ring)][axis],
            Quantity::Force(ring, axis) => [self.forces.shaft(), self.forces.housing()][place(ring)][axis],
            Quantity::SensorAcceleration => self.sensor,
            Quantity::CageAngle => self.cage_angle,
            Quantity::CageSpeed => self.drive.cage.rate_at(self.tau),
            // A sum over all elements, and recorders do not ask for it.
            Quantity::CageTorque => {
                let acceleration = self.acceleration[place(RingName::Housing)];
                self.model.cage_torque(self.drive, self.tau, self.state, acceleration, self.forces)
            }
            Quantity::ElementAngle(j) => self.cage_angle + self.model.element_offset(j),
            Quantity::ElementPath(j) => self.state[j],
            Quantity::ElementInnerForce(j) => self.forces.contacts.inner[j],
            Quantity::ElementOuterForce(j) => self.forces.contacts.outer[j],
            _ => return None,
        })
    }
}

fn place(ring: RingName) -> usize {
    match ring {
        RingName::Shaft => 0,
        RingName::Housing => 1,
    }
}

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
        let outputs = Outputs::new(
            &self.model,
            (&drive, 0.0),
            (&progress.state, &self.derivative),
            &self.forces,
            self.state.cage.total(),
        );
        self.present_acceleration = outputs.acceleration[place(RingName::Housing)];
        let first = self.inputs.count;
        for (i, quantity) in self.quantities.iter().enumerate().skip(first) {
            let value = match *quantity {
                Quantity::MeanForce(ring, axis) => Some(progress.mean_force[2 * place(ring) + axis]),
                other => outputs.value(other),
            };
            if let Some(value) = value {
                self.values[i] = value;
            }
        }
        let solves_grids = self.model.defect.as_ref().is_some_and(|(near, _)| near.solves_grids());
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

    /// Computes the tangent stiffness of the inner ring, −∂F/∂x with the elements in static balance [N/m].
    pub(super) fn refresh_stiffness(&mut self) {
        if self.stiffness_is_stale {
            let drive = self.drive(false);
            let progress = &self.state.progress;
            let now = self.model.kinematics(&drive, 0.0, &progress.state);
            let (state, cells) = (&progress.state, &progress.cells);
            let jacobian = self.model.ring_jacobian(state, cells, now.offset(), now.cage.angle);
            for (value, quantity) in self.values.iter_mut().zip(self.quantities.iter()) {
                if let Quantity::Stiffness(row, column) = *quantity {
                    *value = -jacobian[(row, column)];
                }
            }
            self.stiffness_is_stale = false;
        }
    }
}
