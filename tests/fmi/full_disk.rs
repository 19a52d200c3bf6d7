//! A disk that is full during a recording costs samples and is told; it costs no instance.
//!
//! The disk is played by the system's limit to the length of a file, beyond which writing fails as it does on a full
//! disk: what still fits is written. The limit is the whole program's, so there is one test only. `unsafe` is what a C
//! interface takes.
#![cfg(unix)]
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

#[path = "fmi2/host.rs"]
#[allow(dead_code)]
mod two;

use brinell_fmi::fmi2::*;
use std::path::{Path, PathBuf};
use std::{env, fs};
use two::{Host, Line, Resources};

/// Sets the longest that a file may become (bytes).
fn room(bytes: libc::rlim_t) {
    // SAFETY: plain numbers; the signal that would end the program is ignored, so that writing fails instead.
    unsafe {
        libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
        let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
        assert_eq!(libc::getrlimit(libc::RLIMIT_FSIZE, &raw mut limit), 0);
        limit.rlim_cur = bytes.min(limit.rlim_max);
        assert_eq!(libc::setrlimit(libc::RLIMIT_FSIZE, &raw const limit), 0);
    }
}

/// A healthy bearing that is about to record, at its first communication point.
fn recording(name: &str, folder: &Path, logging: bool) -> Host {
    let recorder = |text: String| text + "\n[recorder]\nrate_hz = 51200.0\n";
    let host = Host::with(Resources::edited("6205-healthy", "resources", recorder), name, logging);
    begin(&host, folder);
    host
}

fn begin(host: &Host, folder: &Path) {
    assert_eq!(host.set_text(host.reference("recorder.folder"), folder.to_str().unwrap()), Status::Ok);
    host.start();
    host.lines();
}

fn run(host: &Host, from: f64, steps: u32) -> Status {
    let status = (0..steps).map(|n| host.step(from + f64::from(n) * 1e-3, 1e-3));
    status.max().unwrap()
}

/// Times of a recording, by its header, and how many bytes the file has beyond them.
fn times(file: &Path) -> (Vec<f64>, usize) {
    let bytes = fs::read(file).unwrap();
    let length = 12 + u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
    let header = std::str::from_utf8(&bytes[12..length]).unwrap();
    let rows: usize = header.split("'shape': (").nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
    let width = header.matches("'<f8'").count();
    let value = |row: usize| f64::from_le_bytes(bytes[length + 8 * row * width..][..8].try_into().unwrap());
    ((0..rows).map(value).collect(), bytes.len() - length - 8 * rows * width)
}

fn told(lines: &[Line], file: &Path, words: &[&str]) {
    let line = lines.iter().find(|line| line.message.contains("recording ")).unwrap_or_else(|| panic!("{lines:?}"));
    for word in [&["samples", "from 0", "s to 0", file.to_str().unwrap()], words].concat() {
        assert!(line.message.contains(word), "{word}: {line:?}");
    }
}

#[test]
fn a_full_disk_costs_samples_that_are_told_and_no_instance() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("full-disk-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let unlimited = libc::RLIM_INFINITY;
    let file = folder.join("bearing.npy");

    // Some rows are stored, and then the disk is full.
    let host = recording("bearing", &folder, true);
    assert_eq!(run(&host, 0.0, 40), Status::Ok);
    let (stored, beyond) = times(&file);
    assert!(stored.len() > 1000 && beyond == 0);
    room(fs::metadata(&file).unwrap().len() + 50_000);
    assert_eq!(host.terminate(), Status::Warning, "a result may still be read: {:?}", host.lines());
    told(&host.lines(), &file, &["fmi2Terminate", "large"]);
    assert!(host.get(&[host.reference("shaft.y")]).is_ok());
    assert_eq!(times(&file), (stored.clone(), 0), "the file holds what it held");
    assert_eq!(host.reset(), Status::Warning, "{:?}", host.lines());
    told(&host.lines(), &file, &["fmi2Reset", "lost"]);
    assert_eq!(times(&file), (stored, 0));

    // The instance is usable at once, and records when there is room again.
    begin(&host, &folder);
    assert_eq!(run(&host, 0.0, 80), Status::Error, "writing fails in a step");
    assert_eq!(host.reset(), Status::Warning, "{:?}", host.lines());
    begin(&host, &folder);
    assert_eq!(run(&host, 0.0, 20), Status::Ok);
    let state = host.save();
    assert_eq!(run(&host, 20e-3, 60), Status::Error);
    assert_eq!(host.restore(state), Status::Ok);
    room(unlimited);
    assert_eq!(run(&host, 20e-3, 60), Status::Ok, "{:?}", host.lines());
    assert_eq!(host.terminate(), Status::Ok);
    let (all, beyond) = times(&file);
    assert_eq!((all.len(), beyond), (4096 - 15, 0));
    assert!(
        all.windows(2).all(|pair| (pair[1] - pair[0] - 1.0 / 51_200.0).abs() < 1e-12),
        "no row twice, none missing"
    );
    drop(host);

    // The last chance, and nobody listens but the one who must.
    let host = recording("bearing", &folder, false);
    assert_eq!(run(&host, 0.0, 10), Status::Ok);
    room(1000);
    // SAFETY: any handle may be passed.
    unsafe { fmi2FreeInstance(host.c) };
    told(&host.lines(), &file, &["fmi2FreeInstance", "lost"]);
    room(unlimited);
    drop(recording("bearing", &folder, true));
    drop(host);
    fs::remove_dir_all(folder).unwrap();
}
