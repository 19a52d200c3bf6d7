//! What a folder's rows were made of, line by line: a sweep goes on only where all of it is the same. A longer sweep
//! begins with the shorter one, so how many runs there are to be is left out.

use std::path::Path;
use std::{fs, io};

use anyhow::{Context, Result, bail};
use brinell::numerics::checksum::checksum;
use clap::ValueEnum;
use toml::{Table, Value};

use super::SignalFormat;
use crate::shared::{shipped, whole_file};
use crate::sweep::file::Sweep;
use crate::sweep::rows::Column;
use crate::sweep::scenes::Base;

/// Name of the file.
const FILE: &str = "design.txt";

/// All that rows and signals depend on.
pub(in crate::sweep) struct Record(Vec<String>);

impl Record {
    /// Of a sweep in a file.
    pub(in crate::sweep) fn of(
        sweep: &Sweep,
        base: &Base,
        file: &Path,
        text: &str,
        written: Option<SignalFormat>,
        columns: &[Column],
    ) -> Result<Self> {
        let mut lines = vec![format!("program = {:?}", env!("CARGO_PKG_VERSION"))];
        let signals = written.and_then(|written| written.to_possible_value());
        lines.push(format!("signals = {:?}", signals.as_ref().map_or("none", |value| value.get_name())));
        // Also the order of the grid, in which runs take its points and rows have their cells.
        let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
        lines.push(format!("columns = {names:?}"));
        let mut table: Table = text.parse().with_context(|| file.display().to_string())?;
        table.remove("runs");
        flat(&table, "", &mut lines);
        flat(&base.table, "scene.", &mut lines);
        let mut files: Vec<(String, String)> = Vec::new();
        for name in sweep.speed_profiles.iter().chain(&sweep.noise_spectrum) {
            let path = file.parent().unwrap_or(Path::new("")).join(name);
            files.push((name.clone(), fs::read_to_string(&path).with_context(|| path.display().to_string())?));
        }
        let of_grid = sweep.grid.iter().flat_map(|entry| &entry.of).chain(sweep.set.iter().map(|entry| &entry.of));
        let file = |value: &'_ Value| value.get("file").and_then(Value::as_str).map(str::to_owned);
        let of_grid = of_grid.filter_map(|value| value.as_str().map(str::to_owned).or_else(|| file(value)));
        let named = base.scene.profile_names().into_iter().map(str::to_owned).chain(of_grid);
        // Most words of a grid are no files.
        files.extend(named.filter_map(|name| {
            let text = shipped::text_beside(&base.path, &name).ok()?;
            Some((name, text))
        }));
        lines.extend(files.iter().map(|(name, text)| format!("file {name:?} = {:016x}", checksum(text.as_bytes()))));
        Ok(Self(lines))
    }

    /// Refuses a folder that holds rows of another sweep; writes the record where there is none.
    pub(super) fn claim(&self, folder: &Path) -> Result<()> {
        let path = folder.join(FILE);
        let there = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return whole_file::write(&path, self.0.iter().map(|line| format!("{line}\n")).collect::<String>());
            }
            Err(error) => return Err(error).with_context(|| path.display().to_string()),
        };
        let there: Vec<&str> = there.lines().collect();
        let missing = self.0.iter().find(|line| !there.contains(&line.as_str()));
        let gone = there.iter().find(|line| !self.0.iter().any(|own| own == *line));
        let difference = match (gone, missing) {
            (None, None) => return Ok(()),
            (Some(gone), Some(missing)) => format!("with `{gone}` where this one has `{missing}`"),
            (Some(gone), None) => format!("with `{gone}`, which this one has not"),
            (None, Some(missing)) => format!("without `{missing}`"),
        };
        bail!(
            "{} holds another sweep, {difference}: choose another folder with -o, or take this one away; {FILE} in it \
             says all of it",
            folder.display()
        )
    }
}

/// The keys of a table, those of tables in it included, a line for each.
fn flat(table: &Table, path: &str, lines: &mut Vec<String>) {
    for (key, value) in table {
        match value {
            Value::Table(inner) => flat(inner, &format!("{path}{key}."), lines),
            other => lines.push(format!("{path}{key} = {}", other.to_string().replace('\n', " "))),
        }
    }
}
