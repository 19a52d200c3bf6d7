//! What can be wrong with a scene. Each message gives the quantity with its key in the scene file, its value and the
//! limit.

mod bearing;
mod defect;
mod freedom;
mod waviness;

pub use bearing::BearingError;
pub use defect::DefectError;
pub use freedom::FreedomError;
pub use waviness::WavinessError;

use super::messages::{Limits, Plain};

/// Longest name of a scene or a sensor (bytes).
pub const LONGEST_NAME: usize = 64;

/// A scene that cannot exist.
///
/// Values are shown in the unit of the key, so that a reader finds in the file what the message speaks of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum SceneError {
    /// Several faults, each of which is there whatever becomes of the others.
    #[error("{} faults{}", .0.len(), lines(.0))]
    Several(Vec<SceneError>),
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
    /// Waviness that cannot be, or not in this bearing.
    #[error(transparent)]
    Waviness(#[from] WavinessError),
    /// Something that needs other degrees of freedom, or that these need.
    #[error(transparent)]
    Freedom(#[from] FreedomError),
    /// Something wrong with one of several tables of a name.
    #[error("[[{table}]] number {number}: {of}")]
    InTable { table: &'static str, number: usize, of: Box<SceneError> },
    /// A sensor's name that does not fit into a description.
    #[error("sensor name (sensor.name) {0:?}: at most {max} bytes without control characters", max = LONGEST_NAME)]
    SensorName(String),
    /// A quantity outside its limits, or not finite.
    #[error("{quantity} ({key}) is {}: it must be {limits}", Plain(*value))]
    OutOfRange { quantity: &'static str, key: &'static str, value: f64, limits: Limits },
    /// Offsets that are not one for each element.
    #[error("cage.spacing_deg has {found} values: it must have {count}, one for each element")]
    SpacingCount { found: usize, count: usize },
    /// Elements so far off even spacing that they would leave their pockets.
    #[error(
        "element {element} of the cage (cage.spacing_deg, cage.spacing_rms_deg, cage.jitter_rms_deg) is {offset_deg} \
         degrees off even spacing with a jitter of {jitter_deg} degrees: together they must be at most {limit_deg} \
         degrees, a quarter of the spacing"
    )]
    OffPocket { element: usize, offset_deg: f64, jitter_deg: f64, limit_deg: f64 },
    /// A load on a ring that does not move by itself.
    #[error("load on the {ring} ({ring}.load_n) is [{}, {}]: it must be [0, 0] unless {ring}.motion \
             is \"internal\"", load[0], load[1])]
    LoadNotInternal { ring: &'static str, load: [f64; 2] },
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
    StepBeyondStop { step: f64, stop: f64 },
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
    pub fn each(self) -> Vec<SceneError> {
        match self {
            Self::Several(all) => all,
            one => vec![one],
        }
    }
}

/// Each fault on a line of its own.
fn lines(faults: &[SceneError]) -> String {
    faults.iter().map(|fault| format!("\n  {}", fault)).collect()
}
