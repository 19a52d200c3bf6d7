//! The functions of model exchange. An FMU for co-simulation alone has them too, and they answer `fmi2Error`: some
//! importers (fmuloader 0.1) look up the functions of both kinds when they load the binary, and fail if one is missing.

#![allow(non_snake_case)]

use super::functions::ALWAYS;
use super::types::{Boolean, Component, EventInfo, FALSE, Real, Status};
use crate::arguments::{array, array_mut, store};
use crate::both_versions::exchange::{AT_ANY_TIME, Done, Instance};
use crate::instance::Mode::{ContinuousTime, Event, Instantiated};
use crate::instance::{PerItem, modes};

crate::both_versions::exchange::functions! {
    Fmi2, Component;
    /// `fmi2EnterEventMode`.
    fmi2EnterEventMode() modes([Event, ContinuousTime]), |instance: Instance, function| -> Done {
        instance.enter(Event, function);
        Ok(())
    };
    /// `fmi2NewDiscreteStates`: contacts at the end of their part of a defect enter the next one. Nothing is iterated.
    fmi2NewDiscreteStates(eventInfo: *mut EventInfo) modes([Event]), |instance: Instance, _, info| -> Done {
        instance.handle_event()?;
        let none = EventInfo {
            new_discrete_states_needed: FALSE,
            terminate_simulation: FALSE,
            nominals_of_continuous_states_changed: FALSE,
            values_of_continuous_states_changed: FALSE,
            next_event_time_defined: FALSE,
            next_event_time: 0.0,
        };
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe { store("eventInfo", info, none) }
    };
    /// `fmi2EnterContinuousTimeMode`.
    fmi2EnterContinuousTimeMode() modes([Event]), |instance: Instance, function| -> Done {
        instance.enter(ContinuousTime, function);
        Ok(())
    };
    /// `fmi2CompletedIntegratorStep`: neither an event nor the end is asked for.
    fmi2CompletedIntegratorStep(
        noSetFMUStatePriorToCurrentPoint: Boolean,
        enterEventMode: *mut Boolean,
        terminateSimulation: *mut Boolean
    ) modes([ContinuousTime]), |instance: Instance, _, _: Boolean, event, end| -> Done {
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe {
            store("enterEventMode", event, FALSE)?;
            store("terminateSimulation", end, FALSE)?;
        }
        instance.accept_states()
    };
    /// `fmi2SetTime`.
    fmi2SetTime(time: Real) modes([Event, ContinuousTime]), |instance: Instance, _, time| -> Done {
        instance.set_time(time)
    };
    /// `fmi2SetContinuousStates`.
    fmi2SetContinuousStates(x: *const Real, nx: usize) modes([ContinuousTime]), |instance: Instance, _, x, nx| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.set_states(unsafe { array("x", x, nx)? })
    };
    /// `fmi2GetDerivatives`.
    fmi2GetDerivatives(derivatives: *mut Real, nx: usize) AT_ANY_TIME, |instance: Instance, _, values, nx| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::Derivatives, unsafe { array_mut("derivatives", values, nx)? })
    };
    /// `fmi2GetEventIndicators`.
    fmi2GetEventIndicators(eventIndicators: *mut Real, ni: usize) AT_ANY_TIME,
        |instance: Instance, _, values, ni| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::Indicators, unsafe { array_mut("eventIndicators", values, ni)? })
    };
    /// `fmi2GetContinuousStates`.
    fmi2GetContinuousStates(x: *mut Real, nx: usize) AT_ANY_TIME, |instance: Instance, _, values, nx| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::States, unsafe { array_mut("x", values, nx)? })
    };
    /// `fmi2GetNominalsOfContinuousStates`.
    fmi2GetNominalsOfContinuousStates(x_nominal: *mut Real, nx: usize) AT_ANY_TIME.and(Instantiated),
        |instance: Instance, _, values, nx| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::Nominals, unsafe { array_mut("x_nominal", values, nx)? })
    };
}
