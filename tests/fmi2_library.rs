//! The compiled library as a host loads it: what it exports, and that it leaves no trace.
//!
//! `unsafe` is what loading a library takes. The tests run in one thread, after one another, because they look at the whole process.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

use brinell::fmi2::*;
use brinell::simulation::guid::guid;
use libloading::{Library, Symbol};
use object::Object;
use std::ffi::CString;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::{env, fs, ptr};

static ALONE: Mutex<()> = Mutex::new(());

const NAMES: [&str; 34] = [
    "fmi2CancelStep",
    "fmi2DeSerializeFMUstate",
    "fmi2DoStep",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2FreeFMUstate",
    "fmi2FreeInstance",
    "fmi2GetBoolean",
    "fmi2GetBooleanStatus",
    "fmi2GetDirectionalDerivative",
    "fmi2GetFMUstate",
    "fmi2GetInteger",
    "fmi2GetIntegerStatus",
    "fmi2GetReal",
    "fmi2GetRealOutputDerivatives",
    "fmi2GetRealStatus",
    "fmi2GetStatus",
    "fmi2GetString",
    "fmi2GetStringStatus",
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2Instantiate",
    "fmi2Reset",
    "fmi2SerializeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SetBoolean",
    "fmi2SetDebugLogging",
    "fmi2SetFMUstate",
    "fmi2SetInteger",
    "fmi2SetReal",
    "fmi2SetRealInputDerivatives",
    "fmi2SetString",
    "fmi2SetupExperiment",
    "fmi2Terminate",
];

/// The library that was built along with this test.
fn library() -> PathBuf {
    let test = env::current_exe().unwrap();
    test.with_file_name(format!("{}brinell{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX))
}

type Instantiate = unsafe extern "C" fn(
    FmiString,
    FmuType,
    FmiString,
    FmiString,
    *const CallbackFunctions,
    Boolean,
    Boolean,
) -> Component;

unsafe extern "C" fn ignore(_: ComponentEnvironment, _: FmiString, _: Status, _: FmiString, _: FmiString) {}

/// Loads the library, runs a bearing through a step, an error and a saved state, and unloads it.
fn cycle(path: &Path, guid: &CString, location: &CString) {
    // SAFETY: the signatures are those of the standard; every call is one that the standard allows, with good
    // pointers. The logger ignores what it gets; on the platforms tested, leaving arguments out of a C function does
    // no harm.
    unsafe {
        let library = Library::new(path).unwrap();
        let callbacks = CallbackFunctions {
            logger: Some(std::mem::transmute::<
                unsafe extern "C" fn(ComponentEnvironment, FmiString, Status, FmiString, FmiString),
                LoggerCallback,
            >(ignore)),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::null_mut(),
        };
        let instantiate: Symbol<'_, Instantiate> = library.get("fmi2Instantiate").unwrap();
        let setup: Symbol<'_, unsafe extern "C" fn(Component, Boolean, f64, f64, Boolean, f64) -> Status> =
            library.get("fmi2SetupExperiment").unwrap();
        let plain =
            |name: &str| -> Symbol<'_, unsafe extern "C" fn(Component) -> Status> { library.get(name).unwrap() };
        let step: Symbol<'_, unsafe extern "C" fn(Component, f64, f64, Boolean) -> Status> =
            library.get("fmi2DoStep").unwrap();
        let save: Symbol<'_, unsafe extern "C" fn(Component, *mut FmuState) -> Status> =
            library.get("fmi2GetFMUstate").unwrap();
        let free: Symbol<'_, unsafe extern "C" fn(Component)> = library.get("fmi2FreeInstance").unwrap();

        let c = instantiate(
            c"cycle".as_ptr(),
            CO_SIMULATION,
            guid.as_ptr(),
            location.as_ptr(),
            &raw const callbacks,
            FALSE,
            TRUE,
        );
        assert!(!c.is_null());
        assert_eq!(setup(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
        assert_eq!(plain("fmi2EnterInitializationMode")(c), Status::Ok);
        assert_eq!(plain("fmi2ExitInitializationMode")(c), Status::Ok);
        assert_eq!(step(c, 0.0, 1e-5, TRUE), Status::Ok);
        let mut state = ptr::null_mut();
        assert_eq!(save(c, &raw mut state), Status::Ok);
        assert_eq!(step(c, 5.0, 1e-5, TRUE), Status::Error);
        free(c);
    }
}

fn scene() -> (CString, CString) {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("library-{}", std::process::id()));
    fs::create_dir_all(&directory).unwrap();
    let text = include_str!("../scenes/er16k-tb1.toml");
    fs::write(directory.join("scene.toml"), text).unwrap();
    let location = format!("file://{}", directory.to_str().unwrap());
    (CString::new(guid(text, None)).unwrap(), CString::new(location).unwrap())
}

#[test]
fn exactly_the_functions_of_a_co_simulation_unit_are_exported() {
    let _alone = ALONE.lock().unwrap();
    let bytes = fs::read(library()).unwrap();
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
    assert_eq!(names, NAMES);
}

#[test]
#[cfg(target_os = "linux")]
fn after_2500_cycles_of_loading_and_unloading_nothing_is_left() {
    let _alone = ALONE.lock().unwrap();
    let path = library();
    let (guid, location) = scene();
    let mapped = || fs::read_to_string("/proc/self/maps").unwrap().contains(path.to_str().unwrap());
    let resident = || {
        let text = fs::read_to_string("/proc/self/statm").unwrap();
        let pages: u64 = text.split_whitespace().nth(1).unwrap().parse().unwrap();
        pages * 4096
    };
    for _ in 0..50 {
        cycle(&path, &guid, &location);
    }
    assert!(!mapped(), "the library is still mapped");
    let before = resident();
    for _ in 0..2450 {
        cycle(&path, &guid, &location);
    }
    assert!(!mapped(), "the library is still mapped");
    // 1 MB: a leak of one saved state (1 kB) per cycle would be twice that.
    let growth = resident().saturating_sub(before);
    assert!(growth < 1 << 20, "{growth} bytes");
    fs::remove_dir_all(location.to_str().unwrap().trim_start_matches("file://")).unwrap();
}
