//! What outputs are at one instant.

use super::quantity::{Quantity, RingName};
use crate::dynamics::contacts::Forces;
use crate::dynamics::parameters::{Excitation, Frame, Model, RingInSpace, RingState, force_slot};
use crate::numerics::plane::Vector;

/// Angles of the cage and of the frames of defects (rad), all turns counted.
#[derive(Debug, Clone, Copy, Default)]
pub struct Angles {
    /// Of the nominal cage.
    pub cage: f64,
    /// In the order of [`Frame`].
    pub frames: [f64; 3],
}

/// The outputs of one instant, each computed when it is asked for, of the solution then.
#[derive(Debug, Clone, Copy)]
pub struct Outputs<'a> {
    pub(in crate::simulation) model: &'a Model,
    /// What acts from outside.
    pub(in crate::simulation) excitation: &'a Excitation,
    /// Time since the communication point (s).
    pub(in crate::simulation) tau: f64,
    pub(in crate::simulation) state: &'a [f64],
    /// The state's derivative and the forces: the model's for that state.
    pub(in crate::simulation) derivative: &'a [f64],
    pub(in crate::simulation) forces: &'a Forces,
    /// State of the modes between outer ring and sensors.
    pub(in crate::simulation) sensor_modes: &'a [f64],
    /// Angles at the communication point.
    pub(in crate::simulation) start: Angles,
}

impl Outputs<'_> {
    fn ring(&self, ring: RingName) -> RingState {
        let Self { excitation, tau, state, .. } = *self;
        match ring {
            RingName::Shaft => self.model.shaft_state(excitation, tau, state),
            RingName::Housing => self.model.housing_state(excitation, tau, state),
        }
    }

    /// Acceleration of a ring (m/s²).
    pub(in crate::simulation) fn acceleration(&self, ring: RingName) -> Vector {
        let Self { excitation, tau, derivative, .. } = *self;
        self.model.ring_rates(excitation, tau, derivative)[ring.index()].velocity
    }

    /// What sensor `k` measures (m/s²).
    fn sensor(&self, k: usize) -> f64 {
        let Self { derivative, sensor_modes, .. } = *self;
        let own = derivative[self.model.layout.sensor_index(k) + 1];
        self.model.sensor_modes.measured(k, own, sensor_modes)
    }

    /// Angle of the nominal cage, all turns counted (rad).
    fn cage_angle(&self) -> f64 {
        self.start.cage + self.excitation.cage.at(self.tau)
    }

    /// Angle of a frame of defects, all turns counted (rad).
    fn frame_angle(&self, frame: Frame) -> f64 {
        let (Self { excitation, tau, .. }, frame) = (*self, frame as usize);
        self.start.frames[frame] + excitation.frames[frame].since.at(tau)
    }

    /// Angle of element `j`, all turns counted (rad).
    fn element_angle(&self, j: usize) -> f64 {
        self.cage_angle() + self.model.element_offset(j) + self.forces.element_lead(j)
    }

    /// Rings with more than two degrees of freedom; `None` in the plane.
    fn in_space(&self) -> Option<[RingInSpace; 2]> {
        let Self { excitation, tau, state, .. } = *self;
        self.model.space.as_ref().map(|_| self.model.rings_in_space(excitation, tau, state, None))
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
        let Self { excitation, tau, state, .. } = *self;
        Some(match quantity {
            // Beyond the plane.
            Quantity::Position(ring, k @ 2..) => self.in_space()?[ring.index()].position[k],
            Quantity::Velocity(ring, k @ 2..) => self.in_space()?[ring.index()].velocity[k],
            Quantity::Acceleration(ring, k @ 2..) => {
                self.model.ring_rates_in_space(excitation, tau, self.derivative)[ring.index()].velocity[k]
            }
            Quantity::Probe(k @ 2..) => {
                let [shaft, housing] = self.in_space()?;
                shaft.position[k] - housing.position[k]
            }
            Quantity::ElementAxial(j) => self.forces.contacts.axial_positions(self.model, state)[j],
            Quantity::ContactAngle(j, side) => self.contact_angle(j, side),
            Quantity::ShoulderMargin(j, side) => self.shoulder_margin(j, side),
            Quantity::Position(ring, axis) => self.ring(ring).position[axis],
            Quantity::Velocity(ring, axis) => self.ring(ring).velocity[axis],
            Quantity::Acceleration(ring, axis) => self.acceleration(ring)[axis],
            Quantity::Force(ring, axis) => self.forces.rings[force_slot(ring.index(), axis)],
            Quantity::SensorAcceleration(k) => self.sensor(k),
            Quantity::Probe(axis) => {
                self.ring(RingName::Shaft).position[axis] - self.ring(RingName::Housing).position[axis]
            }
            Quantity::CageAngle => self.cage_angle() + self.forces.cage_lead.angle,
            Quantity::RingAngle(ring) => self.frame_angle(ring.frame()),
            Quantity::ShaftTorque => self.forces.torque_on(Frame::Shaft),
            Quantity::CageSpeed => excitation.cage.rate_at(tau) * (1.0 + self.forces.cage_lead.rate),
            Quantity::CageTorque => {
                let acceleration = self.acceleration(RingName::Housing);
                self.model.cage_torque(excitation, tau, state, acceleration, self.forces)
            }
            Quantity::ElementAngle(j) => self.element_angle(j),
            Quantity::ElementSpinAngle(j) => {
                self.model.spin_angle(j, self.frame_angle(Frame::Spin), self.element_angle(j))
            }
            Quantity::ElementPath(j) => self.forces.contacts.paths(self.model, state)[j],
            Quantity::ElementInnerForce(j) => self.forces.contacts.inner[j],
            Quantity::ElementOuterForce(j) => self.forces.contacts.outer[j],
            Quantity::MeanForce(..) | Quantity::NextMeanForce(..) | Quantity::Stiffness(..) => return None,
            Quantity::SuggestedStep | Quantity::RadialClearance => return None,
            Quantity::CouplingError | Quantity::LargestCouplingError => return None,
            Quantity::Speed(_) | Quantity::Load(..) | Quantity::Count(_) | Quantity::Parameter(_) => return None,
        })
    }
}
