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

/// FMI 2.0: the 34 functions of co-simulation, and the 10 of model exchange that only refuse. FMI 3.0: all 75.
const NAMES: [&str; 119] = [
    "fmi2CancelStep",
    "fmi2CompletedIntegratorStep",
    "fmi2DeSerializeFMUstate",
    "fmi2DoStep",
    "fmi2EnterContinuousTimeMode",
    "fmi2EnterEventMode",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2FreeFMUstate",
    "fmi2FreeInstance",
    "fmi2GetBoolean",
    "fmi2GetBooleanStatus",
    "fmi2GetContinuousStates",
    "fmi2GetDerivatives",
    "fmi2GetDirectionalDerivative",
    "fmi2GetEventIndicators",
    "fmi2GetFMUstate",
    "fmi2GetInteger",
    "fmi2GetIntegerStatus",
    "fmi2GetNominalsOfContinuousStates",
    "fmi2GetReal",
    "fmi2GetRealOutputDerivatives",
    "fmi2GetRealStatus",
    "fmi2GetStatus",
    "fmi2GetString",
    "fmi2GetStringStatus",
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2Instantiate",
    "fmi2NewDiscreteStates",
    "fmi2Reset",
    "fmi2SerializeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SetBoolean",
    "fmi2SetContinuousStates",
    "fmi2SetDebugLogging",
    "fmi2SetFMUstate",
    "fmi2SetInteger",
    "fmi2SetReal",
    "fmi2SetRealInputDerivatives",
    "fmi2SetString",
    "fmi2SetTime",
    "fmi2SetupExperiment",
    "fmi2Terminate",
    "fmi3ActivateModelPartition",
    "fmi3CompletedIntegratorStep",
    "fmi3DeserializeFMUState",
    "fmi3DoStep",
    "fmi3EnterConfigurationMode",
    "fmi3EnterContinuousTimeMode",
    "fmi3EnterEventMode",
    "fmi3EnterInitializationMode",
    "fmi3EnterStepMode",
    "fmi3EvaluateDiscreteStates",
    "fmi3ExitConfigurationMode",
    "fmi3ExitInitializationMode",
    "fmi3FreeFMUState",
    "fmi3FreeInstance",
    "fmi3GetAdjointDerivative",
    "fmi3GetBinary",
    "fmi3GetBoolean",
    "fmi3GetClock",
    "fmi3GetContinuousStateDerivatives",
    "fmi3GetContinuousStates",
    "fmi3GetDirectionalDerivative",
    "fmi3GetEventIndicators",
    "fmi3GetFMUState",
    "fmi3GetFloat32",
    "fmi3GetFloat64",
    "fmi3GetInt16",
    "fmi3GetInt32",
    "fmi3GetInt64",
    "fmi3GetInt8",
    "fmi3GetIntervalDecimal",
    "fmi3GetIntervalFraction",
    "fmi3GetNominalsOfContinuousStates",
    "fmi3GetNumberOfContinuousStates",
    "fmi3GetNumberOfEventIndicators",
    "fmi3GetNumberOfVariableDependencies",
    "fmi3GetOutputDerivatives",
    "fmi3GetShiftDecimal",
    "fmi3GetShiftFraction",
    "fmi3GetString",
    "fmi3GetUInt16",
    "fmi3GetUInt32",
    "fmi3GetUInt64",
    "fmi3GetUInt8",
    "fmi3GetVariableDependencies",
    "fmi3GetVersion",
    "fmi3InstantiateCoSimulation",
    "fmi3InstantiateModelExchange",
    "fmi3InstantiateScheduledExecution",
    "fmi3Reset",
    "fmi3SerializeFMUState",
    "fmi3SerializedFMUStateSize",
    "fmi3SetBinary",
    "fmi3SetBoolean",
    "fmi3SetClock",
    "fmi3SetContinuousStates",
    "fmi3SetDebugLogging",
    "fmi3SetFMUState",
    "fmi3SetFloat32",
    "fmi3SetFloat64",
    "fmi3SetInt16",
    "fmi3SetInt32",
    "fmi3SetInt64",
    "fmi3SetInt8",
    "fmi3SetIntervalDecimal",
    "fmi3SetIntervalFraction",
    "fmi3SetShiftDecimal",
    "fmi3SetShiftFraction",
    "fmi3SetString",
    "fmi3SetTime",
    "fmi3SetUInt16",
    "fmi3SetUInt32",
    "fmi3SetUInt64",
    "fmi3SetUInt8",
    "fmi3Terminate",
    "fmi3UpdateDiscreteStates",
];

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
    let mut expected = NAMES;
    expected.sort_unstable();
    assert_eq!(names, expected);
}

#[test]
#[cfg(target_os = "linux")]
fn after_650_cycles_of_loading_and_unloading_nothing_is_left() {
    let _alone = ALONE.lock().unwrap();
    let path = library_beside().unwrap();
    let scenes = [Resources::of("er16k-tb1"), with_map()];
    let mapped = || fs::read_to_string("/proc/self/maps").unwrap().contains(path.to_str().unwrap());
    for number in 0..50 {
        cycle(&path, &scenes[number % 2]);
    }
    assert!(!mapped(), "the library is still mapped");
    let before = resident();
    for number in 0..600 {
        cycle(&path, &scenes[number % 2]);
    }
    assert!(!mapped(), "the library is still mapped");
    // A leak of one saved state (1 kB) per cycle would be twice that.
    let growth = resident().saturating_sub(before);
    assert!(growth < 300 << 10, "{growth} bytes");
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
