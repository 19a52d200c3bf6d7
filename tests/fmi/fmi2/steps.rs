//! Time: experiments, communication points, steps, and what is told about them.

use crate::both;
use crate::two::{Host, Resources, Two};
use brinell_fmi::fmi2::*;
use std::ffi::CStr;
use std::ptr;
use std::sync::Arc;

#[test]
fn an_experiment_needs_a_finite_start_and_a_later_finite_stop() {
    both::experiments_are_finite::<Two>();
    let host = Host::of("6205-healthy");
    assert_eq!(host.setup(Some(1e-4), -5.0, Some(-4.0)), Status::Ok);
    // A second call takes the place of the first.
    host.start_at(100.0, None);
    assert_eq!(host.step(100.0, 1e-4), Status::Ok);
}

#[test]
fn a_tolerance_of_the_host_tightens_the_scenes_and_never_loosens_it() {
    both::a_tolerance_tightens_and_never_loosens::<Two>();
}

#[test]
fn a_step_that_is_not_above_zero_and_finite_is_an_error() {
    for size in [0.0, -1e-4, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let host = Host::started("6205-healthy");
        assert_eq!(host.step(0.0, size), Status::Error, "{size}");
        assert!(host.last_message().contains("communication step size"));
    }
}

#[test]
fn the_shortest_positive_step_is_taken() {
    for size in [5e-324, f64::MIN_POSITIVE, 1e-300, 1e-18] {
        let host = Host::started("6205-healthy");
        assert_eq!(host.step(0.0, size), Status::Ok, "{size} {:?}", host.lines());
        assert!(host.get(&host.reals()).is_ok(), "{size} {:?}", host.lines());
    }
}

#[test]
fn a_wrong_communication_point_is_an_error_and_a_rounded_one_is_not() {
    for point in [1e-4, -1e-4, 1.0, f64::NAN, f64::INFINITY] {
        let host = Host::started("6205-healthy");
        assert_eq!(host.step(point, 1e-4), Status::Error, "{point}");
        assert!(host.last_message().contains("communication point"));
    }
    let host = Host::started("6205-healthy");
    assert_eq!(host.step(0.0, 1e-3), Status::Ok);
    assert_eq!(host.step(1e-3 * (1.0 + 5e-10), 1e-3), Status::Ok);
    assert_eq!(host.step(2e-3 * (1.0 - 5e-10), 1e-3), Status::Ok);
}

#[test]
fn a_step_ends_exactly_where_the_host_computes_it() {
    let host = Host::started("6205-healthy");
    let mut time = 0.0;
    for step in [1e-3, 3e-4, 7e-5, 1e-3 / 3.0] {
        assert_eq!(host.step(time, step), Status::Ok);
        time += step;
        assert_eq!(host.last_time().to_bits(), time.to_bits());
    }
}

/// A step past a stop time a millisecond after the start is an error, and one that ends there is not: ten added tenths
/// of a millisecond are more than a millisecond by rounding.
fn ends_at_the_stop_time(start: f64) {
    let host = Host::started_at("6205-healthy", start, Some(start + 1e-3));
    let mut time = start;
    for _ in 0..10 {
        assert_eq!(host.step(time, 1e-4), Status::Ok, "{:?}", host.lines());
        time += 1e-4;
    }
    assert_eq!(host.step(time, 1e-4), Status::Error, "{start}");
    assert!(host.last_message().contains("stop time"));
}

#[test]
fn a_step_past_the_stop_time_is_an_error_and_one_that_ends_there_is_not() {
    ends_at_the_stop_time(0.0);
}

#[test]
fn a_whole_step_past_a_late_stop_time_is_an_error() {
    [1e5, 1e7, 1.7e9].into_iter().for_each(ends_at_the_stop_time);
}

#[test]
fn a_step_left_out_or_done_twice_is_an_error_however_late() {
    // 1.7e9 s: a host whose time is that of Unix.
    for start in [-1e3, 0.0, 1e3, 1e5, 1e6, 1e7, 1.7e9] {
        for off in [1e-4, -1e-4, 5e-5, -5e-5, -0.9, 0.9] {
            let host = Host::started_at("6205-healthy", start, None);
            assert_eq!(host.step(start, 1e-4), Status::Ok);
            let point = start + 1e-4;
            assert_eq!(host.step(point + off, 1e-4), Status::Error, "{off} s off at {start} s");
            assert!(host.last_message().contains("communication point"));
            // The host itself adds and multiplies.
            assert_eq!(host.reset(), Status::Ok);
            host.start_at(start, None);
            for n in 0..5 {
                assert_eq!(host.step(start + f64::from(n) * 1e-4, 1e-4), Status::Ok, "{:?}", host.lines());
            }
        }
    }
}

#[test]
fn a_host_whose_points_drift_away_from_its_steps_is_refused() {
    // Each point half a percent of a step beyond the end of the step before.
    let host = Host::started_at("6205-healthy", 1e3, None);
    let step = |host: &Host, n: u32| host.step(1e3 + f64::from(n) * 1.005e-4, 1e-4);
    for n in 0..=2 {
        assert_eq!(step(&host, n), Status::Ok, "{:?}", host.lines());
    }
    // A state that is put back brings the drift along, as bytes too.
    let bytes = host.serialize(host.save());
    assert_eq!(step(&host, 3), Status::Error);
    assert!(host.last_message().contains("all steps since"), "{:?}", host.lines());
    let other = Host::started("6205-healthy");
    let state = other.deserialize(&bytes).unwrap();
    assert_eq!(other.restore(state), Status::Ok);
    assert_eq!(step(&other, 3), Status::Error);
}

#[test]
fn a_step_shorter_than_time_can_show_is_taken() {
    let host = Host::started_at("6205-healthy", 1.7e9, None);
    let angle = host.reference("cage.angle");
    let before = host.get(&[angle, host.reference("cage.speed")]).unwrap();
    // Numbers at Unix time are 2.4e-7 s apart: most of these steps do not move it, but the cage.
    for n in 0..100 {
        assert_eq!(host.step(1.7e9 + f64::from(n) * 1e-8, 1e-8), Status::Ok, "{:?}", host.lines());
    }
    let turned = host.get(&[angle]).unwrap()[0] - before[0];
    // Rounding of a hundred sums of an angle of 1.6.
    assert!((turned - 1e-6 * before[1]).abs() < 1e-13, "{turned}");
    // What a double at that time can tell apart is told apart.
    assert_eq!(host.step(1.7e9 + 1e-5, 1e-8), Status::Error);
}

#[test]
fn without_a_stop_time_there_is_no_end() {
    let host = Host::of("6205-healthy");
    // NaN goes with "not defined" and must not be looked at.
    host.start();
    assert_eq!(host.step(0.0, 0.02), Status::Ok);
}

#[test]
fn the_result_does_not_depend_on_how_the_time_is_split() {
    let run = |count: u32| {
        let host = Host::of("er16k-tb1");
        assert_eq!(host.set(&[host.reference("solver.tolerance")], &[1e-9]), Status::Ok);
        host.start();
        let step = 2e-3 / f64::from(count);
        for n in 0..count {
            assert_eq!(host.step(f64::from(n) * step, step), Status::Ok);
        }
        host.get(&[host.reference("shaft.y"), host.reference("housing.y")]).unwrap()
    };
    let (one, many) = (run(1), run(100));
    for (one, many) in one.iter().zip(many) {
        // 1e-12 m: tolerance 1e-9 of an approach of 10 µm, over some hundred integration steps.
        assert!((one - many).abs() < 1e-12, "{one} {many}");
    }
}

#[test]
fn status_queries_answer_and_unknown_kinds_are_discarded() {
    let host = Host::started("6205-healthy");
    assert_eq!(host.step(0.0, 1e-4), Status::Ok);
    let (mut status, mut time, mut integer, mut flag) = (Status::Fatal, f64::NAN, 77, 77);
    let mut text: FmiString = ptr::null();
    // SAFETY: pointers to one value each.
    unsafe {
        assert_eq!(fmi2GetStatus(host.c, DO_STEP_STATUS, &raw mut status), Status::Ok);
        assert_eq!(fmi2GetRealStatus(host.c, LAST_SUCCESSFUL_TIME, &raw mut time), Status::Ok);
        assert_eq!(fmi2GetBooleanStatus(host.c, TERMINATED, &raw mut flag), Status::Ok);
        assert_eq!(fmi2GetStringStatus(host.c, PENDING_STATUS, &raw mut text), Status::Ok);
        assert_eq!(CStr::from_ptr(text), c"no step is pending");
        for kind in [-1, 4, i32::MAX] {
            assert_eq!(fmi2GetStatus(host.c, kind, &raw mut status), Status::Discard);
            assert_eq!(fmi2GetRealStatus(host.c, kind, &raw mut time), Status::Discard);
            assert_eq!(fmi2GetIntegerStatus(host.c, kind, &raw mut integer), Status::Discard);
            assert_eq!(fmi2GetBooleanStatus(host.c, kind, &raw mut flag), Status::Discard);
            assert_eq!(fmi2GetStringStatus(host.c, kind, &raw mut text), Status::Discard);
        }
        assert_eq!(fmi2GetIntegerStatus(host.c, DO_STEP_STATUS, &raw mut integer), Status::Discard);
    }
    assert_eq!((status, time, integer, flag), (Status::Ok, 1e-4, 77, FALSE));
    // Discarded queries do not end the run.
    assert_eq!(host.step(1e-4, 1e-4), Status::Ok);
    // SAFETY: NULL is what is tested.
    assert_eq!(unsafe { fmi2GetRealStatus(host.c, LAST_SUCCESSFUL_TIME, ptr::null_mut()) }, Status::Error);
}

#[test]
fn an_enormous_step_ends_after_the_budget_of_integration_steps() {
    let few = |text: String| text.replace("[solver]", "[solver]\nmax_steps = 3000");
    let resources = Arc::new(Resources::edited("er16k-tb1", "resources", few));
    for step in [1e3, 1e15, f64::MAX] {
        let host = Host::with(Arc::clone(&resources), "budget", true);
        host.start();
        let before = std::time::Instant::now();
        assert_eq!(host.step(0.0, step), Status::Error, "{step}");
        // A few microseconds for each of 3000 integration steps, on a machine that is busy.
        assert!(before.elapsed().as_secs() < 20);
        assert!(host.last_message().contains("limit solver.max_steps = 3000"), "{step}");
        assert_eq!(host.reset(), Status::Ok);
    }
}
