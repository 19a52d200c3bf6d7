//! The exported function that steps through time.

#![allow(non_snake_case)]

use super::functions;
use super::types::{Bool, FALSE, Instance, Status};
use crate::arguments::store;
use crate::instance::Failure;
use crate::{boundary, intermediate};

/// `fmi3DoStep`: advances from a communication point by a step of any positive size. It ends early only where the host
/// asks for it in an intermediate update; it never needs events handled and never ends the run.
///
/// `noSetFMUStatePriorToCurrentPoint` is accepted and not needed: saved states are the host's to free.
///
/// # Safety
/// The pointers are null, or point to one value each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: Instance,
    currentCommunicationPoint: f64,
    communicationStepSize: f64,
    _noSetFMUStatePriorToCurrentPoint: Bool,
    eventHandlingNeeded: *mut Bool,
    terminateSimulation: *mut Bool,
    earlyReturn: *mut Bool,
    lastSuccessfulTime: *mut f64,
) -> Status {
    boundary::call_lending(instance, &functions::DO_STEP, |instance| {
        let before = instance.clock.ok_or(Failure::NotSetUp)?.time;
        // SAFETY: this function's contract; null and misaligned pointers are refused, and before anything is done.
        unsafe {
            store("eventHandlingNeeded", eventHandlingNeeded, FALSE)?;
            store("terminateSimulation", terminateSimulation, FALSE)?;
            store("earlyReturn", earlyReturn, FALSE)?;
            store("lastSuccessfulTime", lastSuccessfulTime, before)?;
        }
        let (time, early) = intermediate::take_step(instance, currentCommunicationPoint, communicationStepSize)?;
        // SAFETY: as above.
        unsafe {
            store("earlyReturn", earlyReturn, early.into())?;
            store("lastSuccessfulTime", lastSuccessfulTime, time)
        }
    })
}
