//! Hosts that break the rules: whatever they do, nothing crashes, and no NaN leaves under OK.

use crate::host::{Host, logger};
use brinell_fmi::fmi2::*;
use proptest::prelude::*;
use std::ptr;

#[test]
fn a_logger_that_calls_back_into_its_instance_is_turned_away() {
    let host = Host::started("er16k-tb1");
    *host.log.meddle_with.borrow_mut() = Some((host.c, None));
    assert_eq!(host.step(0.5, 1e-4), Status::Error);
    let meddled = host.log.meddle_with.take().unwrap();
    assert_eq!(meddled.1, Some(Status::Error));
    // The instance is still there.
    assert_eq!(host.reset(), Status::Ok);
}

#[test]
fn a_logger_may_call_another_instance() {
    let (host, other) = (Host::started("er16k-tb1"), Host::started("er16k-tb1"));
    *host.log.meddle_with.borrow_mut() = Some((other.c, None));
    assert_eq!(host.step(0.5, 1e-4), Status::Error);
    // It freed the other one; resetting that is then an error.
    assert_eq!(host.log.meddle_with.take().unwrap().1, Some(Status::Error));
}

#[test]
fn every_pointer_may_be_null_in_every_function() {
    let _ = logger();
    let host = Host::started("er16k-tb1");
    let state = host.save();
    let c = host.c;
    // SAFETY: NULL is what is tested, with counts that say otherwise.
    let calls: Vec<Box<dyn Fn() -> Status>> = unsafe {
        vec![
            Box::new(move || fmi2SetDebugLogging(c, TRUE, 3, ptr::null())),
            Box::new(move || fmi2GetReal(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2GetInteger(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2GetBoolean(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2GetString(c, ptr::null(), 3, ptr::null_mut())),
            Box::new(move || fmi2SetReal(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2SetInteger(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2SetBoolean(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2SetString(c, ptr::null(), 3, ptr::null())),
            Box::new(move || fmi2GetFMUstate(c, ptr::null_mut())),
            Box::new(move || fmi2SetFMUstate(c, ptr::null_mut())),
            Box::new(move || fmi2SerializedFMUstateSize(c, ptr::null_mut(), ptr::null_mut())),
            Box::new(move || fmi2SerializeFMUstate(c, ptr::null_mut(), ptr::null_mut(), 9)),
            Box::new(move || fmi2DeSerializeFMUstate(c, ptr::null(), 9, ptr::null_mut())),
            Box::new(move || {
                fmi2GetDirectionalDerivative(c, ptr::null(), 1, ptr::null(), 1, ptr::null(), ptr::null_mut())
            }),
            Box::new(move || fmi2SetRealInputDerivatives(c, ptr::null(), 1, ptr::null(), ptr::null())),
            Box::new(move || fmi2GetRealOutputDerivatives(c, ptr::null(), 1, ptr::null(), ptr::null_mut())),
            Box::new(move || fmi2GetStatus(c, DO_STEP_STATUS, ptr::null_mut())),
            Box::new(move || fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, ptr::null_mut())),
            Box::new(move || fmi2GetBooleanStatus(c, TERMINATED, ptr::null_mut())),
            Box::new(move || fmi2GetStringStatus(c, PENDING_STATUS, ptr::null_mut())),
        ]
    };
    for (number, call) in calls.iter().enumerate() {
        assert_eq!(call(), Status::Error, "call {number}");
        assert_eq!(host.restore(state), Status::Ok);
    }
}

/// One call of a host that has lost its mind.
#[derive(Debug, Clone)]
enum Whim {
    Setup(f64, Option<f64>),
    Enter,
    Exit,
    Terminate,
    Reset,
    Step(f64, f64),
    StepOn(f64),
    Get(u32),
    Set(u32, f64),
    SetInteger(u32, i32),
    Rate(u32, i32, f64),
    Save,
    Restore(usize),
    Free(usize),
    Bytes(usize, usize, u8),
    Cancel,
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>(),
        prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 1e-4, 1e-3, 1e-9, 1e9, f64::NAN, f64::INFINITY, 5e-324]),
        -1e3..1e3,
        -1e-4..1e-4,
    ]
}

fn whim() -> impl Strategy<Value = Whim> {
    // References reach a little past the table's end.
    let reference = || 0u32..100;
    prop_oneof![
        1 => (number(), prop::option::of(number())).prop_map(|(start, stop)| Whim::Setup(start, stop)),
        2 => Just(Whim::Setup(0.0, None)),
        3 => Just(Whim::Enter),
        3 => Just(Whim::Exit),
        1 => Just(Whim::Terminate),
        2 => Just(Whim::Reset),
        1 => (number(), number().prop_filter("steps of minutes take minutes", |step| *step <= 1e-2 || step.is_nan()))
            .prop_map(|(point, step)| Whim::Step(point, step)),
        6 => (1e-7..1e-4).prop_map(Whim::StepOn),
        6 => reference().prop_map(Whim::Get),
        6 => (reference(), number()).prop_map(|(reference, value)| Whim::Set(reference, value)),
        1 => (reference(), any::<i32>()).prop_map(|(reference, value)| Whim::SetInteger(reference, value)),
        2 => (reference(), -1..4, number()).prop_map(|(reference, order, value)| Whim::Rate(reference, order, value)),
        2 => Just(Whim::Save),
        2 => (0usize..4).prop_map(Whim::Restore),
        1 => (0usize..4).prop_map(Whim::Free),
        1 => (0usize..4, any::<usize>(), any::<u8>()).prop_map(|(state, place, flip)| Whim::Bytes(state, place, flip)),
        1 => Just(Whim::Cancel),
    ]
}

fn indulge(host: &Host, whims: &[Whim]) {
    let mut states = vec![ptr::null_mut()];
    let all = host.reals();
    for whim in whims {
        let pick = |number: usize| states[number % states.len()];
        match *whim {
            Whim::Setup(start, stop) => drop(host.setup(None, start, stop)),
            Whim::Enter => drop(host.enter()),
            Whim::Exit => drop(host.exit()),
            Whim::Terminate => drop(host.terminate()),
            Whim::Reset => drop(host.reset()),
            Whim::Step(point, step) => drop(host.step(point, step)),
            Whim::StepOn(step) => {
                let mut time = 0.0;
                // SAFETY: a place for one value.
                unsafe { fmi2GetRealStatus(host.c, LAST_SUCCESSFUL_TIME, &raw mut time) };
                host.step(time, step);
            }
            Whim::Get(reference) => {
                if let Ok(values) = host.get(&[reference]) {
                    assert!(values[0].is_finite());
                }
            }
            Whim::Set(reference, value) => drop(host.set(&[reference], &[value])),
            Whim::SetInteger(reference, value) => drop(host.set_integers(&[reference], &[value])),
            Whim::Rate(reference, order, value) => {
                // SAFETY: one element each.
                unsafe {
                    fmi2SetRealInputDerivatives(host.c, &raw const reference, 1, &raw const order, &raw const value)
                };
            }
            Whim::Save => states.push(host.save()),
            Whim::Restore(state) => drop(host.restore(pick(state))),
            Whim::Free(state) => drop(host.free(pick(state))),
            Whim::Bytes(state, place, flip) => {
                let mut size = 0;
                // SAFETY: any handle may be passed; a place for one value.
                if unsafe { fmi2SerializedFMUstateSize(host.c, pick(state), &raw mut size) } == Status::Ok {
                    let mut bytes = host.serialize(pick(state));
                    let place = place % bytes.len();
                    bytes[place] ^= flip;
                    if let Ok(state) = host.deserialize(&bytes) {
                        assert_eq!(flip, 0);
                        states.push(state);
                    }
                }
            }
            Whim::Cancel => {
                // SAFETY: any handle may be passed.
                unsafe { fmi2CancelStep(host.c) };
            }
        }
    }
    if let Ok(values) = host.get(&all) {
        assert!(values.iter().all(|value| value.is_finite()));
    }
    // However it went, a reset brings the instance back.
    assert_eq!(host.reset(), Status::Ok);
    host.start();
    assert_eq!(host.step(0.0, 1e-5), Status::Ok);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_sequence_of_calls_leaves_an_instance_that_can_be_reset(
        scene in prop::sample::select(vec!["er16k-tb1", "6205-hosted", "6205-epps", "er16k-tb1-hosted-shaft"]),
        whims in prop::collection::vec(whim(), 1..60),
    ) {
        indulge(&Host::of(scene), &whims);
    }
}
