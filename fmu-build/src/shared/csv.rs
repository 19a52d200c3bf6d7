//! CSV as Brinell writes it: one header line `name [unit]`, then numbers that read back to the same bits; and tables of
//! two columns that users write.

use std::fmt::Display;
use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result, bail};

use super::whole_file;

/// Writes the header line.
pub fn header<'a, N: Display>(out: &mut impl Write, columns: impl IntoIterator<Item = (N, &'a str)>) -> io::Result<()> {
    for (index, (name, unit)) in columns.into_iter().enumerate() {
        let comma = if index == 0 { "" } else { "," };
        write!(out, "{comma}{name} [{unit}]")?;
    }
    writeln!(out)
}

/// Writes one row. Rust's debug form is the shortest text that reads back to the same number.
pub fn row(out: &mut impl Write, values: impl IntoIterator<Item = f64>) -> io::Result<()> {
    for (index, value) in values.into_iter().enumerate() {
        let comma = if index == 0 { "" } else { "," };
        write!(out, "{comma}{value:?}")?;
    }
    writeln!(out)
}

/// Rows of numbers below their names with units, into a file of their own.
///
/// # Errors
/// Of a row, as it is; of writing.
pub fn write<'a, N: Display, R: IntoIterator<Item = f64>>(
    path: &Path,
    names: impl IntoIterator<Item = (N, &'a str)>,
    rows: impl IntoIterator<Item = Result<R>>,
) -> Result<()> {
    whole_file::write_with(path, |mut out| {
        header(&mut out, names)?;
        rows.into_iter().try_for_each(|values| Ok(row(&mut out, values?)?))
    })
}

/// Columns of equal length, named with their units, into a file of their own.
pub fn table(path: &Path, names: &[(impl Display, &str)], columns: &[impl AsRef<[f64]>]) -> Result<()> {
    let rows = columns.iter().map(|column| column.as_ref().len()).min().unwrap_or(0);
    let rows = (0..rows).map(|i| Ok(columns.iter().map(move |column| column.as_ref()[i])));
    write(path, names.iter().map(|(name, unit)| (name, *unit)), rows)
}

/// Two numbers, and the line that they stand on.
pub type Pair = (usize, [f64; 2]);

/// Reads a table of two columns, the first of which ascends, below one of these headings; gives which it is. Empty
/// lines and those that begin with `#` are left out.
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
    let mut pairs: Vec<Pair> = Vec::new();
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
        if let Some((_, [last, _])) = pairs.last().filter(|(_, [last, _])| values[0] <= *last) {
            bail!("line {number}: {} is {}: it must be above {last}, that of the row before", names[0], values[0]);
        }
        pairs.push((number, values));
    }
    if pairs.len() < 2 {
        bail!("it has {} rows of numbers: {what} needs at least 2", pairs.len());
    }
    Ok((which, pairs))
}
