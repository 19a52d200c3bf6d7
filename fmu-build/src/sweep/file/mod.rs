//! The file of a sweep: TOML that says which scene is run, and what changes from run to run.

mod growth;
mod kind;
mod split;

use std::ops::RangeInclusive;

use brinell_scene_file::{nearest, toml_fault};
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

use super::faults::Fault;
use crate::run::noise::{Color, FLOORS, NoiseLimits, RATIOS};
pub(super) use kind::Kind;
pub(super) use split::{PARTS, Split};

/// Keys of the file itself, and its tables of keys of a scene.
const KEYS: [&str; 15] = [
    "scene",
    "runs",
    "seed",
    "stop_s",
    "settle_s",
    "rate_hz",
    "filter",
    "kinds",
    "speed_profiles",
    "noise_db",
    "noise_rms_m_s2",
    "noise_color",
    "noise_spectrum",
    "split",
    "split_by",
];
const TABLES: [&str; 4] = ["set", "grid", "growth", "random"];
/// Samples per second that a sweep may ask for (Hz).
const RATES: RangeInclusive<f64> = 100.0..=1e6;
/// Runs of a sweep at most: numbers of runs have seven digits.
const MOST: u64 = 10_000_000;

/// A key of a scene, what stands behind it, and its line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry<T> {
    pub(super) key: String,
    pub(super) of: T,
    pub(super) line: usize,
}

/// What a file asks for.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sweep {
    /// Scene file, relative to this one, or the name of a shipped scene.
    pub(super) scene: String,
    /// How many runs; each point of the grid once where nothing is given.
    pub(super) runs: u64,
    pub(super) seed: u64,
    /// End of each run, and what is left out of signals and statistics at its beginning (s).
    pub(super) stop: f64,
    pub(super) settle: f64,
    /// Samples per second (Hz).
    pub(super) rate: f64,
    /// Whether samples go through the recorder's filter against aliases.
    pub(super) filter: bool,
    pub(super) kinds: Vec<Kind>,
    /// Files with the shaft's speed over time, relative to this one.
    pub(super) speed_profiles: Vec<String>,
    pub(super) noise: NoiseLimits,
    /// File with the spectrum of noise that every run has, relative to this one.
    pub(super) noise_spectrum: Option<String>,
    /// Parts of the data set that runs are shared out to.
    pub(super) split: Option<Split>,
    pub(super) set: Vec<Entry<Value>>,
    /// The last key is that of `[growth]` where a defect grows.
    pub(super) grid: Vec<Entry<Vec<Value>>>,
    /// Whether runs are stages of bearings whose defect grows.
    pub(super) grows: bool,
    pub(super) random: Vec<Entry<[f64; 2]>>,
}

impl Sweep {
    /// Reads the text of a file; gives what of it is right, and all that is wrong with it by itself.
    ///
    /// # Errors
    /// The first place at which it is not TOML.
    pub(super) fn read(text: &str) -> Result<(Self, Vec<Fault>), toml::de::Error> {
        let breaks: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
        let line = |at: usize| 1 + breaks.partition_point(|&end| end < at);
        let file = DeTable::parse(text).map_err(|error| toml_fault(text).unwrap_or(error))?;
        let values: Table = text.parse()?;
        let mut reading = Reading { file: file.get_ref(), values: &values, line: &line, faults: Vec::new() };
        let sweep = reading.sweep();
        Ok((sweep, reading.faults))
    }

    /// How many runs, each with all stages of a growth, show every point of the grid, kind and speed once.
    pub(super) fn points(&self) -> u64 {
        let grid = self.fixed().iter().map(|entry| entry.of.len()).chain([self.kinds.len(), self.speed_profiles.len()]);
        grid.fold(1, |product, count| product.saturating_mul(count.max(1) as u64))
    }

    /// Keys that change from run to run, and the lines on which they stand.
    pub(super) fn lines(&self) -> impl Iterator<Item = (&str, usize)> {
        let set = self.set.iter().map(|entry| (entry.key.as_str(), entry.line));
        let grid = self.grid.iter().map(|entry| (entry.key.as_str(), entry.line));
        set.chain(grid).chain(self.random.iter().map(|entry| (entry.key.as_str(), entry.line)))
    }
}

/// A file under the reader's eye, and what is wrong with it so far.
struct Reading<'a, 'f> {
    file: &'a DeTable<'f>,
    values: &'a Table,
    line: &'a dyn Fn(usize) -> usize,
    faults: Vec<Fault>,
}

impl Reading<'_, '_> {
    fn sweep(&mut self) -> Sweep {
        self.unknown();
        let scene = self.text("scene").unwrap_or_else(|| {
            if !self.file.keys().any(|key| is_meant("scene", key.get_ref())) {
                self.fault(0, "scene is missing: a scene file, or a shipped scene");
            }
            String::new()
        });
        let stop = self.number("stop_s", 0.3, "above 0 and finite", |value| value > 0.0 && value.is_finite());
        let settle = self.number("settle_s", (0.05f64).min(0.5 * stop), "from 0 to below stop_s", |value| {
            (0.0..stop).contains(&value)
        });
        let rate = self.number("rate_hz", 51_200.0, "from 100 to 1000000", |value| RATES.contains(&value));
        let filter = self.read("filter", "true or false", Value::as_bool).unwrap_or(false);
        let (kinds, speed_profiles, noise) = (self.kinds(), self.texts("speed_profiles"), self.noise());
        let (set, mut grid, random) = (self.entries("set"), self.grid(), self.random());
        let growth = self.growth();
        let grows = growth.is_some();
        grid.extend(growth);
        let mut sweep = Sweep {
            scene,
            runs: 0,
            seed: 0,
            stop,
            settle,
            rate,
            filter,
            kinds,
            speed_profiles,
            noise,
            noise_spectrum: self.text("noise_spectrum"),
            split: None,
            set,
            grid,
            grows,
            random,
        };
        self.given_twice(&mut sweep);
        sweep.seed = self.whole("seed", 0, i64::MAX as u64).unwrap_or(1);
        sweep.split = self.split(sweep.seed, sweep.fixed());
        let points = sweep.points().saturating_mul(sweep.stages());
        sweep.runs = self.whole("runs", 1, MOST).unwrap_or(points);
        if !self.file.keys().any(|key| is_meant("runs", key.get_ref())) && (!sweep.random.is_empty() || points > MOST) {
            self.fault(
                0,
                format!("runs is missing: values are drawn at random, or the grid has more than {MOST} points"),
            );
        }
        sweep
    }

    /// Keys that mean nothing here.
    fn unknown(&mut self) {
        let known = || KEYS.into_iter().chain(TABLES);
        for (key, _) in self.file.iter().filter(|(key, _)| !known().any(|known| known == key.get_ref().as_ref())) {
            let hint = match nearest(known(), key.get_ref()) {
                Some(near) => format!("did you mean {near}?"),
                None => format!(
                    "known here are {}, and the tables [set], [grid], [growth], [random] with keys of the scene",
                    KEYS.join(", ")
                ),
            };
            self.fault((self.line)(key.span().start), format!("{} is unknown: {hint}", key.get_ref()));
        }
    }

    /// Line of a key of the file itself.
    fn line_of(&self, key: &str) -> usize {
        self.file.get_key_value(key).map_or(0, |(key, _)| (self.line)(key.span().start))
    }

    fn fault(&mut self, line: usize, message: impl Into<String>) {
        self.faults.push(Fault { line, message: message.into() });
    }

    fn wrong(&mut self, key: &str, value: &Value, limit: &str) {
        self.fault(self.line_of(key), format!("{key} is {value}: it must be {limit}"));
    }

    /// What a key's value is read as; `None` where it is missing, or wrong, which is told by what it must be.
    fn read<T>(&mut self, key: &str, limit: &str, of: impl FnOnce(&Value) -> Option<T>) -> Option<T> {
        let value = self.values.get(key)?;
        let read = of(value);
        if read.is_none() {
            self.wrong(key, value, limit);
        }
        read
    }

    fn number(&mut self, key: &str, usual: f64, limit: &str, fits: impl Fn(f64) -> bool) -> f64 {
        let limit = format!("a number, {limit}");
        self.read(key, &limit, |value| number(value).filter(|&number| fits(number))).unwrap_or(usual)
    }

    fn whole(&mut self, key: &str, least: u64, most: u64) -> Option<u64> {
        let whole = |value: &Value| value.as_integer().and_then(|whole| u64::try_from(whole).ok());
        let limit = format!("a whole number from {least} to {most}");
        self.read(key, &limit, |value| whole(value).filter(|whole| (least..=most).contains(whole)))
    }

    fn text(&mut self, key: &str) -> Option<String> {
        let text = |value: &Value| value.as_str().filter(|text| !text.trim().is_empty()).map(str::to_owned);
        self.read(key, "a text in quotes", text)
    }

    fn texts(&mut self, key: &str) -> Vec<String> {
        let texts = |value: &Value| {
            let all = value.as_array().filter(|all| !all.is_empty())?;
            all.iter().map(|one| one.as_str().map(str::to_owned)).collect()
        };
        self.read(key, "a list of texts in quotes", texts).unwrap_or_default()
    }

    fn kinds(&mut self) -> Vec<Kind> {
        let mut kinds = Vec::new();
        for word in self.texts("kinds") {
            match Kind::ALL.iter().find(|(known, _)| *known == word) {
                Some((_, kind)) => kinds.push(*kind),
                None => {
                    let words = Kind::ALL.map(|(word, _)| word);
                    let near = nearest(words, &word).map_or_else(String::new, |near| format!("; did you mean {near}?"));
                    let words = words.join(", ");
                    self.fault(self.line_of("kinds"), format!("kinds: {word:?} is none of {words}{near}"));
                }
            }
        }
        kinds
    }

    fn noise(&mut self) -> NoiseLimits {
        let limit = "a ratio, or a list of two, the lower one first, from -60 to 200";
        let ratio = self.limits("noise_db", RATIOS, limit);
        let limit = "a root mean square, or a list of two, the lower one first, from 1e-9 to 1e6";
        let floor = self.limits("noise_rms_m_s2", FLOORS, limit);
        let color = self.read("noise_color", "\"white\" or \"pink\"", |value| match value.as_str()? {
            "white" => Some(Color::White),
            "pink" => Some(Color::Pink),
            _ => None,
        });
        NoiseLimits { ratio, floor, color: color.unwrap_or_default() }
    }

    /// A number, or two between which one is drawn.
    fn limits(&mut self, key: &str, range: RangeInclusive<f64>, limit: &str) -> Option<[f64; 2]> {
        let is_one = |[low, high]: &[f64; 2]| low <= high && range.contains(low) && range.contains(high);
        self.read(key, limit, |value| number(value).map(|number| [number; 2]).or_else(|| pair(value)).filter(is_one))
    }

    fn grid(&mut self) -> Vec<Entry<Vec<Value>>> {
        let limit = "a list of values, one at least";
        self.lists("grid", limit, |value| value.as_array().filter(|all| !all.is_empty()).cloned())
    }

    fn random(&mut self) -> Vec<Entry<[f64; 2]>> {
        let limit = "a list of two numbers, the lower one first";
        self.lists("random", limit, |value| pair(value).filter(|[low, high]| low <= high))
    }

    /// What the values of a table's keys are read as, those that are wrong aside.
    fn lists<T>(&mut self, table: &'static str, limit: &str, of: impl Fn(&Value) -> Option<T>) -> Vec<Entry<T>> {
        let mut lists = Vec::new();
        for Entry { key, of: value, line } in self.entries(table) {
            match of(&value) {
                Some(of) => lists.push(Entry { key, of, line }),
                None => self.fault(line, format!("{table}.{key} is {value}: it must be {limit}")),
            }
        }
        lists
    }

    /// The keys of a scene in one of the tables, in their order in the file.
    fn entries(&mut self, table: &'static str) -> Vec<Entry<Value>> {
        let (Some(spanned), Some(value)) = (self.file.get(table), self.values.get(table)) else { return Vec::new() };
        let (DeValue::Table(written), Value::Table(values)) = (spanned.get_ref(), value) else {
            self.wrong(table, value, &format!("a table [{table}] of keys of the scene"));
            return Vec::new();
        };
        let mut all = Vec::new();
        leaves(written, values, "", &mut all);
        all.sort_by_key(|leaf| leaf.at);
        all.into_iter().map(|Leaf { at, key, of }| Entry { key, of, line: (self.line)(at) }).collect()
    }

    /// Keys that stand twice, of which the first stays, and two ways to say one thing.
    fn given_twice(&mut self, sweep: &mut Sweep) {
        let all: Vec<(String, usize)> = sweep.lines().map(|(key, line)| (key.to_owned(), line)).collect();
        let is_first =
            |key: &str, line: usize| all.iter().find(|(other, _)| other == key).is_none_or(|one| one.1 == line);
        sweep.grid.retain(|entry| is_first(&entry.key, entry.line));
        sweep.random.retain(|entry| is_first(&entry.key, entry.line));
        for (index, (key, line)) in all.iter().enumerate() {
            let line = *line;
            if let Some((_, first)) = all[..index].iter().find(|(other, _)| other == key) {
                self.fault(
                    line,
                    format!(
                        "{key} stands in line {first} already: give it in one of [set], [grid], [growth], [random]"
                    ),
                );
            }
            if key == "shaft.speed_hz" && !sweep.speed_profiles.is_empty() {
                self.fault(line, "shaft.speed_hz and speed_profiles exclude each other: give only one");
            }
            if key == "name" || key == "recorder" || key.starts_with("recorder.") {
                let why = "names are those of runs, and samples are taken at rate_hz";
                self.fault(line, format!("{key} is the sweep's own: {why}"));
            }
        }
    }
}

/// Whether a key is this one, or a slip of the pen for it.
fn is_meant(wanted: &str, key: &str) -> bool {
    key == wanted || nearest(KEYS.into_iter().chain(TABLES), key) == Some(wanted)
}

/// A key and its value.
struct Leaf {
    /// Position in the text.
    at: usize,
    /// With the tables that it is in.
    key: String,
    of: Value,
}

/// Keys and values of a table, those of tables in it included.
fn leaves(at: &DeTable<'_>, values: &Table, path: &str, all: &mut Vec<Leaf>) {
    for (key, value) in at.iter() {
        let name = key.get_ref().as_ref();
        let Some(of) = values.get(name) else { continue };
        let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        match (value.get_ref(), of) {
            (DeValue::Table(inner), Value::Table(values)) => leaves(inner, values, &path, all),
            _ => all.push(Leaf { at: key.span().start, key: path, of: of.clone() }),
        }
    }
}

/// A finite number.
pub(super) fn number(value: &Value) -> Option<f64> {
    let number = value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    number.filter(|number| number.is_finite())
}

fn pair(value: &Value) -> Option<[f64; 2]> {
    match value.as_array().map(Vec::as_slice) {
        Some([low, high]) => Some([number(low)?, number(high)?]),
        _ => None,
    }
}
