//! FMI 3.0.

use crate::library::{HostError, Log, State, fault, functions, keep, last_line, loaded, text};
use libloading::Library;
use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;

type Handle = *mut c_void;
type LogMessage = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);
type IntermediateUpdate = unsafe extern "C" fn(*mut c_void, f64, u8, u8, u8, u8, *mut u8, *mut f64);

functions! {
    instantiate = "fmi3InstantiateCoSimulation": (
        *const c_char, *const c_char, *const c_char, u8, u8, u8, u8, *const u32, usize, *mut c_void,
        Option<LogMessage>, Option<IntermediateUpdate>
    ) -> Handle;
    free = "fmi3FreeInstance": (Handle);
    enter = "fmi3EnterInitializationMode": (Handle, u8, f64, f64, u8, f64) -> c_int;
    exit = "fmi3ExitInitializationMode": (Handle) -> c_int;
    get = "fmi3GetFloat64": (Handle, *const u32, usize, *mut f64, usize) -> c_int;
    set = "fmi3SetFloat64": (Handle, *const u32, usize, *const f64, usize) -> c_int;
    step = "fmi3DoStep": (Handle, f64, f64, u8, *mut u8, *mut u8, *mut u8, *mut f64) -> c_int;
    save = "fmi3GetFMUState": (Handle, *mut *mut c_void) -> c_int;
    restore = "fmi3SetFMUState": (Handle, *mut c_void) -> c_int;
}

/// One instance of a co-simulation FMU.
#[derive(Debug)]
pub struct Instance {
    handle: Handle,
    functions: Functions,
    /// Holds the functions.
    _library: Library,
    log: Box<Log>,
}

unsafe extern "C" fn note(environment: *mut c_void, _: c_int, category: *const c_char, message: *const c_char) {
    // SAFETY: the standard passes zero-terminated strings; this host passed its own log, which outlives the instance.
    unsafe { keep(environment, category, &text(message)) };
}

/// A host that is told of every integration step and does nothing.
unsafe extern "C" fn watch(_: *mut c_void, _: f64, _: u8, _: u8, _: u8, _: u8, _: *mut u8, _: *mut f64) {}

impl Instance {
    /// Loads the library and makes an instance at its first communication point, at 0 s. `resources` is the unpacked
    /// folder of that name; one that is `watched` calls back after each integration step.
    pub fn start(path: &Path, token: &str, resources: &Path, watched: bool) -> Result<Self, HostError> {
        let library = loaded(path)?;
        let functions = Functions::of(&library)?;
        let log: Box<Log> = Box::default();
        let (token, folder) = (CString::new(token)?, CString::new(format!("{}/", resources.display()))?);
        let update = watched.then_some(watch as IntermediateUpdate);
        // SAFETY: the strings live through the call, the log as long as the instance.
        let handle = unsafe {
            let environment = ptr::from_ref(&*log).cast_mut().cast();
            let (name, nothing) = (c"host".as_ptr(), ptr::null());
            let (token, folder) = (token.as_ptr(), folder.as_ptr());
            (functions.instantiate)(name, token, folder, 0, 0, 0, 1, nothing, 0, environment, Some(note), update)
        };
        if handle.is_null() {
            return Err(HostError::NoInstance { function: "fmi3InstantiateCoSimulation", log: last_line(&log) });
        }
        let made = Self { handle, functions, _library: library, log };
        // SAFETY of these calls and those below: the handle is a living instance; pointers among the arguments point
        // to as many values as are passed along.
        unsafe {
            made.answer("fmi3EnterInitializationMode", (functions.enter)(handle, 0, 0.0, 0.0, 0, 0.0))?;
            made.answer("fmi3ExitInitializationMode", (functions.exit)(handle))?;
        }
        Ok(made)
    }

    /// `fmi3GetFloat64`. An array has one reference and several values.
    pub fn floats_into(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), HostError> {
        let (of, count) = (references.as_ptr(), references.len());
        let (into, places) = (values.as_mut_ptr(), values.len());
        // SAFETY: see `start`.
        self.answer("fmi3GetFloat64", unsafe { (self.functions.get)(self.handle, of, count, into, places) })
    }

    /// `fmi3SetFloat64`.
    pub fn set_floats(&mut self, references: &[u32], values: &[f64]) -> Result<(), HostError> {
        let (of, count) = (references.as_ptr(), references.len());
        let (from, places) = (values.as_ptr(), values.len());
        // SAFETY: see `start`.
        self.answer("fmi3SetFloat64", unsafe { (self.functions.set)(self.handle, of, count, from, places) })
    }

    /// `fmi3DoStep`.
    pub fn step(&mut self, from: f64, step: f64) -> Result<(), HostError> {
        let (mut flags, mut reached) = ([0u8; 3], 0.0);
        let [event, end, early] = std::array::from_fn(|i| flags.as_mut_ptr().wrapping_add(i));
        let reached = &raw mut reached;
        // SAFETY: see `start`; each pointer is to a value of its own.
        let status = unsafe { (self.functions.step)(self.handle, from, step, 1, event, end, early, reached) };
        self.answer("fmi3DoStep", status)
    }

    /// `fmi3GetFMUState`. It lives as long as the instance.
    pub fn save(&mut self) -> Result<State, HostError> {
        let mut state = ptr::null_mut();
        // SAFETY: see `start`.
        self.answer("fmi3GetFMUState", unsafe { (self.functions.save)(self.handle, &raw mut state) })?;
        Ok(State(state))
    }

    /// `fmi3SetFMUState`.
    pub fn restore(&mut self, state: State) -> Result<(), HostError> {
        // SAFETY: see `start`; the state is one of the instance.
        self.answer("fmi3SetFMUState", unsafe { (self.functions.restore)(self.handle, state.0) })
    }

    fn answer(&self, function: &'static str, status: c_int) -> Result<(), HostError> {
        let fail = |status| Err(HostError::Status { function, status, log: last_line(&self.log) });
        fault(status).map_or(Ok(()), fail)
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: the instance lives and is not used after this.
        unsafe { (self.functions.free)(self.handle) };
    }
}
