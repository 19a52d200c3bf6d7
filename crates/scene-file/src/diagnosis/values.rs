//! What is wrong with single values of a scene file, whatever the rest of it says: of another kind than their key
//! takes, a word that is not known, outside its limits. Asked only of a file that was refused.

use super::all_tables::{TableOf, path};
use super::toml_kinds::Kind;
use crate::quantities::of_key;
use crate::spelling::nearest;
use toml::de::{DeInteger, DeValue};

/// Why the value of a key of a table cannot be.
pub(super) fn fault(table: &TableOf, key: &str, value: &DeValue<'_>) -> Option<String> {
    let whole = path(table.name, key, false);
    let limits = of_key(&whole);
    let beyond =
        limits.and_then(|(key, of)| numbers(value).into_iter().find_map(|value| of.check_written(key, value).err()));
    if let Some(beyond) = beyond {
        return Some(beyond.to_string());
    }
    let kind = table.kind(key).filter(|kind| !is_of(kind, value))?;
    let given = shown(value);
    Some(match kind {
        Kind::Table => format!("[{whole}] is {given}: it must be one table [{whole}]"),
        Kind::OneOrMore => format!("[{whole}] is {given}: it must be a table [{whole}], or several [[{whole}]]"),
        Kind::List(of) if **of == Kind::Table => {
            format!("[{whole}] is {given}: it must be [[{whole}]], once or several times")
        }
        Kind::Word(words) => {
            let near = value.as_str().and_then(|word| nearest(words.iter().copied(), word));
            let near = near.map_or_else(String::new, |near| format!("; did you mean \"{near}\"?"));
            format!("{whole} is {given}: it must be {kind}{near}")
        }
        Kind::Number | Kind::Whole(_) if value.as_str().is_some_and(|text| text.trim().parse::<f64>().is_ok()) => {
            format!("{whole} is {given}: it must be {kind}, without quotes")
        }
        // One that is below 0 is reported like any other value of another kind.
        Kind::Number | Kind::Whole(_)
            if value.is_integer() && (*kind != Kind::Whole(true) || !given.starts_with('-')) =>
        {
            format!("{whole} is {given}: a whole number must have at most 64 bits")
        }
        _ => format!("{whole} is {given}: it must be {kind}"),
    })
}

fn is_of(kind: &Kind, value: &DeValue<'_>) -> bool {
    let all =
        |kind: &Kind| value.as_array().is_some_and(|values| values.iter().all(|value| is_of(kind, value.get_ref())));
    let whole = value.as_integer().and_then(whole);
    match kind {
        Kind::Number => value.is_float() || whole.is_some(),
        // Seeds have 64 bits.
        Kind::Whole(true) => whole.is_some_and(|number| (0..=i128::from(u64::MAX)).contains(&number)),
        Kind::Whole(false) => whole.is_some_and(|number| i64::try_from(number).is_ok()),
        Kind::Flag => value.is_bool(),
        Kind::Text => value.is_str(),
        Kind::Word(words) => value.as_str().is_some_and(|word| words.contains(&word)),
        Kind::Short(kind, [least, most]) => {
            all(kind) && value.as_array().is_some_and(|values| (*least..=*most).contains(&(values.len() as u64)))
        }
        Kind::List(kind) => all(kind),
        Kind::Table => value.is_table(),
        Kind::OneOrMore => value.is_table() || all(&Kind::Table),
        Kind::TextOrTable => value.is_str() || value.is_table(),
    }
}

/// A whole number of at most 64 bits, with a sign or without.
fn whole(written: &DeInteger<'_>) -> Option<i128> {
    let number = i128::from_str_radix(written.as_str(), written.radix()).ok()?;
    (i128::from(i64::MIN)..=i128::from(u64::MAX)).contains(&number).then_some(number)
}

/// A value in few words, as it stands in the file.
fn shown(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("{text:?}"),
        DeValue::Integer(written) => written.as_str().to_owned(),
        DeValue::Float(written) => written.as_str().to_owned(),
        DeValue::Boolean(value) => value.to_string(),
        DeValue::Datetime(value) => value.to_string(),
        DeValue::Array(values) if values.iter().any(|value| value.get_ref().is_table()) => {
            format!("{} tables", values.len())
        }
        DeValue::Array(values) => match values.len() {
            1 => "a list of one value".to_owned(),
            count => format!("a list of {count} values"),
        },
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// All numbers of a value: itself, or those of a list.
pub(super) fn numbers(value: &DeValue<'_>) -> Vec<f64> {
    match value {
        DeValue::Array(values) => values.iter().flat_map(|value| numbers(value.get_ref())).collect(),
        other => number(other).into_iter().collect(),
    }
}

/// A number as it stands in the file.
fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(written) => {
            let whole = i128::from_str_radix(written.as_str(), written.radix()).map(|n| n as f64).ok();
            whole.or_else(|| written.as_str().parse().ok().filter(|_| written.radix() == 10))
        }
        DeValue::Float(written) => written.as_str().parse().ok(),
        _ => None,
    }
}
