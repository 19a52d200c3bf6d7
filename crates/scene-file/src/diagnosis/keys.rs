//! What is wrong with the keys of a scene file. Asked only of a file that was refused.

use super::all_tables::{TableOf, path, tables};
use super::key_fault::{Hint, KeyFault};
use super::locations::{Found, Location};
use super::not_modelled::instead_of;
use super::toml_kinds::Keys;
use super::values;
use crate::rivals::exclude_each_other;
use crate::spelling::nearest;
use toml::de::DeValue;

/// Table, and two keys of which one is needed, or a key that excludes the first.
const ALTERNATIVES: [(&str, [&str; 2]); 4] = [
    ("bearing", GROOVES),
    ("bearing", ["density_kg_m3", "element_mass_g"]),
    ("defect", ["length_deg", "length_mm"]),
    ("defect", ["depth_um", "profile"]),
];

/// Two keys of which balls need one, and the key that rollers need instead, with the words for both.
const GROOVES: [&str; 2] = ["groove_diameter_mm", "conformity_inner"];
const BALL: &str = "ball";
const ROLLER: &str = "cylindrical-roller";
const ROLLER_LENGTH: &str = "roller_length_mm";

/// A fault, and the keys that cannot be relied on because of it.
pub(super) struct Finding {
    pub(super) fault: KeyFault,
    pub(super) excludes: Vec<(Location, String)>,
}

/// Faults of a table's keys and of its values by themselves; `line` gives the line of an offset in the text.
pub(super) fn of_table(of: &'static TableOf, found: &Found<'_, '_>, line: &dyn Fn(usize) -> usize) -> Vec<Finding> {
    let (name, keys, table, location) = (of.name, of.keys.as_slice(), found.table, found.location);
    let head = found.at.map_or(0, line);
    let mut findings = Vec::new();
    let mut keep = |fault: KeyFault, excluded: &[&str]| {
        let excludes = excluded.iter().map(|key| (location, (*key).to_owned())).collect();
        findings.push(Finding { fault, excludes });
    };
    // What is there under another spelling is not missing as well.
    let mut there: Vec<&str> = table.keys().map(|key| key.get_ref().as_ref()).collect();
    for (key, value) in table {
        let (line, key) = (line(key.span().start), key.get_ref().as_ref());
        if keys.contains(&key) {
            if let Some(message) = values::fault(of, key, value.get_ref()) {
                keep(KeyFault::Value { line, message }, &[key]);
            }
            continue;
        }
        let (shown, near) = (path(name, key, is_table(value.get_ref())), nearest(keys.iter().copied(), key));
        // A slip of the pen in a key that there is asks for nothing that there is not.
        let alike = |near: &str| {
            ["roller_", "axial_", "contact_", "tilt_"].iter().any(|of| key.starts_with(of) && near.starts_with(of))
        };
        let slip = near.is_some_and(alike);
        let fault = match instead_of(name, key).filter(|_| !slip) {
            Some(only) => KeyFault::NotModelled { line, key: shown, only },
            None => KeyFault::Unknown { line, key: shown, hint: hint(name, keys, key) },
        };
        keep(fault, &[&[key], near.as_slice()].concat());
        there.extend(near);
    }
    // A bearing of the catalogue needs nothing beside its name.
    if there.contains(&"catalogue") {
        return findings;
    }
    for key in of.needed.iter().filter(|key| !there.contains(key)) {
        // Of the file itself all but the name are tables.
        let is_table = name.is_empty() && *key != "name";
        let with = if is_table { needed(key) } else { &[] };
        keep(KeyFault::Missing { line: head, key: path(name, key, is_table), with }, &[key]);
    }
    let kind = table.get("element").filter(|_| name == "bearing").and_then(|kind| kind.get_ref().as_str());
    if kind == Some(ROLLER) && !there.contains(&ROLLER_LENGTH) {
        keep(KeyFault::Missing { line: head, key: path(name, ROLLER_LENGTH, false), with: &[] }, &[ROLLER_LENGTH]);
    }
    for (_, two) in ALTERNATIVES.iter().filter(|(table, _)| *table == name) {
        if two == &GROOVES && kind.is_some_and(|kind| kind != BALL) {
            continue;
        }
        let keys = two.map(|key| path(name, key, false));
        let own = |key: &str| two.contains(&"density_kg_m3") && key == "element_density_kg_m3";
        if !there
            .iter()
            .any(|key| two.contains(key) || own(key) || exclude_each_other(&keys[0], &path(name, key, false)))
        {
            keep(KeyFault::Neither { line: head, keys }, two);
        }
    }
    findings
}

/// Whether a value is a table, or several of them.
fn is_table(value: &DeValue<'_>) -> bool {
    let all_tables =
        |values: &toml::de::DeArray<'_>| !values.is_empty() && values.iter().all(|value| value.get_ref().is_table());
    value.is_table() || value.as_array().is_some_and(all_tables)
}

fn needed(name: &str) -> Keys {
    tables().iter().find(|table| table.name == name).map_or(&[], |table| &table.needed)
}

fn hint(table: &str, keys: Keys, key: &str) -> Hint {
    let elsewhere = tables().iter().find(|other| other.name != table && other.keys.contains(&key));
    match (elsewhere, nearest(keys.iter().copied(), key)) {
        (Some(other), _) if !other.name.is_empty() => Hint::BelongsTo(other.name),
        (_, Some(near)) => Hint::DidYouMean(near),
        _ => Hint::Takes(keys),
    }
}

#[cfg(test)]
mod tests {
    use super::super::toml_kinds::Kind;
    use super::*;
    use crate::tables::BearingTable;
    use brinell::scene::DegreesOfFreedom;
    use serde::Deserialize;

    #[test]
    fn a_bearing_cannot_be_without_the_keys_that_it_needs() {
        let line = |key: &str| format!("{key} = {}\n", if key == "element_count" { "9" } else { "1.0" });
        let refusal = |without: &str| {
            let keys = needed("bearing").iter().filter(|key| **key != without).map(|key| line(key));
            let text = keys.collect::<String>() + "groove_diameter_mm = 1.0\ndensity_kg_m3 = 7800\n";
            let table = BearingTable::deserialize(toml::de::Deserializer::parse(&text).unwrap()).unwrap();
            table.into_bearing(DegreesOfFreedom::Two).err().map(|faults| faults.0[0].to_string())
        };
        assert_eq!(refusal(""), None);
        for key in needed("bearing") {
            let why = refusal(key).unwrap_or_default();
            assert!(why.starts_with(&format!("bearing.{key} is missing")), "without {key}: {why}");
        }
    }

    #[test]
    fn every_table_of_the_file_says_its_keys_and_what_kind_of_value_each_takes() {
        let tables = tables();
        for TableOf { name, keys, .. } in tables {
            // The probe is no table of a file.
            assert!(!keys.is_empty() || ["", "probe"].contains(name), "[{name}]");
        }
        for key in tables[0].keys.iter().filter(|key| !["name", "description", "gravity_m_s2"].contains(key)) {
            assert!(tables.iter().any(|table| table.name == *key), "[{key}] is not checked");
        }
        for table in tables {
            for key in &table.keys {
                assert!(table.kind(key).is_some(), "{}.{key}", table.name);
            }
        }
        let kind = |name: &str, key: &str| tables.iter().find(|table| table.name == name).unwrap().kind(key).unwrap();
        assert_eq!(kind("shaft", "motion"), &Kind::Word(vec!["host", "internal", "fixed"]));
        assert_eq!(kind("housing", "load_n"), &Kind::Short(Box::new(Kind::Number), [2, 3]));
        assert_eq!(kind("contact", "cells"), &Kind::Short(Box::new(Kind::Whole(true)), [2, 2]));
        assert_eq!(kind("cage", "spacing_deg"), &Kind::List(Box::new(Kind::Number)));
        assert_eq!(kind("sensor", "mode"), &Kind::List(Box::new(Kind::Table)));
        assert_eq!(kind("", "sensor"), &Kind::OneOrMore);
        assert_eq!(kind("", "probe"), &Kind::Table);
    }
}
