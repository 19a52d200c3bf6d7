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
        let away = |wanted: &String| {
            if !wanted.is_empty() && other.starts_with(wanted) { LETTER } else { distance(&other, wanted) }
        };
        away(&wanted).min(away(&said))
    };
    let (far, nearest) = known.into_iter().map(|other| (away(other), other)).min_by_key(|(far, _)| *far)?;
    (far <= LETTER * (wanted.chars().count() / 3).max(1)).then_some(nearest)
}

/// What a letter counts that is put in, left out or exchanged for another; two that are swapped count less.
const LETTER: usize = 2;
const SWAP: usize = 1;

/// What makes one word of the other (Damerau and Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).map(|j| j * LETTER).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i * LETTER];
        for j in 1..=b.len() {
            let exchanged = rows[i - 1][j - 1] + if a[i - 1] == b[j - 1] { 0 } else { LETTER };
            let mut least = exchanged.min(rows[i - 1][j] + LETTER).min(row[j - 1] + LETTER);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + SWAP);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_as_far_apart_as_letters_change_and_swapped_ones_are_nearest() {
        for (a, b, expected) in
            [("slip", "slip", 0), ("slip", "slipp", 2), ("solver", "solwer", 2), ("", "abc", 6), ("6250", "6205", 1)]
        {
            assert_eq!((distance(a, b), distance(b, a)), (expected, expected), "{a} {b}");
        }
        assert_eq!(nearest(["depth_um", "length_deg"], "depth"), Some("depth_um"));
        assert_eq!(nearest(["depth_um", "length_deg"], "colour"), None);
        assert_eq!(nearest(["depth_um", "length_deg"], ""), None);
        let keys = ["pitch_diameter_mm", "element_diameter_mm", "roller_length_mm", "element_count"];
        assert_eq!(nearest(keys, "ball_diameter_mm"), Some("element_diameter_mm"));
        assert_eq!(nearest(keys, "roller_lenght_mm"), Some("roller_length_mm"));
        assert_eq!(nearest(keys, "balls_count"), Some("element_count"));
    }
}
