//! All tables of a scene file and their keys, of the schema that is made of the structures which read them: no list can
//! differ from it.

use super::toml_kinds::Kind;
use crate::schema::{schema, table};
use serde_json::Value;
use std::sync::LazyLock;

/// The names, in the order in which a key's table is looked for; the empty one is the file itself.
const NAMES: [&str; 17] = [
    "",
    "bearing",
    "contact",
    "film",
    "cage",
    "defect",
    "defect.profile",
    "waviness",
    "shaft",
    "housing",
    "sensor",
    "sensor.mode",
    "probe",
    "solver",
    "host",
    "recorder",
    "experiment",
];

/// Keys that a bearing cannot be without, unless it is one of the catalogue.
const NEEDED_OF_A_BEARING: [&str; 5] =
    ["element_count", "element_diameter_mm", "pitch_diameter_mm", "youngs_modulus_gpa", "poissons_ratio"];

/// A table of the scene file.
pub(super) struct TableOf {
    /// Its name; empty for the file itself.
    pub(super) name: &'static str,
    /// Its keys.
    pub(super) keys: Vec<&'static str>,
    /// Those that it cannot be without.
    pub(super) needed: Vec<&'static str>,
    kinds: Vec<Option<Kind>>,
}

impl TableOf {
    /// The kind of value that one of its keys takes.
    pub(super) fn kind(&self, key: &str) -> Option<&Kind> {
        self.kinds[self.keys.iter().position(|known| *known == key)?].as_ref()
    }
}

/// All tables and the keys that each takes.
pub(super) fn tables() -> &'static [TableOf] {
    static SCHEMA: LazyLock<Value> = LazyLock::new(|| schema().into());
    static TABLES: LazyLock<Vec<TableOf>> = LazyLock::new(|| {
        let table_of = |name| {
            let table = table(&SCHEMA, name);
            let properties = table.and_then(|table| table["properties"].as_object());
            let (keys, kinds) =
                properties.into_iter().flatten().map(|(key, part)| (key.as_str(), Kind::of(&SCHEMA, part))).unzip();
            let required = table.and_then(|table| table["required"].as_array());
            let needed = match name {
                "bearing" => NEEDED_OF_A_BEARING.into(),
                _ => required.into_iter().flatten().filter_map(Value::as_str).collect(),
            };
            TableOf { name, keys, needed, kinds }
        };
        NAMES.map(table_of).into()
    });
    &TABLES
}

/// A key with its table, as it is shown; a table in brackets.
pub(super) fn path(table: &str, key: &str, is_table: bool) -> String {
    let path = if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") };
    if is_table { format!("[{path}]") } else { path }
}
