//! Hosts that break the rules in ways that a random walk (`tests/adversary/misuse`) leaves out.

use crate::both::{probes, refuse};
use crate::two::Host;
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
    // With counts that say otherwise.
    let probes = probes! {
        fmi2SetDebugLogging "" (TRUE, 3, ptr::null());
        fmi2GetReal "" (ptr::null(), 3, ptr::null_mut());
        fmi2GetInteger "" (ptr::null(), 3, ptr::null_mut());
        fmi2GetBoolean "" (ptr::null(), 3, ptr::null_mut());
        fmi2GetString "" (ptr::null(), 3, ptr::null_mut());
        fmi2SetReal "" (ptr::null(), 3, ptr::null());
        fmi2SetInteger "" (ptr::null(), 3, ptr::null());
        fmi2SetBoolean "" (ptr::null(), 3, ptr::null());
        fmi2SetString "" (ptr::null(), 3, ptr::null());
        fmi2GetFMUstate "" (ptr::null_mut());
        fmi2SetFMUstate "" (ptr::null_mut());
        fmi2SerializedFMUstateSize "" (ptr::null_mut(), ptr::null_mut());
        fmi2SerializeFMUstate "" (ptr::null_mut(), ptr::null_mut(), 9);
        fmi2DeSerializeFMUstate "" (ptr::null(), 9, ptr::null_mut());
        fmi2GetDirectionalDerivative "" (ptr::null(), 1, ptr::null(), 1, ptr::null(), ptr::null_mut());
        fmi2SetRealInputDerivatives "" (ptr::null(), 1, ptr::null(), ptr::null());
        fmi2GetRealOutputDerivatives "" (ptr::null(), 1, ptr::null(), ptr::null_mut());
        fmi2GetStatus "" (DO_STEP_STATUS, ptr::null_mut());
        fmi2GetRealStatus "" (LAST_SUCCESSFUL_TIME, ptr::null_mut());
        fmi2GetBooleanStatus "" (TERMINATED, ptr::null_mut());
        fmi2GetStringStatus "" (PENDING_STATUS, ptr::null_mut());
    };
    refuse(&Host::started("er16k-tb1"), &probes);
}
