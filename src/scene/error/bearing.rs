//! What can be wrong with a bearing: dimensions that do not fit together, quantities of another kind of element.

use super::SceneError;
use crate::scene::messages::Limits;

/// A bearing that cannot exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum BearingError {
    /// A groove in which the element does not fit.
    #[error(
        "groove conformity of the {ring} ring (bearing.groove_diameter_mm/2 over bearing.element_diameter_mm, or \
         bearing.conformity_{ring}) is {conformity}: it must be at least {limit}, at 0.5 the groove is as narrow as \
         the element"
    )]
    GrooveTooNarrow { ring: &'static str, conformity: f64, limit: f64 },
    /// A key of balls in a roller bearing.
    #[error(
        "{key} is given: only balls have it, and bearing.element is \"cylindrical-roller\", whose raceways are \
         straight and whose contacts are lines"
    )]
    OnlyBalls { key: &'static str },
    /// Something that is worked out for balls only, asked of rollers.
    #[error("{key}: it is worked out for balls only, and bearing.element is \"cylindrical-roller\"")]
    NotOfRollers { key: &'static str },
    /// Oil films between elements that have no inertia.
    #[error(
        "[film] is given and bearing.element_inertia is \"none\": a film resists the speed of an element that its \
         inertia keeps in motion; with films bearing.element_inertia must be \"full\""
    )]
    FilmWithoutInertia,
    /// A roller so short or so long that its law does not hold.
    #[error(
        "effective roller length (bearing.roller_length_mm) is {length_mm}: it must be at least {low_mm} and at most \
         {high_mm} mm, 0.3 and 3 times bearing.element_diameter_mm, for cylindrical rollers; needle rollers bend"
    )]
    RollerLength { length_mm: f64, low_mm: f64, high_mm: f64 },
    /// Raceways of rollers of another material than steel.
    #[error(
        "{quantity} ({key}) is {value}: with cylindrical rollers it must be {limits}, as of steel, on which their \
         contact law was measured; rollers of another material have bearing.element_youngs_modulus_gpa"
    )]
    NotSteel { quantity: &'static str, key: &'static str, value: f64, limits: Limits },
    /// A measured crown near a defect, under a law that solves grids.
    #[error(
        "contact.law is \"{law}\": a roller with a measured crown (bearing.roller_profile \"{name}\") has \"hertz\" \
         near a defect; grids and maps are of rollers that are \"log\" or \"straight\", so far"
    )]
    CrownLaw { law: &'static str, name: String },
    /// More or larger elements than the pitch circle holds.
    #[error(
        "element diameter (bearing.element_diameter_mm) is {diameter_mm}: {count} elements on a pitch circle of \
         {pitch_diameter_mm} mm (bearing.pitch_diameter_mm) overlap above {limit_mm} mm"
    )]
    ElementsOverlap { count: usize, diameter_mm: f64, pitch_diameter_mm: f64, limit_mm: f64 },
    /// An inner raceway without a radius.
    #[error(
        "pitch diameter (bearing.pitch_diameter_mm) is {pitch_diameter_mm}: it must be above {limit_mm}, the element \
         diameter and the radial clearance together, or no inner raceway is left"
    )]
    NoInnerRaceway { pitch_diameter_mm: f64, limit_mm: f64 },
    /// A preload that squeezes the elements beyond what the model describes.
    #[error(
        "radial clearance (bearing.radial_clearance_um) is {clearance_um}: below {limit_um} inner groove, element and \
         outer groove overlap by more than the contacts can take elastically; bearing.internal_clearance_um is twice \
         as much"
    )]
    NoRoom { clearance_um: f64, limit_um: f64 },
    /// Diameters that are not one for each element.
    #[error("bearing.element_diameter_offsets_um has {found} values: it must have {count}, one for each element")]
    DiameterCount { found: usize, count: usize },
    /// An element far larger or smaller than the others.
    #[error(
        "diameter of element {element} beyond the nominal one (bearing.element_diameter_offsets_um, \
         bearing.element_diameter_rms_um) is {offset_um}: it must be at most {limit_um} in size, a thousandth of \
         bearing.element_diameter_mm"
    )]
    TooUnequal { element: usize, offset_um: f64, limit_um: f64 },
    /// An element that does not fit where a nominal one does.
    #[error(
        "element {element}, {offset_um} um larger than bearing.element_diameter_mm \
         (bearing.element_diameter_offsets_um, bearing.element_diameter_rms_um), does not fit: {of}"
    )]
    UnequalElement { element: usize, offset_um: f64, of: Box<SceneError> },
    /// Elements of unequal size between grooves at a contact angle.
    #[error(
        "bearing.element_diameter_offsets_um or bearing.element_diameter_rms_um is given: it needs \
         bearing.degrees_of_freedom 2, and there are {given}; unequal elements at a contact angle are not modelled, \
         so far"
    )]
    UnequalInSpace { given: usize },
    /// A clearance from which the elements fall.
    #[error(
        "radial clearance (bearing.radial_clearance_um) is {clearance_um}: it must be at most {limit_um}, the radius \
         of an element; bearing.internal_clearance_um is twice as much"
    )]
    TooLoose { clearance_um: f64, limit_um: f64 },
}
