//! What a user reads when something is wrong: the reason, once.
#![allow(clippy::unwrap_used)]

mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_brinell")).args(arguments).output().unwrap()
}

/// What the program says of a scene whose text was changed in one place.
fn said_of(folder: &Path, old: &str, new: &str, command: &[&str]) -> (bool, String) {
    let text = fs::read_to_string(common::root().join("scenes/6205-healthy.toml")).unwrap();
    assert_eq!(text.matches(old).count(), 1, "`{old}` must stand once in the scene");
    let path = folder.join("changed.toml");
    fs::write(&path, text.replace(old, new)).unwrap();
    let path = path.display().to_string();
    let output = program(&[&command[..1], &[path.as_str()], &command[1..]].concat());
    (output.status.success(), String::from_utf8(output.stderr).unwrap())
}

#[track_caller]
fn once(said: &str, words: &str) {
    assert_eq!(said.matches(words).count(), 1, "`{words}` once in: {said}");
}

#[test]
fn what_is_wrong_with_a_scene_file_is_said_once() {
    let folder = common::folder("messages");
    for (old, new, words) in [
        ("element_count = 9", "element_count = \"nine\"", "invalid type"),
        ("[bearing]", "[bearing", "TOML parse error"),
        ("element_count = 9", "element_cout = 9", "did you mean element_count?"),
        ("element_count = 9", "element_count = 0", "number of elements"),
    ] {
        let (succeeded, said) = said_of(&folder, old, new, &["build"]);
        assert!(!succeeded, "{new} was taken");
        once(&said, words);
        once(&said, "changed.toml");
    }
}

#[test]
fn a_groove_that_no_ball_bearing_has_is_remarked_upon() {
    let folder = common::folder("remarks");
    let out = folder.display().to_string();
    let command = ["run", "--stop", "1e-4", "--no-figure", "-o", &out];
    let (succeeded, said) = said_of(&folder, "conformity_outer = 0.52", "conformity_outer = 5.2", &command);
    assert!(succeeded, "{said}");
    once(&said, "the groove conformity of the outer ring is 5.2000: ball bearings have 0.51 to 0.6");
    let (succeeded, said) = said_of(&folder, "conformity_outer = 0.52", "conformity_outer = 0.53", &command);
    assert!(succeeded && !said.contains("note:"), "{said}");
}

#[test]
fn a_reader_that_has_gone_ends_the_program_without_a_word() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let ended = Command::new(env!("CARGO_BIN_EXE_brinell")).arg("scenes").stdout(writer).output().unwrap();
    assert!(!ended.status.success());
    assert_eq!(String::from_utf8(ended.stderr).unwrap(), "");
}

#[cfg(unix)]
#[test]
fn a_library_that_cannot_be_loaded_is_said_once() {
    common::python();
    let folder = common::folder("no-library");
    let (library, out) = (folder.join("no.so").display().to_string(), folder.display().to_string());
    fs::write(&library, "no library").unwrap();
    let scene = common::root().join("scenes/6205-healthy.toml").display().to_string();
    assert!(program(&["build", &scene, "--library", &library, "-o", &out]).status.success());
    let output = program(&["check", &folder.join("6205-healthy.fmu").display().to_string()]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success());
    once(&said, "dlopen failed");
}

#[test]
fn a_new_scene_runs_as_it_is_and_is_not_written_over() {
    let folder = common::folder("new-scene");
    let into = folder.display().to_string();
    let new = ["new", "mine", "--bearing", "6206-2RS", "--defect", "inner:1.2mm", "--output", &into];
    assert!(program(&new).status.success());
    let scene = folder.join("mine.toml").display().to_string();
    let run = program(&["run", &scene, "--no-figure", "--stop", "0.002", "--output", &into]);
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let again = String::from_utf8(program(&new).stderr).unwrap();
    once(&again, "is there already and stays as it is");
    let unknown = String::from_utf8(program(&["new", "other", "--bearing", "30205"]).stderr).unwrap();
    once(&unknown, "6204, 6205, 6206");
    for (name, found) in [("NJ205", "\nNU205 "), ("6205-2RS", "\n6205 "), ("nu20", "\nNU203 ")] {
        once(&String::from_utf8(program(&["catalogue", name]).stdout).unwrap(), found);
    }
    let listed = String::from_utf8(program(&["catalogue", "62"]).stdout).unwrap();
    once(&listed, "Case Western Reserve University's bearing data, drive end");
    assert!(listed.lines().filter(|line| line.contains("assumed")).count() > 8 && !listed.contains("\n60"), "{listed}");
}
