//! The table `[bearing]`: dimensions and material, or a catalogue's name instead of them.

use super::diameters::Diameters;
use super::faults::{Faults, TableFault};
use crate::catalogue::{CatalogueBearing, NotInCatalogue, catalogued};
use brinell::scene::quantity::ELEMENT_COUNT;
use brinell::scene::{
    Bearing, BearingError, Crown, DegreesOfFreedom, ElementInertia, FreedomError, Gyroscopic, Roller, RollerProfile,
    RollingElement, SceneError,
};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// What a bearing of the catalogue is taken to be made of and how the grooves of balls are curved: usual values of
/// bearings of steel.
const CONFORMITY: f64 = 0.52;
const YOUNGS_MODULUS_GPA: f64 = 207.0;
const POISSONS_RATIO: f64 = 0.3;
const DENSITY_KG_M3: f64 = 7800.0;

/// The keys with what the catalogue adds.
struct WholeBearing {
    element: ElementKind,
    roller_length_mm: Option<f64>,
    roller_profile: Option<String>,
    roller_laminae: Option<u32>,
    element_count: usize,
    element_diameter_mm: f64,
    diameters: Diameters,
    pitch_diameter_mm: f64,
    groove_diameter_mm: Option<f64>,
    conformity_inner: Option<f64>,
    conformity_outer: Option<f64>,
    clearance: Clearance,
    youngs_modulus_gpa: f64,
    poissons_ratio: f64,
    density_kg_m3: Option<f64>,
    element_mass_g: Option<f64>,
    hertz_inner_n_m1_5: Option<f64>,
    hertz_outer_n_m1_5: Option<f64>,
    outer_compliance_m_n: f64,
    element_inertia: ElementInertia,
    angles: Angles,
}

/// The keys as they stand in the file.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BearingTable {
    /// Name of a deep groove, angular contact or cylindrical roller bearing, as 6205, 7205B or NU205; its dimensions
    /// hold where no key beside it says otherwise.
    catalogue: Option<String>,
    /// What rolls; without it balls, or what the bearing of the catalogue has.
    element: Option<ElementKind>,
    /// Effective length of a roller, without its chamfers; rollers only, as the next two.
    roller_length_mm: Option<f64>,
    /// Relief of a roller's ends: "log", the crown of ISO/TS 16281, without it; or "straight", or a file of
    /// axial_mm and depth_um.
    roller_profile: Option<String>,
    /// Laminae into which a roller is cut; 40 without it.
    roller_laminae: Option<u32>,
    /// Number of balls or rollers.
    element_count: Option<usize>,
    /// Their diameter.
    element_diameter_mm: Option<f64>,
    /// Diameter of each element beyond that. With 2 degrees of freedom only, as the next two.
    element_diameter_offsets_um: Option<Vec<f64>>,
    /// Root mean square of such differences that are drawn, of sum 0; instead of the list.
    element_diameter_rms_um: Option<f64>,
    /// Which elements of that kind; needed where they are drawn.
    element_diameter_seed: Option<u64>,
    /// Diameter of the circle of their centres.
    pitch_diameter_mm: Option<f64>,
    /// Diameter of the groove's circle across the track, of both rings; instead of the conformities. Balls only.
    groove_diameter_mm: Option<f64>,
    /// Groove radius of the inner ring over ball diameter.
    conformity_inner: Option<f64>,
    /// The same of the outer ring.
    conformity_outer: Option<f64>,
    /// What separates a raceway from an element pressed to the other.
    radial_clearance_um: Option<f64>,
    /// Radial internal clearance of catalogues (ISO 5753), twice the radial clearance; one of the two.
    internal_clearance_um: Option<f64>,
    /// Total axial play from stop to stop; one of the four. 3 or 5 degrees of freedom only.
    axial_clearance_um: Option<f64>,
    /// Free contact angle of an angular contact bearing, positive where it takes pushes of the inner ring towards +z;
    /// one of the four. 3 or 5 degrees of freedom only.
    contact_angle_deg: Option<f64>,
    /// In how many directions the rings move: 2, along x and y, without it; 3, and along z; 5, and they tilt about x
    /// and y. Balls only.
    #[schemars(extend("enum" = [2, 3, 5]))]
    degrees_of_freedom: Option<i64>,
    /// Contact angle for which cage, spin and tracks are worked out; without it the free one where it is given, else
    /// that of the start's equilibrium.
    operating_angle_deg: Option<f64>,
    /// Height of the inner ring's shoulder above the groove's bottom, on the loaded side; nothing is reported without
    /// it.
    shoulder_inner_mm: Option<f64>,
    /// The same of the outer ring.
    shoulder_outer_mm: Option<f64>,
    /// Who holds the balls' gyroscopic couple: "none" without it; of balls without inertia only.
    #[serde(default)]
    gyroscopic: Gyroscopic,
    /// Of rings and elements.
    youngs_modulus_gpa: Option<f64>,
    /// Of rings and elements.
    poissons_ratio: Option<f64>,
    /// Of the elements.
    density_kg_m3: Option<f64>,
    /// Mass of one element; instead of the density.
    element_mass_g: Option<f64>,
    /// Hertz constant of the inner contact; computed without it. Balls only.
    hertz_inner_n_m1_5: Option<f64>,
    /// Hertz constant of the outer contact; computed without it. Balls only.
    hertz_outer_n_m1_5: Option<f64>,
    /// By how much the outer raceway yields to one element; 0 without it.
    #[serde(default)]
    outer_compliance_m_n: f64,
    /// "full" without it: elements vibrate between the raceways. "none": each is in radial balance at every
    /// instant, for rotor studies below 2 kHz.
    #[serde(default)]
    element_inertia: ElementInertia,
}

/// What rolls.
#[derive(JsonSchema, Deserialize, Default, Clone, Copy, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum ElementKind {
    /// Balls in grooves.
    #[default]
    Ball,
    /// Cylindrical rollers on straight raceways.
    CylindricalRoller,
}

impl BearingTable {
    /// The degrees of freedom, which other tables ask as well.
    pub(super) fn freedom(&self) -> Result<DegreesOfFreedom, SceneError> {
        let given = self.degrees_of_freedom.unwrap_or(DegreesOfFreedom::Two.count() as i64);
        DegreesOfFreedom::counted(given).ok_or(FreedomError::NoneSuch { given }.into())
    }

    pub(crate) fn into_bearing(self, freedom: DegreesOfFreedom) -> Result<Bearing, Faults> {
        WholeBearing::try_from(self)?.into_bearing(freedom)
    }
}

impl TryFrom<BearingTable> for WholeBearing {
    type Error = TableFault;

    /// What the keys leave open, from the catalogue.
    fn try_from(keys: BearingTable) -> Result<Self, TableFault> {
        let named = keys.catalogue.as_deref().map(bearing_named).transpose()?;
        let kind = named.map(|bearing| match bearing.inside.roller_length {
            None => (ElementKind::Ball, "balls"),
            Some(_) => (ElementKind::CylindricalRoller, "cylindrical rollers"),
        });
        if let (Some(bearing), Some((kind, elements)), Some(asked)) = (named, kind, keys.element)
            && kind != asked
        {
            return Err(TableFault::OtherElements { name: bearing.designation, elements });
        }
        let element = keys.element.or(kind.map(|(kind, _)| kind)).unwrap_or_default();
        let inside = named.map(|bearing| bearing.inside);
        let from_catalogue = |value: f64| named.map(|_| value);
        let no_groove = keys.groove_diameter_mm.is_none() && keys.conformity_inner.or(keys.conformity_outer).is_none();
        let conformity = from_catalogue(CONFORMITY).filter(|_| no_groove && element == ElementKind::Ball);
        let density = from_catalogue(DENSITY_KG_M3).filter(|_| keys.element_mass_g.is_none());
        let needed = |value: Option<f64>, key| value.ok_or(missing(key));
        let count = keys.element_count.or(inside.map(|inside| inside.element_count));
        let diameter = keys.element_diameter_mm.or(inside.map(|inside| inside.element_diameter));
        let pitch = keys.pitch_diameter_mm.or(inside.map(|inside| inside.pitch_diameter));
        let angle = inside.and_then(|inside| inside.contact_angle);
        if let (Some(bearing), Some(angle), Ok(DegreesOfFreedom::Two)) = (named, angle, keys.freedom()) {
            return Err(TableFault::AngularInPlane { name: bearing.designation, angle });
        }
        let clearance = keys.clearance(angle)?;
        let youngs_modulus = keys.youngs_modulus_gpa.or(from_catalogue(YOUNGS_MODULUS_GPA));
        Ok(Self {
            element,
            roller_length_mm: keys.roller_length_mm.or(inside.and_then(|inside| inside.roller_length)),
            roller_profile: keys.roller_profile,
            roller_laminae: keys.roller_laminae,
            element_count: count.ok_or(missing("bearing.element_count"))?,
            element_diameter_mm: needed(diameter, "bearing.element_diameter_mm")?,
            diameters: Diameters {
                offsets_um: keys.element_diameter_offsets_um,
                rms_um: keys.element_diameter_rms_um,
                seed: keys.element_diameter_seed,
            },
            pitch_diameter_mm: needed(pitch, "bearing.pitch_diameter_mm")?,
            groove_diameter_mm: keys.groove_diameter_mm,
            conformity_inner: keys.conformity_inner.or(conformity),
            conformity_outer: keys.conformity_outer.or(conformity),
            clearance,
            youngs_modulus_gpa: needed(youngs_modulus, "bearing.youngs_modulus_gpa")?,
            poissons_ratio: needed(keys.poissons_ratio.or(from_catalogue(POISSONS_RATIO)), "bearing.poissons_ratio")?,
            density_kg_m3: keys.density_kg_m3.or(density),
            element_mass_g: keys.element_mass_g,
            hertz_inner_n_m1_5: keys.hertz_inner_n_m1_5,
            hertz_outer_n_m1_5: keys.hertz_outer_n_m1_5,
            outer_compliance_m_n: keys.outer_compliance_m_n,
            element_inertia: keys.element_inertia,
            angles: Angles {
                operating_angle: keys.operating_angle_deg.map(f64::to_radians),
                shoulders: [keys.shoulder_inner_mm, keys.shoulder_outer_mm].map(|height| height.map(|mm| mm / 1e3)),
                gyroscopic: keys.gyroscopic,
            },
        })
    }
}

const fn missing(key: &'static str) -> TableFault {
    TableFault::Missing { key, why: "bearing.catalogue is not given either" }
}

fn bearing_named(name: &str) -> Result<CatalogueBearing, TableFault> {
    catalogued(name).ok_or_else(|| NotInCatalogue { name: name.to_owned() }.into())
}

/// Clearance where the file says none (µm).
const DEFAULT_CLEARANCE_UM: f64 = 5.0;

/// What the file says of how loose the bearing is, in SI units.
enum Clearance {
    /// G = R_o − R_i − 2r (m). What a catalogue calls the radial internal clearance is how far one ring can be moved
    /// against the other, from stop to stop: 2 G.
    Radial(f64),
    /// The same along the axis (m).
    AxialPlay(f64),
    /// Free contact angle (rad).
    ContactAngle(f64),
}

/// What the file says of contact angles and shoulders, in SI units.
struct Angles {
    operating_angle: Option<f64>,
    shoulders: [Option<f64>; 2],
    gyroscopic: Gyroscopic,
}

impl BearingTable {
    /// What is given, or the contact angle (°) of the catalogue's bearing, or the usual clearance.
    fn clearance(&self, angle: Option<f64>) -> Result<Clearance, TableFault> {
        let given = [
            ("bearing.radial_clearance_um", self.radial_clearance_um.map(|um| Clearance::Radial(um / 1e6))),
            ("bearing.internal_clearance_um", self.internal_clearance_um.map(|um| Clearance::Radial(um / 2e6))),
            ("bearing.axial_clearance_um", self.axial_clearance_um.map(|um| Clearance::AxialPlay(um / 1e6))),
            ("bearing.contact_angle_deg", self.contact_angle_deg.map(|deg| Clearance::ContactAngle(deg.to_radians()))),
        ];
        let mut given = given.into_iter().filter_map(|(key, clearance)| clearance.map(|clearance| (key, clearance)));
        match (given.next(), given.next()) {
            (Some((first, _)), Some((second, _))) => Err(TableFault::Both { first, second }),
            (Some((_, clearance)), None) => Ok(clearance),
            (None, _) => Ok(angle.map_or(Clearance::Radial(DEFAULT_CLEARANCE_UM / 1e6), |degrees| {
                Clearance::ContactAngle(degrees.to_radians())
            })),
        }
    }
}

impl Clearance {
    /// Of a bearing with its diameters and grooves.
    fn put_into(self, bearing: &mut Bearing) -> Result<(), SceneError> {
        match self {
            Self::Radial(clearance) => bearing.radial_clearance = clearance,
            // Rollers are refused for it, and have no groove to work a clearance out of.
            Self::ContactAngle(angle) if bearing.roller().is_some() => bearing.contact_angle = Some(angle),
            Self::ContactAngle(angle) => bearing.set_contact_angle(angle),
            Self::AxialPlay(play) => {
                let (key, freedom) = ("bearing.axial_clearance_um", bearing.degrees_of_freedom);
                if freedom == DegreesOfFreedom::Two {
                    return Err(FreedomError::NeedsMore { key, least: 3, given: freedom.count() }.into());
                }
                if bearing.roller().is_none() {
                    bearing.radial_clearance = bearing.clearance_of_play(play)?;
                }
            }
        }
        Ok(())
    }
}

impl WholeBearing {
    // 1e3 is exact and 1e-3 is not, so a division rounds once and a product twice.
    fn into_bearing(self, freedom: DegreesOfFreedom) -> Result<Bearing, Faults> {
        // Lists get that length: no memory is taken for what no bearing has.
        ELEMENT_COUNT.check(self.element_count as f64)?;
        let element = self.rolling_element()?;
        let (conformity_inner, conformity_outer) = match element {
            RollingElement::Ball => self.conformities()?,
            RollingElement::CylindricalRoller(_) => (f64::INFINITY, f64::INFINITY),
        };
        let mut bearing = Bearing {
            density: self.density(&element)?,
            element,
            element_count: self.element_count,
            element_diameter: self.element_diameter_mm / 1e3,
            diameter_offsets: Vec::new(),
            drawn_diameters: None,
            pitch_diameter: self.pitch_diameter_mm / 1e3,
            conformity_inner,
            conformity_outer,
            radial_clearance: DEFAULT_CLEARANCE_UM / 1e6,
            degrees_of_freedom: freedom,
            contact_angle: None,
            operating_angle: self.angles.operating_angle,
            shoulder_inner: self.angles.shoulders[0],
            shoulder_outer: self.angles.shoulders[1],
            gyroscopic: self.angles.gyroscopic,
            youngs_modulus: self.youngs_modulus_gpa * 1e9,
            poissons_ratio: self.poissons_ratio,
            element_mass: self.element_mass_g.map(|mass| mass / 1e3),
            hertz_inner: self.hertz_inner_n_m1_5,
            hertz_outer: self.hertz_outer_n_m1_5,
            outer_compliance: self.outer_compliance_m_n,
            element_inertia: self.element_inertia,
        };
        self.diameters.put_into(&mut bearing)?;
        self.clearance.put_into(&mut bearing)?;
        Ok(bearing)
    }

    fn rolling_element(&self) -> Result<RollingElement, Faults> {
        const LENGTH: &str = "bearing.roller_length_mm";
        if self.element == ElementKind::Ball {
            let keys = [
                (LENGTH, self.roller_length_mm.is_some()),
                ("bearing.roller_profile", self.roller_profile.is_some()),
                ("bearing.roller_laminae", self.roller_laminae.is_some()),
            ];
            let given = keys.into_iter().find_map(|(key, given)| given.then_some(key));
            return given.map_or(Ok(RollingElement::Ball), |key| Err(TableFault::OnlyRollers { key }.into()));
        }
        let keys = [
            ("bearing.groove_diameter_mm", self.groove_diameter_mm.is_some()),
            ("bearing.conformity_inner", self.conformity_inner.is_some()),
            ("bearing.conformity_outer", self.conformity_outer.is_some()),
            ("bearing.hertz_inner_n_m1_5", self.hertz_inner_n_m1_5.is_some()),
            ("bearing.hertz_outer_n_m1_5", self.hertz_outer_n_m1_5.is_some()),
        ];
        if let Some((key, _)) = keys.into_iter().find(|(_, given)| *given) {
            return Err(SceneError::from(BearingError::OnlyBalls { key }).into());
        }
        let why = "bearing.element is \"cylindrical-roller\"";
        let length = self.roller_length_mm.ok_or(TableFault::Missing { key: LENGTH, why })? / 1e3;
        let profile = match self.roller_profile.as_deref() {
            None | Some("log") => RollerProfile::Logarithmic,
            Some("straight") => RollerProfile::Straight,
            Some(file) if file.ends_with(".csv") => {
                RollerProfile::Measured(Crown { name: file.to_owned(), points: Arc::default() })
            }
            Some(other) => return Err(TableFault::RollerProfile { given: other.to_owned() }.into()),
        };
        let laminae = self.roller_laminae.unwrap_or(Roller::LAMINAE);
        Ok(RollingElement::CylindricalRoller(Roller { length, profile, laminae }))
    }

    fn conformities(&self) -> Result<(f64, f64), TableFault> {
        const GROOVE: &str = "bearing.groove_diameter_mm";
        const INNER: &str = "bearing.conformity_inner";
        const OUTER: &str = "bearing.conformity_outer";
        match (self.groove_diameter_mm, self.conformity_inner, self.conformity_outer) {
            (Some(groove), None, None) => {
                let conformity = groove / (2.0 * self.element_diameter_mm);
                Ok((conformity, conformity))
            }
            (None, Some(inner), Some(outer)) => Ok((inner, outer)),
            (Some(_), Some(_), _) => Err(TableFault::Both { first: GROOVE, second: INNER }),
            (Some(_), None, Some(_)) => Err(TableFault::Both { first: GROOVE, second: OUTER }),
            (None, None, None) => Err(TableFault::Neither { first: GROOVE, second: INNER }),
            (None, None, Some(_)) => {
                Err(TableFault::Missing { key: INNER, why: "bearing.conformity_outer is given without it" })
            }
            (None, Some(_), None) => {
                Err(TableFault::Missing { key: OUTER, why: "bearing.conformity_inner is given without it" })
            }
        }
    }

    fn density(&self, element: &RollingElement) -> Result<f64, TableFault> {
        match (self.density_kg_m3, self.element_mass_g) {
            (Some(density), _) => Ok(density),
            (None, Some(mass)) => Ok(mass / 1e3 / element.volume(self.element_diameter_mm / 1e3)),
            (None, None) => {
                Err(TableFault::Neither { first: "bearing.density_kg_m3", second: "bearing.element_mass_g" })
            }
        }
    }
}
