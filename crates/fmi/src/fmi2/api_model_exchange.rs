//! The functions of model exchange, which this FMU does not provide.
//!
//! The standard asks a co-simulation FMU for none of them. Some importers (fmuloader 0.1) look up the functions of both
//! kinds when they load the binary, and fail if one is missing. So they are there, touch no argument and return
//! `fmi2Error`.

#![allow(non_snake_case)]

use super::functions::ALWAYS;
use super::types::{Boolean, Component, EventInfo, Real, Status};
use crate::boundary;
use crate::instance::{Failure, Function, Version};

macro_rules! not_provided {
    ($($name:ident($($argument:ty),*);)*) => {$(
        /// A function of model exchange: always an error.
        ///
        /// # Safety
        /// `c` may be any value; the other arguments are not read.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(c: Component, $(_: $argument),*) -> Status {
            const FUNCTION: &Function = &Function { name: stringify!($name), version: Version::Fmi2, allowed: ALWAYS };
            boundary::call(c, FUNCTION, |_| Err(Failure::ModelExchange))
        }
    )*};
}

not_provided! {
    fmi2EnterEventMode();
    fmi2NewDiscreteStates(*mut EventInfo);
    fmi2EnterContinuousTimeMode();
    fmi2CompletedIntegratorStep(Boolean, *mut Boolean, *mut Boolean);
    fmi2SetTime(Real);
    fmi2SetContinuousStates(*const Real, usize);
    fmi2GetDerivatives(*mut Real, usize);
    fmi2GetEventIndicators(*mut Real, usize);
    fmi2GetContinuousStates(*mut Real, usize);
    fmi2GetNominalsOfContinuousStates(*mut Real, usize);
}
