//! What kind of value a key takes, as the schema of the file says.

use serde_json::Value;
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
    /// Yes or no.
    Flag,
    /// Any text.
    Text,
    /// One of these words.
    Word(Vec<&'static str>),
    /// So many values of a kind, from least to most.
    Short(Box<Kind>, [u64; 2]),
    /// Any number of values of a kind.
    List(Box<Kind>),
    /// A table.
    Table,
    /// One table, or several of the name.
    OneOrMore,
    /// A text, or a table in its place.
    TextOrTable,
}

impl Kind {
    /// The kind that a part of the schema describes.
    pub(super) fn of(schema: &'static Value, part: &'static Value) -> Option<Self> {
        if let Some(path) = part["$ref"].as_str() {
            return Self::of(schema, schema.pointer(path.strip_prefix('#')?)?);
        }
        match part["anyOf"].as_array().map(Vec::as_slice) {
            // A key that may be left out.
            Some([one, none]) if none["type"] == "null" => return Self::of(schema, one),
            Some([_, text]) if text["type"] == "string" => return Some(Self::TextOrTable),
            Some(_) => return Some(Self::OneOrMore),
            None => {}
        }
        if let Some(words) = words(part) {
            return Some(Self::Word(words));
        }
        let name = if part["type"].is_array() { &part["type"][0] } else { &part["type"] };
        match name.as_str()? {
            "number" => Some(Self::Number),
            "integer" => Some(Self::Whole(part["format"].as_str()?.starts_with('u'))),
            "boolean" => Some(Self::Flag),
            "string" => Some(Self::Text),
            "object" => Some(Self::Table),
            "array" => {
                let of = Box::new(Self::of(schema, &part["items"])?);
                let lengths = part["minItems"].as_u64().zip(part["maxItems"].as_u64());
                Some(match lengths {
                    Some((least, most)) => Self::Short(of, [least, most]),
                    None => Self::List(of),
                })
            }
            _ => None,
        }
    }

    fn several(&self) -> &'static str {
        match self {
            Self::Number => "numbers",
            Self::Whole(_) => "whole numbers",
            Self::Flag => "answers",
            Self::Text | Self::Word(_) => "texts in quotes",
            Self::Short(..) | Self::List(_) => "lists",
            Self::Table | Self::OneOrMore | Self::TextOrTable => "tables",
        }
    }
}

/// The words of which a value must be one: all together, or each beside what it means.
fn words(part: &'static Value) -> Option<Vec<&'static str>> {
    if let Some(words) = part["enum"].as_array() {
        let words: Vec<&str> = words.iter().filter_map(Value::as_str).collect();
        // Numbers of which a value must be one are no words.
        return (!words.is_empty()).then_some(words);
    }
    let each = part["oneOf"].as_array()?.iter();
    Some(
        each.flat_map(|one| one["const"].as_str().map(|word| vec![word]).or_else(|| words(one)).unwrap_or_default())
            .collect(),
    )
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => f.write_str("a number"),
            Self::Whole(true) => f.write_str("a whole number, 0 or more"),
            Self::Whole(false) => f.write_str("a whole number"),
            Self::Flag => f.write_str("true or false"),
            Self::Text => f.write_str("a text in quotes"),
            Self::Word(words) => match words.as_slice() {
                [only] => write!(f, "\"{only}\""),
                [rest @ .., last] => {
                    rest.iter().try_for_each(|word| write!(f, "\"{word}\", "))?;
                    write!(f, "or \"{last}\"")
                }
                [] => Ok(()),
            },
            Self::Short(kind, lengths) => {
                let how_many = match lengths {
                    [2, 2] => "two",
                    [2, 3] => "two or three",
                    _ => "three",
                };
                write!(f, "a list of {how_many} {}", kind.several())
            }
            Self::List(kind) => write!(f, "a list of {}", kind.several()),
            Self::Table => f.write_str("one table"),
            Self::OneOrMore => f.write_str("a table, or several"),
            Self::TextOrTable => f.write_str("a text in quotes, or a table"),
        }
    }
}
