//! What is wrong with a sweep beside its scene: every value is tried in the scene before anything runs.
//!
//! First one run whose values are each the first on the grid and the lower end of its range, then, key by key, the
//! others. What only some runs with random values meet shows when they are run, in their rows. What a scene is asked
//! about, its values are asked about here: each key of the sweep once, and once where nothing presses at the defect.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Result;
use brinell::scene::{Plain, Scene};
use brinell_scene_file::{SceneFileError, UnitRemark};
use toml::Value;

use super::design::{Point, Run, drawn};
use super::faults::Fault;
use super::file::{Entry, Sweep, number};
use super::scenes::Base;
use crate::package::model::not_pressed;
use crate::shared::{note, shipped};

/// Values of one key that are tried at most.
const TRIED: usize = 1000;

/// What is wrong with the scenes of a sweep, each fault with the line of its key, and what there is to ask.
pub(super) fn faults(base: &Base, sweep: &Sweep, is_whole: &dyn Fn(&str) -> bool) -> (Vec<Fault>, Questions) {
    let mut faults: Vec<Fault> = Vec::new();
    let mut tell = |fault: Fault| {
        if !faults.iter().any(|known| known.message == fault.message) {
            faults.push(fault);
        }
    };
    let mut questions = Questions::default();
    for point in 0..sweep.kinds.len().max(1) as u64 {
        let first = first(sweep, point, is_whole);
        let wrong = questions.ask(base, sweep, &first);
        wrong.iter().for_each(|message| tell(about(sweep, message, 0)));
        for (position, (key, line, values)) in others(sweep, is_whole).into_iter().enumerate() {
            for value in values {
                let mut run = first.clone();
                run.values[position] = (key.to_owned(), value);
                let all = questions.ask(base, sweep, &run);
                all.iter()
                    .filter(|message| !wrong.contains(message))
                    .for_each(|message| tell(about(sweep, message, line)));
            }
        }
    }
    (faults, questions)
}

/// What there is to ask about the runs of a sweep.
#[derive(Debug, Default)]
pub(super) struct Questions {
    /// Of each key the first, with its line.
    units: BTreeMap<(usize, String), String>,
    not_pressed: Option<String>,
}

impl Questions {
    /// What is wrong with the scene of a run, or else what there is to ask about it is kept.
    fn ask(&mut self, base: &Base, sweep: &Sweep, run: &Run) -> Vec<String> {
        let (text, scene) = match read(base, sweep, run) {
            Ok(read) => read,
            Err(messages) => return messages,
        };
        for UnitRemark { question, .. } in brinell_scene_file::unit_questions(&text) {
            // Of keys that are the scene's own the scene is asked.
            if let Some((key, line)) = sweep.lines().find(|(key, _)| question.key == *key) {
                let asked = || format!("{key} = {}: {question}", Plain(question.value));
                self.units.entry((line, key.to_owned())).or_insert_with(asked);
            }
        }
        if self.not_pressed.is_none() && run.profile.is_none() {
            let texts: Result<Vec<_>> =
                scene.profile_names().iter().map(|name| shipped::text_beside(&base.path, name)).collect();
            let texts = texts.unwrap_or_default();
            let asked = not_pressed(&scene, texts.iter().map(String::as_str));
            self.not_pressed = asked.map(|asked| format!("runs such as {}: {asked}", shown(run)));
        }
        Vec::new()
    }

    /// Asks.
    pub(super) fn tell(&self, file: &Path) {
        let units = self.units.iter().map(|((line, _), asked)| format!("line {line}: {asked}"));
        for asked in units.chain(self.not_pressed.clone()) {
            note!("note: {}: {asked}", file.display());
        }
    }
}

/// The values of a run in few words.
fn shown(run: &Run) -> String {
    let kind = run.kind.map(|kind| format!("kind {}", kind.word()));
    let values = run.values.iter().map(|(key, value)| format!("{key} = {value}"));
    kind.into_iter().chain(values).collect::<Vec<_>>().join(", ")
}

/// Whether a key takes whole numbers only: what the scene says of one that is none.
pub(super) fn takes_whole_numbers(base: &Base, sweep: &Sweep, key: &str) -> bool {
    let kinds = 0..sweep.kinds.len().max(1) as u64;
    kinds.map(|point| first(sweep, point, &|_| false)).any(|mut run| {
        let Some((_, value)) = run.values.iter_mut().find(|(known, _)| known == key) else { return false };
        let Some(low) = number(value) else { return false };
        *value = Value::Float(low.floor() + 0.5);
        let messages = read(base, sweep, &run).err().unwrap_or_default();
        messages.iter().any(|message| message.starts_with(&format!("{key} is")) && message.contains("a whole number"))
    })
}

/// The run of a kind with the first value of every key.
fn first(sweep: &Sweep, point: u64, is_whole: &dyn Fn(&str) -> bool) -> Run {
    let Point { kind, profile, mut values } = sweep.point(point, 0);
    let low = |entry: &Entry<[f64; 2]>| (entry.key.clone(), drawn(entry.of, 0.0, is_whole(&entry.key)));
    values.extend(sweep.random.iter().map(low));
    Run { index: 0, kind, profile, values, noise: None }
}

/// Keys in the order of a run's values, each with its line and the other values that runs have of it.
fn others<'s>(sweep: &'s Sweep, is_whole: &dyn Fn(&str) -> bool) -> Vec<(&'s str, usize, Vec<Value>)> {
    let grid = sweep
        .grid
        .iter()
        .map(|Entry { key, line, of }| (key.as_str(), *line, of.iter().skip(1).take(TRIED).cloned().collect()));
    let random = sweep.random.iter().map(|&Entry { ref key, line, of: [_, high] }| {
        (key.as_str(), line, vec![drawn([high, high], 0.0, is_whole(key))])
    });
    grid.chain(random).collect()
}

/// The scene of a run and its text; or what is wrong with it, without lines of a file that nobody sees.
fn read(base: &Base, sweep: &Sweep, run: &Run) -> Result<(String, Scene), Vec<String>> {
    let table = base.changed(sweep, run).map_err(|message| vec![message])?;
    let text = toml::to_string(&table).map_err(|error| vec![error.to_string()])?;
    match brinell_scene_file::from_toml(&text) {
        Ok(scene) => Ok((text, scene)),
        Err(SceneFileError::Keys(faults)) => Err(faults
            .iter()
            .map(|fault| {
                let message = fault.to_string();
                message.strip_prefix(&format!("line {}: ", fault.line())).unwrap_or(&message).to_owned()
            })
            .collect()),
        Err(error) => Err(vec![error.to_string()]),
    }
}

/// A fault with the line of the key that it names, or else of the key that was changed.
fn about(sweep: &Sweep, message: &str, line: usize) -> Fault {
    let words = |key: &str| {
        let mut words = message.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '.'));
        words.any(|word| word.trim_end_matches('.') == key)
    };
    let named = sweep.lines().find(|(key, _)| words(key));
    let in_table = || {
        sweep
            .lines()
            .find(|(key, _)| key.split('.').next().is_some_and(|table| message.starts_with(&format!("[{table}]"))))
    };
    let line = match named {
        Some((_, line)) => line,
        None if line > 0 => line,
        None => in_table().map_or(0, |(_, line)| line),
    };
    Fault { line, message: message.to_owned() }
}
