//! MATLAB's files of versions 5 to 7 ([format][mat]): numeric arrays, also within structures and cells, which are named
//! by their path as in `bearing.gs` or `Y[7].Data`, and single numbers. Where a structure has a text `Name`, its arrays
//! are called so: `vibration_1 (Y[7].Data)`. Version 7.3 is HDF5 ([`hdf5`](super::hdf5)).
//!
//! A file is a header of 128 bytes and elements, each a tag (type, bytes) and data; an array is an element of elements:
//! flags, dimensions, name, numbers. Numbers may be stored in a smaller type than the array's.
//!
//! [mat]: https://www.mathworks.com/help/pdf_doc/matlab/matfile_format.pdf

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::array::{self, Contents, Kind, Number};

/// Types of elements.
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// Classes of arrays.
const CELL: u8 = 1;
const STRUCTURE: u8 = 2;
const TEXT: u8 = 4;
const NUMERIC: std::ops::RangeInclusive<u8> = 6..=15;

/// Deepest nesting of structures and cells: a hostile file must not exhaust the stack.
const DEEPEST: usize = 16;
/// Most bytes that a compressed element may have.
const LARGEST: u64 = 1 << 30;

/// What the file holds.
pub(super) fn contents(bytes: &[u8]) -> Result<Contents, String> {
    let big_endian = match bytes.get(126..128) {
        Some(b"IM") => false,
        Some(b"MI") => true,
        _ => return Err("not a MATLAB file of version 5 or later: save it with -v7".to_owned()),
    };
    let mut file = File { big_endian, contents: Contents::default() };
    let mut rest = &bytes[128..];
    while !rest.is_empty() {
        let (kind, data) = file.element(&mut rest)?;
        match kind {
            COMPRESSED => {
                let mut inside = Vec::new();
                ZlibDecoder::new(data).take(LARGEST).read_to_end(&mut inside).map_err(|why| why.to_string())?;
                let (kind, data) = file.element(&mut inside.as_slice())?;
                if kind == MATRIX {
                    file.matrix(data, "", 0)?;
                }
            }
            MATRIX => file.matrix(data, "", 0)?,
            _ => {}
        }
    }
    Ok(file.contents)
}

struct File {
    big_endian: bool,
    contents: Contents,
}

impl File {
    fn word(&self, bytes: &[u8], at: usize) -> Result<u32, String> {
        let four = bytes.get(at..).and_then(<[u8]>::first_chunk).ok_or_else(short)?;
        Ok(if self.big_endian { u32::from_be_bytes(*four) } else { u32::from_le_bytes(*four) })
    }

    fn words(&self, bytes: &[u8]) -> Result<Vec<usize>, String> {
        (0..bytes.len() / 4).map(|i| Ok(self.word(bytes, 4 * i)? as usize)).collect()
    }

    /// Type and data of the next element.
    fn element<'a>(&self, rest: &mut &'a [u8]) -> Result<(u32, &'a [u8]), String> {
        let tag = self.word(rest, 0)?;
        // Up to four bytes stand in the tag itself.
        let (kind, length, start) = match tag >> 16 {
            0 => (tag, self.word(rest, 4)? as usize, 8),
            length => (tag & 0xffff, length as usize, 4),
        };
        let data = rest.get(start..start + length).ok_or_else(short)?;
        let end = start + length;
        *rest = rest.get(if kind == COMPRESSED { end } else { end.next_multiple_of(8) }..).unwrap_or_default();
        Ok((kind, data))
    }

    /// Adds what an array holds; `path` is its name where it is part of another, and has none itself.
    fn matrix(&mut self, data: &[u8], path: &str, depth: usize) -> Result<(), String> {
        if data.is_empty() || depth > DEEPEST {
            return Ok(());
        }
        let Head { class, shape, name, mut rest } = self.head(data)?;
        let path = if path.is_empty() { &*String::from_utf8_lossy(name) } else { path };
        let count = shape.iter().try_fold(1usize, |product, &n| product.checked_mul(n)).ok_or_else(short)?;
        let entry = |index: usize| if count == 1 { path.to_owned() } else { format!("{path}[{}]", index + 1) };
        match class {
            STRUCTURE => {
                let (_, length) = self.element(&mut rest)?;
                let length = (self.word(length, 0)? as usize).max(1);
                let (_, names) = self.element(&mut rest)?;
                (0..count).try_for_each(|index| self.structure(&mut rest, names.chunks(length), &entry(index), depth))
            }
            CELL => (0..count).try_for_each(|index| self.part(&mut rest, &entry(index), depth)),
            class if NUMERIC.contains(&class) && count > 0 => {
                let (kind, data) = self.element(&mut rest)?;
                let values = self.number(kind)?.values(data);
                let channels = array::channels(&values, &shape, true).map_err(|why| format!("{path}: {why}"))?;
                self.contents.add(path, channels);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// What an array begins with, and what follows that.
    fn head<'a>(&self, data: &'a [u8]) -> Result<Head<'a>, String> {
        let mut rest = data;
        let (_, flags) = self.element(&mut rest)?;
        let class = self.word(flags, 0)? as u8;
        let (_, dimensions) = self.element(&mut rest)?;
        let shape = self.words(dimensions)?;
        let (_, name) = self.element(&mut rest)?;
        Ok(Head { class, shape, name, rest })
    }

    /// Adds the fields of one structure.
    fn structure<'f>(
        &mut self,
        rest: &mut &[u8],
        fields: impl Iterator<Item = &'f [u8]>,
        path: &str,
        depth: usize,
    ) -> Result<(), String> {
        let first = self.contents.names.len();
        let mut called = None;
        for field in fields {
            let field = String::from_utf8_lossy(field.split(|&byte| byte == 0).next().unwrap_or_default());
            if field.eq_ignore_ascii_case("name") {
                let mut part = *rest;
                called = self.text(self.element(&mut part)?)?;
            }
            self.part(rest, &format!("{path}.{field}"), depth)?;
        }
        if let Some(name) = called {
            self.contents.call(first, path, &name);
        }
        Ok(())
    }

    /// The text in an array of characters; none in other arrays, nor where there is nothing to read.
    fn text(&self, (kind, data): (u32, &[u8])) -> Result<Option<String>, String> {
        if kind != MATRIX || data.is_empty() {
            return Ok(None);
        }
        let Head { class, mut rest, .. } = self.head(data)?;
        if class != TEXT {
            return Ok(None);
        }
        let (kind, data) = self.element(&mut rest)?;
        let text = match kind {
            // Characters of one byte, and UTF-8.
            1 | 2 | 16 => String::from_utf8_lossy(data).into_owned(),
            // Of two bytes, and UTF-16.
            4 | 17 => {
                let pair = |two: &[u8]| if self.big_endian { [two[0], two[1]] } else { [two[1], two[0]] };
                let units: Vec<u16> = data.chunks_exact(2).map(|two| u16::from_be_bytes(pair(two))).collect();
                String::from_utf16_lossy(&units)
            }
            _ => String::new(),
        };
        Ok(Some(text.trim().to_owned()).filter(|text| !text.is_empty()))
    }

    /// A field or a cell.
    fn part(&mut self, rest: &mut &[u8], path: &str, depth: usize) -> Result<(), String> {
        let (kind, data) = self.element(rest)?;
        if kind == MATRIX { self.matrix(data, path, depth + 1) } else { Ok(()) }
    }

    fn number(&self, kind: u32) -> Result<Number, String> {
        let (kind, size) = match kind {
            1 => (Kind::Signed, 1),
            2 => (Kind::Unsigned, 1),
            3 => (Kind::Signed, 2),
            4 => (Kind::Unsigned, 2),
            5 => (Kind::Signed, 4),
            6 => (Kind::Unsigned, 4),
            7 => (Kind::Float, 4),
            9 => (Kind::Float, 8),
            12 => (Kind::Signed, 8),
            13 => (Kind::Unsigned, 8),
            other => return Err(format!("numbers of type {other} are not read")),
        };
        Number::new(kind, size, self.big_endian, "")
    }
}

/// What an array begins with.
struct Head<'a> {
    class: u8,
    shape: Vec<usize>,
    name: &'a [u8],
    rest: &'a [u8],
}

fn short() -> String {
    "the file ends inside an array".to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    /// An element: type and data, filled up to 8 bytes, in this order of bytes.
    fn element(big: bool, kind: u32, data: &[u8]) -> Vec<u8> {
        let word = |n: u32| if big { n.to_be_bytes() } else { n.to_le_bytes() };
        let fill = vec![0; data.len().next_multiple_of(8) - data.len()];
        [&word(kind), &word(data.len() as u32), data, &fill].concat()
    }

    fn words(big: bool, numbers: &[u32]) -> Vec<u8> {
        numbers.iter().flat_map(|n| if big { n.to_be_bytes() } else { n.to_le_bytes() }).collect()
    }

    /// An array of a class: head and what follows it.
    fn array(big: bool, class: u32, shape: [u32; 2], name: &str, rest: &[u8]) -> Vec<u8> {
        let parts = [
            element(big, 6, &words(big, &[class, 0])),
            element(big, 5, &words(big, &shape)),
            element(big, 1, name.as_bytes()),
            rest.to_vec(),
        ];
        element(big, MATRIX, &parts.concat())
    }

    fn doubles(big: bool, shape: [u32; 2], name: &str, values: &[f64]) -> Vec<u8> {
        let bytes: Vec<u8> = values.iter().flat_map(|x| if big { x.to_be_bytes() } else { x.to_le_bytes() }).collect();
        array(big, 6, shape, name, &element(big, 9, &bytes))
    }

    fn file(big: bool, elements: &[Vec<u8>]) -> Vec<u8> {
        let version: [u8; 4] = if big { *b"\x01\0MI" } else { *b"\0\x01IM" };
        [&[b' '; 124][..], &version, &elements.concat()].concat()
    }

    /// Two signals, the one with a speed beside it, of which numbers are stored in two bytes.
    fn two_signals(big: bool) -> Vec<u8> {
        let short: Vec<u8> =
            [1i16, -2, 3].into_iter().flat_map(|x| if big { x.to_be_bytes() } else { x.to_le_bytes() }).collect();
        file(
            big,
            &[
                doubles(big, [3, 1], "X097_DE_time", &[0.5, -0.25, 1.0]),
                doubles(big, [1, 1], "X097RPM", &[1796.0]),
                array(big, 6, [1, 3], "X097_FE_time", &element(big, 3, &short)),
            ],
        )
    }

    #[test]
    fn arrays_and_single_numbers_of_either_order_of_bytes_are_read() {
        for big in [false, true] {
            let Contents { names, columns, numbers, .. } = contents(&two_signals(big)).unwrap();
            assert_eq!(names, ["X097_DE_time", "X097_FE_time"]);
            assert_eq!(columns, [[0.5, -0.25, 1.0], [1.0, -2.0, 3.0]]);
            assert_eq!(numbers, [("X097RPM".to_owned(), 1796.0)]);
        }
    }

    #[test]
    fn compressed_arrays_and_those_in_structures_and_cells_have_their_path_as_a_name() {
        let parts = [
            fields(&["sr", "gs"]),
            doubles(false, [1, 1], "", &[48828.0]),
            doubles(false, [2, 2], "", &[1.0, 2.0, 3.0, 4.0]),
        ];
        let structure = array(false, 2, [1, 1], "bearing", &parts.concat());
        let cells = array(
            false,
            1,
            [1, 2],
            "c",
            &[element(false, MATRIX, &[]), doubles(false, [2, 1], "", &[7.0, 8.0])].concat(),
        );
        let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        packed.write_all(&structure).unwrap();
        let packed = packed.finish().unwrap();
        let compressed = [&words(false, &[COMPRESSED, packed.len() as u32])[..], &packed].concat();
        let Contents { names, columns, numbers, .. } = contents(&file(false, &[compressed, cells])).unwrap();
        assert_eq!(names, ["bearing.gs[1]", "bearing.gs[2]", "c[2]"]);
        assert_eq!(columns, [[1.0, 2.0], [3.0, 4.0], [7.0, 8.0]]);
        assert_eq!(numbers, [("bearing.sr".to_owned(), 48828.0)]);
    }

    /// Names of a structure's fields. The length of a name stands in the tag itself.
    fn fields(names: &[&str]) -> Vec<u8> {
        let bytes = names.iter().flat_map(|name| {
            let mut bytes = [0; 8];
            bytes[..name.len()].copy_from_slice(name.as_bytes());
            bytes
        });
        [words(false, &[4 << 16 | 5, 8]), element(false, 1, &bytes.collect::<Vec<u8>>())].concat()
    }

    #[test]
    fn arrays_are_called_by_the_name_beside_them_in_their_structure() {
        // As the data of Paderborn are: a structure of structures, each with its name before its numbers.
        let text =
            |kind: u32, text: &[u8], count: u32| array(false, TEXT.into(), [1, count], "", &element(false, kind, text));
        let utf16: Vec<u8> = "vibration_1".encode_utf16().flat_map(u16::to_le_bytes).collect();
        let channels = [
            fields(&["Name", "Raster", "Data"]),
            text(16, b"force", 5),
            text(16, b"Mech", 4),
            doubles(false, [1, 2], "", &[1.0, 2.0]),
            text(4, &utf16, 11),
            text(16, b"Host", 4),
            doubles(false, [1, 3], "", &[3.0, 4.0, 5.0]),
        ];
        let y = array(false, 2, [1, 2], "", &channels.concat());
        let whole = array(false, 2, [1, 1], "N15", &[fields(&["Y"]), y].concat());
        let whole = file(false, &[whole]);
        let Contents { names, columns, .. } = contents(&whole).unwrap();
        assert_eq!(names, ["force (N15.Y[1].Data)", "vibration_1 (N15.Y[2].Data)"]);
        assert_eq!(columns, [vec![1.0, 2.0], vec![3.0, 4.0, 5.0]]);
        // Two arrays beside one name keep theirs apart.
        let two = [
            fields(&["a", "name", "b"]),
            doubles(false, [1, 2], "", &[1.0, 2.0]),
            text(2, b"left", 4),
            doubles(false, [1, 2], "", &[3.0, 4.0]),
        ];
        let two = file(false, &[array(false, 2, [1, 1], "s", &two.concat())]);
        assert_eq!(contents(&two).unwrap().names, ["left.a (s.a)", "left.b (s.b)"]);
        for at in 0..whole.len() {
            let _ = contents(&whole[..at]);
            let mut bytes = whole.clone();
            bytes[at] ^= 0x83;
            let _ = contents(&bytes);
        }
    }

    #[test]
    fn a_file_cut_short_is_refused_or_ends_between_two_arrays_and_never_panics() {
        let whole = two_signals(false);
        for cut in 0..whole.len() {
            let read = contents(&whole[..cut]);
            assert!(read.is_err() || read.is_ok_and(|read| read.names.len() < 2), "{cut} bytes");
        }
        assert!(contents(b"MATLAB 4").is_err_and(|why| why.contains("-v7")));
    }

    #[test]
    fn changed_bytes_never_panic() {
        let whole = two_signals(false);
        for at in 120..whole.len() {
            for change in [1, 0x80, 0xff] {
                let mut bytes = whole.clone();
                bytes[at] ^= change;
                let _ = contents(&bytes);
            }
        }
    }
}
