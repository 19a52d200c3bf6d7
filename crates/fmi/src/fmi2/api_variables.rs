//! The exported functions that read and set variables.
//!
//! A call sets all of its variables or none. Brinell has no Boolean variables.

#![allow(non_snake_case)]

use super::functions;
use super::types::{Boolean, Component, FmiString, Integer, Real, Status, ValueReference};
use crate::arguments::{array, array_mut, disjoint, store_all, string};
use crate::boundary;
use crate::instance::{Failure, finite};

/// `fmi2GetReal`.
///
/// # Safety
/// `vr` and `value` are null, or point to `nvr` elements each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(c: Component, vr: *const ValueReference, nvr: usize, value: *mut Real) -> Status {
    boundary::call(c, &functions::GET_REAL, |instance| {
        disjoint(vr, nvr, value, nvr)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, values) = unsafe { (array("vr", vr, nvr)?, array_mut("value", value, nvr)?) };
        instance.simulation.reals(references, values)?;
        finite(&instance.simulation, references, values)
    })
}

/// `fmi2GetInteger`: integers and enumerations.
///
/// # Safety
/// `vr` and `value` are null, or point to `nvr` elements each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *mut Integer,
) -> Status {
    boundary::call(c, &functions::GET_INTEGER, |instance| {
        disjoint(vr, nvr, value, nvr)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, values) = unsafe { (array("vr", vr, nvr)?, array_mut("value", value, nvr)?) };
        Ok(instance.simulation.integers(references, values)?)
    })
}

/// `fmi2GetBoolean`: there are no Boolean variables, so only `nvr` = 0 succeeds.
///
/// # Safety
/// `vr` is null, or points to `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    _value: *mut Boolean,
) -> Status {
    boundary::call(c, &functions::GET_BOOLEAN, |instance| {
        // SAFETY: this function's contract; null is refused.
        match unsafe { array("vr", vr, nvr)? } {
            [] => Ok(()),
            [first, ..] => Err(instance.wrong_type(*first, "Boolean").into()),
        }
    })
}

/// `fmi2GetString`. The strings stay valid until the next call of this function on the instance.
///
/// # Safety
/// `vr` and `value` are null, or point to `nvr` elements each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *mut FmiString,
) -> Status {
    boundary::call(c, &functions::GET_STRING, |instance| {
        disjoint(vr, nvr, value, nvr)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let references = unsafe { array("vr", vr, nvr)? };
        let texts = instance.simulation.strings(references)?;
        let texts: Vec<_> = instance.keep(texts).collect();
        // SAFETY: as above.
        unsafe { store_all("value", value, &texts) }
    })
}

/// `fmi2SetReal`.
///
/// # Safety
/// `vr` and `value` are null, or point to `nvr` elements each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *const Real,
) -> Status {
    boundary::call(c, &functions::SET_REAL, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe { (array("vr", vr, nvr)?, array("value", value, nvr)?) };
        Ok(instance.simulation.set_reals(references, values)?)
    })
}

/// `fmi2SetInteger`: enumerations; no integer can be set.
///
/// # Safety
/// `vr` and `value` are null, or point to `nvr` elements each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *const Integer,
) -> Status {
    boundary::call(c, &functions::SET_INTEGER, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe { (array("vr", vr, nvr)?, array("value", value, nvr)?) };
        Ok(instance.simulation.set_integers(references, values)?)
    })
}

/// `fmi2SetBoolean`: there are no Boolean variables, so only `nvr` = 0 succeeds.
///
/// # Safety
/// `vr` is null, or points to `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    _value: *const Boolean,
) -> Status {
    boundary::call(c, &functions::SET_BOOLEAN, |instance| {
        // SAFETY: this function's contract; null is refused.
        match unsafe { array("vr", vr, nvr)? } {
            [] => Ok(()),
            [first, ..] => Err(instance.wrong_type(*first, "Boolean").into()),
        }
    })
}

/// `fmi2SetString`. The strings are copied.
///
/// # Safety
/// `vr` and `value` are null, or point to `nvr` elements each; the strings are null or end in NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *const FmiString,
) -> Status {
    boundary::call(c, &functions::SET_STRING, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe { (array("vr", vr, nvr)?, array("value", value, nvr)?) };
        let texts = values
            .iter()
            // SAFETY: this function's contract; null is refused.
            .map(|pointer| unsafe { string("value", *pointer) })
            .collect::<Result<Vec<_>, Failure>>()?;
        Ok(instance.simulation.set_strings(references, &texts)?)
    })
}
