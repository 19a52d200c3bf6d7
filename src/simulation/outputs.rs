//! What outputs are at one instant.

use super::quantity::{Quantity, RingName};
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
    /// Acceleration of the outer ring [m/s²].
    pub(super) fn housing_acceleration(&self) -> Vector {
        self.acceleration[RingName::Housing.index()]
    }

    /// Those of the instant `tau` [s] after the communication point. `derivative` and `forces` are the model's for
    /// `state`; `cage_start` is the cage angle at the communication point [rad], all turns counted.
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

    /// Value of an output; `None` for what is not of an instant, or costs more than what is computed here.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        Some(match quantity {
            Quantity::Position(ring, axis) => self.ring[ring.index()].position[axis],
            Quantity::Velocity(ring, axis) => self.ring[ring.index()].velocity[axis],
            Quantity::Acceleration(ring, axis) => self.acceleration[ring.index()][axis],
            Quantity::Force(ring, axis) => [self.forces.shaft(), self.forces.housing()][ring.index()][axis],
            Quantity::SensorAcceleration => self.sensor,
            Quantity::CageAngle => self.cage_angle,
            Quantity::CageSpeed => self.drive.cage.rate_at(self.tau),
            // A sum over all elements, and recorders do not ask for it.
            Quantity::CageTorque => {
                let acceleration = self.acceleration[RingName::Housing.index()];
                self.model.cage_torque(self.drive, self.tau, self.state, acceleration, self.forces)
            }
            Quantity::ElementAngle(j) => self.cage_angle + self.model.element_offset(j),
            Quantity::ElementPath(j) => self.state[j],
            Quantity::ElementInnerForce(j) => self.forces.contacts.inner[j],
            Quantity::ElementOuterForce(j) => self.forces.contacts.outer[j],
            Quantity::MeanForce(..) | Quantity::Stiffness(..) => return None,
            Quantity::ShaftSpeed | Quantity::Load(..) | Quantity::Count(_) | Quantity::Parameter(_) => return None,
        })
    }
}
