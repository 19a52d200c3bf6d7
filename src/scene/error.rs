//! What can be wrong with a scene. Each message gives the quantity with its key in the scene file, its value and the
//! limit.

use super::catalogue::catalogue;
use super::key_fault::KeyFault;
use super::limits::Limits;
use super::spelling::nearest;
use std::fmt;

/// Longest name of a scene.
pub(super) const LONGEST_NAME: usize = 64;

/// A scene that cannot be read or cannot exist.
///
/// Values are shown in the unit of the key, so that a reader finds in the file what the message speaks of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// Broken TOML, or a value of the wrong type. The message holds the parser's; it is no source that would be shown
    /// again.
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
        "profile (defect.profile or bearing.roller_profile) \"{0}\": it must be the name of a file beside the scene file, \
         without a folder"
    )]
    ProfileName(String),
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
        "sensor.response = {0:?}: modes are fitted to it by the program brinell; read from Rust, a scene gives them as [[sensor.mode]]"
    )]
    ResponseNotFitted(String),
    /// A sensor's name that does not fit into a description.
    #[error("sensor name (sensor.name) {0:?}: at most {max} bytes without control characters", max = LONGEST_NAME)]
    SensorName(String),
    /// A quantity outside its limits, or not finite.
    #[error("{quantity} ({key}) is {value}: it must be {limits}")]
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
    /// A groove in which the element does not fit.
    #[error(
        "groove conformity of the {ring} ring (bearing.groove_diameter_mm/2 over bearing.element_diameter_mm, or \
         bearing.conformity_{ring}) is {conformity}: it must be at least {limit}, at 0.5 the groove is as narrow as the element"
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
        "{key} is given: only balls have it, and bearing.element is \"cylindrical-roller\", whose raceways are straight \
         and whose contacts are lines"
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
        "[film] is given and bearing.element_inertia is \"none\": a film resists the speed of an element that its inertia \
         keeps in motion; with films bearing.element_inertia must be \"full\""
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
        /// Length [mm].
        length_mm: f64,
        /// Smallest length [mm].
        low_mm: f64,
        /// Largest length [mm].
        high_mm: f64,
    },
    /// Rollers of another material than steel.
    #[error(
        "{quantity} ({key}) is {value}: with cylindrical rollers it must be {limits}, as of steel, on which their contact law \
         was measured"
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
        "contact.law is \"{law}\": a roller with a measured crown (bearing.roller_profile \"{name}\") has \"hertz\" near a \
         defect; grids and maps are of rollers that are \"log\" or \"straight\", so far"
    )]
    CrownLaw {
        /// The law.
        law: &'static str,
        /// File of the crown.
        name: String,
    },
    /// A defect off the track of a roller, whose track is as wide as the roller.
    #[error("defect.tilt_deg is {tilt_deg}: it must be 0 on a roller, which touches over its whole length")]
    TiltOnRoller {
        /// Tilt [°].
        tilt_deg: f64,
    },
    /// More or larger elements than the pitch circle holds.
    #[error(
        "element diameter (bearing.element_diameter_mm) is {diameter_mm}: {count} elements on a pitch circle of \
         {pitch_diameter_mm} mm (bearing.pitch_diameter_mm) overlap above {limit_mm} mm"
    )]
    ElementsOverlap {
        /// Number of elements.
        count: usize,
        /// Element diameter [mm].
        diameter_mm: f64,
        /// Pitch diameter [mm].
        pitch_diameter_mm: f64,
        /// Largest diameter that fits [mm].
        limit_mm: f64,
    },
    /// An inner raceway without a radius.
    #[error(
        "pitch diameter (bearing.pitch_diameter_mm) is {pitch_diameter_mm}: it must be above {limit_mm}, the element diameter \
         and the radial clearance together, or no inner raceway is left"
    )]
    NoInnerRaceway {
        /// Pitch diameter [mm].
        pitch_diameter_mm: f64,
        /// What it must exceed [mm].
        limit_mm: f64,
    },
    /// A preload that squeezes the elements beyond what the model describes.
    #[error(
        "radial clearance (bearing.radial_clearance_um) is {clearance_um}: below {limit_um} inner groove, element and outer \
         groove overlap by more than the contacts can take elastically; bearing.internal_clearance_um is twice as much"
    )]
    NoRoom {
        /// Clearance [µm].
        clearance_um: f64,
        /// Smallest clearance [µm].
        limit_um: f64,
    },
    /// A clearance from which the elements fall.
    #[error(
        "radial clearance (bearing.radial_clearance_um) is {clearance_um}: it must be at most {limit_um}, the radius \
         of an element; bearing.internal_clearance_um is twice as much"
    )]
    TooLoose {
        /// Clearance [µm].
        clearance_um: f64,
        /// Largest clearance [µm].
        limit_um: f64,
    },
    /// A spall as long as the raceway or longer.
    #[error(
        "spall length (defect.length_deg or defect.length_mm) is {length_mm} mm: it must be below {limit_mm} mm, \
         {limit}"
    )]
    SpallTooLong {
        /// Length [mm].
        length_mm: f64,
        /// Limit [mm].
        limit_mm: f64,
        /// What that is.
        limit: &'static str,
    },
    /// A spall into which no element sinks.
    #[error(
        "spall length (defect.length_deg or defect.length_mm) is {length_mm} mm: it must be at least {limit_mm} mm, a \
         thousandth of the element's diameter, or no element sinks into it"
    )]
    SpallTooShort {
        /// Length [mm].
        length_mm: f64,
        /// Limit [mm].
        limit_mm: f64,
    },
    /// A spall as deep as the element's radius or deeper.
    #[error("spall depth (defect.depth_um) is {depth_um}: it must be below {limit_um}, {limit}")]
    SpallTooDeep {
        /// Depth [µm].
        depth_um: f64,
        /// Limit [µm].
        limit_um: f64,
        /// What that is.
        limit: &'static str,
    },
    /// A defect of an element that the bearing does not have.
    #[error("defect.element is {element}: the bearing has elements 1 to {count}")]
    NoSuchElement {
        /// Number given, from 1.
        element: i64,
        /// Number of elements.
        count: usize,
    },
    /// A pit so far off the rolling track that the track does not cross it.
    #[error(
        "defect length (defect.length_mm) is {length_mm}: at this defect.tilt_deg the rolling track crosses a pit only if \
         it is more than {limit_mm} across"
    )]
    PitNotMet {
        /// Diameter [mm].
        length_mm: f64,
        /// Diameter at which its rim touches the track [mm].
        limit_mm: f64,
    },
    /// A measured profile off the rolling track.
    #[error(
        "defect.tilt_deg is {tilt_deg}: it must be 0 with defect.profile, which is measured along the rolling track"
    )]
    TiltedProfile {
        /// Tilt [°].
        tilt_deg: f64,
    },
    /// A key that belongs to a defect of an element.
    #[error("{key} is {value}: only a defect with defect.on = \"element\" has it")]
    NotOnElement {
        /// The key.
        key: &'static str,
        /// What was given.
        value: f64,
    },
    /// Offsets that are not one for each element.
    #[error("cage.spacing_deg has {found} values: it must have {count}, one for each element")]
    SpacingCount {
        /// Values given.
        found: usize,
        /// Number of elements.
        count: usize,
    },
    /// Elements so far off their places that they would leave their pockets.
    #[error(
        "element {element} of the cage (cage.spacing_deg, cage.spacing_rms_deg, cage.jitter_rms_deg) is {offset_deg} degrees \
         off even spacing with a jitter of {jitter_deg} degrees: together they must be at most {limit_deg} degrees, a \
         quarter of the spacing"
    )]
    OffPocket {
        /// Its number, from 1.
        element: usize,
        /// Offset [°].
        offset_deg: f64,
        /// Root mean square of the jitter [°].
        jitter_deg: f64,
        /// Limit [°].
        limit_deg: f64,
    },
    /// Flanks that meet before they reach the floor.
    #[error(
        "spall depth (defect.depth_um) is {depth_um}: flanks of {edge_slope_deg} degrees (defect.edge_slope_deg) meet at \
         {limit_um} um in a spall of {length_mm} mm"
    )]
    FlanksMeet {
        /// Depth [µm].
        depth_um: f64,
        /// Steepness of the flanks [°].
        edge_slope_deg: f64,
        /// Depth at which they meet [µm].
        limit_um: f64,
        /// Length [mm].
        length_mm: f64,
    },
    /// A softness of edges that the law knows nothing of.
    #[error(
        "contact.edge is \"step\" and contact.law is \"hertz\" (the default without a defect), which knows no edges: it \
         needs \"map\" or \"love\""
    )]
    EdgeOfHertz,
    /// A load on a ring that does not move by itself.
    #[error("load on the {ring} ({ring}.load_n) is [{}, {}]: it must be [0, 0] unless {ring}.motion is \"internal\"", load[0], load[1])]
    LoadNotInternal {
        /// Table of the ring.
        ring: &'static str,
        /// The load [N].
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
        /// Communication step [s].
        step: f64,
        /// Stop time [s].
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
            _ => matches!(
                self,
                Self::GrooveTooNarrow { .. }
                    | Self::RollerLength { .. }
                    | Self::ElementsOverlap { .. }
                    | Self::NoInnerRaceway { .. }
                    | Self::NoRoom { .. }
                    | Self::TooLoose { .. }
                    | Self::SpallTooLong { .. }
                    | Self::SpallTooShort { .. }
                    | Self::SpallTooDeep { .. }
                    | Self::NoSuchElement { .. }
                    | Self::PitNotMet { .. }
                    | Self::SpacingCount { .. }
                    | Self::OffPocket { .. }
                    | Self::FlanksMeet { .. }
            ),
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

fn known_bearings() -> String {
    catalogue().map(|bearing| bearing.designation).collect::<Vec<_>>().join(", ")
}

fn meant(name: &str) -> String {
    let near = nearest(catalogue().map(|bearing| bearing.designation), name);
    near.map_or_else(String::new, |near| format!(" (did you mean {near}?)"))
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
