//! The exported functions that begin and arrange the life of an instance.

#![allow(non_snake_case)]

use std::ffi::CStr;
use std::path::PathBuf;
use std::ptr;

use super::functions;
use super::types::{
    Boolean, CO_SIMULATION, CallbackFunctions, Component, FALSE, FmiString, FmuType, MODEL_EXCHANGE, Real, Status,
};
use crate::c_interface::{Logger, uri};
use crate::instance::{Clock, Failure, Mode};
use crate::instantiation::{Refusal, text};
use crate::{boundary, instantiation};

/// `fmi2GetTypesPlatform`: "default".
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> FmiString {
    c"default".as_ptr()
}

/// `fmi2GetVersion`: "2.0".
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> FmiString {
    c"2.0".as_ptr()
}

/// `fmi2Instantiate`: a new instance, or NULL after a line to the logger. `visible` is ignored: there is nothing to
/// see.
///
/// # Safety
/// Pointers are null or as FMI 2.0 describes them: strings end in NUL, `functions` points to the callbacks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instanceName: FmiString,
    fmuType: FmuType,
    fmuGUID: FmiString,
    fmuResourceLocation: FmiString,
    functions: *const CallbackFunctions,
    _visible: Boolean,
    loggingOn: Boolean,
) -> Component {
    if functions.is_null() || !functions.is_aligned() {
        return ptr::null_mut();
    }
    // SAFETY: not null and aligned; the host passes its callbacks (FMI 2.0, fmi2Instantiate). They are copied, for the
    // struct need not outlive the call.
    let callbacks = unsafe { functions.read() };
    // SAFETY: null or ended by NUL, by this function's contract.
    let [name, guid, location] = unsafe { [text(instanceName), text(fmuGUID), text(fmuResourceLocation)] };
    instantiation::instantiate(
        "fmi2Instantiate",
        name,
        |name| Logger::formatted(&callbacks, name, loggingOn != FALSE),
        || {
            if ![CO_SIMULATION, MODEL_EXCHANGE].contains(&fmuType) {
                return Err(Refusal::Type(fmuType));
            }
            let guid = guid.ok_or(Refusal::NoToken("GUID"))?;
            let resources = resources(location)?;
            if fmuType == MODEL_EXCHANGE && !instantiation::is_marked(&resources, instantiation::MODEL_EXCHANGE) {
                return Err(Refusal::Type(fmuType));
            }
            instantiation::model("GUID", guid, resources)
        },
        |instance| {
            instance.exchange = fmuType == MODEL_EXCHANGE;
            instance.lists_exchange = instantiation::is_marked(&resources(location)?, instantiation::MODEL_EXCHANGE);
            Ok(())
        },
    )
}

fn resources(location: Option<&CStr>) -> Result<PathBuf, Refusal> {
    let location = location.ok_or(Refusal::NoResources(
        "resource location is NULL: pass the URI of the unpacked directory \"resources\"",
    ))?;
    Ok(uri::path(location.to_bytes())?)
}

/// `fmi2SetupExperiment`: start, stop and tolerance.
///
/// A tolerance that the host defines can only tighten the one in force (`solver.tolerance`): hosts hand in their own
/// default without asking, and a scene's tolerance is chosen for its impacts. To loosen it, set `solver.tolerance`.
///
/// # Safety
/// `c` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: Component,
    toleranceDefined: Boolean,
    tolerance: Real,
    startTime: Real,
    stopTimeDefined: Boolean,
    stopTime: Real,
) -> Status {
    boundary::call(c, &functions::SETUP_EXPERIMENT, |instance| {
        let clock = Clock::new(startTime, (stopTimeDefined != FALSE).then_some(stopTime))?;
        if toleranceDefined != FALSE {
            instance.tighten(tolerance)?;
        }
        instance.clock = Some(clock);
        Ok(())
    })
}

/// `fmi2EnterInitializationMode`.
///
/// # Safety
/// `c` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: Component) -> Status {
    boundary::call(c, &functions::ENTER_INITIALIZATION_MODE, |instance| {
        if instance.clock.is_none() {
            return Err(Failure::NotSetUp);
        }
        instance.enter(Mode::Initialization, &functions::ENTER_INITIALIZATION_MODE);
        Ok(())
    })
}
