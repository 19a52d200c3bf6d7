//! What is said of every scene and trace that cannot be, word by word, in two files to read: `answers_to_*.txt`.

use brinell::scene::{Defect, DefectShape};
use brinell::surface::Surface;
use brinell_tests::snapshot;
use std::path::PathBuf;

/// The scene that is spoilt, in one place or more.
pub(crate) const GOOD: &str = include_str!("good.toml");

fn file(name: &str) -> PathBuf {
    brinell_tests::root().join("tests/scene").join(name)
}

#[test]
fn every_scene_that_cannot_be_is_told_with_the_quantity_its_key_its_value_and_the_limit() {
    snapshot::compare(&file("answers_to_scenes.txt"), |changes| {
        let text = snapshot::changed(GOOD, changes);
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
    let defect = Defect::outer(0.0, DefectShape::Profile("trace.csv".into()));
    snapshot::compare(&file("answers_to_traces.txt"), |lines| {
        let text: String = lines.lines().map(|line| format!("{}\n", line.trim_start_matches(['|', ' ']))).collect();
        Surface::load(&defect, Some(&text), &bearing).map_or_else(|error| error.to_string(), |_| "accepted".to_owned())
    });
}
