//! A public importer drives the FMUs of FMI 3.0: fmpy, through the C interface. The scripts in `tests/python` say what
//! they check.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::path::{Path, PathBuf};

use fmu_build::commands::check;
use fmu_build::shared::Project;

fn all_fmus(folder: &Path) -> Vec<PathBuf> {
    common::names().iter().map(|name| common::fmu3_of(name, folder)).collect()
}

#[test]
fn validate_fmu_finds_nothing_in_fmi_3() {
    let fmus = all_fmus(&common::folder("validate3"));
    common::python().run("validate.py", fmus).unwrap_or_else(|error| panic!("{error:#}"));
}

#[test]
fn simulate_fmu_runs_a_scene_of_each_kind_of_contact_under_fmi_3() {
    let folder = common::folder("simulate3-some");
    let names = ["6205-healthy", "6205-epps", "nu205-healthy", "er16k-tb1-oil"];
    common::run_script("simulate.py", names.map(|name| common::fmu3_of(name, &folder)));
}

#[test]
#[ignore = "half a minute; all scenes give the bits of FMI 2.0, under which all are simulated"]
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
#[cfg(debug_assertions)]
fn the_build_command_makes_either_version() {
    let folder = common::folder("build3");
    let scene = common::root().join("scenes/6205-healthy.toml");
    let library = common::built_with_the_tests().unwrap();
    let build = |options: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_brinell"));
        command.arg("build").arg(&scene).arg("--library").arg(&library).arg("-o").arg(&folder);
        let output = command.args(options).output().unwrap();
        (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let expected = common::folder("build3-expected");
    let built = || std::fs::read(folder.join("6205-healthy.fmu")).unwrap();
    for (options, make) in [
        (&["--fmi", "3"][..], common::fmu3_of as fn(&str, &Path) -> PathBuf),
        (&["--fmi", "2"], common::fmu_of),
        (&[], common::fmu_of),
    ] {
        let (succeeded, said) = build(options);
        assert!(succeeded, "{said}");
        assert!(built() == std::fs::read(make("6205-healthy", &expected)).unwrap(), "{options:?}");
    }
}

#[test]
fn the_check_command_passes_an_fmu_of_fmi_3() {
    let folder = common::folder("check3");
    for name in ["6205-epps", "6205-hosted"] {
        check::command(&Project::find(), &common::fmu3_of(name, &folder), false).unwrap();
    }
}

#[test]
fn states_derivatives_updates_and_terminals_of_every_shipped_scene_keep_to_fmi_3() {
    println!("{}", common::run_script("fmi3.py", all_fmus(&common::folder("fmi3"))));
}
