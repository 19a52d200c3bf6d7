//! The file formats of recordings: CSV, NumPy's `.npy` and WAV.
//!
//! `.npy` is read here because its header is one line of Python literal of which three entries matter; little-endian reals
//! and integers of one or two dimensions, in C or Fortran order. WAV goes through `hound`.

use super::error::SizingError;
use std::path::Path;

/// What a file holds.
pub(super) struct Columns {
    pub(super) signal: Vec<f64>,
    pub(super) tachometer: Option<Vec<f64>>,
    /// Sampling rate [Hz], where the file states it.
    pub(super) rate: Option<f64>,
}

pub(super) fn read(path: &Path) -> Result<Columns, SizingError> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let refuse = |why: String| SizingError::Format { path: path.to_owned(), why };
    let bytes = || std::fs::read(path).map_err(|source| SizingError::File { path: path.to_owned(), source });
    match ending.as_str() {
        "csv" => csv(&String::from_utf8_lossy(&bytes()?)).map_err(refuse),
        "npy" => npy(&bytes()?).map_err(refuse),
        "wav" => wav(&bytes()?).map_err(refuse),
        _ => Err(refuse(format!("ending '{ending}': recordings are .csv, .npy or .wav"))),
    }
}

fn csv(text: &str) -> Result<Columns, String> {
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim_start_matches('\u{feff}').trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
        .peekable();
    let Some(&(_, first)) = lines.peek() else { return Err("no line of numbers".to_owned()) };
    let cells: Vec<&str> = first.split(',').map(str::trim).collect();
    let width = cells.len();
    let named = cells.iter().any(|cell| cell.parse::<f64>().is_err());
    let (signal, tachometer, time) = if named {
        lines.next();
        let begins = |with: &str| cells.iter().position(|cell| cell.to_ascii_lowercase().starts_with(with));
        let signal = begins("sensor.acceleration").or_else(|| begins("acceleration"));
        let signal = signal.or((width == 1).then_some(0));
        let signal = signal.ok_or_else(|| format!("columns {first}: none begins with acceleration"))?;
        (signal, begins("tach"), begins("time"))
    } else {
        (0, (width > 1).then_some(1), None)
    };
    let mut columns = vec![Vec::new(); width];
    for (number, line) in lines {
        let mut count = 0;
        for (column, cell) in columns.iter_mut().zip(line.split(',')) {
            let cell = cell.trim();
            column.push(cell.parse::<f64>().map_err(|_| format!("line {number}: '{cell}' is not a number"))?);
            count += 1;
        }
        if count != width {
            return Err(format!("line {number}: {count} columns, the first line has {width}"));
        }
    }
    let rate = time.and_then(|time| rate_of(&columns[time]));
    let tachometer = tachometer.map(|column| columns[column].clone());
    Ok(Columns { signal: columns.swap_remove(signal), tachometer, rate })
}

fn rate_of(time: &[f64]) -> Option<f64> {
    let span = time.last()? - time.first()?;
    let rate = (time.len() - 1) as f64 / span;
    (rate.is_finite() && rate > 0.0).then_some(rate)
}

fn wav(bytes: &[u8]) -> Result<Columns, String> {
    let mut reader = hound::WavReader::new(bytes).map_err(|e| e.to_string())?;
    let spec = reader.spec();
    let samples: Result<Vec<f64>, _> = match spec.sample_format {
        hound::SampleFormat::Float => reader.samples::<f32>().map(|s| s.map(f64::from)).collect(),
        hound::SampleFormat::Int => reader.samples::<i32>().map(|s| s.map(f64::from)).collect(),
    };
    let samples = samples.map_err(|e| e.to_string())?;
    let columns = interleaved(&samples, spec.channels as usize);
    Ok(Columns { rate: Some(f64::from(spec.sample_rate)), ..columns })
}

fn npy(bytes: &[u8]) -> Result<Columns, String> {
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
        let mut columns = values.chunks(rows.max(1)).map(<[f64]>::to_vec);
        return Ok(Columns { signal: columns.next().unwrap_or_default(), tachometer: columns.next(), rate: None });
    }
    Ok(interleaved(&values, width))
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
        _ => return Err(format!("element type {kind}: <f4, <f8, <i2 and <i4 are read")),
    })
}

fn between<'a>(text: &'a str, before: &str, after: &str) -> Option<&'a str> {
    let rest = &text[text.find(before)? + before.len()..];
    Some(&rest[..rest.find(after)?])
}

fn interleaved(samples: &[f64], channels: usize) -> Columns {
    let channel = |k: usize| samples.iter().skip(k).step_by(channels.max(1)).copied().collect::<Vec<_>>();
    Columns { signal: channel(0), tachometer: (channels > 1).then(|| channel(1)), rate: None }
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
        assert_eq!(npy(&vector).unwrap().signal, [1.0, -2.0, 3.0]);
        for (order, values) in
            [("False", [1.0f32, 10.0, 2.0, 20.0, 3.0, 30.0]), ("True", [1.0, 2.0, 3.0, 10.0, 20.0, 30.0])]
        {
            let header = format!("{{'descr': '<f4', 'fortran_order': {order}, 'shape': (3, 2), }}\n");
            let columns = npy(&npy_bytes(&header, &values.map(f32::to_le_bytes).concat())).unwrap();
            assert_eq!(columns.signal, [1.0, 2.0, 3.0]);
            assert_eq!(columns.tachometer.unwrap(), [10.0, 20.0, 30.0]);
        }
    }

    #[test]
    fn broken_npy_files_are_refused_and_never_panic() {
        let good = npy_bytes("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n", &[0; 16]);
        assert!(npy(&good).is_ok());
        for len in 0..good.len() {
            assert!(npy(&good[..len]).is_err(), "{len} bytes");
        }
        let strange = npy_bytes("{'descr': '|O', 'fortran_order': False, 'shape': (2,), }\n", &[0; 16]);
        assert!(npy(&strange).is_err_and(|e| e.contains("|O")));
    }

    #[test]
    fn csv_columns_are_found_by_name_and_time_gives_the_rate() {
        let text = "# made\ntime,cage.angle,sensor.acceleration,tacho\n0.0,9,1,0\n0.5,9,2,5\n1.0,9,3,0\n";
        let columns = csv(text).unwrap();
        assert_eq!((columns.signal, columns.rate), (vec![1.0, 2.0, 3.0], Some(2.0)));
        assert_eq!(columns.tachometer.unwrap(), [0.0, 5.0, 0.0]);
        assert_eq!(csv("1.5\n2.5\n").unwrap().signal, [1.5, 2.5]);
        assert!(csv("a,b\n1,2\n").is_err_and(|e| e.contains("acceleration")));
        assert!(csv("1\n2\nx\n").is_err_and(|e| e.contains("line 3")));
        assert!(csv("").is_err());
    }

    #[test]
    fn wav_gives_signal_tachometer_and_rate() {
        let spec = hound::WavSpec {
            channels: 2,
            sample_rate: 48_000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut writer = hound::WavWriter::new(&mut bytes, spec).unwrap();
        for sample in [1i16, 7, -2, 8] {
            writer.write_sample(sample).unwrap();
        }
        writer.finalize().unwrap();
        let columns = wav(bytes.get_ref()).unwrap();
        assert_eq!((columns.signal, columns.rate), (vec![1.0, -2.0], Some(48_000.0)));
        assert_eq!(columns.tachometer.unwrap(), [7.0, 8.0]);
    }
}
