//! Reference results as the FMI cross-check and FMI-LS-REF want them: fmpy accepts the files, and finds the results.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

fn build(options: &[&str], folder: &Path) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_brinell"));
    if let Some(library) = common::built_with_the_tests() {
        command.env("BRINELL_LIBRARY", library);
    }
    let output = command.args(["build", "--reference"]).args(options).arg("-o").arg(folder).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn the_cross_check_finds_them(names: &[&str], folder: &str) {
    let folder = common::folder(folder);
    let said = build(names, &folder);
    assert!(said.lines().last().unwrap().ends_with(".fmu"), "the FMU comes last: {said}");
    let arguments = std::iter::once(OsString::from(&folder)).chain(names.iter().map(OsString::from));
    println!("{}", common::run_script("reference.py", arguments));
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
    for version in ["2", "3"] {
        let folder = common::folder(&format!("reference-in-{version}"));
        build(&["er16k-tb1", "6205-hosted", "--fmi", version], &folder);
        let fmus = [folder.join("er16k-tb1.fmu"), folder.join("6205-hosted.fmu")];
        println!("{}", common::run_script("reference_inside.py", fmus));
    }
}

#[test]
fn without_being_asked_an_fmu_holds_no_reference_results() {
    let bytes = std::fs::read(common::fmu3_of("6205-healthy", &common::folder("no-reference"))).unwrap();
    let archive = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
    assert!(archive.file_names().all(|name| !name.unwrap().starts_with("extra/")));
}
