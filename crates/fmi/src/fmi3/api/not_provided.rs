//! The functions of capabilities that this FMU does not declare. The standard wants them exported, and recommends that
//! they say why they fail; nothing else may be relied on. They touch no argument.

#![allow(non_snake_case)]

use super::functions::ALWAYS;
use super::types::{Instance, IntervalQualifier, Status, ValueReference};
use crate::boundary;
use crate::instance::{Failure, Function, Version};

const EVENTS: &str = "has no event mode: modelDescription.xml says so with hasEventMode=\"false\"";
const STRUCTURE: &str = "has no structural parameters";
const CLOCKS: &str = "has no clocks";

macro_rules! not_provided {
    ($($why:ident: $($name:ident($($argument:ty),*))*;)*) => {$($(
        /// A function that is not provided: always an error.
        ///
        /// # Safety
        /// `instance` may be any value; the other arguments are not read.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: Instance, $(_: $argument),*) -> Status {
            const FUNCTION: &Function =
                &Function { name: stringify!($name), version: Version::Fmi3, allowed: ALWAYS };
            boundary::call(instance, FUNCTION, |_| Err(Failure::NotProvided($why)))
        }
    )*)*};
}

type References = *const ValueReference;

not_provided! {
    EVENTS:
        fmi3EnterStepMode()
        fmi3EvaluateDiscreteStates();
    STRUCTURE:
        fmi3EnterConfigurationMode()
        fmi3ExitConfigurationMode();
    CLOCKS:
        fmi3GetIntervalDecimal(References, usize, *mut f64, *mut IntervalQualifier)
        fmi3GetIntervalFraction(References, usize, *mut u64, *mut u64, *mut IntervalQualifier)
        fmi3GetShiftDecimal(References, usize, *mut f64)
        fmi3GetShiftFraction(References, usize, *mut u64, *mut u64)
        fmi3SetIntervalDecimal(References, usize, *const f64)
        fmi3SetIntervalFraction(References, usize, *const u64, *const u64)
        fmi3SetShiftDecimal(References, usize, *const f64)
        fmi3SetShiftFraction(References, usize, *const u64, *const u64)
        fmi3ActivateModelPartition(ValueReference, f64);
}
