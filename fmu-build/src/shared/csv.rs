//! CSV as Brinell writes it: one header line `name [unit]`, then numbers that read back to the same bits; and tables of
//! two columns that users write.

use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result, bail};

use super::whole_file;

/// Writes the header line.
pub fn header<'a>(out: &mut impl Write, columns: impl Iterator<Item = (&'a str, &'a str)>) -> io::Result<()> {
    for (index, (name, unit)) in columns.enumerate() {
        let comma = if index == 0 { "" } else { "," };
        write!(out, "{comma}{name} [{unit}]")?;
    }
    writeln!(out)
}

/// Writes one row. Rust's debug form is the shortest text that reads back to the same number.
pub fn row(out: &mut impl Write, values: impl Iterator<Item = f64>) -> io::Result<()> {
    for (index, value) in values.enumerate() {
        let comma = if index == 0 { "" } else { "," };
        write!(out, "{comma}{value:?}")?;
    }
    writeln!(out)
}

/// Columns of equal length, named with their units, into a file of their own.
pub fn table(path: &Path, names: &[(String, &str)], columns: &[Vec<f64>]) -> Result<()> {
    whole_file::write_with(path, |mut out| {
        header(&mut out, names.iter().map(|(name, unit)| (name.as_str(), *unit)))?;
        let rows = columns.iter().map(Vec::len).min().unwrap_or(0);
        for i in 0..rows {
            row(&mut out, columns.iter().map(|column| column[i]))?;
        }
        Ok(())
    })
}

/// Two numbers, and the line that they stand on.
pub type Pair = (usize, [f64; 2]);

/// Reads a table of two columns below one of these headings; gives which it is. Empty lines and those that begin with
/// `#` are left out.
///
/// # Errors
/// What is no such table, which `what` names, with the line, the value and what it must be.
pub fn pairs(text: &str, what: &str, headings: &[[&str; 2]]) -> Result<(usize, Vec<Pair>)> {
    let mut lines = (1..).zip(text.lines().map(|line| line.trim_start_matches('\u{feff}').trim()));
    let (_, heading) = lines.next().unwrap_or((1, ""));
    let cells = |line: &str| line.split(',').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    let Some(which) = headings.iter().position(|known| cells(heading) == *known) else {
        let known: Vec<String> = headings.iter().map(|names| names.join(",")).collect();
        bail!("line 1 is {heading:?}: {what} begins with the heading {}", known.join(" or "));
    };
    let names = headings[which];
    let mut pairs = Vec::new();
    for (number, line) in lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#')) {
        let cells = cells(line);
        if cells.len() != names.len() {
            let [one, other] = names;
            bail!("line {number}: {line:?} has {} cells: it must have 2, {one} and {other}", cells.len());
        }
        let mut values = [0.0; 2];
        for ((value, cell), name) in values.iter_mut().zip(cells).zip(names) {
            let finite = cell.parse().ok().filter(|value: &f64| value.is_finite());
            *value =
                finite.with_context(|| format!("line {number}: {name} is {cell:?}: it must be a finite number"))?;
        }
        pairs.push((number, values));
    }
    if pairs.len() < 2 {
        bail!("it has {} rows of numbers: {what} needs at least 2", pairs.len());
    }
    Ok((which, pairs))
}
