//! In which mode each function may be called.

use crate::three::Host;
use brinell_fmi::fmi3::*;
use std::ptr;

type Probe = (&'static str, &'static str, fn(&Host) -> Status);

macro_rules! plain {
    ($($name:ident $allowed:literal ($($argument:expr),*);)*) => {
        // SAFETY of all the blocks: nothing but the handle, NULL with a count of 0, and arguments that are not
        // read.
        [$((stringify!($name), $allowed, (|h| unsafe { $name(h.c, $($argument),*) }) as fn(&Host) -> Status)),*]
    };
}

/// Calls with no variables. The letters are the modes of sections 2.3 and 4.2 of
/// the standard: Instantiated, initialiZation, step (C), Terminated, Error; written down here a second time.
fn probes() -> Vec<Probe> {
    let plain: Vec<Probe> = plain! {
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
    }
    .to_vec();
    let others: [Probe; 3] = [
        ("fmi3DoStep", "C", |h| h.do_step(0.0, 1e-5).map_or_else(|status| status, |_| Status::Ok)),
        ("fmi3GetFMUState", "IZCTE", |h| {
            let mut state = ptr::null_mut();
            // SAFETY: a pointer to a state.
            unsafe { fmi3GetFMUState(h.c, &raw mut state) }
        }),
        ("fmi3GetNumberOfVariableDependencies", "IZCTE", |h| {
            let mut count = 0;
            // SAFETY: a pointer to a number.
            unsafe { fmi3GetNumberOfVariableDependencies(h.c, 0, &raw mut count) }
        }),
    ];
    plain.into_iter().chain(others).collect()
}

/// Functions of capabilities that are not declared, and a word of why they fail.
fn not_provided() -> Vec<Probe> {
    plain! {
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
    }
    .to_vec()
}

fn in_mode(mode: char) -> Host {
    let host = Host::of("6205-healthy");
    if mode != 'I' {
        assert_eq!(host.enter(None, 0.0, None), Status::Ok);
    }
    if "CTE".contains(mode) {
        assert_eq!(host.exit(), Status::Ok);
    }
    match mode {
        'T' => assert_eq!(host.terminate(), Status::Ok),
        'E' => assert_eq!(host.do_step(0.0, -1.0), Err(Status::Error)),
        _ => {}
    }
    host.lines();
    host
}

#[test]
fn every_function_of_fmi_3_is_allowed_in_the_modes_of_the_standard_and_in_no_other() {
    for (name, allowed, probe) in probes() {
        for mode in "IZCTE".chars() {
            let host = in_mode(mode);
            let status = probe(&host);
            let lines = host.lines();
            if name == "fmi3GetVariableDependencies" {
                // Asked for none, where an input has none; it is allowed everywhere.
                assert_eq!(status, Status::Ok, "{lines:?}");
            } else if allowed.contains(mode) {
                assert!(status <= Status::Discard, "{name} in {mode}: {lines:?}");
            } else {
                assert_eq!(status, Status::Error, "{name} in {mode}");
                let line = lines.last().unwrap();
                assert!(line.message.starts_with(name) && line.message.contains("not allowed in mode"), "{line:?}");
                let advice = ["fmi3Reset", "fmi3SetFMUState", "fmi3FreeInstance"];
                assert!(advice.iter().all(|word| line.message.contains(word)), "{line:?}");
                assert!(!line.message.contains("fmi2") && !line.message.contains("step complete"), "{line:?}");
            }
        }
    }
}

#[test]
fn what_is_not_provided_is_an_error_with_a_reason() {
    let host = Host::started("6205-healthy");
    let state = host.save();
    for (name, word, probe) in not_provided() {
        host.lines();
        assert_eq!(probe(&host), Status::Error, "{name}");
        let message = host.last_message();
        assert!(message.starts_with(name) && message.contains(word), "{message}");
        assert_eq!(host.restore(state), Status::Ok);
    }
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
        for (name, _, probe) in probes().into_iter().chain(not_provided()) {
            assert_eq!(probe(&host), Status::Error, "{name}");
        }
        // SAFETY: any handle may be passed.
        unsafe { fmi3FreeInstance(handle) };
    }
    host.c = own;
    assert!(host.lines().is_empty(), "no instance, no logger");
}

#[test]
fn a_reset_instance_of_fmi_3_runs_like_a_new_one_to_the_bit() {
    let run = |host: &Host| {
        host.start();
        (0..20).for_each(|n| host.step(f64::from(n) * 1e-4, 1e-4));
        crate::two::bits(&host.all())
    };
    let host = Host::of("er16k-tb1");
    let first = run(&host);
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(host.set(&[host.reference("cage.slip")], &[0.5]), Status::Ok);
    assert_ne!(run(&host), first);
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(run(&host), first);
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
    let host = Host::with(crate::three::Resources::of("6205-healthy"), "panic on demand", &[], None);
    host.start();
    assert_eq!(host.do_step(0.0, 1e-5), Err(Status::Error));
    assert!(host.last_message().contains("internal error: panic on demand"));
    assert_eq!(host.reset(), Status::Ok);
    host.start();
}
