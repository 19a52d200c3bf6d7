//! A public importer drives the FMUs of FMI 3.0: fmpy, through the C interface. The scripts in `tests/python` say what
//! they check.
#![allow(clippy::unwrap_used)]

use crate::common::{self, run_script};
use std::path::PathBuf;

use fmu_build::commands::check;
use fmu_build::shared::{Project, Version};

fn fmu_of(name: &str) -> PathBuf {
    common::fmu(name, Version::Fmi3)
}

#[test]
fn validate_fmu_finds_nothing_in_fmi_3() {
    common::validate(common::fmus(Version::Fmi3));
}

#[test]
fn simulate_fmu_runs_a_scene_of_each_kind_of_contact_under_fmi_3() {
    run_script("steps/simulate.py", ["6205-healthy", "6205-epps", "nu205-healthy", "er16k-tb1-oil"].map(fmu_of));
}

#[test]
#[ignore = "half a minute; all scenes give the bits of FMI 2.0, under which all are simulated"]
fn simulate_fmu_runs_every_shipped_scene_under_fmi_3() {
    run_script("steps/simulate.py", common::fmus(Version::Fmi3));
}

#[test]
fn every_shipped_scene_gives_the_bits_of_fmi_2_under_fmi_3() {
    let pairs = common::names().into_iter().flat_map(|name| [common::fmu_of(&name), fmu_of(&name)]);
    println!("{}", run_script("interface/equal_bits3.py", [PathBuf::from("300")].into_iter().chain(pairs)));
}

#[test]
#[cfg(debug_assertions)]
fn the_build_command_makes_either_version() {
    let (folder, library) = (common::folder("build3"), common::built_with_the_tests().unwrap());
    for (options, version) in
        [(&["--fmi", "3"][..], Version::Fmi3), (&["--fmi", "2"], Version::Fmi2), (&[], Version::Fmi2)]
    {
        let mut build = common::program::brinell(&["build", "6205-healthy", "--library"]);
        common::program::done(build.arg(&library).arg("-o").arg(&folder).args(options));
        let [built, expected] = [folder.join("6205-healthy.fmu"), common::fmu("6205-healthy", version)];
        assert!(std::fs::read(built).unwrap() == std::fs::read(expected).unwrap(), "{options:?}");
    }
}

#[test]
fn the_check_command_passes_an_fmu_of_fmi_3() {
    for name in ["6205-epps", "6205-hosted"] {
        check::command(&Project::find(), &fmu_of(name), false).unwrap();
    }
}

#[test]
fn states_derivatives_updates_and_terminals_of_every_shipped_scene_keep_to_fmi_3() {
    println!("{}", run_script("interface/fmi3.py", common::fmus(Version::Fmi3)));
}
