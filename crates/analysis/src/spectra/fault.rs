//! Which part of the bearing is damaged: the kind whose comb repeats most, if none beside it repeats nearly as much.

use super::combs::{Comb, Combs};
use serde::Serialize;

/// Part of the bearing that seems to be damaged, by a recording's combs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Fault {
    /// The outer raceway.
    Outer,
    /// The inner raceway.
    Inner,
    /// A rolling element.
    Element,
    /// Two kinds repeat about as much, recordings of one bearing differ, or they are too short to tell.
    Undecided,
    /// Nothing of the bearing repeats, or nothing is more similar to the recording than the scene's bearing without a
    /// spall.
    #[default]
    None,
}

impl Fault {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Outer => "the outer raceway",
            Self::Inner => "the inner raceway",
            Self::Element => "a rolling element",
            Self::Undecided => "undecided",
            Self::None => "no fault found",
        }
    }
}

/// How plainly a recording shows the kind of its fault, as published grades of recordings do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Grade {
    /// A tenth of the variance repeats at one kind's comb and less than a fifth of that at any other.
    Clear,
    /// One kind leads, but less plainly.
    Likely,
    /// Something of the bearing repeats, but no kind leads; another speed would suit it as well; or it is too short.
    Possible,
    /// No fault found.
    #[default]
    None,
}

impl Grade {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Clear => "clear",
            Self::Likely => "likely",
            Self::Possible => "possible",
            Self::None => "no fault found",
        }
    }
}

/// Share of the variance from which a fault is there. Two healthy machines, and pitted balls that do not show, have at
/// most 0.058 at the frequencies of their own bearing and at those of fifty that they do not have; named faults have
/// 0.07 and more.
pub const EXISTS: f64 = 0.065;
/// Times what noise alone has in the comb's windows: short recordings have wide windows.
const ABOVE_NOISE: f64 = 3.0;
/// Times the share of any other kind's own lines by which a kind leads.
const LEADS: f64 = 3.0;
/// Turns of the shaft from which its lines are apart from each other.
const FEWEST_TURNS: f64 = 4.5;
/// Share and lead of a [`Grade::Clear`] kind.
const CLEAR: [f64; 2] = [0.1, 5.0];

impl Comb {
    /// Share from which it is a fault's.
    pub(crate) fn limit(&self) -> f64 {
        EXISTS.max(ABOVE_NOISE * self.noise)
    }
}

impl Combs {
    fn all(&self) -> [(Fault, &Comb); 3] {
        [(Fault::Outer, &self.outer), (Fault::Inner, &self.inner), (Fault::Element, &self.element)]
    }

    /// The strongest comb, and the strongest of the others by what they have alone.
    fn leader_and_rival(&self) -> [(Fault, &Comb); 2] {
        let mut all = self.all();
        all.sort_by(|(_, a), (_, b)| b.alone.total_cmp(&a.alone));
        [all[0], all[1]]
    }

    /// Whether the recording is too short to tell anything: all windows of its combs are so wide that they hold lines
    /// of the shaft.
    pub(crate) fn is_too_short(&self) -> bool {
        self.turns < FEWEST_TURNS
    }

    /// The kind that the recording looks like.
    pub fn fault(&self) -> Fault {
        let [(fault, leader), (_, rival)] = self.leader_and_rival();
        if self.is_too_short() {
            Fault::Undecided
        } else if leader.share < leader.limit() {
            Fault::None
        } else if leader.share < LEADS * rival.alone {
            Fault::Undecided
        } else {
            fault
        }
    }

    /// How plainly.
    pub fn grade(&self) -> Grade {
        let [(_, leader), (_, rival)] = self.leader_and_rival();
        match self.fault() {
            Fault::None => Grade::None,
            Fault::Undecided => Grade::Possible,
            _ if leader.share >= CLEAR[0] && leader.share >= CLEAR[1] * rival.alone => Grade::Clear,
            _ => Grade::Likely,
        }
    }

    /// That of a kind of fault, where one is named.
    pub fn of(&self, fault: Fault) -> Option<&Comb> {
        self.all().into_iter().find(|(kind, _)| *kind == fault).map(|(_, comb)| comb)
    }

    /// The strongest.
    pub fn strongest(&self) -> &Comb {
        self.leader_and_rival()[0].1
    }

    /// In words.
    pub fn described(&self) -> String {
        let one = |name: &str, comb: &Comb| format!("{name} {:.1} % at {:.2} Hz", 100.0 * comb.share, comb.frequency);
        format!("{}, {}, {}", one("BPFO", &self.outer), one("BPFI", &self.inner), one("2 BSF", &self.element))
    }

    /// What speaks for the strongest kind, and what against it, in words.
    pub fn evidence(&self) -> [Vec<String>; 2] {
        let [(fault, leader), (other, rival)] = self.leader_and_rival();
        let [low, high] = [leader.band.low, leader.band.high].map(|f| 1e-3 * f);
        let exists = format!(
            "the lines of {} at multiples of {:.2} Hz make up {:.1} % of the envelope's variation (limit {:.1} %), \
             best from {low:.1} to {high:.1} kHz",
            fault.name(),
            leader.frequency,
            100.0 * leader.share,
            100.0 * leader.limit(),
        );
        let beside = format!(
            "the next kind, {} at {:.2} Hz, has {:.1} % of its own ({LEADS} times less is the limit)",
            other.name(),
            rival.frequency,
            100.0 * rival.alone,
        );
        let pairs = [(leader.share >= leader.limit(), exists), (leader.share >= LEADS * rival.alone, beside)];
        let [mut speaks_for, mut against] = [Vec::new(), Vec::new()];
        for (holds, text) in pairs {
            if holds { speaks_for.push(text) } else { against.push(text) }
        }
        [speaks_for, against]
    }
}
