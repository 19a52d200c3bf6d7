//! All tables of a scene file and their keys, of the schema that is made of the structures which read them: no list can
//! differ from it.

use super::toml_kinds::Kind;
use crate::schema::{schema, table};
use serde_json::Value;
use std::sync::LazyLock;

/// The names, in the order in which a key's table is looked for; the empty one is the file itself.
const NAMES: [&str; 16] = [
    "",
    "bearing",
    "contact",
    "film",
    "cage",
    "defect",
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

/// A table of the scene file.
pub(super) struct TableOf {
    /// Its name; empty for the file itself.
    pub(super) name: &'static str,
    /// Its keys.
    pub(super) keys: Vec<&'static str>,
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
            let properties = table(&SCHEMA, name).and_then(|table| table["properties"].as_object());
            let (keys, kinds) =
                properties.into_iter().flatten().map(|(key, part)| (key.as_str(), Kind::of(&SCHEMA, part))).unzip();
            TableOf { name, keys, kinds }
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
