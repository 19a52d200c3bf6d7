//! What a scene may say and hardly means: it is computed, and remarked upon.

use super::Scene;
use super::unit_hint::meant;
use std::f64::consts::TAU;
use std::fmt;

/// Largest groove conformity of ball bearings that are built, self-aligning ones aside; ISO 281 rates up to 0.53.
const USUAL_CONFORMITY: f64 = 0.6;

/// Something in a scene that is possible and unusual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remark {
    /// A groove as of a raceway for rollers, or invented for one.
    OpenGroove {
        /// "inner" or "outer".
        ring: &'static str,
        /// Groove radius over element diameter.
        conformity: f64,
    },
    /// Oil films that take half of the clearance and more.
    ThickFilms {
        /// Both films together at the speed of the start [µm].
        together_um: f64,
        /// Radial clearance [µm].
        clearance_um: f64,
    },
    /// A value far from what is built, and usual if it was meant in another unit.
    OtherUnit {
        /// The key of the scene file, with its unit.
        key: &'static str,
        /// The value in that unit.
        value: f64,
        /// Smallest and largest that is usual, in the same unit.
        usual: [f64; 2],
        /// The unit in which the value would be usual.
        meant: &'static str,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OpenGroove { ring, conformity } => write!(
                f,
                "the groove conformity of the {ring} ring is {conformity:.4}: ball bearings have 0.51 to \
                 {USUAL_CONFORMITY}. A roller bearing with a groove invented for it gets a ball's point contacts: cylindrical \
                 rollers are bearing.element = \"cylindrical-roller\""
            ),
            Self::ThickFilms { together_um, clearance_um } => write!(
                f,
                "the oil films of both raceways are {together_um:.2} um thick together, of a radial clearance of \
                 {clearance_um} um (bearing.radial_clearance_um): they press the bearing as if it were that much tighter"
            ),
            Self::OtherUnit { key, value, usual: [least, most], meant } => {
                write!(f, "{key} = {value}: {meant}? Usual are {least} to {most} in the unit of the key")
            }
        }
    }
}

impl Scene {
    /// What is possible and unusual in this scene.
    pub fn remarks(&self) -> Vec<Remark> {
        let grooves = [("inner", self.bearing.conformity_inner), ("outer", self.bearing.conformity_outer)];
        let balls = self.bearing.roller().is_none();
        let open = grooves.into_iter().filter(|(_, conformity)| balls && *conformity > USUAL_CONFORMITY);
        let open = open.map(|(ring, conformity)| Remark::OpenGroove { ring, conformity });
        open.chain(self.other_units()).collect()
    }

    /// Values that would be usual in another unit.
    fn other_units(&self) -> impl Iterator<Item = Remark> {
        let bearing = &self.bearing;
        let values = [
            ("bearing.element_diameter_mm", bearing.element_diameter * 1e3, [0.3, 300.0]),
            ("bearing.pitch_diameter_mm", bearing.pitch_diameter * 1e3, [2.0, 5000.0]),
            ("bearing.density_kg_m3", bearing.density, [1e3, 25e3]),
            ("shaft.speed_hz", self.shaft_speed.abs() / TAU, [0.0, 1500.0]),
        ];
        values.into_iter().filter_map(|(key, value, usual)| {
            let meant = meant(key, value, |value| (usual[0]..=usual[1]).contains(&value))?;
            Some(Remark::OtherUnit { key, value, usual, meant })
        })
    }
}
