//! The C types of the standard's headers `fmi3PlatformTypes.h` and `fmi3FunctionTypes.h` (FMI 3.0.x).
//!
//! What a host hands in as a Boolean is a byte, and an enumeration a plain C integer: any value is then one that can be
//! refused, not undefined behaviour.

use libc::{c_int, c_void};

pub use crate::c_interface::{
    Bool, ComponentEnvironment as InstanceEnvironment, FmiString, FmuState, IntermediateUpdateCallback,
    LogMessageCallback, Status, ValueReference,
};

/// `fmi3Instance`: handle of an instance.
pub type Instance = *mut c_void;
/// `fmi3Binary`.
pub type Binary = *const u8;
/// `fmi3DependencyKind`.
pub type DependencyKind = c_int;
/// `fmi3IntervalQualifier`.
pub type IntervalQualifier = c_int;
/// `fmi3ClockUpdateCallback`; never called.
pub type ClockUpdateCallback = unsafe extern "C" fn(InstanceEnvironment);
/// `fmi3LockPreemptionCallback` and `fmi3UnlockPreemptionCallback`; never called.
pub type PreemptionCallback = unsafe extern "C" fn();

/// `fmi3False`.
pub const FALSE: Bool = 0;
/// `fmi3True`.
pub const TRUE: Bool = 1;
/// `fmi3Dependent`: a dependency of no particular structure.
pub const DEPENDENT: DependencyKind = 5;
