//! In which mode each function may be called.

use crate::both::{self, Probe, probes};
use crate::three::{Host, Three};
use crate::two::Line;
use brinell_fmi::fmi3::*;
use std::ptr;

/// Calls with no variables. The letters are the modes of sections 2.3 and 4.2 of the standard, written down here a
/// second time.
const PROBES: &[Probe] = &probes! {
    fmi3SetDebugLogging "IZCTE" (TRUE, 0, ptr::null());
    fmi3EnterInitializationMode "I" (FALSE, 0.0, 0.0, FALSE, 0.0);
    fmi3ExitInitializationMode "Z" ();
    fmi3Terminate "C" ();
    fmi3Reset "IZCTE" ();
    fmi3GetFloat32 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetFloat64 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetInt8 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetUInt8 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetInt16 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetUInt16 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetInt32 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetUInt32 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetInt64 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetUInt64 "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetBoolean "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetString "IZCTE" (ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetBinary "IZCTE" (ptr::null(), 0, ptr::null_mut(), ptr::null_mut(), 0);
    fmi3GetClock "IZCTE" (ptr::null(), 0, ptr::null_mut());
    fmi3SetFloat32 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetFloat64 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetInt8 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetUInt8 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetInt16 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetUInt16 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetInt32 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetUInt32 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetInt64 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetUInt64 "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetBoolean "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetString "IZC" (ptr::null(), 0, ptr::null(), 0);
    fmi3SetBinary "IZC" (ptr::null(), 0, ptr::null(), ptr::null(), 0);
    fmi3SetClock "IZC" (ptr::null(), 0, ptr::null());
    fmi3GetVariableDependencies "IZCTE"
        (0, ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), 0);
    fmi3FreeFMUState "IZCTE" (ptr::null_mut());
    fmi3GetDirectionalDerivative "ZCTE"
        (ptr::null(), 0, ptr::null(), 0, ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetAdjointDerivative "ZCTE" (ptr::null(), 0, ptr::null(), 0, ptr::null(), 0, ptr::null_mut(), 0);
    fmi3GetOutputDerivatives "CTE" (ptr::null(), 0, ptr::null(), ptr::null_mut(), 0);
    fmi3DoStep "C" (0.0, 1e-5, TRUE, &mut 0, &mut 0, &mut 0, &mut 0.0);
    fmi3GetFMUState "IZCTE" (&mut ptr::null_mut());
    fmi3GetNumberOfVariableDependencies "IZCTE" (0, &mut 0);
};

/// Functions of capabilities that are not declared, and a word of why they fail.
const NOT_PROVIDED: &[Probe] = &probes! {
    fmi3EnterContinuousTimeMode "co-simulation" ();
    fmi3CompletedIntegratorStep "co-simulation" (TRUE, ptr::null_mut(), ptr::null_mut());
    fmi3SetTime "co-simulation" (0.0);
    fmi3SetContinuousStates "co-simulation" (ptr::null(), 3);
    fmi3GetContinuousStateDerivatives "co-simulation" (ptr::null_mut(), 3);
    fmi3GetEventIndicators "co-simulation" (ptr::null_mut(), 3);
    fmi3GetContinuousStates "co-simulation" (ptr::null_mut(), 3);
    fmi3GetNominalsOfContinuousStates "co-simulation" (ptr::null_mut(), 3);
    fmi3GetNumberOfEventIndicators "co-simulation" (ptr::null_mut());
    fmi3GetNumberOfContinuousStates "co-simulation" (ptr::null_mut());
    fmi3EnterEventMode "event mode" ();
    fmi3EnterStepMode "event mode" ();
    fmi3EvaluateDiscreteStates "event mode" ();
    fmi3UpdateDiscreteStates "event mode"
        (ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), ptr::null_mut());
    fmi3EnterConfigurationMode "structural parameters" ();
    fmi3ExitConfigurationMode "structural parameters" ();
    fmi3GetIntervalDecimal "clocks" (ptr::null(), 1, ptr::null_mut(), ptr::null_mut());
    fmi3GetIntervalFraction "clocks" (ptr::null(), 1, ptr::null_mut(), ptr::null_mut(), ptr::null_mut());
    fmi3GetShiftDecimal "clocks" (ptr::null(), 1, ptr::null_mut());
    fmi3GetShiftFraction "clocks" (ptr::null(), 1, ptr::null_mut(), ptr::null_mut());
    fmi3SetIntervalDecimal "clocks" (ptr::null(), 1, ptr::null());
    fmi3SetIntervalFraction "clocks" (ptr::null(), 1, ptr::null(), ptr::null());
    fmi3SetShiftDecimal "clocks" (ptr::null(), 1, ptr::null());
    fmi3SetShiftFraction "clocks" (ptr::null(), 1, ptr::null(), ptr::null());
    fmi3ActivateModelPartition "clocks" (0, 0.0);
};

#[test]
fn every_function_of_fmi_3_is_allowed_in_the_modes_of_the_standard_and_in_no_other() {
    let look = |name: &str, status: Status, line: Option<&Line>| {
        if name == "fmi3GetVariableDependencies" {
            // Asked for none, where an input has none; it is allowed everywhere.
            assert_eq!(status, Status::Ok, "{line:?}");
        } else if status == Status::Error {
            let message = &line.unwrap().message;
            let advice = ["fmi3Reset", "fmi3SetFMUState", "fmi3FreeInstance"];
            assert!(advice.iter().all(|word| message.contains(word)), "{message}");
            assert!(!message.contains("fmi2") && !message.contains("step complete"), "{message}");
        }
    };
    both::allowed_in_their_modes::<Three>(PROBES, |_| {}, look);
}

#[test]
fn what_is_not_provided_is_an_error_with_a_reason() {
    both::refuse(&Host::started("6205-healthy"), NOT_PROVIDED);
}

#[test]
fn null_dead_and_invented_handles_are_errors_under_fmi_3() {
    let dead = {
        let host = Host::started("6205-healthy");
        host.c
    };
    let mut host = Host::of("6205-healthy");
    let own = host.c;
    host.lines();
    for handle in [ptr::null_mut(), dead, ptr::without_provenance_mut(8), ptr::without_provenance_mut(0xdead_beef)] {
        host.c = handle;
        for (name, _, probe) in PROBES.iter().chain(NOT_PROVIDED) {
            assert_eq!(probe(handle), Status::Error, "{name}");
        }
        // SAFETY: any handle may be passed.
        unsafe { fmi3FreeInstance(handle) };
    }
    host.c = own;
    assert!(host.lines().is_empty(), "no instance, no logger");
}

#[test]
fn a_reset_instance_of_fmi_3_runs_like_a_new_one_to_the_bit() {
    both::runs_anew_after_a_reset::<Three>();
}

#[test]
fn an_instance_of_one_version_is_none_of_the_other() {
    let two = crate::two::Host::of("6205-healthy");
    // SAFETY: one reference, one value.
    let status = unsafe { fmi3GetFloat64(two.c, &0, 1, &mut 0.0, 1) };
    assert_eq!(status, Status::Error);
}

#[test]
fn a_panic_inside_a_step_reaches_the_host_as_a_status_and_a_reset_mends_it() {
    both::a_panic_fails_its_instance_alone::<Three>();
}
