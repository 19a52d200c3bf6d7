//! NumPy's files: [`.npy`][npy], and `.npz`, a ZIP archive of them. Numbers of one or two dimensions are read, in C or
//! Fortran order, and arrays of one dimension with named fields, each a number or a row of numbers, as the recorder of
//! an FMU writes them.
//!
//! The header is a Python literal, which is translated to JSON:
//!
//! ```text
//! {'descr': '<f8', 'fortran_order': False, 'shape': (204800, 2), }
//! {'descr': [('time', '<f8'), ('element.path', '<f8', (100,)), ], 'fortran_order': False, 'shape': (51201,), }
//! ```
//!
//! [npy]: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

use std::io::{Cursor, Read};

use serde::Deserialize;

use super::array::{self, Columns, Contents, Number};

#[derive(Deserialize)]
struct Header {
    descr: Elements,
    fortran_order: bool,
    shape: Vec<usize>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Elements {
    Number(String),
    Fields(Vec<Field>),
}

/// Name and type; of a row of numbers their count, too.
#[derive(Deserialize)]
#[serde(untagged)]
enum Field {
    Number(String, String),
    Row(String, String, [usize; 1]),
    Other(serde_json::Value),
}

/// Most numbers of a row, and bytes that fill up a row of C's: a hostile file must not exhaust the memory.
const MOST: usize = 1 << 16;
/// Most bytes of a file in an archive.
const LARGEST: u64 = 1 << 30;

/// All arrays in an archive, named after them.
pub(super) fn archive(bytes: &[u8]) -> Result<Contents, String> {
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|why| why.to_string())?;
    let mut contents = Contents::default();
    for index in 0..archive.len() {
        let entry = archive.by_index(index).map_err(|why| why.to_string())?;
        let name = entry.name().map_err(|why| why.to_string())?.into_owned();
        let Some(name) = name.strip_suffix(".npy") else { continue };
        let mut inside = Vec::new();
        entry.take(LARGEST).read_to_end(&mut inside).map_err(|why| format!("{name}: {why}"))?;
        let about = |why: String| format!("{name}: {why}");
        // Text beside the signals, as `<U7`.
        if matches!(header(&inside).map_err(about)?.0.descr, Elements::Number(kind) if kind.contains(['U', 'S'])) {
            continue;
        }
        let (names, columns) = columns(&inside).map_err(about)?;
        if names.is_empty() {
            contents.add(name, columns);
        } else {
            contents.names.extend(names);
            contents.columns.extend(columns);
        }
    }
    Ok(contents)
}

/// The header, and what follows it.
fn header(bytes: &[u8]) -> Result<(Header, &[u8]), String> {
    let short = || "the file ends inside its header".to_owned();
    if bytes.get(..6) != Some(b"\x93NUMPY".as_slice()) {
        return Err("not a .npy file: the magic string is missing".to_owned());
    }
    let (start, length) = match bytes.get(6).ok_or_else(short)? {
        1 => (10, bytes.get(8..10).map(|b| u16::from_le_bytes([b[0], b[1]]) as usize)),
        _ => (12, bytes.get(8..12).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize)),
    };
    let end = start + length.ok_or_else(short)?;
    let text = String::from_utf8_lossy(bytes.get(start..end).ok_or_else(short)?);
    let header = serde_json::from_str(&json(&text)).map_err(|why| format!("the header: {why}"))?;
    Ok((header, &bytes[end..]))
}

/// The file's channels.
pub(super) fn columns(bytes: &[u8]) -> Result<Columns, String> {
    let (header, data) = header(bytes)?;
    match &header.descr {
        Elements::Number(kind) => {
            let number = Number::of_numpy(kind)?;
            check_length(data, number.size(), &header.shape)?;
            let shape = if header.shape.is_empty() { &[1][..] } else { &header.shape };
            Ok((Vec::new(), array::channels(&number.values(data), shape, header.fortran_order)?))
        }
        Elements::Fields(fields) => of_fields(fields, &header.shape, data),
    }
}

fn check_length(data: &[u8], row: usize, shape: &[usize]) -> Result<(), String> {
    if shape.iter().try_fold(row, |product, &n| product.checked_mul(n)) == Some(data.len()) {
        return Ok(());
    }
    Err(format!("{} bytes of numbers, the shape {shape:?} of {row} bytes each needs another number", data.len()))
}

/// Columns of an array with fields.
fn of_fields(fields: &[Field], shape: &[usize], data: &[u8]) -> Result<Columns, String> {
    if shape.len() != 1 {
        return Err(format!("{} dimensions of named fields: 1 is read", shape.len()));
    }
    // Name, type and first byte of each column.
    let (mut places, mut row) = (Vec::new(), 0);
    for field in fields {
        let (name, kind, count) = match field {
            Field::Number(name, kind) => (name, kind, None),
            Field::Row(name, kind, [count]) if (1..=MOST).contains(count) => (name, kind, Some(*count)),
            Field::Row(name, ..) => return Err(not_read(&name.clone().into())),
            Field::Other(field) => return Err(not_read(field)),
        };
        // Bytes that fill a row up have no type.
        if let Some(bytes) = kind.strip_prefix("|V").and_then(|bytes| bytes.parse().ok()) {
            row +=
                Some(bytes).filter(|bytes| (1..=MOST).contains(bytes)).ok_or_else(|| not_read(&kind.clone().into()))?;
            continue;
        }
        let number = Number::of_numpy(kind).map_err(|why| format!("field '{name}': {why}"))?;
        for name in entries(name, count) {
            places.push((name, number, row));
            row += number.size();
        }
    }
    check_length(data, row, shape)?;
    let rows = || data.chunks_exact(row.max(1));
    Ok(places
        .into_iter()
        .map(|(name, number, at)| (name, rows().map(|row| number.value(&row[at..])).collect()))
        .unzip())
}

fn not_read(field: &serde_json::Value) -> String {
    format!("field {field} is neither a number nor a row of numbers for each sample")
}

/// Names of a field's numbers: `element[1].path` and so on of an array `element.path`.
fn entries(name: &str, count: Option<usize>) -> Vec<String> {
    let Some(count) = count else { return vec![name.to_owned()] };
    let (first, rest) = name.split_at(name.find('.').unwrap_or(name.len()));
    (1..=count).map(|entry| format!("{first}[{entry}]{rest}")).collect()
}

/// A Python literal of dictionaries, tuples, lists, texts, numbers and truth values as JSON.
fn json(literal: &str) -> String {
    let mut json = String::with_capacity(literal.len());
    let mut characters = literal.trim().chars();
    // A comma is written with what follows it: JSON has none before a bracket that closes.
    let mut comma = false;
    while let Some(c) = characters.next() {
        if c.is_whitespace() {
            continue;
        }
        let closes = matches!(c, ')' | ']' | '}');
        if std::mem::take(&mut comma) && !closes {
            json.push(',');
        }
        match c {
            ',' => comma = true,
            '(' => json.push('['),
            ')' => json.push(']'),
            '\'' | '"' => {
                let mut text = String::new();
                while let Some(inner) = characters.next().filter(|&inner| inner != c) {
                    // Escapes other than of quotes and of itself do not occur in names of signals.
                    text.extend(if inner == '\\' { characters.next() } else { Some(inner) });
                }
                json += &serde_json::Value::String(text).to_string();
            }
            // True and False.
            _ => json.push(c.to_ascii_lowercase()),
        }
    }
    json
}

#[cfg(test)]
mod tests {
    use super::*;

    fn npy_bytes(header: &str, data: &[u8]) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(data);
        bytes
    }

    #[test]
    fn a_vector_and_two_columns_in_either_order_are_read_from_npy() {
        let vector = npy_bytes(
            "{'descr': '<i2', 'fortran_order': False, 'shape': (3,), }\n",
            &[1i16, -2, 3].map(i16::to_le_bytes).concat(),
        );
        assert_eq!(columns(&vector).unwrap().1, [[1.0, -2.0, 3.0]]);
        for (order, values) in
            [("False", [1.0f32, 10.0, 2.0, 20.0, 3.0, 30.0]), ("True", [1.0, 2.0, 3.0, 10.0, 20.0, 30.0])]
        {
            let header = format!("{{'descr': '<f4', 'fortran_order': {order}, 'shape': (3, 2), }}\n");
            let read = columns(&npy_bytes(&header, &values.map(f32::to_le_bytes).concat())).unwrap().1;
            assert_eq!(read, [[1.0, 2.0, 3.0], [10.0, 20.0, 30.0]]);
            // The same numbers with a row for each channel, which the other order writes.
            let other = if order == "True" { "False" } else { "True" };
            let header = format!("{{'descr': '<f4', 'fortran_order': {other}, 'shape': (2, 3), }}\n");
            assert_eq!(columns(&npy_bytes(&header, &values.map(f32::to_le_bytes).concat())).unwrap().1, read);
        }
    }

    #[test]
    fn fields_are_columns_by_their_names_and_rows_of_numbers_a_column_for_each_entry() {
        let header =
            "{'descr': [('t', '<f8'), ('element.path', '<f8', (2,))], 'fortran_order': False, 'shape': (2,), }\n";
        let data = [0.0, 1.0, 2.0, 0.5, 3.0, 4.0].map(f64::to_le_bytes).concat();
        let (names, read) = columns(&npy_bytes(header, &data)).unwrap();
        assert_eq!(names, ["t", "element[1].path", "element[2].path"]);
        assert_eq!(read, [[0.0, 0.5], [1.0, 3.0], [2.0, 4.0]]);
        let header = r#"{"shape": (1,), 'fortran_order': False,
            'descr': [('it\'s (m, [1])', '|i1'), ('', '|V2'), ("b, c", '>u2')]}"#;
        let (names, read) = columns(&npy_bytes(header, &[0xff, 9, 9, 1, 2])).unwrap();
        assert_eq!((names, read), (vec!["it's (m, [1])".to_owned(), "b, c".to_owned()], vec![vec![-1.0], vec![258.0]]));
    }

    #[test]
    fn broken_npy_files_are_refused_and_never_panic() {
        let good = npy_bytes("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n", &[0; 16]);
        assert!(columns(&good).is_ok());
        for len in 0..good.len() {
            assert!(columns(&good[..len]).is_err(), "{len} bytes");
        }
        let refused = |header: &str| columns(&npy_bytes(header, &[0; 16])).unwrap_err();
        assert!(refused("{'descr': '|O', 'fortran_order': False, 'shape': (2,), }").contains("|O"));
        assert!(
            refused("{'descr': [('a', '<f8', (3, 2))], 'fortran_order': False, 'shape': (7,)}").contains("neither")
        );
        assert!(refused("{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}").contains("header"));
        // Deeper than any header is nested: neither a crash nor an accepted file.
        assert!(refused(&"(".repeat(60_000)).contains("header"));
    }

    #[test]
    fn an_archive_gives_its_arrays_and_single_numbers_by_name_and_leaves_text_out() {
        let mut bytes = Cursor::new(Vec::new());
        let mut archive = zip::ZipWriter::new(&mut bytes);
        let head = |shape: &str| format!("{{'descr': '|u1', 'fortran_order': False, 'shape': {shape}, }}\n");
        for (name, shape, data) in
            [("de.npy", "(3,)", &[1u8, 2, 3][..]), ("rpm.npy", "()", &[9]), ("two.npy", "(3, 2)", &[1, 2, 3, 4, 5, 6])]
        {
            archive.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
            std::io::Write::write_all(&mut archive, &npy_bytes(&head(shape), data)).unwrap();
        }
        archive.start_file("unit.npy", zip::write::SimpleFileOptions::default()).unwrap();
        let text = npy_bytes("{'descr': '<U1', 'fortran_order': False, 'shape': (), }\n", b"g\0\0\0");
        std::io::Write::write_all(&mut archive, &text).unwrap();
        archive.finish().unwrap();
        let Contents { names, columns, numbers, .. } = super::archive(bytes.get_ref()).unwrap();
        assert_eq!(names, ["de", "two[1]", "two[2]"]);
        assert_eq!(columns, [[1.0, 2.0, 3.0], [1.0, 3.0, 5.0], [2.0, 4.0, 6.0]]);
        assert_eq!(numbers, [("rpm".to_owned(), 9.0)]);
    }
}
