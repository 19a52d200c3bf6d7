//! What was probably meant by a word that is not known.

/// The known word that is spelt most like this one: a beginning of it, or a third of the letters off; `None` if none is.
pub fn nearest<'k>(known: impl IntoIterator<Item = &'k str>, word: &str) -> Option<&'k str> {
    let plain = |word: &str| word.to_lowercase().replace('-', "_");
    let wanted = plain(word);
    let away = |other: &str| {
        let other = plain(other);
        if !wanted.is_empty() && other.starts_with(&wanted) { 1 } else { distance(&other, &wanted) }
    };
    let (far, nearest) = known.into_iter().map(|other| (away(other), other)).min_by_key(|(far, _)| *far)?;
    (far <= (wanted.chars().count() / 3).max(1)).then_some(nearest)
}

/// Letters to be put in, left out or exchanged to make one word of the other (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut aslant = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let exchanged = aslant + usize::from(from != *to);
            aslant = row[j + 1];
            row[j + 1] = exchanged.min(row[j] + 1).min(aslant + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_as_far_apart_as_letters_change() {
        for (a, b, expected) in [("slip", "slip", 0), ("slip", "slipp", 1), ("solver", "solwer", 1), ("", "abc", 3)] {
            assert_eq!((distance(a, b), distance(b, a)), (expected, expected), "{a} {b}");
        }
        assert_eq!(nearest(["depth_um", "length_deg"], "depth"), Some("depth_um"));
        assert_eq!(nearest(["depth_um", "length_deg"], "colour"), None);
        assert_eq!(nearest(["depth_um", "length_deg"], ""), None);
    }
}
