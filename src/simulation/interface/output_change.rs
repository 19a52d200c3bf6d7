//! A small change of the bearing, of which the derivatives of outputs are made.

use crate::dynamics::contacts::Forces;
use crate::dynamics::derivatives::{ForceChange, Variation};
use crate::dynamics::parameters::{COORDINATES, Excitation, Frame, Model, RINGS, RingInSpace, SPATIAL_BODIES};
use crate::numerics::number::Dual;
use crate::scene::MOST_SENSORS;

/// A small change of everything that outputs are made of, and what it makes of the forces.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Change {
    pub(in crate::simulation) variation: Variation,
    pub(in crate::simulation) forces: ForceChange,
    /// Of the external loads (N) and moments (N m) on inner and outer ring.
    pub(in crate::simulation) loads: [[f64; COORDINATES]; 2],
    /// Of the sensors' positions and velocities.
    pub(in crate::simulation) sensors: [[f64; 2]; MOST_SENSORS],
    /// Of the accelerations of inner and outer ring (m/s²) and of their tilts (rad/s²).
    pub(in crate::simulation) accelerations: [[f64; COORDINATES]; 2],
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
            loads: Default::default(),
            sensors: [[0.0; 2]; MOST_SENSORS],
            accelerations: Default::default(),
            sensor_accelerations: [0.0; MOST_SENSORS],
            by_sensor_modes: [0.0; MOST_SENSORS],
            modes: vec![0.0; modes],
            cage_torque: 0.0,
            stiffness: [[0.0; COORDINATES]; COORDINATES],
        }
    }

    pub(in crate::simulation) fn clear(&mut self) {
        self.variation.clear();
        (self.loads, self.accelerations) = Default::default();
        (self.sensors, self.sensor_accelerations) = ([[0.0; 2]; MOST_SENSORS], [0.0; MOST_SENSORS]);
        self.by_sensor_modes = [0.0; MOST_SENSORS];
        self.modes.fill(0.0);
        self.cage_torque = 0.0;
        self.stiffness = [[0.0; COORDINATES]; COORDINATES];
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
        for i in 0..RINGS {
            let (ring, k) = (i / COORDINATES, i % COORDINATES);
            let moved = &self.variation.rings[ring];
            (x[i], v[i]) = (moved.position[k], moved.velocity[k]);
            acting[i] = self.forces.rings[ring][k] + self.loads[ring][k];
        }
        for (k, &[of_x, of_v]) in self.sensors.iter().enumerate() {
            (x[RINGS + k], v[RINGS + k]) = (of_x, of_v);
        }
        let [speeds, _] = excitation.ring_speeds(0.0);
        let by_speed = [Frame::Shaft, Frame::Housing].map(|frame| self.variation.frames[frame as usize][1]);
        let found = space.vary_accelerations((&x, &v), &acting, rings, [speeds, by_speed]);
        for i in 0..RINGS {
            // What the host prescribes has been set before.
            self.accelerations[i / COORDINATES][i % COORDINATES] += found[i];
        }
        self.sensor_accelerations.copy_from_slice(&found[RINGS..]);
    }
}
