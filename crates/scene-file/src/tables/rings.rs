//! The tables `[shaft]`, `[housing]`, `[sensor]` and `[probe]` of the scene file.

use super::faults::{Faults, TableFault, only_one};
use super::short_lists::{Vector, pair, triple};
use brinell::scene::DegreesOfFreedom::{self, Five, Three, Two};
use brinell::scene::{AxialSupport, FreedomError, Motion, Ring, SceneError, Sensor, SensorMode, TiltSupport};
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt::Display;

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
    /// Load, x and y; a third number is along z. This, mass, damping and stiffness of a ring whose motion is internal
    /// only.
    #[schemars(extend("default" = [0.0, 0.0]))]
    load_n: Option<Vector>,
    /// Its mass.
    #[schemars(extend("default" = Ring::default_shaft().mass))]
    mass_kg: Option<f64>,
    /// Damping to the ground.
    #[schemars(extend("default" = Ring::default_shaft().damping))]
    damping_n_s_m: Option<f64>,
    /// Stiffness to the ground.
    #[schemars(extend("default" = Ring::default_shaft().stiffness))]
    stiffness_n_m: Option<f64>,
    /// Force of a preload spring along the axis, in the sense of the contact angle; this and what is axial with 3 or 5
    /// degrees of freedom only.
    #[schemars(extend("default" = 0.0))]
    preload_n: Option<f64>,
    /// Damping to the ground along the axis; damping_n_s_m without it.
    axial_damping_n_s_m: Option<f64>,
    /// Stiffness to the ground along the axis; stiffness_n_m without it.
    axial_stiffness_n_m: Option<f64>,
    /// Moment about x and y; this, tilt and moments of inertia with 5 degrees of freedom only.
    #[schemars(extend("default" = [0.0, 0.0]))]
    #[serde(default, deserialize_with = "pair")]
    load_moment_n_m: Option<[f64; 2]>,
    /// Moment of inertia about x or y; what holds without it is assumed.
    #[schemars(extend("default" = TiltSupport::ASSUMED.transverse_inertia))]
    transverse_inertia_kg_m2: Option<f64>,
    /// Moment of inertia about the axis; what holds without it is assumed.
    #[schemars(extend("default" = TiltSupport::ASSUMED.polar_inertia))]
    polar_inertia_kg_m2: Option<f64>,
    /// Damping of tilt to the ground; what holds without it is assumed.
    #[schemars(extend("default" = TiltSupport::ASSUMED.damping))]
    tilt_damping_n_m_s: Option<f64>,
    /// Stiffness of tilt to the ground.
    #[schemars(extend("default" = TiltSupport::ASSUMED.stiffness))]
    tilt_stiffness_n_m_rad: Option<f64>,
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
    /// Load, x and y; a third number is along z. This, mass, damping and stiffness of a ring whose motion is internal
    /// only.
    #[schemars(extend("default" = [0.0, 0.0]))]
    load_n: Option<Vector>,
    /// Its mass.
    #[schemars(extend("default" = Ring::default_housing().mass))]
    mass_kg: Option<f64>,
    /// Damping to the ground.
    #[schemars(extend("default" = Ring::default_housing().damping))]
    damping_n_s_m: Option<f64>,
    /// Stiffness to the ground.
    #[schemars(extend("default" = Ring::default_housing().stiffness))]
    stiffness_n_m: Option<f64>,
    /// Force of a preload spring along the axis, in the sense of the contact angle; this and what is axial with 3 or 5
    /// degrees of freedom only.
    #[schemars(extend("default" = 0.0))]
    preload_n: Option<f64>,
    /// Damping to the ground along the axis; damping_n_s_m without it.
    axial_damping_n_s_m: Option<f64>,
    /// Stiffness to the ground along the axis; stiffness_n_m without it.
    axial_stiffness_n_m: Option<f64>,
}

impl ShaftTable {
    pub(super) fn into_ring(self, freedom: DegreesOfFreedom) -> Result<Ring, Faults> {
        let default = Ring::default_shaft();
        let mut keys = RingKeys { name: "shaft", motion: self.motion, freedom, faults: Faults::default() };
        let across = [self.mass_kg, self.damping_n_s_m, self.stiffness_n_m];
        let along = [self.preload_n, self.axial_damping_n_s_m, self.axial_stiffness_n_m];
        let mut ring = keys.ring(self.load_n, across, along, default);
        let moment = self.load_moment_n_m.map(|moment| format!("{moment:?}"));
        keys.of("load_moment_n_m", moment, Five);
        let mut number = |key, given: Option<f64>, default: f64| {
            keys.of(key, given, Five);
            given.unwrap_or(default)
        };
        let tilt = TiltSupport {
            transverse_inertia: number(
                "transverse_inertia_kg_m2",
                self.transverse_inertia_kg_m2,
                default.tilt.transverse_inertia,
            ),
            polar_inertia: number("polar_inertia_kg_m2", self.polar_inertia_kg_m2, default.tilt.polar_inertia),
            damping: number("tilt_damping_n_m_s", self.tilt_damping_n_m_s, default.tilt.damping),
            stiffness: number("tilt_stiffness_n_m_rad", self.tilt_stiffness_n_m_rad, default.tilt.stiffness),
            load_moment: self.load_moment_n_m.unwrap_or_default(),
        };
        if self.motion == Motion::Internal {
            ring.tilt = tilt;
        }
        keys.faults.into_result().map(|()| ring)
    }
}

impl HousingTable {
    pub(super) fn into_ring(self, freedom: DegreesOfFreedom) -> Result<Ring, Faults> {
        let mut keys = RingKeys { name: "housing", motion: self.motion, freedom, faults: Faults::default() };
        let across = [self.mass_kg, self.damping_n_s_m, self.stiffness_n_m];
        let along = [self.preload_n, self.axial_damping_n_s_m, self.axial_stiffness_n_m];
        let ring = keys.ring(self.load_n, across, along, Ring::default_housing());
        keys.faults.into_result().map(|()| ring)
    }
}

/// Reads a ring's keys. One without effect is refused: whoever wrote it expects one.
struct RingKeys {
    name: &'static str,
    motion: Motion,
    freedom: DegreesOfFreedom,
    faults: Faults,
}

impl RingKeys {
    /// Keeps why a key that is given has no effect.
    fn of(&mut self, key: &str, given: Option<impl Display>, least: DegreesOfFreedom) {
        let Some(value) = given.map(|value| value.to_string()) else { return };
        let key = format!("{}.{key}", self.name);
        if self.freedom < least {
            self.faults.0.push(TableFault::NeedsFreedom { key, value, least, given: self.freedom });
        } else if self.motion != Motion::Internal {
            self.faults.0.push(TableFault::NotInternal { ring: self.name, key, value, motion: self.motion });
        }
    }

    /// The ring; `across` are mass, damping and stiffness, `along` preload, damping and stiffness.
    fn ring(&mut self, load: Option<Vector>, across: [Option<f64>; 3], along: [Option<f64>; 3], default: Ring) -> Ring {
        self.of("load_n", load, Two);
        for (key, given) in ["mass_kg", "damping_n_s_m", "stiffness_n_m"].into_iter().zip(across) {
            self.of(key, given, Two);
        }
        for (key, given) in ["preload_n", "axial_damping_n_s_m", "axial_stiffness_n_m"].into_iter().zip(along) {
            self.of(key, given, Three);
        }
        if self.motion != Motion::Internal {
            return Ring { motion: self.motion, ..Ring::hosted() };
        }
        let [mass, damping, stiffness] = across;
        let (damping, stiffness) = (damping.unwrap_or(default.damping), stiffness.unwrap_or(default.stiffness));
        let [preload, axial_damping, axial_stiffness] = along;
        let axial = AxialSupport {
            load: load.and_then(|load| load.axial).unwrap_or(0.0),
            preload: preload.unwrap_or(0.0),
            damping: axial_damping.unwrap_or(damping),
            stiffness: axial_stiffness.unwrap_or(stiffness),
        };
        let load = load.map_or([0.0; 2], |load| load.across);
        Ring { load, mass: mass.unwrap_or(default.mass), damping, stiffness, axial, ..default }
    }
}

/// An accelerometer on the housing.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SensorTable {
    /// Name for descriptions.
    name: String,
    /// Direction in which it measures, counter-clockwise from +x.
    #[schemars(extend("default" = Sensor::default().direction.to_degrees()))]
    direction_deg: Option<f64>,
    /// Direction in which it measures, a vector along x, y and z of any length; instead of the angle.
    #[serde(deserialize_with = "triple")]
    direction: Option<[f64; 3]>,
    /// Its mass.
    mass_kg: f64,
    /// Stiffness of its mount.
    stiffness_n_m: f64,
    /// Damping of its mount.
    damping_n_s_m: f64,
    /// Modes of the structure between the outer ring and it.
    mode: Vec<SensorModeTable>,
    /// File of a measured frequency or impulse response, to which `brinell` fits the modes; instead of
    /// them.
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
    /// Gain of its velocity times its angular frequency; not 0 where points of the structure swing out of phase.
    #[serde(default)]
    quadrature_gain: f64,
}

/// Says by being there that displacements between the rings are wanted.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ProbeTable {}

impl SensorTable {
    pub(super) fn into_sensor(self) -> Result<Sensor, TableFault> {
        if let Some(file) = self.response {
            let both = (!self.mode.is_empty())
                .then_some(TableFault::Both { first: "sensor.response", second: "[[sensor.mode]]" });
            return Err(both.unwrap_or(TableFault::ResponseNotFitted(file)));
        }
        let mut sensor = Sensor {
            name: self.name,
            direction: self.direction_deg.map_or(Sensor::default().direction, f64::to_radians),
            elevation: 0.0,
            mass: self.mass_kg,
            stiffness: self.stiffness_n_m,
            damping: self.damping_n_s_m,
            modes: self.mode.into_iter().map(SensorModeTable::into_mode).collect(),
        };
        let (degrees, vector) = (self.direction_deg.is_some(), self.direction.is_some());
        only_one(&[("sensor.direction_deg", degrees), ("sensor.direction", vector)])?;
        match self.direction {
            Some([0.0, 0.0, 0.0]) => return Err(TableFault::Scene(SceneError::from(FreedomError::NoDirection))),
            Some(vector) => sensor.set_direction(vector),
            None => {}
        }
        Ok(sensor)
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
        let Sensor { name, mass, stiffness, damping, .. } = Sensor::default();
        Self {
            name,
            direction_deg: None,
            direction: None,
            mass_kg: mass,
            stiffness_n_m: stiffness,
            damping_n_s_m: damping,
            mode: Vec::new(),
            response: None,
        }
    }
}
