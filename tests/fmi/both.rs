//! What must be true of either version, said once; a test of each version's own says it of that version.

use crate::two::any_host::{Host, Version};
use crate::two::{Line, bits};
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind};
use brinell_fmi::fmi2::{Component, FmuState, Status};
use brinell_tests::resources::Resources;
use std::sync::Arc;
use std::{fs, ptr};

pub(crate) type Call = fn(Component) -> Status;
/// A function, what is said about it, and a call of it.
pub(crate) type Probe = (&'static str, &'static str, Call);

/// Calls of functions with these arguments behind the handle, and a word on each.
macro_rules! probes {
    ($($name:ident $word:literal ($($argument:expr),*);)*) => {
        // SAFETY of all the blocks: the handle may be any; pointers are NULL, to one value, or not read.
        [$((stringify!($name), $word, (|c| unsafe { $name(c, $($argument),*) }) as $crate::both::Call)),*]
    };
}
pub(crate) use probes;

/// Each is an error whose line begins with the function and has the word, and it costs nothing.
pub(crate) fn refuse<V: Version>(host: &Host<V>, probes: &[Probe]) {
    let state = host.save();
    for (name, word, probe) in probes {
        let message = host.refuses(state, &[name, word], |host| probe(host.c));
        assert!(message.starts_with(name), "{message}");
    }
}

/// The modes of co-simulation: Instantiated, initialiZation, step Complete, Terminated, Error.
pub(crate) const MODES: &str = "IZCTE";

/// An instance in a mode, with what its version wants beforehand.
pub(crate) fn in_mode<V: Version>(mode: char, beforehand: impl Fn(&Host<V>)) -> Host<V> {
    let host = Host::of("6205-healthy");
    beforehand(&host);
    if mode != 'I' {
        assert_eq!(host.begin(None, 0.0, None), Status::Ok);
    }
    if "CTE".contains(mode) {
        assert_eq!(host.exit(), Status::Ok);
    }
    match mode {
        'T' => assert_eq!(host.terminate(), Status::Ok),
        'E' => assert_eq!(host.advance(0.0, -1.0), Status::Error),
        _ => {}
    }
    host.lines();
    host
}

/// Each function is allowed in the modes that its word names and in no other; `look` sees its status and what was
/// logged last.
pub(crate) fn allowed_in_their_modes<V: Version>(
    probes: &[Probe],
    beforehand: impl Fn(&Host<V>),
    look: impl Fn(&str, Status, Option<&Line>),
) {
    for (name, allowed, probe) in probes {
        for mode in MODES.chars() {
            let host = in_mode(mode, &beforehand);
            let status = probe(host.c);
            let lines = host.lines();
            if allowed.contains(mode) {
                assert!(status <= Status::Discard, "{name} in {mode}: {lines:?}");
            } else {
                assert_eq!(status, Status::Error, "{name} in {mode}");
                let line = lines.last().unwrap();
                assert!(line.message.starts_with(name) && line.message.contains("not allowed in mode"), "{line:?}");
            }
            look(name, status, lines.last());
        }
    }
}

/// A reset instance runs like a new one to the bit.
pub(crate) fn runs_anew_after_a_reset<V: Version>() {
    let run = |host: &Host<V>| {
        host.start();
        for n in 0..20 {
            assert_eq!(host.advance(f64::from(n) * 1e-4, 1e-4), Status::Ok);
        }
        bits(&host.all())
    };
    let host = Host::of("er16k-tb1");
    let first = run(&host);
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(host.set(&[host.reference("cage.slip")], &[0.5]), Status::Ok);
    assert_ne!(run(&host), first);
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(run(&host), first);
}

/// Length of the steps of [`run`].
pub(crate) const STEP: f64 = 1e-4;

/// Steps `count` times from step number `first`, with a speed that changes, and gives all reals after each.
pub(crate) fn run<V: Version>(host: &Host<V>, first: u32, count: u32) -> Vec<Vec<u64>> {
    let speed = host.reference("shaft.speed");
    (first..first + count)
        .map(|n| {
            assert_eq!(host.set(&[speed], &[60.0 + 0.1 * f64::from(n)]), Status::Ok);
            assert_eq!(host.advance(f64::from(n) * STEP, STEP), Status::Ok, "{:?}", host.lines());
            bits(&host.all())
        })
        .collect()
}

pub(crate) const SCENES: [&str; 3] = ["er16k-tb1", "6205-hosted", "6205-epps"];

/// A rewound instance repeats every bit.
pub(crate) fn repeats_when_rewound<V: Version>() {
    for scene in SCENES {
        let host = Host::<V>::started(scene);
        run(&host, 0, 55);
        // An element of the ER16K has just met the spall's edge.
        let state = host.save();
        let before = bits(&host.all());
        let first = run(&host, 55, 20);
        for _ in 0..2 {
            assert_eq!(host.restore(state), Status::Ok);
            assert_eq!(bits(&host.all()), before, "{scene}");
            assert_eq!(run(&host, 55, 20), first, "{scene}");
        }
        assert_eq!(host.free(state), Status::Ok);
    }
}

/// A state in bytes continues in another instance bit by bit.
pub(crate) fn continues_from_bytes<V: Version>() {
    for scene in SCENES {
        let host = Host::<V>::of(scene);
        // Parameters travel with the state.
        assert_eq!(host.set(&[host.reference("contact.damping")], &[0.3]), Status::Ok);
        host.start();
        run(&host, 0, 55);
        let bytes = host.serialize(host.save());
        let expected = run(&host, 55, 20);
        let other = Host::<V>::of(scene);
        let state = other.deserialize(&bytes).unwrap();
        assert_eq!(other.restore(state), Status::Ok);
        assert_eq!(run(&other, 55, 20), expected, "{scene}");
        assert_eq!(other.serialize(state), bytes, "{scene}");
        for wrong in [&bytes[..bytes.len() - 1], &bytes[..10], &[]] {
            assert!(other.deserialize(wrong).is_err());
            assert_eq!(other.restore(state), Status::Ok);
        }
    }
}

/// A state passed where its address belongs, as the program fmusim does it, which stops at any status but OK, is freed
/// and logged; one that is freed or another instance's is refused. None of them is followed.
pub(crate) fn frees_a_state_by_value<V: Version>() {
    let (host, other) = (Host::<V>::started("er16k-tb1"), Host::<V>::started("er16k-tb1"));
    let (keep, state, foreign) = (host.save(), host.save(), other.save());
    // SAFETY: what is tested: handles, which are no addresses.
    let free = |state: FmuState| unsafe { (V::FUNCTIONS.free_state)(host.c, state.cast()) };
    assert_eq!(free(state), Status::Ok);
    let line = host.lines().pop().unwrap();
    assert!(line.status == Status::Warning && line.message.contains("it is freed"), "{line:?}");
    // The run goes on.
    run(&host, 0, 2);
    for wrong in [state, foreign] {
        assert_eq!(free(wrong), Status::Error);
        assert_eq!(host.restore(keep), Status::Ok);
    }
    let (bytes, as_address) = (host.serialize(keep), keep.cast());
    // SAFETY: as above; bytes as long as said.
    host.refuses(keep, &["not the address"], |h| unsafe { (V::FUNCTIONS.get_state)(h.c, as_address) });
    host.refuses(keep, &[], |h| unsafe {
        (V::FUNCTIONS.deserialize)(h.c, bytes.as_ptr().cast(), bytes.len(), as_address)
    });
    assert_eq!(other.restore(foreign), Status::Ok);
}

/// Bytes that lie over the handle they are to give are refused.
pub(crate) fn refuses_bytes_over_their_handle<V: Version>() {
    let host = Host::<V>::started("er16k-tb1");
    let good = host.serialize(host.save());
    let mut words = vec![0u64; good.len().div_ceil(8)];
    for (word, bytes) in words.iter_mut().zip(good.chunks(8)) {
        let mut eight = [0; 8];
        eight[..bytes.len()].copy_from_slice(bytes);
        *word = u64::from_ne_bytes(eight);
    }
    // A word of zeros, which would pass for a handle that is NULL.
    let zero = words.iter().position(|word| *word == 0).unwrap();
    let before = words.clone();
    let base = words.as_mut_ptr();
    // SAFETY: as many bytes as said, with the handle among them, which is what is tested.
    let status =
        unsafe { (V::FUNCTIONS.deserialize)(host.c, base.cast_const().cast(), good.len(), base.add(zero).cast()) };
    assert_eq!((status, words), (Status::Error, before));
    assert!(host.last_message().contains("overlap"));
}

/// A panic fails its own instance and no other. Tests are built with the feature `panic-on-demand`.
pub(crate) fn a_panic_fails_its_instance_alone<V: Version>() {
    let (bad, good) = (Host::<V>::named("er16k-tb1", "panic on demand"), Host::<V>::started("er16k-tb1"));
    bad.start();
    // A saved state brings it back.
    let state = bad.save();
    bad.refuses(state, &["internal error: panic on demand"], |host| host.advance(0.0, 1e-4));
    assert_eq!(bad.advance(0.0, 1e-4), Status::Error);
    bad.refuses(state, &["not allowed in mode"], |host| host.advance(0.0, 1e-4));
    assert_eq!(good.advance(0.0, 1e-4), Status::Ok);
    assert_eq!(bad.all().len(), good.all().len());
    // So does a reset.
    assert_eq!((bad.advance(0.0, 1e-4), bad.reset()), (Status::Error, Status::Ok));
    bad.start();
}

/// States that are NULL, invented, freed or another instance's are errors.
pub(crate) fn refuses_states_of_nobody<V: Version>() {
    let (host, other) = (Host::<V>::started("er16k-tb1"), Host::<V>::started("er16k-tb1"));
    let (own, freed, foreign) = (host.save(), host.save(), other.save());
    assert_eq!(host.free(freed), Status::Ok);
    let mut list: Vec<FmuState> = vec![ptr::null_mut(), freed, foreign, host.c];
    let invented = [1, 8, 24, 0x1234, usize::MAX, own.addr() ^ 16, own.addr() | 1].map(ptr::without_provenance_mut);
    list.extend(invented.into_iter().filter(|state| *state != freed));
    for state in list {
        let words: &[&str] = if state.is_null() { &[] } else { &["not one of this instance's"] };
        host.refuses(own, words, |host| host.restore(state));
        let (mut size, mut handle) = (0, state);
        // SAFETY: any handle may be passed; pointers to one value.
        unsafe {
            assert_eq!((V::FUNCTIONS.state_size)(host.c, state, &raw mut size), Status::Error);
            assert_eq!((V::FUNCTIONS.serialize)(host.c, state, ptr::null_mut(), 0), Status::Error);
            if !state.is_null() {
                assert_eq!((V::FUNCTIONS.get_state)(host.c, &raw mut handle), Status::Error);
                assert_eq!((V::FUNCTIONS.free_state)(host.c, &raw mut handle), Status::Error);
            }
        }
        assert_eq!(handle, state);
    }
    assert_eq!((host.restore(own), other.restore(foreign)), (Status::Ok, Status::Ok));
}

/// An experiment needs a finite start and a later finite stop.
pub(crate) fn experiments_are_finite<V: Version>() {
    for (start, stop) in [
        (f64::NAN, None),
        (f64::INFINITY, None),
        (0.0, Some(f64::NAN)),
        (0.0, Some(0.0)),
        (0.0, Some(-1.0)),
        (0.0, Some(f64::INFINITY)),
        (1.0, Some(1.0)),
    ] {
        assert_eq!(Host::<V>::of("6205-healthy").begin(None, start, stop), Status::Error, "{start} {stop:?}");
    }
}

/// A tolerance of the host tightens the scene's and never loosens it.
pub(crate) fn a_tolerance_tightens_and_never_loosens<V: Version>() {
    let tolerance_after = |given: f64| {
        let host = Host::<V>::of("er16k-tb1");
        assert_eq!(host.begin(Some(given), 0.0, None), Status::Ok);
        host.get(&[host.reference("solver.tolerance")]).unwrap()[0]
    };
    // The scene says 1e-5; 1e-12 is the smallest that may be set.
    assert_eq!([1e-3, 1e-5, 1e-7, 1e-30].map(tolerance_after), [1e-5, 1e-5, 1e-7, 1e-12]);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(Host::<V>::of("er16k-tb1").begin(Some(bad), 0.0, None), Status::Error);
    }
}

/// Values outside their range and NaN are discarded, all or none of a call, and change nothing.
pub(crate) fn discards_values_outside_their_range<V: Version>() {
    for scene in SCENES {
        let host = Host::<V>::started(scene);
        let (good, before) = (host.reference("shaft.speed"), bits(&host.all()));
        for variable in host.table().iter().filter(|variable| variable.causality == Causality::Input) {
            let Kind::Real { max: Some(max), min: Some(min), .. } = variable.kind else { panic!("{}", variable.name) };
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, max * 1.001, min * 1.001] {
                // A good value before the bad one must not be taken either.
                assert_eq!(host.set(&[good, variable.reference], &[12.5, value]), Status::Discard, "{}", variable.name);
                let line = host.lines().pop().unwrap();
                assert_eq!((line.status, line.category.as_str()), (Status::Discard, "logStatusDiscard"));
                let limit = if variable.reference == good { "100000" } else { "" };
                assert!(line.message.contains(&variable.name) && line.message.contains(limit), "{line:?}");
            }
        }
        assert_eq!(bits(&host.all()), before);
        // The run goes on.
        assert_eq!(host.advance(0.0, 1e-5), Status::Ok);
    }
}

/// Resources of an FMU that lists the variables of model exchange.
pub(crate) fn for_both_kinds(scene: &str) -> Arc<Resources> {
    let resources = Resources::of(scene);
    fs::write(resources.directory.join("interface"), "model-exchange").unwrap();
    resources.into()
}

/// An instance for co-simulation of an FMU for both kinds shows states, their derivatives and event indicators from
/// initialization to the end, with their derivatives, and steps to the same bits as one that nobody asks for them. In
/// an FMU for co-simulation alone there are no such variables.
pub(crate) fn shows_the_variables_of_model_exchange_when_stepped<V: Version>(
    derive: impl Fn(&Host<V>, u32, u32) -> Result<f64, Status>,
) {
    for scene in ["er16k-tb1", "er16k-inner", "6205-hosted", "6205-epps", "6205-irregular-cage", "7205-preloaded"] {
        let (plain, host) = (Host::<V>::of(scene), Host::<V>::with(for_both_kinds(scene), "both", true));
        let mut own = host.simulation().clone();
        let exchanged = own.exchange_variables();
        let references: Vec<u32> = exchanged.iter().map(|variable| variable.reference).collect();
        let agrees = |own: &mut Simulation, when: &str| {
            let shown = host.get(&references).unwrap_or_else(|status| panic!("{when}: {status:?}: {:?}", host.lines()));
            let expected = references.iter().map(|&reference| own.exchange_value(reference).unwrap().unwrap());
            let expected = expected.collect::<Vec<_>>();
            assert_eq!(bits(&shown), bits(&expected), "{scene} {when}");
        };
        for host in [&plain, &host] {
            assert_eq!(host.begin(None, 0.0, None), Status::Ok);
        }
        agrees(&mut own, "in initialization mode");
        own.initialize(0.0).unwrap();
        assert_eq!([plain.exit(), host.exit()], [Status::Ok; 2]);
        for n in 0..40 {
            agrees(&mut own, "at a communication point");
            own.step(STEP).unwrap();
            for host in [&plain, &host] {
                assert_eq!(host.advance(f64::from(n) * STEP, STEP), Status::Ok, "{:?}", host.lines());
            }
        }
        assert_eq!(bits(&plain.all()), bits(&host.all()), "{scene}");
        let named = |name: &str| exchanged.iter().find(|variable| variable.name == name).unwrap().reference;
        let (speed, cage) = (host.reference("shaft.speed"), named("der(state.cage.angle)"));
        // The cage turns with the shaft by its kinematics: 0.38 to 0.42 of it in these bearings.
        let share = derive(&host, cage, speed).unwrap();
        assert!((0.35..0.45).contains(&share), "{scene}: {share}");
        assert_eq!(host.terminate(), Status::Ok);
        agrees(&mut own, "after the end");
        for references in [&references[..1], &references[..]] {
            assert_eq!(plain.get(references), Err(Status::Error), "{scene}");
        }
    }
}
