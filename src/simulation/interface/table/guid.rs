//! The GUID of a scene: a hash of what decides its variables and results.
//!
//! It ties a model description to the resources and the binary that belong to it: equal scenes and equal versions of
//! Brinell give equal GUIDs on every machine, any other text or version gives another one. It guards against
//! mix-ups, not against forgery: the hash is 128-bit FNV-1a, which is no cryptographic one.

use crate::numerics::checksum::wide_checksum;

/// The GUID of a scene's text and the texts of its profiles, as in `{01234567-89ab-cdef-0123-456789abcdef}`.
pub fn guid<'p>(scene_text: &'p str, profiles: impl IntoIterator<Item = &'p str>) -> String {
    let mut parts = vec![Some(env!("CARGO_PKG_VERSION")), Some(scene_text)];
    parts.extend(profiles.into_iter().map(Some));
    if parts.len() == 2 {
        parts.push(None);
    }
    // Lengths keep apart what would read the same when joined; an absent part is not an empty one.
    let lengths: Vec<_> =
        parts.iter().map(|part| part.map_or(u64::MAX, |text| text.len() as u64).to_le_bytes()).collect();
    let hash = wide_checksum(
        lengths.iter().zip(parts).flat_map(|(length, part)| [&length[..], part.unwrap_or_default().as_bytes()]),
    );
    let digits = format!("{hash:032x}");
    format!("{{{}-{}-{}-{}-{}}}", &digits[..8], &digits[8..12], &digits[12..16], &digits[16..20], &digits[20..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_the_form_of_a_guid() {
        let guid = guid("scene", None);
        let lengths: Vec<_> = guid.trim_matches(['{', '}']).split('-').map(str::len).collect();
        assert_eq!((guid.len(), lengths), (38, vec![8, 4, 4, 4, 12]));
    }

    #[test]
    fn it_changes_with_every_part_and_with_nothing_else() {
        assert_eq!(guid("a", Some("b")), guid("a", Some("b")));
        let all = [guid("a", None), guid("a", Some("")), guid("a", Some("b")), guid("ab", Some("")), guid("b", None)];
        for (i, one) in all.iter().enumerate() {
            assert!(all[i + 1..].iter().all(|other| other != one), "{one}");
        }
    }
}
