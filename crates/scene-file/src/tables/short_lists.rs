//! Lists of two or three values. An array that serde reads ends after its last value, whatever follows in the file.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// Two values, neither fewer nor more, of a key that may be left out.
pub(super) fn pair<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<Option<[T; 2]>, D::Error> {
    let all = deserializer.deserialize_seq(Values { least: 2, most: 2, of: PhantomData })?;
    Ok(all.try_into().ok())
}

/// Three numbers, x, y and z.
pub(super) fn triple<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[f64; 3]>, D::Error> {
    let all = deserializer.deserialize_seq(Values { least: 3, most: 3, of: PhantomData })?;
    Ok(all.try_into().ok())
}

/// Numbers along x and y and, where there is a third one, along z.
#[derive(Clone, Copy)]
pub(super) struct Vector {
    pub(super) across: [f64; 2],
    pub(super) axial: Option<f64>,
}

impl fmt::Display for Vector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers: Vec<f64> = self.across.into_iter().chain(self.axial).collect();
        write!(f, "{numbers:?}")
    }
}

impl<'de> Deserialize<'de> for Vector {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let all = deserializer.deserialize_seq(Values { least: 2, most: 3, of: PhantomData })?;
        Ok(Self { across: [all[0], all[1]], axial: all.get(2).copied() })
    }
}

/// What holds without the key stands in the schema.
impl Serialize for Vector {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.across.into_iter().chain(self.axial))
    }
}

impl JsonSchema for Vector {
    fn schema_name() -> Cow<'static, str> {
        "Vector".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let number = json_schema!({ "type": "number", "format": "double" });
        json_schema!({ "type": "array", "items": number, "minItems": 2, "maxItems": 3 })
    }
}

struct Values<T> {
    least: usize,
    most: usize,
    of: PhantomData<T>,
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Values<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of {} to {} values", self.least, self.most)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<Vec<T>, A::Error> {
        let mut all = Vec::new();
        while let Some(value) = values.next_element()? {
            all.push(value);
        }
        let fits = (self.least..=self.most).contains(&all.len());
        if fits { Ok(all) } else { Err(A::Error::invalid_length(all.len(), &self)) }
    }
}
