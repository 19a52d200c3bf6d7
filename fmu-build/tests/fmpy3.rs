//! A public importer drives the FMUs of FMI 3.0: fmpy, through the C interface. The scripts in `tests/python` say what
//! they check.
#![allow(clippy::unwrap_used)]

mod common;

use std::path::{Path, PathBuf};

use fmu_build::{check, project::Project};

fn all_fmus(folder: &Path) -> Vec<PathBuf> {
    common::names().iter().map(|name| common::fmu3_of(name, folder)).collect()
}

#[test]
fn validate_fmu_finds_nothing_in_fmi_3() {
    for fmu in all_fmus(&common::folder("validate3")) {
        common::python().run("validate.py", [&fmu]).unwrap_or_else(|error| panic!("{error:#}"));
    }
}

#[test]
fn simulate_fmu_runs_every_shipped_scene_under_fmi_3() {
    common::run_script("simulate.py", all_fmus(&common::folder("simulate3")));
}

#[test]
fn every_shipped_scene_gives_the_bits_of_fmi_2_under_fmi_3() {
    let (two, three) = (common::folder("bits2"), common::folder("bits3"));
    let pairs = common::names()
        .into_iter()
        .flat_map(|name| [common::fmu_of(&name, &two), common::fmu3_of(&name, &three)].map(PathBuf::into_os_string));
    println!("{}", common::run_script("equal_bits3.py", [std::ffi::OsString::from("300")].into_iter().chain(pairs)));
}

#[test]
fn the_check_command_passes_an_fmu_of_fmi_3() {
    let folder = common::folder("check3");
    for name in ["6205-epps", "6205-hosted"] {
        check::command(&Project::find(), &common::fmu3_of(name, &folder)).unwrap();
    }
}

#[test]
fn states_derivatives_updates_and_terminals_of_every_shipped_scene_keep_to_fmi_3() {
    println!("{}", common::run_script("fmi3.py", all_fmus(&common::folder("fmi3"))));
}
