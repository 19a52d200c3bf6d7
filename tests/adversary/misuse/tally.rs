//! What walks have done: calls by function, state and status, and comparisons.

use super::TABLE;
use super::standard::{LETTERS, State, row};
use brinell_fmi::fmi2::Status;
use std::fmt;
use std::ops::Range;

/// Functions of the table that do alike, by their rows.
const GROUPS: [(&str, Range<usize>); 7] = [
    ("life of an instance, logging", 0..10),
    ("reading variables", 10..14),
    ("setting variables", 14..18),
    ("states", 18..24),
    ("derivatives", 24..27),
    ("steps", 27..29),
    ("status of a step", 29..34),
];

#[derive(Clone, Default)]
pub(super) struct Tally {
    /// Walks that came to their end.
    pub(super) walks: u64,
    /// Of these, such with a disk that is full.
    pub(super) full_disks: u64,
    /// Threads that had calls to make.
    pub(super) threads: u64,
    /// By function, state and status: OK, warning, discard, error.
    pub(super) calls: Calls,
    /// Of an instance with its twin.
    pub(super) comparisons: u64,
    /// Of an instance with a new one that goes the way straight.
    pub(super) straight_ways: u64,
    /// Recordings compared with those of twins.
    pub(super) recordings: u64,
    /// Steps that failed because the recording found no room.
    pub(super) no_room: u64,
    pub(super) instances: u64,
    /// Calls with handles that lead nowhere, and attempts to make instances of wrong arguments.
    pub(super) strange: u64,
}

#[derive(Clone)]
pub(super) struct Calls([[[u64; 4]; 5]; 34]);

impl Default for Calls {
    fn default() -> Self {
        Self([[[0; 4]; 5]; 34])
    }
}

impl Tally {
    pub(super) fn count(&mut self, function: &str, state: State, status: Status) {
        self.calls.0[row(function)][state as usize][status as usize] += 1;
    }

    pub(super) fn add(&mut self, other: &Self) {
        let counts = |calls: &Calls| calls.0.as_flattened().as_flattened().to_vec();
        let sums = self.calls.0.as_flattened_mut().as_flattened_mut();
        sums.iter_mut().zip(counts(&other.calls)).for_each(|(sum, part)| *sum += part);
        self.walks += other.walks;
        self.full_disks += other.full_disks;
        self.threads += other.threads;
        self.comparisons += other.comparisons;
        self.straight_ways += other.straight_ways;
        self.recordings += other.recordings;
        self.no_room += other.no_room;
        self.instances += other.instances;
        self.strange += other.strange;
    }

    /// Calls of these functions by status.
    fn of(&self, rows: Range<usize>) -> [u64; 4] {
        let by_status = |sums: [u64; 4], counts: &[u64; 4]| std::array::from_fn(|i| sums[i] + counts[i]);
        self.calls.0[rows].as_flattened().iter().fold([0; 4], by_status)
    }

    /// All calls by status: OK, warning, discard, error.
    pub(super) fn statuses(&self) -> [u64; 4] {
        self.of(0..TABLE.len())
    }

    /// Functions and states that were never tried.
    pub(super) fn gaps(&self) -> Vec<String> {
        let states = || LETTERS.chars().enumerate();
        let gap = |name: &str, row: usize| -> Vec<String> {
            let untried = states().filter(|(state, _)| self.calls.0[row][*state] == [0; 4]);
            untried.map(|(_, letter)| format!("{name} in {letter}")).collect()
        };
        TABLE.iter().enumerate().flat_map(|(row, (name, ..))| gap(name, row)).collect()
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            walks,
            full_disks,
            threads,
            instances,
            comparisons,
            straight_ways,
            recordings,
            no_room,
            strange,
            ..
        } = self;
        writeln!(f, "{walks} walks, {full_disks} of them with a full disk; {instances} instances, {threads} threads")?;
        writeln!(f, "| functions | calls | OK | warning | discard | error |\n|---|---:|---:|---:|---:|---:|")?;
        for (name, rows) in GROUPS.into_iter().chain([("all", 0..TABLE.len())]) {
            let [ok, warning, discard, error] = self.of(rows);
            let all = ok + warning + discard + error;
            writeln!(f, "| {name} | {all} | {ok} | {warning} | {discard} | {error} |")?;
        }
        write!(f, "{strange} calls with handles that lead nowhere; compared: {comparisons} times with a twin, ")?;
        write!(f, "{straight_ways} times with a straight way, {recordings} recordings; {no_room} steps found no room")
    }
}
