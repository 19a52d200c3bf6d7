//! The table `[bearing]`: dimensions and material, or a catalogue's name instead of them.

use super::diameters;
use super::faults::{Faults, TableFault, only_one};
use crate::catalogue::{CatalogueBearing, designation};
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
/// Silicon nitride, of which the elements of hybrid bearings are: modulus and density as makers of them publish (300 to
/// 315 GPa, 3200 to 3290 kg/m³), Poisson's ratio between their 0.24 and 0.27.
const CERAMIC_MODULUS_GPA: f64 = 310.0;
const CERAMIC_RATIO: f64 = 0.26;
const CERAMIC_DENSITY_KG_M3: f64 = 3200.0;

/// The keys as they stand in the file.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BearingTable {
    /// Name of a deep groove, angular contact or cylindrical roller bearing as its maker writes it: 6205, SKF
    /// 6205-2Z/C3, 7205 BEP, NU 205 ECP. Its elements, its pitch diameter, conformity 0.52, steel (HC: elements of
    /// silicon nitride) and the middle of its clearance class (CN without one) hold where no key beside it says
    /// otherwise. Without it dimensions and material are needed.
    catalogue: Option<String>,
    /// What rolls; without it balls, or what the bearing of the catalogue has. Cylindrical rollers need
    /// roller_length_mm and have no groove.
    element: Option<ElementKind>,
    /// Effective length of a roller, without its chamfers; rollers need it, and only they have keys of rollers.
    roller_length_mm: Option<f64>,
    /// Relief of a roller's ends: "log", the crown of ISO/TS 16281, or "straight", or a file of axial_mm and depth_um.
    #[schemars(extend("default" = "log"))]
    roller_profile: Option<String>,
    /// Laminae into which a roller is cut.
    #[schemars(extend("default" = Roller::LAMINAE))]
    roller_laminae: Option<u32>,
    /// Number of balls or rollers.
    element_count: Option<usize>,
    /// Their diameter.
    element_diameter_mm: Option<f64>,
    /// Diameter of each element beyond element_diameter_mm; equal elements without it. With 2 degrees of freedom only,
    /// as diameters that are drawn.
    element_diameter_offsets_um: Option<Vec<f64>>,
    /// Root mean square of differences of diameters that are drawn, of sum 0; instead of the list.
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
    /// What separates a raceway from an element pressed to the other, R_o − R_i − 2r. How loose the bearing is may be
    /// said by internal_clearance_um, axial_clearance_um or contact_angle_deg instead; with catalogue the default is
    /// half of its class's middle.
    #[schemars(extend("default" = DEFAULT_CLEARANCE_UM))]
    radial_clearance_um: Option<f64>,
    /// Radial internal clearance of catalogues (ISO 5753), twice radial_clearance_um, which it replaces.
    internal_clearance_um: Option<f64>,
    /// Total axial play from stop to stop; replaces radial_clearance_um. 3 or 5 degrees of freedom only.
    axial_clearance_um: Option<f64>,
    /// Free contact angle of an angular contact bearing, positive where it takes pushes of the inner ring towards +z;
    /// replaces radial_clearance_um. 3 or 5 degrees of freedom only.
    contact_angle_deg: Option<f64>,
    /// In how many directions the rings move: 2, along x and y; 3, and along z; 5, and they tilt about x and y. 3 and 5
    /// with balls only.
    #[schemars(extend("enum" = [2, 3, 5], "default" = DegreesOfFreedom::Two.count()))]
    degrees_of_freedom: Option<i64>,
    /// Contact angle for which cage, spin and tracks are worked out; without it the free one where it is given, else
    /// that of the start's equilibrium.
    operating_angle_deg: Option<f64>,
    /// Height of the inner ring's shoulder above the groove's bottom, on the loaded side; nothing is reported without
    /// it.
    shoulder_inner_mm: Option<f64>,
    /// The same of the outer ring's shoulder.
    shoulder_outer_mm: Option<f64>,
    /// Who holds the balls' gyroscopic couple; of balls without inertia only.
    #[serde(default)]
    gyroscopic: Gyroscopic,
    /// Of the rings, and of the elements without element_youngs_modulus_gpa.
    youngs_modulus_gpa: Option<f64>,
    /// Of the rings, and of the elements without element_poissons_ratio.
    poissons_ratio: Option<f64>,
    /// Of the elements; of no effect beside element_density_kg_m3 or element_mass_g.
    density_kg_m3: Option<f64>,
    /// Of elements of another material than the rings, as ceramic ones of a hybrid bearing.
    element_youngs_modulus_gpa: Option<f64>,
    /// Of elements of another material than the rings.
    element_poissons_ratio: Option<f64>,
    /// Of elements of another material than the rings; of no effect beside element_mass_g.
    element_density_kg_m3: Option<f64>,
    /// Mass of one element; computed from the density without it.
    element_mass_g: Option<f64>,
    /// Hertz constant of the inner contact; computed without it. Balls only.
    hertz_inner_n_m1_5: Option<f64>,
    /// Hertz constant of the outer contact; computed without it. Balls only.
    hertz_outer_n_m1_5: Option<f64>,
    /// By how much the outer raceway yields to one element; rings and seats are rigid where it is 0.
    #[serde(default)]
    outer_compliance_m_n: f64,
    /// "full": elements vibrate between the raceways. "none": each is in radial balance at every instant, for rotor
    /// studies below 2 kHz.
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

    /// What the keys leave open, from the catalogue.
    fn with_catalogue(mut self) -> Result<Self, TableFault> {
        let Some(name) = self.catalogue.as_deref() else { return Ok(self) };
        let read = designation(name)?;
        let CatalogueBearing { designation: name, inside, .. } = read.bearing;
        let (kind, elements) = match inside.roller_length {
            None => (ElementKind::Ball, "balls"),
            Some(_) => (ElementKind::CylindricalRoller, "cylindrical rollers"),
        };
        if *self.element.get_or_insert(kind) != kind {
            return Err(TableFault::OtherElements { name, elements });
        }
        if let Some(angle) = inside.contact_angle {
            if let Ok(DegreesOfFreedom::Two) = self.freedom() {
                return Err(TableFault::AngularInPlane { name, angle });
            }
            if self.is_silent_on_clearance() {
                self.contact_angle_deg = Some(angle);
            }
        }
        if let Some(clearance) = read.clearance.filter(|_| self.is_silent_on_clearance()) {
            self.internal_clearance_um = Some(clearance.middle_um());
        }
        self.roller_length_mm = self.roller_length_mm.or(inside.roller_length);
        self.element_count.get_or_insert(inside.element_count);
        self.element_diameter_mm.get_or_insert(inside.element_diameter);
        self.pitch_diameter_mm.get_or_insert(inside.pitch_diameter);
        let no_groove = self.groove_diameter_mm.or(self.conformity_inner).or(self.conformity_outer).is_none();
        if no_groove && kind == ElementKind::Ball {
            (self.conformity_inner, self.conformity_outer) = (Some(CONFORMITY), Some(CONFORMITY));
        }
        self.youngs_modulus_gpa.get_or_insert(YOUNGS_MODULUS_GPA);
        self.poissons_ratio.get_or_insert(POISSONS_RATIO);
        if self.element_mass_g.is_none() {
            self.density_kg_m3.get_or_insert(DENSITY_KG_M3);
        }
        if read.hybrid {
            self.element_youngs_modulus_gpa.get_or_insert(CERAMIC_MODULUS_GPA);
            self.element_poissons_ratio.get_or_insert(CERAMIC_RATIO);
            if self.element_mass_g.is_none() {
                self.element_density_kg_m3.get_or_insert(CERAMIC_DENSITY_KG_M3);
            }
        }
        Ok(self)
    }

    fn is_silent_on_clearance(&self) -> bool {
        let radial = self.radial_clearance_um.or(self.internal_clearance_um);
        radial.or(self.axial_clearance_um).or(self.contact_angle_deg).is_none()
    }

    // 1e3 is exact and 1e-3 is not, so a division rounds once and a product twice.
    pub(crate) fn into_bearing(self, freedom: DegreesOfFreedom) -> Result<Bearing, Faults> {
        let keys = self.with_catalogue()?;
        let clearance = keys.clearance()?;
        let element_count = needed(keys.element_count, "bearing.element_count")?;
        let diameter_mm = needed(keys.element_diameter_mm, "bearing.element_diameter_mm")?;
        let pitch_mm = needed(keys.pitch_diameter_mm, "bearing.pitch_diameter_mm")?;
        let youngs_modulus_gpa = needed(keys.youngs_modulus_gpa, "bearing.youngs_modulus_gpa")?;
        let poissons_ratio = needed(keys.poissons_ratio, "bearing.poissons_ratio")?;
        // Lists get that length: no memory is taken for what no bearing has.
        ELEMENT_COUNT.check(element_count as f64)?;
        let element = keys.rolling_element()?;
        let (conformity_inner, conformity_outer) = match element {
            RollingElement::Ball => keys.conformities(diameter_mm)?,
            RollingElement::CylindricalRoller(_) => (f64::INFINITY, f64::INFINITY),
        };
        let mm = |given: Option<f64>| given.map(|mm| mm / 1e3);
        let mut bearing = Bearing {
            density: keys.density(&element, diameter_mm)?,
            element,
            element_count,
            element_diameter: diameter_mm / 1e3,
            diameter_offsets: Vec::new(),
            drawn_diameters: None,
            pitch_diameter: pitch_mm / 1e3,
            conformity_inner,
            conformity_outer,
            radial_clearance: DEFAULT_CLEARANCE_UM / 1e6,
            degrees_of_freedom: freedom,
            contact_angle: None,
            operating_angle: keys.operating_angle_deg.map(f64::to_radians),
            shoulder_inner: mm(keys.shoulder_inner_mm),
            shoulder_outer: mm(keys.shoulder_outer_mm),
            gyroscopic: keys.gyroscopic,
            youngs_modulus: youngs_modulus_gpa * 1e9,
            poissons_ratio,
            element_youngs_modulus: keys.element_youngs_modulus_gpa.map(|gpa| gpa * 1e9),
            element_poissons_ratio: keys.element_poissons_ratio,
            element_mass: keys.element_mass_g.map(|mass| mass / 1e3),
            hertz_inner: keys.hertz_inner_n_m1_5,
            hertz_outer: keys.hertz_outer_n_m1_5,
            outer_compliance: keys.outer_compliance_m_n,
            element_inertia: keys.element_inertia,
        };
        let (offsets_um, rms_um) = (keys.element_diameter_offsets_um, keys.element_diameter_rms_um);
        diameters::put_into(&mut bearing, offsets_um, rms_um, keys.element_diameter_seed)?;
        clearance.put_into(&mut bearing)?;
        Ok(bearing)
    }

    /// What is given, or the usual clearance.
    fn clearance(&self) -> Result<Clearance, TableFault> {
        let given = [
            ("bearing.radial_clearance_um", self.radial_clearance_um.map(|um| Clearance::Radial(um / 1e6))),
            ("bearing.internal_clearance_um", self.internal_clearance_um.map(|um| Clearance::Radial(um / 2e6))),
            ("bearing.axial_clearance_um", self.axial_clearance_um.map(|um| Clearance::AxialPlay(um / 1e6))),
            ("bearing.contact_angle_deg", self.contact_angle_deg.map(|deg| Clearance::ContactAngle(deg.to_radians()))),
        ];
        only_one(&given.each_ref().map(|(key, clearance)| (*key, clearance.is_some())))?;
        let given = given.into_iter().find_map(|(_, clearance)| clearance);
        Ok(given.unwrap_or(Clearance::Radial(DEFAULT_CLEARANCE_UM / 1e6)))
    }

    fn rolling_element(&self) -> Result<RollingElement, Faults> {
        const LENGTH: &str = "bearing.roller_length_mm";
        if self.element.unwrap_or_default() == ElementKind::Ball {
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

    fn conformities(&self, element_diameter_mm: f64) -> Result<(f64, f64), TableFault> {
        const GROOVE: &str = "bearing.groove_diameter_mm";
        const INNER: &str = "bearing.conformity_inner";
        const OUTER: &str = "bearing.conformity_outer";
        let (groove, inner, outer) = (self.groove_diameter_mm, self.conformity_inner, self.conformity_outer);
        only_one(&[(GROOVE, groove.is_some()), (INNER, inner.is_some()), (OUTER, outer.is_some())])?;
        match (groove, inner, outer) {
            (Some(groove), ..) => {
                let conformity = groove / (2.0 * element_diameter_mm);
                Ok((conformity, conformity))
            }
            (None, Some(inner), Some(outer)) => Ok((inner, outer)),
            (None, None, None) => Err(TableFault::Neither { first: GROOVE, second: INNER }),
            (None, None, Some(_)) => {
                Err(TableFault::Missing { key: INNER, why: "bearing.conformity_outer is given without it" })
            }
            (None, Some(_), None) => {
                Err(TableFault::Missing { key: OUTER, why: "bearing.conformity_inner is given without it" })
            }
        }
    }

    fn density(&self, element: &RollingElement, diameter_mm: f64) -> Result<f64, TableFault> {
        match (self.element_density_kg_m3.or(self.density_kg_m3), self.element_mass_g) {
            (Some(density), _) => Ok(density),
            (None, Some(mass)) => Ok(mass / 1e3 / element.volume(diameter_mm / 1e3)),
            (None, None) => {
                Err(TableFault::Neither { first: "bearing.density_kg_m3", second: "bearing.element_mass_g" })
            }
        }
    }
}

/// A key that only the catalogue can do without.
fn needed<T>(value: Option<T>, key: &'static str) -> Result<T, TableFault> {
    value.ok_or(TableFault::Missing { key, why: "bearing.catalogue is not given either" })
}

/// Clearance of a bearing with dimensions of its own where the file says none (µm).
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
