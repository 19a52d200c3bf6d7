//! The exported functions that read and set variables: Float64, Int64 for enumerations and seeds, UInt64 for counters,
//! String. Of the other types there are none, and only a call for no variables succeeds.
//!
//! A call sets all of its variables or none.

#![allow(non_snake_case)]

use super::functions;
use super::types::{Binary, Bool, FmiString, Instance, Status, ValueReference};
use super::values::{self, addressing, check_kind, check_scalars, may_read, may_set, wrong_type};
use crate::both_versions::variables::{Array, get, get_strings, none, set, set_strings};
use crate::instance::{self, Failure};
use brinell::simulation::VariableError;
use brinell::simulation::interface::table::Kind;

/// Functions by what they do, their row of the table of modes, and what the model is asked for.
macro_rules! functions {
    ($($(#[$meaning:meta])* $access:ident $name:ident($values:ty) $row:ident $body:expr;)*) => {$(
        $(#[$meaning])*
        ///
        /// # Safety
        /// `valueReferences` and `values` are null, or point to as many elements as said; strings are null or end in
        /// NUL.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: Instance,
            valueReferences: *const ValueReference,
            nValueReferences: usize,
            values: $values,
            nValues: usize,
        ) -> Status {
            let references = Array { name: "valueReferences", pointer: valueReferences, count: nValueReferences };
            let values = Array { name: "values", pointer: values, count: nValues };
            // SAFETY: this function's contract.
            unsafe { $access(instance, &functions::$row, references, values, $body) }
        }
    )*};
}

functions! {
    /// `fmi3GetFloat64`.
    get fmi3GetFloat64(*mut f64) GET_FLOAT64 |instance, references, values| {
        may_read(instance, references)?;
        values::read(instance, references, values)
    };
    /// `fmi3GetInt64`: enumerations, seeds, and in an FMU without arrays counters.
    get fmi3GetInt64(*mut i64) GET_INT64 |instance, references, values| {
        may_read(instance, references)?;
        let signed = addressing(instance)?.counts_signed();
        check_kind(instance, references, "Int64", if signed { is_whole } else { is_number })?;
        check_scalars(instance, references, values.len())?;
        for (value, reference) in values.iter_mut().zip(references) {
            let reference = std::slice::from_ref(reference);
            if check_kind(instance, reference, "Int64", is_counter).is_ok() {
                let mut count = [0];
                instance.simulation.counts(reference, &mut count)?;
                *value = i64::try_from(count[0]).unwrap_or(i64::MAX);
            } else {
                let mut number = [0];
                instance.simulation.integers(reference, &mut number)?;
                *value = number[0].into();
            }
        }
        Ok(())
    };
    /// `fmi3GetUInt64`: counters.
    get fmi3GetUInt64(*mut u64) GET_UINT64 |instance, references, values| {
        may_read(instance, references)?;
        let signed = addressing(instance)?.counts_signed();
        check_kind(instance, references, "UInt64", if signed { is_none } else { is_counter })?;
        check_scalars(instance, references, values.len())?;
        Ok(instance.simulation.counts(references, values)?)
    };
    /// `fmi3GetString`. The strings stay valid until the next call of this function on the instance.
    get_strings fmi3GetString(*mut FmiString) GET_STRING |instance, references, count| {
        may_read(instance, references)?;
        check_kind(instance, references, "String", is_text)?;
        check_scalars(instance, references, count)?;
        Ok(instance.simulation.strings(references)?)
    };
    /// `fmi3SetFloat64`.
    set fmi3SetFloat64(*const f64) SET_FLOAT64 |instance, references, values| {
        may_set(instance, references)?;
        values::set(instance, references, values)
    };
    /// `fmi3SetInt64`: enumerations and seeds.
    set fmi3SetInt64(*const i64) SET_INT64 |instance, references, values| {
        may_set(instance, references)?;
        check_kind(instance, references, "Int64", is_number)?;
        check_scalars(instance, references, values.len())?;
        let numbers = references.iter().zip(values).map(|(&reference, &value)| {
            // What an i32 cannot hold is no number of any of them.
            i32::try_from(value).map_err(|_| out_of_range(&instance.simulation, reference, value))
        });
        let numbers: Vec<i32> = numbers.collect::<Result<_, _>>()?;
        Ok(instance.simulation.set_integers(references, &numbers)?)
    };
    /// `fmi3SetUInt64`: counters are computed, so only no variables at all succeed.
    set fmi3SetUInt64(*const u64) SET_UINT64 |instance, references, values| {
        may_set(instance, references)?;
        check_kind(instance, references, "UInt64", is_counter)?;
        check_scalars(instance, references, values.len())?;
        match references.first() {
            None => Ok(()),
            // It says that they are computed.
            Some(&counter) => Ok(instance.simulation.set_integers(&[counter], &[0])?),
        }
    };
    /// `fmi3SetString`. The strings are copied.
    set_strings fmi3SetString(*const FmiString) SET_STRING |instance, references, texts| {
        may_set(instance, references)?;
        check_kind(instance, references, "String", is_text)?;
        check_scalars(instance, references, texts.len())?;
        Ok(instance.simulation.set_strings(references, texts)?)
    };
}

/// Functions for types of which there are no variables, by the name that the standard gives the type.
macro_rules! absent {
    ($($wanted:literal: $get:ident($($read:ty),*), $set:ident($($write:ty),*);)*) => {$(
        absent!($get($($read),*), functions::reading, may_read, $wanted);
        absent!($set($($write),*), functions::setting, may_set, $wanted);
    )*};
    ($name:ident($($argument:ty),*), $row:path, $may:ident, $wanted:literal) => {
        /// There are no variables of this type.
        ///
        /// # Safety
        /// `valueReferences` is null, or points to `nValueReferences` elements; the rest is not read.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: Instance,
            valueReferences: *const ValueReference,
            nValueReferences: usize,
            $(_: $argument),*
        ) -> Status {
            const FUNCTION: &instance::Function = &$row(stringify!($name));
            let references = Array { name: "valueReferences", pointer: valueReferences, count: nValueReferences };
            let refusal = |instance: &instance::Instance, references: &[ValueReference]| {
                $may(instance, references)?;
                none_of(instance, references, $wanted)
            };
            // SAFETY: this function's contract.
            unsafe { none(instance, FUNCTION, references, refusal) }
        }
    };
}

absent! {
    "Float32": fmi3GetFloat32(*mut f32, usize), fmi3SetFloat32(*const f32, usize);
    "Int8": fmi3GetInt8(*mut i8, usize), fmi3SetInt8(*const i8, usize);
    "UInt8": fmi3GetUInt8(*mut u8, usize), fmi3SetUInt8(*const u8, usize);
    "Int16": fmi3GetInt16(*mut i16, usize), fmi3SetInt16(*const i16, usize);
    "UInt16": fmi3GetUInt16(*mut u16, usize), fmi3SetUInt16(*const u16, usize);
    "Int32": fmi3GetInt32(*mut i32, usize), fmi3SetInt32(*const i32, usize);
    "UInt32": fmi3GetUInt32(*mut u32, usize), fmi3SetUInt32(*const u32, usize);
    "Boolean": fmi3GetBoolean(*mut Bool, usize), fmi3SetBoolean(*const Bool, usize);
    "Binary": fmi3GetBinary(*mut usize, *mut Binary, usize), fmi3SetBinary(*const usize, *const Binary, usize);
    "Clock": fmi3GetClock(*mut Bool), fmi3SetClock(*const Bool);
}

/// Refuses any variable, for it has another type.
fn none_of(instance: &instance::Instance, references: &[ValueReference], wanted: &'static str) -> Result<(), Failure> {
    match references {
        [] => Ok(()),
        [first, ..] => Err(wrong_type(instance, *first, wanted)?),
    }
}

fn is_number(kind: &Kind) -> bool {
    matches!(kind, Kind::Enumeration { .. } | Kind::Whole { .. })
}

fn is_counter(kind: &Kind) -> bool {
    *kind == Kind::Integer
}

fn is_whole(kind: &Kind) -> bool {
    is_number(kind) || is_counter(kind)
}

fn is_none(_: &Kind) -> bool {
    false
}

fn is_text(kind: &Kind) -> bool {
    matches!(kind, Kind::Text { .. })
}

fn out_of_range(simulation: &brinell::simulation::Simulation, reference: u32, value: i64) -> VariableError {
    match simulation.variable(reference) {
        Ok(variable) => {
            let [min, max] = match variable.kind {
                Kind::Enumeration { items, .. } => [1.0, items.len() as f64],
                _ => [0.0, i32::MAX.into()],
            };
            VariableError::OutOfRange { name: variable.name.clone(), value: value as f64, min, max }
        }
        Err(error) => error,
    }
}
