//! Rows of a sweep: one for each run, kept in a journal as they come and written as one table.
//!
//! A line of the journal is a row with a checksum before it. A program that is ended while it writes leaves at most a
//! line that its checksum does not fit; that run is made again.

pub(super) mod columns;
pub(super) mod labels;
pub(super) mod statistics;

use crate::run::table::{GROUP, parquet_writer};
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedRowGroupWriter;
use parquet::schema::types::{PrimitiveTypeBuilder, Type};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use brinell::numerics::checksum::checksum;

use crate::shared::{NotWritten, whole_file};

/// Name of the journal.
pub(super) const FILE: &str = "rows.log";

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Number,
    Whole,
    Text,
}

/// A column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) meaning: String,
}

/// What stands in a column of a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cell {
    Missing,
    Number(f64),
    Whole(i64),
    Text(String),
}

/// A row: a cell for each column, the first of which is the run's number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row(pub(super) Vec<Cell>);

impl Row {
    /// The row of a run, all else missing.
    pub(super) fn of(columns: &[Column], run: u64) -> Self {
        let mut row = Self(vec![Cell::Missing; columns.len()]);
        row.0[0] = Cell::Whole(run as i64);
        row
    }

    /// Number of its run.
    pub(super) fn run(&self) -> Option<u64> {
        match self.0.first() {
            Some(Cell::Whole(run)) => u64::try_from(*run).ok(),
            _ => None,
        }
    }

    /// Puts a value into the column of this name. What is not finite is missing.
    ///
    /// # Errors
    /// No such column.
    pub(super) fn put(&mut self, columns: &[Column], name: &str, cell: Cell) -> Result<()> {
        let position = columns.iter().position(|column| column.name == name);
        let position = position.with_context(|| format!("a sweep's table has no column {name}"))?;
        self.0[position] = match cell {
            Cell::Number(number) if !number.is_finite() => Cell::Missing,
            cell => cell,
        };
        Ok(())
    }

    /// As a line of the journal.
    fn line(&self) -> String {
        let cells: Vec<String> = self.0.iter().map(Cell::written).collect();
        let text = cells.join("\t");
        format!("{:016x}\t{text}\n", checksum(text.as_bytes()))
    }

    /// From a line without its end; `None` of what was not written whole, or has other columns.
    fn read(line: &str, columns: &[Column]) -> Option<Self> {
        let (sum, text) = line.split_once('\t')?;
        if u64::from_str_radix(sum, 16).ok()? != checksum(text.as_bytes()) {
            return None;
        }
        let row = Self(text.split('\t').map(Cell::read).collect::<Option<_>>()?);
        (row.0.len() == columns.len() && row.run().is_some()).then_some(row)
    }
}

impl Cell {
    /// Numbers by their bits, so that they come back as they were.
    fn written(&self) -> String {
        match self {
            Self::Missing => String::new(),
            Self::Number(number) => format!("n{:016x}", number.to_bits()),
            Self::Whole(whole) => format!("w{whole}"),
            // As JSON: no tab and no end of a line.
            Self::Text(text) => format!("t{}", serde_json::Value::from(text.as_str())),
        }
    }

    fn read(text: &str) -> Option<Self> {
        let Some((kind, rest)) = text.split_at_checked(1) else { return Some(Self::Missing) };
        match kind {
            "n" => u64::from_str_radix(rest, 16).ok().map(|bits| Self::Number(f64::from_bits(bits))),
            "w" => rest.parse().ok().map(Self::Whole),
            "t" => serde_json::from_str(rest).ok().map(Self::Text),
            _ => None,
        }
    }
}

/// The journal of a sweep, open for further rows.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// Opens the journal in a folder; gives the rows that are there, each run once. What was torn is cut off, in a
    /// new file that is written in `running`.
    pub(super) fn open(folder: &Path, running: &Path, columns: &[Column]) -> Result<(Self, Vec<Row>)> {
        let path = folder.join(FILE);
        let about = || path.display().to_string();
        let text = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => return Err(error).with_context(about),
        };
        let mut rows: Vec<Row> = Vec::new();
        let whole = String::from_utf8_lossy(&text);
        for line in whole.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n')) {
            rows.extend(Row::read(line, columns));
        }
        rows.sort_by_key(Row::run);
        rows.dedup_by_key(|row| row.run());
        let new_file = running.join(FILE);
        whole_file::write_with(&new_file, |out| {
            Ok(rows.iter().try_for_each(|row| out.write_all(row.line().as_bytes()))?)
        })?;
        whole_file::take_out(&new_file, folder)?;
        let file = File::options().append(true).open(&path).with_context(about)?;
        Ok((Self { path, file }, rows))
    }

    /// Adds a row.
    pub(super) fn add(&mut self, row: &Row) -> Result<()> {
        let written = self.file.write_all(row.line().as_bytes());
        Ok(written.map_err(|error| NotWritten::new(&self.path, error))?)
    }
}

/// Writes the rows as Apache Parquet, whole or not at all: a row for each run, in their order; what a run does not have
/// is null. The file's metadata has each column's unit as `unit:<name>`, and these pairs of `origin`.
pub(super) fn write_table(path: &Path, columns: &[Column], origin: &[(&str, &str)], rows: &[Row]) -> Result<()> {
    fn field(column: &Column) -> PrimitiveTypeBuilder<'_> {
        let (physical, logical) = match column.kind {
            Kind::Number => (Physical::DOUBLE, None),
            Kind::Whole => (Physical::INT64, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let built = Type::primitive_type_builder(&column.name, physical).with_repetition(Repetition::OPTIONAL);
        built.with_logical_type(logical)
    }
    let units = columns.iter().filter_map(|column| Some((column.name.as_str(), column.unit()?)));
    whole_file::write_with(path, |out| {
        let properties = WriterProperties::builder();
        let mut writer = parquet_writer(out, properties, "sweep", columns.iter().map(field), units, origin)?;
        for rows in rows.chunks(GROUP) {
            let mut group = writer.next_row_group()?;
            for (position, column) in columns.iter().enumerate() {
                let cells = rows.iter().map(|row| &row.0[position]);
                match column.kind {
                    Kind::Number => put::<DoubleType, _>(&mut group, cells, |cell| match cell {
                        Cell::Number(number) => Some(*number),
                        Cell::Whole(whole) => Some(*whole as f64),
                        _ => None,
                    })?,
                    Kind::Whole => put::<Int64Type, _>(&mut group, cells, |cell| match cell {
                        Cell::Whole(whole) => Some(*whole),
                        _ => None,
                    })?,
                    Kind::Text => put::<ByteArrayType, _>(&mut group, cells, |cell| match cell {
                        Cell::Text(text) => Some(ByteArray::from(text.as_str())),
                        _ => None,
                    })?,
                }
            }
            group.close()?;
        }
        writer.close()?;
        Ok(())
    })
}

/// Writes the next column.
fn put<'c, T: DataType, W: std::io::Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    cells: impl Iterator<Item = &'c Cell>,
    value: impl Fn(&Cell) -> Option<T::T>,
) -> Result<()> {
    let values: Vec<Option<T::T>> = cells.map(value).collect();
    let there: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let values: Vec<T::T> = values.into_iter().flatten().collect();
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(&values, Some(&there), None)?;
        column.close()?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn columns() -> Vec<Column> {
        let column = |(name, kind): (&str, Kind)| Column { name: name.to_owned(), kind, meaning: String::new() };
        [("run", Kind::Whole), ("rms", Kind::Number), ("error", Kind::Text)].map(column).to_vec()
    }

    fn row(run: u64) -> Row {
        let mut row = Row::of(&columns(), run);
        row.put(&columns(), "rms", Cell::Number(0.1 * run as f64)).unwrap();
        row.put(&columns(), "error", Cell::Text(format!("a \"quoted\"\ttext\nof {run} µm \\ \u{1b}'"))).unwrap();
        row
    }

    #[test]
    fn rows_come_back_with_their_bits_and_what_was_torn_anywhere_is_left_out() {
        let (folder, running) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let (mut journal, none) = Journal::open(folder.path(), running.path(), &columns()).unwrap();
        assert!(none.is_empty());
        [3, 0, 2].iter().for_each(|&run| journal.add(&row(run)).unwrap());
        let whole = fs::read(folder.path().join("rows.log")).unwrap();
        let ends: Vec<usize> = (0..whole.len()).filter(|&at| whole[at] == b'\n').collect();
        for length in 0..=whole.len() {
            fs::write(folder.path().join("rows.log"), &whole[..length]).unwrap();
            let (_, rows) = Journal::open(folder.path(), running.path(), &columns()).unwrap();
            let kept = ends.iter().filter(|&&end| end < length).count();
            let mut expected: Vec<Row> = [3, 0, 2][..kept].iter().map(|&run| row(run)).collect();
            expected.sort_by_key(Row::run);
            assert_eq!(rows, expected, "cut after {length} bytes");
        }
        let mut damaged = whole.clone();
        damaged[ends[0] + 25] ^= 1;
        fs::write(folder.path().join("rows.log"), damaged).unwrap();
        assert_eq!(Journal::open(folder.path(), running.path(), &columns()).unwrap().1, [row(2), row(3)]);
    }
    #[test]
    fn a_value_for_a_column_that_the_table_does_not_have_is_an_error() {
        let mut row = Row::of(&columns(), 3);
        let error = row.put(&columns(), "rms_m_s2", Cell::Number(1.0)).unwrap_err();
        assert_eq!(error.to_string(), "a sweep's table has no column rms_m_s2");
        assert_eq!(row, Row::of(&columns(), 3));
    }
}
