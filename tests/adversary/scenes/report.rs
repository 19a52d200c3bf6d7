//! What many random scenes came to: the summary on `docs/evidence/stability.md` and `docs/data/random-scenes.csv`.

use super::commands::Compared;
use super::judge::{Measure, Verdict};
use crate::random_case::Kind;
use crate::subject::Refusal;
use brinell::simulation::SimulationError;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

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

/// Of the table: differences are of any force, over the largest, and have four quantiles.
pub const COLUMNS: [&str; 8] = ["group", "name", "scenes", "median", "q90", "q99", "worst", "example"];
/// What is drawn, in the order of an entry's names.
const GROUPS: [&str; 7] = ["defect on", "defect", "rings", "outer ring", "speed", "elements", "bodies"];
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

/// Scenes without a comparison, by class of error with an example, and by reason.
#[derive(Default)]
struct LeftOut<'a> {
    refused: BTreeMap<&'a str, (usize, &'a str)>,
    undecided: BTreeMap<&'a str, usize>,
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

    /// How many agreed, and how well.
    pub fn summary(&self) -> String {
        let LeftOut { refused, undecided } = self.left_out();
        let whole = self.agreed.iter().filter(|(_, measure)| measure.judged > 0.999).count();
        let count = |which: usize| self.entries.iter().filter(|entry| entry.compared[which]).count();
        let worst = self.agreed.iter().fold(0.0f64, |m, (_, measure)| m.max(measure.units));
        let mut starts: Vec<f64> = self.agreed.iter().map(|(_, measure)| measure.start).collect();
        starts.sort_unstable_by(f64::total_cmp);
        let [median, most] = [0.5, 0.99].map(|share| starts.get(place(share, starts.len())).copied().unwrap_or(0.0));
        let rows = [
            ("scenes", self.entries.len().to_string()),
            ("agreed", format!("{}, of which {whole} to their end, the others until bounces", self.agreed.len())),
            ("**failed**", self.failed().len().to_string()),
            ("refused with an error", refused.values().map(|entry| entry.0).sum::<usize>().to_string()),
            ("the oracle could not judge the first step", undecided.values().sum::<usize>().to_string()),
            ("`stiffness`; its critical load; `modes` compared", [0, 1, 2].map(|i| count(i).to_string()).join("; ")),
            ("forces of the start, over the largest: median, 99 %", format!("{median:.0e}, {most:.0e}")),
            ("worst difference later, in units", format!("{worst:.0} of {} allowed", crate::units::LIMIT)),
        ];
        let lines = rows.map(|(what, count)| format!("| {what} | {count} |\n")).concat();
        format!("| | |\n|---|---:|\n{lines}")
    }

    /// Scenes that were refused, with an example of the error, and those that the oracle could not judge.
    fn left_out(&self) -> LeftOut<'a> {
        let mut left_out = LeftOut::default();
        for entry in self.entries {
            match &entry.came {
                Came::Refused(class, text) => left_out.refused.entry(class).or_insert((0, text)).0 += 1,
                Came::Undecided(why) => *left_out.undecided.entry(why).or_default() += 1,
                Came::Agreed(_) | Came::Failed(_) => {}
            }
        }
        left_out
    }

    /// Differences of forces over the largest by what is drawn, and what was refused: rows of [`COLUMNS`].
    pub fn table(&self) -> Vec<[String; 8]> {
        let mut rows = Vec::new();
        for tolerance in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
            rows.extend(self.row("tolerance", &format!("{tolerance:.0e}"), |entry| entry.tolerance == tolerance));
        }
        for (which, group) in GROUPS.into_iter().enumerate() {
            for name in self.names(which) {
                rows.extend(self.row(group, name, |entry| entry.names[which] == name));
            }
        }
        let LeftOut { refused, undecided } = self.left_out();
        let row = |group: &str, name: &str, count: usize, example: &str| {
            let [a, b, c, d] = [(); 4].map(|()| String::new());
            [group.to_owned(), name.to_owned(), count.to_string(), a, b, c, d, example.to_owned()]
        };
        rows.extend(refused.into_iter().map(|(class, (count, example))| row("refused", class, count, example)));
        rows.extend(undecided.into_iter().map(|(why, count)| row("not judged", why, count, "")));
        rows
    }

    fn names(&self, which: usize) -> Vec<&'a str> {
        let mut names: Vec<&str> = self.agreed.iter().map(|(entry, _)| entry.names[which].as_str()).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    fn row(&self, group: &str, name: &str, belongs: impl Fn(&Entry) -> bool) -> Option<[String; 8]> {
        let found = self.agreed.iter().filter(|(entry, _)| belongs(entry));
        let mut errors: Vec<f64> = found.map(|(_, measure)| measure.error).collect();
        errors.sort_unstable_by(f64::total_cmp);
        let [a, b, c, d] = QUANTILES.map(|quantile| errors.get(place(quantile, errors.len())));
        let text = |error: Option<&f64>| error.map(|error| format!("{error:.0e}"));
        let count = errors.len().to_string();
        Some([group.to_owned(), name.to_owned(), count, text(a)?, text(b)?, text(c)?, text(d)?, String::new()])
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
