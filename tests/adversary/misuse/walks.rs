//! Many walks, several instances at once, from several threads.
//!
//! Instances are dealt out to the threads anew in each round, so each is used by one thread at a time and wanders
//! between them. `BRINELL_WALK_SEED` is the first seed, `BRINELL_WALK_COUNT` the
//! number of walks, and `BRINELL_WALK_SECONDS` goes on until so many have passed, and prints the counts so far every
//! half minute, as in `BRINELL_WALK_SECONDS=3600 cargo test --workspace --release --test adversary misuse --
//! --nocapture`.

use super::chance::Chance;
use super::stage::{Folders, FullDisk, Stage, stages};
use super::tally::Tally;
use super::walker::{SHARERS, Strangers, Walker};
use super::{PATIENCE, call, disk, finish, states, walk_of_bytes};
use crate::support;
use crate::two::FORBIDDEN_CALLS;
use brinell_fmi::fmi2::Status;
use std::env;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// One for each of eleven scenes, and one more, so that each thread has as many.
const INSTANCES: usize = 12;
const THREADS: usize = 3;
const ROUNDS: usize = 8;
/// Calls that each instance gets in a round.
const CALLS_A_ROUND: usize = 40;

/// A round in one thread.
fn round(walkers: &mut [Walker], seed: u64, others: &Strangers) {
    let mut chance = Chance::new(seed);
    let patience = *chance.pick(&PATIENCE);
    for _ in 0..CALLS_A_ROUND * walkers.len() {
        let index = chance.below(walkers.len());
        call(&mut walkers[index], &mut chance, patience, others);
    }
}

fn walk(stages: &[Stage], seed: u64, full: FullDisk) -> Tally {
    let mut chance = Chance::new(seed);
    let folders = Folders::new(seed, full);
    let mut others = Strangers::default();
    let new = |number| Walker::new(&stages[number as usize % stages.len()], &folders, number, seed, &mut chance);
    let mut walkers: Vec<Walker> = (0..INSTANCES as u64).map(new).collect();
    for _ in 0..ROUNDS {
        others.blobs = walkers.iter().filter_map(|w| states::publish(w, &mut chance)).collect();
        others.states = walkers.iter().flat_map(|w| &w.saved).map(|saved| saved.handle.addr()).collect();
        let components: Vec<usize> = walkers.iter().map(|w| w.subject.c.addr()).collect();
        // Those that share names stay together, or it would be a matter of time which of them has a recording.
        let sharers = SHARERS as usize;
        walkers.sort_by_key(|w| w.number % 1000);
        for i in (sharers + 1..walkers.len()).rev() {
            walkers.swap(i, sharers + chance.below(i + 1 - sharers));
        }
        let around = &others;
        let seeds: Vec<u64> = (0..THREADS).map(|_| chance.number()).collect();
        std::thread::scope(|scope| {
            let parts = walkers.chunks_mut(INSTANCES / THREADS).zip(seeds);
            let threads: Vec<_> = parts.map(|(part, seed)| scope.spawn(move || round(part, seed, around))).collect();
            for thread in threads {
                thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            }
        });
        // States of an instance that is gone are strangers for ever.
        let gone = |c: &usize| walkers.iter().all(|w| w.subject.c.addr() != *c);
        others.dead.extend(components.into_iter().filter(gone));
    }
    let full_disks = u64::from(folders.full().is_some());
    let mut sum = Tally { walks: 1, full_disks, threads: (ROUNDS * THREADS) as u64, ..Tally::default() };
    for walker in &mut walkers {
        finish(walker, &mut chance);
        sum.add(&walker.tally);
    }
    sum
}

fn number(name: &str) -> Option<u64> {
    env::var(name).ok().map(|text| text.parse().unwrap_or_else(|_| panic!("{name} is no whole number: {text}")))
}

/// Time between two looks at a long run.
const HALF_A_MINUTE: Duration = Duration::from_secs(30);

/// Walks of the seeds that the environment asks for. One that finds something does not keep the others from being
/// taken.
fn walks(count: u64, full: impl Fn(&mut Chance) -> FullDisk) -> Tally {
    let first = number("BRINELL_WALK_SEED").unwrap_or(1);
    let count = number("BRINELL_WALK_COUNT").unwrap_or(count);
    let long = number("BRINELL_WALK_SECONDS").map(Duration::from_secs);
    let map = |scene: &str| support::map_of(&brinell_scene_file::from_toml(scene).unwrap(), None);
    let (stages, start, mut sum) = (stages(map), Instant::now(), Tally::default());
    let mut found = Vec::new();
    let mut shown = start;
    let mut seed = first;
    while long.map_or(seed < first + count, |long| start.elapsed() < long) {
        let full = full(&mut Chance::new(seed));
        match catch_unwind(AssertUnwindSafe(|| walk(&stages, seed, full))) {
            Ok(tally) => sum.add(&tally),
            Err(panic) => {
                let words = panic.downcast_ref::<String>().map_or("a panic without words", String::as_str);
                found.push(format!("seed {seed}: {}", words.lines().next().unwrap_or_default()));
            }
        }
        seed += 1;
        if shown.elapsed() >= HALF_A_MINUTE {
            shown = Instant::now();
            println!("after {} s, {} findings: {sum}", start.elapsed().as_secs(), found.len());
        }
    }
    println!("seeds {first} to {}, {} s, {} findings: {sum}", seed - 1, start.elapsed().as_secs(), found.len());
    let list = found.join("\n");
    assert!(found.is_empty(), "{} walks; one alone: BRINELL_WALK_SEED=… BRINELL_WALK_COUNT=1\n{list}", found.len());
    sum
}

#[test]
fn a_fuzzers_bytes_are_a_walk() {
    let mut chance = Chance::new(1);
    for _ in 0..20 {
        let bytes: Vec<u8> = (0..500).map(|_| chance.number() as u8).collect();
        walk_of_bytes(&bytes);
    }
}

#[test]
fn any_sequence_of_calls_has_the_statuses_of_the_standard_and_leaves_what_succeeded_untouched() {
    let sum = walks(12, |_| FullDisk::None);
    let gaps = sum.gaps();
    // Each function has been called in each state, and each status has come.
    assert!(gaps.is_empty(), "{gaps:?}");
    assert!(
        sum.statuses().iter().all(|count| *count > 0)
            && sum.comparisons > 0
            && sum.straight_ways > 0
            && sum.recordings > 0,
        "{sum}"
    );
    assert_eq!(FORBIDDEN_CALLS.load(Ordering::Relaxed), 0);
}

#[test]
fn on_a_full_disk_calls_fail_with_an_error_and_a_reset_always_works() {
    if let Err(reason) = disk::run_on_a_small_disk("misuse::walks::on_the_small_disk") {
        println!("no small disk can be made here ({reason}); /dev/full takes its place");
        if !std::path::Path::new("/dev/full").exists() {
            println!("skipped: there is no /dev/full either");
            return;
        }
        walks(5, |_| FullDisk::Device);
    }
}

#[test]
#[ignore = "started by the test above, in a process that has a small disk"]
fn on_the_small_disk() {
    if !disk::is_small() {
        println!("skipped: there is no small disk, the test above makes one");
        return;
    }
    let sum = walks(5, |chance| if chance.one_in(4) { FullDisk::Device } else { disk::nearly_full(chance) });
    assert!(sum.statuses()[Status::Error as usize] > 0 && sum.no_room > 0, "{sum}");
}
