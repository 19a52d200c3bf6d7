//! The exported functions that read and set variables of the types that there are: Float64, Int64 for enumerations,
//! UInt64 for counters, String.
//!
//! A call sets all of its variables or none.

#![allow(non_snake_case)]

use super::functions;
use super::types::{FmiString, Instance, Status, ValueReference};
use super::values::{self, check_kind, check_scalars, may_read, may_set};
use crate::arguments::{array, array_mut, disjoint, store_all, string};
use crate::boundary;
use crate::instance::Failure;
use brinell::simulation::VariableError;
use brinell::simulation::interface::table::Kind;

/// `fmi3GetFloat64`.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *mut f64,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::GET_FLOAT64, |instance| {
        disjoint(valueReferences, nValueReferences, values, nValues)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, values) = unsafe {
            (array("valueReferences", valueReferences, nValueReferences)?, array_mut("values", values, nValues)?)
        };
        may_read(instance, references)?;
        values::read(instance, references, values)
    })
}

/// `fmi3GetInt64`: enumerations.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt64(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *mut i64,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::GET_INT64, |instance| {
        disjoint(valueReferences, nValueReferences, values, nValues)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, values) = unsafe {
            (array("valueReferences", valueReferences, nValueReferences)?, array_mut("values", values, nValues)?)
        };
        may_read(instance, references)?;
        check_kind(instance, references, "Int64", is_enumeration)?;
        check_scalars(instance, references, values.len())?;
        for (value, reference) in values.iter_mut().zip(references) {
            let mut number = [0];
            instance.simulation.integers(std::slice::from_ref(reference), &mut number)?;
            *value = number[0].into();
        }
        Ok(())
    })
}

/// `fmi3GetUInt64`: counters.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt64(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *mut u64,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::GET_UINT64, |instance| {
        disjoint(valueReferences, nValueReferences, values, nValues)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let (references, values) = unsafe {
            (array("valueReferences", valueReferences, nValueReferences)?, array_mut("values", values, nValues)?)
        };
        may_read(instance, references)?;
        check_kind(instance, references, "UInt64", is_counter)?;
        check_scalars(instance, references, values.len())?;
        Ok(instance.simulation.counts(references, values)?)
    })
}

/// `fmi3GetString`. The strings stay valid until the next call of this function on the instance.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetString(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *mut FmiString,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::GET_STRING, |instance| {
        disjoint(valueReferences, nValueReferences, values, nValues)?;
        // SAFETY: this function's contract; null, misaligned and overlapping arrays are refused.
        let references = unsafe { array("valueReferences", valueReferences, nValueReferences)? };
        may_read(instance, references)?;
        check_kind(instance, references, "String", is_text)?;
        check_scalars(instance, references, nValues)?;
        let texts = instance.simulation.strings(references)?;
        let texts: Vec<_> = instance.keep(texts).collect();
        // SAFETY: as above.
        unsafe { store_all("values", values, &texts) }
    })
}

/// `fmi3SetFloat64`.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *const f64,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::SET_FLOAT64, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe {
            (array("valueReferences", valueReferences, nValueReferences)?, array("values", values, nValues)?)
        };
        may_set(instance, references)?;
        values::set(instance, references, values)
    })
}

/// `fmi3SetInt64`: enumerations.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt64(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *const i64,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::SET_INT64, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe {
            (array("valueReferences", valueReferences, nValueReferences)?, array("values", values, nValues)?)
        };
        may_set(instance, references)?;
        check_kind(instance, references, "Int64", is_enumeration)?;
        check_scalars(instance, references, values.len())?;
        let numbers = references.iter().zip(values).map(|(&reference, &value)| {
            // What an i32 cannot hold is no item of an enumeration.
            i32::try_from(value).map_err(|_| out_of_range(&instance.simulation, reference, value))
        });
        let numbers: Vec<i32> = numbers.collect::<Result<_, _>>()?;
        Ok(instance.simulation.set_integers(references, &numbers)?)
    })
}

/// `fmi3SetUInt64`: counters are computed, so only no variables at all succeed.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt64(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *const u64,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::SET_UINT64, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe {
            (array("valueReferences", valueReferences, nValueReferences)?, array("values", values, nValues)?)
        };
        may_set(instance, references)?;
        check_kind(instance, references, "UInt64", is_counter)?;
        check_scalars(instance, references, values.len())?;
        match references.first() {
            None => Ok(()),
            // It says that they are computed.
            Some(&counter) => Ok(instance.simulation.set_integers(&[counter], &[0])?),
        }
    })
}

/// `fmi3SetString`. The strings are copied.
///
/// # Safety
/// `valueReferences` and `values` are null, or point to as many elements as said; the strings are null or end in NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetString(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    values: *const FmiString,
    nValues: usize,
) -> Status {
    boundary::call(instance, &functions::SET_STRING, |instance| {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        let (references, values) = unsafe {
            (array("valueReferences", valueReferences, nValueReferences)?, array("values", values, nValues)?)
        };
        may_set(instance, references)?;
        check_kind(instance, references, "String", is_text)?;
        check_scalars(instance, references, values.len())?;
        let texts = values
            .iter()
            // SAFETY: this function's contract; null is refused.
            .map(|pointer| unsafe { string("values", *pointer) })
            .collect::<Result<Vec<_>, Failure>>()?;
        Ok(instance.simulation.set_strings(references, &texts)?)
    })
}

fn is_enumeration(kind: &Kind) -> bool {
    matches!(kind, Kind::Enumeration { .. })
}

fn is_counter(kind: &Kind) -> bool {
    *kind == Kind::Integer
}

fn is_text(kind: &Kind) -> bool {
    matches!(kind, Kind::Text { .. })
}

fn out_of_range(simulation: &brinell::simulation::Simulation, reference: u32, value: i64) -> VariableError {
    match simulation.variable(reference) {
        Ok(variable) => {
            let items = if let Kind::Enumeration { items, .. } = variable.kind { items.len() } else { 0 };
            VariableError::OutOfRange { name: variable.name.clone(), value: value as f64, min: 1.0, max: items as f64 }
        }
        Err(error) => error,
    }
}
