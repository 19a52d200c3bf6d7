//! The tables `[shaft]`, `[housing]`, `[sensor]` and `[probe]` of the scene file.

use super::faults::{Faults, TableFault};
use super::one_or_more::OneOrMore;
use super::pair_of_numbers::optional;
use brinell::scene::{Motion, Ring, Sensor, SensorMode};
use schemars::JsonSchema;
use serde::Deserialize;

/// The inner ring.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShaftTable {
    /// Who moves it.
    motion: Motion,
    /// Turns of the shaft per second.
    pub(super) speed_hz: f64,
    /// Its angle at the start.
    #[serde(default)]
    pub(super) initial_angle_deg: f64,
    /// Load, x and y; of a ring with mass only.
    #[serde(default, deserialize_with = "optional")]
    load_n: Option<[f64; 2]>,
    /// Mass; 3.2638 without it.
    mass_kg: Option<f64>,
    /// Damping to the ground; 1376.8 without it.
    damping_n_s_m: Option<f64>,
    /// Stiffness to the ground; 0 without it.
    stiffness_n_m: Option<f64>,
}

/// The outer ring.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HousingTable {
    /// Who moves it.
    motion: Motion,
    /// Turns of the outer ring per second; without it it does not turn.
    pub(super) speed_hz: Option<f64>,
    /// Its angle at the start.
    #[serde(default)]
    pub(super) initial_angle_deg: f64,
    /// Load, x and y; of a ring with mass only.
    #[serde(default, deserialize_with = "optional")]
    load_n: Option<[f64; 2]>,
    /// Mass; 6.638 without it.
    mass_kg: Option<f64>,
    /// Damping to the ground; 2210.7 without it.
    damping_n_s_m: Option<f64>,
    /// Stiffness to the ground; 1.51056e7 without it.
    stiffness_n_m: Option<f64>,
}

impl ShaftTable {
    pub(super) fn into_ring(self) -> Result<Ring, Faults> {
        let support = [self.mass_kg, self.damping_n_s_m, self.stiffness_n_m];
        ring("shaft", self.motion, self.load_n, support, Ring::default_shaft())
    }
}

impl HousingTable {
    pub(super) fn into_ring(self) -> Result<Ring, Faults> {
        let support = [self.mass_kg, self.damping_n_s_m, self.stiffness_n_m];
        ring("housing", self.motion, self.load_n, support, Ring::default_housing())
    }
}

/// A ring from its keys; `given` are mass, damping and stiffness.
fn ring(
    name: &'static str,
    motion: Motion,
    load: Option<[f64; 2]>,
    given: [Option<f64>; 3],
    default: Ring,
) -> Result<Ring, Faults> {
    if motion == Motion::Internal {
        let [mass, damping, stiffness] = given;
        let (mass, damping) = (mass.unwrap_or(default.mass), damping.unwrap_or(default.damping));
        let stiffness = stiffness.unwrap_or(default.stiffness);
        return Ok(Ring { motion, load: load.unwrap_or_default(), mass, damping, stiffness });
    }
    // A key without effect is refused: whoever wrote it expects one.
    let refuse =
        |key: &str, value: String| TableFault::NotInternal { ring: name, key: format!("{name}.{key}"), value, motion };
    let mut faults = Faults::default();
    if let Some(load) = load {
        faults.0.push(refuse("load_n", format!("{load:?}")));
    }
    for (key, value) in ["mass_kg", "damping_n_s_m", "stiffness_n_m"].into_iter().zip(given) {
        if let Some(value) = value {
            faults.0.push(refuse(key, value.to_string()));
        }
    }
    faults.into_result()?;
    Ok(Ring { motion, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 })
}

/// An accelerometer on the housing.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SensorTable {
    /// Name for descriptions.
    name: String,
    /// Direction in which it measures, counter-clockwise from +x.
    direction_deg: f64,
    /// Its mass.
    mass_kg: f64,
    /// Stiffness of its mount.
    stiffness_n_m: f64,
    /// Damping of its mount.
    damping_n_s_m: f64,
    /// Modes of the structure between the outer ring and it.
    mode: Vec<SensorModeTable>,
    /// File of a measured frequency or impulse response, to which `brinell` fits the modes.
    response: Option<String>,
}

/// A mode of the structure between the outer ring and a sensor.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SensorModeTable {
    /// Its natural frequency.
    frequency_hz: f64,
    /// Its share of critical damping.
    damping_ratio: f64,
    /// Its participation factor times its shape where the sensor sits; those of all modes add up to 1.
    gain: f64,
    /// Gain of its velocity times its angular frequency; 0 unless points of the structure swing out of phase.
    #[serde(default)]
    quadrature_gain: f64,
}

/// Says by being there that displacements between the rings are wanted.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ProbeTable {}

impl OneOrMore<SensorTable> {
    pub(super) fn into_sensors(self) -> Result<Vec<Sensor>, Faults> {
        let count = self.0.len();
        let mut faults = Faults::default();
        let mut sensors = Vec::new();
        for (k, table) in self.0.into_iter().enumerate() {
            sensors
                .extend(faults.take(table.into_sensor().map_err(|of| Faults::from(of).in_table("sensor", k, count))));
        }
        faults.into_result().map(|()| sensors)
    }
}

impl SensorTable {
    pub(super) fn into_sensor(self) -> Result<Sensor, TableFault> {
        if let Some(file) = self.response {
            let both = (!self.mode.is_empty())
                .then_some(TableFault::Both { first: "sensor.response", second: "[[sensor.mode]]" });
            return Err(both.unwrap_or(TableFault::ResponseNotFitted(file)));
        }
        Ok(Sensor {
            name: self.name,
            direction: self.direction_deg.to_radians(),
            mass: self.mass_kg,
            stiffness: self.stiffness_n_m,
            damping: self.damping_n_s_m,
            modes: self.mode.into_iter().map(SensorModeTable::into_mode).collect(),
        })
    }
}

impl SensorModeTable {
    fn into_mode(self) -> SensorMode {
        let Self { frequency_hz: frequency, damping_ratio, gain, quadrature_gain } = self;
        SensorMode { frequency, damping_ratio, gain, quadrature_gain }
    }
}

impl Default for SensorTable {
    fn default() -> Self {
        let Sensor { name, direction, mass, stiffness, damping, modes: _ } = Sensor::default();
        let (direction_deg, mode) = (direction.to_degrees(), Vec::new());
        Self {
            name,
            direction_deg,
            mass_kg: mass,
            stiffness_n_m: stiffness,
            damping_n_s_m: damping,
            mode,
            response: None,
        }
    }
}
