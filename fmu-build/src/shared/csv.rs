//! CSV as Brinell writes it: one header line `name [unit]`, then numbers that read back to the same bits.

use std::io::{self, Write};

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
