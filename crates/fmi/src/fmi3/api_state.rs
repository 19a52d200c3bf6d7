//! The exported functions that save and restore the state of an instance.

#![allow(non_snake_case)]

use std::ptr;

use super::functions;
use super::types::{FmuState, Instance, Status};
use crate::arguments::{array, disjoint, state_handle, store, store_all};
use crate::boundary;
use crate::instance::{Failure, blob, snapshots};

/// `fmi3GetFMUState`: saves the state; over an earlier one if `*FMUState` is not NULL.
///
/// # Safety
/// `FMUState` is null or points to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(instance: Instance, FMUState: *mut FmuState) -> Status {
    boundary::call(instance, &functions::GET_FMU_STATE, |instance| {
        // SAFETY: this function's contract; null and misaligned pointers are refused. The handle itself may be any
        // value.
        let handle = unsafe { state_handle(FMUState)? };
        *handle = instance.save(*handle)?;
        Ok(())
    })
}

/// `fmi3SetFMUState`: puts a saved state back, mode and time included.
///
/// # Safety
/// `instance` and `FMUState` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(instance: Instance, FMUState: FmuState) -> Status {
    boundary::call(instance, &functions::SET_FMU_STATE, |instance| instance.restore(FMUState))
}

/// `fmi3FreeFMUState`: frees a saved state and sets its handle to NULL. NULL is ignored. A host that passes the state
/// instead of its address, as fmusim (the program in C) does, has it freed all the same; the log warns.
///
/// # Safety
/// `FMUState` is null or points to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(instance: Instance, FMUState: *mut FmuState) -> Status {
    boundary::call(instance, &functions::FREE_FMU_STATE, |instance| {
        if FMUState.is_null() {
            return Ok(());
        }
        if snapshots::is_handle(FMUState.addr()) {
            return instance.free_by_value(FMUState.cast(), "fmi3FreeFMUState");
        }
        // SAFETY: this function's contract; misaligned pointers are refused. The handle itself may be any value.
        let handle = unsafe { state_handle(FMUState)? };
        if !handle.is_null() {
            instance.snapshots.free(*handle)?;
            *handle = ptr::null_mut();
        }
        Ok(())
    })
}

/// `fmi3SerializedFMUStateSize`: number of bytes of a saved state.
///
/// # Safety
/// `size` is null or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: Instance,
    FMUState: FmuState,
    size: *mut usize,
) -> Status {
    boundary::call(instance, &functions::SERIALIZED_FMU_STATE_SIZE, |instance| {
        let length = blob::length(instance.snapshots.get(FMUState)?);
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe { store("size", size, length) }
    })
}

/// `fmi3SerializeFMUState`: a saved state as bytes; `size` must be the one that `fmi3SerializedFMUStateSize` gives.
///
/// # Safety
/// `serializedState` is null or points to `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: Instance,
    FMUState: FmuState,
    serializedState: *mut u8,
    size: usize,
) -> Status {
    boundary::call(instance, &functions::SERIALIZE_FMU_STATE, |instance| {
        let bytes = blob::encode(instance.snapshots.get(FMUState)?, instance.model.guid());
        if size != bytes.len() {
            return Err(Failure::Size { given: size, needed: bytes.len() });
        }
        // SAFETY: this function's contract; null is refused.
        unsafe { store_all("serializedState", serializedState, &bytes) }
    })
}

/// `fmi3DeserializeFMUState`: a saved state from bytes; over an earlier one if `*FMUState` is not NULL.
///
/// # Safety
/// `serializedState` is null or points to `size` bytes; `FMUState` is null or points to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: Instance,
    serializedState: *const u8,
    size: usize,
    FMUState: *mut FmuState,
) -> Status {
    boundary::call(instance, &functions::DESERIALIZE_FMU_STATE, |instance| {
        disjoint(serializedState, size, FMUState, 1)?;
        // SAFETY: this function's contract; null, misaligned and overlapping pointers are refused. The handle itself
        // may be any value.
        let handle = unsafe { state_handle(FMUState)? };
        // SAFETY: as above.
        let bytes = unsafe { array("serializedState", serializedState, size)? };
        let snapshot = blob::decode(bytes, instance.model.guid(), &instance.simulation)?;
        *handle = instance.snapshots.put(*handle, |_| Some(snapshot))?;
        Ok(())
    })
}
