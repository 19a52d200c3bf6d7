//! What was probably meant by a word that is not known.

/// Longest word that is compared (bytes).
const LONGEST: usize = 100;
/// Words that people say, and those that keys have for them.
const SYNONYMS: [(&str, &str); 3] = [("ball", "element"), ("balls", "element"), ("roller", "element")];

/// The known word that is spelt most like this one, or like what it says in a key's words: a beginning of it, or a
/// third of the letters off; `None` if none is.
pub fn nearest<'k>(known: impl IntoIterator<Item = &'k str>, word: &str) -> Option<&'k str> {
    // What is longer is no slip of the pen.
    if word.len() > LONGEST {
        return None;
    }
    let plain = |word: &str| word.to_lowercase().replace('-', "_");
    let wanted = plain(word);
    let in_keys = |part| SYNONYMS.iter().find(|(said, _)| *said == part).map_or(part, |(_, key)| *key);
    let said = wanted.split('_').map(in_keys).collect::<Vec<_>>().join("_");
    let away = |other: &str| {
        let other = plain(other);
        let away = |wanted: &String| match other.starts_with(wanted) && !wanted.is_empty() {
            // Of several that it begins the shortest.
            true => (1, true, other.len()),
            // A swap is one letter off as well, and the likelier slip: no letter is another.
            false => (strsim::osa_distance(&other, wanted), letters(&other) != letters(wanted), 0),
        };
        away(&wanted).min(away(&said))
    };
    let (far, nearest) = known.into_iter().map(|other| (away(other), other)).min_by_key(|(far, _)| *far)?;
    (far.0 <= (wanted.chars().count() / 3).max(1)).then_some(nearest)
}

fn letters(word: &str) -> Vec<char> {
    let mut letters: Vec<char> = word.chars().collect();
    letters.sort_unstable();
    letters
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_word_has_the_fewest_letters_changed_and_swapped_ones_are_nearest() {
        for (wanted, expected) in
            [("slipp", Some("slip")), ("solwer", Some("solver")), ("6250", Some("6205")), ("x", None)]
        {
            assert_eq!(nearest(["slip", "solver", "6200", "6205"], wanted), expected, "{wanted}");
        }
        assert_eq!(nearest(["depth_um", "length_deg"], "depth"), Some("depth_um"));
        assert_eq!(nearest(["er16k-tb1-damped", "er16k-tb1"], "er16k-tb"), Some("er16k-tb1"));
        assert_eq!(nearest(["depth_um", "length_deg"], "colour"), None);
        assert_eq!(nearest(["depth_um", "length_deg"], ""), None);
        let keys = ["pitch_diameter_mm", "element_diameter_mm", "roller_length_mm", "element_count"];
        assert_eq!(nearest(keys, "ball_diameter_mm"), Some("element_diameter_mm"));
        assert_eq!(nearest(keys, "roller_lenght_mm"), Some("roller_length_mm"));
        assert_eq!(nearest(keys, "balls_count"), Some("element_count"));
    }
}
