//! The exported functions that begin and arrange the life of an instance.

#![allow(non_snake_case)]

use std::ffi::CStr;
use std::slice;

use super::functions;
use super::types::{
    Bool, ClockUpdateCallback, FALSE, FmiString, Instance, InstanceEnvironment, IntermediateUpdateCallback,
    LogMessageCallback, PreemptionCallback, Status, ValueReference,
};
use crate::c_interface::{Logger, uri};
use crate::instance::{Addressing, Clock, IntermediateUpdates, Listing, Mode};
use crate::instantiation::{Refusal, text};
use crate::resources::SharedModel;
use crate::{boundary, instance, instantiation};

/// `fmi3GetVersion`: "3.0".
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> FmiString {
    c"3.0".as_ptr()
}

/// `fmi3InstantiateCoSimulation`: a new instance, or NULL after a line to the logger. `visible` is ignored: there is
/// nothing to see. `eventModeUsed` must be false, for there is no event mode.
///
/// # Safety
/// Pointers are null or as FMI 3.0 describes them: strings end in NUL, `requiredIntermediateVariables` points to as
/// many references as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    instanceName: FmiString,
    instantiationToken: FmiString,
    resourcePath: FmiString,
    _visible: Bool,
    loggingOn: Bool,
    eventModeUsed: Bool,
    earlyReturnAllowed: Bool,
    requiredIntermediateVariables: *const ValueReference,
    nRequiredIntermediateVariables: usize,
    instanceEnvironment: InstanceEnvironment,
    logMessage: Option<LogMessageCallback>,
    intermediateUpdate: Option<IntermediateUpdateCallback>,
) -> Instance {
    // SAFETY: null or ended by NUL, by this function's contract.
    let [name, token, path] = unsafe { [text(instanceName), text(instantiationToken), text(resourcePath)] };
    instantiation::instantiate(
        "fmi3InstantiateCoSimulation",
        name,
        |name| Some(Logger::plain(logMessage, instanceEnvironment, name, loggingOn != FALSE)),
        || {
            if eventModeUsed != FALSE {
                return Err(Refusal::NotProvided("has no event mode: eventModeUsed must be fmi3False"));
            }
            model(token, path)
        },
        |instance| {
            // SAFETY: this function's contract.
            let required = unsafe { references(requiredIntermediateVariables, nRequiredIntermediateVariables)? };
            let early_return = earlyReturnAllowed != FALSE;
            instance.addressing = Some(addressing(instance, path));
            instance.updates = updates(instance, required, intermediateUpdate, instanceEnvironment, early_return)?;
            Ok(())
        },
    )
}

fn model(token: Option<&CStr>, path: Option<&CStr>) -> Result<SharedModel, Refusal> {
    let token = token.ok_or(Refusal::NoToken("instantiation token"))?;
    let path = path.ok_or(Refusal::NoResources(
        "resourcePath is NULL: pass the path of the unpacked directory \"resources\", which this FMU reads",
    ))?;
    instantiation::model("instantiation token", token, uri::plain_path(path.to_bytes())?)
}

/// Whether the resources at a path are marked by a word.
fn is_marked(path: Option<&CStr>, word: &str) -> bool {
    let directory = path.and_then(|path| uri::plain_path(path.to_bytes()).ok());
    directory.is_some_and(|directory| instantiation::is_marked(&directory, word))
}

/// # Safety
/// If the pointer is neither null nor misaligned, it points to as many references.
unsafe fn references<'a>(pointer: *const ValueReference, count: usize) -> Result<&'a [ValueReference], Refusal> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(Refusal::Array("requiredIntermediateVariables", count));
    }
    // SAFETY: not null and aligned; the rest is the contract.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// What references stand for in the FMU at a path, of whichever kind the instance is.
fn addressing(instance: &instance::Instance, path: Option<&CStr>) -> Addressing {
    let [exchange, scalars] = [instantiation::MODEL_EXCHANGE, instantiation::SCALARS].map(|word| is_marked(path, word));
    Addressing::of(&instance.simulation, Listing { exchange, scalars })
}

/// What the host wants of intermediate updates.
fn updates(
    instance: &instance::Instance,
    required: &[ValueReference],
    callback: Option<IntermediateUpdateCallback>,
    environment: InstanceEnvironment,
    early_return: bool,
) -> Result<Option<IntermediateUpdates>, Refusal> {
    let (simulation, addressing) = (&instance.simulation, instance.addressing.as_ref());
    let is_possible =
        |reference: &&u32| addressing.is_some_and(|addressing| addressing.is_intermediate(simulation, **reference));
    if let Some(&impossible) = required.iter().find(|reference| !is_possible(reference)) {
        return Err(Refusal::NotIntermediate(impossible));
    }
    let mut sorted = required.to_vec();
    sorted.sort_unstable();
    match callback {
        Some(callback) => Ok(Some(IntermediateUpdates {
            callback,
            environment,
            early_return,
            with_inputs: sorted.iter().any(|&reference| Addressing::is_input(simulation, reference)),
            required: sorted,
            may_set: false,
            failed: false,
        })),
        None if required.is_empty() => Ok(None),
        None => Err(Refusal::NoCallback),
    }
}

/// `fmi3InstantiateModelExchange`: a new instance, or NULL after a line to the logger, also where the FMU is for
/// co-simulation alone.
///
/// # Safety
/// Pointers are null or as FMI 3.0 describes them: strings end in NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    instanceName: FmiString,
    instantiationToken: FmiString,
    resourcePath: FmiString,
    _visible: Bool,
    loggingOn: Bool,
    instanceEnvironment: InstanceEnvironment,
    logMessage: Option<LogMessageCallback>,
) -> Instance {
    // SAFETY: null or ended by NUL, by this function's contract.
    let [name, token, path] = unsafe { [text(instanceName), text(instantiationToken), text(resourcePath)] };
    instantiation::instantiate(
        "fmi3InstantiateModelExchange",
        name,
        |name| Some(Logger::plain(logMessage, instanceEnvironment, name, loggingOn != FALSE)),
        || {
            if !is_marked(path, instantiation::MODEL_EXCHANGE) {
                return Err(Refusal::NotProvided(CO_SIMULATION));
            }
            model(token, path)
        },
        |instance| {
            instance.exchange = true;
            instance.addressing = Some(addressing(instance, path));
            Ok(())
        },
    )
}

const CO_SIMULATION: &str = "is for co-simulation: use fmi3InstantiateCoSimulation";

/// `fmi3InstantiateScheduledExecution`: NULL after a line to the logger, for this FMU is for co-simulation.
///
/// # Safety
/// Pointers are null or as FMI 3.0 describes them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    instanceName: FmiString,
    _instantiationToken: FmiString,
    _resourcePath: FmiString,
    _visible: Bool,
    loggingOn: Bool,
    instanceEnvironment: InstanceEnvironment,
    logMessage: Option<LogMessageCallback>,
    _clockUpdate: Option<ClockUpdateCallback>,
    _lockPreemption: Option<PreemptionCallback>,
    _unlockPreemption: Option<PreemptionCallback>,
) -> Instance {
    // SAFETY: this function's contract.
    let name = unsafe { text(instanceName) };
    let logger = |name| Some(Logger::plain(logMessage, instanceEnvironment, name, loggingOn != FALSE));
    let refusal = || Err(Refusal::NotProvided(CO_SIMULATION));
    instantiation::instantiate("fmi3InstantiateScheduledExecution", name, logger, refusal, |_| Ok(()))
}

/// `fmi3EnterInitializationMode`: start, stop and tolerance. A tolerance can only tighten the one in force
/// (`solver.tolerance`); to loosen it, set `solver.tolerance`.
///
/// # Safety
/// `instance` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: Instance,
    toleranceDefined: Bool,
    tolerance: f64,
    startTime: f64,
    stopTimeDefined: Bool,
    stopTime: f64,
) -> Status {
    boundary::call(instance, &functions::ENTER_INITIALIZATION_MODE, |instance| {
        let clock = Clock::new(startTime, (stopTimeDefined != FALSE).then_some(stopTime))?;
        if toleranceDefined != FALSE {
            instance.tighten(tolerance)?;
        }
        instance.clock = Some(clock);
        instance.enter(Mode::Initialization, &functions::ENTER_INITIALIZATION_MODE);
        Ok(())
    })
}
