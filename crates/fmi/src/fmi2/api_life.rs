//! The exported functions that begin, arrange and end the life of an instance.

#![allow(non_snake_case)]

use std::ffi::{CStr, CString, c_char};
use std::ptr;

use super::functions;
use super::types::{Boolean, CO_SIMULATION, CallbackFunctions, Component, FALSE, FmiString, FmuType, Real, Status};
use crate::arguments;
use crate::boundary;
use crate::clock::Clock;
use crate::failure::Failure;
use crate::handles;
use crate::instance::Instance;
use crate::logger::Logger;
use crate::mode::Mode;
use crate::resources::{self, ResourceError};
use crate::shared_models::SharedModel;
use brinell::simulation::variables::Kind;

/// Name by which the tolerance of the time integration is found in the variable table.
const TOLERANCE: &str = "solver.tolerance";

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

/// Why there is no instance.
#[derive(Debug, thiserror::Error)]
enum Refusal {
    #[error("the instance name is NULL or blank: give each instance a name")]
    Name,
    #[error("FMU type {0}: only co-simulation (1) is provided")]
    Type(FmuType),
    #[error("the GUID is NULL: pass the one of modelDescription.xml")]
    NoGuid,
    #[error(
        "GUID {given}: the resources have {own}. Model description, resources and binary must come from one FMU, \
         unpacked as it was built"
    )]
    Guid { given: String, own: String },
    #[error("the resource location is NULL: pass the URI of the unpacked directory \"resources\"")]
    NoResources,
    #[error(transparent)]
    Resources(#[from] ResourceError),
    #[error("too many instances are alive: free some")]
    TooMany,
    #[error("internal error: {0}. Please report it")]
    Panic(String),
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

    let outcome = boundary::guard(|| {
        let name = name.filter(|name| !name.to_bytes().trim_ascii().is_empty());
        // The logger needs a name even to say that there is none.
        let shown: CString = name.unwrap_or(c"(unnamed)").to_owned();
        let logger = Logger::new(&callbacks, shown, loggingOn != FALSE)?;
        let refused = match prepare(name.is_some(), fmuType, guid, location) {
            Ok(model) => {
                logger.line(Status::Ok, || "fmi2Instantiate: instantiated.".to_owned());
                match handles::insert(Box::new(Instance::new(model, logger))) {
                    Ok(component) => return Some(component),
                    Err(instance) => (Refusal::TooMany, instance.logger),
                }
            }
            Err(refusal) => (refusal, logger),
        };
        let (refusal, logger) = refused;
        logger.insist(Status::Error, format!("fmi2Instantiate: {refusal}."));
        None
    });
    match outcome {
        Ok(component) => component.unwrap_or(ptr::null_mut()),
        Err(panic) => {
            drop(boundary::guard(|| {
                if let Some(logger) = Logger::new(&callbacks, c"(unnamed)".to_owned(), true) {
                    logger.insist(Status::Error, format!("fmi2Instantiate: {}.", Refusal::Panic(panic)));
                }
            }));
            ptr::null_mut()
        }
    }
}

/// # Safety
/// `pointer` is null or points to a string ended by NUL that outlives the call.
unsafe fn text<'a>(pointer: *const c_char) -> Option<&'a CStr> {
    // SAFETY: not null; the rest is the contract.
    (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) })
}

/// What an instance is made of, if everything about it is in order.
fn prepare(
    named: bool,
    fmu_type: FmuType,
    guid: Option<&CStr>,
    location: Option<&CStr>,
) -> Result<SharedModel, Refusal> {
    if !named {
        return Err(Refusal::Name);
    }
    if fmu_type != CO_SIMULATION {
        return Err(Refusal::Type(fmu_type));
    }
    let guid = guid.ok_or(Refusal::NoGuid)?;
    let model = resources::load(location.ok_or(Refusal::NoResources)?)?;
    if guid.to_bytes() != model.guid().as_bytes() {
        return Err(Refusal::Guid { given: guid.to_string_lossy().into_owned(), own: model.guid().to_owned() });
    }
    Ok(model)
}

/// `fmi2FreeInstance`: ends an instance and frees its saved states. NULL and dead handles are ignored.
///
/// # Safety
/// `c` may be any value. The standard forbids a call while another one on the same instance runs; it is then ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: Component) {
    if let Ok(instance) = handles::borrow(c)
        && functions::FREE_INSTANCE.allowed.contains(instance.mode)
    {
        drop(boundary::guard(|| {
            let mut instance = handles::remove(instance);
            if let Err(failure) = instance.finish_recording("are lost") {
                instance.logger.insist(Status::Error, format!("fmi2FreeInstance: {failure}."));
            }
        }));
    }
}

/// `fmi2SetDebugLogging`: logging off, or on for the categories listed, an empty list meaning all. An unknown
/// category is a warning; the others are set.
///
/// # Safety
/// `categories` is null or points to `nCategories` strings, each null or ended by NUL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: Component,
    loggingOn: Boolean,
    nCategories: usize,
    categories: *const FmiString,
) -> Status {
    boundary::call(c, &functions::SET_DEBUG_LOGGING, |instance| {
        // SAFETY: this function's contract; null is refused.
        let pointers = unsafe { arguments::array("categories", categories, nCategories)? };
        let names = pointers
            .iter()
            // SAFETY: this function's contract; null is refused.
            .map(|pointer| unsafe { arguments::string("categories", *pointer) })
            .collect::<Result<Vec<_>, _>>()?;
        let switched = instance.logger.switch(loggingOn != FALSE, &names);
        switched.map_err(|name| Failure::UnknownCategory(name.to_owned()))
    })
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
            tighten(instance, tolerance)?;
        }
        instance.clock = Some(clock);
        Ok(())
    })
}

fn tighten(instance: &mut Instance, tolerance: f64) -> Result<(), Failure> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(Failure::Tolerance(tolerance));
    }
    let Some(variable) = instance.simulation.table().iter().find(|variable| variable.name == TOLERANCE) else {
        return Ok(());
    };
    let reference = variable.reference;
    let least = match variable.kind {
        Kind::Real { min: Some(min), .. } => min,
        _ => 0.0,
    };
    let mut present = [0.0];
    instance.simulation.reals(&[reference], &mut present)?;
    if tolerance < present[0] {
        instance.simulation.set_reals(&[reference], &[tolerance.max(least)])?;
    }
    Ok(())
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
        enter(instance, Mode::Initialization, "fmi2EnterInitializationMode");
        Ok(())
    })
}

/// `fmi2ExitInitializationMode`: finds the static equilibrium at the start time.
///
/// # Safety
/// `c` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: Component) -> Status {
    boundary::call(c, &functions::EXIT_INITIALIZATION_MODE, |instance| {
        let clock = instance.clock.ok_or(Failure::NotSetUp)?;
        instance.initialize(clock.start)?;
        enter(instance, Mode::StepComplete, "fmi2ExitInitializationMode");
        Ok(())
    })
}

/// `fmi2Terminate`: no more steps; results may still be read. A warning if the recording cannot be stored.
///
/// # Safety
/// `c` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(c: Component) -> Status {
    boundary::call(c, &functions::TERMINATE, |instance| {
        let finished = instance.finish_recording("stay in memory: fmi2FreeInstance and fmi2Reset try once more");
        enter(instance, Mode::Terminated, "fmi2Terminate");
        finished
    })
}

/// `fmi2Reset`: as after `fmi2Instantiate`. Saved states and the choice of log categories stay. A warning if samples of
/// the recording could not be stored: they are lost, the instance is as good as new.
///
/// # Safety
/// `c` may be any value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(c: Component) -> Status {
    boundary::call(c, &functions::RESET, |instance| {
        let unstored = instance.reset()?;
        enter(instance, Mode::Instantiated, "fmi2Reset");
        unstored.map_or(Ok(()), Err)
    })
}

fn enter(instance: &mut Instance, mode: Mode, function: &str) {
    instance.mode = mode;
    let line = || match instance.clock {
        Some(clock) => format!("{function}: {mode} at {:?} s.", clock.time),
        None => format!("{function}: {mode}."),
    };
    instance.logger.line(Status::Ok, line);
}
