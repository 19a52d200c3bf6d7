//! Parts of a data set: which runs are for training, validation and test.
//!
//! Without groups each run is drawn by the seed and its number alone. With groups, all runs that share the values of
//! some keys of the grid are in one part: groups are put in a random order that depends on the seed, and cut by their
//! shares. How many runs there are changes nothing, so that a longer sweep begins with the shorter one.

use brinell::numerics::checksum::checksum;
use brinell::numerics::counter_noise::uniform;
use brinell_scene_file::nearest;
use toml::Value;

use super::{Entry, Reading, number};

/// Names of the parts.
pub(in crate::sweep) const PARTS: [&str; 3] = ["train", "validation", "test"];
/// What random numbers of the parts depend on beside the seed.
const COURSE: &str = "split";
/// Groups at most.
const MOST_GROUPS: usize = 100_000;

/// How runs are shared out.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::sweep) struct Split {
    shares: [f64; 3],
    groups: Option<Groups>,
}

/// Runs that stay together.
#[derive(Debug, Clone, PartialEq)]
struct Groups {
    /// Keys of the grid, each with its different values.
    keys: Vec<(String, Vec<Value>)>,
    /// Part of each combination of values, the last key's changing first.
    parts: Vec<usize>,
}

impl Split {
    /// Part of a run that has these values.
    pub(in crate::sweep) fn part(&self, seed: u64, index: u64, values: &[(String, Value)]) -> &'static str {
        let drawn = || part_at(self.shares, uniform(seed, checksum(COURSE.as_bytes()), index as i64));
        PARTS[self.groups.as_ref().map_or_else(drawn, |groups| groups.parts[groups.group(values)])]
    }
}

impl Groups {
    /// # Errors
    /// More groups than a sweep takes, or too few for a part that is to have some.
    fn new(keys: Vec<(String, Vec<Value>)>, shares: [f64; 3], seed: u64) -> Result<Self, String> {
        let count = keys.iter().fold(1usize, |product, (_, values)| product.saturating_mul(values.len()));
        if count > MOST_GROUPS {
            return Err(format!("split_by makes {count} groups of runs: there may be {MOST_GROUPS} at most"));
        }
        let mut order: Vec<usize> = (0..count).collect();
        let draw = |group: &usize| uniform(seed, checksum(COURSE.as_bytes()), *group as i64);
        order.sort_by(|one, other| draw(one).total_cmp(&draw(other)));
        let mut parts = vec![0; count];
        for (rank, group) in order.into_iter().enumerate() {
            parts[group] = part_at(shares, (rank as f64 + 0.5) / count as f64);
        }
        if let Some(empty) = (0..3).find(|part| shares[*part] > 0.0 && !parts.contains(part)) {
            return Err(format!(
                "split_by makes {count} groups of runs, of which none is for {}, whose share is {}: give the grid more \
                 values of these keys, or the part a larger share or 0",
                PARTS[empty], shares[empty]
            ));
        }
        Ok(Self { keys, parts })
    }

    /// Which group a run of these values is in.
    fn group(&self, values: &[(String, Value)]) -> usize {
        self.keys.iter().fold(0, |group, (key, different)| {
            let value = values.iter().find(|(known, _)| known == key).map(|(_, value)| value);
            group * different.len()
                + value.and_then(|value| different.iter().position(|one| same(one, value))).unwrap_or(0)
        })
    }
}

/// Whether two values of a key are one: 1 is 1.0.
fn same(one: &Value, other: &Value) -> bool {
    match (number(one), number(other)) {
        (Some(one), Some(other)) => one == other,
        _ => one == other,
    }
}

/// The part in which a place from 0 to 1 is, where the parts lie one behind the other.
fn part_at(shares: [f64; 3], place: f64) -> usize {
    let last = shares.iter().rposition(|share| *share > 0.0).unwrap_or(0);
    if place < shares[0] {
        0
    } else if place < shares[0] + shares[1] {
        1
    } else {
        last
    }
}

impl Reading<'_, '_> {
    /// The keys `split` and `split_by`.
    pub(super) fn split(&mut self, seed: u64, grid: &[Entry<Vec<Value>>]) -> Option<Split> {
        let by = self.split_by(grid);
        let Some(value) = self.values.get("split") else {
            if self.values.contains_key("split_by") {
                self.fault(
                    self.line_of("split_by"),
                    "split_by without split: give the shares, as split = [0.8, 0.1, 0.1]",
                );
            }
            return None;
        };
        let limit = "three numbers from 0 to 1, the shares of train, validation and test";
        let shares: [f64; 3] = self.read("split", limit, |value| {
            let shares: Vec<f64> = value.as_array()?.iter().map(number).collect::<Option<_>>()?;
            shares.try_into().ok().filter(|shares: &[f64; 3]| shares.iter().all(|share| (0.0..=1.0).contains(share)))
        })?;
        // Thirds and tenths add to 1 within their rounding in a file.
        let sum: f64 = shares.iter().sum();
        if (sum - 1.0).abs() > 1e-6 {
            self.wrong("split", value, &format!("{limit}, with the sum 1 and not {}", (sum * 1e9).round() / 1e9));
            return None;
        }
        match by.map(|keys| Groups::new(keys, shares, seed)).transpose() {
            Ok(groups) => Some(Split { shares, groups }),
            Err(message) => {
                self.fault(self.line_of("split_by"), message);
                None
            }
        }
    }

    /// Keys of the grid that `split_by` names, each with its different values.
    fn split_by(&mut self, grid: &[Entry<Vec<Value>>]) -> Option<Vec<(String, Vec<Value>)>> {
        let names = match self.values.get("split_by")? {
            Value::String(one) => vec![one.clone()],
            _ => self.texts("split_by"),
        };
        let mut keys = Vec::new();
        for name in names {
            match grid.iter().find(|entry| entry.key == name) {
                Some(_) if keys.iter().any(|(known, _)| *known == name) => {}
                Some(entry) => {
                    let mut different: Vec<Value> = Vec::new();
                    entry.of.iter().for_each(|value| {
                        if !different.iter().any(|one| same(one, value)) {
                            different.push(value.clone());
                        }
                    });
                    keys.push((name, different));
                }
                None => {
                    let near = nearest(grid.iter().map(|entry| entry.key.as_str()), &name);
                    let hint = near.map_or_else(String::new, |near| format!("; did you mean {near}?"));
                    self.fault(self.line_of("split_by"), format!("split_by: {name:?} is no key of [grid]{hint}"));
                }
            }
        }
        (!keys.is_empty()).then_some(keys)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::super::Sweep;
    use super::*;

    const FILE: &str = "scene = \"er16k-tb1\"\nruns = 4000\nseed = 7\nkinds = [\"outer\", \"inner\"]\n\
        split = [0.7, 0.2, 0.1]\nGROUPS\n\
        [grid]\ndefect.length_mm = [1, 1.5, 2, 2.5, 3, 1.0]\ndefect.depth_um = [20, 50]\n\
        [random]\nshaft.load_n = [300, 1500]\n";

    fn parts(text: &str) -> Vec<(&'static str, Vec<(String, Value)>)> {
        let (sweep, faults) = Sweep::read(text).unwrap();
        assert_eq!(faults, []);
        let split = sweep.split.as_ref().unwrap();
        let of = |index| {
            let values = sweep.run(index, &|_| false).values;
            (split.part(sweep.seed, index, &values), values)
        };
        (0..sweep.runs).map(of).collect()
    }

    #[test]
    fn runs_are_shared_out_by_seed_and_number_and_a_longer_sweep_begins_with_the_shorter_one() {
        let text = FILE.replace("GROUPS\n", "");
        let all = parts(&text);
        for (part, share) in PARTS.iter().zip([0.7, 0.2, 0.1]) {
            let count = all.iter().filter(|(of, _)| of == part).count() as f64;
            // Four standard deviations of a count of 4000.
            assert!((count - 4000.0 * share).abs() < 4.0 * (4000.0 * share * (1.0 - share)).sqrt(), "{part}: {count}");
        }
        assert_eq!(parts(&text.replace("runs = 4000", "runs = 100")), all[..100]);
        assert_ne!(parts(&text.replace("seed = 7", "seed = 8")), all);
    }

    #[test]
    fn runs_that_share_a_group_are_in_one_part_and_groups_have_the_shares() {
        let by = |keys: &str| parts(&FILE.replace("GROUPS", keys));
        let groups_of = |all: &[(&'static str, Vec<(String, Value)>)], keys: usize| {
            let mut groups: Vec<(String, &str)> = all
                .iter()
                .map(|(part, values)| {
                    let named = values[..keys].iter().map(|(_, value)| format!("{} ", number(value).unwrap()));
                    (named.collect(), *part)
                })
                .collect();
            groups.sort();
            groups.dedup();
            groups
        };
        // 1 and 1.0 are one length: ten groups, of which 7, 2 and 1 are the shares.
        let all = by("split_by = [\"defect.length_mm\", \"defect.depth_um\"]");
        let groups = groups_of(&all, 2);
        let counts = PARTS.map(|part| groups.iter().filter(|(_, of)| *of == part).count());
        assert_eq!((groups.len(), counts), (10, [7, 2, 1]), "{groups:?}");
        // Coarser groups, of lengths alone: five.
        let text = FILE.replace("GROUPS", "split_by = \"defect.length_mm\"");
        let all = parts(&text.replace("0.7, 0.2, 0.1", "0.6, 0.2, 0.2"));
        assert_eq!(groups_of(&all, 1).len(), 5);
    }
}
