//! What a user reads when something is wrong: the reason, once.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::fs;
use std::process::{Command, Output};

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_brinell")).args(arguments).output().unwrap()
}

#[track_caller]
fn once(said: &str, words: &str) {
    assert_eq!(said.matches(words).count(), 1, "`{words}` once in: {said}");
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
    once(&said, "Failed to load shared library");
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
    for (name, found) in [("NJ205", "\nNU205 "), ("6205-2RS", "\n6205 "), ("nu20", "\nNU203 ")] {
        once(&String::from_utf8(program(&["catalogue", name]).stdout).unwrap(), found);
    }
    let listed = String::from_utf8(program(&["catalogue", "62"]).stdout).unwrap();
    once(&listed, "Case Western Reserve University's bearing data, drive end");
    let count = |word: &str| listed.lines().filter(|line| line.contains(word)).count();
    // 6200, 6201 and 6202; 6204 and 6206 to 6212.
    assert_eq!((count("assumed"), count("table A-9")), (3, 8), "{listed}");
    assert!(!listed.contains("\n60"), "{listed}");
}

#[test]
fn scenes_that_are_written_have_the_schema_beside_them_that_they_name() {
    let folder = common::folder("schema-beside");
    let into = folder.display().to_string();
    let schema = folder.join("scene.schema.json");
    for command in [&["new", "mine"][..], &["scenes", "6205-epps"]] {
        let output = program(&[command, &["--output", &into]].concat());
        assert!(output.status.success());
        once(&String::from_utf8(output.stdout).unwrap(), "scene.schema.json");
        assert_eq!(fs::read(&schema).unwrap(), program(&["schema"]).stdout);
        fs::remove_file(&schema).unwrap();
    }
    // Somebody else's stays.
    fs::write(&schema, "{}").unwrap();
    assert!(program(&["new", "other", "--output", &into]).status.success());
    assert_eq!(fs::read_to_string(&schema).unwrap(), "{}");
}
