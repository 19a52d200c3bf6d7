//! Reading and setting: scalars, arrays, types, and what is refused.

use crate::both::{self, probes, refuse};
use crate::three::{Host, Three};
use crate::two::{self, Resources, bits};
use brinell::simulation::interface::table::{Causality, Kind};
use brinell_fmi::fmi3::*;
use std::ffi::CStr;
use std::ptr;

#[test]
fn an_array_has_the_values_of_all_elements_in_their_order() {
    for scene in ["er16k-tb1", "er16k-element"] {
        let (host, other) = (Host::started(scene), two::Host::started(scene));
        for n in 0..30 {
            let point = f64::from(n) * 1e-4;
            host.step(point, 1e-4);
            assert_eq!(other.step(point, 1e-4), Status::Ok);
        }
        for quantity in ["angle", "path", "force.inner", "force.outer"] {
            let names = (1..=9).map(|j| other.reference(&format!("element[{j}].{quantity}")));
            let expected = other.get(&names.collect::<Vec<_>>()).unwrap();
            let found = host.array(&format!("element.{quantity}")).unwrap();
            assert_eq!(bits(&found), bits(&expected), "{quantity}");
        }
        // Scalars and arrays in one call, in any order.
        let (path, y, time) = (host.reference("element.path"), host.reference("shaft.y"), host.reference("time"));
        let mixed = host.get_values(&[y, path, time, y], 12).unwrap();
        assert_eq!((mixed[0], mixed[10], mixed[11]), (mixed[11], 29.0 * 1e-4 + 1e-4, mixed[0]));
        assert_eq!(mixed[1..10], host.array("element.path").unwrap());
    }
}

#[test]
fn what_only_a_defective_element_has_is_a_scalar() {
    let host = Host::started("er16k-element");
    let name = host.table().iter().find(|row| row.name.ends_with("spin_angle")).unwrap().name.clone();
    assert!(name.starts_with("element[1]."));
    assert!(host.get(&[host.reference(&name)]).unwrap()[0].is_finite());
}

#[test]
fn a_number_of_values_that_does_not_fit_is_an_error_with_both_numbers() {
    let host = Host::started("er16k-tb1");
    let (state, path, y) = (host.save(), host.reference("element.path"), host.reference("shaft.y"));
    for (references, count, needed) in [
        (&[path][..], 1, "9 values"),
        (&[path], 10, "9 values"),
        (&[y, path], 9, "10 values"),
        (&[y], 2, "1 values"),
        (&[y, y], 1, "2 values"),
        (&[], 1, "0 values"),
    ] {
        let words = ["nValues", &format!("= {count}:"), needed];
        host.refuses(state, &words, |h| h.get_values(references, count).unwrap_err());
    }
    let speed = host.reference("shaft.speed");
    host.refuses(state, &["nValues = 2", "1 values"], |h| h.set(&[speed], &[1.0, 2.0]));
}

#[test]
fn unknown_references_wrong_types_and_what_cannot_be_set_are_errors_that_say_so() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let hidden = host.simulation().reference("element[2].path").unwrap();
    let steps = host.reference("solver.steps");
    let law = host.reference("contact.law");
    let y = host.reference("shaft.y");
    for unknown in [hidden, 5_000, u32::MAX] {
        let word = format!("value reference {unknown} is unknown");
        host.refuses(state, &[&word], |h| h.get(&[unknown]).unwrap_err());
        host.refuses(state, &[&word], |h| h.set(&[unknown], &[1.0]));
    }
    for wrong in [steps, law] {
        host.refuses(state, &["is not of type Real"], |h| h.get(&[wrong]).unwrap_err());
    }
    // SAFETY of all the blocks: one reference and one value each.
    host.refuses(state, &["shaft.y", "Int64"], |h| unsafe { fmi3GetInt64(h.c, &y, 1, &mut 0, 1) });
    host.refuses(state, &["shaft.y", "UInt64"], |h| unsafe { fmi3GetUInt64(h.c, &y, 1, &mut 0, 1) });
    host.refuses(state, &["shaft.y", "Boolean"], |h| unsafe { fmi3GetBoolean(h.c, &y, 1, &mut 0, 1) });
    host.refuses(state, &["shaft.y", "Int32"], |h| unsafe { fmi3SetInt32(h.c, &y, 1, &0, 1) });
    host.refuses(state, &["shaft.y", "Binary"], |h| unsafe { fmi3GetBinary(h.c, &y, 1, &mut 0, &mut ptr::null(), 1) });
    host.refuses(state, &["shaft.y", "Clock"], |h| unsafe { fmi3GetClock(h.c, &y, 1, &mut 0) });
    host.refuses(state, &["solver.steps", "computed"], |h| unsafe { fmi3SetUInt64(h.c, &steps, 1, &0, 1) });
    host.refuses(state, &["contact.law", "fixed after"], |h| unsafe { fmi3SetInt64(h.c, &law, 1, &1, 1) });
    host.refuses(state, &["shaft.y", "computed"], |h| h.set(&[y], &[1.0]));
    host.refuses(state, &["cage.slip", "fixed after"], |h| h.set(&[h.reference("cage.slip")], &[0.1]));
    let time = host.reference("time");
    host.refuses(state, &["time", "computed"], |h| h.set(&[time], &[1.0]));
    let path = host.reference("element.path");
    host.refuses(state, &["element.path", "computed"], |h| h.set(&[path], &[0.0; 9]));
}

#[test]
fn values_outside_their_range_and_nan_are_discarded_under_fmi_3_and_change_nothing() {
    both::discards_values_outside_their_range::<Three>();
}

#[test]
fn counters_enumerations_and_strings_have_their_types() {
    let recorder = |text: String| text + "\n[recorder]\nrate_hz = 51200.0\nfilter = \"none\"\n";
    let host = Host::with(Resources::edited("er16k-tb1", "resources", recorder), "instance 1", true);
    let law = host.reference("contact.law");
    let mut value = 0;
    // SAFETY of all the blocks: one reference and one value each; strings end in NUL.
    unsafe {
        assert_eq!(fmi3GetInt64(host.c, &law, 1, &mut value, 1), Status::Ok);
        let other = if value == 1 { 2 } else { 1 };
        assert_eq!(fmi3SetInt64(host.c, &law, 1, &other, 1), Status::Ok);
        let mut now = 0;
        assert_eq!(fmi3GetInt64(host.c, &law, 1, &mut now, 1), Status::Ok);
        assert_eq!(now, other);
        for wrong in [0, 4, i64::MAX, i64::MIN] {
            assert_eq!(fmi3SetInt64(host.c, &law, 1, &wrong, 1), Status::Discard);
            assert!(host.last_message().contains("contact.law"));
        }
        assert_eq!(fmi3SetInt64(host.c, &law, 1, &value, 1), Status::Ok);
        let folder = host.reference("recorder.folder");
        let mut text = ptr::null();
        assert_eq!(fmi3SetString(host.c, &folder, 1, &c"".as_ptr(), 1), Status::Ok);
        assert_eq!(fmi3GetString(host.c, &folder, 1, &mut text, 1), Status::Ok);
        assert_eq!(CStr::from_ptr(text), c"");
    }
    host.start();
    let steps = host.reference("solver.steps");
    let count = || {
        let mut count = 77;
        // SAFETY: one reference and one value.
        assert_eq!(unsafe { fmi3GetUInt64(host.c, &steps, 1, &mut count, 1) }, Status::Ok);
        count
    };
    assert_eq!(count(), 0);
    host.step(0.0, 1e-3);
    assert!(count() > 10);
}

#[test]
fn start_values_are_read_before_initialization_and_the_time_is_where_the_instance_is() {
    let host = Host::of("er16k-tb1");
    for row in host.table().iter().filter(|row| row.causality != Causality::Output) {
        if let Kind::Real { start: Some(start), .. } = row.kind {
            assert_eq!(host.get(&[row.reference]).unwrap(), [start], "{}", row.name);
        }
    }
    let time = host.reference("time");
    assert_eq!(host.begin(None, 3.5, None), Status::Ok);
    assert_eq!(host.get(&[time]).unwrap(), [3.5]);
    assert_eq!(host.exit(), Status::Ok);
    host.step(3.5, 0.25e-3);
    assert_eq!(host.get(&[time]).unwrap(), [3.5 + 0.25e-3]);
}

#[test]
fn misaligned_and_overlapping_arrays_and_null_are_refused_under_fmi_3() {
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let mut memory = [0.0f64; 8];
    let odd = memory.as_mut_ptr().wrapping_byte_add(1);
    let y = host.reference("shaft.y");
    // SAFETY of all the blocks: refused before memory is touched, or good.
    host.refuses(state, &["values", "aligned"], |h| unsafe { fmi3GetFloat64(h.c, &y, 1, odd, 1) });
    host.refuses(state, &["values", "NULL"], |h| unsafe { fmi3GetFloat64(h.c, &y, 1, ptr::null_mut(), 1) });
    host.refuses(state, &["valueReferences", "NULL"], |h| unsafe {
        fmi3GetFloat64(h.c, ptr::null(), 1, memory.as_mut_ptr(), 1)
    });
    host.refuses(state, &["overlap"], |h| unsafe {
        let pointer = memory.as_mut_ptr();
        fmi3GetFloat64(h.c, pointer.cast(), 1, pointer, 1)
    });
}

#[test]
fn every_pointer_may_be_null_in_every_function_of_fmi_3() {
    let calls = probes! {
        fmi3SetDebugLogging "" (TRUE, 1, ptr::null());
        fmi3GetFloat32 "" (ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetFloat64 "" (ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetInt64 "" (ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetUInt64 "" (ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetBoolean "" (ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetString "" (ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetBinary "" (ptr::null(), 1, ptr::null_mut(), ptr::null_mut(), 1);
        fmi3GetClock "" (ptr::null(), 1, ptr::null_mut());
        fmi3SetFloat64 "" (ptr::null(), 1, ptr::null(), 1);
        fmi3SetInt64 "" (ptr::null(), 1, ptr::null(), 1);
        fmi3SetUInt64 "" (ptr::null(), 1, ptr::null(), 1);
        fmi3SetString "" (ptr::null(), 1, ptr::null(), 1);
        fmi3GetNumberOfVariableDependencies "" (0, ptr::null_mut());
        fmi3GetVariableDependencies "" (12, ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), 5);
        fmi3GetFMUState "" (ptr::null_mut());
        fmi3SetFMUState "" (ptr::null_mut());
        fmi3SerializedFMUStateSize "" (ptr::null_mut(), ptr::null_mut());
        fmi3SerializeFMUState "" (ptr::null_mut(), ptr::null_mut(), 10);
        fmi3DeserializeFMUState "" (ptr::null(), 10, ptr::null_mut());
        fmi3GetDirectionalDerivative "" (ptr::null(), 1, ptr::null(), 1, ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetAdjointDerivative "" (ptr::null(), 1, ptr::null(), 1, ptr::null(), 1, ptr::null_mut(), 1);
        fmi3GetOutputDerivatives "" (ptr::null(), 1, ptr::null(), ptr::null_mut(), 1);
        fmi3DoStep "" (0.0, 1e-4, TRUE, ptr::null_mut(), ptr::null_mut(), ptr::null_mut(), ptr::null_mut());
    };
    let host = Host::started("er16k-tb1");
    refuse(&host, &calls);
    host.step(0.0, 1e-4);
}
