//! Between two communication points nothing is allocated, intermediate updates included: counted by the program's own
//! allocator.

use crate::counting::counted;
use crate::three::{self, Three, set};
use crate::two;
use crate::two::any_host::{Host, Version};
use brinell_fmi::fmi3::Status;

const SCENES: [&str; 4] = ["er16k-tb1", "6205-hosted", "6205-epps", "6205-irregular-cage"];

/// Sets, steps, reads, saves and restores so many times.
fn allocates_nothing<V: Version>(host: &Host<V>, steps: u32, scene: &str) {
    let (speed, (all, count)) = (host.reference("shaft.speed"), V::reals(host.simulation()));
    let mut values = vec![0.0; count];
    let mut state = host.save();
    // The harness has a thread of its own, which is not counted.
    let ((), allocations) = counted(|| {
        (0..steps).for_each(|n| {
            assert_eq!(host.set(&[speed], &[60.0 + 0.01 * f64::from(n)]), Status::Ok);
            assert_eq!(host.advance(f64::from(n) * 1e-4, 1e-4), Status::Ok);
            assert_eq!(V::get(host.c, &all, &mut values), Status::Ok);
            // SAFETY: `state` is a handle of this instance.
            assert_eq!(unsafe { (V::FUNCTIONS.get_state)(host.c, &raw mut state) }, Status::Ok);
            assert_eq!(host.restore(state), Status::Ok);
        })
    });
    assert_eq!(allocations, 0, "{scene}");
}

#[test]
fn setting_stepping_reading_saving_and_restoring_allocate_nothing() {
    for scene in SCENES {
        allocates_nothing(&two::Host::started(scene), 200, scene);
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
            &[path, speed],
            Box::new(move |update| {
                assert_eq!(Three::get(update.instance, &[path], &mut looked), Status::Ok);
                if update.set_requested {
                    let value = 60.0 + 1e3 * looked[0].abs();
                    assert_eq!(set(update.instance, &[speed], &[value]), Status::Ok);
                }
                None
            }),
        );
        allocates_nothing(&host, 100, scene);
    }
}
