//! CSV as Brinell writes it: one header line `name [unit]`, then numbers that read back to the same bits.

use std::io::{self, Write};
use std::path::Path;

use anyhow::Result;

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
