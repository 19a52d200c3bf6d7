//! Where tables stand in a scene file, and which keys a message names.

use super::all_tables::tables;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A table of the file: its name, empty for the file itself, and from 0 its number among those of the name; of a table
/// within another that of the outer one first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Location {
    pub(super) table: &'static str,
    pub(super) number: [usize; 2],
}

/// A table that there is, and where in the text it begins; the file itself at its beginning.
pub(super) struct Found<'a, 'f> {
    pub(super) location: Location,
    pub(super) at: Option<usize>,
    pub(super) table: &'a DeTable<'f>,
}

/// Names of tables of which there may be several.
const SEVERAL: [&str; 4] = ["defect", "waviness", "sensor", "sensor.mode"];

/// All tables of a name. What is of the wrong type is none.
pub(super) fn all_of<'a, 'f>(name: &'static str, file: &'a DeTable<'f>) -> Vec<Found<'a, 'f>> {
    if name.is_empty() {
        return vec![Found { location: Location { table: "", number: [0; 2] }, at: None, table: file }];
    }
    let (outer, last) = name.rsplit_once('.').unwrap_or(("", name));
    let depth = usize::from(!outer.is_empty());
    let mut found = Vec::new();
    for outer in all_of(outer, file) {
        let Some(value) = outer.table.get(last) else { continue };
        let mut keep = |k: usize, at: usize, table: &'a DeTable<'f>| {
            let mut number = outer.location.number;
            number[depth] = k;
            found.push(Found { location: Location { table: name, number }, at: Some(at), table });
        };
        match value.get_ref() {
            DeValue::Table(table) => keep(0, value.span().start, table),
            DeValue::Array(values) if SEVERAL.contains(&name) => {
                for (k, value) in values.iter().enumerate() {
                    if let Some(table) = value.get_ref().as_table() {
                        keep(k, value.span().start, table);
                    }
                }
            }
            _ => {}
        }
    }
    found
}

/// The table of a file at a location.
pub(super) fn at_mut<'a, 'f>(file: &'a mut DeTable<'f>, location: Location) -> Option<&'a mut DeTable<'f>> {
    let names = location.table.split('.').filter(|name| !name.is_empty());
    names.zip(location.number).try_fold(file, |table, (name, number)| match table.get_mut(name)?.get_mut() {
        DeValue::Table(table) => Some(table),
        DeValue::Array(tables) => table_mut(tables.get_mut(number)?),
        _ => None,
    })
}

/// A value that is a table.
pub(super) fn table_mut<'a, 'f>(value: &'a mut Spanned<DeValue<'f>>) -> Option<&'a mut DeTable<'f>> {
    if let DeValue::Table(table) = value.get_mut() { Some(table) } else { None }
}

/// The keys that a message names with their tables, and the one of the file itself, in its order. The tables of which
/// there are several are those of this number.
pub(super) fn named(message: &str, number: [usize; 2]) -> Vec<(Location, &'static str)> {
    let mut named: Vec<(Location, &'static str)> = Vec::new();
    let tables = tables();
    for word in message.split(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '.') {
        let word = word.trim_end_matches('.');
        let (table, key) = word.rsplit_once('.').unwrap_or(("", word));
        // Keys of the file itself are words of the language, except for one.
        let known = tables.iter().find(|known| known.name == table && (!table.is_empty() || word == "gravity_m_s2"));
        let Some((known, key)) = known.and_then(|known| known.keys.iter().find(|k| **k == key).map(|k| (known, *k)))
        else {
            continue;
        };
        let number = match known.name {
            "sensor.mode" => number,
            name if SEVERAL.iter().any(|of| name.split('.').next() == Some(of)) => [number[0], 0],
            _ => [0; 2],
        };
        let one = (Location { table: known.name, number }, key);
        if !named.contains(&one) {
            named.push(one);
        }
    }
    named
}
