//! Saving, restoring and serializing the state of an instance.

use crate::both::{self, STEP, run};
use crate::two::{Host, Resources, Two};
use brinell::simulation::interface::table::Kind;
use brinell_fmi::fmi2::*;
use std::ptr;

#[test]
fn a_rewound_instance_repeats_every_bit() {
    both::repeats_when_rewound::<Two>();
}

#[test]
fn elements_without_inertia_are_rewound_and_go_on_in_another_instance_with_the_same_bits() {
    let without = |text: String| text.replace("[bearing]\n", "[bearing]\nelement_inertia = \"none\"\n");
    let started = |name: &str| {
        let host = Host::with(Resources::edited("er16k-tb1", "resources", without), name, true);
        host.start();
        host
    };
    let host = started("instance 1");
    assert_eq!(host.table().iter().filter(|variable| variable.name.contains(".path")).count(), 9);
    run(&host, 0, 55);
    let state = host.save();
    let bytes = host.serialize(state);
    let first = run(&host, 55, 20);
    assert_eq!(host.restore(state), Status::Ok);
    assert_eq!(run(&host, 55, 20), first);
    assert_eq!(host.free(state), Status::Ok);
    let other = started("instance 2");
    let state = other.deserialize(&bytes).unwrap();
    assert_eq!(other.restore(state), Status::Ok);
    assert_eq!(run(&other, 55, 20), first);
    assert_eq!(other.free(state), Status::Ok);
}

#[test]
fn a_step_that_failed_leaves_nothing_behind_in_a_state_put_back() {
    // A millisecond takes more steps than that; 0.1 ms does not.
    let few = |text: String| text.replace("[solver]", "[solver]\nmax_steps = 100");
    let host = Host::with(Resources::edited("er16k-tb1", "resources", few), "instance 1", true);
    host.start();
    run(&host, 0, 55);
    let state = host.save();
    let counters = host.table().iter().filter(|v| v.kind == Kind::Integer).map(|v| v.reference).collect::<Vec<_>>();
    let (signals, counts) = (run(&host, 55, 20), host.get_integers(&counters).unwrap());
    assert_eq!(host.restore(state), Status::Ok);
    assert_eq!(host.step(55.0 * STEP, 10e-3), Status::Error);
    assert_eq!(host.restore(state), Status::Ok);
    assert_eq!(run(&host, 55, 20), signals);
    assert_eq!(host.get_integers(&counters).unwrap(), counts);
}

#[test]
fn a_state_in_bytes_continues_in_another_instance_bit_by_bit() {
    both::continues_from_bytes::<Two>();
}

#[test]
fn a_state_saved_over_an_earlier_one_takes_its_place() {
    let host = Host::started("er16k-tb1");
    let mut state = host.save();
    let handle = state;
    run(&host, 0, 5);
    // SAFETY: a handle of this instance.
    assert_eq!(unsafe { fmi2GetFMUstate(host.c, &raw mut state) }, Status::Ok);
    assert_eq!(state, handle);
    let expected = run(&host, 5, 5);
    assert_eq!(host.restore(state), Status::Ok);
    assert_eq!(run(&host, 5, 5), expected);
}

#[test]
fn a_freed_state_is_null_and_cannot_be_used_again() {
    let host = Host::started("er16k-tb1");
    let (keep, mut state) = (host.save(), host.save());
    let copy = state;
    // SAFETY: a handle of this instance, then NULL.
    unsafe {
        assert_eq!(fmi2FreeFMUstate(host.c, &raw mut state), Status::Ok);
        assert!(state.is_null());
        assert_eq!(fmi2FreeFMUstate(host.c, &raw mut state), Status::Ok);
        assert_eq!(fmi2FreeFMUstate(host.c, ptr::null_mut()), Status::Ok);
    }
    // The memory is used again, the handle is not.
    let next = host.save();
    assert_ne!(next, copy);
    assert_eq!(host.restore(copy), Status::Error);
    assert!(host.lines().last().unwrap().message.contains("FMU state"));
    assert_eq!(host.free(copy), Status::Error);
    assert_eq!(host.restore(keep), Status::Ok);
    assert_eq!(host.restore(next), Status::Ok);
}

#[test]
fn a_state_passed_where_its_address_belongs_is_freed_and_logged_or_refused() {
    both::frees_a_state_by_value::<Two>();
}

#[test]
fn bytes_that_lie_over_the_handle_they_are_to_give_are_refused() {
    both::refuses_bytes_over_their_handle::<Two>();
}

#[test]
fn null_invented_and_foreign_states_are_errors() {
    both::refuses_states_of_nobody::<Two>();
}

#[test]
fn states_survive_a_reset() {
    let host = Host::started("er16k-tb1");
    run(&host, 0, 3);
    let state = host.save();
    let expected = run(&host, 3, 3);
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(host.restore(state), Status::Ok);
    assert_eq!(run(&host, 3, 3), expected);
}

#[test]
fn a_buffer_of_another_size_is_refused() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let size = host.serialize(state).len();
    let mut bytes = vec![0u8; size + 1];
    for wrong in [0, 1, size - 1, size + 1] {
        // SAFETY: the buffer is at least as long as said.
        let status = unsafe { fmi2SerializeFMUstate(host.c, state, bytes.as_mut_ptr().cast(), wrong) };
        assert_eq!(status, Status::Error);
        assert!(host.lines().last().unwrap().message.contains(&size.to_string()));
    }
    assert!(bytes.iter().all(|byte| *byte == 0));
}

#[test]
fn damaged_short_long_and_foreign_bytes_are_refused() {
    let host = Host::started("6205-epps");
    let good = host.serialize(host.save());
    let refused = |bytes: &[u8], word: &str| {
        assert_eq!(host.deserialize(bytes), Err(Status::Error));
        let message = host.lines().pop().unwrap().message;
        assert!(message.contains(word), "{word}: {message}");
    };
    for length in 0..good.len() {
        refused(&good[..length], if length < 8 { "not a serialized state" } else { "serialized state" });
    }
    refused(&[&good[..], &[0]].concat(), "bytes");
    refused(b"something else entirely, and long enough to be read", "not a serialized state");
    for index in 0..good.len() {
        for bit in 0..8 {
            let mut bytes = good.clone();
            bytes[index] ^= 1 << bit;
            assert_eq!(host.deserialize(&bytes), Err(Status::Error), "byte {index}, bit {bit}");
        }
    }
    host.lines();
    let other = Host::started("er16k-tb1");
    refused(&other.serialize(other.save()), "GUID");
    // SAFETY: NULL is what is tested.
    unsafe {
        let mut state = ptr::null_mut();
        assert_eq!(fmi2DeSerializeFMUstate(host.c, ptr::null(), 10, &raw mut state), Status::Error);
        assert_eq!(fmi2DeSerializeFMUstate(host.c, good.as_ptr().cast(), good.len(), ptr::null_mut()), Status::Error);
        assert_eq!(fmi2GetFMUstate(host.c, ptr::null_mut()), Status::Error);
    }
    assert!(host.deserialize(&good).is_ok());
}

#[test]
fn contents_that_no_run_leaves_behind_are_refused_with_the_reason_even_if_the_checksum_is_right() {
    let host = Host::started("6205-healthy");
    let good = host.serialize(host.save());
    // Magic 8, format 4, checksum 8; then length 8, GUID 38, three bytes, six times; then time 8, started 1, turns and
    // rest of the cage and of three frames, three accelerations at the end of the last step.
    let (checked, simulation) = (20, 20 + 8 + 38 + 3 + 6 * 8);
    let cage_rest = simulation + 8 + 1 + 8;
    let accelerations = cage_rest + 8 + 3 * 16;
    let next_step = accelerations + 3 * 8;
    let gained = next_step + 3 * 8 + 1 + 4 * 4;
    let path = gained + 2 * 8 + 1 + 10 * 8;
    let velocity = path + 16 * 8;
    for (offset, value, reason) in [
        (accelerations, f64::NAN, "not finite"),
        (next_step, 1e-300, "integration step is shorter"),
        (next_step, -1e-6, "integration step is shorter"),
        (next_step, f64::NAN, "not finite"),
        (next_step + 8, 1e30, "error of the last integration step"),
        (cage_rest, 7.0, "an angle that they cannot have"),
        (cage_rest + 3 * 16, 7.0, "an angle that they cannot have"),
        (gained, -1.0, "choice of the integration method"),
        (gained + 8, 1e-300, "choice of the integration method"),
        (path, 1.0, "outside the bearing"),
        (path + 9 * 8, 1.0, "no state's"),
        (velocity, 1e30, "velocity"),
        (velocity, f64::INFINITY, "not finite"),
        (path - 8, f64::NEG_INFINITY, "not finite"),
    ] {
        let mut bytes = good.clone();
        bytes[offset..offset + 8].copy_from_slice(&f64::to_le_bytes(value));
        let sum = brinell::numerics::checksum::checksum(&bytes[checked..]);
        bytes[checked - 8..checked].copy_from_slice(&sum.to_le_bytes());
        assert_eq!(host.deserialize(&bytes), Err(Status::Error), "{value} at {offset}");
        let message = host.lines().pop().unwrap().message;
        assert!(message.contains(reason), "{reason}: {message}");
    }
    assert!(host.deserialize(&good).is_ok());
}
