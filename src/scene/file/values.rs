//! What is wrong with single values of a scene file, whatever the rest of it says. Asked only of a file that was
//! refused: a value that is wrong by itself is then told beside what it was refused for.

use super::super::error::SceneError;
use super::super::quantity::WRITTEN;
use toml::de::DeValue;

/// Why the value of a key, given with its table, is outside its limits; each component of a list is.
pub(super) fn fault(key: &str, value: &DeValue<'_>) -> Option<SceneError> {
    let quantity = WRITTEN.iter().find(|quantity| quantity.key() == key)?;
    match value {
        DeValue::Array(values) => values.iter().find_map(|value| fault(key, value.get_ref())),
        other => quantity.check_written(number(other)?).err(),
    }
}

/// A number as it stands in the file.
fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(written) => i64::from_str_radix(written.as_str(), written.radix()).ok().map(|n| n as f64),
        DeValue::Float(written) => written.as_str().parse().ok(),
        _ => None,
    }
}
