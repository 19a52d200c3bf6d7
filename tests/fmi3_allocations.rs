//! Between two communication points nothing is allocated under FMI 3.0, intermediate updates included: counted by the
//! program's own allocator.
//!
//! `unsafe` is what an allocator and a C interface take. One test only, for the count is the whole program's.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

#[path = "support/counting.rs"]
mod counting;
#[path = "fmi3/host.rs"]
#[allow(dead_code)]
mod host;
#[path = "fmi2/host.rs"]
#[allow(dead_code)]
mod two;

use brinell_fmi::fmi3::*;
use counting::counted;
use host::Host;

#[test]
fn setting_stepping_updating_reading_saving_and_restoring_allocate_nothing_under_fmi_3() {
    for scene in ["er16k-tb1", "6205-hosted", "6205-epps", "6205-irregular-cage"] {
        let plain = Host::of(scene);
        let [speed, path] = ["shaft.speed", "element.path"].map(|name| plain.reference(name));
        let mut looked = [0.0; 9];
        let host = Host::updated(
            scene,
            &["element.path", "shaft.speed"],
            Box::new(move |update| {
                // SAFETY: the arrays are as long as said.
                unsafe {
                    let status = fmi3GetFloat64(update.instance, &path, 1, looked.as_mut_ptr(), 9);
                    assert_eq!(status, Status::Ok);
                    if update.set_requested {
                        let value = 60.0 + 1e3 * looked[0].abs();
                        assert_eq!(fmi3SetFloat64(update.instance, &speed, 1, &value, 1), Status::Ok);
                    }
                }
                None
            }),
        );
        let (all, count) = host.reals();
        let mut values = vec![0.0; count];
        let mut state = host.save();
        // The harness has a thread of its own, which is not counted.
        let ((), allocations) = counted(|| {
            (0..100).for_each(|n| {
                assert_eq!(host.set(&[speed], &[60.0 + 0.01 * f64::from(n)]), Status::Ok);
                assert!(host.do_step(f64::from(n) * 1e-4, 1e-4).is_ok());
                // SAFETY: the arrays are as long as said; `state` is a handle of this instance.
                unsafe {
                    let pointer = values.as_mut_ptr();
                    assert_eq!(fmi3GetFloat64(host.c, all.as_ptr(), all.len(), pointer, count), Status::Ok);
                    assert_eq!(fmi3GetFMUState(host.c, &raw mut state), Status::Ok);
                    assert_eq!(fmi3SetFMUState(host.c, state), Status::Ok);
                }
            })
        });
        assert_eq!(allocations, 0, "{scene}");
    }
}
