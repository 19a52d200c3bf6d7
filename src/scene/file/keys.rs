//! What is wrong with the keys of a scene file, all of it at once. Asked only of a file that was refused.

use super::super::key_fault::{Hint, KeyFault};
use super::bearing::BearingTable;
use super::cage::CageTable;
use super::film::FilmTable;
use super::not_modelled::instead_of;
use super::rings::{HousingTable, ProbeTable, SensorModeTable, SensorTable, ShaftTable};
use super::values;
use super::{ContactTable, DefectTable, ExperimentTable, RecorderTable, SceneError, SceneFile, SolverTable};
use serde::Deserialize;
use serde::de::{Deserializer, Visitor};
use std::fmt;
use toml::de::{DeTable, DeValue};

type Keys = &'static [&'static str];

/// Keys that a table cannot be without. The file itself is the table without a name.
const NEEDED: [(&str, Keys); 8] = [
    ("", &["name", "bearing", "shaft", "housing"]),
    ("bearing", &["element_count", "element_diameter_mm", "pitch_diameter_mm", "youngs_modulus_gpa", "poissons_ratio"]),
    ("film", &["viscosity_pa_s", "pressure_viscosity_1_pa"]),
    ("defect", &["angle_deg"]),
    ("shaft", &["motion", "speed_hz"]),
    ("housing", &["motion"]),
    ("sensor.mode", &["frequency_hz", "damping_ratio", "gain"]),
    ("recorder", &["rate_hz"]),
];

/// Table, two keys of which one is needed, and keys that go without both.
const ALTERNATIVES: [(&str, [&str; 2], Keys); 4] = [
    ("bearing", GROOVES, &["conformity_outer"]),
    ("bearing", ["density_kg_m3", "element_mass_g"], &[]),
    ("defect", ["length_deg", "length_mm"], &["profile"]),
    ("defect", ["depth_um", "profile"], &[]),
];

/// Two keys of which balls need one, and the key that rollers need instead, with the words for both.
const GROOVES: [&str; 2] = ["groove_diameter_mm", "conformity_inner"];
const BALL: &str = "ball";
const ROLLER: &str = "cylindrical-roller";
const ROLLER_LENGTH: &str = "roller_length_mm";

/// All tables and the keys that each takes, as the tables themselves say.
fn tables() -> [(&'static str, Keys); 14] {
    [
        ("", fields::<SceneFile>()),
        ("bearing", fields::<BearingTable>()),
        ("contact", fields::<ContactTable>()),
        ("film", fields::<FilmTable>()),
        ("cage", fields::<CageTable>()),
        ("defect", fields::<DefectTable>()),
        ("shaft", fields::<ShaftTable>()),
        ("housing", fields::<HousingTable>()),
        ("sensor", fields::<SensorTable>()),
        ("sensor.mode", fields::<SensorModeTable>()),
        ("probe", fields::<ProbeTable>()),
        ("solver", fields::<SolverTable>()),
        ("recorder", fields::<RecorderTable>()),
        ("experiment", fields::<ExperimentTable>()),
    ]
}

/// The error for a file that was refused with `error`: with it all faults of its keys, and of its values that are wrong
/// by themselves.
pub(super) fn all_faults(text: &str, error: SceneError) -> SceneError {
    let Ok(mut faults) = DeTable::parse(text).map(|file| faults(text, file.get_ref())) else { return error };
    // A file that is not understood is not understood for one of its keys; without them it says where.
    let of_keys = faults.iter().any(|fault| !matches!(fault, KeyFault::Value { .. }));
    let breaks: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
    let mut more = Vec::new();
    for other in error.clone().each() {
        let said = other.in_list();
        let (line, said) = match &other {
            SceneError::Toml(_) | SceneError::Neither { .. } if of_keys => continue,
            SceneError::Toml(wrong) => {
                (wrong.span().map_or(0, |at| line_of(&breaks, at.start)), wrong.message().to_owned())
            }
            _ => (0, said),
        };
        let is_told = |fault: &KeyFault| match fault {
            KeyFault::Value { line: at, said: told } => said.ends_with(told) || (line > 0 && *at == line),
            _ => false,
        };
        if !faults.iter().any(is_told) {
            more.push(KeyFault::Value { line, said });
        }
    }
    faults.extend(more);
    faults.sort_by_key(KeyFault::line);
    match &faults[..] {
        [] | [KeyFault::Value { .. }] => error,
        _ => SceneError::Keys(faults),
    }
}

fn faults(text: &str, file: &DeTable<'_>) -> Vec<KeyFault> {
    let breaks: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
    let mut faults = Vec::new();
    for (name, keys) in tables() {
        if name.is_empty() {
            faults.extend(of_table(&breaks, (name, keys), 0, file));
        }
        for (at, table) in all_of(name, file) {
            faults.extend(of_table(&breaks, (name, keys), line_of(&breaks, at), table));
        }
    }
    faults.sort_by_key(KeyFault::line);
    faults
}

/// Names of tables of which there may be several.
const SEVERAL: [&str; 3] = ["defect", "sensor", "sensor.mode"];

/// All tables of a name, and where each begins. What is of the wrong type is no matter of keys.
fn all_of<'a, 'f>(name: &str, file: &'a DeTable<'f>) -> Vec<(usize, &'a DeTable<'f>)> {
    let (within, last) = match name.rsplit_once('.') {
        None => (vec![file], name),
        Some((outer, last)) => (all_of(outer, file).into_iter().map(|(_, table)| table).collect(), last),
    };
    let mut found = Vec::new();
    for value in within.into_iter().filter_map(|table| table.get(last)) {
        match value.get_ref() {
            DeValue::Table(table) => found.push((value.span().start, table)),
            DeValue::Array(tables) if SEVERAL.contains(&name) => {
                let tables = tables.iter().map(|value| (value.span().start, value.get_ref()));
                found.extend(tables.filter_map(|(at, value)| value.as_table().map(|table| (at, table))));
            }
            _ => {}
        }
    }
    found
}

/// Faults of a table whose head stands in `line`; lines end at `breaks`.
fn of_table(breaks: &[usize], (name, keys): (&str, Keys), line: usize, table: &DeTable<'_>) -> Vec<KeyFault> {
    let mut faults = Vec::new();
    // What is there under another spelling is not missing as well.
    let mut there: Vec<&str> = table.keys().map(|key| key.get_ref().as_ref()).collect();
    for (key, value) in table.iter().filter(|(key, _)| !keys.contains(&key.get_ref().as_ref())) {
        let (line, key) = (line_of(breaks, key.span().start), key.get_ref());
        let shown = path(name, key, matches!(value.get_ref(), DeValue::Table(_) | DeValue::Array(_)));
        // A slip of the pen in a key of rollers asks for nothing that there is not.
        let slip = key.starts_with("roller_") && nearest(keys, key).is_some();
        faults.push(match instead_of(name, key).filter(|_| !slip) {
            Some(only) => KeyFault::NotModelled { line, key: shown, only },
            None => KeyFault::Unknown { line, key: shown, hint: hint(name, keys, key) },
        });
        there.extend(nearest(keys, key));
    }
    for (key, value) in table {
        let wrong = values::fault(&path(name, key.get_ref(), false), value.get_ref());
        let line = line_of(breaks, key.span().start);
        faults.extend(wrong.map(|wrong| KeyFault::Value { line, said: wrong.to_string() }));
    }
    // A bearing of the catalogue needs nothing beside its name.
    if there.contains(&"catalogue") {
        return faults;
    }
    for key in needed(name).iter().filter(|key| !there.contains(key)) {
        // Of the file itself all but the name are tables.
        let is_table = name.is_empty() && *key != "name";
        let with = if is_table { needed(key) } else { &[] };
        faults.push(KeyFault::Missing { line, key: path(name, key, is_table), with });
    }
    let kind = table.get("element").filter(|_| name == "bearing").and_then(|kind| kind.get_ref().as_str());
    if kind == Some(ROLLER) && !there.contains(&ROLLER_LENGTH) {
        faults.push(KeyFault::Missing { line, key: path(name, ROLLER_LENGTH, false), with: &[] });
    }
    for (_, two, instead) in ALTERNATIVES.iter().filter(|(table, ..)| *table == name) {
        if two == &GROOVES && kind.is_some_and(|kind| kind != BALL) {
            continue;
        }
        if !two.iter().chain(*instead).any(|key| there.contains(key)) {
            faults.push(KeyFault::Neither { line, keys: two.map(|key| path(name, key, false)) });
        }
    }
    faults
}

fn needed(table: &str) -> Keys {
    NEEDED.iter().find(|(name, _)| *name == table).map_or(&[], |(_, keys)| keys)
}

/// A key with its table, as it is shown; a table in brackets.
fn path(table: &str, key: &str, is_table: bool) -> String {
    let path = if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") };
    if is_table { format!("[{path}]") } else { path }
}

/// Line of a place in a text with these line breaks, from 1.
fn line_of(breaks: &[usize], at: usize) -> usize {
    1 + breaks.partition_point(|&end| end < at)
}

fn hint(table: &str, keys: Keys, key: &str) -> Hint {
    let elsewhere = tables().into_iter().find(|(name, keys)| *name != table && keys.contains(&key));
    match (elsewhere, nearest(keys, key)) {
        (Some((other, _)), _) if !other.is_empty() => Hint::BelongsTo(other),
        (_, Some(near)) => Hint::DidYouMean(near),
        _ => Hint::Takes(keys),
    }
}

/// The key that is spelt most like this one: without its unit, or a third of the letters off.
fn nearest(keys: Keys, key: &str) -> Option<&'static str> {
    let key = key.to_lowercase().replace('-', "_");
    let away = |other: &str| if other.starts_with(&key) { 1 } else { distance(other, &key) };
    let nearest = keys.iter().copied().min_by_key(|other| away(other))?;
    (away(nearest) <= (key.chars().count() / 3).max(1)).then_some(nearest)
}

/// Letters to be put in, left out or exchanged to make one word of the other (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut aslant = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let exchanged = aslant + usize::from(from != *to);
            aslant = row[j + 1];
            row[j + 1] = exchanged.min(row[j] + 1).min(aslant + 1);
        }
    }
    row[b.len()]
}

/// The keys that a table takes.
fn fields<'a, T: Deserialize<'a>>() -> Keys {
    T::deserialize(Ask).err().map_or(&[], |Fields(keys)| keys)
}

/// Gives the names of the fields that a structure asks for, as its error.
struct Ask;

#[derive(Debug)]
struct Fields(Keys);

impl fmt::Display for Fields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.join(", "))
    }
}

impl std::error::Error for Fields {}

impl serde::de::Error for Fields {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self(&[])
    }
}

impl<'de> Deserializer<'de> for Ask {
    type Error = Fields;

    fn deserialize_struct<V: Visitor<'de>>(self, _: &'static str, fields: Keys, _: V) -> Result<V::Value, Fields> {
        Err(Fields(fields))
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Fields> {
        Err(Fields(&[]))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_say_themselves_which_keys_they_cannot_be_without() {
        // serde names the first that is missing; the files below lack one each.
        let lines =
            |table: &str| needed(table).iter().map(|key| format!("{key} = {}\n", value_of(key))).collect::<Vec<_>>();
        for (table, keys) in tables().into_iter().filter(|(table, _)| !table.is_empty()) {
            let whole = lines(table);
            let refused = |text: &str| refusal(table, text);
            assert_eq!(refused(&whole.concat()), None, "[{table}] asks for more than is listed");
            for (i, key) in needed(table).iter().enumerate() {
                assert!(keys.contains(key), "[{table}] has no {key}");
                let without: String =
                    whole.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, line)| line.as_str()).collect();
                let why = refused(&without).unwrap_or_default();
                assert!(why.contains(&format!("missing field `{key}`")), "[{table}] without {key}: {why}");
            }
        }
    }

    fn value_of(key: &str) -> &'static str {
        match key {
            "element_count" => "9",
            "motion" => "\"internal\"",
            _ => "1.0",
        }
    }

    fn refusal(table: &str, text: &str) -> Option<String> {
        fn of<T: for<'a> Deserialize<'a>>(text: &str) -> Option<String> {
            toml::from_str::<T>(text).err().map(|error| error.message().to_owned())
        }
        match table {
            "bearing" => of::<BearingTable>(text),
            "contact" => of::<ContactTable>(text),
            "film" => of::<FilmTable>(text),
            "cage" => of::<CageTable>(text),
            "defect" => of::<DefectTable>(text),
            "shaft" => of::<ShaftTable>(text),
            "housing" => of::<HousingTable>(text),
            "sensor" => of::<SensorTable>(text),
            "sensor.mode" => of::<SensorModeTable>(text),
            "probe" => of::<ProbeTable>(text),
            "solver" => of::<SolverTable>(text),
            "recorder" => of::<RecorderTable>(text),
            _ => of::<ExperimentTable>(text),
        }
    }

    #[test]
    fn every_table_of_the_file_says_its_keys() {
        let tables = tables();
        // Of a probe there is nothing to be said.
        assert!(tables.iter().all(|(name, keys)| !keys.is_empty() || ["", "probe"].contains(name)), "{tables:?}");
        for key in tables[0].1.iter().filter(|key| !["name", "description", "gravity_m_s2"].contains(key)) {
            assert!(tables.iter().any(|(table, _)| table == key), "[{key}] is not looked at");
        }
    }

    #[test]
    fn words_are_as_far_apart_as_letters_change() {
        for (a, b, expected) in [("slip", "slip", 0), ("slip", "slipp", 1), ("solver", "solwer", 1), ("", "abc", 3)] {
            assert_eq!((distance(a, b), distance(b, a)), (expected, expected), "{a} {b}");
        }
        assert_eq!(nearest(&["depth_um", "length_deg"], "depth"), Some("depth_um"));
        assert_eq!(nearest(&["depth_um", "length_deg"], "colour"), None);
    }
}
