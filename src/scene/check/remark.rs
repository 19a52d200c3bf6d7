//! What a scene may hold and hardly means: it is computed, and remarked upon.

use crate::scene::Scene;
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
        /// Both films together at the speed of the start (µm).
        together_um: f64,
        /// Radial clearance (µm).
        clearance_um: f64,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OpenGroove { ring, conformity } => write!(
                f,
                "the groove conformity of the {ring} ring is {conformity:.4}: ball bearings have 0.51 to \
                 {USUAL_CONFORMITY}. A roller bearing with a groove invented for it gets a ball's point contacts: \
                 cylindrical rollers are bearing.element = \"cylindrical-roller\""
            ),
            Self::ThickFilms { together_um, clearance_um } => write!(
                f,
                "the oil films of both raceways are {together_um:.2} um thick together, of a radial clearance of \
                 {clearance_um} um (bearing.radial_clearance_um): they press the bearing as if it were that much \
                 tighter"
            ),
        }
    }
}

impl Scene {
    /// What is possible and unusual in this scene.
    pub fn remarks(&self) -> Vec<Remark> {
        let grooves = [("inner", self.bearing.conformity_inner), ("outer", self.bearing.conformity_outer)];
        let balls = self.bearing.roller().is_none();
        let open = grooves.into_iter().filter(|(_, conformity)| balls && *conformity > USUAL_CONFORMITY);
        open.map(|(ring, conformity)| Remark::OpenGroove { ring, conformity }).collect()
    }
}
