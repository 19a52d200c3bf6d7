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
