//! The GUID of a scene: a hash of what decides its variables and results.
//!
//! It ties a model description to the resources and the binary that belong to it: equal scenes and equal versions of
//! Brinell give equal GUIDs on every machine, any other text or version gives another one. It guards against
//! mix-ups, not against forgery: the hash is 128-bit FNV-1a (Fowler, Noll, Vo; parameters from the
//! Internet draft draft-eastlake-fnv), which is no cryptographic one.

const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

/// The GUID of a scene's text and the text of its profile, as in `{01234567-89ab-cdef-0123-456789abcdef}`.
pub fn guid(scene_text: &str, profile: Option<&str>) -> String {
    let mut hash = OFFSET;
    for part in [Some(env!("CARGO_PKG_VERSION")), Some(scene_text), profile] {
        // Lengths keep apart what would read the same when joined; an absent part is not an empty one.
        hash = fnv1a(hash, &part.map_or(u64::MAX, |text| text.len() as u64).to_le_bytes());
        hash = fnv1a(hash, part.unwrap_or_default().as_bytes());
    }
    let digits = format!("{hash:032x}");
    format!("{{{}-{}-{}-{}-{}}}", &digits[..8], &digits[8..12], &digits[12..16], &digits[16..20], &digits[20..])
}

fn fnv1a(hash: u128, bytes: &[u8]) -> u128 {
    bytes.iter().fold(hash, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_gives_the_published_test_value() {
        // FNV-1a of "a" with 128 bits, from the authors' test vectors.
        assert_eq!(fnv1a(OFFSET, b"a"), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
    }

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
