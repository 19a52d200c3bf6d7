//! What reading and setting variables has in common in all types and both versions: arrays from C in, slices to the
//! model.

use crate::arguments::{array, array_mut, disjoint, store_all, string};
use crate::boundary;
use crate::c_interface::{Component, FmiString, Status, ValueReference};
use crate::instance::{Failure, Function, Instance};

/// An array of the host, by the name that the standard gives it.
pub(crate) struct Array<P> {
    pub(crate) name: &'static str,
    pub(crate) pointer: P,
    pub(crate) count: usize,
}

type References = Array<*const ValueReference>;

/// Reads numbers.
///
/// # Safety
/// Both arrays are null, or point to as many elements as they say.
#[inline]
pub(crate) unsafe fn get<T>(
    component: Component,
    function: &'static Function,
    references: References,
    values: Array<*mut T>,
    read: impl FnOnce(&mut Instance, &[ValueReference], &mut [T]) -> Result<(), Failure>,
) -> Status {
    boundary::call(component, function, |instance| {
        disjoint(references.pointer, references.count, values.pointer, values.count)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, values) = unsafe {
            (
                array(references.name, references.pointer, references.count)?,
                array_mut(values.name, values.pointer, values.count)?,
            )
        };
        read(instance, references, values)
    })
}

/// Computes a product with the Jacobian from references of unknowns and knowns and a seed.
///
/// # Safety
/// All arrays are null, or point to as many elements as they say.
pub(crate) unsafe fn product(
    component: Component,
    function: &'static Function,
    [unknowns, knowns]: [References; 2],
    seed: Array<*const f64>,
    values: Array<*mut f64>,
    compute: impl FnOnce(&mut Instance, [&[ValueReference]; 2], &[f64], &mut [f64]) -> Result<(), Failure>,
) -> Status {
    boundary::call(component, function, |instance| {
        disjoint(unknowns.pointer, unknowns.count, values.pointer, values.count)?;
        disjoint(knowns.pointer, knowns.count, values.pointer, values.count)?;
        disjoint(seed.pointer, seed.count, values.pointer, values.count)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (unknowns, knowns, seed, values) = unsafe {
            (
                array(unknowns.name, unknowns.pointer, unknowns.count)?,
                array(knowns.name, knowns.pointer, knowns.count)?,
                array(seed.name, seed.pointer, seed.count)?,
                array_mut(values.name, values.pointer, values.count)?,
            )
        };
        compute(instance, [unknowns, knowns], seed, values)
    })
}

/// Sets numbers.
///
/// # Safety
/// Both arrays are null, or point to as many elements as they say.
#[inline]
pub(crate) unsafe fn set<T>(
    component: Component,
    function: &'static Function,
    references: References,
    values: Array<*const T>,
    set: impl FnOnce(&mut Instance, &[ValueReference], &[T]) -> Result<(), Failure>,
) -> Status {
    boundary::call(component, function, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe {
            (
                array(references.name, references.pointer, references.count)?,
                array(values.name, values.pointer, values.count)?,
            )
        };
        set(instance, references, values)
    })
}

/// Reads strings, which stay valid until strings are read again from the instance. `read` is given the number of values
/// as well.
///
/// # Safety
/// Both arrays are null, or point to as many elements as they say.
pub(crate) unsafe fn get_strings(
    component: Component,
    function: &'static Function,
    references: References,
    values: Array<*mut FmiString>,
    read: impl FnOnce(&mut Instance, &[ValueReference], usize) -> Result<Vec<String>, Failure>,
) -> Status {
    boundary::call(component, function, |instance| {
        disjoint(references.pointer, references.count, values.pointer, values.count)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let references = unsafe { array(references.name, references.pointer, references.count)? };
        let texts = read(instance, references, values.count)?;
        let texts: Vec<_> = instance.keep(texts).collect();
        // SAFETY: as above.
        unsafe { store_all(values.name, values.pointer, &texts) }
    })
}

/// Sets strings, which are copied.
///
/// # Safety
/// Both arrays are null, or point to as many elements as they say; the strings are null or end in NUL.
pub(crate) unsafe fn set_strings(
    component: Component,
    function: &'static Function,
    references: References,
    values: Array<*const FmiString>,
    store: impl FnOnce(&mut Instance, &[ValueReference], &[&str]) -> Result<(), Failure>,
) -> Status {
    let name = values.name;
    // SAFETY: this function's contract.
    unsafe {
        set(component, function, references, values, |instance, references, values| {
            // SAFETY: this function's contract; null is refused.
            let texts = values.iter().map(|pointer| string(name, *pointer));
            store(instance, references, &texts.collect::<Result<Vec<_>, _>>()?)
        })
    }
}

/// Reads or sets variables of a type of which there are none: only a call for no variables succeeds. The values are not
/// looked at.
///
/// # Safety
/// The references are null, or point to as many elements as they say.
pub(crate) unsafe fn none(
    component: Component,
    function: &'static Function,
    references: References,
    refusal: impl FnOnce(&Instance, &[ValueReference]) -> Result<(), Failure>,
) -> Status {
    boundary::call(component, function, |instance| {
        // SAFETY: this function's contract; null is refused.
        refusal(instance, unsafe { array(references.name, references.pointer, references.count)? })
    })
}
