//! Values as they stand in a file, for serde to read.
//!
//! What toml offers instead keeps track of lines and knows types of its own, once for each structure that is read: a
//! tenth of the library in an FMU. Lines are found where a file is refused (`reading.rs`), and no key takes a date.

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, MapDeserializer, SeqDeserializer};
use serde::de::{Deserializer, Error as _, IntoDeserializer, Visitor};
use toml::de::{DeInteger, DeTable, DeValue, Error};

/// Reads a structure from a table.
///
/// # Errors
/// What the structure refuses: keys that are missing or unknown, values of another kind.
pub(super) fn read<'de, T: Deserialize<'de>>(table: &'de DeTable<'de>) -> Result<T, Error> {
    T::deserialize(MapAccessDeserializer::new(entries(table)))
}

fn entries<'de>(
    table: &'de DeTable<'de>,
) -> MapDeserializer<'de, impl Iterator<Item = (&'de str, Written<'de>)>, Error> {
    MapDeserializer::new(table.iter().map(|(key, value)| (&**key.get_ref(), Written(value.get_ref()))))
}

/// A value.
struct Written<'de>(&'de DeValue<'de>);

impl<'de> IntoDeserializer<'de, Error> for Written<'de> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for Written<'de> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.0 {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Integer(written) => match whole(written) {
                Some(Whole::Signed(number)) => visitor.visit_i64(number),
                Some(Whole::Large(number)) => visitor.visit_u64(number),
                None => Err(Error::custom("a whole number has more than 64 bits")),
            },
            DeValue::Float(written) => visitor.visit_f64(float(written.as_str())?),
            DeValue::Boolean(value) => visitor.visit_bool(*value),
            DeValue::Datetime(_) => Err(Error::custom("no key takes a date or a time")),
            DeValue::Array(values) => {
                visitor.visit_seq(SeqDeserializer::new(values.iter().map(|value| Written(value.get_ref()))))
            }
            DeValue::Table(table) => visitor.visit_map(entries(table)),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_some(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        match self.0.as_str() {
            Some(word) => visitor.visit_enum(word.into_deserializer()),
            None => Err(Error::custom("a word in quotes is needed")),
        }
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct
        newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

/// A whole number as it can be read.
pub(super) enum Whole {
    Signed(i64),
    /// Beyond the signed ones: seeds have 64 bits.
    Large(u64),
}

/// A whole number; `None` of one that has more than 64 bits.
pub(super) fn whole(written: &DeInteger<'_>) -> Option<Whole> {
    let (digits, radix) = (written.as_str(), written.radix());
    let signed = i64::from_str_radix(digits, radix).map(Whole::Signed);
    signed.or_else(|_| u64::from_str_radix(digits, radix).map(Whole::Large)).ok()
}

/// A number; one that is beyond all numbers is none, unless it is written as infinite.
fn float(written: &str) -> Result<f64, Error> {
    let number = written.parse().ok().filter(|number: &f64| !number.is_infinite() || written.contains("inf"));
    number.ok_or_else(|| Error::custom("a number is too large"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Values {
        #[serde(default)]
        numbers: Vec<f64>,
        #[serde(default)]
        seeds: Vec<u64>,
        text: Option<String>,
        word: Option<Word>,
        flag: Option<bool>,
        inner: Option<Box<Values>>,
    }

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Word {
        One,
        Two,
    }

    fn read_text(text: &str) -> Result<Values, String> {
        let file = DeTable::parse(text).unwrap();
        read(file.get_ref()).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn every_kind_of_value_is_read_as_toml_reads_it() {
        for text in [
            "numbers = [1, -2, 1_000, 0x1f, 0b11, 0o17, 1.5, -0.0, 1e-3, 6.0_2e23, inf, -inf]",
            "seeds = [0, 9223372036854775807, 9223372036854775808, 18446744073709551615, 0x7fff_ffff_ffff_ffff]",
            "text = \"a \\u00e9 \\n\"\nword = \"two\"\nflag = true",
            "word = 'one'\n[inner]\ninner.text = '''x\ny'''\ninner.flag = false",
            "inner = { text = 'in one line', inner = { numbers = [] } }",
        ] {
            let read = read_text(text).unwrap();
            assert_eq!(read, toml::from_str(text).unwrap(), "{text}");
        }
        let values = read_text("numbers = [0x1f, -inf, -0.0]\nseeds = [18446744073709551615]").unwrap();
        assert_eq!((values.numbers[0], values.numbers[1], values.seeds[0]), (31.0, f64::NEG_INFINITY, u64::MAX));
        assert!(values.numbers[2].is_sign_negative());
    }

    #[test]
    fn what_is_no_value_of_its_key_is_refused_as_toml_refuses_it() {
        for text in [
            "numbers = 1",
            "numbers = ['1']",
            "numbers = [1e999]",
            "numbers = [-1e999]",
            "numbers = [340282366920938463463374607431768211455]",
            "numbers = [999999999999999999999999999999999999999999]",
            "seeds = [-1]",
            "seeds = [1.0]",
            "seeds = [18446744073709551616]",
            "text = 1",
            "text = 1979-05-27",
            "word = 'three'",
            "word = 2",
            "flag = 'true'",
            "inner = 1",
            "inner = [1]",
            "[inner]\nunknown = 1",
            "[[inner]]\nflag = true",
        ] {
            assert!(read_text(text).is_err(), "{text}");
            assert!(toml::from_str::<Values>(text).is_err(), "{text}");
        }
        assert!(read_text("[inner]\nunknown = 1").unwrap_err().contains("unknown"));
        // The one difference: toml takes a table of one empty table for a word.
        assert!(toml::from_str::<Values>("word = { one = {} }").is_ok());
        assert!(read_text("word = { one = {} }").unwrap_err().contains("a word in quotes"));
    }
}
