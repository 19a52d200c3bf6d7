//! Every scene in `scenes/` can be read, is named like its file and sources its numbers.

use brinell::surface::{Profile, Surface};
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    brinell_tests::root().join("scenes")
}

/// Name and text of every scene.
pub(crate) fn scenes() -> Vec<(String, String)> {
    let paths = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let scenes = paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenes.map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), read(&path))).collect()
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{path:?}: {error}"))
}

#[test]
fn every_shipped_scene_can_be_read_and_is_named_like_its_file() {
    let scenes = scenes();
    assert!(scenes.len() >= 6, "{}", scenes.len());
    for (name, text) in scenes {
        let scene = brinell_scene_file::from_toml(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(scene.name, name);
        assert!(!scene.description.is_empty(), "{name}");
    }
}

#[test]
fn every_surface_of_a_shipped_scene_can_be_loaded() {
    for (name, text) in scenes() {
        let scene = brinell_scene_file::from_toml(&text).unwrap();
        let profiles: Vec<_> = scene.profile_names().iter().map(|file| read(&folder().join(file))).collect();
        let surfaces = Surface::load_all(&scene, profiles.iter().map(String::as_str));
        let surfaces = surfaces.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(surfaces.len(), scene.defects.len(), "{name}");
        assert!(surfaces.iter().all(|surface| surface.extent().1 > surface.extent().0), "{name}");
    }
}

#[test]
fn every_number_in_a_shipped_scene_has_a_source_or_is_assumed() {
    for (name, text) in scenes() {
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let Some((_, value)) = line.split_once('=') else { continue };
            let (value, comment) = value.split_once('#').unwrap_or((value, ""));
            if !value.contains('"') {
                assert!(comment.trim().len() > 3, "{name}: `{line}` has no source");
            }
        }
    }
}

#[test]
fn the_stand_in_trace_has_the_length_that_was_reported() {
    let trace = Profile::from_csv(&read(&folder().join("6205-epps-trace.csv"))).unwrap();
    let deep: Vec<f64> = trace.points().iter().filter(|point| point.1 > 0.0).map(|point| point.0).collect();
    // 0.8 mm at the surface: the last points at depth lie within one spacing of 4 um of either edge.
    let length = deep[deep.len() - 1] - deep[0];
    assert!((0.792e-3 - 1e-9..0.8e-3).contains(&length), "{length}");
    // An element sinks 17 um into 0.8 mm; the floor must stay out of its reach.
    assert!(trace.points().iter().filter(|point| point.0.abs() < 0.39e-3).all(|point| point.1 > 30e-6));
}
