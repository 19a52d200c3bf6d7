//! A host: unpacked resources, a logger that remembers, and the exported functions as methods.
//!
//! The standard's logger takes variable arguments, which stable Rust cannot define. The logger here takes the six
//! arguments that Brinell passes. On the platforms that the tests run on (System V x86-64, AArch64 Linux, Windows
//! x64) variable arguments arrive where fixed ones do, so this is harmless; on Apple's AArch64 it is not.

#[path = "../any_host.rs"]
pub(crate) mod any_host;

pub(crate) use any_host::Line;
use any_host::{Functions, Of, Version, is_real};
use brinell::simulation::Simulation;
use brinell_fmi::fmi2::*;
pub(crate) use brinell_tests::resources::Resources;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_void};
use std::ptr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

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

impl<'a> Call<'a> {
    /// One for co-simulation that nothing is wrong with.
    pub(crate) fn good(name: &'a str, guid: &'a str, location: &'a str) -> Self {
        Self {
            name: Some(name),
            fmu_type: CO_SIMULATION,
            guid: Some(guid),
            location: Some(location),
            logger: Some(logger()),
            logging: false,
        }
    }

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

/// FMI 2.0.
pub(crate) struct Two;

/// An instance and its host.
pub(crate) type Host = any_host::Host<Two>;

impl Version for Two {
    type Log = Log;
    type Byte = Byte;
    const FUNCTIONS: Functions<Byte> = Functions {
        free: fmi2FreeInstance,
        exit: fmi2ExitInitializationMode,
        terminate: fmi2Terminate,
        reset: fmi2Reset,
        get_state: fmi2GetFMUstate,
        set_state: fmi2SetFMUstate,
        free_state: fmi2FreeFMUstate,
        state_size: fmi2SerializedFMUstateSize,
        serialize: fmi2SerializeFMUstate,
        deserialize: fmi2DeSerializeFMUstate,
    };

    fn lines(log: &Log) -> Vec<Line> {
        log.take()
    }

    fn make(resources: Arc<Resources>, name: &str, logging: bool) -> (Component, Box<Log>) {
        let location = resources.uri();
        Call { logging, ..Call::good(name, &resources.guid, &location) }.make()
    }

    fn begin(host: &Host, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        let status = host.setup(tolerance, start, stop);
        if status == Status::Ok { host.enter() } else { status }
    }

    fn step(host: &Host, point: f64, size: f64) -> Status {
        host.step(point, size)
    }

    fn get(c: Component, references: &[u32], values: &mut [f64]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: the arrays are as long as said.
        unsafe { fmi2GetReal(c, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }

    fn set(c: Component, references: &[u32], values: &[f64]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: the arrays are as long as said.
        unsafe { fmi2SetReal(c, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    fn reals(simulation: &Simulation) -> (Vec<u32>, usize) {
        let real = simulation.table().iter().filter(|variable| is_real(variable));
        let list: Vec<u32> = real.map(|variable| variable.reference).collect();
        let count = list.len();
        (list, count)
    }

    fn reference(simulation: &Simulation, name: &str) -> u32 {
        simulation.reference(name).unwrap()
    }
}

impl Host {
    pub(crate) fn setup(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        let flag = |value: Option<f64>| Boolean::from(value.is_some());
        let (tolerance_given, stop_given) = (flag(tolerance), flag(stop));
        let (tolerance, stop) = (tolerance.unwrap_or(f64::NAN), stop.unwrap_or(f64::NAN));
        // SAFETY of this and those below: any handle may be passed; pointers are to as much as is said.
        unsafe { fmi2SetupExperiment(self.c, tolerance_given, tolerance, start, stop_given, stop) }
    }

    pub(crate) fn enter(&self) -> Status {
        unsafe { fmi2EnterInitializationMode(self.c) }
    }

    pub(crate) fn step(&self, point: f64, size: f64) -> Status {
        unsafe { fmi2DoStep(self.c, point, size, TRUE) }
    }

    /// The communication point that the last step led to (s).
    pub(crate) fn last_time(&self) -> f64 {
        let mut time = f64::NAN;
        unsafe { fmi2GetRealStatus(self.c, LAST_SUCCESSFUL_TIME, &raw mut time) };
        time
    }

    pub(crate) fn get_integers(&self, references: &[u32]) -> Result<Vec<i32>, Status> {
        let mut values = vec![0; references.len()];
        unsafe { fmi2GetInteger(self.c, references.as_ptr(), references.len(), values.as_mut_ptr()) }.of(values)
    }

    pub(crate) fn set_integers(&self, references: &[u32], values: &[i32]) -> Status {
        assert_eq!(references.len(), values.len());
        unsafe { fmi2SetInteger(self.c, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    pub(crate) fn set_text(&self, reference: u32, value: &str) -> Status {
        let value = CString::new(value).unwrap();
        let pointer = value.as_ptr();
        unsafe { fmi2SetString(self.c, &raw const reference, 1, &raw const pointer) }
    }

    /// References of all real variables.
    pub(crate) fn reals(&self) -> Vec<u32> {
        Two::reals(self.simulation()).0
    }

    /// Derivatives of unknowns by knowns, times a seed.
    pub(crate) fn directional(&self, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Result<Vec<f64>, Status> {
        let mut values = vec![f64::NAN; unknowns.len()];
        let (of, by, into) = (unknowns.as_ptr(), knowns.as_ptr(), values.as_mut_ptr());
        let (rows, columns) = (unknowns.len(), knowns.len());
        unsafe { fmi2GetDirectionalDerivative(self.c, of, rows, by, columns, seed.as_ptr(), into) }.of(values)
    }

    /// Derivatives of outputs by time.
    pub(crate) fn by_time(&self, unknowns: &[u32], order: i32) -> Result<Vec<f64>, Status> {
        let (orders, mut values) = (vec![order; unknowns.len()], vec![f64::NAN; unknowns.len()]);
        let (of, into) = (unknowns.as_ptr(), values.as_mut_ptr());
        unsafe { fmi2GetRealOutputDerivatives(self.c, of, unknowns.len(), orders.as_ptr(), into) }.of(values)
    }

    /// Gives an input a derivative by time.
    pub(crate) fn rate(&self, reference: u32, order: i32, value: f64) -> Status {
        unsafe { fmi2SetRealInputDerivatives(self.c, &raw const reference, 1, &raw const order, &raw const value) }
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
