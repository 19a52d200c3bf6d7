//! Files as public collections and loggers have them: the forms of their bytes, with signals made here.
//!
//! PRONOSTIA (FEMTO-ST, PHM 2012): hour, minute, second, microseconds, two accelerations, no heading, 25.6 kHz. IMS:
//! tabs, names of dates. CWRU: `X098_DE_time` beside `X098RPM`. MFPT: `bearing.sr`, `bearing.gs`, `bearing.rate`.
//! Paderborn: structures with `Name` and `Data`.

use super::matlab::{array, doubles, fields, file, text};
use super::{RATE, noise, refused};
use brinell_analysis::recording::{Recording, Source, Speed, TextFormat};
use brinell_analysis::statistics::Random;
use std::fmt::Write;
use std::path::Path;

/// Reads bytes as a file of this name.
fn read(name: &str, bytes: &[u8], rate: Option<f64>, channel: Option<&str>) -> Result<Recording, String> {
    with_speed(name, bytes, rate, channel, Speed::Constant(30.0))
}

fn with_speed(
    name: &str,
    bytes: &[u8],
    rate: Option<f64>,
    channel: Option<&str>,
    speed: Speed,
) -> Result<Recording, String> {
    let source = Source { rate, speed, signal: channel.map(str::to_owned), text: TextFormat::default() };
    Recording::of_file(Path::new(name), bytes, &source).map_err(|error| error.to_string())
}

/// Whether these are the samples of a file, but for their mean and the digits that it has.
fn assert_samples(recording: &Recording, samples: &[f64], digits: f64) {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    assert_eq!(recording.samples().len(), samples.len());
    for (read, sample) in recording.samples().iter().zip(samples) {
        assert!((read + mean - sample).abs() < digits, "{read} for {sample}");
    }
}

#[test]
fn a_clock_in_hours_minutes_and_seconds_is_left_out_where_rate_and_channel_are_given() {
    const PRONOSTIA: f64 = 25_600.0;
    for seed in 0..40 {
        let mut random = Random::new(seed);
        // Seconds, minutes and hours pass during half of the recordings.
        let start = if seed % 2 == 0 { 35_979.0 } else { 35_999.9 } + 0.9 * random.uniform();
        let samples = noise(2560 + random.below(3000));
        let heading = ["", "hour,minute,second,microsecond,h,v\n", "h,min,s,us,acc x,acc y\n"][random.below(3)];
        let whole_microseconds = random.below(2) == 0;
        let mut text = heading.to_owned();
        for (i, sample) in samples.iter().enumerate() {
            let t = start + i as f64 / PRONOSTIA;
            let (h, m, s) = ((t / 3600.0).floor(), (t / 60.0).floor() % 60.0, t.floor() % 60.0);
            let us = 1e6 * t.fract();
            let us = if whole_microseconds { format!("{us:.0}") } else { format!("{us:.4e}") };
            writeln!(text, "{h},{m},{s},{us},{:.3},{sample:.3}", -2.0 * sample).unwrap();
        }
        let read = read("acc_00001.csv", text.as_bytes(), Some(PRONOSTIA), Some("6"));
        let recording = read.unwrap_or_else(|why| panic!("seed {seed}, {heading:?}: {why}"));
        assert_samples(&recording, &samples, 2e-3);
        assert_eq!(recording.rate(), PRONOSTIA);
    }
}

#[test]
fn a_coarse_clock_is_refused_unless_both_rate_and_channel_are_given_and_a_hole_always() {
    let samples = noise(6000);
    let times = |digits: usize, hole: f64| -> String {
        let line = |(i, sample): (usize, &f64)| {
            let t = i as f64 / RATE + if i > 3000 { hole } else { 0.0 };
            format!("{t:.digits$},{sample:.6}\n")
        };
        "time [s],acc\n".to_owned() + &samples.iter().enumerate().map(line).collect::<String>()
    };
    let coarse = times(3, 0.0);
    for (rate, channel) in [(None, None), (Some(RATE), None), (None, Some("acc"))] {
        refused(read("a.csv", coarse.as_bytes(), rate, channel), &["time [s]", "--rate and --channel"]);
    }
    let recording = read("a.csv", coarse.as_bytes(), Some(RATE), Some("acc")).unwrap();
    assert_samples(&recording, &samples, 2e-6);
    assert!(recording.remarks()[0].contains("time [s] does not say when"), "{:?}", recording.remarks());
    // A clock that tells samples apart still tells what is missing.
    refused(read("a.csv", times(6, 1e-3).as_bytes(), Some(RATE), Some("acc")), &["a hole of"]);
}

#[test]
fn texts_are_read_whatever_their_name_and_however_long_their_row() {
    let samples = noise(3000);
    let with = |sign: &str, end: &str| samples.iter().map(|x| format!("{x:.6}{sign}")).collect::<String>() + end;
    for (name, text) in [
        ("acc_00001", with("\n", "")),
        ("2004.02.12.10.32.39", with("\t\n", "")),
        ("signal.dat", with(" ", "")),
        ("row.csv", with(",", "\n")),
        ("row.txt", with(" ", "\r\n")),
        ("row.tsv", with("\t", "\n")),
        ("column.tsv", "acc\n".to_owned() + &with("\n", "")),
    ] {
        let recording = read(name, text.as_bytes(), Some(RATE), None).unwrap_or_else(|why| panic!("{name}: {why}"));
        assert_samples(&recording, &samples, 2e-6);
    }
    // As the eight channels of IMS: tabs, without a heading.
    let row = |x: &f64| format!("{:.6}\t{x:.6}\t{:.6}\n", 2.0 * x, 3.0 * x);
    let three: String = samples.iter().map(row).collect();
    let recording = read("2003.10.22.12.06.24", three.as_bytes(), Some(20_480.0), Some("2")).unwrap();
    assert_samples(&recording, &samples, 2e-6);
    refused(read("2003.10.22.12.06.24", three.as_bytes(), Some(20_480.0), None), &["3 columns", "--channel"]);
    refused(read("setup.exe", b"MZ\0\0", Some(RATE), None), &["ending 'exe', and no text", ".lvm"]);
}

#[test]
fn what_a_matlab_file_states_of_rate_and_speed_is_taken_compared_or_offered() {
    let samples = noise(3000);
    let mfpt = |rate: f64| {
        let parts = [
            fields(&["sr", "gs", "load", "rate"]),
            doubles([1, 1], "", &[rate]),
            doubles([3000, 1], "", &samples),
            doubles([1, 1], "", &[270.0]),
            doubles([1, 1], "", &[25.0]),
        ];
        file(&[array(2, [1, 1], "bearing", &parts.concat())])
    };
    let recording = read("baseline_1.mat", &mfpt(97_656.0), None, None).unwrap();
    assert_samples(&recording, &samples, 1e-12);
    assert_eq!(recording.rate(), 97_656.0);
    assert!(recording.remarks()[0].contains("97656 Hz by bearing.sr = 97656"), "{:?}", recording.remarks());
    assert_eq!(recording.stated_speed().unwrap().hertz, 25.0);
    let other = read("baseline_1.mat", &mfpt(97_656.0), Some(48_828.0), None);
    refused(other, &["48828 Hz", "97656.000 Hz by bearing.sr"]);
    let no_speed = with_speed("baseline_1.mat", &mfpt(97_656.0), None, None, Speed::Unknown);
    refused(no_speed, &["speed is not said", "bearing.rate = 25: --speed 25"]);

    // Of two recordings in one file one speed is stated.
    let cwru = file(&[
        doubles([3000, 1], "X098_DE_time", &samples),
        doubles([3000, 1], "X099_DE_time", &samples[..2000].repeat(2)[..3000]),
        doubles([1, 1], "X098RPM", &[1772.0]),
    ]);
    let of = |channel: &str| with_speed("99.mat", &cwru, Some(12_000.0), Some(channel), Speed::Unknown);
    refused(of("X098_DE_time"), &["X098RPM = 1772: --speed 1772rpm"]);
    let other = of("X099_DE_time").unwrap_err();
    assert!(other.ends_with("--speed-column"), "{other}");
    refused(read("99.mat", &cwru, None, Some("X098_DE_time")), &["no sampling rate", "X098RPM = 1772"]);
}

#[test]
fn a_channel_of_paderborns_structures_is_chosen_by_its_name_or_its_path() {
    let samples = noise(3000);
    let seconds: Vec<f64> = (0..3000).map(|i| f64::from(i) / 64_000.0).collect();
    let x = [fields(&["Name", "Data"]), text("HostService"), doubles([1, 3000], "", &seconds)];
    let y = [
        fields(&["Name", "Data"]),
        text("force"),
        doubles([1, 200], "", &noise(200)),
        text("vibration_1"),
        doubles([1, 3000], "", &samples),
    ];
    let parts = [fields(&["X", "Y"]), array(2, [1, 1], "", &x.concat()), array(2, [1, 2], "", &y.concat())].concat();
    let bytes = file(&[array(2, [1, 1], "N15_M07_F10_K001_1", &parts)]);
    for channel in [None, Some("vibration_1"), Some("N15_M07_F10_K001_1.Y[2].Data"), Some("3")] {
        let recording = read("N15_M07_F10_K001_1.mat", &bytes, Some(64_000.0), channel).unwrap();
        assert_samples(&recording, &samples, 1e-12);
    }
    // What ticks beside the signal offers its rate.
    refused(read("N15_M07_F10_K001_1.mat", &bytes, None, None), &["HostService", "64000", "if it counts seconds"]);
    let none = read("N15_M07_F10_K001_1.mat", &bytes, Some(64_000.0), Some("speed"));
    refused(none, &["force (N15_M07_F10_K001_1.Y[1].Data)", "vibration_1"]);
}
