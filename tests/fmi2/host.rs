//! A host: unpacked resources, a logger that remembers, and the exported functions as methods.
//!
//! The standard's logger takes variable arguments, which stable Rust cannot define. The logger here takes the six
//! arguments that Brinell passes. On the platforms that the tests run on (System V x86-64, AArch64 Linux, Windows
//! x64) variable arguments arrive where fixed ones do, so this is harmless; on Apple's AArch64 it is not.

use brinell_fmi::fmi2::*;
pub(crate) use brinell_tests::resources::Resources;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_void};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::{fs, ptr};

/// One call of the logger.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    pub(crate) instance: String,
    pub(crate) status: Status,
    pub(crate) category: String,
    pub(crate) format: String,
    pub(crate) message: String,
}

/// Where the logger keeps its lines: the component environment points here.
#[derive(Default)]
pub(crate) struct Log {
    lines: RefCell<Vec<Line>>,
    /// An instance that the logger calls back into.
    pub(crate) meddle_with: RefCell<Option<(Component, Option<Status>)>>,
}

type FixedLogger = unsafe extern "C" fn(ComponentEnvironment, FmiString, Status, FmiString, FmiString, FmiString);

unsafe extern "C" fn remember(
    environment: ComponentEnvironment,
    instance: FmiString,
    status: Status,
    category: FmiString,
    format: FmiString,
    message: FmiString,
) {
    // SAFETY: the environment is the `Log` of a living `Host`; Brinell passes strings that end in NUL, or this test
    // fails.
    let (log, texts) = unsafe {
        let text = |pointer| CStr::from_ptr(pointer).to_str().unwrap().to_owned();
        (&*environment.cast::<Log>(), [instance, category, format, message].map(text))
    };
    let [instance, category, format, message] = texts;
    log.lines.borrow_mut().push(Line { instance, status, category, format, message });
    let meddle_with = log.meddle_with.borrow().map(|(component, _)| component);
    if let Some(component) = meddle_with {
        // SAFETY: any handle may be passed.
        let status = unsafe {
            fmi2FreeInstance(component);
            fmi2Reset(component)
        };
        *log.meddle_with.borrow_mut() = Some((component, Some(status)));
    }
}

/// The logger as the C interface wants it.
pub(crate) fn logger() -> LoggerCallback {
    // SAFETY: see the head of this file.
    unsafe { std::mem::transmute::<FixedLogger, LoggerCallback>(remember) }
}

/// How often a callback was called that must not be.
pub(crate) static FORBIDDEN_CALLS: AtomicU32 = AtomicU32::new(0);

unsafe extern "C" fn allocate(_: usize, _: usize) -> *mut c_void {
    FORBIDDEN_CALLS.fetch_add(1, Ordering::Relaxed);
    ptr::null_mut()
}

unsafe extern "C" fn release(_: *mut c_void) {
    FORBIDDEN_CALLS.fetch_add(1, Ordering::Relaxed);
}

unsafe extern "C" fn finished(_: ComponentEnvironment, _: Status) {
    FORBIDDEN_CALLS.fetch_add(1, Ordering::Relaxed);
}

/// What a host passes to `fmi2Instantiate`; `None` stands for NULL.
pub(crate) struct Call<'a> {
    pub(crate) name: Option<&'a str>,
    pub(crate) fmu_type: FmuType,
    pub(crate) guid: Option<&'a str>,
    pub(crate) location: Option<&'a str>,
    pub(crate) logger: Option<LoggerCallback>,
    pub(crate) logging: bool,
}

impl Call<'_> {
    /// Calls `fmi2Instantiate` and tells what the logger got.
    pub(crate) fn make(&self) -> (Component, Box<Log>) {
        let log = Box::<Log>::default();
        let callbacks = CallbackFunctions {
            logger: self.logger,
            allocate_memory: Some(allocate),
            free_memory: Some(release),
            step_finished: Some(finished),
            component_environment: ptr::from_ref(&*log).cast_mut().cast::<c_void>(),
        };
        let texts = [self.name, self.guid, self.location].map(|text| text.map(|text| CString::new(text).unwrap()));
        let [name, guid, location] =
            texts.each_ref().map(|text| text.as_ref().map_or(ptr::null(), |text| text.as_ptr()));
        // SAFETY: strings end in NUL; the callbacks live through the call, the log as long as the instance.
        let component = unsafe {
            fmi2Instantiate(name, self.fmu_type, guid, location, &raw const callbacks, FALSE, self.logging.into())
        };
        (component, log)
    }
}

/// An instance and its host.
pub(crate) struct Host {
    pub(crate) c: Component,
    pub(crate) log: Box<Log>,
    pub(crate) resources: Arc<Resources>,
}

impl Host {
    /// An instance of a shipped scene, logging on.
    pub(crate) fn of(scene: &str) -> Self {
        Self::named(scene, "instance 1")
    }

    /// The same with a name.
    pub(crate) fn named(scene: &str, name: &str) -> Self {
        Self::with(Resources::of(scene), name, true)
    }

    /// An instance of given resources, which others may share.
    pub(crate) fn with(resources: impl Into<Arc<Resources>>, name: &str, logging: bool) -> Self {
        let resources = resources.into();
        let (guid, location) = (resources.guid.clone(), resources.uri());
        let call = Call {
            name: Some(name),
            fmu_type: CO_SIMULATION,
            guid: Some(&guid),
            location: Some(&location),
            logger: Some(logger()),
            logging,
        };
        let (c, log) = call.make();
        assert!(!c.is_null(), "{:?}", log.lines.borrow());
        Self { c, log, resources }
    }

    /// An instance at its first communication point.
    pub(crate) fn started(scene: &str) -> Self {
        let host = Self::of(scene);
        host.start();
        host
    }

    /// From instantiated to the first communication point at 0 s.
    pub(crate) fn start(&self) {
        assert_eq!(self.setup(None, 0.0, None), Status::Ok, "{:?}", self.lines());
        assert_eq!(self.enter(), Status::Ok, "{:?}", self.lines());
        assert_eq!(self.exit(), Status::Ok, "{:?}", self.lines());
    }

    /// The lines logged since the last call.
    pub(crate) fn lines(&self) -> Vec<Line> {
        self.log.take()
    }

    pub(crate) fn setup(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        let flag = |value: Option<f64>| Boolean::from(value.is_some());
        let (tolerance_given, stop_given) = (flag(tolerance), flag(stop));
        let (tolerance, stop) = (tolerance.unwrap_or(f64::NAN), stop.unwrap_or(f64::NAN));
        // SAFETY: no pointers but the handle.
        unsafe { fmi2SetupExperiment(self.c, tolerance_given, tolerance, start, stop_given, stop) }
    }

    pub(crate) fn enter(&self) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi2EnterInitializationMode(self.c) }
    }

    pub(crate) fn exit(&self) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi2ExitInitializationMode(self.c) }
    }

    pub(crate) fn terminate(&self) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi2Terminate(self.c) }
    }

    pub(crate) fn reset(&self) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi2Reset(self.c) }
    }

    pub(crate) fn step(&self, point: f64, size: f64) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi2DoStep(self.c, point, size, TRUE) }
    }

    /// The communication point that the last step led to (s).
    pub(crate) fn last_time(&self) -> f64 {
        let mut time = f64::NAN;
        // SAFETY: any handle may be passed; `time` may be written.
        unsafe { fmi2GetRealStatus(self.c, LAST_SUCCESSFUL_TIME, &raw mut time) };
        time
    }

    pub(crate) fn get(&self, references: &[u32]) -> Result<Vec<f64>, Status> {
        let mut values = vec![f64::NAN; references.len()];
        // SAFETY: the arrays are as long as said.
        match unsafe { fmi2GetReal(self.c, references.as_ptr(), references.len(), values.as_mut_ptr()) } {
            Status::Ok => Ok(values),
            status => Err(status),
        }
    }

    pub(crate) fn set(&self, references: &[u32], values: &[f64]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: the arrays are as long as said.
        unsafe { fmi2SetReal(self.c, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    pub(crate) fn get_integers(&self, references: &[u32]) -> Result<Vec<i32>, Status> {
        let mut values = vec![0; references.len()];
        // SAFETY: the arrays are as long as said.
        match unsafe { fmi2GetInteger(self.c, references.as_ptr(), references.len(), values.as_mut_ptr()) } {
            Status::Ok => Ok(values),
            status => Err(status),
        }
    }

    pub(crate) fn set_integers(&self, references: &[u32], values: &[i32]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: the arrays are as long as said.
        unsafe { fmi2SetInteger(self.c, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    pub(crate) fn set_text(&self, reference: u32, value: &str) -> Status {
        let value = CString::new(value).unwrap();
        let pointer = value.as_ptr();
        // SAFETY: one reference and one string that ends in NUL.
        unsafe { fmi2SetString(self.c, &raw const reference, 1, &raw const pointer) }
    }

    pub(crate) fn save(&self) -> FmuState {
        let mut state = ptr::null_mut();
        // SAFETY: `state` is NULL, as the first call wants it.
        assert_eq!(unsafe { fmi2GetFMUstate(self.c, &raw mut state) }, Status::Ok, "{:?}", self.lines());
        state
    }

    pub(crate) fn restore(&self, state: FmuState) -> Status {
        // SAFETY: any handle may be passed.
        unsafe { fmi2SetFMUstate(self.c, state) }
    }

    pub(crate) fn free(&self, mut state: FmuState) -> Status {
        // SAFETY: any handle may be passed.
        unsafe { fmi2FreeFMUstate(self.c, &raw mut state) }
    }

    pub(crate) fn serialize(&self, state: FmuState) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: `size` may be written.
        assert_eq!(unsafe { fmi2SerializedFMUstateSize(self.c, state, &raw mut size) }, Status::Ok);
        let mut bytes = vec![0u8; size];
        // SAFETY: the buffer has the size said.
        let status = unsafe { fmi2SerializeFMUstate(self.c, state, bytes.as_mut_ptr().cast(), size) };
        assert_eq!(status, Status::Ok, "{:?}", self.lines());
        bytes
    }

    pub(crate) fn deserialize(&self, bytes: &[u8]) -> Result<FmuState, Status> {
        let mut state = ptr::null_mut();
        // SAFETY: the bytes are as many as said, `state` is NULL.
        match unsafe { fmi2DeSerializeFMUstate(self.c, bytes.as_ptr().cast(), bytes.len(), &raw mut state) } {
            Status::Ok => Ok(state),
            status => Err(status),
        }
    }

    /// The value reference of a variable.
    pub(crate) fn reference(&self, name: &str) -> u32 {
        self.table().iter().find(|variable| variable.name == name).unwrap_or_else(|| panic!("{name}")).reference
    }

    /// The variable table, as the model description would tell it.
    pub(crate) fn table(&self) -> Vec<brinell::simulation::interface::table::Variable> {
        self.simulation().table().to_vec()
    }

    /// The model behind the interface, set up once more.
    pub(crate) fn simulation(&self) -> brinell::simulation::Simulation {
        let text = fs::read_to_string(self.resources.directory.join("scene.toml")).unwrap();
        let scene = brinell_scene_file::from_toml(&text).unwrap();
        let read = |file: &str| fs::read_to_string(self.resources.directory.join(file)).unwrap();
        let profiles: Vec<String> = scene.profile_names().into_iter().map(read).collect();
        brinell::simulation::Simulation::new(scene, profiles.iter().map(String::as_str)).unwrap()
    }

    /// References of all real variables.
    pub(crate) fn reals(&self) -> Vec<u32> {
        use brinell::simulation::interface::table::Kind;
        let real =
            |variable: &&brinell::simulation::interface::table::Variable| matches!(variable.kind, Kind::Real { .. });
        self.table().iter().filter(real).map(|variable| variable.reference).collect()
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: any handle may be passed, also one that a test has freed.
        unsafe { fmi2FreeInstance(self.c) };
    }
}

impl Log {
    /// The lines logged since the last call.
    pub(crate) fn take(&self) -> Vec<Line> {
        self.lines.take()
    }
}

/// The bits of values, for comparisons that forgive nothing.
pub(crate) fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}
