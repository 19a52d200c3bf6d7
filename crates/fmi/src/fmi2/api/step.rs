//! The exported functions that step through time and tell how a step went.
//!
//! Steps are done when `fmi2DoStep` returns: none is ever pending or discarded, so the status functions have only
//! plain answers.

#![allow(non_snake_case)]

use super::functions;
use super::types::{
    Boolean, Component, DO_STEP_STATUS, FALSE, FmiString, Integer, LAST_SUCCESSFUL_TIME, PENDING_STATUS, Real, Status,
    StatusKind, TERMINATED,
};
use crate::arguments::store;
use crate::boundary;
use crate::instance::Failure;

/// `fmi2DoStep`: advances from a communication point by a step of any positive size.
///
/// `noSetFMUStatePriorToCurrentPoint` is accepted and not needed: saved states are the host's to free.
///
/// # Safety
/// `c` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    c: Component,
    currentCommunicationPoint: Real,
    communicationStepSize: Real,
    _noSetFMUStatePriorToCurrentPoint: Boolean,
) -> Status {
    boundary::call(c, &functions::DO_STEP, |instance| {
        instance.take_step(currentCommunicationPoint, communicationStepSize)
    })
}

/// `fmi2CancelStep`: always an error, for no step runs in the background.
///
/// # Safety
/// `c` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: Component) -> Status {
    boundary::call(c, &functions::CANCEL_STEP, |_| Ok(()))
}

/// `fmi2GetStatus`: for `fmi2DoStepStatus`, the status of the last step.
///
/// # Safety
/// `value` is null or points to a status.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(c: Component, s: StatusKind, value: *mut Status) -> Status {
    boundary::call(c, &functions::GET_STATUS, |instance| match s {
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        DO_STEP_STATUS => unsafe { store("value", value, instance.last_step) },
        _ => Err(Failure::UnknownStatus(s)),
    })
}

/// `fmi2GetRealStatus`: for `fmi2LastSuccessfulTime`, the communication point reached (s).
///
/// # Safety
/// `value` is null or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(c: Component, s: StatusKind, value: *mut Real) -> Status {
    boundary::call(c, &functions::GET_REAL_STATUS, |instance| match s {
        LAST_SUCCESSFUL_TIME => {
            let time = instance.clock.ok_or(Failure::NotSetUp)?.time;
            // SAFETY: this function's contract; null and misaligned pointers are refused.
            unsafe { store("value", value, time) }
        }
        _ => Err(Failure::UnknownStatus(s)),
    })
}

/// `fmi2GetIntegerStatus`: the standard defines no integer status.
///
/// # Safety
/// `c` may be any value; `value` is not touched.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(c: Component, s: StatusKind, _value: *mut Integer) -> Status {
    boundary::call(c, &functions::GET_INTEGER_STATUS, |_| Err(Failure::UnknownStatus(s)))
}

/// `fmi2GetBooleanStatus`: for `fmi2Terminated`, false: the model never ends a run by itself.
///
/// # Safety
/// `value` is null or points to a Boolean.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(c: Component, s: StatusKind, value: *mut Boolean) -> Status {
    boundary::call(c, &functions::GET_BOOLEAN_STATUS, |_| match s {
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        TERMINATED => unsafe { store("value", value, FALSE) },
        _ => Err(Failure::UnknownStatus(s)),
    })
}

/// `fmi2GetStringStatus`: for `fmi2PendingStatus`, that nothing is pending.
///
/// # Safety
/// `value` is null or points to a string.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(c: Component, s: StatusKind, value: *mut FmiString) -> Status {
    boundary::call(c, &functions::GET_STRING_STATUS, |_| match s {
        // SAFETY: this function's contract; null and misaligned pointers are refused. The string is static.
        PENDING_STATUS => unsafe { store("value", value, c"no step is pending".as_ptr()) },
        _ => Err(Failure::UnknownStatus(s)),
    })
}
