//! What a scene may say and hardly means: it is computed, and remarked upon.

use super::Scene;
use std::fmt;

/// Largest groove conformity of ball bearings that are built, self-aligning ones aside; ISO 281 rates up to 0.53.
const USUAL_CONFORMITY: f64 = 0.6;

/// Something in a scene that is possible and unusual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remark {
    /// A groove as of a raceway for rollers, or made up for one.
    OpenGroove {
        /// "inner" or "outer".
        ring: &'static str,
        /// Groove radius over element diameter.
        conformity: f64,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OpenGroove { ring, conformity } => write!(
                f,
                "the groove conformity of the {ring} ring is {conformity:.4}: ball bearings have 0.51 to \
                 {USUAL_CONFORMITY}. Rolling elements are balls here, so far; a roller bearing with a groove made up \
                 for it gets a ball's point contacts"
            ),
        }
    }
}

impl Scene {
    /// What is possible and unusual in this scene.
    pub fn remarks(&self) -> Vec<Remark> {
        let grooves = [("inner", self.bearing.conformity_inner), ("outer", self.bearing.conformity_outer)];
        let open = grooves.into_iter().filter(|(_, conformity)| *conformity > USUAL_CONFORMITY);
        open.map(|(ring, conformity)| Remark::OpenGroove { ring, conformity }).collect()
    }
}
