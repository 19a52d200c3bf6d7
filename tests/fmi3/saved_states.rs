//! Saving, restoring and serializing under FMI 3.0, and to and from FMI 2.0.

use crate::three::Host;
use crate::two;
use crate::two::bits;
use brinell_fmi::fmi3::*;

const STEP: f64 = 1e-4;

fn run(host: &Host, first: u32, count: u32) -> Vec<Vec<u64>> {
    (first..first + count)
        .map(|n| {
            host.step(f64::from(n) * STEP, STEP);
            bits(&host.all())
        })
        .collect()
}

#[test]
fn a_rewound_instance_of_fmi_3_repeats_every_bit_and_so_does_one_from_bytes() {
    for scene in ["er16k-tb1", "6205-hosted", "6205-epps"] {
        let host = Host::started(scene);
        run(&host, 0, 55);
        let state = host.save();
        let expected = run(&host, 55, 20);
        assert_eq!(host.restore(state), Status::Ok);
        assert_eq!(run(&host, 55, 20), expected, "{scene}");
        let bytes = host.serialize(state);
        assert_eq!(host.free(state), Status::Ok);
        let other = Host::of(scene);
        let copy = other.deserialize(&bytes).unwrap();
        assert_eq!(other.restore(copy), Status::Ok);
        assert_eq!(run(&other, 55, 20), expected, "{scene}");
        for wrong in [&bytes[..bytes.len() - 1], &bytes[..10], &[]] {
            assert!(other.deserialize(wrong).is_err());
            assert_eq!(other.restore(copy), Status::Ok);
        }
    }
}

#[test]
fn a_state_in_bytes_goes_from_one_version_of_fmi_to_the_other() {
    let (three, two) = (Host::started("er16k-tb1"), two::Host::started("er16k-tb1"));
    run(&three, 0, 55);
    let bytes = three.serialize(three.save());
    let state = two.deserialize(&bytes).unwrap();
    assert_eq!(two.restore(state), Status::Ok);
    run(&three, 55, 5);
    (55..60).for_each(|n| assert_eq!(two.step(f64::from(n) * STEP, STEP), Status::Ok));
    let y = three.reference("shaft.y");
    assert_eq!(bits(&three.get(&[y]).unwrap()), bits(&two.get(&[y]).unwrap()));
    let back = three.deserialize(&two.serialize(two.save())).unwrap();
    assert_eq!(three.restore(back), Status::Ok);
    run(&three, 60, 1);
}

#[test]
fn invented_freed_and_foreign_states_are_errors_under_fmi_3() {
    let (host, other) = (Host::started("6205-healthy"), Host::started("6205-healthy"));
    let (kept, freed) = (host.save(), host.save());
    assert_eq!(host.free(freed), Status::Ok);
    for wrong in [freed, other.save(), std::ptr::without_provenance_mut(0x1234)] {
        host.lines();
        assert_eq!(host.restore(wrong), Status::Error);
        assert!(host.last_message().contains("not one of this instance's"));
        assert_eq!(host.restore(kept), Status::Ok);
    }
}

#[test]
fn a_state_in_place_of_its_address_is_freed_and_bytes_over_their_handle_are_refused_under_fmi_3() {
    let host = Host::started("6205-healthy");
    let (kept, state) = (host.save(), host.save());
    // SAFETY: what is tested: a handle, which is no address, is not followed.
    unsafe {
        assert_eq!(fmi3FreeFMUState(host.c, state.cast()), Status::Ok);
        assert!(host.last_message().contains("it is freed"));
        assert_eq!(fmi3FreeFMUState(host.c, state.cast()), Status::Error);
    }
    assert_eq!(host.restore(kept), Status::Ok);
    let size = host.serialize(kept).len();
    let mut words = vec![0u64; size.div_ceil(8)];
    let base = words.as_mut_ptr();
    // SAFETY: as many bytes as said, with the handle, which is NULL, among them, which is what is tested.
    let status = unsafe { fmi3DeserializeFMUState(host.c, base.cast(), size, base.cast()) };
    assert_eq!(status, Status::Error);
    assert!(host.last_message().contains("overlap"));
    assert!(words.iter().all(|word| *word == 0));
}
