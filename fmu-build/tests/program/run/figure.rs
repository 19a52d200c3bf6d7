//! The figure of `run`, as a program: the envelope's spectrum and the frequencies that are marked in it.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::fs;
use std::path::Path;

use super::run;
use serde_json::Value;

#[test]
fn a_run_of_eight_passages_shows_the_envelopes_spectrum_with_the_bearings_frequencies() {
    common::python();
    let out = common::folder("run-figure");
    let said = run("6205-healthy", &out, &["--stop", "0.1"]);
    names_all_files(&said.out, &out);
    let said = said.err;
    assert!(!said.contains("note: no spectrum"), "{said}");
    let file = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    let marks: Value = serde_json::from_str(&file("6205-healthy-envelope.json")).unwrap();
    // Of a 6205 at the scene's 25 Hz: orders 3.5848, 5.4152, 4.7135 and 0.3983.
    for (name, order) in [("BPFO", 3.5848), ("BPFI", 5.4152), ("2 BSF", 4.7135), ("FTF", 0.3983)] {
        let found = marks["frequencies_hz"][name].as_f64().unwrap();
        // The last printed digit of the orders.
        assert!((found / 25.0 - order).abs() < 1e-4, "{name}: {found}");
    }
    // Four over 1001 samples of 0.1 ms.
    assert!((marks["line_width_hz"].as_f64().unwrap() - 4.0 / 0.1001).abs() < 1e-9);
    let text = file("6205-healthy-envelope.csv");
    assert!(text.starts_with("frequency [Hz],amplitude [1]\n") && text.lines().count() > 50, "{text}");
    assert!(fs::metadata(out.join("6205-healthy.png")).unwrap().len() > 10_000);
}

#[test]
fn a_figure_says_its_recorders_bands_and_that_a_run_ups_frequencies_are_at_the_mean_speed() {
    common::python();
    let out = common::folder("run-figure-up");
    let profile = out.join("up.csv");
    fs::write(&profile, "time_s,speed_hz\n0,10\n0.1,20\n0.3,20\n").unwrap();
    // 15 360 samples of the recorder are bands; 3001 communication points are lines.
    run("er16k-tb1", &out, &[&format!("--speed-profile={}", profile.display()), "--step", "1e-4"]);
    // Letters are curves; what they say stands in comments.
    let figure = fs::read_to_string(out.join("er16k-tb1.svg")).unwrap();
    assert!(figure.contains("er16k-tb1; in each part of the time: line the middle value"), "no word of bands");
    assert!(figure.contains("<!-- frequency at the mean speed of 18."), "an axis of the scene's own speed");
}

#[test]
fn every_file_that_a_run_writes_is_said_and_no_other() {
    common::python();
    let folder = common::folder("run-files");
    let scene = folder.join("recorded.toml");
    fs::write(&scene, common::scene_text("6205-healthy") + "\n[recorder]\nrate_hz = 25600.0\n").unwrap();
    // With a figure alone: `a_run_of_eight_passages` above.
    for (name, more) in [("all", ["--html", "--wav"].as_slice()), ("table", &["--no-figure"])] {
        let out = folder.join(name);
        names_all_files(&run(&scene, &out, &[&["--stop", "0.1"], more].concat()).out, &out);
    }
}

/// What is said is every file in a folder, once.
#[track_caller]
fn names_all_files(said: &str, out: &Path) {
    let entries = fs::read_dir(out).unwrap().map(|entry| entry.unwrap().path().display().to_string());
    let (mut there, mut said) = (entries.collect::<Vec<_>>(), said.lines().collect::<Vec<_>>());
    there.sort();
    said.sort();
    assert_eq!(said, there);
}

#[test]
fn a_run_too_short_for_it_says_how_long_it_would_have_to_be() {
    common::python();
    let out = common::folder("run-figure-short");
    let said = run("6205-healthy", &out, &["--stop", "0.01"]).err;
    assert!(said.contains("--stop 0.09 is enough"), "{said}");
    assert!(!out.join("6205-healthy-envelope.csv").exists());
    assert!(out.join("6205-healthy.png").is_file());
}

#[test]
fn bands_of_a_long_run_reach_to_its_ends_and_hold_every_extreme() {
    let said = common::run_text(common::python(), &common::folder("run-figure-bands"), BANDS, [""; 0]);
    assert!(said.contains("held"), "{said}");
}

/// One sample far above and one far below all others, the latter among the last that do not fill a part.
const BANDS: &str = r#"
import numpy as np
import plotting

time = np.linspace(0.0, 20.0, 200_001)
values = np.sin(1000 * time)
values[123_456], values[-2] = 50.0, -70.0
figure, axis = plotting.plt.subplots()
assert plotting.is_long(time) and not plotting.is_long(time[:1000])
plotting.curve(axis, time, values, plotting.BLUE, None)
light = axis.collections[0].get_paths()[0].vertices
assert light[:, 0].min() == 0.0 and light[:, 0].max() == 20.0, light[:, 0].max()
assert light[:, 1].max() == 50.0 and light[:, 1].min() == -70.0
assert abs(light[light[:, 1] > 40][0, 0] - time[123_456]) < 20 / 480
print("held")
"#;
