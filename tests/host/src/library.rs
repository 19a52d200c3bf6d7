//! Loading a library, and what both versions answer with.

use std::env;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use libloading::Library;

/// Lines of an instance's log.
pub(crate) type Log = Mutex<Vec<String>>;

/// The library that was built along with this program.
///
/// # Errors
/// Where the program does not know where it is.
pub fn library_beside() -> std::io::Result<PathBuf> {
    let name = format!("{}brinell_fmi{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    Ok(env::current_exe()?.with_file_name(name))
}

/// Functions of a library by their names in the standard, with its signatures.
macro_rules! functions {
    ($($field:ident = $name:literal: ($($kind:ty),*) $(-> $result:ty)?;)*) => {
        #[derive(Debug, Clone, Copy)]
        struct Functions {
            $($field: unsafe extern "C" fn($($kind),*) $(-> $result)?,)*
        }

        impl Functions {
            fn of(library: &libloading::Library) -> Result<Self, $crate::HostError> {
                // SAFETY: these are the standard's signatures, and who loads a library trusts it to have them.
                unsafe { Ok(Self { $($field: *library.get($name)?,)* }) }
            }
        }
    };
}
pub(crate) use functions;

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

/// A state that an instance has saved.
#[derive(Debug, Clone, Copy)]
pub struct State(pub(crate) *mut c_void);

/// Loads a library.
pub(crate) fn loaded(path: &Path) -> Result<Library, HostError> {
    // SAFETY: the user asked for this library to be run; its initialisers are his trust.
    Ok(unsafe { Library::new(path)? })
}

/// # Safety
/// The pointer is null or to a zero-terminated string.
pub(crate) unsafe fn text(pointer: *const c_char) -> String {
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
pub(crate) unsafe fn keep(environment: *mut c_void, category: *const c_char, line: &str) {
    // SAFETY: this function's contract.
    let (log, category) = unsafe { (&*environment.cast::<Log>(), text(category)) };
    if let Ok(mut log) = log.lock() {
        log.push(format!("{category}: {line}"));
    }
}

/// The standard's name of a status that is neither OK nor Warning.
pub(crate) fn fault(status: c_int) -> Option<&'static str> {
    match status {
        0 | 1 => None,
        2 => Some("Discard"),
        3 => Some("Error"),
        4 => Some("Fatal"),
        5 => Some("Pending"),
        _ => Some("no status of the standard"),
    }
}

pub(crate) fn last_line(log: &Log) -> String {
    log.lock().ok().and_then(|log| log.last().cloned()).unwrap_or_else(|| "empty".into())
}
