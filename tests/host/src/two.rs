//! FMI 2.0.

use crate::library::{HostError, Log, State, fault, functions, keep, last_line, loaded, text};
use libloading::Library;
use std::ffi::{CString, c_char, c_int, c_void};
use std::fmt::Write;
use std::path::Path;
use std::ptr;

type Component = *mut c_void;

functions! {
    instantiate = "fmi2Instantiate": (
        *const c_char, c_int, *const c_char, *const c_char, *const Callbacks, c_int, c_int
    ) -> Component;
    free = "fmi2FreeInstance": (Component);
    setup = "fmi2SetupExperiment": (Component, c_int, f64, f64, c_int, f64) -> c_int;
    enter = "fmi2EnterInitializationMode": (Component) -> c_int;
    exit = "fmi2ExitInitializationMode": (Component) -> c_int;
    get = "fmi2GetReal": (Component, *const u32, usize, *mut f64) -> c_int;
    set = "fmi2SetReal": (Component, *const u32, usize, *const f64) -> c_int;
    step = "fmi2DoStep": (Component, f64, f64, c_int) -> c_int;
    save = "fmi2GetFMUstate": (Component, *mut *mut c_void) -> c_int;
    restore = "fmi2SetFMUstate": (Component, *mut c_void) -> c_int;
    terminate = "fmi2Terminate": (Component) -> c_int;
}

#[repr(C)]
#[derive(Debug)]
struct Callbacks {
    logger: unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, *const c_char),
    allocate: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    free: Option<unsafe extern "C" fn(*mut c_void)>,
    step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    environment: *mut c_void,
}

/// One instance of a co-simulation FMU.
#[derive(Debug)]
pub struct Instance {
    // Fields drop in this order; the instance is freed in `drop`, before any of them.
    component: Component,
    functions: Functions,
    /// Holds the functions.
    _library: Library,
    /// The instance calls them.
    _callbacks: Box<Callbacks>,
    log: Box<Log>,
}

impl Instance {
    /// Loads the library and makes an instance. `resources` is the unpacked folder of that name.
    pub fn new(path: &Path, instance: &str, guid: &str, resources: &Path) -> Result<Self, HostError> {
        Self::with_uri(path, instance, guid, &file_uri(resources))
    }

    /// The same with the folder as a URI, written as the caller likes.
    pub fn with_uri(path: &Path, instance: &str, guid: &str, uri: &str) -> Result<Self, HostError> {
        let library = loaded(path)?;
        let functions = Functions::of(&library)?;
        let log: Box<Log> = Box::default();
        let callbacks = Box::new(Callbacks {
            logger: note,
            allocate: Some(libc::calloc),
            free: Some(libc::free),
            step_finished: None,
            environment: ptr::from_ref(&*log).cast_mut().cast(),
        });
        let (instance, guid, uri) = (CString::new(instance)?, CString::new(guid)?, CString::new(uri)?);
        // SAFETY: the strings live through the call, the callbacks as long as the instance.
        let component = unsafe {
            (functions.instantiate)(instance.as_ptr(), 1, guid.as_ptr(), uri.as_ptr(), &raw const *callbacks, 0, 1)
        };
        if component.is_null() {
            return Err(HostError::NoInstance { function: "fmi2Instantiate", log: last_line(&log) });
        }
        Ok(Self { component, functions, _library: library, _callbacks: callbacks, log })
    }

    /// `fmi2SetupExperiment` with start time 0, a tolerance if there is one and no stop time; then into and out of
    /// initialization.
    pub fn initialize(&mut self, tolerance: Option<f64>) -> Result<(), HostError> {
        let (c, f) = (self.component, self.functions);
        let defined = c_int::from(tolerance.is_some());
        // SAFETY of these calls and those below: the component is a living instance; pointers among the arguments
        // point to as many values as are passed along.
        unsafe {
            self.answer("fmi2SetupExperiment", (f.setup)(c, defined, tolerance.unwrap_or(0.0), 0.0, 0, 0.0))?;
            self.answer("fmi2EnterInitializationMode", (f.enter)(c))?;
            self.answer("fmi2ExitInitializationMode", (f.exit)(c))
        }
    }

    /// `fmi2GetReal`.
    pub fn reals(&mut self, references: &[u32]) -> Result<Vec<f64>, HostError> {
        let mut values = vec![f64::NAN; references.len()];
        self.reals_into(references, &mut values)?;
        Ok(values)
    }

    /// The same into as many places.
    pub fn reals_into(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), HostError> {
        assert_eq!(references.len(), values.len(), "one value for each reference");
        let (of, count) = (references.as_ptr(), references.len());
        // SAFETY: see `initialize`.
        self.answer("fmi2GetReal", unsafe { (self.functions.get)(self.component, of, count, values.as_mut_ptr()) })
    }

    /// `fmi2SetReal`.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), HostError> {
        assert_eq!(references.len(), values.len(), "one value for each reference");
        let (of, count) = (references.as_ptr(), references.len());
        // SAFETY: see `initialize`.
        self.answer("fmi2SetReal", unsafe { (self.functions.set)(self.component, of, count, values.as_ptr()) })
    }

    /// `fmi2DoStep`.
    pub fn step(&mut self, from: f64, step: f64) -> Result<(), HostError> {
        // SAFETY: see `initialize`.
        self.answer("fmi2DoStep", unsafe { (self.functions.step)(self.component, from, step, 0) })
    }

    /// `fmi2DoStep` of no instance at all: what a call costs that is refused.
    pub fn step_of_none(&self) -> bool {
        // SAFETY: the library refuses a null handle.
        fault(unsafe { (self.functions.step)(ptr::null_mut(), 0.0, 1e-9, 0) }).is_none()
    }

    /// `fmi2GetFMUstate`, over an earlier state if there is one. It lives as long as the instance.
    pub fn save(&mut self, over: Option<State>) -> Result<State, HostError> {
        let mut state = over.map_or(ptr::null_mut(), |state| state.0);
        // SAFETY: see `initialize`; the state is null or one of the instance.
        self.answer("fmi2GetFMUstate", unsafe { (self.functions.save)(self.component, &raw mut state) })?;
        Ok(State(state))
    }

    /// `fmi2SetFMUstate`.
    pub fn restore(&mut self, state: State) -> Result<(), HostError> {
        // SAFETY: see `initialize`.
        self.answer("fmi2SetFMUstate", unsafe { (self.functions.restore)(self.component, state.0) })
    }

    /// `fmi2Terminate`.
    pub fn terminate(&mut self) -> Result<(), HostError> {
        // SAFETY: see `initialize`.
        self.answer("fmi2Terminate", unsafe { (self.functions.terminate)(self.component) })
    }

    fn answer(&self, function: &'static str, status: c_int) -> Result<(), HostError> {
        let fail = |status| Err(HostError::Status { function, status, log: last_line(&self.log) });
        fault(status).map_or(Ok(()), fail)
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: the instance lives and is not used after this.
        unsafe { (self.functions.free)(self.component) };
    }
}

/// The host's logger. The standard's is variadic, which stable Rust cannot define; on the platforms named below the
/// first variadic argument is passed where a sixth named one is, so `"%s"` with its text can be read.
unsafe extern "C" fn note(
    environment: *mut c_void,
    _instance: *const c_char,
    _status: c_int,
    category: *const c_char,
    message: *const c_char,
    first: *const c_char,
) {
    let variadic_like_named = cfg!(not(all(target_os = "macos", target_arch = "aarch64")));
    // SAFETY: the standard passes zero-terminated strings; this host passed its own log, which outlives the instance.
    unsafe {
        let mut line = text(message);
        if line == "%s" && variadic_like_named {
            line = text(first);
        }
        keep(environment, category, &line);
    }
}

/// The folder as a URI: percent-encoded, so that spaces and other alphabets survive.
fn file_uri(folder: &Path) -> String {
    let path = folder.to_string_lossy().replace('\\', "/");
    let mut uri = String::from(if path.starts_with('/') { "file://" } else { "file:///" });
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' | b':' => uri.push(byte as char),
            _ => {
                // Writing to a String cannot fail.
                let _ = write!(uri, "%{byte:02X}");
            }
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_with_spaces_and_umlauts_becomes_a_plain_uri() {
        assert_eq!(file_uri(Path::new("/a b/Wälz+lager")), "file:///a%20b/W%C3%A4lz%2Blager");
    }
}
