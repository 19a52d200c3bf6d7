//! The columns of a run's table: which variables, in which order.

use anyhow::{Result, bail};
use brinell::simulation::interface::table::{Kind, Variability, Variable};
use brinell::simulation::{Simulation, SimulationError};
use brinell_scene_file::nearest;

use crate::package::description::units;

/// The first column.
const TIME: &str = "time";

/// Columns of a long run.
const USUAL: [&str; 15] = [
    "shaft.speed",
    "shaft.x",
    "shaft.y",
    "shaft.z",
    "shaft.tilt.x",
    "shaft.tilt.y",
    "shaft.force.*",
    "shaft.angle",
    "housing.x",
    "housing.y",
    "housing.z",
    "housing.ay",
    "sensor*",
    "probe.*",
    "cage.angle",
];

/// Columns beside the time.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// Names and units, those of integers last.
    names: Vec<(String, &'static str)>,
    reals: Vec<u32>,
    integers: Vec<u32>,
    /// Room for the integers of a row.
    counts: Vec<i32>,
}

impl Columns {
    /// All inputs and outputs that are numbers, and the counters.
    pub fn all(table: &[Variable]) -> Self {
        Self::those(table, &|_| true)
    }

    /// What sensors and probe show, where the rings are, the force between them, speed and cage.
    pub fn usual(table: &[Variable]) -> Self {
        Self::those(table, &|name| USUAL.iter().any(|pattern| matches(pattern, name)))
    }

    /// Those that `patterns` name, in the order of the table; `*` in a pattern stands for any characters.
    ///
    /// # Errors
    /// A pattern that no variable has.
    pub fn matching(table: &[Variable], patterns: &[String]) -> Result<Self> {
        let all = Self::all(table);
        for pattern in patterns {
            if pattern.trim().is_empty() {
                bail!("--columns has an empty name: names are separated by single commas");
            }
            // Which is there whatever is asked for.
            let is_time = matches(pattern, TIME);
            if !is_time && !all.names.iter().any(|(name, _)| matches(pattern, name)) {
                bail!("column {pattern:?}: no input or output of this scene has that name; {}", all.near(pattern));
            }
        }
        Ok(Self::those(table, &|name| patterns.iter().any(|pattern| matches(pattern, name))))
    }

    /// These and one more, which may be among them.
    pub fn with(self, table: &[Variable], name: &str) -> Self {
        let mine: Vec<String> = self.names.into_iter().map(|(name, _)| name).collect();
        Self::those(table, &|other| other == name || mine.iter().any(|mine| mine == other))
    }

    fn those(table: &[Variable], wanted: &dyn Fn(&str) -> bool) -> Self {
        let mut columns = Self { names: Vec::new(), reals: Vec::new(), integers: Vec::new(), counts: Vec::new() };
        let mut counters = Vec::new();
        // What is fixed is no course over time.
        let shown = |variable: &&Variable| variable.variability != Variability::Fixed && wanted(&variable.name);
        for variable in table.iter().filter(shown) {
            match variable.kind {
                Kind::Real { unit, .. } => {
                    columns.names.push((variable.name.clone(), units::name(unit)));
                    columns.reals.push(variable.reference);
                }
                Kind::Integer => {
                    counters.push((variable.name.clone(), "1"));
                    columns.integers.push(variable.reference);
                }
                _ => {}
            }
        }
        columns.names.extend(counters);
        columns.counts = vec![0; columns.integers.len()];
        columns
    }

    /// Names and units.
    pub fn names(&self) -> impl Iterator<Item = (&str, &'static str)> {
        self.names.iter().map(|(name, unit)| (name.as_str(), *unit))
    }

    /// Puts the present values into `row`, which has a slot for each column.
    pub fn read(&mut self, simulation: &mut Simulation, row: &mut [f64]) -> Result<(), SimulationError> {
        let (reals, counts) = row.split_at_mut(self.reals.len());
        simulation.reals(&self.reals, reals)?;
        simulation.integers(&self.integers, &mut self.counts)?;
        counts.iter_mut().zip(&self.counts).for_each(|(slot, &count)| *slot = f64::from(count));
        Ok(())
    }

    /// Names that begin like a pattern, or else how names begin.
    fn near(&self, pattern: &str) -> String {
        let head = |name: &str| name.split(['.', '[', '*']).next().unwrap_or_default().to_owned();
        let near = nearest(self.names().map(|(name, _)| name), pattern);
        let near = near.map_or_else(String::new, |near| format!("did you mean {near}? "));
        let like: Vec<&str> = self.names().map(|(name, _)| name).filter(|name| head(name) == head(pattern)).collect();
        if !like.is_empty() {
            return format!("{near}names that begin with {:?} are {}", head(pattern), like.join(", "));
        }
        let mut heads: Vec<String> = Vec::new();
        for head in self.names().map(|(name, _)| format!("{}*", head(name))) {
            if !heads.contains(&head) {
                heads.push(head);
            }
        }
        format!("{near}there are {}", heads.join(", "))
    }
}

/// Whether a name is as the pattern says.
pub(super) fn matches(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((start, rest)) => name
            .strip_prefix(start)
            .is_some_and(|name| name.char_indices().any(|(at, _)| matches(rest, &name[at..])) || matches(rest, "")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_stands_for_any_characters_and_brackets_for_themselves() {
        for (pattern, name, expected) in [
            ("shaft.x", "shaft.x", true),
            ("shaft.x", "shaft.xy", false),
            ("shaft.*", "shaft.load.x", true),
            ("*.x", "shaft.load.x", true),
            ("element[*].path", "element[12].path", true),
            ("element[1*].path", "element[2].path", false),
            ("*", "time", true),
            ("s*t*x", "shaft.x", true),
            ("shaft*", "shaft", true),
            ("shaft.x*y", "shaft.x", false),
        ] {
            assert_eq!(matches(pattern, name), expected, "{pattern} {name}");
        }
    }
}
