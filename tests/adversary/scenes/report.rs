//! What many random scenes came to: the section of `docs/evidence/stability.md`.

use super::commands::Compared;
use super::judge::{Measure, Verdict};
use crate::random_case::Kind;
use crate::subject::Refusal;
use brinell::simulation::SimulationError;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter, Write};

/// What came of one scene. As text it is a line of fields between tabs, so that a long run can be broken off and taken
/// up.
pub struct Entry {
    pub seed: u64,
    /// Body with the defect, its shape, motion of the rings, whether the outer one turns, speed, what rolls, and
    /// whether that is of one size and all is round.
    names: [String; 7],
    tolerance: f64,
    /// Whether the numbers of `stiffness`, its critical load and `modes` were compared.
    compared: Compared,
    pub came: Came,
}

pub enum Came {
    Agreed(Measure),
    /// Class of the error, and its text.
    Refused(String, String),
    Undecided(String),
    Failed(String),
}

/// Quantiles that are shown.
const QUANTILES: [f64; 4] = [0.5, 0.9, 0.99, 1.0];

impl Entry {
    pub fn new(seed: u64, kind: Kind, tolerance: f64, verdict: Verdict, compared: Compared) -> Self {
        let came = match verdict {
            Verdict::Agreed(measure) => Came::Agreed(measure),
            Verdict::Refused(error) => Came::Refused(class(&error), error.to_string()),
            Verdict::Undecided(why) => Came::Undecided(why.to_owned()),
            Verdict::Failed(why) => Came::Failed(why),
        };
        Self {
            seed,
            names: [kind.on, kind.defect, kind.motion, kind.outer_ring, kind.speed, kind.elements, kind.bodies]
                .map(str::to_owned),
            tolerance,
            compared,
            came,
        }
    }

    /// From its line; `None` where a run was broken off within it.
    pub fn parse(line: &str) -> Option<Self> {
        let mut fields = line.split('\t');
        let seed = fields.next()?.parse().ok()?;
        let mut name = || fields.next().map(str::to_owned);
        let names = [name()?, name()?, name()?, name()?, name()?, name()?, name()?];
        let tolerance = fields.next()?.parse().ok()?;
        let mut compared = [false; 3];
        compared.iter_mut().zip(fields.next()?.chars()).for_each(|(compared, digit)| *compared = digit == '1');
        let (verdict, rest) = (fields.next()?, fields.collect::<Vec<_>>());
        let came = match (verdict, &rest[..]) {
            ("agreed", [start, error, units, judged]) => Came::Agreed(Measure {
                start: start.parse().ok()?,
                error: error.parse().ok()?,
                units: units.parse().ok()?,
                judged: judged.parse().ok()?,
            }),
            ("refused", [class, text, "."]) => Came::Refused((*class).to_owned(), (*text).to_owned()),
            ("undecided", [why, "."]) => Came::Undecided((*why).to_owned()),
            ("failed", [why, "."]) => Came::Failed((*why).to_owned()),
            _ => return None,
        };
        Some(Self { seed, names, tolerance, compared, came })
    }
}

impl Display for Entry {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let [stiffness, critical, modes] = self.compared.map(u8::from);
        write!(f, "{}\t{}\t{:e}\t", self.seed, self.names.join("\t"), self.tolerance)?;
        write!(f, "{stiffness}{critical}{modes}\t")?;
        let one_line = |text: &str| text.replace(['\t', '\n'], " ");
        match &self.came {
            Came::Agreed(m) => write!(f, "agreed\t{:e}\t{:e}\t{:e}\t{:e}", m.start, m.error, m.units, m.judged),
            Came::Refused(class, text) => write!(f, "refused\t{class}\t{}\t.", one_line(text)),
            Came::Undecided(why) => write!(f, "undecided\t{why}\t."),
            Came::Failed(why) => write!(f, "failed\t{}\t.", one_line(why)),
        }
    }
}

/// What came of all scenes.
pub struct Tally<'a> {
    entries: &'a [Entry],
    agreed: Vec<(&'a Entry, Measure)>,
}

impl<'a> Tally<'a> {
    pub fn new(entries: &'a [Entry]) -> Self {
        let measure = |entry: &'a Entry| match entry.came {
            Came::Agreed(measure) => Some((entry, measure)),
            _ => None,
        };
        Self { entries, agreed: entries.iter().filter_map(measure).collect() }
    }

    /// Each scene that failed, with its seed.
    pub fn failed(&self) -> Vec<String> {
        let why = |entry: &Entry| match &entry.came {
            Came::Failed(why) => Some(format!("BRINELL_SEED={}: {why}", entry.seed)),
            _ => None,
        };
        self.entries.iter().filter_map(why).collect()
    }

    /// How many agreed.
    pub fn agreed(&self) -> usize {
        self.agreed.len()
    }

    /// The tables.
    pub fn markdown(&self) -> String {
        let (mut refused, mut undecided) = (BTreeMap::<_, (usize, &str)>::new(), BTreeMap::<_, usize>::new());
        for entry in self.entries {
            match &entry.came {
                Came::Refused(class, text) => refused.entry(class).or_insert((0, text)).0 += 1,
                Came::Undecided(why) => *undecided.entry(why).or_default() += 1,
                Came::Agreed(_) | Came::Failed(_) => {}
            }
        }
        let mut text = format!(
            "Of {} scenes {} agreed, {} failed, {} were refused with an error, and of {} the oracle could not judge \
             even the first step.\n\n",
            self.entries.len(),
            self.agreed.len(),
            self.failed().len(),
            refused.values().map(|entry| entry.0).sum::<usize>(),
            undecided.values().sum::<usize>()
        );
        let whole = self.agreed.iter().filter(|(_, measure)| measure.judged > 0.999).count();
        writeln!(text, "{whole} were judged to their end, the others until bounces let nobody say more.\n").unwrap();
        let count = |which: usize| self.entries.iter().filter(|entry| entry.compared[which]).count();
        writeln!(
            text,
            "The numbers of the commands were the oracle's as well: load distribution and stiffness of {} scenes, \
             critical loads of {}, modes of {}, and characteristic frequencies of all.\n",
            count(0),
            count(1),
            count(2)
        )
        .unwrap();
        self.errors(&mut text);
        text += "| refused, or not judged | scenes | for example |\n|---|---:|---|\n";
        for (class, (count, example)) in refused {
            writeln!(text, "| {class} | {count} | {} |", example.replace('|', "/")).unwrap();
        }
        for (why, count) in undecided {
            writeln!(text, "| not judged: {why} | {count} | |").unwrap();
        }
        text
    }

    /// How far the scenes that agreed are from the oracle.
    fn errors(&self, text: &mut String) {
        *text += "| tolerance | scenes | difference of any force over the largest: median | 90 % | 99 % | worst |\n";
        *text += "|---:|---:|---:|---:|---:|---:|\n";
        for tolerance in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
            self.row(text, &format!("{tolerance:.0e}"), |entry| entry.tolerance == tolerance);
        }
        for (title, columns) in [("defect on", 0..1), ("defect", 1..2), ("rings; speed", 2..5), ("elements", 5..7)] {
            *text +=
                &format!("\n| {title} | scenes | median | 90 % | 99 % | worst |\n|---|---:|---:|---:|---:|---:|\n");
            for which in columns {
                for name in self.names(which) {
                    self.row(text, name, |entry| entry.names[which] == name);
                }
            }
        }
        let worst = self.agreed.iter().fold(0.0f64, |m, (_, measure)| m.max(measure.units));
        let mut starts: Vec<f64> = self.agreed.iter().map(|(_, measure)| measure.start).collect();
        starts.sort_unstable_by(f64::total_cmp);
        let [median, most] = [0.5, 0.99].map(|share| starts.get(place(share, starts.len())).copied().unwrap_or(0.0));
        writeln!(
            text,
            "\nThe forces of the start are the oracle's to {median:.0e} of the largest in half of the scenes and to \
             {most:.0e} in 99 % of them; the largest differences are those of straight rollers that are just \
             touched, with less force than the rounding of their place makes. The worst difference later is \
             {worst:.0} units of {} allowed.\n",
            crate::units::LIMIT
        )
        .unwrap();
    }

    fn names(&self, which: usize) -> Vec<&'a str> {
        let mut names: Vec<&str> = self.agreed.iter().map(|(entry, _)| entry.names[which].as_str()).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    fn row(&self, text: &mut String, name: &str, belongs: impl Fn(&Entry) -> bool) {
        let found = self.agreed.iter().filter(|(entry, _)| belongs(entry));
        let mut errors: Vec<f64> = found.map(|(_, measure)| measure.error).collect();
        errors.sort_unstable_by(f64::total_cmp);
        if errors.is_empty() {
            return;
        }
        write!(text, "| {name} | {} |", errors.len()).unwrap();
        for quantile in QUANTILES {
            write!(text, " {:.0e} |", errors[place(quantile, errors.len())]).unwrap();
        }
        text.push('\n');
    }
}

/// Where this share of so many sorted numbers ends.
fn place(share: f64, count: usize) -> usize {
    (share * count.saturating_sub(1) as f64).round() as usize
}

/// What kind of error it is, for counting.
fn class(error: &Refusal) -> String {
    let word = |text: &str| text.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default().to_owned();
    let text = format!("{error:?}");
    match error {
        Refusal::Simulation(SimulationError::Step { cause, .. }) => format!("step: {}", word(&format!("{cause:?}"))),
        _ => match text.split_once('(') {
            Some((outer, inner)) => format!("{outer}: {}", word(inner)),
            None => word(&text),
        },
    }
}
