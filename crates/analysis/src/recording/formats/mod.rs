//! Files as columns of numbers, single numbers and, where the format has a place for it, their rate.
//!
//! The ending says what a file is. Where it says nothing, the first bytes do, and what has no zero byte is a text. WAV
//! goes through `hound`.

mod array;
pub(crate) mod csv;
mod hdf5;
mod lvm;
mod mat;
mod npy;

pub use csv::TextFormat;

pub(super) use array::Contents;

/// How files that are read end, but for texts of any other name.
pub const ENDINGS: [&str; 8] = ["csv", "tsv", "txt", "lvm", "npy", "npz", "mat", "wav"];
const READ: &str = ".csv, .tsv, .txt, .lvm, .npy, .npz, .mat or .wav, or texts of any other name";

/// What a file of these bytes holds, whose name ends so.
///
/// # Errors
/// Bytes that are not what the ending says.
pub(super) fn contents(ending: &str, bytes: &[u8], text: TextFormat) -> Result<Contents, String> {
    match ending {
        "npy" => npy::columns(bytes).map(Contents::from),
        "npz" => npy::archive(bytes),
        "mat" => matlab(bytes),
        "wav" => wav(bytes),
        "tdms" => Err("TDMS is not read; in Python npTDMS converts a channel: numpy.save('a.npy', \
                       nptdms.TdmsFile.read('a.tdms')['GROUP']['CHANNEL'][:])"
            .to_owned()),
        "csv" | "tsv" | "txt" | "lvm" => written(bytes, ending, text),
        _ => unnamed(bytes, ending, text),
    }
}

/// A text, by its ending or by LabVIEW's first line.
fn written(bytes: &[u8], ending: &str, format: TextFormat) -> Result<Contents, String> {
    let text = String::from_utf8_lossy(bytes);
    if lvm::is(&text) { lvm::contents(&text, format) } else { csv::columns(&text, ending, format).map(Contents::from) }
}

/// A file whose ending says nothing.
fn unnamed(bytes: &[u8], ending: &str, format: TextFormat) -> Result<Contents, String> {
    if bytes.starts_with(b"\x93NUMPY") {
        npy::columns(bytes).map(Contents::from)
    } else if bytes.starts_with(b"RIFF") {
        wav(bytes)
    } else if bytes.starts_with(b"MATLAB 5.0") || hdf5::is(bytes) {
        matlab(bytes)
    } else if bytes.contains(&0) {
        Err(format!("ending '{ending}', and no text: recordings are {READ}"))
    } else {
        written(bytes, ending, format)
    }
}

fn matlab(bytes: &[u8]) -> Result<Contents, String> {
    if hdf5::is(bytes) { hdf5::contents(bytes) } else { mat::contents(bytes) }
}

fn wav(bytes: &[u8]) -> Result<Contents, String> {
    let mut reader = hound::WavReader::new(bytes).map_err(|e| e.to_string())?;
    let spec = reader.spec();
    let samples: Result<Vec<f64>, _> = match spec.sample_format {
        hound::SampleFormat::Float => reader.samples::<f32>().map(|s| s.map(f64::from)).collect(),
        hound::SampleFormat::Int => reader.samples::<i32>().map(|s| s.map(f64::from)).collect(),
    };
    let columns = array::deinterleaved(&samples.map_err(|e| e.to_string())?, spec.channels as usize);
    Ok(Contents { columns, rate: Some(f64::from(spec.sample_rate)), ..Contents::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wav_gives_channels_and_rate() {
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
        let bytes = bytes.into_inner();
        let read = wav(&bytes).unwrap();
        assert_eq!((&read.columns[..], read.rate), (&[vec![1.0, -2.0], vec![7.0, 8.0]][..], Some(48_000.0)));
        // Without an ending it is one as well.
        assert_eq!(contents("", &bytes, TextFormat::default()).unwrap(), read);
    }

    #[test]
    fn a_file_without_a_telling_name_is_what_its_first_bytes_say() {
        let plain = TextFormat::default();
        for ending in ["", "39", "dat", "asc"] {
            let columns = contents(ending, b"0.5 1\n1.5\t2\n2.5 3\n", plain).unwrap().columns;
            assert_eq!(columns, [[0.5, 1.5, 2.5], [1.0, 2.0, 3.0]]);
            let labview = "LabVIEW Measurement\nDelta_X\t0.5\n***End_of_Header***\nX_Value\tacc\n0\t7\n";
            assert_eq!(contents(ending, labview.as_bytes(), plain).unwrap().rate, Some(2.0));
            let refused = contents(ending, b"\x7fELF\0\0\0", plain).unwrap_err();
            assert!(refused.contains(&format!("ending '{ending}', and no text")), "{refused}");
        }
    }
}
