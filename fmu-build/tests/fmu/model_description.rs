//! The model descriptions of all shipped scenes stand in `modelDescription/`, so that a change of the public interface
//! is a diff to review. After an intended change: `BLESS=1 cargo test -p fmu-build --test fmu model_description`.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use brinell::simulation::interface::table::{Causality, Kind, Variability};
use fmu_build::package::Model;
use fmu_build::package::description::{model_description, units};
use fmu_build::shared::Version;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

fn attribute(element: &BytesStart<'_>, name: &str) -> Option<String> {
    let found = element.try_get_attribute(name).unwrap()?;
    Some(found.normalized_value(XmlVersion::Implicit1_0).unwrap().into_owned())
}

/// Scenes whose interfaces after FMI 3.0 are kept: inputs for forces and for motion, a scalar of one element, several
/// sensors. All others follow from the same rows.
const KEPT: [&str; 4] = ["6205-hosted", "6205-two-defects", "er16k-element", "er16k-tb1"];

/// A folder holds the descriptions of these scenes, as they are now, and `more`.
fn are_committed(folder: &Path, names: &[&str], version: Version, more: Option<PathBuf>) {
    let mut expected = BTreeSet::from_iter(more);
    for name in names {
        let file = folder.join(name).with_extension("xml");
        common::is_committed(&file, &model_description(&common::model(name), version).unwrap());
        expected.insert(file);
    }
    let there: BTreeSet<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert_eq!(there, expected, "one file for each scene");
}

#[test]
fn the_committed_model_descriptions_are_those_of_the_shipped_scenes() {
    let (folder, names) = (common::root().join("modelDescription"), common::names());
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    are_committed(&folder, &names, Version::Fmi2, Some(folder.join("fmi3")));
}

#[test]
fn the_committed_model_descriptions_of_fmi_3_are_those_of_their_scenes() {
    are_committed(&common::root().join("modelDescription/fmi3"), &KEPT, Version::Fmi3, None);
}

#[test]
fn both_versions_have_the_same_variables_by_the_same_names() {
    for scene in common::scenes() {
        let model = Model::read(&scene).unwrap();
        let written = model_description(&model, Version::Fmi3).unwrap();
        let mut names: BTreeSet<String> = BTreeSet::new();
        let mut reader = Reader::from_str(&written);
        let mut last = String::new();
        loop {
            match reader.read_event().unwrap() {
                Event::Eof => break,
                Event::Start(element) | Event::Empty(element) => {
                    let attribute = |name| attribute(&element, name);
                    if attribute("causality").is_some() {
                        last = attribute("name").unwrap();
                        assert!(names.insert(last.clone()), "{last} twice");
                    } else if element.name().as_ref() == "Dimension" {
                        names.remove(&last);
                        let count: u32 = attribute("start").unwrap().parse().unwrap();
                        let (head, tail) = last.split_once('.').unwrap();
                        names.extend((1..=count).map(|j| format!("{head}[{j}].{tail}")));
                    }
                }
                _ => {}
            }
        }
        assert!(names.remove("time"));
        let expected: BTreeSet<String> = model.simulation.table().iter().map(|row| row.name.clone()).collect();
        assert_eq!(names, expected, "{}", model.scene.name);
    }
}

#[test]
fn only_topographies_that_balls_meet_beside_their_track_have_a_counter_of_it() {
    let folder = common::folder("topography");
    let depths = "arc_mm,axial_mm,depth_um\n-0.1,0.8,0\n-0.1,1.4,0\n0.1,0.8,0\n0.1,1.4,0\n";
    fs::write(folder.join("topography.csv"), depths).unwrap();
    // In the plane balls stay on the track, so rows must reach there.
    fs::write(folder.join("on_track.csv"), depths.replace("0.8,", "-0.3,").replace("1.4,", "0.3,")).unwrap();
    fs::write(folder.join("trace.csv"), "arc_mm,depth_um\n-0.1,0\n0.1,0\n").unwrap();
    for (freedom, file, counts) in
        [(3, "topography", true), (5, "topography", true), (2, "on_track", false), (3, "trace", false)]
    {
        let in_space = if freedom == 2 { "" } else { "operating_angle_deg = 15.0\n" };
        let scene = format!(
            "name = \"met\"\n[bearing]\ndegrees_of_freedom = {freedom}\nelement_count = 9\n\
             element_diameter_mm = 7.94\npitch_diameter_mm = 39.04\n{in_space}\
             youngs_modulus_gpa = 207.0\npoissons_ratio = 0.3\ndensity_kg_m3 = 7800.0\nradial_clearance_um = 8.0\n\
             conformity_inner = 0.52\nconformity_outer = 0.52\n[contact]\nlaw = \"love\"\n\
             [defect]\nangle_deg = -90.0\nprofile = \"{file}.csv\"\n\
             [shaft]\nmotion = \"host\"\nspeed_hz = 1.0\n[housing]\nmotion = \"fixed\"\n"
        );
        let path = folder.join("met.toml");
        fs::write(&path, scene).unwrap();
        let model = Model::read(&path).unwrap();
        for version in [Version::Fmi2, Version::Fmi3] {
            let written = model_description(&model, version).unwrap();
            assert_eq!(written.contains("solver.off_track_contacts"), counts, "{freedom} {file} {version:?}");
        }
    }
}

#[test]
fn the_table_keeps_the_rules_that_the_writer_relies_on() {
    for scene in common::scenes() {
        let model = Model::read(&scene).unwrap();
        let table = model.simulation.table();
        for (index, variable) in table.iter().enumerate() {
            let name = &variable.name;
            assert_eq!(variable.reference as usize, index, "{name}: the reference is the index");
            assert!(!variable.description.is_empty(), "{name}: a description");
            let is_real = matches!(variable.kind, Kind::Real { .. });
            assert!(is_real || variable.variability != Variability::Continuous, "{name}: only reals are continuous");
            // pathsim-fmi and CoFMUPy read every output as a real number.
            assert!(is_real || variable.causality != Causality::Output, "{name}: only reals are outputs");
            match variable.causality {
                Causality::Parameter => assert_eq!(variable.variability, Variability::Fixed, "{name}"),
                // Half of a parameter.
                Causality::Local if is_real && variable.variability == Variability::Fixed => {
                    assert_eq!(name, "bearing.radial_clearance");
                }
                _ => assert_ne!(variable.variability, Variability::Fixed, "{name}"),
            }
            if let Kind::Real { start, min, max, nominal, .. } = variable.kind {
                assert!(nominal > 0.0 && nominal.is_finite(), "{name}: nominal {nominal}");
                let given = matches!(variable.causality, Causality::Input | Causality::Parameter);
                assert_eq!(start.is_some(), given, "{name}: start");
                let start = start.unwrap_or(nominal);
                let (min, max) = (min.unwrap_or(f64::NEG_INFINITY), max.unwrap_or(f64::INFINITY));
                assert!(!given || (min..=max).contains(&start), "{name}: start {start}");
            }
        }
        for output in model.simulation.dependencies() {
            let name = &table[output.output as usize].name;
            assert!(output.direct.is_sorted() && output.initial.is_sorted(), "{name}: dependencies ascend");
            let causality = |&known: &u32| table[known as usize].causality;
            assert!(output.direct.iter().all(|known| causality(known) == Causality::Input), "{name} follows inputs");
            assert!(
                output.initial.iter().all(|known| matches!(causality(known), Causality::Input | Causality::Parameter)),
                "{name} starts from knowns"
            );
        }
    }
}

#[test]
fn a_display_unit_is_the_unit_times_its_factor() {
    use brinell::simulation::interface::table::Unit;
    let (_, factor) = units::display_unit(Unit::RadianPerSecond, 100.0).unwrap();
    // 10 Hz are 600 rev/min; 2 ulp for the two roundings.
    let speed = 10.0 * std::f64::consts::TAU;
    assert!((factor * speed - 600.0).abs() < 4.0 * f64::EPSILON * 600.0);
}

#[test]
fn special_characters_of_a_scene_survive_in_the_xml() {
    let mut model = common::model("6205-healthy");
    model.scene.description = "Ø 7.94 < \"8\" & more,\n\ton two lines".to_owned();
    let written = model_description(&model, Version::Fmi2).unwrap();
    let mut reader = Reader::from_str(&written);
    let description = loop {
        match reader.read_event().unwrap() {
            Event::Start(root) => break attribute(&root, "description"),
            Event::Eof => panic!("no root element"),
            _ => {}
        }
    };
    assert_eq!(description, Some(model.scene.description));
}
