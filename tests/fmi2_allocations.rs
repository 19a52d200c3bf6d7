//! Between two communication points nothing is allocated: counted by the program's own allocator.
//!
//! `unsafe` is what an allocator and a C interface take. One test only, for the count is the whole program's.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

#[path = "support/counting.rs"]
mod counting;
#[path = "fmi2/host.rs"]
#[allow(dead_code)]
mod host;

use brinell_fmi::fmi2::*;
use counting::counted;
use host::Host;

#[test]
fn setting_stepping_reading_saving_and_restoring_allocate_nothing() {
    for scene in ["er16k-tb1", "6205-hosted", "6205-epps", "6205-irregular-cage"] {
        let host = Host::started(scene);
        let (speed, all) = (host.reference("shaft.speed"), host.reals());
        let mut values = vec![0.0; all.len()];
        let mut state = host.save();
        // The harness has a thread of its own, which is not counted.
        let ((), allocations) = counted(|| {
            (0..200).for_each(|n| {
                assert_eq!(host.set(&[speed], &[60.0 + 0.01 * f64::from(n)]), Status::Ok);
                assert_eq!(host.step(f64::from(n) * 1e-4, 1e-4), Status::Ok);
                // SAFETY: the arrays are as long as said; `state` is a handle of this instance.
                unsafe {
                    assert_eq!(fmi2GetReal(host.c, all.as_ptr(), all.len(), values.as_mut_ptr()), Status::Ok);
                    assert_eq!(fmi2GetFMUstate(host.c, &raw mut state), Status::Ok);
                    assert_eq!(fmi2SetFMUstate(host.c, state), Status::Ok);
                }
            })
        });
        assert_eq!(allocations, 0, "{scene}");
    }
}
