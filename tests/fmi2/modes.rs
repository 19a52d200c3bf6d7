//! In which mode each function may be called.

use crate::two::Host;
use brinell_fmi::fmi2::*;
use std::ptr;

type Probe = (&'static str, &'static str, fn(&Host) -> Status);

/// Calls every function that takes an instance, in a way that succeeds or is at most discarded where the function is
/// allowed. The letters are the modes of the table in section 4.2.4 of the standard: Instantiated, initialiZation,
/// step Complete, Terminated, Error; written down here a second time, from the standard.
// SAFETY of all the blocks: nothing but the handle, NULL with a count of 0, and pointers to one value are passed.
const PROBES: &[Probe] = &[
    ("fmi2SetDebugLogging", "IZCTE", |h| unsafe { fmi2SetDebugLogging(h.c, TRUE, 0, ptr::null()) }),
    ("fmi2SetupExperiment", "I", |h| h.setup(None, 0.0, None)),
    ("fmi2EnterInitializationMode", "I", |h| {
        // Right only after an experiment has been set up, which the fixture does.
        h.enter()
    }),
    ("fmi2ExitInitializationMode", "Z", |h| h.exit()),
    ("fmi2Terminate", "C", |h| h.terminate()),
    ("fmi2Reset", "IZCTE", |h| h.reset()),
    ("fmi2GetReal", "ZCTE", |h| unsafe { fmi2GetReal(h.c, ptr::null(), 0, ptr::null_mut()) }),
    ("fmi2GetInteger", "ZCTE", |h| unsafe { fmi2GetInteger(h.c, ptr::null(), 0, ptr::null_mut()) }),
    ("fmi2GetBoolean", "ZCTE", |h| unsafe { fmi2GetBoolean(h.c, ptr::null(), 0, ptr::null_mut()) }),
    ("fmi2GetString", "ZCTE", |h| unsafe { fmi2GetString(h.c, ptr::null(), 0, ptr::null_mut()) }),
    ("fmi2SetReal", "IZC", |h| unsafe { fmi2SetReal(h.c, ptr::null(), 0, ptr::null()) }),
    ("fmi2SetInteger", "IZC", |h| unsafe { fmi2SetInteger(h.c, ptr::null(), 0, ptr::null()) }),
    ("fmi2SetBoolean", "IZC", |h| unsafe { fmi2SetBoolean(h.c, ptr::null(), 0, ptr::null()) }),
    ("fmi2SetString", "IZC", |h| unsafe { fmi2SetString(h.c, ptr::null(), 0, ptr::null()) }),
    ("fmi2GetFMUstate", "IZCTE", |h| {
        let mut state = ptr::null_mut();
        unsafe { fmi2GetFMUstate(h.c, &raw mut state) }
    }),
    ("fmi2FreeFMUstate", "IZCTE", |h| unsafe { fmi2FreeFMUstate(h.c, ptr::null_mut()) }),
    ("fmi2SetRealInputDerivatives", "IZC", |h| unsafe {
        fmi2SetRealInputDerivatives(h.c, ptr::null(), 0, ptr::null(), ptr::null())
    }),
    ("fmi2DoStep", "C", |h| h.step(0.0, 1e-5)),
    ("fmi2CancelStep", "", |h| unsafe { fmi2CancelStep(h.c) }),
    ("fmi2GetStatus", "CT", |h| {
        let mut value = Status::Fatal;
        unsafe { fmi2GetStatus(h.c, DO_STEP_STATUS, &raw mut value) }
    }),
    ("fmi2GetRealStatus", "CT", |h| {
        let mut value = 0.0;
        unsafe { fmi2GetRealStatus(h.c, LAST_SUCCESSFUL_TIME, &raw mut value) }
    }),
    ("fmi2GetIntegerStatus", "CT", |h| {
        let mut value = 0;
        unsafe { fmi2GetIntegerStatus(h.c, DO_STEP_STATUS, &raw mut value) }
    }),
    ("fmi2GetBooleanStatus", "CT", |h| {
        let mut value = 0;
        unsafe { fmi2GetBooleanStatus(h.c, TERMINATED, &raw mut value) }
    }),
    ("fmi2GetStringStatus", "CT", |h| {
        let mut value = ptr::null();
        unsafe { fmi2GetStringStatus(h.c, PENDING_STATUS, &raw mut value) }
    }),
];

fn in_mode(mode: char) -> Host {
    let host = Host::of("6205-healthy");
    assert_eq!(host.setup(None, 0.0, None), Status::Ok);
    if mode != 'I' {
        assert_eq!(host.enter(), Status::Ok);
    }
    if "CTE".contains(mode) {
        assert_eq!(host.exit(), Status::Ok);
    }
    match mode {
        'T' => assert_eq!(host.terminate(), Status::Ok),
        'E' => assert_eq!(host.step(0.0, -1.0), Status::Error),
        _ => {}
    }
    host.lines();
    host
}

#[test]
fn every_function_is_allowed_in_the_modes_of_the_standards_table_and_in_no_other() {
    for (name, allowed, probe) in PROBES {
        for mode in "IZCTE".chars() {
            let host = in_mode(mode);
            let status = probe(&host);
            let lines = host.lines();
            if allowed.contains(mode) {
                assert!(status <= Status::Discard, "{name} in {mode}: {lines:?}");
            } else {
                assert_eq!(status, Status::Error, "{name} in {mode}");
                let line = lines.last().unwrap();
                assert!(line.message.starts_with(name) && line.message.contains("not allowed in mode"), "{line:?}");
            }
        }
    }
}

#[test]
fn saved_states_may_be_handled_in_every_mode() {
    for mode in "IZCTE".chars() {
        let host = in_mode(mode);
        let state = host.save();
        let bytes = host.serialize(state);
        let copy = host.deserialize(&bytes).unwrap();
        assert_eq!(host.restore(copy), Status::Ok, "{mode}");
        // The mode came back with the state.
        assert_eq!(host.enter() == Status::Ok, mode == 'I');
    }
}

#[test]
fn after_an_error_only_reset_restore_free_and_reading_help() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    assert_eq!(host.step(0.5, 1e-4), Status::Error);
    assert_eq!(host.step(0.0, 1e-4), Status::Error);
    assert_eq!(host.set(&[0], &[1.0]), Status::Error);
    assert!(host.get(&host.reals()).is_ok());
    assert_eq!(host.restore(state), Status::Ok);
    assert_eq!(host.step(0.0, 1e-4), Status::Ok);

    assert_eq!(host.step(0.5, 1e-4), Status::Error);
    assert_eq!(host.reset(), Status::Ok);
    host.start();
    assert_eq!(host.step(0.0, 1e-4), Status::Ok);
}

#[test]
fn initialization_needs_an_experiment_first() {
    let host = Host::of("er16k-tb1");
    assert_eq!(host.enter(), Status::Error);
    assert!(host.lines().last().unwrap().message.contains("fmi2SetupExperiment"));
}

#[test]
fn a_reset_instance_runs_like_a_new_one_to_the_bit() {
    let run = |host: &Host| {
        host.start();
        for n in 0..20 {
            assert_eq!(host.step(f64::from(n) * 1e-4, 1e-4), Status::Ok);
        }
        crate::two::bits(&host.get(&host.reals()).unwrap())
    };
    let host = Host::of("er16k-tb1");
    let first = run(&host);
    assert_eq!(host.reset(), Status::Ok);
    let slip = host.reference("cage.slip");
    assert_eq!(host.set(&[slip], &[0.5]), Status::Ok);
    assert_ne!(run(&host), first);
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(run(&host), first);
}

#[test]
fn cancelling_a_step_is_an_error_that_says_why() {
    let host = Host::started("er16k-tb1");
    // SAFETY: any handle may be passed.
    assert_eq!(unsafe { fmi2CancelStep(host.c) }, Status::Error);
    assert!(host.lines().last().unwrap().message.contains("no step runs in the background"));
}

#[test]
fn the_functions_of_model_exchange_are_errors_that_name_the_right_one() {
    // SAFETY of all the blocks: the arguments are not read.
    let probes: [Probe; 10] = [
        ("fmi2EnterEventMode", "", |h| unsafe { fmi2EnterEventMode(h.c) }),
        ("fmi2NewDiscreteStates", "", |h| unsafe { fmi2NewDiscreteStates(h.c, ptr::null_mut()) }),
        ("fmi2EnterContinuousTimeMode", "", |h| unsafe { fmi2EnterContinuousTimeMode(h.c) }),
        ("fmi2CompletedIntegratorStep", "", |h| unsafe {
            fmi2CompletedIntegratorStep(h.c, TRUE, ptr::null_mut(), ptr::null_mut())
        }),
        ("fmi2SetTime", "", |h| unsafe { fmi2SetTime(h.c, 0.0) }),
        ("fmi2SetContinuousStates", "", |h| unsafe { fmi2SetContinuousStates(h.c, ptr::null(), 3) }),
        ("fmi2GetDerivatives", "", |h| unsafe { fmi2GetDerivatives(h.c, ptr::null_mut(), 3) }),
        ("fmi2GetEventIndicators", "", |h| unsafe { fmi2GetEventIndicators(h.c, ptr::null_mut(), 0) }),
        ("fmi2GetContinuousStates", "", |h| unsafe { fmi2GetContinuousStates(h.c, ptr::null_mut(), 3) }),
        ("fmi2GetNominalsOfContinuousStates", "", |h| unsafe {
            fmi2GetNominalsOfContinuousStates(h.c, ptr::null_mut(), 3)
        }),
    ];
    let host = Host::started("6205-healthy");
    let state = host.save();
    for (name, _, probe) in probes {
        host.lines();
        assert_eq!(probe(&host), Status::Error, "{name}");
        let line = host.lines().pop().unwrap();
        assert!(line.message.starts_with(name) && line.message.contains("fmi2DoStep"), "{line:?}");
        assert_eq!(host.restore(state), Status::Ok);
    }
    // SAFETY: a handle that is not one.
    assert_eq!(unsafe { fmi2SetTime(ptr::null_mut(), 0.0) }, Status::Error);
}
