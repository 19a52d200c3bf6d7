//! Files beside those that are written: what a command names, takes and leaves, in a folder where it was run before.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use crate::common;
use crate::common::program::{brinell, done};

/// What a command says on standard error.
#[track_caller]
fn notes(folder: &Path, words: &[&str]) -> String {
    done(brinell(words).current_dir(folder)).err
}

#[test]
fn the_spectrum_of_the_envelope_is_written_with_any_columns_and_without_a_figure() {
    let folder = common::folder("files-envelope");
    let run = ["run", "6205-healthy", "--stop", "0.1", "--no-figure"];
    for (out, more) in [("all", &[][..]), ("few", &["--columns", "shaft.x"])] {
        notes(&folder, &[&run[..], more, &["-o", out]].concat());
    }
    let read = |file: &str| fs::read_to_string(folder.join(file)).unwrap();
    assert!(read("all/6205-healthy-envelope.csv").lines().count() > 100);
    for end in ["csv", "json"] {
        let [all, few] = ["all", "few"].map(|out| read(&format!("{out}/6205-healthy-envelope.{end}")));
        assert!(all == few, "the spectrum depends on the table's columns");
    }
    assert_eq!(read("few/6205-healthy.csv").lines().next(), Some("time [s],shaft.x [m]"));
}

#[test]
fn files_of_an_earlier_run_that_a_run_does_not_write_anew_are_named() {
    let folder = common::folder("files-earlier");
    let run = ["run", "6205-healthy", "--stop", "0.001", "--no-figure"];
    assert_eq!(notes(&folder, &run), "", "there is nothing yet");
    for end in [".png", ".html", "-envelope.csv", "-other.png"] {
        fs::write(folder.join(format!("6205-healthy{end}")), "earlier").unwrap();
    }
    let said = notes(&folder, &run);
    let named = "6205-healthy.png, 6205-healthy.html, 6205-healthy-envelope.csv\n";
    assert!(said.starts_with("note: of an earlier run") && said.ends_with(named), "{said}");
    assert!(!said.contains("other") && !said.contains("6205-healthy.csv"), "{said}");
    // Figures of other commands are named by them.
    fs::write(folder.join("6205-healthy-stiffness.svg"), "earlier").unwrap();
    let said = notes(&folder, &["stiffness", "6205-healthy", "--points", "3", "--no-figure"]);
    assert!(said.ends_with(": 6205-healthy-stiffness.svg\n"), "{said}");
}

#[test]
fn an_fmu_of_another_version_is_not_replaced_without_a_word() {
    let folder = common::folder("files-versions");
    fs::write(folder.join("library.so"), "library").unwrap();
    let build = |fmi: &str| notes(&folder, &["build", "6205-healthy", "--library", "library.so", "--fmi", fmi]);
    assert_eq!([build("2"), build("2")], ["", ""]);
    let said = build("3");
    assert!(said.contains("6205-healthy.fmu was of FMI 2.0 and is now of FMI 3.0; -o names a folder"), "{said}");
    assert!(build("2").contains("was of FMI 3.0 and is now of FMI 2.0"));
    fs::write(folder.join("6205-healthy.fmu"), "no archive").unwrap();
    assert_eq!(build("2"), "");
}

#[test]
fn a_scene_in_this_folder_needs_no_ending_and_a_shipped_one_says_that_it_is_taken() {
    let folder = common::folder("files-ending");
    let scene = common::scene_text("6205-healthy").replace("\"6205-healthy\"", "\"own\"");
    fs::write(folder.join("base.toml"), &scene).unwrap();
    let run = |name: &str| notes(&folder, &["run", name, "--stop", "1e-4", "--no-figure"]);
    // A folder of that name is no scene.
    fs::create_dir(folder.join("base")).unwrap();
    assert_eq!(run("base"), "");
    assert!(folder.join("own.csv").is_file());
    fs::write(folder.join("6205-healthy.toml"), &scene).unwrap();
    let said = run("6205-healthy");
    let differs = "note: 6205-healthy is the shipped scene; the file here, which differs, is 6205-healthy.toml\n";
    assert_eq!(said, differs);
    assert!(folder.join("6205-healthy.csv").is_file());
    fs::remove_file(folder.join("6205-healthy.toml")).unwrap();
    done(brinell(&["scenes", "6205-healthy"]).current_dir(&folder));
    assert_eq!(run("6205-healthy"), "", "the same scene");
}

#[test]
fn new_scenes_of_two_sizes_have_two_names() {
    let folder = common::folder("files-new");
    for (defect, name) in [
        ("inner:1.2mm", "6205-inner-1_2mm"),
        ("inner:2mm", "6205-inner-2mm"),
        ("outer:5deg", "6205-outer-5deg"),
        ("element:0.4mm", "6205-element-0_4mm"),
    ] {
        let said = done(brinell(&["new", "--defect", defect]).current_dir(&folder)).out;
        assert!(said.starts_with(&format!("{name}.toml\n")), "{said}");
        let text = fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
        assert_eq!(brinell_scene_file::from_toml(&text).unwrap().name, name);
    }
}

#[test]
fn without_packages_a_run_gives_its_table_and_says_how_to_go_without_a_figure() {
    let folder = common::folder("files-offline");
    let mut command = brinell(&["run", "6205-healthy", "--stop", "1e-3"]);
    // Nobody listens at this port.
    let offline = [("PIP_INDEX_URL", "http://127.0.0.1:9/simple"), ("PIP_RETRIES", "0"), ("PIP_TIMEOUT", "1")];
    let said = done(command.current_dir(&folder).envs(offline).env("BRINELL_CACHE", folder.join("cache")));
    assert!(said.err.contains("note: no figure: ") && said.err.contains("--no-figure goes without"), "{}", said.err);
    assert!(said.out.contains("6205-healthy.csv") && folder.join("6205-healthy.csv").is_file(), "{}", said.out);
}
