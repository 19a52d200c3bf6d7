//! The exported functions that read and set variables of types of which Brinell has none: only a call for no variables
//! succeeds.

#![allow(non_snake_case)]

use super::functions::{reading, setting};
use super::types::{Binary, Bool, Instance, Status, ValueReference};
use super::values::{may_read, may_set, wrong_type};
use crate::arguments::array;
use crate::instance::{Failure, Function};
use crate::{boundary, instance};

/// Refuses any variable, for it has another type.
fn none_of(instance: &instance::Instance, references: &[ValueReference], wanted: &'static str) -> Result<(), Failure> {
    match references {
        [] => Ok(()),
        [first, ..] => Err(wrong_type(instance, *first, wanted)?),
    }
}

macro_rules! absent {
    ($($wanted:literal: $get:ident($($read:ty),*), $set:ident($($write:ty),*);)*) => {$(
        /// There are no variables of this type.
        ///
        /// # Safety
        /// `valueReferences` is null, or points to `nValueReferences` elements; the rest is not read.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $get(
            instance: Instance,
            valueReferences: *const ValueReference,
            nValueReferences: usize,
            $(_: $read),*
        ) -> Status {
            const FUNCTION: &Function = &reading(stringify!($get));
            boundary::call(instance, FUNCTION, |instance| {
                // SAFETY: this function's contract; null is refused.
                let references = unsafe { array("valueReferences", valueReferences, nValueReferences)? };
                may_read(instance, references)?;
                none_of(instance, references, $wanted)
            })
        }

        /// There are no variables of this type.
        ///
        /// # Safety
        /// `valueReferences` is null, or points to `nValueReferences` elements; the rest is not read.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set(
            instance: Instance,
            valueReferences: *const ValueReference,
            nValueReferences: usize,
            $(_: $write),*
        ) -> Status {
            const FUNCTION: &Function = &setting(stringify!($set));
            boundary::call(instance, FUNCTION, |instance| {
                // SAFETY: this function's contract; null is refused.
                let references = unsafe { array("valueReferences", valueReferences, nValueReferences)? };
                may_set(instance, references)?;
                none_of(instance, references, $wanted)
            })
        }
    )*};
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
