//! A small FMI 2.0 host: just enough to step an FMU's library through its C interface where no other host runs, under
//! Wine, QEMU and Valgrind.
//!
//! It trusts the library to follow the standard's binary interface; that is what loading a library means.

#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fmt::Write;
use std::path::Path;
use std::ptr;
use std::sync::Mutex;

use libloading::{Library, Symbol};

/// All functions of a co-simulation library.
pub const FUNCTIONS: [&str; 34] = [
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2SetDebugLogging",
    "fmi2Instantiate",
    "fmi2FreeInstance",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2Terminate",
    "fmi2Reset",
    "fmi2GetReal",
    "fmi2GetInteger",
    "fmi2GetBoolean",
    "fmi2GetString",
    "fmi2SetReal",
    "fmi2SetInteger",
    "fmi2SetBoolean",
    "fmi2SetString",
    "fmi2GetFMUstate",
    "fmi2SetFMUstate",
    "fmi2FreeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SerializeFMUstate",
    "fmi2DeSerializeFMUstate",
    "fmi2GetDirectionalDerivative",
    "fmi2SetRealInputDerivatives",
    "fmi2GetRealOutputDerivatives",
    "fmi2DoStep",
    "fmi2CancelStep",
    "fmi2GetStatus",
    "fmi2GetRealStatus",
    "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus",
    "fmi2GetStringStatus",
];

/// Why an FMU's library did not do what it was asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// The file is no library, or lacks something.
    #[error("library")]
    Library(#[from] libloading::Error),
    /// A name with a zero byte.
    #[error("a name for the C interface")]
    ZeroByte(#[from] std::ffi::NulError),
    /// No instance was made.
    #[error("{function} gave NULL; log: {log}")]
    NoInstance {
        /// The function.
        function: &'static str,
        /// The last line of the log.
        log: String,
    },
    /// A function answered neither OK nor Warning.
    #[error("{function} answered {status}; log: {log}")]
    Status {
        /// The function.
        function: &'static str,
        /// The standard's name of the status.
        status: &'static str,
        /// The last line of the log.
        log: String,
    },
}

type Component = *mut c_void;
type Log = Mutex<Vec<String>>;

#[repr(C)]
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
    library: Library,
    callbacks: Box<Callbacks>,
    log: Box<Log>,
}

impl std::fmt::Debug for Callbacks {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Callbacks")
    }
}

/// Takes the symbol and calls it. The signature stands beside each use, next to the standard's name.
macro_rules! call {
    ($host:expr, $function:literal, ($($kind:ty),*), ($($value:expr),*)) => {{
        // SAFETY: the symbol has the standard's signature, written here; pointers among the arguments point to
        // live slices of the lengths passed along, and the component is a living instance of this library.
        let status = unsafe {
            let function: Symbol<'_, unsafe extern "C" fn($($kind),*) -> c_int> = $host.library.get($function)?;
            function($($value),*)
        };
        $host.answer($function, status)
    }};
}

/// Loads a library that has all of these functions.
fn loaded(path: &Path, functions: &[&str]) -> Result<Library, HostError> {
    // SAFETY: the user asked for this library to be run; its initialisers are his trust.
    let library = unsafe { Library::new(path)? };
    for function in functions {
        // SAFETY: the symbol is looked up, not used.
        unsafe { library.get::<unsafe extern "C" fn()>(*function) }?;
    }
    Ok(library)
}

/// # Safety
/// The pointer is null or to a zero-terminated string.
unsafe fn text(pointer: *const c_char) -> String {
    if pointer.is_null() {
        return String::from("NULL");
    }
    // SAFETY: not null; the rest is the contract.
    unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned()
}

/// Adds a line to the log.
///
/// # Safety
/// `environment` points to a living [`Log`]; `category` is null or a zero-terminated string.
unsafe fn keep(environment: *mut c_void, category: *const c_char, line: &str) {
    // SAFETY: this function's contract.
    let (log, category) = unsafe { (&*environment.cast::<Log>(), text(category)) };
    if let Ok(mut log) = log.lock() {
        log.push(format!("{category}: {line}"));
    }
}

impl Instance {
    /// Loads the library and makes an instance. `resources` is the unpacked folder of that name.
    pub fn new(path: &Path, instance: &str, guid: &str, resources: &Path) -> Result<Self, HostError> {
        Self::with_uri(path, instance, guid, &file_uri(resources))
    }

    /// The same with the folder as a URI, written as the caller likes.
    pub fn with_uri(path: &Path, instance: &str, guid: &str, uri: &str) -> Result<Self, HostError> {
        let library = loaded(path, &FUNCTIONS)?;
        let log: Box<Log> = Box::default();
        let callbacks = Box::new(Callbacks {
            logger: note,
            allocate: Some(libc::calloc),
            free: Some(libc::free),
            step_finished: None,
            environment: ptr::from_ref(&*log).cast_mut().cast(),
        });
        let mut made = Self { component: ptr::null_mut(), library, callbacks, log };
        let (instance, guid, uri) = (CString::new(instance)?, CString::new(guid)?, CString::new(uri)?);
        type Instantiate = unsafe extern "C" fn(
            *const c_char,
            c_int,
            *const c_char,
            *const c_char,
            *const Callbacks,
            c_int,
            c_int,
        ) -> Component;
        // SAFETY: standard's signature; the strings live through the call, the callbacks as long as the instance.
        made.component = unsafe {
            let instantiate: Symbol<'_, Instantiate> = made.library.get("fmi2Instantiate")?;
            instantiate(instance.as_ptr(), 1, guid.as_ptr(), uri.as_ptr(), &*made.callbacks, 0, 1)
        };
        if made.component.is_null() {
            let log = made.last_line();
            return Err(HostError::NoInstance { function: "fmi2Instantiate", log });
        }
        Ok(made)
    }

    /// `fmi2SetupExperiment` with start time 0, a tolerance if there is one and no stop time; then into and out of
    /// initialization.
    pub fn initialize(&mut self, tolerance: Option<f64>) -> Result<(), HostError> {
        let c = self.component;
        let (tolerance_defined, stop_defined) = (c_int::from(tolerance.is_some()), 0);
        let tolerance = tolerance.unwrap_or(0.0);
        call!(
            self,
            "fmi2SetupExperiment",
            (Component, c_int, f64, f64, c_int, f64),
            (c, tolerance_defined, tolerance, 0.0, stop_defined, 0.0)
        )?;
        call!(self, "fmi2EnterInitializationMode", (Component), (c))?;
        call!(self, "fmi2ExitInitializationMode", (Component), (c))
    }

    /// `fmi2GetReal`.
    pub fn reals(&mut self, references: &[u32]) -> Result<Vec<f64>, HostError> {
        let mut values = vec![f64::NAN; references.len()];
        call!(
            self,
            "fmi2GetReal",
            (Component, *const u32, usize, *mut f64),
            (self.component, references.as_ptr(), references.len(), values.as_mut_ptr())
        )?;
        Ok(values)
    }

    /// `fmi2SetReal`.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), HostError> {
        assert_eq!(references.len(), values.len(), "one value for each reference");
        call!(
            self,
            "fmi2SetReal",
            (Component, *const u32, usize, *const f64),
            (self.component, references.as_ptr(), references.len(), values.as_ptr())
        )
    }

    /// `fmi2DoStep`.
    pub fn step(&mut self, from: f64, step: f64) -> Result<(), HostError> {
        call!(self, "fmi2DoStep", (Component, f64, f64, c_int), (self.component, from, step, 0))
    }

    /// `fmi2Terminate`.
    pub fn terminate(&mut self) -> Result<(), HostError> {
        call!(self, "fmi2Terminate", (Component), (self.component))
    }

    /// What the FMU has logged so far.
    pub fn log(&self) -> Vec<String> {
        self.log.lock().map(|log| log.clone()).unwrap_or_default()
    }

    fn last_line(&self) -> String {
        self.log().pop().unwrap_or_else(|| "empty".into())
    }

    fn answer(&self, function: &'static str, status: c_int) -> Result<(), HostError> {
        let status = match status {
            0 | 1 => return Ok(()),
            2 => "fmi2Discard",
            3 => "fmi2Error",
            4 => "fmi2Fatal",
            5 => "fmi2Pending",
            _ => "no status of the standard",
        };
        Err(HostError::Status { function, status, log: self.last_line() })
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if self.component.is_null() {
            return;
        }
        // SAFETY: standard's signature; the instance lives and is not used after this.
        unsafe {
            if let Ok(free) = self.library.get::<unsafe extern "C" fn(Component)>("fmi2FreeInstance") {
                free(self.component);
            }
        }
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
