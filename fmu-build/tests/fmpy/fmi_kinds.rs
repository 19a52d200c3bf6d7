//! Other interfaces than the usual one: Model Exchange, flat names, FMI 3.0 without arrays.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::collections::BTreeSet;
use std::path::PathBuf;

use fmu_build::package::{description, write};
use fmu_build::shared::{Interface, Kind, Names, Version};

fn packed(scenes: &[&str], interface: Interface, folder: &str) -> Vec<PathBuf> {
    let folder = common::folder(folder);
    let write = |name: &&str| write(&common::model(name), common::library(), interface, &folder).unwrap();
    scenes.iter().map(write).collect()
}

#[test]
fn cvode_of_fmpy_integrates_what_the_fmu_integrates_itself() {
    let fmus = [(Version::Fmi2, "exchange2"), (Version::Fmi3, "exchange3")].map(|(version, folder)| {
        let interface = Interface { version, kind: Kind::Both, ..Interface::default() };
        packed(&["6205-healthy", "er16k-tb1"], interface, folder)
    });
    println!("{}", common::run_script("steps/model_exchange.py", fmus.concat()));
}

#[test]
fn fmpy_finds_nothing_wrong_with_other_kinds_names_and_scalars() {
    let scenes = ["6205-healthy", "6205-hosted", "er16k-inner", "6205-two-defects", "7205-inner"];
    let mut fmus = Vec::new();
    for version in [Version::Fmi2, Version::Fmi3] {
        for kind in [Kind::Cs, Kind::Me, Kind::Both] {
            let scalars = version == Version::Fmi3;
            let interface = Interface { version, kind, names: Names::Flat, scalars };
            fmus.extend(packed(&scenes, interface, &format!("kinds-{}-{kind:?}", version.number())));
        }
    }
    common::validate(fmus);
}

#[test]
fn fmpy_steps_an_fmu_of_fmi_3_without_arrays() {
    let interface = Interface { version: Version::Fmi3, scalars: true, ..Interface::default() };
    common::run_script("steps/simulate.py", packed(&["er16k-tb1"], interface, "scalars"));
}

#[test]
fn flat_names_are_identifiers_of_at_most_55_letters_and_differ() {
    let interface = Interface { kind: Kind::Both, names: Names::Flat, ..Interface::default() };
    for name in common::names() {
        let written = description::model_description(&common::model(&name), interface).unwrap();
        let names = written.split("<ScalarVariable name=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
        let names: Vec<&str> = names.collect();
        for name in &names {
            let is_identifier = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            assert!(is_identifier && name.len() <= 55, "{name}");
        }
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{name}: names differ");
    }
}
