//! Steps: the bits of FMI 2.0, what `fmi3DoStep` gives, and what it refuses.

use crate::both::{self, run};
use crate::three::{Host, Three};
use crate::two;
use brinell_fmi::fmi3::*;
use std::ptr;

const SCENES: [&str; 5] = ["er16k-tb1", "6205-hosted", "6205-epps", "6205-irregular-cage", "er16k-turning-outer"];

#[test]
fn the_same_scene_and_steps_give_the_bits_of_fmi_2() {
    for scene in SCENES {
        let (host, other) = (Host::started(scene), two::Host::started(scene));
        // Row by row, as FMI 2.0 has them: arrays give all their elements where their first stands.
        let sorted = |mut values: Vec<u64>| {
            values.sort_unstable();
            values
        };
        for (n, (found, expected)) in run(&host, 0, 60).into_iter().zip(run(&other, 0, 60)).enumerate() {
            assert_eq!(sorted(found), sorted(expected), "{scene} after step {n}");
        }
    }
}

#[test]
fn a_step_gives_no_event_no_end_no_early_return_and_its_end() {
    let host = Host::started("er16k-tb1");
    assert_eq!(host.do_step(0.0, 1e-3), Ok((false, false, false, 1e-3)));
    assert_eq!(host.do_step(1e-3, 0.1e-3), Ok((false, false, false, 1e-3 + 0.1e-3)));
}

#[test]
fn a_wrong_point_a_wrong_step_and_one_past_the_stop_time_are_errors_with_the_numbers() {
    for (point, size, words) in [
        (0.5, 1e-4, ["0.5 s", "0.0 s"]),
        (0.0, 0.0, ["0.0 s", "above 0"]),
        (0.0, -1e-4, ["-0.0001 s", "above 0"]),
        (0.0, f64::NAN, ["NaN", "above 0"]),
        (0.0, 2e-3, ["stop time 0.001 s", "past"]),
    ] {
        let host = Host::started_at("6205-healthy", 0.0, Some(1e-3));
        let message = host.refuses(host.save(), &words, |h| h.advance(point, size));
        assert!(message.starts_with("fmi3DoStep"), "{message}");
        // Nothing is lost.
        host.step(0.0, 1e-3);
    }
}

#[test]
fn start_and_stop_must_be_finite_and_a_tolerance_can_only_tighten() {
    both::experiments_are_finite::<Three>();
    both::a_tolerance_tightens_and_never_loosens::<Three>();
}

#[test]
fn a_step_with_a_null_pointer_for_a_result_is_refused_before_anything_is_done() {
    for missing in 0..4 {
        let host = Host::started("6205-healthy");
        let (mut flags, mut time) = ([0; 3], 0.0);
        let pointer_or_null = |index: usize, pointer| if index == missing { ptr::null_mut() } else { pointer };
        let [event, end, early] = std::array::from_fn(|i| pointer_or_null(i, &raw mut flags[i]));
        let reached = if missing == 3 { ptr::null_mut() } else { &raw mut time };
        host.refuses(host.save(), &["is NULL"], |h| {
            // SAFETY: NULL, or pointers to one value each.
            unsafe { fmi3DoStep(h.c, 0.0, 1e-4, TRUE, event, end, early, reached) }
        });
        host.step(0.0, 1e-4);
    }
}
