//! What outputs are at one instant.

use super::quantity::{Quantity, RingName};
use crate::dynamics::contacts::Forces;
use crate::dynamics::parameters::{CageState, Excitation, Frame, Model, RingInSpace, RingState, force_slot};
use crate::numerics::plane::Vector;
use crate::scene::MOST_SENSORS;

/// Angles of the cage and of the frames of defects (rad), all turns counted.
#[derive(Debug, Clone, Copy, Default)]
pub struct Angles {
    /// Of the nominal cage.
    pub cage: f64,
    /// In the order of [`Frame`].
    pub frames: [f64; 3],
}

/// The solution at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Solution<'a> {
    /// What acts from outside.
    pub excitation: &'a Excitation,
    /// Time since the communication point (s).
    pub tau: f64,
    /// State vector.
    pub state: &'a [f64],
    /// Its derivative.
    pub derivative: &'a [f64],
    /// State of the modes between outer ring and sensors.
    pub sensor_modes: &'a [f64],
}

/// All that the outputs of one instant are computed from.
#[derive(Debug)]
pub struct Outputs<'a> {
    state: &'a [f64],
    forces: &'a Forces,
    ring: [RingState; 2],
    acceleration: [Vector; 2],
    /// Rings in space with their rates.
    space: Option<[[RingInSpace; 2]; 2]>,
    sensors: [f64; MOST_SENSORS],
    angles: Angles,
    /// The nominal cage.
    cage: CageState,
    model: &'a Model,
    excitation: &'a Excitation,
    tau: f64,
}

impl<'a> Outputs<'a> {
    /// Acceleration of the outer ring (m/s²).
    pub(in crate::simulation) fn housing_acceleration(&self) -> Vector {
        self.acceleration[RingName::Housing.index()]
    }

    /// Those of a solution. Its derivative and `forces` are the model's for its state; `start` are the angles at the
    /// communication point.
    pub fn new(model: &'a Model, solution: Solution<'a>, forces: &'a Forces, start: Angles) -> Self {
        let Solution { excitation, tau, state, derivative, sensor_modes } = solution;
        let mut sensors = [0.0; MOST_SENSORS];
        for (k, i) in model.layout.sensor_indices().enumerate() {
            sensors[k] = model.sensor_modes.measured(k, derivative[i + 1], sensor_modes);
        }
        Self {
            state,
            forces,
            ring: [model.shaft_state(excitation, tau, state), model.housing_state(excitation, tau, state)],
            acceleration: model.ring_rates(excitation, tau, derivative).map(|ring| ring.velocity),
            space: model.space.as_ref().map(|_| {
                let rings = model.rings_in_space(excitation, tau, state, None);
                [rings, model.ring_rates_in_space(excitation, tau, derivative)]
            }),
            sensors,
            angles: Angles {
                cage: start.cage + excitation.cage.at(tau),
                frames: std::array::from_fn(|i| start.frames[i] + excitation.frames[i].since.at(tau)),
            },
            cage: excitation.cage_at(tau),
            model,
            excitation,
            tau,
        }
    }

    /// Angle of element `j`, all turns counted (rad).
    fn element_angle(&self, j: usize) -> f64 {
        self.angles.cage + self.model.element_offset(j) + self.forces.element_lead(j)
    }

    fn in_space(&self, of: impl Fn(&[[RingInSpace; 2]; 2]) -> f64) -> f64 {
        self.space.as_ref().map_or(0.0, of)
    }

    /// Contact angle (rad) of element `j` on the inner (0) or the outer (1) raceway; 0 of a contact without force.
    fn contact_angle(&self, j: usize, side: usize) -> f64 {
        let Some(space) = &self.model.space else { return 0.0 };
        self.forces.contacts.contact_angle(space, j, side)
    }

    /// Angle (rad) that a contact ellipse leaves to the shoulder; negative where the shoulder cuts it.
    fn shoulder_margin(&self, j: usize, side: usize) -> f64 {
        let Some(space) = &self.model.space else { return 0.0 };
        self.forces.contacts.shoulder_margin(space, j, side)
    }

    /// Value of an output; `None` for what is not of an instant, or costs more than what is computed here.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        Some(match quantity {
            // Beyond the plane.
            Quantity::Position(ring, k @ 2..) => self.in_space(|[rings, _]| rings[ring.index()].position[k]),
            Quantity::Velocity(ring, k @ 2..) => self.in_space(|[rings, _]| rings[ring.index()].velocity[k]),
            Quantity::Acceleration(ring, k @ 2..) => self.in_space(|[_, rates]| rates[ring.index()].velocity[k]),
            Quantity::Force(ring, k @ 2..) => self.forces.rings[force_slot(ring.index(), k)],
            Quantity::Probe(k @ 2..) => self.in_space(|[[shaft, housing], _]| shaft.position[k] - housing.position[k]),
            Quantity::ElementAxial(j) => self.forces.contacts.axial_positions(self.model, self.state)[j],
            Quantity::ContactAngle(j, side) => self.contact_angle(j, side),
            Quantity::ShoulderMargin(j, side) => self.shoulder_margin(j, side),
            Quantity::Position(ring, axis) => self.ring[ring.index()].position[axis],
            Quantity::Velocity(ring, axis) => self.ring[ring.index()].velocity[axis],
            Quantity::Acceleration(ring, axis) => self.acceleration[ring.index()][axis],
            Quantity::Force(ring, axis) => [self.forces.shaft(), self.forces.housing()][ring.index()][axis],
            Quantity::SensorAcceleration(k) => self.sensors[k],
            Quantity::Probe(axis) => self.ring[0].position[axis] - self.ring[1].position[axis],
            Quantity::CageAngle => self.angles.cage + self.forces.cage_lead.angle,
            Quantity::RingAngle(ring) => self.angles.frames[ring.frame() as usize],
            Quantity::ShaftTorque => self.forces.torque_on(Frame::Shaft),
            Quantity::CageSpeed => self.cage.speed * (1.0 + self.forces.cage_lead.rate),
            // A sum over all elements, and recorders do not ask for it.
            Quantity::CageTorque => {
                let acceleration = self.acceleration[RingName::Housing.index()];
                self.model.cage_torque(self.excitation, self.tau, self.state, acceleration, self.forces)
            }
            Quantity::ElementAngle(j) => self.element_angle(j),
            Quantity::ElementSpinAngle(j) => self.model.spin_angle(j, &self.angles.frames, self.element_angle(j)),
            Quantity::ElementPath(j) => self.forces.contacts.paths(self.model, self.state)[j],
            Quantity::ElementInnerForce(j) => self.forces.contacts.inner[j],
            Quantity::ElementOuterForce(j) => self.forces.contacts.outer[j],
            Quantity::MeanForce(..) | Quantity::Stiffness(..) => return None,
            Quantity::Speed(_) | Quantity::Load(..) | Quantity::Count(_) | Quantity::Parameter(_) => return None,
        })
    }
}
