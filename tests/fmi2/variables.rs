//! Reading and setting variables.

use crate::two::Host;
use brinell::simulation::interface::table::{Causality, Kind, Variable};
use brinell_fmi::fmi2::*;
use std::ptr;

const SCENES: [&str; 3] = ["er16k-tb1", "6205-hosted", "6205-epps"];

fn start_of(variable: &Variable) -> Option<f64> {
    match variable.kind {
        Kind::Real { start, .. } => start,
        _ => None,
    }
}

#[test]
fn initialization_shows_the_start_values_of_the_table() {
    for scene in SCENES {
        let host = Host::of(scene);
        host.setup(None, 0.0, None);
        assert_eq!(host.enter(), Status::Ok);
        for variable in host.table() {
            if let Some(start) = start_of(&variable) {
                assert_eq!(host.get(&[variable.reference]), Ok(vec![start]), "{}", variable.name);
            }
            if let Kind::Enumeration { start, .. } = variable.kind {
                assert_eq!(host.get_integers(&[variable.reference]), Ok(vec![start]), "{}", variable.name);
            }
        }
        assert!(host.get(&host.reals()).is_ok(), "{:?}", host.lines());
    }
}

#[test]
fn what_is_set_is_read_back() {
    let host = Host::of("er16k-tb1");
    let (load, slip, law) =
        (host.reference("shaft.load.y"), host.reference("cage.slip"), host.reference("contact.law"));
    assert_eq!(host.set(&[load, slip], &[-321.0, 0.01]), Status::Ok);
    assert_eq!(host.set_integers(&[law], &[1]), Status::Ok);
    host.setup(None, 0.0, None);
    assert_eq!(host.enter(), Status::Ok);
    assert_eq!(host.get(&[slip, load, slip]), Ok(vec![0.01, -321.0, 0.01]));
    assert_eq!(host.get_integers(&[law]), Ok(vec![1]));
}

#[test]
fn a_load_set_before_initialization_is_carried_by_the_bearing() {
    let host = Host::of("6205-healthy");
    assert_eq!(host.set(&[host.reference("shaft.load.y")], &[-800.0]), Status::Ok);
    host.start();
    let force = host.get(&[host.reference("shaft.force.y")]).unwrap()[0];
    // 1e-5: the elements move past the displaced ring from the start on, which damps a millionth of the force.
    assert!((force / 800.0 - 1.0).abs() < 1e-5, "{force}");
}

#[test]
fn no_variables_with_null_arrays_is_fine() {
    let host = Host::started("er16k-tb1");
    // SAFETY: NULL goes with a count of 0.
    let statuses = unsafe {
        [
            fmi2GetReal(host.c, ptr::null(), 0, ptr::null_mut()),
            fmi2SetReal(host.c, ptr::null(), 0, ptr::null()),
            fmi2GetInteger(host.c, ptr::null(), 0, ptr::null_mut()),
            fmi2SetInteger(host.c, ptr::null(), 0, ptr::null()),
            fmi2GetBoolean(host.c, ptr::null(), 0, ptr::null_mut()),
            fmi2SetBoolean(host.c, ptr::null(), 0, ptr::null()),
            fmi2GetString(host.c, ptr::null(), 0, ptr::null_mut()),
            fmi2SetString(host.c, ptr::null(), 0, ptr::null()),
        ]
    };
    assert_eq!(statuses, [Status::Ok; 8]);
}

#[test]
fn null_arrays_with_a_count_are_errors_that_name_the_argument() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let (reference, mut value) = (0u32, 0.0);
    // SAFETY: one element each, or NULL, which is what is tested.
    let calls: [(&str, &dyn Fn() -> Status); 4] = unsafe {
        [
            ("vr", &|| fmi2GetReal(host.c, ptr::null(), 1, ptr::null_mut::<f64>().wrapping_byte_add(8))),
            ("value", &|| fmi2GetReal(host.c, &raw const reference, 1, ptr::null_mut())),
            ("vr", &|| fmi2SetReal(host.c, ptr::null(), 1, &raw const value)),
            ("value", &|| fmi2SetReal(host.c, &raw const reference, 1, ptr::null())),
        ]
    };
    for (argument, call) in calls {
        host.lines();
        assert_eq!(call(), Status::Error);
        let line = host.lines().remove(0);
        assert!(line.message.contains(&format!("argument {argument} is NULL")), "{line:?}");
        assert_eq!(host.restore(state), Status::Ok);
    }
    value += 1.0;
    assert_eq!(value, 1.0);
}

#[test]
fn unknown_references_and_wrong_types_are_errors_that_say_so() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let count = host.table().len() as u32;
    let speed = host.reference("shaft.speed");
    let steps = host.reference("solver.steps");
    let mut text: FmiString = ptr::null();
    let mut flag = 0;
    let value = c"x".as_ptr();
    // SAFETY: one element each.
    let unknown: &str = &format!("is unknown: this model's references are 0 to {}", count - 1);
    let calls: [(&str, &dyn Fn() -> Status); 13] = unsafe {
        [
            (unknown, &|| host.get(&[count]).unwrap_err()),
            (unknown, &|| host.get(&[speed, u32::MAX]).unwrap_err()),
            (unknown, &|| host.get_integers(&[count]).unwrap_err()),
            (unknown, &|| host.set(&[count], &[0.0])),
            (unknown, &|| host.set_integers(&[count], &[0])),
            (unknown, &|| fmi2GetBoolean(host.c, &raw const count, 1, (&raw const flag).cast_mut())),
            (unknown, &|| fmi2GetString(host.c, &raw const count, 1, (&raw const text).cast_mut())),
            ("not of type Real", &|| host.get(&[steps]).unwrap_err()),
            ("not of type Integer", &|| host.get_integers(&[speed]).unwrap_err()),
            ("not of type Boolean", &|| fmi2GetBoolean(host.c, &raw const speed, 1, (&raw const flag).cast_mut())),
            ("not of type Boolean", &|| fmi2SetBoolean(host.c, &raw const speed, 1, &raw const flag)),
            ("not of type String", &|| fmi2GetString(host.c, &raw const speed, 1, (&raw const text).cast_mut())),
            ("not of type String", &|| fmi2SetString(host.c, &raw const speed, 1, &raw const value)),
        ]
    };
    for (words, call) in calls {
        host.lines();
        assert_eq!(call(), Status::Error);
        let line = host.lines().remove(0);
        assert!(line.message.contains(words), "{words}: {line:?}");
        assert_eq!(host.restore(state), Status::Ok);
    }
    (text, flag) = (ptr::null(), flag + 1);
    assert!(text.is_null() && flag == 1);
}

#[test]
fn values_outside_their_range_and_nan_are_discarded_and_change_nothing() {
    for scene in SCENES {
        let host = Host::started(scene);
        let all = host.reals();
        let before = host.get(&all).unwrap();
        for variable in host.table().iter().filter(|variable| variable.causality == Causality::Input) {
            let Kind::Real { max: Some(max), min: Some(min), .. } = variable.kind else { panic!("{}", variable.name) };
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, max * 1.001, min * 1.001] {
                // A good value before the bad one must not be taken either.
                let good = host.reference("shaft.speed");
                assert_eq!(host.set(&[good, variable.reference], &[12.5, value]), Status::Discard, "{}", variable.name);
                let line = host.lines().pop().unwrap();
                assert_eq!((line.status, line.category.as_str()), (Status::Discard, "logStatusDiscard"));
                assert!(line.message.contains(&variable.name), "{line:?}");
            }
        }
        assert_eq!(host.get(&all).unwrap(), before);
        // The run goes on.
        assert_eq!(host.step(0.0, 1e-5), Status::Ok);
    }
}

#[test]
fn outputs_cannot_be_set_and_parameters_not_after_initialization() {
    for scene in SCENES {
        let host = Host::started(scene);
        let state = host.save();
        let all = host.reals();
        let before = host.get(&all).unwrap();
        for variable in host.table().iter().filter(|variable| variable.causality != Causality::Input) {
            let status = match variable.kind {
                Kind::Real { start, .. } => host.set(&[variable.reference], &[start.unwrap_or(0.0)]),
                _ => host.set_integers(&[variable.reference], &[1]),
            };
            assert_eq!(status, Status::Error, "{}", variable.name);
            assert_eq!(host.get(&all).unwrap(), before);
            assert_eq!(host.restore(state), Status::Ok);
        }
    }
}

#[test]
fn outputs_follow_inputs_that_feed_through_without_a_step() {
    let host = Host::of("6205-hosted");
    let (y, force) = (host.reference("shaft.y"), host.reference("shaft.force.y"));
    // Deeper than the clearance of 5 µm.
    assert_eq!(host.set(&[y], &[-20e-6]), Status::Ok);
    host.start();
    let before = host.get(&[y, force]).unwrap();
    assert_eq!(host.set(&[y], &[before[0] - 1e-6]), Status::Ok);
    // Pushed down further, the bearing pushes back up.
    assert!(host.get(&[force]).unwrap()[0] > before[1]);
    assert_eq!(host.set(&[y], &[before[0]]), Status::Ok);
    assert_eq!(host.get(&[force]).unwrap()[0].to_bits(), before[1].to_bits());
}

#[test]
fn misaligned_overlapping_and_absurdly_long_arrays_are_refused() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let mut words = [0u32; 16];
    let base = words.as_mut_ptr();
    // SAFETY: these arguments break the contract in ways that are refused before memory is touched.
    let calls: [(&str, &dyn Fn() -> Status); 4] = unsafe {
        [
            ("aligned", &|| fmi2GetReal(host.c, base.byte_add(1), 1, base.add(8).cast())),
            ("overlap", &|| fmi2GetReal(host.c, base, 4, base.add(2).cast())),
            ("elements", &|| fmi2SetReal(host.c, base, usize::MAX, base.add(8).cast())),
            ("elements", &|| fmi2SetReal(host.c, base, 1 << 40, base.add(8).cast())),
        ]
    };
    for (word, call) in calls {
        host.lines();
        assert_eq!(call(), Status::Error);
        let line = host.lines().remove(0);
        assert!(line.message.contains(word), "{line:?}");
        assert_eq!(host.restore(state), Status::Ok);
    }
}
