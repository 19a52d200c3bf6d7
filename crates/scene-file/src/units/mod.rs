//! Values that look as if they were in another unit: which sizes are usual, and which unit was probably meant.

mod mistaken;
mod usual_ranges;

pub use mistaken::UnitQuestion;
pub(crate) use usual_ranges::Dimensions;

use brinell::scene::Plain;
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
        let UnitQuestion { key, value, unit, usual, source, .. } = &self.question;
        let [least, most] = usual.map(|value| Plain(format!("{value:.1e}").parse().unwrap_or(value)));
        write!(
            f,
            "line {}: {key} = {}: {} Usual are {least} to {most} {unit} ({source})",
            self.line,
            Plain(*value),
            self.question
        )
    }
}
