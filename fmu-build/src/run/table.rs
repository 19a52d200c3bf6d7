//! A run's table as users ask for it: CSV, NumPy or Parquet.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Result;
use brinell::recording::Layout;
use clap::ValueEnum;
use parquet::basic::{Compression, Encoding, GzipLevel, Repetition, Type as Physical};
use parquet::data_type::DoubleType;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{PrimitiveTypeBuilder, Type};

use super::signals::Signals;
use crate::shared::{csv, whole_file};

/// Rows in a group: what is kept in memory while a file is written.
pub(crate) const GROUP: usize = 1 << 15;

/// How much time is spent on packing, of 9: more makes files a hundredth smaller.
const PACKING: u32 = 4;

/// What a table is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Format {
    /// Text, a line for each communication point
    #[default]
    Csv,
    /// NumPy's file, a field for each column; of many elements arrays, as element.path
    Npy,
    /// Apache Parquet, packed
    Parquet,
}

/// A column of a table.
#[derive(Debug, Clone, Copy)]
pub struct Column<'a> {
    /// Which of the signals it is.
    pub index: usize,
    /// Its unit, for the heading.
    pub unit: &'a str,
}

/// What a table's metadata says of where it comes from: version and scene file.
pub fn origin(scene: &str) -> [(&str, &str); 2] {
    [("brinell.version", env!("CARGO_PKG_VERSION")), ("brinell.scene", scene)]
}

impl Format {
    /// The file of a scene's table. The recorder's samples have the name that ends in `.npy` alone.
    pub fn path(self, folder: &Path, scene: &str) -> PathBuf {
        let ending = match self {
            Self::Csv => ".csv",
            Self::Npy => "-signals.npy",
            Self::Parquet => ".parquet",
        };
        folder.join(format!("{scene}{ending}"))
    }

    /// Writes these columns of the signals; Parquet's metadata says by these pairs of `origin` where they come from.
    pub fn write(self, signals: &Signals, columns: &[Column], origin: &[(&str, &str)], path: &Path) -> Result<()> {
        whole_file::write_with(path, |out| match self {
            Self::Csv => as_csv(signals, columns, out),
            Self::Npy => as_npy(signals, columns, out),
            Self::Parquet => as_parquet(signals, columns, origin, out),
        })
    }
}

fn as_csv(signals: &Signals, columns: &[Column], mut out: &mut (dyn Write + Send)) -> Result<()> {
    csv::header(&mut out, columns.iter().map(|column| (signals.names()[column.index].as_str(), column.unit)))?;
    signals.each_row(|row| Ok(csv::row(&mut out, columns.iter().map(|column| row[column.index]))?))
}

fn as_npy(signals: &Signals, columns: &[Column], out: &mut (dyn Write + Send)) -> Result<()> {
    let names: Vec<String> = columns.iter().map(|column| signals.names()[column.index].clone()).collect();
    let layout = Layout::of(&names);
    out.write_all(&layout.header(signals.rows()))?;
    let order: Vec<usize> = layout.order().iter().map(|&k| columns[k].index).collect();
    signals.each_row(|row| Ok(order.iter().try_for_each(|&index| out.write_all(&row[index].to_le_bytes()))?))
}

/// Doubles with their bytes sorted by significance, which then pack well.
fn as_parquet(
    signals: &Signals,
    columns: &[Column],
    origin: &[(&str, &str)],
    out: &mut (dyn Write + Send),
) -> Result<()> {
    let name = |column: &Column| signals.names()[column.index].as_str();
    let field =
        |column| Type::primitive_type_builder(name(column), Physical::DOUBLE).with_repetition(Repetition::REQUIRED);
    let units = columns.iter().map(|column| (name(column), column.unit));
    let sorted = WriterProperties::builder().set_dictionary_enabled(false).set_encoding(Encoding::BYTE_STREAM_SPLIT);
    let mut writer = parquet_writer(out, sorted, "run", columns.iter().map(field), units, origin)?;
    let mut group = vec![Vec::with_capacity(GROUP); columns.len()];
    signals.each_row(|row| {
        for (values, column) in group.iter_mut().zip(columns) {
            values.push(row[column.index]);
        }
        if group[0].len() == GROUP { put(&mut group, &mut writer) } else { Ok(()) }
    })?;
    put(&mut group, &mut writer)?;
    writer.close()?;
    Ok(())
}

/// A Parquet file of these fields, packed. Its own metadata has each column's unit as `unit:<name>`, and then the pairs
/// of `origin`.
pub(crate) fn parquet_writer<'a, W: Write + Send>(
    out: W,
    properties: WriterPropertiesBuilder,
    schema: &str,
    fields: impl Iterator<Item = PrimitiveTypeBuilder<'a>>,
    units: impl Iterator<Item = (&'a str, &'a str)>,
    origin: &[(&str, &str)],
) -> Result<SerializedFileWriter<W>> {
    let fields = fields.map(|field| Ok(Arc::new(field.build()?))).collect::<Result<Vec<_>>>()?;
    let schema = Arc::new(Type::group_type_builder(schema).with_fields(fields).build()?);
    let pair = |key: String, value: &str| KeyValue::new(key, Some(value.to_owned()));
    let units = units.map(|(name, unit)| pair(format!("unit:{name}"), unit));
    let metadata = units.chain(origin.iter().map(|(key, value)| pair((*key).to_owned(), value))).collect();
    let packed = properties.set_compression(Compression::GZIP(GzipLevel::try_new(PACKING)?));
    let properties = packed.set_key_value_metadata(Some(metadata)).build();
    Ok(SerializedFileWriter::new(out, schema, Arc::new(properties))?)
}

/// Writes the rows that have gathered, if any.
fn put<W: Write + Send>(group: &mut [Vec<f64>], writer: &mut SerializedFileWriter<W>) -> Result<()> {
    if group[0].is_empty() {
        return Ok(());
    }
    let mut rows = writer.next_row_group()?;
    for column in group {
        if let Some(mut writer) = rows.next_column()? {
            writer.typed::<DoubleType>().write_batch(column, None, None)?;
            writer.close()?;
        }
        column.clear();
    }
    rows.close()?;
    Ok(())
}
