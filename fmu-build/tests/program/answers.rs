//! What the program answers to what it does not do or asks about, word by word: `answers.txt`.
#![allow(clippy::unwrap_used)]

use crate::common;
use crate::common::program::{brinell, tried};
use crate::reports::size::{RATE, csv, healthy};
use brinell_tests::snapshot;
use std::fs;
use std::path::Path;

/// Notes of a command that does what it is told, or its error without how it is used; where nothing may be left behind.
fn answer(command: &str, folder: &Path) -> String {
    let words: Vec<&str> = command.split(' ').map(|word| if word == "''" { "" } else { word }).collect();
    let (done, said) = tried(brinell(&words).current_dir(folder));
    let text = said.err.replace(folder.to_str().unwrap(), ".");
    if done {
        let notes = text.lines().filter(|line| line.starts_with("note: ") || line.starts_with("warning: "));
        return std::iter::once("done").chain(notes).collect::<Vec<_>>().join("\n");
    }
    let left = fs::read_dir(folder.join("out")).map_or(0, |entries| entries.count());
    assert!(said.out.is_empty() && left == 0, "{command} has written something");
    let answer = text.split("\n\nUsage").next().unwrap();
    answer.lines().filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n")
}

/// Writes the files that a block begins with: a shipped scene and what changes in it, or lines after `|`.
fn write_files(block: &str, folder: &Path) {
    let mut lines = block.lines().peekable();
    while let Some(head) = lines.next() {
        let (name, base) = head.split_once(" is").unwrap_or_else(|| panic!("no file: {head}"));
        let body: Vec<&str> = std::iter::from_fn(|| lines.next_if(|line| line.starts_with(['-', '+', '|']))).collect();
        let text = if base.is_empty() {
            body.iter().map(|line| format!("{}\n", line[1..].strip_prefix(' ').unwrap_or_default())).collect()
        } else {
            snapshot::changed(&common::scene_text(base.trim()), &body.join("\n"))
        };
        fs::write(folder.join(name), text).unwrap();
    }
}

/// Recordings that are too long to stand in a block.
fn write_recordings(folder: &Path) {
    let good = healthy(60_000);
    let mut broken = good.clone();
    broken[17] = f64::NAN;
    let clipped = good.iter().map(|x| x.clamp(-0.9, 0.9)).collect();
    let (short, still) = (good[..3000].to_vec(), healthy(250_000));
    for (name, samples) in
        [("short", short), ("broken", broken), ("clipped", clipped), ("constant", vec![1.0; 60_000]), ("still", still)]
    {
        csv(folder, &format!("{name}.csv"), &[("acceleration", samples)]);
    }
    let time = (0..60_000).map(|k| f64::from(k) / RATE).collect();
    csv(folder, "timed.csv", &[("time", time), ("acceleration", good.clone())]);
    let [left, key] = [0.5, 1.0].map(|value| vec![value; 60_000]);
    csv(folder, "four.csv", &[("left", left), ("right", good.clone()), ("key", key.clone()), ("n [rpm]", key)]);
    csv(folder, "good.csv", &[("acceleration", good)]);
}

#[test]
fn what_is_not_done_is_answered_in_words_of_the_task() {
    let file = common::root().join("fmu-build/tests/program/answers.txt");
    let folder = common::folder("answers");
    write_recordings(&folder);
    snapshot::compare(&file, |block| {
        let (files, command) = block.rsplit_once('\n').unwrap_or(("", block));
        let command = command.strip_prefix("$ brinell ").unwrap_or_else(|| panic!("no command: {command}"));
        let _ = fs::remove_dir_all(folder.join("out"));
        write_files(files, &folder);
        answer(command, &folder)
    });
}
