//! Columns of numbers in a text with a header line, commas, and comment lines that begin with `#`.

use super::SurfaceError;

/// One line of numbers, with its line number from 1, in the order of the columns asked for.
pub(super) struct Row<const N: usize> {
    pub(super) line: usize,
    pub(super) values: [f64; N],
}

/// Whether the header has a column of this name.
pub(super) fn has_column(text: &str, column: &str) -> bool {
    lines(text).next().is_some_and(|(_, header)| cells(header).any(|cell| cell == column))
}

/// Reads the columns, which may stand in any order; all are needed and no other is known.
pub(super) fn read<const N: usize>(text: &str, columns: [&'static str; N]) -> Result<Vec<Row<N>>, SurfaceError> {
    let mut lines = lines(text);
    let (line, header) = lines.next().ok_or(SurfaceError::Empty)?;
    let order = column_order(line, header, columns)?;
    lines.map(|(line, text)| read_row(line, text, &order, columns)).collect()
}

/// For each cell of a line the index of its column.
fn column_order<const N: usize>(
    line: usize,
    header: &str,
    columns: [&'static str; N],
) -> Result<Vec<usize>, SurfaceError> {
    let mut order = Vec::with_capacity(N);
    for cell in cells(header) {
        let Some(index) = columns.iter().position(|&column| column == cell) else {
            // Of a file without a header the message says that its header is missing.
            if cell.parse::<f64>().is_ok() {
                return Err(missing(line, columns[0], header));
            }
            return Err(SurfaceError::UnknownColumn { line, column: cell.to_owned(), known: columns.join(", ") });
        };
        if order.contains(&index) {
            return Err(SurfaceError::RepeatedColumn { line, column: columns[index] });
        }
        order.push(index);
    }
    match (0..N).find(|index| !order.contains(index)) {
        Some(index) => Err(missing(line, columns[index], header)),
        None => Ok(order),
    }
}

fn missing(line: usize, column: &'static str, header: &str) -> SurfaceError {
    SurfaceError::MissingColumn { line, column, header: header.to_owned() }
}

fn read_row<const N: usize>(
    line: usize,
    text: &str,
    order: &[usize],
    columns: [&'static str; N],
) -> Result<Row<N>, SurfaceError> {
    let found = cells(text).count();
    if found != order.len() {
        return Err(SurfaceError::ValueCount { line, found, expected: order.len() });
    }
    let mut values = [0.0; N];
    for (cell, &index) in cells(text).zip(order) {
        let column = columns[index];
        let value: f64 = cell.parse().map_err(|_| SurfaceError::NotANumber { line, column, text: cell.to_owned() })?;
        if !value.is_finite() {
            return Err(SurfaceError::NotFinite { line, column, value });
        }
        values[index] = value;
    }
    Ok(Row { line, values })
}

/// Lines that say something, with their numbers.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    // Spreadsheets write a byte order mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let numbered = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

fn cells(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(str::trim)
}
