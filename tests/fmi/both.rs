//! What must be true of either version, said once; a test of each version's own says it of that version.

use crate::two::any_host::{Host, Version};
use crate::two::{Line, bits};
use brinell_fmi::fmi2::{Component, FmuState, Status};

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

/// Each function is allowed in the modes that its word names and in no other; `look` sees its status and what was logged
/// last.
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

const SCENES: [&str; 3] = ["er16k-tb1", "6205-hosted", "6205-epps"];

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
