//! Values that look as if they were in another unit: which sizes are usual, and which unit was probably meant.

mod mistaken;
mod usual_ranges;

pub use mistaken::UnitQuestion;
pub(crate) use usual_ranges::Dimensions;

use brinell::scene::{Bearing, Plain};
use std::fmt;

/// A value of a scene file far from what is built, and usual if it was meant in another unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitRemark {
    /// Its line in the file, from 1.
    pub line: usize,
    /// The question.
    pub question: UnitQuestion,
}

impl fmt::Display for UnitRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let UnitQuestion { key, value, .. } = &self.question;
        write!(f, "line {}: {key} = {}: {}", self.line, Plain(*value), asked(&self.question))
    }
}

/// A file of depths that are far from what is usual, and usual if they were meant in another unit: the question about
/// the deepest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DepthRemark(UnitQuestion);

impl DepthRemark {
    /// What there is to ask about a file of depths in micrometres whose deepest is so many.
    pub fn of(bearing: &Bearing, deepest_um: f64) -> Option<Self> {
        Dimensions::of_bearing(bearing).question("defect.depth_um", deepest_um).map(Self)
    }
}

impl fmt::Display for DepthRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(question) = self;
        write!(f, "its depths reach {} {}: {}", Plain(question.value), question.unit, asked(question))
    }
}

/// The question, and what is usual.
fn asked(question: &UnitQuestion) -> String {
    let UnitQuestion { unit, usual, source, .. } = question;
    let [least, most] = usual.map(|value| Plain(format!("{value:.1e}").parse().unwrap_or(value)));
    format!("{question} Usual are {least} to {most} {unit} ({source})")
}
