//! Questions and answers in one file: what a person reads, word by word, for one glance and one `git diff`.

use std::path::Path;
use std::{env, fs};

/// Compares answers with those in a file of blocks between empty lines. In a block, lines that begin with `=` are the
/// answer, lines that begin with `#` say something to the reader, and all others are the question; a block without a
/// question is a heading. `BLESS=1` in the environment writes the answers anew.
///
/// # Panics
/// On the first block that is answered otherwise.
pub fn compare(file: &Path, answer: impl Fn(&str) -> String) {
    let text = fs::read_to_string(file).expect("the file of questions");
    let mut written = Vec::new();
    for block in text.trim_end().split("\n\n") {
        let kept: Vec<&str> = block.lines().filter(|line| !line.starts_with('=')).collect();
        let question: Vec<&str> = kept.iter().copied().filter(|line| !line.starts_with('#')).collect();
        let mut lines: Vec<String> = kept.iter().map(|line| (*line).to_owned()).collect();
        if !question.is_empty() {
            lines.extend(answer(&question.join("\n")).lines().map(|line| format!("= {line}").trim_end().to_owned()));
        }
        written.push(lines.join("\n"));
        if env::var_os("BLESS").is_none() {
            let answered = written.last().expect("pushed above");
            assert_eq!(block, answered, "{} has left, now it is right; BLESS=1 writes it", file.display());
        }
    }
    if env::var_os("BLESS").is_some() {
        fs::write(file, written.join("\n\n") + "\n").expect("the file can be written");
    }
}

/// A text whose `-` lines are replaced by the `+` lines that follow them; `+` lines alone are put at its end.
///
/// # Panics
/// Where a line has neither sign, and where the lines to replace do not stand once.
pub fn changed(text: &str, changes: &str) -> String {
    let mut text = text.to_owned();
    let lines: Vec<&str> = changes.lines().collect();
    let run = |lines: &[&str], sign: char| lines.iter().take_while(|line| line.starts_with(sign)).count();
    let join = |lines: &[&str]| -> String {
        lines.iter().map(|line| format!("{}\n", line[1..].strip_prefix(' ').unwrap_or_default())).collect()
    };
    let mut rest = &lines[..];
    while !rest.is_empty() {
        let old = run(rest, '-');
        let new = run(&rest[old..], '+');
        assert!(old + new > 0, "neither - nor + begins: {}", rest[0]);
        let (from, to) = (join(&rest[..old]), join(&rest[old..old + new]));
        let whole = |at: &usize| *at == 0 || text.as_bytes()[at - 1] == b'\n';
        let places: Vec<usize> = text.match_indices(&from).map(|(at, _)| at).filter(whole).collect();
        match places[..] {
            _ if old == 0 => text += &to,
            [at] => text.replace_range(at..at + from.len(), &to),
            _ => panic!("stands {} times: {from}", places.len()),
        }
        rest = &rest[old + new..];
    }
    text
}
