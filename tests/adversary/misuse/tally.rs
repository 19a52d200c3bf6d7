//! What walks have done: calls by function, state and status, and comparisons.

use super::standard::{LETTERS, State, TABLE, row};
use brinell_fmi::fmi2::Status;
use std::fmt;

#[derive(Clone)]
pub(super) struct Tally {
    /// By function and state.
    pub(super) calls: [[u64; 5]; 34],
    /// By status: OK, warning, discard, error.
    pub(super) statuses: [u64; 4],
    /// Of an instance with its twin.
    pub(super) comparisons: u64,
    /// Of an instance with a new one that goes the way straight.
    pub(super) straight_ways: u64,
    /// Recordings compared with those of twins.
    pub(super) recordings: u64,
    pub(super) instances: u64,
    /// Calls with handles that lead nowhere, and attempts to make instances of wrong arguments.
    pub(super) strange: u64,
}

impl Default for Tally {
    fn default() -> Self {
        let none = [[0; 5]; 34];
        let statuses = [0; 4];
        Self { calls: none, statuses, comparisons: 0, straight_ways: 0, recordings: 0, instances: 0, strange: 0 }
    }
}

impl Tally {
    pub(super) fn count(&mut self, function: &str, state: State, status: Status) {
        self.calls[row(function)][state as usize] += 1;
        self.statuses[status as usize] += 1;
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (sum, part) in self.calls.iter_mut().flatten().zip(other.calls.iter().flatten()) {
            *sum += part;
        }
        for (sum, part) in self.statuses.iter_mut().zip(other.statuses) {
            *sum += part;
        }
        self.comparisons += other.comparisons;
        self.straight_ways += other.straight_ways;
        self.recordings += other.recordings;
        self.instances += other.instances;
        self.strange += other.strange;
    }

    /// Functions and states that were never tried.
    pub(super) fn gaps(&self) -> Vec<String> {
        let states = || LETTERS.chars().enumerate();
        let gap = |name: &str, row: usize| -> Vec<String> {
            let untried = states().filter(|(state, _)| self.calls[row][*state] == 0);
            untried.map(|(_, letter)| format!("{name} in {letter}")).collect()
        };
        TABLE.iter().enumerate().flat_map(|(row, (name, _))| gap(name, row)).collect()
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [ok, warning, discard, error] = self.statuses;
        writeln!(f, "{} instances, {} calls: OK {ok}", self.instances, ok + warning + discard + error)?;
        writeln!(f, "warning {warning}, discard {discard}, error {error}; {} with strange handles", self.strange)?;
        write!(f, "{} comparisons with a twin, {} with a straight way, ", self.comparisons, self.straight_ways)?;
        write!(f, "{} of recordings", self.recordings)
    }
}
