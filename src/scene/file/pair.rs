//! Lists of exactly two values. An array that serde reads ends after its second value, whatever follows in the file.

use serde::Deserialize;
use serde::de::{Deserializer, Error};

/// Two values, neither fewer nor more.
pub(super) fn pair<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<[T; 2], D::Error> {
    let values = Vec::deserialize(deserializer)?;
    let count = values.len();
    values.try_into().map_err(|_| D::Error::invalid_length(count, &"a list of two values"))
}

/// As [`pair`], of a key that may be left out.
pub(super) fn optional<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    deserializer: D,
) -> Result<Option<[T; 2]>, D::Error> {
    pair(deserializer).map(Some)
}
