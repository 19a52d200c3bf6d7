//! What can be wrong with a bearing: dimensions that do not fit together, keys of another kind of element.

use super::catalogue::catalogue;
use super::limits::Limits;
use super::spelling::nearest;

/// A bearing that cannot exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BearingError {
    /// A groove in which the element does not fit.
    #[error(
        "groove conformity of the {ring} ring (bearing.groove_diameter_mm/2 over bearing.element_diameter_mm, or \
         bearing.conformity_{ring}) is {conformity}: it must be at least {limit}, at 0.5 the groove is as narrow as \
         the element"
    )]
    GrooveTooNarrow {
        /// "inner" or "outer".
        ring: &'static str,
        /// Groove radius over element diameter.
        conformity: f64,
        /// Smallest conformity.
        limit: f64,
    },
    /// A name that is not in the catalogue.
    #[error("bearing.catalogue = {name:?} is not in the catalogue{}, which has {}", meant(name), known_bearings())]
    NotInCatalogue {
        /// The name given.
        name: String,
    },
    /// A bearing of the catalogue with other elements than asked for.
    #[error("bearing.catalogue = \"{name}\" has {elements}: bearing.element says otherwise")]
    OtherElements {
        /// The bearing's name.
        name: &'static str,
        /// What it has.
        elements: &'static str,
    },
    /// A key of rollers in a ball bearing.
    #[error("{key} is given: only rollers have it, and bearing.element is \"ball\"; it may be \"cylindrical-roller\"")]
    OnlyRollers {
        /// The key.
        key: &'static str,
    },
    /// A key of balls in a roller bearing.
    #[error(
        "{key} is given: only balls have it, and bearing.element is \"cylindrical-roller\", whose raceways are \
         straight and whose contacts are lines"
    )]
    OnlyBalls {
        /// The key.
        key: &'static str,
    },
    /// Something that is worked out for balls only, asked of rollers.
    #[error("{key}: it is worked out for balls only, and bearing.element is \"cylindrical-roller\"")]
    NotOfRollers {
        /// The key, with its value where that is a word.
        key: &'static str,
    },
    /// Oil films between elements that have no inertia.
    #[error(
        "[film] is given and bearing.element_inertia is \"none\": a film resists the speed of an element that its \
         inertia keeps in motion; with films bearing.element_inertia must be \"full\""
    )]
    FilmWithoutInertia,
    /// A relief of a roller's ends that is not known.
    #[error(
        "bearing.roller_profile is \"{given}\": it must be \"log\", \"straight\", or the name of a .csv file{}",
        nearest(["log", "straight"], given).map_or(String::new(), |word| format!("; did you mean \"{word}\"?"))
    )]
    RollerProfile {
        /// What was given.
        given: String,
    },
    /// A roller so short or so long that its law does not hold.
    #[error(
        "effective roller length (bearing.roller_length_mm) is {length_mm}: it must be at least {low_mm} and at most \
         {high_mm} mm, 0.3 and 3 times bearing.element_diameter_mm, for cylindrical rollers; needle rollers bend"
    )]
    RollerLength {
        /// Length (mm).
        length_mm: f64,
        /// Smallest length (mm).
        low_mm: f64,
        /// Largest length (mm).
        high_mm: f64,
    },
    /// Rollers of another material than steel.
    #[error(
        "{quantity} ({key}) is {value}: with cylindrical rollers it must be {limits}, as of steel, on which their \
         contact law was measured"
    )]
    NotSteel {
        /// The field's term for it.
        quantity: &'static str,
        /// Its key.
        key: &'static str,
        /// Its value in the unit of the key.
        value: f64,
        /// What it may be, in the same unit.
        limits: Limits,
    },
    /// A measured crown near a defect, under a law that solves grids.
    #[error(
        "contact.law is \"{law}\": a roller with a measured crown (bearing.roller_profile \"{name}\") has \"hertz\" \
         near a defect; grids and maps are of rollers that are \"log\" or \"straight\", so far"
    )]
    CrownLaw {
        /// The law.
        law: &'static str,
        /// File of the crown.
        name: String,
    },
    /// More or larger elements than the pitch circle holds.
    #[error(
        "element diameter (bearing.element_diameter_mm) is {diameter_mm}: {count} elements on a pitch circle of \
         {pitch_diameter_mm} mm (bearing.pitch_diameter_mm) overlap above {limit_mm} mm"
    )]
    ElementsOverlap {
        /// Number of elements.
        count: usize,
        /// Element diameter (mm).
        diameter_mm: f64,
        /// Pitch diameter (mm).
        pitch_diameter_mm: f64,
        /// Largest diameter that fits (mm).
        limit_mm: f64,
    },
    /// An inner raceway without a radius.
    #[error(
        "pitch diameter (bearing.pitch_diameter_mm) is {pitch_diameter_mm}: it must be above {limit_mm}, the element \
         diameter and the radial clearance together, or no inner raceway is left"
    )]
    NoInnerRaceway {
        /// Pitch diameter (mm).
        pitch_diameter_mm: f64,
        /// What it must exceed (mm).
        limit_mm: f64,
    },
    /// A preload that squeezes the elements beyond what the model describes.
    #[error(
        "radial clearance (bearing.radial_clearance_um) is {clearance_um}: below {limit_um} inner groove, element and \
         outer groove overlap by more than the contacts can take elastically; bearing.internal_clearance_um is twice \
         as much"
    )]
    NoRoom {
        /// Clearance (µm).
        clearance_um: f64,
        /// Smallest clearance (µm).
        limit_um: f64,
    },
    /// A clearance from which the elements fall.
    #[error(
        "radial clearance (bearing.radial_clearance_um) is {clearance_um}: it must be at most {limit_um}, the radius \
         of an element; bearing.internal_clearance_um is twice as much"
    )]
    TooLoose {
        /// Clearance (µm).
        clearance_um: f64,
        /// Largest clearance (µm).
        limit_um: f64,
    },
}

impl BearingError {
    /// Whether it follows from the bearing's dimensions, so that it means nothing where those are not known.
    pub(super) fn is_of_dimensions(&self) -> bool {
        matches!(
            self,
            Self::GrooveTooNarrow { .. }
                | Self::RollerLength { .. }
                | Self::ElementsOverlap { .. }
                | Self::NoInnerRaceway { .. }
                | Self::NoRoom { .. }
                | Self::TooLoose { .. }
        )
    }
}

fn known_bearings() -> String {
    catalogue().map(|bearing| bearing.designation).collect::<Vec<_>>().join(", ")
}

fn meant(name: &str) -> String {
    let near = nearest(catalogue().map(|bearing| bearing.designation), name);
    near.map_or_else(String::new, |near| format!(" (did you mean {near}?)"))
}
