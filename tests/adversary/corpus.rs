//! What fuzzers start from and have found (`tests/fuzz/corpus`), each input as it is and with damages: a short form of
//! what they do for hours.

use crate::misuse::Chance;
use crate::targets;
use std::fs;

/// Damaged copies of all inputs of a target together, about.
const COPIES: usize = 800;

/// Bytes that mean something in text or in numbers.
const ODD: &[u8] = b"\0\x01\x7f\x80\xff09-.,eE\n\"[]=#nN";

fn damage(bytes: &mut Vec<u8>, chance: &mut Chance) {
    for _ in 0..=chance.below(3) {
        let (at, to) = (chance.below(bytes.len() + 1), chance.below(bytes.len() + 1));
        let (at, to) = (at.min(to), at.max(to).min(at + 16));
        match chance.below(4) {
            0 => drop(bytes.drain(at..to)),
            1 => drop(bytes.splice(at..at, bytes[at..to].to_vec())),
            2 if at < bytes.len() => bytes[at] ^= 1 << chance.below(8),
            _ => drop(bytes.splice(at..to.min(at + 1), [*chance.pick(ODD)])),
        }
    }
}

fn try_all(target: &str) {
    let mut files: Vec<_> = fs::read_dir(brinell_tests::root().join("tests/fuzz/corpus").join(target))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    assert!(!files.is_empty());
    let (mut chance, mut accepted) = (Chance::new(1), 0);
    let copies = COPIES / files.len();
    for file in files {
        let bytes = fs::read(&file).unwrap();
        accepted += usize::from(targets::run(target, &bytes));
        for _ in 0..copies {
            let mut bytes = bytes.clone();
            damage(&mut bytes, &mut chance);
            accepted += usize::from(targets::run(target, &bytes));
        }
    }
    // Seeds of an earlier format would all be refused, and nothing be tried behind that.
    assert!(accepted > 0, "{target}: nothing is accepted");
}

#[test]
fn damaged_maps_are_refused_or_give_finite_approaches() {
    try_all("map");
}

#[test]
fn damaged_recordings_are_refused_or_sized() {
    try_all("recording");
}

#[test]
fn damaged_scenes_are_refused_or_run() {
    try_all("scene");
}

#[test]
fn damaged_states_are_refused_or_can_be_stepped() {
    try_all("state");
}

#[test]
fn damaged_traces_are_refused_or_rolled_over() {
    try_all("trace");
}
