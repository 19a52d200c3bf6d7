//! A measured surface: its file, or a table `[defect.profile]` with what is done to it.

use brinell::scene::{Measured, MeasuredForm, MeasuredLevel};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A file of a measured trace or topography, and what is done to its depths, in this order.
#[derive(JsonSchema, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct ProfileFile {
    /// Its name, beside the scene file.
    file: String,
    /// Form of the ring that the trace still has: the "circle" through both ends, a tenth of the trace each, comes off.
    remove_form: Option<MeasuredForm>,
    /// What is smooth raceway: the straight line through both "ends", a tenth of the trace each, becomes depth 0.
    level: Option<MeasuredLevel>,
    /// Whether the file has heights above the raceway: depths are the opposite.
    #[serde(default)]
    invert: bool,
}

/// The table, or the name of the file alone.
pub(super) struct ProfileTable(ProfileFile);

impl ProfileTable {
    pub(super) fn into_measured(self) -> Measured {
        let ProfileFile { file, remove_form: form, level, invert } = self.0;
        Measured { file, form, level, invert }
    }
}

impl<'de> Deserialize<'de> for ProfileTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FileOrTable)
    }
}

struct FileOrTable;

impl<'de> Visitor<'de> for FileOrTable {
    type Value = ProfileTable;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a file, or a table [defect.profile]")
    }

    fn visit_str<E>(self, name: &str) -> Result<ProfileTable, E> {
        Ok(ProfileTable(ProfileFile { file: name.to_owned(), ..ProfileFile::default() }))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ProfileTable, A::Error> {
        ProfileFile::deserialize(MapAccessDeserializer::new(map)).map(ProfileTable)
    }
}

impl JsonSchema for ProfileTable {
    fn schema_name() -> Cow<'static, str> {
        "ProfileTable".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [generator.subschema_for::<ProfileFile>(), { "type": "string" }] })
    }
}
