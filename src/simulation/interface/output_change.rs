//! A small change of the bearing, of which the derivatives of outputs are made.

use super::quantity::RingName;
use crate::dynamics::derivatives::{ForceChange, Variation};
use crate::dynamics::parameters::RingState;
use crate::dynamics::quasi_static::Rings;
use crate::numerics::plane::{Matrix, Vector};
use crate::scene::MOST_SENSORS;

/// A small change of everything that outputs are made of, and what it makes of the forces.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Change {
    pub(in crate::simulation) variation: Variation,
    pub(in crate::simulation) forces: ForceChange,
    /// Of the external loads on inner and outer ring (N).
    pub(in crate::simulation) loads: Rings,
    /// Of the sensors' positions and velocities.
    pub(in crate::simulation) sensors: [[f64; 2]; MOST_SENSORS],
    /// Of the accelerations of inner and outer ring (m/s²).
    pub(in crate::simulation) accelerations: [Vector; 2],
    pub(in crate::simulation) sensor_accelerations: [f64; MOST_SENSORS],
    /// Of what they measure, by the motion of the modes under them.
    pub(in crate::simulation) by_sensor_modes: [f64; MOST_SENSORS],
    /// Of those modes' state, where somebody else integrates it.
    pub(in crate::simulation) modes: Vec<f64>,
    pub(in crate::simulation) cage_torque: f64,
    pub(in crate::simulation) stiffness: Matrix,
}

impl Change {
    /// No change, for so many elements and slots of the modes under sensors.
    pub(in crate::simulation) fn new(count: usize, modes: usize) -> Self {
        Self {
            variation: Variation::new(count),
            forces: ForceChange::new(count),
            loads: Rings::zeros(),
            sensors: [[0.0; 2]; MOST_SENSORS],
            accelerations: [Vector::zeros(); 2],
            sensor_accelerations: [0.0; MOST_SENSORS],
            by_sensor_modes: [0.0; MOST_SENSORS],
            modes: vec![0.0; modes],
            cage_torque: 0.0,
            stiffness: Matrix::zeros(),
        }
    }

    pub(in crate::simulation) fn clear(&mut self) {
        self.variation.clear();
        (self.loads, self.accelerations) = (Rings::zeros(), [Vector::zeros(); 2]);
        (self.sensors, self.sensor_accelerations) = ([[0.0; 2]; MOST_SENSORS], [0.0; MOST_SENSORS]);
        self.by_sensor_modes = [0.0; MOST_SENSORS];
        self.modes.fill(0.0);
        self.cage_torque = 0.0;
        self.stiffness = Matrix::zeros();
    }

    pub(in crate::simulation) fn ring(&mut self, name: RingName) -> &mut RingState {
        match name {
            RingName::Shaft => &mut self.variation.shaft,
            RingName::Housing => &mut self.variation.housing,
        }
    }
}
