//! The functions of model exchange. In an instance for co-simulation they answer `fmi3Error`.

#![allow(non_snake_case)]

use super::functions::ALWAYS;
use super::types::{Bool, FALSE, Instance as Handle, Status};
use crate::arguments::{array, array_mut, store};
use crate::both_versions::exchange::{AT_ANY_TIME, Done, Instance};
use crate::instance::Mode::{ContinuousTime, Error, Event, Terminated};
use crate::instance::{Mode, Modes, PerItem, modes};

const COUNTED: Modes = modes([Mode::Instantiated, Mode::Initialization, Event, ContinuousTime, Terminated, Error]);

crate::both_versions::exchange::functions! {
    Fmi3, Handle;
    /// `fmi3EnterEventMode`.
    fmi3EnterEventMode() modes([ContinuousTime]), |instance: Instance, function| -> Done {
        instance.enter(Event, function);
        Ok(())
    };
    /// `fmi3UpdateDiscreteStates`: contacts at the end of their part of a defect enter the next one. Nothing is
    /// iterated.
    fmi3UpdateDiscreteStates(
        discreteStatesNeedUpdate: *mut Bool,
        terminateSimulation: *mut Bool,
        nominalsOfContinuousStatesChanged: *mut Bool,
        valuesOfContinuousStatesChanged: *mut Bool,
        nextEventTimeDefined: *mut Bool,
        nextEventTime: *mut f64
    ) modes([Event]), |instance: Instance, _, more, end, nominals, values, timed, time| -> Done {
        instance.handle_event()?;
        let names = [
            "discreteStatesNeedUpdate",
            "terminateSimulation",
            "nominalsOfContinuousStatesChanged",
            "valuesOfContinuousStatesChanged",
            "nextEventTimeDefined",
        ];
        for (name, pointer) in names.into_iter().zip([more, end, nominals, values, timed]) {
            // SAFETY: this function's contract; null and misaligned pointers are refused.
            unsafe { store(name, pointer, FALSE)? };
        }
        // SAFETY: as above.
        unsafe { store("nextEventTime", time, 0.0) }
    };
    /// `fmi3EnterContinuousTimeMode`.
    fmi3EnterContinuousTimeMode() modes([Event]), |instance: Instance, function| -> Done {
        instance.enter(ContinuousTime, function);
        Ok(())
    };
    /// `fmi3CompletedIntegratorStep`: neither an event nor the end is asked for.
    fmi3CompletedIntegratorStep(
        noSetFMUStatePriorToCurrentPoint: Bool,
        enterEventMode: *mut Bool,
        terminateSimulation: *mut Bool
    ) modes([ContinuousTime]), |instance: Instance, _, _: Bool, event, end| -> Done {
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe {
            store("enterEventMode", event, FALSE)?;
            store("terminateSimulation", end, FALSE)?;
        }
        instance.accept_states()
    };
    /// `fmi3SetTime`.
    fmi3SetTime(time: f64) modes([ContinuousTime]), |instance: Instance, _, time| -> Done { instance.set_time(time) };
    /// `fmi3SetContinuousStates`.
    fmi3SetContinuousStates(continuousStates: *const f64, nContinuousStates: usize) modes([ContinuousTime]),
        |instance: Instance, _, states, count| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.set_states(unsafe { array("continuousStates", states, count)? })
    };
    /// `fmi3GetContinuousStateDerivatives`.
    fmi3GetContinuousStateDerivatives(derivatives: *mut f64, nContinuousStates: usize) AT_ANY_TIME,
        |instance: Instance, _, values, count| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::Derivatives, unsafe { array_mut("derivatives", values, count)? })
    };
    /// `fmi3GetEventIndicators`.
    fmi3GetEventIndicators(eventIndicators: *mut f64, nEventIndicators: usize) AT_ANY_TIME,
        |instance: Instance, _, values, count| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::Indicators, unsafe { array_mut("eventIndicators", values, count)? })
    };
    /// `fmi3GetContinuousStates`.
    fmi3GetContinuousStates(continuousStates: *mut f64, nContinuousStates: usize) AT_ANY_TIME,
        |instance: Instance, _, values, count| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::States, unsafe { array_mut("continuousStates", values, count)? })
    };
    /// `fmi3GetNominalsOfContinuousStates`.
    fmi3GetNominalsOfContinuousStates(nominals: *mut f64, nContinuousStates: usize) AT_ANY_TIME,
        |instance: Instance, _, values, count| -> Done {
        // SAFETY: this function's contract; null and misaligned arrays are refused.
        instance.fill(PerItem::Nominals, unsafe { array_mut("nominals", values, count)? })
    };
    /// `fmi3GetNumberOfEventIndicators`.
    fmi3GetNumberOfEventIndicators(nEventIndicators: *mut usize) COUNTED, |instance: Instance, _, count| -> Done {
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe { store("nEventIndicators", count, instance.count_of(PerItem::Indicators)) }
    };
    /// `fmi3GetNumberOfContinuousStates`.
    fmi3GetNumberOfContinuousStates(nContinuousStates: *mut usize) COUNTED, |instance: Instance, _, count| -> Done {
        // SAFETY: this function's contract; null and misaligned pointers are refused.
        unsafe { store("nContinuousStates", count, instance.count_of(PerItem::States)) }
    };
}
