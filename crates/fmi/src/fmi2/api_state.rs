//! The exported functions that save and restore the state of an instance.

#![allow(non_snake_case)]

use std::ptr;

use super::functions;
use super::types::{Byte, Component, FmuState, Status};
use crate::arguments::{array, disjoint, state_handle, store, store_all};
use crate::boundary;
use crate::instance::{Failure, blob, snapshots};

/// `fmi2GetFMUstate`: saves the state; over an earlier one if `*FMUstate` is not NULL.
///
/// # Safety
/// `FMUstate` is null or points to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: Component, FMUstate: *mut FmuState) -> Status {
    boundary::call(c, &functions::GET_FMU_STATE, |instance| {
        // SAFETY: this function's contract; null and misaligned pointers are refused. The handle itself may be any
        // value.
        let handle = unsafe { state_handle(FMUstate)? };
        *handle = instance.save(*handle)?;
        Ok(())
    })
}

/// `fmi2SetFMUstate`: puts a saved state back, mode and time included.
///
/// # Safety
/// `c` and `FMUstate` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: Component, FMUstate: FmuState) -> Status {
    boundary::call(c, &functions::SET_FMU_STATE, |instance| instance.restore(FMUstate))
}

/// `fmi2FreeFMUstate`: frees a saved state and sets its handle to NULL. NULL is ignored. A host that passes the state
/// instead of its address, as fmusim (the program in C) does, has it freed all the same; the log warns.
///
/// # Safety
/// `FMUstate` is null or points to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: Component, FMUstate: *mut FmuState) -> Status {
    boundary::call(c, &functions::FREE_FMU_STATE, |instance| {
        if FMUstate.is_null() {
            return Ok(());
        }
        if snapshots::is_handle(FMUstate.addr()) {
            return instance.free_by_value(FMUstate.cast(), "fmi2FreeFMUstate");
        }
        // SAFETY: this function's contract; misaligned pointers are refused. The handle itself may be any value.
        let handle = unsafe { state_handle(FMUstate)? };
        if !handle.is_null() {
            instance.snapshots.free(*handle)?;
            *handle = ptr::null_mut();
        }
        Ok(())
    })
}

/// `fmi2SerializedFMUstateSize`: number of bytes of a saved state.
///
/// # Safety
/// `size` is null or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(c: Component, FMUstate: FmuState, size: *mut usize) -> Status {
    boundary::call(c, &functions::SERIALIZED_FMU_STATE_SIZE, |instance| {
        let length = blob::length(instance.snapshots.get(FMUstate)?);
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe { store("size", size, length) }
    })
}

/// `fmi2SerializeFMUstate`: a saved state as bytes; `size` must be the one that `fmi2SerializedFMUstateSize` gives.
///
/// # Safety
/// `serializedState` is null or points to `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: Component,
    FMUstate: FmuState,
    serializedState: *mut Byte,
    size: usize,
) -> Status {
    boundary::call(c, &functions::SERIALIZE_FMU_STATE, |instance| {
        let bytes = blob::encode(instance.snapshots.get(FMUstate)?, instance.model.guid());
        if size != bytes.len() {
            return Err(Failure::Size { given: size, needed: bytes.len() });
        }
        // SAFETY: this function's contract; null is refused.
        unsafe { store_all("serializedState", serializedState.cast::<u8>(), &bytes) }
    })
}

/// `fmi2DeSerializeFMUstate`: a saved state from bytes; over an earlier one if `*FMUstate` is not NULL.
///
/// # Safety
/// `serializedState` is null or points to `size` bytes; `FMUstate` is null or points to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: Component,
    serializedState: *const Byte,
    size: usize,
    FMUstate: *mut FmuState,
) -> Status {
    boundary::call(c, &functions::DESERIALIZE_FMU_STATE, |instance| {
        disjoint(serializedState, size, FMUstate, 1)?;
        // SAFETY: this function's contract; null, misaligned and overlapping pointers are refused. The handle itself
        // may be any value.
        let handle = unsafe { state_handle(FMUstate)? };
        // SAFETY: as above.
        let bytes = unsafe { array("serializedState", serializedState.cast::<u8>(), size)? };
        let snapshot = blob::decode(bytes, instance.model.guid(), &instance.simulation)?;
        *handle = instance.snapshots.put(*handle, |_| Some(snapshot))?;
        Ok(())
    })
}
