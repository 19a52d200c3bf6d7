//! In which mode each function may be called.

use crate::both::{self, MODES, Probe, in_mode, probes};
use crate::two::{Host, Two};
use brinell_fmi::fmi2::*;
use std::ptr;

/// Calls of every function that takes an instance, in a way that succeeds or is at most discarded where the function is
/// allowed. The letters are the modes of the table in section 4.2.4 of the standard, written down here a second time.
const PROBES: &[Probe] = &probes! {
    fmi2SetDebugLogging "IZCTE" (TRUE, 0, ptr::null());
    fmi2SetupExperiment "I" (FALSE, 0.0, 0.0, FALSE, 0.0);
    fmi2EnterInitializationMode "I" ();
    fmi2ExitInitializationMode "Z" ();
    fmi2Terminate "C" ();
    fmi2Reset "IZCTE" ();
    fmi2GetReal "ZCTE" (ptr::null(), 0, ptr::null_mut());
    fmi2GetInteger "ZCTE" (ptr::null(), 0, ptr::null_mut());
    fmi2GetBoolean "ZCTE" (ptr::null(), 0, ptr::null_mut());
    fmi2GetString "ZCTE" (ptr::null(), 0, ptr::null_mut());
    fmi2SetReal "IZC" (ptr::null(), 0, ptr::null());
    fmi2SetInteger "IZC" (ptr::null(), 0, ptr::null());
    fmi2SetBoolean "IZC" (ptr::null(), 0, ptr::null());
    fmi2SetString "IZC" (ptr::null(), 0, ptr::null());
    fmi2GetFMUstate "IZCTE" (&mut ptr::null_mut());
    fmi2FreeFMUstate "IZCTE" (ptr::null_mut());
    fmi2SetRealInputDerivatives "IZC" (ptr::null(), 0, ptr::null(), ptr::null());
    fmi2DoStep "C" (0.0, 1e-5, TRUE);
    fmi2CancelStep "" ();
    fmi2GetStatus "CT" (DO_STEP_STATUS, &mut Status::Fatal);
    fmi2GetRealStatus "CT" (LAST_SUCCESSFUL_TIME, &mut 0.0);
    fmi2GetIntegerStatus "CT" (DO_STEP_STATUS, &mut 0);
    fmi2GetBooleanStatus "CT" (TERMINATED, &mut 0);
    fmi2GetStringStatus "CT" (PENDING_STATUS, &mut ptr::null());
};

/// Initialization is right only after that.
fn experiment(host: &Host) {
    assert_eq!(host.setup(None, 0.0, None), Status::Ok);
}

#[test]
fn every_function_is_allowed_in_the_modes_of_the_standards_table_and_in_no_other() {
    both::allowed_in_their_modes(PROBES, experiment, |_, _, _| {});
}

#[test]
fn saved_states_may_be_handled_in_every_mode() {
    for mode in MODES.chars() {
        let host = in_mode(mode, experiment);
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
    both::runs_anew_after_a_reset::<Two>();
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
    let probes = probes! {
        fmi2EnterEventMode "fmi2DoStep" ();
        fmi2NewDiscreteStates "fmi2DoStep" (ptr::null_mut());
        fmi2EnterContinuousTimeMode "fmi2DoStep" ();
        fmi2CompletedIntegratorStep "fmi2DoStep" (TRUE, ptr::null_mut(), ptr::null_mut());
        fmi2SetTime "fmi2DoStep" (0.0);
        fmi2SetContinuousStates "fmi2DoStep" (ptr::null(), 3);
        fmi2GetDerivatives "fmi2DoStep" (ptr::null_mut(), 3);
        fmi2GetEventIndicators "fmi2DoStep" (ptr::null_mut(), 0);
        fmi2GetContinuousStates "fmi2DoStep" (ptr::null_mut(), 3);
        fmi2GetNominalsOfContinuousStates "fmi2DoStep" (ptr::null_mut(), 3);
    };
    both::refuse(&Host::started("6205-healthy"), &probes);
    // SAFETY: a handle that is not one.
    assert_eq!(unsafe { fmi2SetTime(ptr::null_mut(), 0.0) }, Status::Error);
}
