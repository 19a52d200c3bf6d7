//! Hosts that break the rules in ways that a random walk (`tests/adversary/misuse`) leaves out.

use crate::two::{Host, logger};
use brinell_fmi::fmi2::*;
use std::ptr;

#[test]
fn a_logger_that_calls_back_into_its_instance_is_turned_away() {
    let host = Host::started("er16k-tb1");
    *host.log.meddle_with.borrow_mut() = Some((host.c, None));
    assert_eq!(host.step(0.5, 1e-4), Status::Error);
    let meddled = host.log.meddle_with.take().unwrap();
    assert_eq!(meddled.1, Some(Status::Error));
    // The instance is still there.
    assert_eq!(host.reset(), Status::Ok);
}

#[test]
fn a_logger_may_call_another_instance() {
    let (host, other) = (Host::started("er16k-tb1"), Host::started("er16k-tb1"));
    *host.log.meddle_with.borrow_mut() = Some((other.c, None));
    assert_eq!(host.step(0.5, 1e-4), Status::Error);
    // It freed the other one; resetting that is then an error.
    assert_eq!(host.log.meddle_with.take().unwrap().1, Some(Status::Error));
}

#[test]
fn every_pointer_may_be_null_in_every_function() {
    let _ = logger();
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let c = host.c;
    // SAFETY: NULL is what is tested, with counts that say otherwise.
    let calls: Vec<Box<dyn Fn() -> Status>> = unsafe {
        vec![
            Box::new(move || fmi2SetDebugLogging(c, TRUE, 3, ptr::null())),
            Box::new(move || fmi2GetReal(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2GetInteger(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2GetBoolean(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2GetString(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2SetReal(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2SetInteger(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2SetBoolean(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2SetString(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2GetFMUstate(c, ptr::null_mut())),
            Box::new(move || fmi2SetFMUstate(c, ptr::null_mut())),
            Box::new(move || fmi2SerializedFMUstateSize(c, ptr::null_mut(), ptr::null_mut())),
            Box::new(move || fmi2SerializeFMUstate(c, ptr::null_mut(), ptr::null_mut(), 9)),
            Box::new(move || fmi2DeSerializeFMUstate(c, ptr::null(), 9, ptr::null_mut())),
            Box::new(move || {
                fmi2GetDirectionalDerivative(c, ptr::null(), 1, ptr::null(), 1, ptr::null(), ptr::null_mut())
            }),
            Box::new(move || fmi2SetRealInputDerivatives(c, ptr::null(), 1, ptr::null(), ptr::null())),
            Box::new(move || fmi2GetRealOutputDerivatives(c, ptr::null(), 1, ptr::null(), ptr::null_mut())),
            Box::new(move || fmi2GetStatus(c, DO_STEP_STATUS, ptr::null_mut())),
            Box::new(move || fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, ptr::null_mut())),
            Box::new(move || fmi2GetBooleanStatus(c, TERMINATED, ptr::null_mut())),
            Box::new(move || fmi2GetStringStatus(c, PENDING_STATUS, ptr::null_mut())),
        ]
    };
    for (number, call) in calls.iter().enumerate() {
        assert_eq!(call(), Status::Error, "call {number}");
        assert_eq!(host.restore(state), Status::Ok);
    }
}
