//! Reference results as the FMI cross-check and FMI-LS-REF want them: fmpy accepts the files, and finds the results.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::ffi::OsString;
use std::path::Path;

use crate::common::program::{brinell, done};
use fmu_build::shared::Version;

fn build(options: &[&str], folder: &Path) -> String {
    let mut command = brinell(&["build", "--reference"]);
    if let Some(library) = common::built_with_the_tests() {
        command.env("BRINELL_LIBRARY", library);
    }
    done(command.args(options).arg("-o").arg(folder)).out
}

fn the_cross_check_finds_them(names: &[&str], folder: &str) {
    let folder = common::folder(folder);
    let said = build(names, &folder);
    assert!(said.lines().last().unwrap().ends_with(".fmu"), "the FMU comes last: {said}");
    let arguments = std::iter::once(OsString::from(&folder)).chain(names.iter().map(OsString::from));
    println!("{}", common::run_script("reference/reference.py", arguments));
}

#[test]
fn the_cross_check_finds_reference_results_whoever_moves_the_rings() {
    the_cross_check_finds_them(&["6205-hosted", "6205-epps", "nu205-healthy"], "reference-some");
}

#[test]
#[ignore = "half a minute"]
fn the_cross_check_finds_the_reference_results_of_every_shipped_scene() {
    let names = common::names();
    the_cross_check_finds_them(&names.iter().map(String::as_str).collect::<Vec<_>>(), "reference");
}

#[test]
fn an_fmu_holds_its_reference_results_with_their_manifest_and_experiment() {
    let fmus = ["2", "3"].map(|version| {
        let folder = common::folder(&format!("reference-in-{version}"));
        build(&["er16k-tb1", "6205-hosted", "--fmi", version], &folder);
        [folder.join("er16k-tb1.fmu"), folder.join("6205-hosted.fmu")]
    });
    println!("{}", common::run_script("reference/reference_inside.py", fmus.concat()));
}

#[test]
fn without_being_asked_an_fmu_holds_no_reference_results() {
    let file = std::fs::File::open(common::fmu("6205-healthy", Version::Fmi3)).unwrap();
    let archive = zip::ZipArchive::new(file).unwrap();
    assert!(archive.file_names().all(|name| !name.unwrap().starts_with("extra/")));
}
