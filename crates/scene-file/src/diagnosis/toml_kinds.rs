//! Which keys a table of the scene file takes, and what kind of value each: asked of the structures that read them, so
//! that no list can differ from them.

use serde::Deserialize;
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// Names of keys.
pub(super) type Keys = &'static [&'static str];

/// What kind of value a key takes.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    /// A number.
    Number,
    /// A whole number; with `true` none below 0.
    Whole(bool),
    /// Any text.
    Text,
    /// One of these words.
    Word(Keys),
    /// Two values of a kind.
    Pair(Box<Kind>),
    /// Any number of values of a kind.
    List(Box<Kind>),
    /// A table.
    Table,
    /// One table, or several of the name.
    OneOrMore,
}

/// A table of the scene file.
pub(super) struct TableOf {
    /// Its name; empty for the file itself.
    pub(super) name: &'static str,
    /// Its keys.
    pub(super) keys: Keys,
    kind: fn(&'static str) -> Option<Kind>,
}

impl TableOf {
    /// The table that a structure reads.
    pub(super) fn of<'a, T: Deserialize<'a>>(name: &'static str) -> Self {
        let keys = match T::deserialize(AskTable(None)) {
            Err(Answer::Keys(keys)) => keys,
            _ => &[],
        };
        Self { name, keys, kind: kind::<T> }
    }

    /// The kind of value that one of its keys takes.
    pub(super) fn kind(&self, key: &str) -> Option<Kind> {
        self.keys.iter().find(|known| **known == key).and_then(|known| (self.kind)(known))
    }
}

fn kind<'a, T: Deserialize<'a>>(key: &'static str) -> Option<Kind> {
    match T::deserialize(AskTable(Some(key))) {
        Err(Answer::Kind(kind)) => Some(kind),
        _ => None,
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => f.write_str("a number"),
            Self::Whole(true) => f.write_str("a whole number, 0 or more"),
            Self::Whole(false) => f.write_str("a whole number"),
            Self::Text => f.write_str("a text in quotes"),
            Self::Word(words) => match words {
                [only] => write!(f, "\"{only}\""),
                [rest @ .., last] => {
                    rest.iter().try_for_each(|word| write!(f, "\"{word}\", "))?;
                    write!(f, "or \"{last}\"")
                }
                [] => Ok(()),
            },
            Self::Pair(kind) => write!(f, "a list of two {}", kind.several()),
            Self::List(kind) => write!(f, "a list of {}", kind.several()),
            Self::Table => f.write_str("one table"),
            Self::OneOrMore => f.write_str("a table, or several"),
        }
    }
}

impl Kind {
    fn several(&self) -> &'static str {
        match self {
            Self::Number => "numbers",
            Self::Whole(_) => "whole numbers",
            Self::Text | Self::Word(_) => "texts in quotes",
            Self::Pair(_) | Self::List(_) => "lists",
            Self::Table | Self::OneOrMore => "tables",
        }
    }
}

/// What a structure asks for, as the error of the one who asks it.
#[derive(Debug)]
enum Answer {
    Keys(Keys),
    Kind(Kind),
    Nothing,
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

impl std::error::Error for Answer {}

impl serde::de::Error for Answer {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Self::Nothing
    }
}

/// Asks a structure for its keys, or gives it one key to see what it wants to read there.
struct AskTable(Option<&'static str>);

impl<'de> Deserializer<'de> for AskTable {
    type Error = Answer;

    fn deserialize_struct<V: Visitor<'de>>(self, _: &'static str, keys: Keys, visitor: V) -> Result<V::Value, Answer> {
        match self.0 {
            None => Err(Answer::Keys(keys)),
            Some(_) => visitor.visit_map(self),
        }
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Answer> {
        Err(Answer::Nothing)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

impl<'de> MapAccess<'de> for AskTable {
    type Error = Answer;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Answer> {
        let key: Option<StrDeserializer<'static, Answer>> = self.0.map(IntoDeserializer::into_deserializer);
        key.map(|key| seed.deserialize(key)).transpose()
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Answer> {
        seed.deserialize(AskValue)
    }
}

/// Answers what kind of value is to be read.
struct AskValue;

fn answer<T>(kind: Kind) -> Result<T, Answer> {
    Err(Answer::Kind(kind))
}

fn list<T>(asked: Result<T, Answer>, of: fn(Box<Kind>) -> Kind) -> Result<T, Answer> {
    asked.map_err(|said| match said {
        Answer::Kind(kind) => Answer::Kind(of(Box::new(kind))),
        other => other,
    })
}

impl<'de> Deserializer<'de> for AskValue {
    type Error = Answer;

    fn deserialize_f64<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Answer> {
        answer(Kind::Number)
    }

    fn deserialize_i64<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Answer> {
        answer(Kind::Whole(false))
    }

    fn deserialize_u32<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Answer> {
        answer(Kind::Whole(true))
    }

    fn deserialize_u64<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Answer> {
        answer(Kind::Whole(true))
    }

    fn deserialize_string<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Answer> {
        answer(Kind::Text)
    }

    fn deserialize_enum<V: Visitor<'de>>(self, _: &'static str, words: Keys, _: V) -> Result<V::Value, Answer> {
        answer(Kind::Word(words))
    }

    fn deserialize_struct<V: Visitor<'de>>(self, _: &'static str, _: Keys, _: V) -> Result<V::Value, Answer> {
        answer(Kind::Table)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Answer> {
        visitor.visit_some(self)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Answer> {
        list(visitor.visit_seq(self), Kind::List)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Answer> {
        list(visitor.visit_seq(self), Kind::Pair)
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Answer> {
        answer(Kind::OneOrMore)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i128 u8 u16 u128 f32 char str bytes byte_buf unit unit_struct newtype_struct tuple_struct map
        identifier ignored_any
    }
}

impl<'de> SeqAccess<'de> for AskValue {
    type Error = Answer;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Answer> {
        seed.deserialize(AskValue).map(Some)
    }
}
