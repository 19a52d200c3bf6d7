//! What a scene may say and hardly means: it is computed, and remarked upon.

use super::Scene;
use super::plain::Plain;
use super::unit_hint::UnitQuestion;
use super::usual::Dimensions;
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
    /// A value far from what is built, and usual if it was meant in another unit.
    OtherUnit {
        /// Its line in the file, from 1.
        line: usize,
        /// The question.
        question: UnitQuestion,
    },
    /// A file of depths that are far from what is usual, and usual if they were meant in another unit.
    OtherDepths {
        /// The question about the deepest.
        question: UnitQuestion,
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
            Self::OtherUnit { line, question } => {
                write!(f, "line {line}: {} = {}: {}", question.key, Plain(question.value), asked(question))
            }
            Self::OtherDepths { question } => {
                write!(f, "its depths reach {} {}: {}", Plain(question.value), question.unit, asked(question))
            }
        }
    }
}

/// The question, and what is usual.
fn asked(question: &UnitQuestion) -> String {
    let UnitQuestion { unit, usual, source, .. } = question;
    let [least, most] = usual.map(|value| Plain(format!("{value:.1e}").parse().unwrap_or(value)));
    format!("{question} Usual are {least} to {most} {unit} ({source})")
}

impl Scene {
    /// What is possible and unusual in this scene; in the numbers of its file [`Scene::questions`] finds it.
    pub fn remarks(&self) -> Vec<Remark> {
        let grooves = [("inner", self.bearing.conformity_inner), ("outer", self.bearing.conformity_outer)];
        let balls = self.bearing.roller().is_none();
        let open = grooves.into_iter().filter(|(_, conformity)| balls && *conformity > USUAL_CONFORMITY);
        open.map(|(ring, conformity)| Remark::OpenGroove { ring, conformity }).collect()
    }

    /// What there is to ask about a file of depths in micrometres whose deepest is so many.
    pub fn remark_on_depths(&self, deepest_um: f64) -> Option<Remark> {
        let question = Dimensions::of_bearing(&self.bearing).question("defect.depth_um", deepest_um)?;
        Some(Remark::OtherDepths { question })
    }
}
