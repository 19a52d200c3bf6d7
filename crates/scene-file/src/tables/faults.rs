//! Why tables are no scene: keys that contradict each other, and all that the check of a scene refuses.

use crate::NotInCatalogue;
use crate::rivals::exclude_each_other;
use crate::spelling::nearest;
use brinell::scene::{BearingError, DefectError, DegreesOfFreedom, FreedomError, Motion, SceneError, WavinessError};
use std::error::Error;

/// One reason. Messages name keys with their tables, by which their lines are looked up.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(crate) enum TableFault {
    #[error("{first} and {second} exclude each other: give only one")]
    Both { first: &'static str, second: &'static str },
    #[error("one of {first} and {second} is needed, neither is given")]
    Neither { first: &'static str, second: &'static str },
    #[error("{key} is missing: {why}")]
    Missing { key: &'static str, why: &'static str },
    #[error("{key} = {value} has no effect while {ring}.motion is \"{motion}\": it needs \"internal\"")]
    NotInternal { ring: &'static str, key: String, value: String, motion: Motion },
    #[error(
        "{key} = {value} has no effect with bearing.degrees_of_freedom = {}: it needs {}",
        given.count(),
        if *least == DegreesOfFreedom::Five { "5" } else { "3 or 5" }
    )]
    NeedsFreedom { key: String, value: String, least: DegreesOfFreedom, given: DegreesOfFreedom },
    #[error("{key} = {value} does not belong to contact.damping = \"{model}\", which takes {wanted}")]
    WrongDampingKey { key: &'static str, value: f64, model: &'static str, wanted: &'static str },
    #[error(
        "sensor.response = {0:?}: modes are fitted to it by the program brinell; read from Rust, a scene gives them as \
         [[sensor.mode]]"
    )]
    ResponseNotFitted(String),
    #[error("[host] has no effect: neither shaft.motion nor housing.motion is \"host\"")]
    NoHost,
    #[error(transparent)]
    NotInCatalogue(#[from] NotInCatalogue),
    #[error("bearing.catalogue = \"{name}\" has {elements}: bearing.element says otherwise")]
    OtherElements { name: &'static str, elements: &'static str },
    #[error(
        "bearing.catalogue = \"{name}\" has a contact angle of {angle} degrees: it needs \
         bearing.degrees_of_freedom = 3 or 5"
    )]
    AngularInPlane { name: &'static str, angle: f64 },
    #[error("{key} is given: only rollers have it, and bearing.element is \"ball\"; it may be \"cylindrical-roller\"")]
    OnlyRollers { key: &'static str },
    #[error(
        "bearing.roller_profile is \"{given}\": it must be \"log\", \"straight\", or the name of a .csv file{}",
        nearest(["log", "straight"], given).map_or(String::new(), |word| format!("; did you mean \"{word}\"?"))
    )]
    RollerProfile { given: String },
    #[error("{key} is {value}: only a {0} with {0}.on = \"element\" has it", key.split('.').next().unwrap_or_default())]
    NotOnElement { key: &'static str, value: f64 },
    #[error("[[{table}]] number {number}: {of}")]
    InTable { table: &'static str, number: usize, of: Box<TableFault> },
    #[error(transparent)]
    Scene(SceneError),
}

impl TableFault {
    /// Whether it follows from the bearing's dimensions, so that it means nothing where those are not known.
    pub(crate) fn is_of_dimensions(&self) -> bool {
        match self {
            Self::InTable { of, .. } => of.is_of_dimensions(),
            Self::Scene(of) => is_of_dimensions(of),
            _ => false,
        }
    }

    /// The fault itself, and the numbers from 0 of its table among those of its name, the outer one's first.
    pub(crate) fn in_tables(&self) -> ([usize; 2], &(dyn Error + 'static)) {
        let mut number = [0; 2];
        let mut keep = |table: &str, of: usize| number[usize::from(table.contains('.'))] = of.saturating_sub(1);
        let mut fault = self;
        while let Self::InTable { table, number, of } = fault {
            keep(table, *number);
            fault = of;
        }
        let Self::Scene(error) = fault else { return (number, fault) };
        let mut error = error;
        while let SceneError::InTable { table, number, of } = error {
            keep(table, *number);
            error = of;
        }
        (number, error)
    }
}

fn is_of_dimensions(error: &SceneError) -> bool {
    match error {
        SceneError::InTable { of, .. } => is_of_dimensions(of),
        SceneError::OutOfRange { key, .. } => key.contains(" or ") || *key == "bearing.element_mass_g",
        SceneError::Bearing(of) => matches!(
            of,
            BearingError::GrooveTooNarrow { .. }
                | BearingError::RollerLength { .. }
                | BearingError::ElementsOverlap { .. }
                | BearingError::NoInnerRaceway { .. }
                | BearingError::NoRoom { .. }
                | BearingError::TooLoose { .. }
                | BearingError::DiameterCount { .. }
                | BearingError::TooUnequal { .. }
                | BearingError::UnequalElement { .. }
        ),
        SceneError::Freedom(of) => matches!(
            of,
            FreedomError::OpenGroove { .. }
                | FreedomError::TooSteep { .. }
                | FreedomError::AxialPlay { .. }
                | FreedomError::AngleAndClearance { .. }
                | FreedomError::ShoulderTooHigh { .. }
        ),
        SceneError::Defect(of) => matches!(
            of,
            DefectError::SpallTooLong { .. }
                | DefectError::SpallTooShort { .. }
                | DefectError::SpallTooDeep { .. }
                | DefectError::NoSuchElement { .. }
                | DefectError::PitNotMet { .. }
                | DefectError::FlanksMeet { .. }
        ),
        SceneError::Waviness(of) => matches!(
            of,
            WavinessError::NoSuchElement { .. } | WavinessError::TooSteep { .. } | WavinessError::TooCurved { .. }
        ),
        _ => matches!(error, SceneError::SpacingCount { .. } | SceneError::OffPocket { .. }),
    }
}

/// Refuses two keys that exclude each other; of each key whether it is given.
pub(super) fn only_one(keys: &[(&'static str, bool)]) -> Result<(), TableFault> {
    let given: Vec<&'static str> = keys.iter().filter(|(_, is_given)| *is_given).map(|(key, _)| *key).collect();
    for (index, first) in given.iter().enumerate() {
        if let Some(second) = given[index..].iter().find(|second| exclude_each_other(first, second)) {
            return Err(TableFault::Both { first, second });
        }
    }
    Ok(())
}

/// All that is wrong: a reader mends it at once, not one fault after the other.
#[derive(Debug, Default)]
pub(crate) struct Faults(pub(crate) Vec<TableFault>);

impl Faults {
    /// What there is, or keeps why there is nothing.
    pub(super) fn take<T>(&mut self, found: Result<T, impl Into<Self>>) -> Option<T> {
        found.map_err(|faults| self.0.extend(faults.into().0)).ok()
    }

    /// An error where there was a fault.
    pub(super) fn into_result(self) -> Result<(), Self> {
        if self.0.is_empty() { Ok(()) } else { Err(self) }
    }

    /// The same of the table of a name and number, from 0; the message says so where there are several.
    pub(super) fn in_table(self, table: &'static str, index: usize, count: usize) -> Self {
        let of = |of| TableFault::InTable { table, number: index + 1, of: Box::new(of) };
        if count > 1 { Self(self.0.into_iter().map(of).collect()) } else { self }
    }
}

impl From<TableFault> for Faults {
    fn from(fault: TableFault) -> Self {
        Self(vec![fault])
    }
}

impl From<SceneError> for Faults {
    fn from(error: SceneError) -> Self {
        Self(error.each().into_iter().map(TableFault::Scene).collect())
    }
}
