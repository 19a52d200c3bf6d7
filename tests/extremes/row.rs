//! One row of `docs/data/extremes.csv`.

use crate::support::Named;
use brinell::simulation::StepCounts;
use std::fmt::{self, Display, Formatter};

/// Of a row, behind the kind of bearing.
pub const COLUMNS: [&str; 6] = ["what", "expected", "got", "error_of_allowed", "steps", "method"];

/// What was expected of an extreme, and what came.
pub struct Row {
    what: String,
    expected: String,
    got: String,
    error: String,
    steps: StepCounts,
}

impl Row {
    pub fn new(what: impl Into<String>, expected: impl Into<String>, got: impl Into<String>, bearing: &Named) -> Self {
        let steps = bearing.0.step_counts();
        Self { what: what.into(), expected: expected.into(), got: got.into(), error: "–".to_owned(), steps }
    }

    /// With the error found and the largest allowed.
    pub fn within(self, error: f64, limit: f64) -> Self {
        Self { error: format!("{error:.1e} of {limit:.0e}"), ..self }
    }

    fn method(&self) -> String {
        match self.steps {
            StepCounts { all: 0, .. } => "none".to_owned(),
            StepCounts { implicit: 0, .. } => "explicit".to_owned(),
            StepCounts { all, implicit } if all == implicit => "implicit".to_owned(),
            StepCounts { all, implicit } => format!("both, {:.0} % implicit", 100.0 * implicit as f64 / all as f64),
        }
    }

    /// What is in [`COLUMNS`].
    pub fn cells(&self) -> [String; 6] {
        let [what, expected, got, error] = [&self.what, &self.expected, &self.got, &self.error].map(String::clone);
        [what, expected, got, error, self.steps.all.to_string(), self.method()]
    }
}

impl Display for Row {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        writeln!(f, "{}", self.cells().join(" | "))
    }
}
