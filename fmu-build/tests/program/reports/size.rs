//! The command `size`, as a program: JSON alone on standard output, files beside it.
#![allow(clippy::unwrap_used)]

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use crate::common::program::{Said, brinell, tried};
use serde_json::Value;

pub(crate) const RATE: f64 = 51_200.0;

/// A healthy bearing: a shaft's harmonics and noise from a linear congruence.
pub(crate) fn healthy(count: usize) -> Vec<f64> {
    let mut state = 1u32;
    (0..count)
        .map(|i| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (TAU * 30.0 * i as f64 / RATE).sin() + f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        })
        .collect()
}

pub(crate) fn csv(folder: &Path, name: &str, columns: &[(&str, Vec<f64>)]) -> PathBuf {
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
fn size(folder: &Path, recording: &Path, more: &[&str]) -> (bool, Said) {
    let mut command = brinell(&["size", "--bearing", "6205", "--rate", "51200", "--no-figure", "-o"]);
    tried(command.arg(folder.join("out")).arg(recording).args(more))
}

/// Between the bounds of the comb, 3 % below and 2 % above the nominal 35.848 Hz: 3.5848 times the shaft's speed.
fn is_sought_at_10_hz(answer: &str) -> bool {
    let report: Value = serde_json::from_str(answer).unwrap();
    (34.7..36.7).contains(&report["bpfo_hz"].as_f64().unwrap())
}

#[test]
fn the_answer_is_json_alone_and_holds_every_key_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let path = csv(folder.path(), "healthy.csv", &[("acceleration", healthy(60_000))]);
    let (done, said) = size(folder.path(), &path, &["--speed", "10"]);
    assert!(done, "{}", said.err);
    let report: Value = serde_json::from_str(&said.out).unwrap();
    for key in ["verdict", "length_mm", "length_deg", "uncertainty_mm", "kind", "bpfo_hz", "slip", "passages", "reason"]
    {
        assert!(report.get(key).is_some(), "{key}");
    }
    assert_eq!(report["verdict"], "unresolved");
    assert!(report["length_mm"].is_null() && report["length_deg"].is_null() && report["uncertainty_mm"].is_null());
    assert!(report["reason"].as_str().unwrap().contains("passage frequency of the bearing"));
    assert_eq!((&report["grade"], &report["next"].is_string()), (&Value::from("none"), &true));
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
    let mut command = brinell(&["size", "--bearing", "6205", "--speed", "10", "--no-figure", "-o"]);
    let said = tried(command.arg(folder.path().join("out")).arg(&path)).1.err;
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
        let (done, said) = size(folder.path(), &path, &[&["--speed", "600rpm"], more].concat());
        (done, said.err, said.out)
    };
    // Of two channels none is taken silently.
    let (done, said, _) = with(&[]);
    assert!(!done && said.contains("columns left, right") && said.contains("--channel"), "{said}");
    let (done, said, answer) = with(&["--channel", "right"]);
    let page = folder.path().join("page.html");
    let (paged, _, _) = with(&["--channel", "right", "--report", page.to_str().unwrap()]);
    let text = std::fs::read_to_string(&page).unwrap();
    // The answer, the combs of three kinds, and four curves with the lines of the bearing.
    assert!(paged && text.contains("<h1>no fault found</h1>") && text.contains("two.csv"), "{text:.400}");
    assert_eq!(text.matches("<polyline points=\"0.0,").count(), 4);
    assert!(["rolling element (2 BSF)", ">BPFO<", ">2 × BPFI<", ">shaft<"].iter().all(|part| text.contains(part)));
    assert!(done && said.contains("shaft 10.0000 Hz") && said.contains("a load of 390 N is assumed"), "{said}");
    assert!(said.contains("\nno fault found\n  "), "{said}");
    // One line that fits a terminal, and below it what nobody gave.
    assert!(said.lines().filter(|line| line.starts_with("no fault")).all(|line| line.chars().count() <= 160), "{said}");
    assert!(said.contains("\n  assumed: load 390 N") && said.contains("\n  next: nothing;"), "{said}");
    for first in ["Part", "Length", "Certainty", "Assumed", "Next"] {
        assert!(text.contains(&format!("<tr><th>{first}</th>")), "{first}");
    }
    assert!(
        text.contains("load 390 N (assumed)") && !text.contains("nepers") && !text.contains("comb"),
        "{text:.4000}"
    );
    assert!(is_sought_at_10_hz(&answer), "{answer}");
    let (done, said, _) = with(&["--load", "1200", "--channel", "2"]);
    assert!(done && !said.contains("assumed: load") && !said.contains("is assumed"), "{said}");
}

#[test]
fn the_speed_is_sought_in_the_shafts_own_lines() {
    let folder = tempfile::tempdir().unwrap();
    let turning = |i: usize| (1..=6).map(|k| (TAU * f64::from(k) * 17.3 * i as f64 / RATE).sin()).sum::<f64>();
    let signal = healthy(250_000).iter().enumerate().map(|(i, x)| x + 0.3 * turning(i)).collect();
    let turns = csv(folder.path(), "turns.csv", &[("acceleration", signal)]);
    let with = |speed: &str| {
        let (done, said) = size(folder.path(), &turns, &["--speed", speed]);
        (done, said.err)
    };
    for speed in ["12..20", "12..20Hz", "720..1200rpm", "720rpm..1200rpm"] {
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
        let (_, said) = size(folder.path(), &path, &[&["--column", "2"], &speed[..]].concat());
        assert!(is_sought_at_10_hz(&said.out), "{speed:?}: {}", said.out);
    }
}
