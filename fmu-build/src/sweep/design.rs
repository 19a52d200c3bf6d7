//! The design of a sweep: which values each run has. Run i takes point i of the grid, modulo its size, and random
//! values that depend on the seed, the key and i alone: a longer sweep begins with the shorter one, and a further key
//! changes nothing of the others. Where a defect grows, i counts bearings, and each has a run for every stage.

use std::path::PathBuf;
use std::str::FromStr;

use brinell::numerics::checksum::checksum;
use brinell::numerics::counter_noise::{bits, uniform};
use toml::Value;

use super::file::{Kind, Sweep};
use crate::run::noise::Noise;

/// Random numbers of a sweep that are no key's.
const NOISE_RATIO: &str = "noise_db";
const NOISE_FLOOR: &str = "noise_rms_m_s2";
const NOISE: &str = "noise";
/// What names of parts' folders begin with.
const PART: &str = "part-";

/// What one run is.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Run {
    pub(super) index: u64,
    pub(super) kind: Option<Kind>,
    /// Number of the speed profile among those of the sweep.
    pub(super) profile: Option<usize>,
    /// Keys of the scene from the grid, then those drawn at random.
    pub(super) values: Vec<(String, Value)>,
    pub(super) noise: Option<Noise>,
}

/// One of several parts of a sweep, for machines that share the work: every `count`-th run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Part {
    /// From 1 to `count`.
    number: u64,
    count: u64,
}

impl Part {
    /// All runs.
    pub(super) const ALL: Self = Self { number: 1, count: 1 };

    /// How many of its runs are before this one, if it belongs to it.
    pub(super) fn place(self, run: u64) -> Option<u64> {
        (run % self.count == self.number - 1).then_some(run / self.count)
    }

    /// Its folder in that of the sweep.
    pub(super) fn folder(self) -> PathBuf {
        format!("{PART}{}-of-{}", self.number, self.count).into()
    }

    /// The part of a folder of this name, if it is one's.
    pub(super) fn of_folder(name: &str) -> Option<Self> {
        name.strip_prefix(PART)?.replace("-of-", "/").parse().ok()
    }
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((number, count)) if 1 <= number && number <= count => Ok(Self { number, count }),
            _ => Err("it must be K/N, as 2/8: part K of N, with K from 1 to N".to_owned()),
        }
    }
}

/// A point of the grid.
#[derive(Debug)]
pub(super) struct Point {
    pub(super) kind: Option<Kind>,
    /// Which speed profile.
    pub(super) profile: Option<usize>,
    /// Keys and their values.
    pub(super) values: Vec<(String, Value)>,
}

impl Sweep {
    /// Run number `index`; `is_whole` says which keys take whole numbers only.
    pub(super) fn run(&self, index: u64, is_whole: &dyn Fn(&str) -> bool) -> Run {
        let bearing = self.bearing(index);
        let Point { kind, profile, mut values } = self.point(bearing % self.points(), index % self.stages());
        for entry in &self.random {
            let draw = uniform(self.seed, checksum(entry.key.as_bytes()), bearing as i64);
            values.push((entry.key.clone(), drawn(entry.of, draw, is_whole(&entry.key))));
        }
        let within = |key: &str, [low, high]: [f64; 2]| {
            low + (high - low) * uniform(self.seed, checksum(key.as_bytes()), bearing as i64)
        };
        let noise = Noise {
            ratio: self.noise.ratio.map(|limits| within(NOISE_RATIO, limits)),
            floor: self.noise.floor.map(|limits| within(NOISE_FLOOR, limits)),
            color: self.noise.color,
            seed: bits(self.seed, checksum(NOISE.as_bytes()), index as i64),
        };
        let is_there = noise.ratio.is_some() || noise.floor.is_some() || self.noise_spectrum.is_some();
        let noise = is_there.then_some(noise);
        Run { index, kind, profile, values, noise }
    }

    /// A point of the grid: kinds take turns first, then the last key of the grid, speed profiles at last; what grows
    /// has the size of this stage.
    pub(super) fn point(&self, number: u64, stage: u64) -> Point {
        let mut rest = number;
        let mut next = |count: usize| {
            let count = count.max(1) as u64;
            let digit = (rest % count) as usize;
            rest /= count;
            digit
        };
        let kind = self.kinds.get(next(self.kinds.len())).copied();
        let mut values: Vec<(String, Value)> = Vec::with_capacity(self.grid.len() + self.random.len());
        for entry in self.grid[self.fixed().len()..].iter() {
            values.push((entry.key.clone(), entry.of[stage as usize].clone()));
        }
        for entry in self.fixed().iter().rev() {
            values.push((entry.key.clone(), entry.of[next(entry.of.len())].clone()));
        }
        values.reverse();
        let profile = next(self.speed_profiles.len());
        Point { kind, profile: (!self.speed_profiles.is_empty()).then_some(profile), values }
    }
}

/// A value between two limits for a draw from [0, 1).
pub(super) fn drawn([low, high]: [f64; 2], draw: f64, whole: bool) -> Value {
    if whole {
        let (low, high) = (low.ceil(), high.floor());
        return Value::Integer(((low + (high - low + 1.0) * draw).floor() as i64).min(high as i64));
    }
    Value::Float(low + (high - low) * draw)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    const FILE: &str = "scene = \"er16k-tb1\"\nruns = 40\nseed = 7\nkinds = [\"healthy\", \"inner\"]\n\
        speed_profiles = [\"a.csv\", \"b.csv\"]\nnoise_db = [0, 30]\n\
        [grid]\ndefect.length_mm = [1, 2, 3]\ndefect.depth_um = [20, 50]\n[random]\nshaft.load_n = [300, 1500]\n";

    fn runs(text: &str) -> Vec<Run> {
        let sweep = Sweep::read(text).unwrap().0;
        (0..sweep.runs).map(|index| sweep.run(index, &|_| false)).collect()
    }

    #[test]
    fn a_longer_sweep_begins_with_the_shorter_one_and_another_seed_or_key_changes_only_what_it_is_about() {
        let short = runs(FILE);
        assert_eq!(runs(&FILE.replace("runs = 40", "runs = 80"))[..40], short);
        let other = runs(&FILE.replace("seed = 7", "seed = 8"));
        let further = runs(&format!("{FILE}cage.slip = [0.0, 0.01]\n"));
        for ((run, other), further) in short.iter().zip(&other).zip(&further) {
            assert_eq!(run.values[..2], other.values[..2]);
            assert_ne!(run.values[2], other.values[2]);
            assert_ne!(run.noise, other.noise);
            assert_eq!((&run.values[..], run.noise), (&further.values[..3], further.noise));
        }
        let mut seeds: Vec<u64> = short.iter().map(|run| run.noise.unwrap().seed).collect();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), 40, "two runs with one noise");
    }

    #[test]
    fn every_point_of_the_grid_kind_and_speed_comes_once_before_any_comes_twice() {
        let sweep = Sweep::read(FILE).unwrap().0;
        assert_eq!(sweep.points(), 24);
        let points: Vec<String> = (0..24).map(|number| format!("{:?}", sweep.point(number, 0))).collect();
        let mut different = points.clone();
        different.sort();
        different.dedup();
        assert_eq!(different.len(), 24);
        // Kinds take turns first.
        let kinds: Vec<_> = (0..4).map(|number| sweep.point(number, 0).kind.unwrap().word()).collect();
        assert_eq!(kinds, ["healthy", "inner", "healthy", "inner"]);
    }

    #[test]
    fn draws_are_spread_over_their_range_and_whole_ones_reach_both_ends() {
        let draws: Vec<i64> =
            (0..3000).map(|k| drawn([8.0, 10.0], uniform(1, 1, k), true).as_integer().unwrap()).collect();
        for value in 8..=10 {
            let count = draws.iter().filter(|&&draw| draw == value).count();
            // A third each; four standard deviations are 103.
            assert!((897..=1103).contains(&count), "{value}: {count}");
        }
        assert_eq!(draws.iter().min(), Some(&8));
        assert_eq!(draws.iter().max(), Some(&10));
    }
}
