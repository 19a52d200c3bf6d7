//! NumPy's `.npy` files. Numbers of one or two dimensions are read, in C or Fortran order, and arrays of one dimension
//! with named fields, each a number or a row of numbers, as the recorder of an FMU writes them. Of two dimensions the
//! shorter one counts channels.

use super::interleaving::deinterleaved;
use super::npy_header::{Field, Header};

/// Names, empty where there are none, and the columns.
type Columns = (Vec<String>, Vec<Vec<f64>>);

/// How a number is stored.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kind {
    /// `f`, `i` or `u`.
    letter: char,
    big_endian: bool,
    /// Bytes.
    size: usize,
}

/// The file's channels.
pub(crate) fn columns(bytes: &[u8]) -> Result<Columns, String> {
    let short = || "the file ends inside its header".to_owned();
    if bytes.get(..6) != Some(b"\x93NUMPY".as_slice()) {
        return Err("not a .npy file: the magic string is missing".to_owned());
    }
    let (start, length) = match bytes.get(6).ok_or_else(short)? {
        1 => (10, bytes.get(8..10).map(|b| u16::from_le_bytes([b[0], b[1]]) as usize)),
        _ => (12, bytes.get(8..12).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize)),
    };
    let end = start + length.ok_or_else(short)?;
    let header = Header::parse(&String::from_utf8_lossy(bytes.get(start..end).ok_or_else(short)?))?;
    let bytes_of = |field: &Field| Ok::<_, String>(size(&field.kind)? * field.count.unwrap_or(1));
    let row: usize = header.fields.iter().map(bytes_of).sum::<Result<_, _>>()?;
    let needed = header.shape.iter().try_fold(row, |product, &n| product.checked_mul(n));
    let data = &bytes[end..];
    if needed != Some(data.len()) {
        let shape = &header.shape;
        return Err(format!(
            "{} bytes of numbers, the shape {shape:?} of {row} bytes each needs another number",
            data.len()
        ));
    }
    if header.structured { fields(&header, row, data) } else { Ok((Vec::new(), channels(&header, data)?)) }
}

/// Columns of an array with fields.
fn fields(header: &Header, row: usize, data: &[u8]) -> Result<Columns, String> {
    if header.shape.len() != 1 {
        return Err(format!("{} dimensions of named fields: 1 is read", header.shape.len()));
    }
    let (mut names, mut columns, mut at) = (Vec::new(), Vec::new(), 0);
    for field in &header.fields {
        let size = size(&field.kind)?;
        for name in field.names() {
            let from = at;
            at += size;
            // Bytes that fill a row up have no type.
            if !field.kind.contains('V') {
                let kind = Kind::parse(&field.kind).map_err(|why| format!("field '{}': {why}", field.name))?;
                names.push(name);
                columns.push(data.chunks_exact(row.max(1)).map(|row| kind.value(&row[from..at])).collect());
            }
        }
    }
    Ok((names, columns))
}

/// Channels of a plain array.
fn channels(header: &Header, data: &[u8]) -> Result<Vec<Vec<f64>>, String> {
    let kind = Kind::parse(&header.fields[0].kind)?;
    let values: Vec<f64> = data.chunks_exact(kind.size).map(|bytes| kind.value(bytes)).collect();
    let (rows, width) = match header.shape[..] {
        [rows] => (rows, 1),
        [rows, columns] if columns <= rows => (rows, columns),
        // One row per channel: the same as the other order with the roles changed.
        [rows, columns] => (columns, rows),
        _ => return Err(format!("{} dimensions: 1 or 2 are read", header.shape.len())),
    };
    let transposed = header.shape.len() == 2 && header.shape[0] != rows;
    if header.fortran != transposed {
        return Ok(values.chunks(rows.max(1)).map(<[f64]>::to_vec).collect());
    }
    Ok(deinterleaved(&values, width))
}

/// Bytes of a type.
fn size(kind: &str) -> Result<usize, String> {
    let digits = kind.trim_start_matches(['<', '>', '|', '=']).get(1..).unwrap_or_default();
    let size = digits.parse().ok().filter(|&size: &usize| (1..=LARGEST).contains(&size));
    size.ok_or_else(|| format!("element type {kind}: {READ}"))
}

/// Most bytes of an element: those that fill up a row of C's.
const LARGEST: usize = 1 << 16;
const READ: &str = "floats of 4 or 8 bytes and integers of 1 to 8 are read";

impl Kind {
    fn parse(text: &str) -> Result<Self, String> {
        let refuse = || format!("element type {text}: {READ}");
        let size = size(text)?;
        let mut characters = text.chars();
        let (order, letter) = (characters.next().ok_or_else(refuse)?, characters.next().ok_or_else(refuse)?);
        let sizes: &[usize] = match letter {
            'f' => &[4, 8],
            'i' | 'u' => &[1, 2, 4, 8],
            _ => &[],
        };
        let ordered = matches!(order, '<' | '>') || (order == '|' && size == 1);
        if ordered && sizes.contains(&size) {
            Ok(Self { letter, big_endian: order == '>', size })
        } else {
            Err(refuse())
        }
    }

    fn value(self, bytes: &[u8]) -> f64 {
        let mut little = [0; 8];
        for (i, to) in little.iter_mut().take(self.size).enumerate() {
            *to = bytes[if self.big_endian { self.size - 1 - i } else { i }];
        }
        let bits = u64::from_le_bytes(little);
        // The sign's bit is shifted to the top and back.
        let unused = 64 - 8 * self.size as u32;
        match (self.letter, self.size) {
            ('f', 4) => f64::from(f32::from_bits(bits as u32)),
            ('f', _) => f64::from_bits(bits),
            ('i', _) => ((bits << unused) as i64 >> unused) as f64,
            _ => bits as f64,
        }
    }
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
            let found = columns(&npy_bytes(&header, &values.map(f32::to_le_bytes).concat())).unwrap().1;
            assert_eq!(found, [[1.0, 2.0, 3.0], [10.0, 20.0, 30.0]]);
        }
    }

    #[test]
    fn a_field_that_is_an_array_is_a_column_for_each_entry() {
        let header =
            "{'descr': [('t', '<f8'), ('element.path', '<f8', (2,))], 'fortran_order': False, 'shape': (2,), }\n";
        let data = [0.0, 1.0, 2.0, 0.5, 3.0, 4.0].map(f64::to_le_bytes).concat();
        let (names, found) = columns(&npy_bytes(header, &data)).unwrap();
        assert_eq!(names, ["t", "element[1].path", "element[2].path"]);
        assert_eq!(found, [[0.0, 0.5], [1.0, 3.0], [2.0, 4.0]]);
    }

    #[test]
    fn broken_npy_files_are_refused_and_never_panic() {
        let good = npy_bytes("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n", &[0; 16]);
        assert!(columns(&good).is_ok());
        for len in 0..good.len() {
            assert!(columns(&good[..len]).is_err(), "{len} bytes");
        }
        let strange = npy_bytes("{'descr': '|O', 'fortran_order': False, 'shape': (2,), }\n", &[0; 16]);
        assert!(columns(&strange).is_err_and(|e| e.contains("|O")));
    }
}
