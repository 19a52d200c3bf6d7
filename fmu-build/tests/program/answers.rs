//! What the program answers to what it does not do or asks about, word by word: `answers.txt`.
#![allow(clippy::unwrap_used)]

use crate::common;
use brinell_tests::snapshot;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Notes of a command that does what it is told, or its error without how it is used; where nothing may be left behind.
fn answer(command: &str, folder: &Path) -> String {
    let words = command.split(' ').map(|word| if word == "''" { "" } else { word });
    let output = Command::new(env!("CARGO_BIN_EXE_brinell")).args(words).current_dir(folder).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap().replace(folder.to_str().unwrap(), ".");
    if output.status.success() {
        let notes = text.lines().filter(|line| line.starts_with("note: ") || line.starts_with("warning: "));
        return std::iter::once("done").chain(notes).collect::<Vec<_>>().join("\n");
    }
    let left = fs::read_dir(folder.join("out")).map_or(0, |entries| entries.count());
    assert!(output.stdout.is_empty() && left == 0, "{command} has written something");
    let answer = text.split("\n\nUsage").next().unwrap();
    answer.lines().filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n")
}

#[test]
fn what_is_not_done_is_answered_in_words_of_the_task() {
    let file = common::root().join("fmu-build/tests/program/answers.txt");
    let scene = |name: &str| fs::read_to_string(common::root().join(format!("scenes/{name}.toml"))).unwrap();
    let folder = common::folder("answers");
    snapshot::compare(&file, |block| {
        let (changes, command) = block.rsplit_once('\n').unwrap_or(("", block));
        let command = command.strip_prefix("$ brinell ").unwrap_or_else(|| panic!("no command: {command}"));
        let (base, changes) = changes.split_once('\n').unwrap_or((changes, ""));
        let _ = fs::remove_dir_all(folder.join("out"));
        if let Some(base) = base.strip_prefix("scene.toml is ") {
            fs::write(folder.join("scene.toml"), snapshot::changed(&scene(base), changes)).unwrap();
        }
        answer(command, &folder)
    });
}
