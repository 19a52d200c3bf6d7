//! What a user describes: one bearing, its surroundings and the run, in SI units and checked.
//!
//! A [`Scene`] that exists is possible: all that is made of it relies on that and checks nothing again. It is made in
//! Rust by [`Scene::builder`], of a TOML file by the crate `brinell-scene-file`, and in an FMU of the [`model_file`]
//! that was packed of it.

mod bearing;
mod builder;
mod cage;
mod check;
mod contact;
mod error;
mod messages;
pub mod model_file;
mod ring;
mod sensor;
mod surfaces;

pub use bearing::{
    Bearing, Crown, DegreesOfFreedom, DrawnDiameters, ElementInertia, Gyroscopic, Roller, RollerProfile, RollingElement,
};
pub use builder::SceneBuilder;
pub use cage::{Cage, CageIrregularity};
pub use check::{Remark, quantity};
pub use contact::{Contact, ContactEdge, ContactLaw, Damping, Film};
pub use error::{BearingError, DefectError, FreedomError, LONGEST_NAME, SceneError, WavinessError};
pub use messages::{Bound, Limits, Plain};
pub use ring::{AxialSupport, Motion, RepeatedInputs, Ring, TiltSupport};
pub use sensor::{MOST_SENSOR_MODES, MOST_SENSORS, Sensor, SensorMode};
pub use surfaces::{
    Defect, DefectLimit, DefectOn, DefectShape, Measured, MeasuredForm, MeasuredLevel, Waviness, WavyBody,
};

use serde::{Deserialize, Serialize};

/// One bearing in its surroundings. All quantities in SI units, all values checked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Name; letters, digits, `-` and `_`. Gives the file name of the FMU.
    pub name: String,
    /// One line for the reader.
    pub description: String,
    /// Gravity (m/s²), x and y.
    pub gravity: [f64; 2],
    /// Gravity (m/s²) along the bearing's axis, z.
    pub axial_gravity: f64,
    /// The bearing itself.
    pub bearing: Bearing,
    /// Contact law and damping.
    pub contact: Contact,
    /// The oil film; `None` for dry contacts.
    pub film: Option<Film>,
    /// The cage's kinematics.
    pub cage: Cage,
    /// The defects; none for a healthy bearing.
    pub defects: Vec<Defect>,
    /// Waves around bodies; none for round ones.
    pub waviness: Vec<Waviness>,
    /// The inner ring.
    pub shaft: Ring,
    /// Shaft speed (rad/s), the start value of the input `shaft.speed`.
    pub shaft_speed: f64,
    /// Angle of the inner ring at the start (rad).
    pub shaft_initial_angle: f64,
    /// The outer ring.
    pub housing: Ring,
    /// Speed of an outer ring that turns (rad/s), the start value of the input `housing.speed`; `None` for one that
    /// does not.
    pub housing_speed: Option<f64>,
    /// Angle of the outer ring at the start (rad).
    pub housing_initial_angle: f64,
    /// Accelerometers on the housing.
    pub sensors: Vec<Sensor>,
    /// Whether a probe measures the displacement between the rings.
    pub probe: bool,
    /// Relative tolerance of the time integration.
    pub tolerance: f64,
    /// Most integration steps in one communication step, after which it fails.
    pub max_steps: u64,
    /// The recorder inside the step; `None` for none.
    pub recorder: Option<Recorder>,
    /// What the inputs of hosted rings are when a step is repeated.
    pub repeated_inputs: RepeatedInputs,
    /// Default run.
    pub experiment: Experiment,
}

impl Scene {
    /// Whether contacts with the inner raceway meet a defect: of the inner ring or of an element.
    pub fn has_defect_inside(&self) -> bool {
        self.defects.iter().any(|defect| defect.on != DefectOn::Outer)
    }

    /// Whether contacts with the inner raceway meet waves: of the inner ring or of an element.
    pub fn is_wavy_inside(&self) -> bool {
        self.waviness.iter().any(|waves| waves.on != WavyBody::Outer)
    }

    /// Whether the inner ring has a defect or waves, so that it matters how it turns.
    pub fn marks_inner_ring(&self) -> bool {
        self.defects.iter().any(|defect| defect.on == DefectOn::Inner)
            || self.waviness.iter().any(|waves| waves.on == WavyBody::Inner)
    }

    /// The number of the first defect of an element, both from 0.
    pub fn first_defect_of(&self, element: usize) -> Option<usize> {
        self.defects.iter().position(|defect| matches!(defect.on, DefectOn::Element { element: j, .. } if j == element))
    }

    /// The profile files that defects name, each once, in the order of the defects; then that of the roller's crown.
    pub fn profile_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for defect in &self.defects {
            match &defect.shape {
                DefectShape::Profile(of) if !names.contains(&of.file.as_str()) => names.push(&of.file),
                _ => {}
            }
        }
        if let Some(Roller { profile: RollerProfile::Measured(crown), .. }) = self.bearing.roller()
            && !names.contains(&crown.name.as_str())
        {
            names.push(&crown.name);
        }
        names
    }

    /// Whether a ring that turns, or an element's spin, matters: for a defect or waves anywhere but on an outer ring at
    /// rest, and for an outer ring that turns.
    pub fn turns(&self) -> bool {
        self.has_defect_inside()
            || self.is_wavy_inside()
            || self.housing_speed.is_some()
            || self.housing_initial_angle != 0.0
    }

    /// The variable that shows what a sensor measures, by its number from 0: `sensor.acceleration` of one alone.
    pub fn sensor_variable(&self, number: usize) -> String {
        if self.sensors.len() > 1 {
            format!("sensor[{}].acceleration", number + 1)
        } else {
            "sensor.acceleration".to_owned()
        }
    }

    /// The C identifier of the scene's model: `Brinell_er16k_tb1` for the scene `er16k-tb1`. Hyphens, which a name may
    /// hold, become underscores, and the prefix keeps a leading digit inside.
    pub fn model_identifier(&self) -> String {
        format!("Brinell_{}", self.name.replace('-', "_"))
    }
}

/// A recorder of outputs inside the step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Recorder {
    /// Samples per second (Hz).
    pub rate: f64,
    /// What keeps aliases out.
    pub filter: RecorderFilter,
}

/// What the recorder does against aliases of what is faster than half its rate.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RecorderFilter {
    /// Accelerations and forces on rings are sampled much faster and filtered, without delay.
    #[default]
    LinearPhase,
    /// Nothing: every value is that of its instant.
    None,
}

/// Default run of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Experiment {
    /// Stop time (s).
    pub stop: f64,
    /// Communication step (s).
    pub step: f64,
}
