//! The compiled library as a host loads it.

use brinell::scene::model_file;
use brinell::simulation::interface::table::guid;
use brinell_fmi::fmi2::*;
use libloading::{Library, Symbol};
use std::ffi::{CStr, CString};
use std::path::{Path, PathBuf};
use std::{env, fs, ptr};

/// The library that was built along with this test.
pub(crate) fn library() -> PathBuf {
    let test = env::current_exe().unwrap();
    test.with_file_name(format!("{}brinell_fmi{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX))
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

/// The library's functions that the tests here use.
pub(crate) struct Api<'l> {
    instantiate: Symbol<'l, Instantiate>,
    setup: Symbol<'l, unsafe extern "C" fn(Component, Boolean, f64, f64, Boolean, f64) -> Status>,
    enter: Symbol<'l, Plain>,
    exit: Symbol<'l, Plain>,
    pub(crate) step: Symbol<'l, unsafe extern "C" fn(Component, f64, f64, Boolean) -> Status>,
    pub(crate) save: Symbol<'l, unsafe extern "C" fn(Component, *mut FmuState) -> Status>,
    pub(crate) free: Symbol<'l, unsafe extern "C" fn(Component)>,
}

type Plain = unsafe extern "C" fn(Component) -> Status;

impl<'l> Api<'l> {
    pub(crate) fn of(library: &'l Library) -> Self {
        // SAFETY: the signatures are those of the standard.
        unsafe {
            Self {
                instantiate: library.get("fmi2Instantiate").unwrap(),
                setup: library.get("fmi2SetupExperiment").unwrap(),
                enter: library.get("fmi2EnterInitializationMode").unwrap(),
                exit: library.get("fmi2ExitInitializationMode").unwrap(),
                step: library.get("fmi2DoStep").unwrap(),
                save: library.get("fmi2GetFMUstate").unwrap(),
                free: library.get("fmi2FreeInstance").unwrap(),
            }
        }
    }

    /// An instance at its first communication point.
    pub(crate) fn start(&self, name: &CStr, scene: &Scene) -> Component {
        let c = self.create(name, scene);
        self.begin(c);
        c
    }

    /// An instance.
    pub(crate) fn create(&self, name: &CStr, scene: &Scene) -> Component {
        // SAFETY: the call is one that the standard allows, with good pointers. The logger ignores what it gets; on
        // the platforms tested, leaving arguments out of a C function does no harm.
        unsafe {
            let callbacks = CallbackFunctions {
                logger: Some(std::mem::transmute::<Ignore, LoggerCallback>(ignore)),
                allocate_memory: None,
                free_memory: None,
                step_finished: None,
                component_environment: ptr::null_mut(),
            };
            let (guid, location) = (scene.guid.as_ptr(), scene.location.as_ptr());
            let callbacks = &raw const callbacks;
            let c = (self.instantiate)(name.as_ptr(), CO_SIMULATION, guid, location, callbacks, FALSE, TRUE);
            assert!(!c.is_null());
            c
        }
    }

    /// Brings a new instance to its first communication point.
    pub(crate) fn begin(&self, c: Component) {
        // SAFETY: any handle may be passed.
        unsafe {
            assert_eq!((self.setup)(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
            assert_eq!((self.enter)(c), Status::Ok);
            assert_eq!((self.exit)(c), Status::Ok);
        }
    }
}

type Ignore = unsafe extern "C" fn(ComponentEnvironment, FmiString, Status, FmiString, FmiString);

const TEXT: &str = include_str!("../../scenes/er16k-tb1.toml");

/// An unpacked scene, deleted when dropped.
pub(crate) struct Scene {
    directory: PathBuf,
    guid: CString,
    location: CString,
}

impl Scene {
    /// With the law that needs no contact map.
    pub(crate) fn new(name: &str) -> Self {
        Self::of(name, &TEXT.replace("law = \"map\"", "law = \"hertz\""), None)
    }

    /// As it is shipped, with its contact map.
    pub(crate) fn with_map(name: &str, map: &[u8]) -> Self {
        Self::of(name, TEXT, Some(map))
    }

    fn of(name: &str, text: &str, map: Option<&[u8]>) -> Self {
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        fs::write(directory.join("scene.toml"), text).unwrap();
        let model = model_file::encode(&brinell_scene_file::from_toml(text).unwrap(), text).unwrap();
        fs::write(directory.join("model.bin"), model).unwrap();
        if let Some(map) = map {
            fs::write(directory.join("map.bin"), map).unwrap();
        }
        let location = CString::new(format!("file://{}", directory.to_str().unwrap())).unwrap();
        Self { directory, guid: CString::new(guid(text, None)).unwrap(), location }
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.directory);
    }
}
