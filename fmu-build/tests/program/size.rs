//! The command `size`, as a program: JSON alone on standard output, files beside it.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use std::f64::consts::TAU;

pub(super) const RATE: f64 = 51_200.0;

/// A healthy bearing: a shaft's harmonics and noise from a linear congruence.
pub(super) fn healthy(count: usize) -> Vec<f64> {
    let mut state = 1u32;
    (0..count)
        .map(|i| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (std::f64::consts::TAU * 30.0 * i as f64 / RATE).sin() + f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        })
        .collect()
}

pub(super) fn csv(folder: &Path, name: &str, columns: &[(&str, Vec<f64>)]) -> PathBuf {
    let mut text = columns.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(",") + "\n";
    for i in 0..columns[0].1.len() {
        let row: Vec<String> = columns.iter().map(|(_, column)| column[i].to_string()).collect();
        text += &(row.join(",") + "\n");
    }
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// A scene of the rig would be simulated, which takes half a minute.
fn size(folder: &Path, recording: &Path, more: &[&str]) -> Output {
    size_of(folder, recording, &[&["--bearing", "6205"], more].concat())
}

fn size_of(folder: &Path, recording: &Path, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_brinell"))
        .arg("size")
        .arg(recording)
        .args(["--no-figure", "-o"])
        .arg(folder.join("out"))
        .args(more)
        .output()
        .unwrap()
}

#[test]
fn the_answer_is_json_alone_and_holds_every_key_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let path = csv(folder.path(), "healthy.csv", &[("acceleration", healthy(60_000))]);
    let output = size(folder.path(), &path, &["--rate", "51200", "--speed", "10"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    for key in ["verdict", "length_mm", "length_deg", "uncertainty_mm", "kind", "bpfo_hz", "slip", "passages", "reason"]
    {
        assert!(report.get(key).is_some(), "{key}");
    }
    assert_eq!(report["verdict"], "unresolved");
    assert!(report["length_mm"].is_null() && report["length_deg"].is_null() && report["uncertainty_mm"].is_null());
    assert!(report["reason"].as_str().unwrap().contains("ball pass frequency"));
    // The averaged passage, not the recording itself.
    let text = std::fs::read_to_string(folder.path().join("out/healthy-size.csv")).unwrap();
    assert!(text.starts_with("angle [deg],signal [1],level [dB],low [1]\n"));
    assert!(folder.path().join("out/healthy-size.json").is_file());
}

#[test]
fn a_recordings_rate_is_said_in_six_digits_and_each_file_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    // Times as a recorder writes them: k / rate, whose mean step is no whole fraction of a second.
    let time = (0..60_000).map(|k| f64::from(k) / RATE).collect();
    let path = csv(folder.path(), "timed.csv", &[("time [s]", time), ("acceleration", healthy(60_000))]);
    let output = size(folder.path(), &path, &["--speed", "10"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("timed.csv: 1.172 s at 51.2 kHz, shaft 10.0000 Hz\n"), "{said}");
    for name in ["timed-size.csv", "timed-size.json"] {
        assert!(said.contains(&format!("{}\n", folder.path().join("out").join(name).display())), "{said}");
    }
}

#[test]
fn a_bearing_of_the_catalogue_and_rpm_are_enough_and_the_answer_is_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = csv(folder.path(), "two.csv", &[("left", healthy(60_000)), ("right", healthy(60_000))]);
    let with = |more: &[&str]| {
        let output = size_of(folder.path(), &path, &[&["--rate", "51200", "--speed", "600rpm"], more].concat());
        (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned(), output.stdout)
    };
    // Of two channels none is taken silently.
    let (done, said, _) = with(&["--bearing", "6205"]);
    assert!(!done && said.contains("columns left, right") && said.contains("--channel"), "{said}");
    let (done, said, answer) = with(&["--bearing", "6205", "--channel", "right"]);
    let page = folder.path().join("page.html");
    let (paged, _, _) = with(&["--bearing", "6205", "--channel", "right", "--report", page.to_str().unwrap()]);
    let text = std::fs::read_to_string(&page).unwrap();
    // The answer, the combs of three kinds, and four curves with the lines of the bearing.
    assert!(paged && text.contains("<h1>no fault found, no length</h1>") && text.contains("two.csv"), "{text:.400}");
    assert_eq!(text.matches("<polyline points=\"0.0,").count(), 4);
    assert!(["rolling element (2 BSF)", ">BPFO<", ">2 × BPFI<", ">shaft<"].iter().all(|part| text.contains(part)));
    assert!(done && said.contains("shaft 10.0000 Hz") && said.contains("a load of 350 N is assumed"), "{said}");
    assert!(said.contains("\nno fault found, no length: "), "{said}");
    let report: Value = serde_json::from_slice(&answer).unwrap();
    // 3.5848 times the shaft's speed, sought from 3 % below to 2 % above.
    assert!((34.7..36.7).contains(&report["bpfo_hz"].as_f64().unwrap()));
    let (done, said, _) = with(&["--bearing", "6205", "--load", "1200", "--channel", "2"]);
    assert!(done && !said.contains("assumed"), "{said}");
}

#[test]
fn the_speed_is_sought_in_the_shafts_own_lines() {
    let folder = tempfile::tempdir().unwrap();
    let turning = |i: usize| (1..=6).map(|k| (TAU * f64::from(k) * 17.3 * i as f64 / RATE).sin()).sum::<f64>();
    let signal = healthy(250_000).iter().enumerate().map(|(i, x)| x + 0.3 * turning(i)).collect();
    let turns = csv(folder.path(), "turns.csv", &[("acceleration", signal)]);
    let with = |speed: &str| {
        let output = size(folder.path(), &turns, &["--rate", "51200", "--speed", speed]);
        (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for speed in ["auto", "12..30", "720rpm..1800rpm"] {
        let (done, said) = with(speed);
        let found = said.split_once("shaft ").and_then(|(_, rest)| rest.split_once(" Hz, by its own lines"));
        // Lines of 4.9 s are 0.1 Hz apart in the fifth harmonic's bins.
        let found: f64 = found.map_or(f64::NAN, |(hertz, _)| hertz.parse().unwrap());
        assert!(done && (found - 17.3).abs() < 0.1, "{speed}: {found}, {said}");
    }
}

#[test]
fn columns_tachometer_and_speeds_are_chosen_by_name_or_number() {
    let folder = tempfile::tempdir().unwrap();
    let count = 60_000;
    let turn = |i: usize| 10.0 * i as f64 / RATE;
    let tacho = (0..count).map(|i| f64::from(u8::from(turn(i).fract() < 0.05))).collect();
    let columns =
        [("left", vec![0.5; count]), ("right", healthy(count)), ("key", tacho), ("n [rpm]", vec![600.0; count])];
    let path = csv(folder.path(), "four.csv", &columns);
    for speed in [["--tacho", "key"], ["--speed-column", "n"], ["--speed-column", "4"], ["--speed", "10"]] {
        let output = size(folder.path(), &path, &[&["--rate", "51200", "--column", "2"], &speed[..]].concat());
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        // The comb is sought from 3 % below to 2 % above the nominal 35.848 Hz.
        let bpfo = report["bpfo_hz"].as_f64().unwrap();
        assert!((34.7..36.7).contains(&bpfo), "{speed:?}: {bpfo}");
    }
}
