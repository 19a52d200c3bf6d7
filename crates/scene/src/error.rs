//! What can be wrong with a scene. Each message gives the quantity with its key in the scene file, its value and the
//! limit.

use super::bearing_error::BearingError;
use super::defect_error::DefectError;
use super::key_fault::KeyFault;
use super::limits::Limits;
use super::plain::Plain;
use std::fmt;

/// Longest name of a scene.
pub(super) const LONGEST_NAME: usize = 64;

/// A scene that cannot be read or cannot exist.
///
/// Values are shown in the unit of the key, so that a reader finds in the file what the message speaks of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// Broken TOML. The message holds the parser's; it is no source that would be shown again.
    #[error("scene file: {0}")]
    Toml(toml::de::Error),
    /// Keys that are unknown, missing, or ask for what is not modelled, in the order of their lines.
    #[error("scene file: {}", super::key_fault::list(.0))]
    Keys(Vec<KeyFault>),
    /// Several faults, each of which is there whatever becomes of the others.
    #[error("{} faults{}", .0.len(), lines(.0))]
    Several(Vec<SceneError>),
    /// Two keys that exclude each other.
    #[error("scene file: {first} and {second} exclude each other: give only one")]
    Both {
        /// One key.
        first: &'static str,
        /// The other key.
        second: &'static str,
    },
    /// Neither of two keys of which one is needed.
    #[error("scene file: one of {first} and {second} is needed, neither is given")]
    Neither {
        /// One key.
        first: &'static str,
        /// The other key.
        second: &'static str,
    },
    /// A key that is needed because of what else the file says.
    #[error("scene file: {key} is missing: {why}")]
    Missing {
        /// The key.
        key: &'static str,
        /// Why it is needed.
        why: &'static str,
    },
    /// A key that has no meaning for a ring that does not move by itself.
    #[error("scene file: {key} = {value} has no effect while {ring}.motion is \"{motion}\": it needs \"internal\"")]
    NotInternal {
        /// Table of the ring.
        ring: &'static str,
        /// The key.
        key: String,
        /// The value given.
        value: String,
        /// The ring's motion.
        motion: super::Motion,
    },
    /// A constant of the damping model that was not chosen.
    #[error("scene file: {key} = {value} does not belong to contact.damping = \"{model}\", which takes {wanted}")]
    WrongDampingKey {
        /// The key given.
        key: &'static str,
        /// The value given.
        value: f64,
        /// The model chosen, or the default.
        model: &'static str,
        /// The key of that model.
        wanted: &'static str,
    },
    /// A name that cannot become a file name and a C identifier.
    #[error(
        "name \"{0}\": 1 to {max} characters, each an ASCII letter, a digit, - or _",
        max = LONGEST_NAME
    )]
    Name(String),
    /// A profile that is not a plain file name.
    #[error(
        "profile (defect.profile or bearing.roller_profile) \"{0}\": it must be the name of a file beside the scene \
         file, without a folder"
    )]
    ProfileName(String),
    /// A bearing that cannot exist.
    #[error(transparent)]
    Bearing(#[from] BearingError),
    /// A defect that cannot exist, or not in this bearing.
    #[error(transparent)]
    Defect(#[from] DefectError),
    /// Something wrong with one of several tables of a name.
    #[error("[[{table}]] number {number}: {of}")]
    InTable {
        /// "defect", "sensor" or "sensor.mode".
        table: &'static str,
        /// Its number in the scene file, from 1.
        number: usize,
        /// What is wrong with it.
        of: Box<SceneError>,
    },
    /// A sensor's frequency or impulse response to which no modes have been fitted.
    #[error(
        "sensor.response = {0:?}: modes are fitted to it by the program brinell; read from Rust, a scene gives them as \
         [[sensor.mode]]"
    )]
    ResponseNotFitted(String),
    /// A sensor's name that does not fit into a description.
    #[error("sensor name (sensor.name) {0:?}: at most {max} bytes without control characters", max = LONGEST_NAME)]
    SensorName(String),
    /// A quantity outside its limits, or not finite.
    #[error("{quantity} ({key}) is {}: it must be {limits}", Plain(*value))]
    OutOfRange {
        /// The field's term for it.
        quantity: &'static str,
        /// Its key, or keys, in the scene file.
        key: &'static str,
        /// Its value in the unit of the key.
        value: f64,
        /// What it may be, in the same unit.
        limits: Limits,
    },
    /// Offsets that are not one for each element.
    #[error("cage.spacing_deg has {found} values: it must have {count}, one for each element")]
    SpacingCount {
        /// Values given.
        found: usize,
        /// Number of elements.
        count: usize,
    },
    /// Elements so far off even spacing that they would leave their pockets.
    #[error(
        "element {element} of the cage (cage.spacing_deg, cage.spacing_rms_deg, cage.jitter_rms_deg) is {offset_deg} \
         degrees off even spacing with a jitter of {jitter_deg} degrees: together they must be at most {limit_deg} \
         degrees, a quarter of the spacing"
    )]
    OffPocket {
        /// Its number, from 1.
        element: usize,
        /// Offset (°).
        offset_deg: f64,
        /// Root mean square of the jitter (°).
        jitter_deg: f64,
        /// Limit (°).
        limit_deg: f64,
    },
    /// A load on a ring that does not move by itself.
    #[error("load on the {ring} ({ring}.load_n) is [{}, {}]: it must be [0, 0] unless {ring}.motion \
             is \"internal\"", load[0], load[1])]
    LoadNotInternal {
        /// Table of the ring.
        ring: &'static str,
        /// The load (N).
        load: [f64; 2],
    },
    /// Two free rings, so that no load has an equilibrium.
    #[error(
        "stiffness to ground (shaft.stiffness_n_m, housing.stiffness_n_m) is 0 for both rings: where both move by \
         themselves, one must be above 0 or nothing holds the bearing"
    )]
    NothingHolds,
    /// An accelerometer on a ring that stands.
    #[error("sensor: it would measure nothing while housing.motion is \"fixed\", it needs \"internal\" or \"host\"")]
    SensorOnFixedHousing,
    /// A communication step longer than the run.
    #[error(
        "communication step (experiment.step_s) is {step}: it must be at most {stop}, the stop time (experiment.stop_s)"
    )]
    StepBeyondStop {
        /// Communication step (s).
        step: f64,
        /// Stop time (s).
        stop: f64,
    },
}

impl SceneError {
    /// This error of the table of a name and number, from 0, said to belong to it where there are several.
    pub(super) fn in_table(self, table: &'static str, index: usize, count: usize) -> Self {
        match self {
            Self::Several(all) => Self::Several(all.into_iter().map(|of| of.in_table(table, index, count)).collect()),
            of if count > 1 => Self::InTable { table, number: index + 1, of: Box::new(of) },
            of => of,
        }
    }

    /// The faults one by one.
    pub(super) fn each(self) -> Vec<SceneError> {
        match self {
            Self::Several(all) => all,
            one => vec![one],
        }
    }

    /// Whether it follows from the bearing's dimensions, so that it means nothing where those are not known.
    pub(super) fn is_of_dimensions(&self) -> bool {
        match self {
            Self::InTable { of, .. } => of.is_of_dimensions(),
            Self::OutOfRange { key, .. } => key.contains(" or ") || *key == "bearing.element_mass_g",
            Self::Bearing(of) => of.is_of_dimensions(),
            Self::Defect(of) => of.is_of_dimensions(),
            _ => matches!(self, Self::SpacingCount { .. } | Self::OffPocket { .. }),
        }
    }

    /// The message without the words that a list of faults of the file begins with.
    pub(super) fn in_list(&self) -> String {
        let said = self.to_string();
        said.strip_prefix("scene file: ").map_or(said.clone(), str::to_owned)
    }
}

/// Each fault on a line of its own.
fn lines(faults: &[SceneError]) -> String {
    faults.iter().map(|fault| format!("\n  {}", fault.in_list())).collect()
}

impl fmt::Display for super::Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Host => "host",
            Self::Internal => "internal",
            Self::Fixed => "fixed",
        })
    }
}
