//! Files: numbers that can be read in two ways, the recorder's own, files cut short.

use super::matlab::{doubles, file};
use super::{RATE, noise, npy, read_as, read_with, refused, wav};
use brinell::simulation::Simulation;
use brinell_analysis::recording::TextFormat;
use std::path::PathBuf;

#[test]
fn decimal_commas_keep_their_fractions_where_they_are_asked_for() {
    let values = noise(500);
    let comma =
        |digits: usize| -> String { values.iter().map(|v| format!("{v:.digits$}\n").replace('.', ",")).collect() };
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let format = TextFormat { delimiter: None, decimal: Some(',') };
    for digits in [2, 3, 6] {
        for (heading, separator) in
            [("", ""), ("acceleration\n", ""), ("recorder 7\nacceleration [m/s2]\n", ";"), ("acc;\n", ";")]
        {
            let text = heading.to_owned() + &comma(digits).replace('\n', &format!("{separator}\r\n"));
            let read = read_with("csv", text.as_bytes(), Some(RATE), format).unwrap();
            for (x, v) in read.samples().iter().zip(&values) {
                // Printed digits, of the sample and of the mean.
                assert!((x + mean - v).abs() < 1.01 * 10f64.powi(-(digits as i32)), "{digits} digits: {x} for {v}");
            }
            // Read as two columns of whole numbers by default: neither is taken.
            let why = read_as("csv", text.as_bytes(), Some(RATE)).unwrap_err();
            assert!(why.contains("--channel") || why.contains("--delimiter"), "{why}");
        }
    }
}

#[test]
fn matlabs_files_are_read_whole_and_refused_when_they_are_cut() {
    let samples = noise(500);
    let bytes = file(&[doubles([500, 1], "X097_DE_time", &samples)]);
    let read = read_as("mat", &bytes, Some(RATE)).unwrap();
    assert_eq!(read.samples().len(), 500);
    for cut in 0..bytes.len() {
        assert!(read_as("mat", &bytes[..cut], Some(RATE)).is_err(), "{cut} bytes");
    }
    refused(read_as("mat", &bytes, None), &["no sampling rate"]);
}

/// What the recorder of a scene writes in 20 ms, and its folder.
fn recorded(scene_text: &str) -> Vec<u8> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("recorder-{}", std::process::id()));
    let scene = brinell_scene_file::from_toml(scene_text).unwrap();
    let mut simulation = Simulation::new(scene, None).unwrap();
    simulation.record_into(folder.to_str().unwrap());
    simulation.initialize(0.0).unwrap();
    let mut recording = brinell::recording::Recording::begin(&simulation, "bearing").unwrap().unwrap();
    for _ in 0..20 {
        simulation.step(1e-3).unwrap();
    }
    recording.store(&mut simulation).unwrap();
    let bytes = std::fs::read(recording.path()).unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    bytes
}

#[test]
fn the_recorders_own_file_is_read_by_name_with_the_rate_of_its_times() {
    let healthy = include_str!("../../../scenes/6205-healthy.toml");
    let bytes = recorded(&(healthy.to_owned() + "\n[recorder]\nrate_hz = 51200.0\n"));
    let recording = read_as("npy", &bytes, None).unwrap();
    assert!((recording.rate() / RATE - 1.0).abs() < 1e-9);
    // 20 ms, less the rows that the filter has still under way.
    const ROWS: usize = 1024 - 15;
    assert_eq!(recording.samples().len(), ROWS);
    assert!(recording.samples().iter().any(|x| x.abs() > 1e-6));
    refused(read_as("npy", &bytes, Some(25_600.0)), &["25600 Hz", "the file states 51200"]);
    // Rows are taken out, and their number in the header changed.
    let header = 12 + u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
    let row = (bytes.len() - header) / ROWS;
    let text = String::from_utf8(bytes[12..header].to_vec()).unwrap().replace("(1009,)", "(909,) ");
    let (before, after) = (&bytes[header..header + 400 * row], &bytes[header + 500 * row..]);
    let holed = [&bytes[..12], text.as_bytes(), before, after].concat();
    refused(read_as("npy", &holed, None), &["time", "a hole of 0.001953 s after 0.007793 s", "about 100 samples"]);
    for cut in [bytes.len() - 1, bytes.len() - row, header + row / 2, header, header - 1, 20, 0] {
        assert!(read_as("npy", &bytes[..cut], None).is_err(), "{cut} bytes");
    }
    refused(read_as("npy", &[&bytes[..], &[0; 8]].concat(), None), &["bytes of numbers"]);
    // Without a sensor there is no acceleration to take: what there is is listed.
    let at = healthy.find("[sensor]").unwrap();
    let after = healthy[at..].find("\n[").map_or("", |next| &healthy[at + next..]);
    let bytes = recorded(&format!("{}{after}\n[recorder]\nrate_hz = 51200.0\n", &healthy[..at]));
    refused(read_as("npy", &bytes, None), &["which is the signal", "time", "shaft.ay", "element[9].path"]);
}

#[test]
fn a_file_cut_short_is_refused_at_any_byte() {
    let samples: Vec<f64> = noise(500).iter().map(|x| (1000.0 * x).round()).collect();
    for (ending, bytes) in [("npy", npy(&samples)), ("wav", wav(&samples, 51_200))] {
        let rate = Some(RATE);
        assert_eq!(read_as(ending, &bytes, rate).unwrap().samples().len(), 500);
        for cut in 0..bytes.len() {
            assert!(read_as(ending, &bytes[..cut], rate).is_err(), "{cut} of {} bytes of .{ending}", bytes.len());
        }
    }
}
