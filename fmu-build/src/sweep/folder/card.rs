//! The card of a data set: what the table beside it holds, how it was made and what is not in it, for those who get the
//! folder and not its maker.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;
use std::{fs, io};

use anyhow::Result;
use clap::ValueEnum;

use super::{ARRAY, SignalFormat};
use crate::shared::{note, whole_file};
use crate::sweep::file::{PARTS, Sweep};
use crate::sweep::rows::{Cell, Column, Row};
use crate::sweep::scenes::run_name;
use crate::sweep::{TABLE, error_of};

/// Name of the file.
const FILE: &str = "README.md";
/// How it begins: a file of that name that begins otherwise is somebody's own.
const MARK: &str = "<!-- Written by brinell sweep, each time that it writes the table. -->\n";

const NOT_MODELLED: &str = "Rings and housing bore are rigid: what lies between housing and sensor is in the modes of \
the scene's sensors alone. There is no plastic deformation and no wear: a defect stays as it is. There is no friction \
between elements and raceways; the cage moves as the scene says, without dynamics of its own. An oil film is there \
only where the scene has a [film], and only before the contact. At a sharp edge the contact is stiffer than a real \
corner unless the scene has `contact.edge = \"step\"`. Other parts of a machine are not heard: noise is what the \
sweep's file adds, white, pink or of a measured spectrum. So figures of this data set say how methods compare on it, \
and not how they do on a machine.";

/// All that it is made of.
pub(in crate::sweep) struct Card<'a> {
    pub(in crate::sweep) sweep: &'a Sweep,
    /// The sweep's file, and its text.
    pub(in crate::sweep) file: &'a Path,
    pub(in crate::sweep) text: &'a str,
    pub(in crate::sweep) signals: Option<SignalFormat>,
    pub(in crate::sweep) columns: &'a [Column],
}

/// Runs of a class.
#[derive(Default)]
struct Class {
    runs: usize,
    failed: usize,
    /// Of those that did not fail, how many each part of the data set has.
    parts: BTreeMap<String, usize>,
}

impl Card<'_> {
    /// Writes it beside the table of these rows, whole or not at all; one that somebody has written stays.
    pub(in crate::sweep) fn write(&self, folder: &Path, rows: &[Row]) -> Result<()> {
        let path = folder.join(FILE);
        match fs::read(&path) {
            Ok(there) if !there.starts_with(MARK.as_bytes()) => {
                note!("note: {} is not a sweep's and stays as it is: no card was written", path.display());
                Ok(())
            }
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error.into()),
            _ => whole_file::write(&path, self.written(rows)),
        }
    }

    fn written(&self, rows: &[Row]) -> String {
        [
            format!("{MARK}# Simulated vibration of rolling bearings: {}\n\n", self.name()),
            self.what(rows),
            "\n## Runs of each class\n\n".to_owned(),
            self.classes(rows),
            "\n## Columns\n\nWhat a run does not have is null, as keys of a defect in a healthy run.\n\n\
             | column | unit | meaning |\n|---|---|---|\n"
                .to_owned(),
            self.columns.iter().map(column).collect(),
            "\n## How it was made\n\n".to_owned(),
            self.how(),
            format!("\n## What is not modelled\n\n{NOT_MODELLED}\n"),
        ]
        .concat()
    }

    /// Without its folder, which is this machine's.
    fn name(&self) -> Cow<'_, str> {
        self.file.file_name().unwrap_or_default().to_string_lossy()
    }

    fn what(&self, rows: &[Row]) -> String {
        let Sweep { scene, runs, stop, settle, rate, .. } = self.sweep;
        let failed = rows.iter().filter(|row| error_of(row).is_some()).count();
        let mut text = format!(
            "`{TABLE}` has a row for each of {} runs of {runs}, of which {failed} failed: `error` says why. Each is a \
             simulation of the scene `{scene}`, with what its row says, from 0 to {stop} s with {rate} samples per \
             second. Statistics{} leave out the first {settle} s.\n",
            rows.len(),
            if self.signals.is_some() { " and signals" } else { "" },
        );
        text += &match self.signals {
            None => String::new(),
            Some(SignalFormat::Array) => format!(
                "\n`{ARRAY}` has the signals of all runs, for `numpy.load`: an array of runs in the order of \
                 `{TABLE}`, samples, and sensors in the order of the scene (m/s2). The first sample is \
                 one after {settle} s. Those of a run that failed are not numbers.\n"
            ),
            Some(signals) => format!(
                "\n`signals` has the time (s) and all sensors (m/s2) of each run: `{}` is that of run 0.\n",
                signals.file(&run_name(0))
            ),
        };
        text
    }

    /// Counts of `fault_type`, and of the parts of the data set if there are any.
    fn classes(&self, rows: &[Row]) -> String {
        let at = |name: &str| self.columns.iter().position(|column| column.name == name);
        let word = |row: &Row, name: &str| match at(name).map(|at| &row.0[at]) {
            Some(Cell::Text(word)) => Some(word.clone()),
            _ => None,
        };
        let mut classes: BTreeMap<String, Class> = BTreeMap::new();
        for row in rows {
            // A run whose scene is refused has no label.
            let class = classes.entry(word(row, "fault_type").unwrap_or_else(|| "unknown".to_owned())).or_default();
            class.runs += 1;
            match error_of(row) {
                Some(_) => class.failed += 1,
                None => *class.parts.entry(word(row, "split").unwrap_or_default()).or_default() += 1,
            }
        }
        let parts: &[&str] = if at("split").is_some() { &PARTS } else { &[] };
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let words =
            ["fault_type", "runs", "failed"].iter().chain(parts).map(|word| (*word).to_owned()).collect::<Vec<_>>();
        let mut text = line(words.clone()) + &line(vec!["---".to_owned(); words.len()]);
        for (name, class) in &classes {
            let of_parts = parts.iter().map(|part| class.parts.get(*part).copied().unwrap_or(0));
            let counts = [class.runs, class.failed].into_iter().chain(of_parts).map(|count| count.to_string());
            text += &line([name.clone()].into_iter().chain(counts).collect());
        }
        text
    }

    fn how(&self) -> String {
        let value = self.signals.and_then(|signals| signals.to_possible_value());
        let signals = value.map_or_else(String::new, |value| format!(" --signals {}", value.get_name()));
        // A fence that the text does not end.
        let mut fence = "```".to_owned();
        while self.text.contains(&fence) {
            fence.push('`');
        }
        format!(
            "Brinell {}: `brinell sweep {} -o FOLDER{signals}`, which gives the same bits again. With `--scene-of N` \
             it prints the scene of run N. The scene's own text is in the metadata of `{TABLE}`. `{}`:\n\n\
             {fence}toml\n{}\n{fence}\n",
            env!("CARGO_PKG_VERSION"),
            self.name(),
            self.name(),
            self.text.trim_end(),
        )
    }
}

fn column(column: &Column) -> String {
    format!("| `{}` | {} | {} |\n", column.name, column.unit().unwrap_or(""), column.meaning)
}
