//! NumPy's `.npy` files. The header is one line of Python literal of which three entries matter; reals and integers of one or
//! two dimensions are read, in C or Fortran order. Of two dimensions the shorter one counts channels.

use super::recording_file::deinterleaved;

/// The file's channels.
pub(super) fn columns(bytes: &[u8]) -> Result<Vec<Vec<f64>>, String> {
    let short = || "the file ends inside its header".to_owned();
    if bytes.get(..6) != Some(b"\x93NUMPY".as_slice()) {
        return Err("not a .npy file: the magic string is missing".to_owned());
    }
    let (start, length) = match bytes.get(6).ok_or_else(short)? {
        1 => (10, bytes.get(8..10).map(|b| u16::from_le_bytes([b[0], b[1]]) as usize)),
        _ => (12, bytes.get(8..12).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize)),
    };
    let end = start + length.ok_or_else(short)?;
    let header = String::from_utf8_lossy(bytes.get(start..end).ok_or_else(short)?).replace(' ', "");
    let kind = between(&header, "'descr':'", "'").ok_or("structured arrays are not read")?;
    let fortran = header.contains("'fortran_order':True");
    let shape: Vec<usize> = between(&header, "'shape':(", ")")
        .ok_or("no shape in the header")?
        .split(',')
        .filter(|n| !n.is_empty())
        .map(|n| n.parse().map_err(|_| format!("shape {n} is not a number")))
        .collect::<Result<_, _>>()?;
    let values = npy_values(kind, &bytes[end..])?;
    let (rows, width) = match shape[..] {
        [rows] => (rows, 1),
        [rows, columns] if columns <= rows => (rows, columns),
        // One row per channel: the same as the other order with the roles changed.
        [rows, columns] => (columns, rows),
        _ => return Err(format!("{} dimensions: 1 or 2 are read", shape.len())),
    };
    if rows.checked_mul(width) != Some(values.len()) {
        return Err(format!("{} values, the shape {shape:?} needs another number", values.len()));
    }
    let transposed = shape.len() == 2 && shape[0] != rows;
    if fortran != transposed {
        return Ok(values.chunks(rows.max(1)).map(<[f64]>::to_vec).collect());
    }
    Ok(deinterleaved(&values, width))
}

fn npy_values(kind: &str, data: &[u8]) -> Result<Vec<f64>, String> {
    fn each<const N: usize>(data: &[u8], value: fn([u8; N]) -> f64) -> Vec<f64> {
        data.as_chunks::<N>().0.iter().map(|&bytes| value(bytes)).collect()
    }
    Ok(match kind {
        "<f4" => each(data, |b| f64::from(f32::from_le_bytes(b))),
        "<f8" => each(data, f64::from_le_bytes),
        "<i2" => each(data, |b| f64::from(i16::from_le_bytes(b))),
        "<i4" => each(data, |b| f64::from(i32::from_le_bytes(b))),
        ">f4" => each(data, |b| f64::from(f32::from_be_bytes(b))),
        ">f8" => each(data, f64::from_be_bytes),
        _ => return Err(format!("element type {kind}: <f4, <f8, >f4, >f8, <i2 and <i4 are read")),
    })
}

fn between<'a>(text: &'a str, before: &str, after: &str) -> Option<&'a str> {
    let rest = &text[text.find(before)? + before.len()..];
    Some(&rest[..rest.find(after)?])
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
        assert_eq!(columns(&vector).unwrap(), [[1.0, -2.0, 3.0]]);
        for (order, values) in
            [("False", [1.0f32, 10.0, 2.0, 20.0, 3.0, 30.0]), ("True", [1.0, 2.0, 3.0, 10.0, 20.0, 30.0])]
        {
            let header = format!("{{'descr': '<f4', 'fortran_order': {order}, 'shape': (3, 2), }}\n");
            let found = columns(&npy_bytes(&header, &values.map(f32::to_le_bytes).concat())).unwrap();
            assert_eq!(found, [[1.0, 2.0, 3.0], [10.0, 20.0, 30.0]]);
        }
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
