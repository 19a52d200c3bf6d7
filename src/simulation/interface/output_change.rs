//! A small change of the bearing, of which the derivatives of outputs are made.

use super::quantity::RingName;
use crate::dynamics::contacts::Forces;
use crate::dynamics::derivatives::{ForceChange, Variation};
use crate::dynamics::parameters::{
    COORDINATES, Excitation, Frame, Model, RINGS, RingInSpace, RingState, SPATIAL_BODIES,
};
use crate::dynamics::quasi_static::Rings;
use crate::numerics::number::Dual;
use crate::numerics::plane::Vector;
use crate::scene::MOST_SENSORS;

/// A small change of everything that outputs are made of, and what it makes of the forces.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Change {
    pub(in crate::simulation) variation: Variation,
    pub(in crate::simulation) forces: ForceChange,
    /// Of the external loads on inner and outer ring (N).
    pub(in crate::simulation) loads: Rings,
    /// Of the loads along z (N) and the moments (N m) on both rings.
    pub(in crate::simulation) loads_beyond: [[f64; 3]; 2],
    /// Of the sensors' positions and velocities.
    pub(in crate::simulation) sensors: [[f64; 2]; MOST_SENSORS],
    /// Of the accelerations of inner and outer ring (m/s²).
    pub(in crate::simulation) accelerations: [Vector; 2],
    /// Of those along z (m/s²) and of the tilts (rad/s²).
    pub(in crate::simulation) accelerations_beyond: [[f64; 3]; 2],
    pub(in crate::simulation) sensor_accelerations: [f64; MOST_SENSORS],
    /// Of what they measure, by the motion of the modes under them.
    pub(in crate::simulation) by_sensor_modes: [f64; MOST_SENSORS],
    /// Of those modes' state, where somebody else integrates it.
    pub(in crate::simulation) modes: Vec<f64>,
    pub(in crate::simulation) cage_torque: f64,
    /// −1 times that of the tangent stiffness by the inner ring's coordinates.
    pub(in crate::simulation) stiffness: [[f64; COORDINATES]; COORDINATES],
}

impl Change {
    /// No change, for so many elements and slots of the modes under sensors, of rings in space or in the plane.
    pub(in crate::simulation) fn new(count: usize, modes: usize, in_space: bool) -> Self {
        Self {
            variation: if in_space { Variation::in_space(count) } else { Variation::new(count) },
            forces: if in_space { ForceChange::in_space(count) } else { ForceChange::new(count) },
            loads_beyond: [[0.0; 3]; 2],
            accelerations_beyond: [[0.0; 3]; 2],
            loads: Rings::zeros(),
            sensors: [[0.0; 2]; MOST_SENSORS],
            accelerations: [Vector::zeros(); 2],
            sensor_accelerations: [0.0; MOST_SENSORS],
            by_sensor_modes: [0.0; MOST_SENSORS],
            modes: vec![0.0; modes],
            cage_torque: 0.0,
            stiffness: [[0.0; COORDINATES]; COORDINATES],
        }
    }

    pub(in crate::simulation) fn clear(&mut self) {
        self.variation.clear();
        (self.loads, self.accelerations) = (Rings::zeros(), [Vector::zeros(); 2]);
        (self.sensors, self.sensor_accelerations) = ([[0.0; 2]; MOST_SENSORS], [0.0; MOST_SENSORS]);
        self.by_sensor_modes = [0.0; MOST_SENSORS];
        self.modes.fill(0.0);
        self.cage_torque = 0.0;
        self.stiffness = [[0.0; COORDINATES]; COORDINATES];
        (self.loads_beyond, self.accelerations_beyond) = ([[0.0; 3]; 2], [[0.0; 3]; 2]);
    }

    pub(in crate::simulation) fn ring(&mut self, name: RingName) -> &mut RingState {
        match name {
            RingName::Shaft => &mut self.variation.shaft,
            RingName::Housing => &mut self.variation.housing,
        }
    }

    /// Change of the angle that the contact of element `j` leaves to a shoulder (rad).
    pub(in crate::simulation) fn of_shoulder(&self, model: &Model, forces: &Forces, j: usize, side: usize) -> f64 {
        let Some(space) = &model.space else { return 0.0 };
        let contacts = &forces.contacts;
        let force = [&contacts.inner, &contacts.outer][side][j];
        let angle = contacts.contact_angle(space, j, side);
        let by = [self.forces.contact_angles[side][j], [&self.forces.inner, &self.forces.outer][side][j]];
        let [angle, force] = [(angle, by[0]), (force, by[1])].map(|(value, by)| Dual { value, by: [by] });
        space.shoulder_margin::<Dual<f64, 1>>(side, angle, force).by[0]
    }

    /// Accelerations of rings in space and of sensors, from the changes of positions, velocities, forces and loads.
    pub(in crate::simulation) fn accelerate_in_space(
        &mut self,
        model: &Model,
        excitation: &Excitation,
        rings: &[RingInSpace; 2],
    ) {
        let Some(space) = &model.space else { return };
        let (mut x, mut v, mut acting) = ([0.0; SPATIAL_BODIES], [0.0; SPATIAL_BODIES], [0.0; RINGS]);
        let planes = [
            (&self.variation.shaft, self.forces.shaft, [self.loads[0], self.loads[1]]),
            (&self.variation.housing, self.forces.housing, [self.loads[2], self.loads[3]]),
        ];
        for (ring, (plane, force, load)) in planes.into_iter().enumerate() {
            for k in 0..COORDINATES {
                let i = COORDINATES * ring + k;
                (x[i], v[i], acting[i]) = if k < 2 {
                    (plane.position[k], plane.velocity[k], force[k] + load[k])
                } else {
                    let beyond = &self.variation.beyond[ring];
                    let sum = self.forces.beyond[ring][k - 2] + self.loads_beyond[ring][k - 2];
                    (beyond.position[k], beyond.velocity[k], sum)
                };
            }
        }
        for (k, &[of_x, of_v]) in self.sensors.iter().enumerate() {
            (x[RINGS + k], v[RINGS + k]) = (of_x, of_v);
        }
        let [speeds, _] = excitation.ring_speeds(0.0);
        let by_speed = [Frame::Shaft, Frame::Housing].map(|frame| self.variation.frames[frame as usize][1]);
        let found = space.vary_accelerations((&x, &v), &acting, rings, [speeds, by_speed]);
        for i in 0..RINGS {
            let (ring, k) = (i / COORDINATES, i % COORDINATES);
            // What the host prescribes has been set before.
            if k < 2 {
                self.accelerations[ring][k] += found[i];
            } else {
                self.accelerations_beyond[ring][k - 2] += found[i];
            }
        }
        self.sensor_accelerations.copy_from_slice(&found[RINGS..]);
    }
}
