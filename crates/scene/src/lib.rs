//! What a user describes: one bearing, its surroundings and the run, in SI units and checked.
//!
//! A [`Scene`] that exists is possible: all that is made of it relies on that and checks nothing again.

mod bearing_error;
mod builder;
mod cage;
mod catalogue;
mod check;
mod check_defect;
mod check_roller;
mod defect;
mod defect_error;
mod error;
mod faults;
mod file;
mod key_fault;
mod limits;
mod plain;
mod quantity;
mod remark;
mod rolling_element;
mod sensor;
mod spelling;
mod toml_fault;
mod unit_hint;
mod usual;

pub use bearing_error::BearingError;
pub use builder::SceneBuilder;
use cage::centred;
pub use cage::{Cage, CageIrregularity};
pub use catalogue::{CatalogueBearing, Inside, catalogue, catalogued};
pub use defect::{Defect, DefectLimit, DefectOn, DefectShape};
pub use defect_error::DefectError;
pub use error::SceneError;
pub use key_fault::{Hint, KeyFault};
pub use limits::{Bound, Limits};
pub use plain::Plain;
pub use remark::Remark;
pub use rolling_element::{Crown, ElementInertia, Roller, RollerProfile, RollingElement};
pub use sensor::{MOST_SENSOR_MODES, MOST_SENSORS, Sensor, SensorMode};
pub use spelling::nearest;
pub use toml_fault::toml_fault;
pub use unit_hint::UnitQuestion;

use serde::Deserialize;

/// One bearing in its surroundings. All quantities in SI units, all values checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Name; letters, digits, `-` and `_`. Gives the file name of the FMU.
    pub name: String,
    /// One line for the reader.
    pub description: String,
    /// Gravity (m/s²), x and y.
    pub gravity: [f64; 2],
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
    /// Default run.
    pub experiment: Experiment,
}

impl Scene {
    /// Whether contacts with the inner raceway meet a defect: of the inner ring or of an element.
    pub fn has_defect_inside(&self) -> bool {
        self.defects.iter().any(|defect| defect.on != DefectOn::Outer)
    }

    /// Whether the inner ring bears a defect.
    pub fn has_defect_of_inner_ring(&self) -> bool {
        self.defects.iter().any(|defect| defect.on == DefectOn::Inner)
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
                DefectShape::Profile(name) if !names.contains(&name.as_str()) => names.push(name),
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

    /// Whether a ring that turns, or an element's spin, matters: for a defect anywhere but on an outer ring at rest,
    /// and for an outer ring that turns.
    pub fn turns(&self) -> bool {
        self.has_defect_inside() || self.housing_speed.is_some() || self.housing_initial_angle != 0.0
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

/// Dimensions and material of the bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// What rolls.
    pub element: RollingElement,
    /// Number of rolling elements Z.
    pub element_count: usize,
    /// Rolling element diameter D_w (m).
    pub element_diameter: f64,
    /// Pitch diameter D_pw (m).
    pub pitch_diameter: f64,
    /// Groove conformity of the inner ring f_i = r_gi/D_w, above 0.5; infinite with rollers, whose raceways are
    /// straight.
    pub conformity_inner: f64,
    /// Groove conformity of the outer ring f_o = r_go/D_w, above 0.5; infinite with rollers.
    pub conformity_outer: f64,
    /// Radial internal clearance G_r (m); negative is a preload.
    pub radial_clearance: f64,
    /// Young's modulus of rings and elements (Pa).
    pub youngs_modulus: f64,
    /// Poisson's ratio of rings and elements.
    pub poissons_ratio: f64,
    /// Density of the elements (kg/m³).
    pub density: f64,
    /// Mass of one element (kg), when it overrides the solid element's.
    pub element_mass: Option<f64>,
    /// Hertz constant of the inner contact (N/m^1.5), when it overrides the computed one.
    pub hertz_inner: Option<f64>,
    /// Hertz constant of the outer contact (N/m^1.5), when it overrides the computed one.
    pub hertz_outer: Option<f64>,
    /// Compliance in series with each outer contact (m/N): how far the outer raceway yields under an element, by the
    /// ring's and its seat's own deformation, for each newton that this element carries. 0 for a rigid assembly.
    pub outer_compliance: f64,
    /// Whether an element's mass resists its radial acceleration.
    pub element_inertia: ElementInertia,
}

impl Bearing {
    /// Radius of an element (m).
    pub fn element_radius(&self) -> f64 {
        0.5 * self.element_diameter
    }

    /// Radius of the outer raceway at the groove's bottom, R_o = (D_pw + D_w + G_r)/2 (m).
    pub fn outer_raceway_radius(&self) -> f64 {
        (self.pitch_diameter + self.element_diameter + self.radial_clearance) / 2.0
    }

    /// Radius of the inner raceway at the groove's bottom, R_i = (D_pw − D_w − G_r)/2 (m).
    pub fn inner_raceway_radius(&self) -> f64 {
        (self.pitch_diameter - self.element_diameter - self.radial_clearance) / 2.0
    }

    /// Mass of one element (kg): the scene's, or a solid ball's or roller's.
    pub fn mass_of_element(&self) -> f64 {
        self.element_mass.unwrap_or_else(|| self.element.volume(self.element_diameter) * self.density)
    }

    /// The roller; `None` of a ball bearing.
    pub fn roller(&self) -> Option<&Roller> {
        match &self.element {
            RollingElement::Ball => None,
            RollingElement::CylindricalRoller(roller) => Some(roller),
        }
    }
}

/// How forces in the contacts are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Law of the contacts near defects.
    pub law: ContactLaw,
    /// Contact damping.
    pub damping: Damping,
    /// Largest force on an element near the defect that laws `map` and `love` are prepared for (N); `None` to take it
    /// from the loads.
    pub largest_force: Option<f64>,
    /// Cells of the contact grid of laws `map` and `love` along and across Hertz's ellipse at the largest force; `None`
    /// for the usual ones.
    pub cells: Option<[u32; 2]>,
    /// Largest error of the contact map, relative to the largest force; `None` for the usual one.
    pub map_accuracy: Option<f64>,
    /// What laws `map` and `love` take a sharp edge to be.
    pub edge: ContactEdge,
}

/// What a sharp edge of a defect is taken to be.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ContactEdge {
    /// As stiff as the middle of a raceway.
    #[default]
    HalfSpace,
    /// As soft as a step of its depth.
    Step,
}

/// Law of the contacts near defects. On smooth raceways all three are Hertz's.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ContactLaw {
    /// The earlier model: Hertz against the rigid path of the element's centre.
    Hertz,
    /// Love's half-space through a potential computed beforehand.
    Map,
    /// Love's half-space solved on a grid inside the step.
    Love,
}

impl ContactLaw {
    /// All laws. The variable `contact.law` numbers them from 1 in this order.
    pub const ALL: [Self; 3] = [Self::Hertz, Self::Map, Self::Love];

    /// Its number in the variable `contact.law`.
    pub fn number(self) -> i32 {
        Self::ALL.iter().take_while(|&&law| law != self).count() as i32 + 1
    }

    /// The law of a number, if it is one's.
    pub fn numbered(number: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.number() == number)
    }

    /// Its name in a scene file, and what it is.
    pub const fn described(self) -> (&'static str, &'static str) {
        match self {
            Self::Hertz => ("hertz", "Hertz on the rigid path of the element's centre"),
            Self::Map => ("map", "Love's half-space through a potential computed beforehand"),
            Self::Love => ("love", "Love's half-space solved on a grid inside the step"),
        }
    }
}

/// Contact damping; never pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Damping {
    /// Q = Q_e · max(0, 1 + χ δ̇), with the elastic force Q_e(δ), of a ball Kδ^1.5, and χ (s/m).
    HuntCrossley(f64),
    /// Q = max(0, Q_e + τ Q_e′ δ̇), with τ (s).
    Proportional(f64),
}

/// Oil in the contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// Viscosity at the pressure of the surroundings (Pa s).
    pub viscosity: f64,
    /// How the viscosity's logarithm grows with pressure (1/Pa).
    pub pressure_viscosity: f64,
    /// Height up to which oil fills gaps (m); `None` for all of them.
    pub layer: Option<f64>,
}

/// Who moves a ring.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// The host prescribes position and velocity.
    Host,
    /// The ring has a mass and moves under the forces on it.
    Internal,
    /// The ring stands.
    Fixed,
}

/// A ring and its support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Who moves it.
    pub motion: Motion,
    /// External load (N), x and y: start value of the load inputs. This and what follows: zero unless `motion` is
    /// internal.
    pub load: [f64; 2],
    /// Mass (kg).
    pub mass: f64,
    /// Viscous damping to ground (N s/m).
    pub damping: f64,
    /// Stiffness to ground (N/m).
    pub stiffness: f64,
}

/// A recorder of outputs inside the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recorder {
    /// Samples per second (Hz).
    pub rate: f64,
    /// What keeps aliases out.
    pub filter: RecorderFilter,
}

/// What the recorder does against aliases of what is faster than half its rate.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RecorderFilter {
    /// Accelerations and forces on rings are sampled much faster and filtered, without delay.
    #[default]
    LinearPhase,
    /// Nothing: every value is that of its instant.
    None,
}

/// Default run of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Experiment {
    /// Stop time (s).
    pub stop: f64,
    /// Communication step (s).
    pub step: f64,
}
