//! Between two communication points nothing is allocated, intermediate updates included: counted by the program's own
//! allocator.

use crate::counting::counted;
use crate::{three, two};
use brinell_fmi::fmi2::{fmi2GetFMUstate, fmi2GetReal, fmi2SetFMUstate};
use brinell_fmi::fmi3::{Status, fmi3GetFMUState, fmi3GetFloat64, fmi3SetFMUState, fmi3SetFloat64};

const SCENES: [&str; 4] = ["er16k-tb1", "6205-hosted", "6205-epps", "6205-irregular-cage"];

#[test]
fn setting_stepping_reading_saving_and_restoring_allocate_nothing() {
    for scene in SCENES {
        let host = two::Host::started(scene);
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

#[test]
fn setting_stepping_updating_reading_saving_and_restoring_allocate_nothing_under_fmi_3() {
    for scene in SCENES {
        let plain = three::Host::of(scene);
        let [speed, path] = ["shaft.speed", "element.path"].map(|name| plain.reference(name));
        let mut looked = [0.0; 9];
        let host = three::Host::updated(
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
