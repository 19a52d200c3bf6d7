//! A table that may stand once, `[name]`, or several times, `[[name]]`.

use super::faults::Faults;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// All tables of one name, in the order of the file.
pub(super) struct OneOrMore<T>(pub(super) Vec<T>);

impl<T> OneOrMore<T> {
    /// What is made of each table; or all that is wrong with any of them, with their `name` and number.
    pub(super) fn each<U, F: Into<Faults>>(
        self,
        name: &'static str,
        made: impl Fn(T) -> Result<U, F>,
    ) -> Result<Vec<U>, Faults> {
        let count = self.0.len();
        let mut faults = Faults::default();
        let tables = self.0.into_iter().enumerate();
        let all = tables
            .filter_map(|(k, table)| faults.take(made(table).map_err(|of| of.into().in_table(name, k, count))))
            .collect();
        faults.into_result().map(|()| all)
    }
}

impl<T> Default for OneOrMore<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMore<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Tables(PhantomData))
    }
}

struct Tables<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Tables<T> {
    type Value = OneOrMore<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table [name], or several tables [[name]]")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<OneOrMore<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(|one| OneOrMore(vec![one]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<OneOrMore<T>, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(seq)).map(OneOrMore)
    }
}

impl<T: schemars::JsonSchema> schemars::JsonSchema for OneOrMore<T> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("OneOrMore{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let one = generator.subschema_for::<T>();
        schemars::json_schema!({ "anyOf": [one, { "type": "array", "items": one }] })
    }
}
