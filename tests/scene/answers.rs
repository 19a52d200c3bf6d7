//! What is said of every scene and trace that cannot be, word by word, in two files to read: `answers_to_*.txt`.

use brinell::scene::{Defect, DefectShape};
use brinell::surface::Surface;
use std::path::PathBuf;

/// The scene that is spoilt, in one place or more.
pub(crate) const GOOD: &str = include_str!("good.toml");

fn file(name: &str) -> PathBuf {
    brinell_tests::root().join("tests/scene").join(name)
}

/// The good scene with its `-` lines replaced by the `+` lines that follow them.
fn changed(changes: &str) -> String {
    let text_of = |line: &str| format!("{}\n", line[1..].strip_prefix(' ').unwrap_or_default());
    let lines: Vec<&str> = changes.lines().collect();
    let starts = |line: &&str, sign: char| line.starts_with(sign);
    let mut text = GOOD.to_owned();
    let mut rest = &lines[..];
    while !rest.is_empty() {
        let old = rest.iter().take_while(|line| starts(line, '-')).count();
        let new = rest[old..].iter().take_while(|line| starts(line, '+')).count();
        assert!(old > 0, "neither - nor + begins: {}", rest[0]);
        let from: String = rest[..old].iter().map(|line| text_of(line)).collect();
        let to: String = rest[old..old + new].iter().map(|line| text_of(line)).collect();
        let places: Vec<usize> = text.match_indices(&from).map(|(at, _)| at).collect();
        let whole = |at: &usize| *at == 0 || text.as_bytes()[at - 1] == b'\n';
        let [at] = places.iter().copied().filter(whole).collect::<Vec<_>>()[..] else { panic!("not once: {from}") };
        text.replace_range(at..at + from.len(), &to);
        rest = &rest[old + new..];
    }
    text
}

#[test]
fn every_scene_that_cannot_be_is_told_with_the_quantity_its_key_its_value_and_the_limit() {
    brinell_tests::snapshot::compare(&file("answers_to_scenes.txt"), |changes| {
        let text = changed(changes);
        let asked = || brinell_scene_file::unit_questions(&text).into_iter().map(|one| format!("\n{one}"));
        match brinell_scene_file::from_toml(&text) {
            Ok(_) => asked().fold("accepted".to_owned(), |all, one| all + &one),
            Err(error) => error.to_string(),
        }
    });
}

#[test]
fn every_trace_that_cannot_be_is_told_with_its_line_or_position_the_value_and_the_limit() {
    let bearing = brinell_scene_file::from_toml(include_str!("../../scenes/er16k-tb1.toml")).unwrap().bearing;
    let defect = Defect::outer(0.0, DefectShape::Profile("trace.csv".to_owned()));
    brinell_tests::snapshot::compare(&file("answers_to_traces.txt"), |lines| {
        let text: String = lines.lines().map(|line| format!("{}\n", line.trim_start_matches(['|', ' ']))).collect();
        Surface::load(&defect, Some(&text), &bearing).map_or_else(|error| error.to_string(), |_| "accepted".to_owned())
    });
}
