//! The exported functions that read and set variables.
//!
//! A call sets all of its variables or none. Brinell has no Boolean variables.

#![allow(non_snake_case)]

use super::functions;
use super::types::{Boolean, Component, FmiString, Integer, Real, Status, ValueReference};
use crate::both_versions::variables::{Array, get, get_strings, none, set, set_strings};
use crate::instance::{Failure, Instance, finite};

/// Refuses any variable, for there is none of this type.
fn no_boolean(instance: &Instance, references: &[ValueReference]) -> Result<(), Failure> {
    match references {
        [] => Ok(()),
        [first, ..] => Err(instance.wrong_type(*first, "Boolean").into()),
    }
}

/// Functions by what they do, their row of the table of modes, and what the model is asked for.
macro_rules! functions {
    ($($(#[$meaning:meta])* $access:ident $name:ident($values:ty) $row:ident $body:expr;)*) => {$(
        $(#[$meaning])*
        ///
        /// # Safety
        /// `vr` and `value` are null, or point to `nvr` elements each; strings are null or end in NUL.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            c: Component,
            vr: *const ValueReference,
            nvr: usize,
            value: $values,
        ) -> Status {
            let references = Array { name: "vr", pointer: vr, count: nvr };
            let values = Array { name: "value", pointer: value, count: nvr };
            // SAFETY: this function's contract.
            unsafe { functions!(@ $access, c, &functions::$row, references, values, $body) }
        }
    )*};
    (@ none, $c:expr, $row:expr, $references:expr, $values:expr, $body:expr) => {{
        // What a host says about values of which there are none does not matter.
        let _ = $values;
        none($c, $row, $references, $body)
    }};
    (@ $access:ident, $($argument:expr),*) => { $access($($argument),*) };
}

functions! {
    /// `fmi2GetReal`.
    get fmi2GetReal(*mut Real) GET_REAL |instance, references, values| {
        instance.reals(references, values)?;
        finite(&instance.simulation, references, values)
    };
    /// `fmi2GetInteger`: integers and enumerations.
    get fmi2GetInteger(*mut Integer) GET_INTEGER |instance, references, values| {
        Ok(instance.simulation.integers(references, values)?)
    };
    /// `fmi2GetBoolean`: there are no Boolean variables, so only `nvr` = 0 succeeds.
    none fmi2GetBoolean(*mut Boolean) GET_BOOLEAN no_boolean;
    /// `fmi2GetString`. The strings stay valid until the next call of this function on the instance.
    get_strings fmi2GetString(*mut FmiString) GET_STRING |instance, references, _| {
        Ok(instance.simulation.strings(references)?)
    };
    /// `fmi2SetReal`.
    set fmi2SetReal(*const Real) SET_REAL |instance, references, values| {
        instance.set_reals(references, values)
    };
    /// `fmi2SetInteger`: enumerations and the seed of an uneven cage.
    set fmi2SetInteger(*const Integer) SET_INTEGER |instance, references, values| {
        Ok(instance.simulation.set_integers(references, values)?)
    };
    /// `fmi2SetBoolean`: there are no Boolean variables, so only `nvr` = 0 succeeds.
    none fmi2SetBoolean(*const Boolean) SET_BOOLEAN no_boolean;
    /// `fmi2SetString`. The strings are copied.
    set_strings fmi2SetString(*const FmiString) SET_STRING |instance, references, texts| {
        Ok(instance.simulation.set_strings(references, texts)?)
    };
}
