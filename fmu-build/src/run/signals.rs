//! Signals of a run in a NumPy file: what its tables, figures and sounds are made of. It grows row by row, so that a
//! run may be longer than memory.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use brinell::numerics::bytes::Reader;
use brinell::recording::Layout;

/// Rows that are read or changed at once.
const BLOCK: usize = 4096;

/// A file of rows with a number for each name; the first is the time (s).
#[derive(Debug, Clone, PartialEq)]
pub struct Signals {
    path: PathBuf,
    names: Vec<String>,
    /// Length of the header (bytes).
    header: u64,
    rows: u64,
}

/// A file that grows.
pub struct Growing {
    out: BufWriter<File>,
    signals: Signals,
    pushed: u64,
}

impl Growing {
    /// A file for so many rows, with a field for each name however many there are.
    pub fn create(path: &Path, names: Vec<String>, rows: u64) -> io::Result<Self> {
        let header = Layout::flat(&names).header(rows);
        let mut out = BufWriter::new(File::create(path)?);
        out.write_all(&header)?;
        let signals = Signals { path: path.to_owned(), names, header: header.len() as u64, rows };
        Ok(Self { out, signals, pushed: 0 })
    }

    /// Adds a row.
    pub fn push(&mut self, row: &[f64]) -> io::Result<()> {
        self.pushed += 1;
        row.iter().try_for_each(|value| self.out.write_all(&value.to_le_bytes()))
    }

    /// The file, whole; of a run that ended early with the rows that it has.
    pub fn end(mut self) -> io::Result<Signals> {
        if self.pushed < self.signals.rows {
            // A header's length does not depend on the rows.
            self.out.seek(SeekFrom::Start(0))?;
            self.out.write_all(&Layout::flat(&self.signals.names).header(self.pushed))?;
            self.signals.rows = self.pushed;
        }
        self.out.flush()?;
        Ok(self.signals)
    }
}

impl Signals {
    /// A file that a recorder has written of these names, which stand here in the file's order.
    pub fn of_recording(path: &Path, names: Vec<String>) -> Result<Self> {
        let layout = Layout::of(&names);
        let names: Vec<String> = layout.order().iter().map(|&index| names[index].clone()).collect();
        let header = layout.header(0).len() as u64;
        let length = path.metadata().with_context(|| path.display().to_string())?.len();
        let rows = (length - header.min(length)) / (8 * names.len() as u64);
        Ok(Self { path: path.to_owned(), names, header, rows })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names, the time's first.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Indices of the names that `wanted` says.
    pub fn indices(&self, wanted: impl Fn(&str) -> bool) -> Vec<usize> {
        (0..self.names.len()).filter(|&index| wanted(&self.names[index])).collect()
    }

    /// Hands over row after row.
    pub fn each_row(&self, mut to: impl FnMut(&[f64]) -> Result<()>) -> Result<()> {
        let mut file = BufReader::with_capacity(1 << 20, self.open(false)?);
        let mut bytes = vec![0; 8 * self.names.len()];
        let mut row = vec![0.0; self.names.len()];
        for _ in 0..self.rows {
            file.read_exact(&mut bytes).with_context(|| self.path.display().to_string())?;
            numbers(&bytes, &mut row);
            to(&row)?;
        }
        Ok(())
    }

    /// One signal.
    pub fn column(&self, index: usize) -> Result<Vec<f64>> {
        Ok(self.columns(&[index])?.pop().unwrap_or_default())
    }

    /// Several signals, read at once.
    pub fn columns(&self, indices: &[usize]) -> Result<Vec<Vec<f64>>> {
        if self.rows.saturating_mul(indices.len() as u64) > 1 << 27 {
            let names: Vec<&str> = indices.iter().map(|&index| self.names[index].as_str()).collect();
            bail!("{} samples of {}: at most {} go into memory", self.rows, names.join(", "), 1 << 27);
        }
        let mut columns = vec![Vec::with_capacity(self.rows as usize); indices.len()];
        self.each_row(|row| {
            columns.iter_mut().zip(indices).for_each(|(column, &index)| column.push(row[index]));
            Ok(())
        })?;
        Ok(columns)
    }

    /// Lets `by` change each row; it gets the number of the row.
    pub fn change(&self, mut by: impl FnMut(u64, &mut [f64])) -> Result<()> {
        let mut file = self.open(true)?;
        let width = self.names.len();
        let mut row = vec![0.0; width];
        for first in (0..self.rows).step_by(BLOCK) {
            let count = (self.rows - first).min(BLOCK as u64);
            let mut bytes = vec![0; 8 * width * count as usize];
            let at = self.header + 8 * width as u64 * first;
            file.seek(SeekFrom::Start(at))?;
            file.read_exact(&mut bytes)?;
            for (number, bytes) in (first..).zip(bytes.chunks_exact_mut(8 * width)) {
                numbers(bytes, &mut row);
                by(number, &mut row);
                bytes.chunks_exact_mut(8).zip(&row).for_each(|(to, value)| to.copy_from_slice(&value.to_le_bytes()));
            }
            file.seek(SeekFrom::Start(at))?;
            file.write_all(&bytes)?;
        }
        Ok(())
    }

    fn open(&self, to_write: bool) -> Result<File> {
        let opened = File::options().read(true).write(to_write).open(&self.path);
        let mut file = opened.with_context(|| self.path.display().to_string())?;
        file.seek(SeekFrom::Start(self.header))?;
        Ok(file)
    }
}

/// The numbers that bytes stand for.
fn numbers(bytes: &[u8], row: &mut [f64]) {
    let mut reader = Reader(bytes);
    for (number, read) in row.iter_mut().zip(std::iter::from_fn(|| reader.f64())) {
        *number = read;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn rows_are_read_as_they_were_written_and_changed_where_they_are() {
        let folder = tempfile::tempdir().unwrap();
        let names = vec!["time".to_owned(), "a".to_owned()];
        let count = 2 * BLOCK as u64 + 5;
        let mut growing = Growing::create(&folder.path().join("s.npy"), names.clone(), count).unwrap();
        (0..count).for_each(|i| growing.push(&[i as f64, 0.1 * i as f64]).unwrap());
        let signals = growing.end().unwrap();
        assert_eq!(Signals::of_recording(signals.path(), names).unwrap(), signals);
        signals.change(|row, values| values[1] += row as f64).unwrap();
        let expected: Vec<f64> = (0..count).map(|i| 0.1 * i as f64 + i as f64).collect();
        assert_eq!(signals.column(1).unwrap(), expected);
        assert_eq!(signals.column(0).unwrap().last(), Some(&((count - 1) as f64)));
    }
}
