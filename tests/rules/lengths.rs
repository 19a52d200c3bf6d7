//! Reads how long the functions of a formatted Rust file are.

/// Every function's name and its lines, from `fn` to the brace that closes it, or to the end of a mere declaration.
pub(super) fn functions(text: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let starts = lines.iter().enumerate().filter_map(|(start, line)| Some((start, name(line)?)));
    let measured = starts.map(|(start, name)| {
        let indent = &lines[start][..lines[start].len() - lines[start].trim_start().len()];
        let ends = |line: &str| line.starts_with('}') || (line.starts_with(')') && line.ends_with(';'));
        let closes = |line: &&str| line.strip_prefix(indent).is_some_and(ends);
        let whole = lines[start].ends_with(['}', ';']);
        let end = lines[start..].iter().position(closes).filter(|_| !whole);
        (name, end.map_or(1, |end| end + 1))
    });
    measured.collect()
}

/// Name of the function that begins on a line.
pub(super) fn name(line: &str) -> Option<String> {
    let (before, after) = line.trim_start().split_once("fn ")?;
    let words = ["pub", "pub(crate)", "pub(super)", "const", "unsafe", "extern", "\"C\"", "\"C-unwind\""];
    // `pub(in crate::layer)` is two words.
    let of_layer = |word: &str| word == "pub(in" || (word.starts_with("crate::") && word.ends_with(')'));
    if !before.split_whitespace().all(|word| words.contains(&word) || of_layer(word)) {
        return None;
    }
    Some(after.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next()?.to_owned())
}
