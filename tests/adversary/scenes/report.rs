//! What many random scenes came to: the section of `docs/stability.md`.

use super::judge::{Measure, Verdict};
use crate::case::Kind;
use brinell::simulation::SimulationError;
use std::collections::BTreeMap;
use std::fmt::Write;

/// What came of all scenes.
#[derive(Default)]
pub struct Tally {
    agreed: Vec<(Kind, f64, Measure)>,
    refused: BTreeMap<String, (usize, String)>,
    undecided: BTreeMap<&'static str, usize>,
    /// Seeds, with what went wrong.
    pub failed: Vec<(u64, String)>,
}

/// Quantiles that are shown.
const QUANTILES: [f64; 4] = [0.5, 0.9, 0.99, 1.0];

impl Tally {
    pub fn add(&mut self, seed: u64, kind: Kind, tolerance: f64, verdict: Verdict) {
        match verdict {
            Verdict::Agreed(measure) => self.agreed.push((kind, tolerance, measure)),
            Verdict::Refused(error) => {
                let entry = self.refused.entry(class(&error)).or_insert((0, error.to_string()));
                entry.0 += 1;
            }
            Verdict::Undecided(why) => *self.undecided.entry(why).or_default() += 1,
            Verdict::Failed(why) => self.failed.push((seed, why)),
        }
    }

    pub fn join(&mut self, other: Self) {
        self.agreed.extend(other.agreed);
        for (class, (count, example)) in other.refused {
            self.refused.entry(class).or_insert((0, example)).0 += count;
        }
        for (why, count) in other.undecided {
            *self.undecided.entry(why).or_default() += count;
        }
        self.failed.extend(other.failed);
    }

    /// The tables.
    pub fn markdown(&self) -> String {
        let refused: usize = self.refused.values().map(|entry| entry.0).sum();
        let undecided: usize = self.undecided.values().sum();
        let all = self.agreed.len() + refused + undecided + self.failed.len();
        let mut text = format!(
            "Of {all} scenes {} agreed, {} failed, {refused} were refused with an error, and of {undecided} the oracle could not \
             judge even the first step.\n\n",
            self.agreed.len(),
            self.failed.len()
        );
        let whole = self.agreed.iter().filter(|(_, _, measure)| measure.judged > 0.999).count();
        writeln!(text, "{whole} were judged to their end, the others until bounces let nobody say more.\n").unwrap();
        text += "| tolerance | scenes | difference of any force over the largest: median | 90 % | 99 % | worst |\n";
        text += "|---:|---:|---:|---:|---:|---:|\n";
        for tolerance in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
            self.row(&mut text, &format!("{tolerance:.0e}"), |(_, own, _)| *own == tolerance);
        }
        text += "\n| defect | scenes | median | 90 % | 99 % | worst |\n|---|---:|---:|---:|---:|---:|\n";
        for name in self.names(|kind| kind.defect) {
            self.row(&mut text, name, |(kind, ..)| kind.defect == name);
        }
        text += "\n| rings; speed | scenes | median | 90 % | 99 % | worst |\n|---|---:|---:|---:|---:|---:|\n";
        for name in self.names(|kind| kind.motion) {
            self.row(&mut text, name, |(kind, ..)| kind.motion == name);
        }
        for name in self.names(|kind| kind.speed) {
            self.row(&mut text, name, |(kind, ..)| kind.speed == name);
        }
        let worst = self.agreed.iter().fold(0.0f64, |m, (_, _, measure)| m.max(measure.units));
        let start = self.agreed.iter().fold(0.0f64, |m, (_, _, measure)| m.max(measure.start));
        writeln!(
            text,
            "\nThe forces of the start are the oracle's to {start:.0e} of the largest. The worst difference later is {worst:.0} units \
             of {} allowed.\n",
            crate::units::LIMIT
        )
        .unwrap();
        text += "| refused, or not judged | scenes | for example |\n|---|---:|---|\n";
        for (class, (count, example)) in &self.refused {
            writeln!(text, "| {class} | {count} | {} |", example.replace('|', "/")).unwrap();
        }
        for (why, count) in &self.undecided {
            writeln!(text, "| not judged: {why} | {count} | |").unwrap();
        }
        text
    }

    fn names(&self, of: impl Fn(&Kind) -> &'static str) -> Vec<&'static str> {
        let mut names: Vec<&'static str> = self.agreed.iter().map(|(kind, ..)| of(kind)).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    fn row(&self, text: &mut String, name: &str, belongs: impl Fn(&(Kind, f64, Measure)) -> bool) {
        let mut errors: Vec<f64> = self.agreed.iter().filter(|scene| belongs(scene)).map(|s| s.2.error).collect();
        errors.sort_unstable_by(f64::total_cmp);
        if errors.is_empty() {
            return;
        }
        write!(text, "| {name} | {} |", errors.len()).unwrap();
        for quantile in QUANTILES {
            let at = (quantile * (errors.len() - 1) as f64).round() as usize;
            write!(text, " {:.0e} |", errors[at]).unwrap();
        }
        text.push('\n');
    }
}

/// What kind of error it is, for counting.
fn class(error: &SimulationError) -> String {
    let word = |text: &str| text.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default().to_owned();
    let text = format!("{error:?}");
    match error {
        SimulationError::Step { cause, .. } => format!("step: {}", word(&format!("{cause:?}"))),
        _ => match text.split_once('(') {
            Some((outer, inner)) => format!("{outer}: {}", word(inner)),
            None => word(&text),
        },
    }
}
