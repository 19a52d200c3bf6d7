//! All that is wrong with a scene file at once, each fault with its line; and what in it is to be asked about.
//!
//! First the keys and each value by itself. Then what is wrong is left out, something possible put where it is needed,
//! and the rest is read and checked as any file is; what that finds is left out in turn, until nothing is found. A
//! fault that speaks of what was left out follows from it and is left out.

use super::all_tables::{path, tables};
use super::key_fault::{KeyFault, SceneFileError};
use super::keys::{Finding, of_table};
use super::locations::{Location, all_of, named};
use super::repaired::{Repaired, checked};
use super::toml_fault::toml_fault;
use super::values::numbers;
use crate::tables::{Faults, SceneFile, TableFault};
use crate::units::{Dimensions, UnitQuestion, UnitRemark};
use brinell::scene::{Scene, SceneError};
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

/// How often the rest is read: each time at least one key more is left out, and few files are as bad.
const ROUNDS: usize = 20;

/// The scene of a file, or all its faults, or the first place at which it is not TOML.
pub(crate) fn scene_of(text: &str) -> Result<Scene, SceneFileError> {
    let file = DeTable::parse(text).map_err(|error| SceneFileError::Toml(toml_fault(text).unwrap_or(error)))?;
    let read = SceneFile::deserialize(Deserializer::from(file.clone())).map_err(SceneFileError::Toml);
    read.and_then(|file| checked(file).map_err(as_error)).map_err(|error| all_faults(text, file, error))
}

/// Faults without lines.
fn as_error(faults: Faults) -> SceneFileError {
    let value = |fault: TableFault| KeyFault::Value { line: 0, message: fault.to_string() };
    SceneFileError::Keys(faults.0.into_iter().map(value).collect())
}

/// The error for a file that was refused with `error`: all its faults, each with its line.
fn all_faults(text: &str, file: Spanned<DeTable<'_>>, error: SceneFileError) -> SceneFileError {
    let mut repaired = Repaired::of(file.clone());
    let reading = Reading::new(text, file.get_ref());
    let mut faults = Vec::new();
    for Finding { fault, excludes } in reading.findings() {
        excludes.iter().for_each(|(location, key)| {
            repaired.exclude(*location, key);
        });
        faults.push(fault);
    }
    for _ in 0..ROUNDS {
        let errors: Vec<_> = repaired.errors().into_iter().map(|error| (concerned(&error), error)).collect();
        for (keys, error) in &errors {
            let of_dimensions = error.is_of_dimensions() && repaired.lacks_dimensions();
            let follows = of_dimensions || keys.iter().any(|(location, key)| repaired.is_excluded(*location, key));
            if !follows {
                faults.push(reading.with_line(keys, error));
            }
        }
        let keys = errors.iter().flat_map(|(keys, _)| keys);
        if keys.filter(|(location, key)| repaired.exclude(*location, key)).count() == 0 {
            break;
        }
    }
    faults.sort_by_key(KeyFault::line);
    if faults.is_empty() { error } else { SceneFileError::Keys(faults) }
}

/// Questions about values of a file that was accepted.
pub(crate) fn unit_questions(text: &str) -> Vec<UnitRemark> {
    DeTable::parse(text).map_or(Vec::new(), |file| Reading::new(text, file.get_ref()).questions())
}

/// The keys that a fault speaks of.
fn concerned(fault: &TableFault) -> Vec<(Location, &'static str)> {
    let (number, of) = fault.in_tables();
    match of.downcast_ref() {
        Some(SceneError::Name(_)) => vec![(Location { table: "", number }, "name")],
        _ => named(&of.to_string(), number),
    }
}

/// A file, its line breaks, and its bearing's dimensions.
struct Reading<'a, 'f> {
    file: &'a DeTable<'f>,
    breaks: Vec<usize>,
    dimensions: Dimensions,
}

impl<'a, 'f> Reading<'a, 'f> {
    fn new(text: &str, file: &'a DeTable<'f>) -> Self {
        let bearing = file.get("bearing").and_then(|value| value.get_ref().as_table());
        let value = |key: &str| bearing.and_then(|bearing| bearing.get(key)).map(|value| value.get_ref());
        let name = value("catalogue").and_then(DeValue::as_str);
        let dimensions = Dimensions::of(name, |key| value(key).and_then(|value| numbers(value).first().copied()));
        Self { file, breaks: text.match_indices('\n').map(|(at, _)| at).collect(), dimensions }
    }

    /// Line of an offset in the text, from 1.
    fn line(&self, at: usize) -> usize {
        1 + self.breaks.partition_point(|&end| end < at)
    }

    /// Faults of keys and of values by themselves.
    fn findings(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        for of in tables() {
            for found in all_of(of.name, self.file) {
                findings.extend(of_table(of, &found, &|at| self.line(at)));
            }
        }
        for Finding { fault, excludes } in &mut findings {
            if let KeyFault::Value { message, .. } = fault {
                message.push_str(&self.asked(excludes.iter().map(|(location, key)| (*location, key.as_str()))));
            }
        }
        findings
    }

    /// A fault with its line.
    fn with_line(&self, keys: &[(Location, &'static str)], fault: &TableFault) -> KeyFault {
        let of_key = keys.iter().find_map(|(location, key)| self.find(*location, key).map(|(line, _)| line));
        let of_table = || {
            let (location, _) = keys.first()?;
            let found = all_of(location.table, self.file).into_iter().find(|found| found.location == *location)?;
            found.at.map(|at| self.line(at))
        };
        let asked = self.asked(keys.iter().map(|(location, key)| (*location, *key)));
        KeyFault::Value { line: of_key.or_else(of_table).unwrap_or(0), message: fault.to_string() + &asked }
    }

    /// Line and value of a key.
    fn find(&self, location: Location, key: &str) -> Option<(usize, &'a DeValue<'f>)> {
        let found = all_of(location.table, self.file).into_iter().find(|found| found.location == location)?;
        let (key, value) = found.table.get_key_value(key)?;
        Some((self.line(key.span().start), value.get_ref()))
    }

    /// The first question about the value of one of these keys, as the end of a message.
    fn asked<'k>(&self, keys: impl Iterator<Item = (Location, &'k str)>) -> String {
        let question = |(location, key): (Location, &str)| {
            let (_, value) = self.find(location, key)?;
            self.question(location.table, key, value)
        };
        keys.filter_map(question).next().map_or_else(String::new, |question| format!("; {}", question.short()))
    }

    fn question(&self, table: &str, key: &str, value: &DeValue<'_>) -> Option<UnitQuestion> {
        let key = path(table, key, false);
        // Of a vector its largest component.
        let largest = numbers(value).into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        self.dimensions.question(&key, largest)
    }

    fn questions(&self) -> Vec<UnitRemark> {
        let mut asked = Vec::new();
        for of in tables() {
            for found in all_of(of.name, self.file) {
                asked.extend(found.table.iter().filter_map(|(key, value)| {
                    let question = self.question(of.name, key.get_ref(), value.get_ref())?;
                    Some((self.line(key.span().start), question))
                }));
            }
        }
        asked.sort_by_key(|(line, _)| *line);
        asked.into_iter().map(|(line, question)| UnitRemark { line, question }).collect()
    }
}
