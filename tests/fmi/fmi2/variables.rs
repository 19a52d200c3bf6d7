//! Reading and setting variables.

use crate::both::{self, SCENES};
use crate::two::{Host, Two};
use brinell::simulation::interface::table::{Causality, Kind};
use brinell_fmi::fmi2::*;
use std::ptr;

#[test]
fn initialization_shows_the_start_values_of_the_table() {
    for scene in SCENES {
        let host = Host::initializing(scene);
        for variable in host.table() {
            if let Kind::Real { start: Some(start), .. } = variable.kind {
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
    assert_eq!(host.begin(None, 0.0, None), Status::Ok);
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
    let (reference, value) = (&0, &mut 0.0);
    // SAFETY of all the blocks: one element each, or NULL, which is what is tested.
    let [vr, of] = ["argument vr is NULL", "argument value is NULL"];
    host.refuses(state, &[vr], |h| unsafe { fmi2GetReal(h.c, ptr::null(), 1, value) });
    host.refuses(state, &[of], |h| unsafe { fmi2GetReal(h.c, reference, 1, ptr::null_mut()) });
    host.refuses(state, &[vr], |h| unsafe { fmi2SetReal(h.c, ptr::null(), 1, value) });
    host.refuses(state, &[of], |h| unsafe { fmi2SetReal(h.c, reference, 1, ptr::null()) });
}

#[test]
fn unknown_references_and_wrong_types_are_errors_that_say_so() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let count = host.table().len() as u32;
    let [speed, steps] = ["shaft.speed", "solver.steps"].map(|name| host.reference(name));
    let (mut flag, mut text, value) = (0, ptr::null(), c"x".as_ptr());
    let (flag, text) = (&raw mut flag, &raw mut text);
    let unknown = |call: &dyn Fn(&Host) -> Status| {
        host.refuses(state, &[&format!("is unknown: this model's references are 0 to {}", count - 1)], call);
    };
    let mistyped = |kind: &str, call: &dyn Fn(&Host) -> Status| {
        host.refuses(state, &[&format!("not of type {kind}")], call);
    };
    // SAFETY of all the blocks: one element each.
    unknown(&|h| h.get(&[count]).unwrap_err());
    unknown(&|h| h.get(&[speed, u32::MAX]).unwrap_err());
    unknown(&|h| h.get_integers(&[count]).unwrap_err());
    unknown(&|h| h.set(&[count], &[0.0]));
    unknown(&|h| h.set_integers(&[count], &[0]));
    unknown(&|h| unsafe { fmi2GetBoolean(h.c, &count, 1, flag) });
    unknown(&|h| unsafe { fmi2GetString(h.c, &count, 1, text) });
    mistyped("Real", &|h| h.get(&[steps]).unwrap_err());
    mistyped("Integer", &|h| h.get_integers(&[speed]).unwrap_err());
    mistyped("Boolean", &|h| unsafe { fmi2GetBoolean(h.c, &speed, 1, flag) });
    mistyped("Boolean", &|h| unsafe { fmi2SetBoolean(h.c, &speed, 1, flag) });
    mistyped("String", &|h| unsafe { fmi2GetString(h.c, &speed, 1, text) });
    mistyped("String", &|h| unsafe { fmi2SetString(h.c, &speed, 1, &value) });
}

#[test]
fn values_outside_their_range_and_nan_are_discarded_and_change_nothing() {
    both::discards_values_outside_their_range::<Two>();
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
    let (odd, third, ninth) = (base.wrapping_byte_add(1), base.wrapping_add(2).cast(), base.wrapping_add(8).cast());
    // SAFETY of all the blocks: broken contracts are refused before memory is touched.
    host.refuses(state, &["aligned"], |h| unsafe { fmi2GetReal(h.c, odd, 1, ninth) });
    host.refuses(state, &["overlap"], |h| unsafe { fmi2GetReal(h.c, base, 4, third) });
    host.refuses(state, &["elements"], |h| unsafe { fmi2SetReal(h.c, base, usize::MAX, ninth) });
    host.refuses(state, &["elements"], |h| unsafe { fmi2SetReal(h.c, base, 1 << 40, ninth) });
}
