//! Files: numbers that can be read in two ways, the recorder's own, files cut short.

use super::{RATE, SPEED, noise, npy, read_as, refused, wav};
use brinell::simulation::Simulation;
use brinell_analysis::recording::{Recording, Source, Speed};
use std::path::PathBuf;

#[test]
fn decimal_commas_keep_their_fractions_and_what_can_be_read_in_two_ways_is_refused_by_line() {
    let values = noise(500);
    let comma =
        |digits: usize| -> String { values.iter().map(|v| format!("{v:.digits$}\n").replace('.', ",")).collect() };
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    for digits in [2, 3, 6] {
        for (heading, separator) in
            [("", ""), ("acceleration\n", ""), ("recorder 7\nacceleration [m/s2]\n", ";"), ("acc;\n", ";")]
        {
            let text = heading.to_owned() + &comma(digits).replace('\n', &format!("{separator}\r\n"));
            let found = read_as("csv", text.as_bytes(), Some(RATE)).unwrap();
            for (x, v) in found.samples().iter().zip(&values) {
                // Printed digits, of the sample and of the mean.
                assert!((x + mean - v).abs() < 1.01 * 10f64.powi(-(digits as i32)), "{digits} digits: {x} for {v}");
            }
        }
    }
    let rate = Some(RATE);
    for (text, parts) in [
        // One number with one digit behind the comma, or two whole ones.
        ("1,5\n2,7\n3,1\n", &["line 1", "'1,5'", "names above two columns"][..]),
        ("12,345\n13,344\n", &["line 1", "'12,345'"]),
        // Decimals with a nought in front, below two names; and beside a sign.
        ("time,acc\n0,015\n1,025\n", &["line 2", "'0,015'", "line 1"]),
        ("0,015\n1,-5\n", &["line 1", "'0,015'", "line 2", "'1,-5'"]),
        // Commas between numbers and in them.
        ("0,000,1,234\n0,001,1,345\n", &["line 1", "'0,000,1,234'"]),
        // A point and a comma.
        ("t;a\n0.001;0,5\n", &["line 2", "point", "comma"]),
        ("a;b\n1;0,5\n2;1.234\n", &["line 3", "'1.234'", "line 2 a comma"]),
        ("a;b\n1;1.234,5\n", &["line 2", "'1.234,5' is not a number"]),
        // Thousands.
        ("a;b\n1;1,234\n2;999\n3;2,345\n", &["line 2", "'1,234'", "thousands"]),
        ("a;b\n1;1,234,567\n", &["line 2", "is not a number"]),
    ] {
        refused(read_as("csv", text.as_bytes(), rate), parts);
    }
    // Signs, names and points tell; so do blanks.
    for (text, expected) in [
        ("left,right\n2,5\n1,7\n", [2.0, 1.0]),
        ("2,-5\n1,7\n", [2.0, 1.0]),
        ("2.5,3\n1.5,4\n", [2.5, 1.5]),
        ("2,5,\n1,7,\n", [2.0, 1.0]),
        ("1,5 7\n0,5 7\n", [1.5, 0.5]),
        ("-0,5\n1,5\n", [-0.5, 1.5]),
        ("0,5\n1\n2,5\n", [0.5, 1.0]),
        ("1,50e-3\n2,50e-3\n", [1.5e-3, 2.5e-3]),
    ] {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("commas-{}.csv", std::process::id()));
        std::fs::write(&path, text).unwrap();
        let source = Source { rate, speed: Speed::Constant(SPEED), signal: Some("1".to_owned()) };
        let found = Recording::read(&path, &source).unwrap_or_else(|why| panic!("{text}: {why}"));
        let difference = found.samples()[1] - found.samples()[0];
        assert!((difference - (expected[1] - expected[0])).abs() < 1e-12, "{text}: {difference}");
    }
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
