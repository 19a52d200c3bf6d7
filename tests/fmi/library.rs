//! The compiled library as a host loads it: what it exports, and that it leaves no trace.
//!
//! The tests run one after another, because they look at the whole process.
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

#[path = "../support/mod.rs"]
mod support;

use brinell_tests::resources::Resources;
use host::{Instance, library_beside};
use object::Object;
use std::fs;
use std::path::Path;
use std::sync::Mutex;

static ALONE: Mutex<()> = Mutex::new(());

/// FMI 2.0: the 34 functions of co-simulation and the 10 of model exchange. FMI 3.0: all 75. Sorted.
const NAMES: &str = include_str!("exports.txt");

/// `er16k-tb1` with its contact map.
fn with_map() -> Resources {
    let text = include_str!("../../scenes/er16k-tb1.toml");
    let map = support::map_of(&support::shipped_as_it_is("er16k-tb1"), None).unwrap();
    Resources::new(text, None, "resources").with_map(&map)
}

fn started(path: &Path, resources: &Resources) -> Instance {
    let mut instance = Instance::new(path, "library", &resources.guid, &resources.directory).unwrap();
    instance.initialize(None).unwrap();
    instance
}

/// Memory of this process in bytes.
#[cfg(target_os = "linux")]
fn resident() -> usize {
    let text = fs::read_to_string("/proc/self/statm").unwrap();
    let pages: usize = text.split_whitespace().nth(1).unwrap().parse().unwrap();
    pages * 4096
}

/// Loads the library, runs a bearing through a step, an error and a saved state, and unloads it.
fn cycle(path: &Path, resources: &Resources) {
    let mut instance = started(path, resources);
    instance.step(0.0, 1e-5).unwrap();
    instance.save(None).unwrap();
    assert!(instance.step(5.0, 1e-5).is_err());
}

#[test]
fn exactly_the_functions_of_the_standard_are_exported() {
    let _alone = ALONE.lock().unwrap();
    let bytes = fs::read(library_beside().unwrap()).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    let mut names: Vec<_> = file
        .exports()
        .unwrap()
        // Mach-O puts an underscore before every name.
        .map(|export| {
            String::from_utf8_lossy(export.unwrap().name().name().unwrap_or(b"(number)"))
                .trim_start_matches('_')
                .to_owned()
        })
        .collect();
    names.sort();
    assert_eq!(names, NAMES.lines().collect::<Vec<_>>());
}

#[test]
#[cfg(target_os = "linux")]
fn after_650_cycles_of_loading_and_unloading_nothing_is_left() {
    let _alone = ALONE.lock().unwrap();
    let path = library_beside().unwrap();
    let scenes = [Resources::of("er16k-tb1"), with_map()];
    let mapped = || fs::read_to_string("/proc/self/maps").unwrap().contains(path.to_str().unwrap());
    // The allocator's own pieces settle within 200.
    for number in 0..250 {
        cycle(&path, &scenes[number % 2]);
    }
    assert!(!mapped(), "the library is still mapped");
    let before = resident();
    for number in 0..400 {
        cycle(&path, &scenes[number % 2]);
    }
    assert!(!mapped(), "the library is still mapped");
    // A leak of one saved state (1 kB) per cycle would be twice that.
    let growth = resident().saturating_sub(before);
    assert!(growth < 200 << 10, "{growth} bytes");
}

#[test]
#[cfg(target_os = "linux")]
fn further_instances_of_a_scene_take_36_kilobytes_each() {
    let _alone = ALONE.lock().unwrap();
    let (path, scene) = (library_beside().unwrap(), with_map());
    let count = 300;
    let several = || -> Vec<Instance> { (0..count).map(|_| started(&path, &scene)).collect() };
    // What tests before this one have freed is used first, and would not show.
    let first = several();
    let before = resident();
    let all = several();
    // The host keeps 120 bytes of its own for each, and two small allocations of 48.
    let each = resident().saturating_sub(before) / count - 216;
    drop((first, all));
    // A map alone takes half a megabyte.
    assert!(each <= 36_000, "{each} bytes");
}
