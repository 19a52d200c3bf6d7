//! Accelerometers on the housing, and what they sit on.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Most accelerometers in a scene.
pub const MOST_SENSORS: usize = 8;

/// An accelerometer: a damped resonator on the housing, which moves and measures along one direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sensor {
    /// What the user calls it; may be empty.
    pub name: String,
    /// Direction along which it measures (rad), counter-clockwise from +x; π/2 is upwards.
    pub direction: f64,
    /// How far that direction rises from the plane of x and y towards +z (rad); π/2 is along the axis.
    pub elevation: f64,
    /// Mass (kg).
    pub mass: f64,
    /// Stiffness (N/m).
    pub stiffness: f64,
    /// Damping (N s/m).
    pub damping: f64,
    /// Modes of the structure between the outer ring and it.
    pub modes: Vec<SensorMode>,
}

/// Most modes between the outer ring and one sensor.
pub const MOST_SENSOR_MODES: usize = 32;

/// A mode of the structure between the outer ring and a sensor.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SensorMode {
    /// Natural frequency (Hz).
    pub frequency: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// Participation factor times shape where the sensor sits; those of all modes of a structure add up to 1.
    pub gain: f64,
    /// The same of its velocity times its angular frequency: 0 unless the structure's points swing out of phase.
    pub quadrature_gain: f64,
}

impl Sensor {
    /// Unit vector along which it measures. A right angle is one to the bit, and π/2 is only near one.
    pub fn unit_in_space(&self) -> [f64; 3] {
        let part = |number: f64| if number.abs() < 1e-15 { 0.0 } else { number };
        let (flat, rise) = (part(libm::cos(self.elevation)), part(libm::sin(self.elevation)));
        [part(libm::cos(self.direction)) * flat, part(libm::sin(self.direction)) * flat, rise]
    }

    /// Its part in the plane of x and y.
    pub fn unit(&self) -> [f64; 2] {
        let [x, y, _] = self.unit_in_space();
        [x, y]
    }

    /// Its resonance on a mounting that stands (Hz), √(k/m)/2π.
    pub fn resonance(&self) -> f64 {
        (self.stiffness / self.mass).sqrt() / TAU
    }

    /// Moves its resonance to a frequency (Hz). Mass and damping ratio stay.
    pub fn set_resonance(&mut self, frequency: f64) {
        let ratio = frequency / self.resonance();
        self.stiffness *= ratio * ratio;
        self.damping *= ratio;
    }

    /// Turns it along a vector of any length above 0.
    pub fn set_direction(&mut self, [x, y, z]: [f64; 3]) {
        self.direction = libm::atan2(y, x);
        self.elevation = libm::atan2(z, libm::hypot(x, y));
    }
}
