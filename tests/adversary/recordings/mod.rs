//! Hostile recordings: holes of any length anywhere, clocks that stutter, numbers that can be read in two ways,
//! signals that saturate, files cut short. `size` refuses them, says that nothing is resolved, or gives the length of
//! the whole recording.

mod clocks;
mod files;
mod foreign;
#[path = "../../support/machine.rs"]
mod machine;
mod matlab;
mod public;
mod signals;

use brinell_analysis::recording::{Recording, Source, Speed, TextFormat};
use brinell_analysis::sizing::{Report, size};
use brinell_analysis::statistics::Random;
use machine::{RATE, scene};
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Speed of the shaft (Hz).
const SPEED: f64 = 20.0;
/// How long recordings of a whole machine are: 40 turns.
const SECONDS: f64 = 2.0;

/// Reads a file of these bytes; an error as what the user sees of it.
fn read_as(ending: &str, bytes: &[u8], rate: Option<f64>) -> Result<Recording, String> {
    read_with(ending, bytes, rate, TextFormat::default())
}

/// The same of a text whose numbers are written so.
fn read_with(ending: &str, bytes: &[u8], rate: Option<f64>, text: TextFormat) -> Result<Recording, String> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let name = format!("recording-{}-{}.{ending}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, bytes).unwrap();
    let source = Source { rate, speed: Speed::Constant(SPEED), signal: None, text };
    let read = Recording::read(&path, &source);
    std::fs::remove_file(&path).unwrap();
    read.map_err(|error| error.to_string())
}

/// Columns that are parted by semicolons.
const SEMICOLONS: TextFormat = TextFormat { delimiter: Some(';'), decimal: None };

fn read(text: &str) -> Result<Recording, String> {
    read_with("csv", text.as_bytes(), None, SEMICOLONS)
}

#[track_caller]
fn refused(read: Result<Recording, String>, parts: &[&str]) {
    let message = match read {
        Ok(recording) => panic!("accepted: {} samples at {} Hz", recording.samples().len(), recording.rate()),
        Err(message) => message,
    };
    for part in parts {
        assert!(message.contains(part), "'{part}' is missing in: {message}");
    }
}

/// Noise of half a second: enough for what is refused before anything is sized.
fn noise(count: usize) -> Vec<f64> {
    let mut random = Random::new(5);
    (0..count).map(|_| random.normal()).collect()
}

/// Two columns, the time as `print` writes it.
fn timed(heading: &str, times: impl Iterator<Item = f64>, samples: &[f64], print: &dyn Fn(f64) -> String) -> String {
    let mut text = heading.to_owned();
    for (time, sample) in times.zip(samples) {
        writeln!(text, "{};{sample:.6}", print(time)).unwrap();
    }
    text
}

/// Times of `count` samples at `rate`, of which those from `from` on come `hole` later.
fn times(rate: f64, count: usize, from: usize, hole: f64) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| i as f64 / rate + if i >= from { hole } else { 0.0 })
}

fn sized(recording: Recording) -> Report {
    size(&[recording], &scene()).unwrap()
}

/// Plain bytes of a `.npy` file of one row of doubles.
fn npy(samples: &[f64]) -> Vec<u8> {
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", samples.len());
    header += &" ".repeat((64 - (header.len() + 11) % 64) % 64);
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(samples.iter().flat_map(|x| x.to_le_bytes()));
    bytes
}

/// A `.wav` file of 16 bits and one channel.
fn wav(samples: &[f64], rate: u32) -> Vec<u8> {
    let data: Vec<u8> = samples.iter().flat_map(|&x| (x as i16).to_le_bytes()).collect();
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((36 + data.len() as u32).to_le_bytes());
    bytes.extend(b"WAVEfmt \x10\0\0\0\x01\0\x01\0");
    bytes.extend(rate.to_le_bytes());
    bytes.extend((2 * rate).to_le_bytes());
    bytes.extend(b"\x02\0\x10\0data");
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes
}
