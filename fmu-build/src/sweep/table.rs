//! The table of a sweep as Apache Parquet: a row for each run, in the order of runs; what a run does not have is null.

use std::path::Path;
use std::sync::Arc;

use anyhow::Result;
use parquet::basic::{Compression, GzipLevel, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::rows::{Cell, Column, Kind, Row};
use crate::run::table::{GROUP, PACKING};
use crate::shared::whole_file;

/// Writes the rows, whole or not at all.
pub(super) fn write(path: &Path, columns: &[Column], rows: &[Row]) -> Result<()> {
    let field = |column: &Column| {
        let (physical, logical) = match column.kind {
            Kind::Number => (Physical::DOUBLE, None),
            Kind::Whole => (Physical::INT64, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let built = Type::primitive_type_builder(&column.name, physical).with_repetition(Repetition::OPTIONAL);
        Ok(Arc::new(built.with_logical_type(logical).build()?))
    };
    let fields = columns.iter().map(field).collect::<Result<Vec<_>>>()?;
    let schema = Arc::new(Type::group_type_builder("sweep").with_fields(fields).build()?);
    let properties =
        WriterProperties::builder().set_compression(Compression::GZIP(GzipLevel::try_new(PACKING)?)).build();
    whole_file::write_with(path, |out| {
        let mut writer = SerializedFileWriter::new(out, schema, Arc::new(properties))?;
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
