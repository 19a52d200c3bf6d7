//! C types of the interface that its versions share, by the names of FMI 2.0, and the callbacks of both.

use libc::{c_char, c_uint, c_void};

/// `fmi2Component`: handle of an instance.
pub type Component = *mut c_void;

/// `fmi2ComponentEnvironment`: the host's own pointer, handed back in callbacks.
pub type ComponentEnvironment = *mut c_void;

/// `fmi2FMUstate`: handle of a saved state.
pub type FmuState = *mut c_void;

/// `fmi2ValueReference`.
pub type ValueReference = c_uint;

/// `fmi2String`: UTF-8, ended by a NUL.
pub type FmiString = *const c_char;

/// `fmi2Status`. Brinell returns the first four only: a fatal error would condemn the host's other instances, and
/// no step is ever pending.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// All well.
    Ok = 0,
    /// Not quite right, but the computation goes on.
    Warning = 1,
    /// Nothing was done; the computation may go on.
    Discard = 2,
    /// This instance is of no use until it is reset or a saved state is restored.
    Error = 3,
    /// All instances are of no use.
    Fatal = 4,
    /// The step is still running.
    Pending = 5,
}

/// `fmi2CallbackLogger`: environment, instance name, status, category, format, arguments of the format.
///
/// It should not unwind. Of one that does the outcome is defined: the boundary stops it, and an exception of another
/// language, which it cannot handle, ends the process.
pub type LoggerCallback =
    unsafe extern "C-unwind" fn(ComponentEnvironment, FmiString, Status, FmiString, FmiString, ...);

/// `fmi2CallbackAllocateMemory`; never called.
pub type AllocateMemoryCallback = unsafe extern "C" fn(usize, usize) -> *mut c_void;
/// `fmi2CallbackFreeMemory`; never called.
pub type FreeMemoryCallback = unsafe extern "C" fn(*mut c_void);
/// `fmi2StepFinished`; never called.
pub type StepFinishedCallback = unsafe extern "C" fn(ComponentEnvironment, Status);

/// `fmi3Boolean`: C's `bool`, of one byte; every value but 0 counts as true. An importer's `bool` is 0 or 1, and a
/// plain byte can be refused or taken whatever it is.
pub type Bool = u8;

/// `fmi3LogMessageCallback`: environment, status, category, message. It should not unwind either.
pub type LogMessageCallback = unsafe extern "C-unwind" fn(ComponentEnvironment, Status, FmiString, FmiString);

/// `fmi3IntermediateUpdateCallback`: environment, time, whether inputs are asked for, whether outputs may be read,
/// whether the integration step is accepted, whether an early return is possible; then where to write whether one
/// is wanted, and at which time.
pub type IntermediateUpdateCallback =
    unsafe extern "C-unwind" fn(ComponentEnvironment, f64, Bool, Bool, Bool, Bool, *mut Bool, *mut f64);

/// `fmi2CallbackFunctions`. Only the logger is required.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct CallbackFunctions {
    /// Receives messages.
    pub logger: Option<LoggerCallback>,
    /// Never called, may be NULL.
    pub allocate_memory: Option<AllocateMemoryCallback>,
    /// Never called, may be NULL.
    pub free_memory: Option<FreeMemoryCallback>,
    /// Never called, may be NULL.
    pub step_finished: Option<StepFinishedCallback>,
    /// Handed back to the logger.
    pub component_environment: ComponentEnvironment,
}
