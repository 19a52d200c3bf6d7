//! The exported functions that give and take derivatives.

#![allow(non_snake_case)]

use super::functions;
use super::types::{Component, Integer, Real, Status, ValueReference};
use crate::arguments::{array, array_mut, disjoint};
use crate::both_versions::variables::{Array, product};
use crate::boundary;
use crate::instance::finite;

/// `fmi2GetDirectionalDerivative`: J·`dvKnown`, where J holds the partial derivatives of the unknowns by the knowns.
///
/// # Safety
/// Pointers are null or point to `nUnknown` and `nKnown` elements, as their names say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: Component,
    vUnknown_ref: *const ValueReference,
    nUnknown: usize,
    vKnown_ref: *const ValueReference,
    nKnown: usize,
    dvKnown: *const Real,
    dvUnknown: *mut Real,
) -> Status {
    let unknowns = Array { name: "vUnknown_ref", pointer: vUnknown_ref, count: nUnknown };
    let knowns = Array { name: "vKnown_ref", pointer: vKnown_ref, count: nKnown };
    let seed = Array { name: "dvKnown", pointer: dvKnown, count: nKnown };
    let values = Array { name: "dvUnknown", pointer: dvUnknown, count: nUnknown };
    let function = &functions::GET_DIRECTIONAL_DERIVATIVE;
    // SAFETY: this function's contract.
    unsafe {
        product(c, function, [unknowns, knowns], seed, values, |instance, [unknowns, knowns], seed, values| {
            instance.check_listed(unknowns)?;
            instance.check_listed(knowns)?;
            instance.simulation.directional_derivative(unknowns, knowns, seed, values)?;
            finite(&instance.simulation, unknowns, values)
        })
    }
}

/// `fmi2SetRealInputDerivatives`: derivatives of inputs by time, valid through the next step.
///
/// # Safety
/// Pointers are null or point to `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    order: *const Integer,
    value: *const Real,
) -> Status {
    boundary::call(c, &functions::SET_REAL_INPUT_DERIVATIVES, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, orders, values) =
            unsafe { (array("vr", vr, nvr)?, array("order", order, nvr)?, array("value", value, nvr)?) };
        Ok(instance.simulation.set_input_derivatives(references, orders, values)?)
    })
}

/// `fmi2GetRealOutputDerivatives`: derivatives of outputs by time at the communication point.
///
/// # Safety
/// Pointers are null or point to `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    order: *const Integer,
    value: *mut Real,
) -> Status {
    boundary::call(c, &functions::GET_REAL_OUTPUT_DERIVATIVES, |instance| {
        disjoint(vr, nvr, value, nvr)?;
        disjoint(order, nvr, value, nvr)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, orders, values) =
            unsafe { (array("vr", vr, nvr)?, array("order", order, nvr)?, array_mut("value", value, nvr)?) };
        instance.simulation.output_derivatives(references, orders, values)?;
        finite(&instance.simulation, references, values)
    })
}
