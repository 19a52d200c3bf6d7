//! The tables `[shaft]`, `[housing]` and `[sensor]` of the scene file.

use crate::scene::{Motion, Ring, SceneError};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ShaftTable {
    motion: Motion,
    pub(super) speed_hz: f64,
    load_n: Option<[f64; 2]>,
    mass_kg: Option<f64>,
    damping_n_s_m: Option<f64>,
    stiffness_n_m: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HousingTable {
    motion: Motion,
    load_n: Option<[f64; 2]>,
    mass_kg: Option<f64>,
    damping_n_s_m: Option<f64>,
    stiffness_n_m: Option<f64>,
}

impl ShaftTable {
    pub(super) fn into_ring(self) -> Result<Ring, SceneError> {
        let support = [self.mass_kg, self.damping_n_s_m, self.stiffness_n_m];
        ring("shaft", self.motion, self.load_n, support, [3.2638, 1376.8, 0.0])
    }
}

impl HousingTable {
    pub(super) fn into_ring(self) -> Result<Ring, SceneError> {
        let support = [self.mass_kg, self.damping_n_s_m, self.stiffness_n_m];
        ring("housing", self.motion, self.load_n, support, [6.638, 2210.7, 1.51056e7])
    }
}

/// A ring from its keys; `given` and `default` are mass, damping and stiffness.
fn ring(
    name: &'static str,
    motion: Motion,
    load: Option<[f64; 2]>,
    given: [Option<f64>; 3],
    default: [f64; 3],
) -> Result<Ring, SceneError> {
    if motion == Motion::Internal {
        let [mass, damping, stiffness] = [0, 1, 2].map(|i| given[i].unwrap_or(default[i]));
        return Ok(Ring { motion, load: load.unwrap_or_default(), mass, damping, stiffness });
    }
    // A key without effect is refused: whoever wrote it expects one.
    let refuse =
        |key: &str, value: String| SceneError::NotInternal { ring: name, key: format!("{name}.{key}"), value, motion };
    if let Some(load) = load {
        return Err(refuse("load_n", format!("{load:?}")));
    }
    for (key, value) in ["mass_kg", "damping_n_s_m", "stiffness_n_m"].into_iter().zip(given) {
        if let Some(value) = value {
            return Err(refuse(key, value.to_string()));
        }
    }
    Ok(Ring { motion, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct SensorTable {
    pub(super) mass_kg: f64,
    pub(super) stiffness_n_m: f64,
    pub(super) damping_n_s_m: f64,
}

impl Default for SensorTable {
    fn default() -> Self {
        Self { mass_kg: 1.0, stiffness_n_m: 8.8826e9, damping_n_s_m: 9424.8 }
    }
}
