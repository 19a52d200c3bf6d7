//! The command `modes`: its file is there, whole, and a figure can be drawn of it.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::fs;
use std::path::PathBuf;

use crate::common::program::{brinell, done};
use serde_json::Value;

/// The folder of a scene's modes, and the report in it.
fn made(scene: &str, folder: &str, more: &[&str]) -> (PathBuf, Value) {
    let folder = common::folder(folder);
    done(brinell(&["modes", scene, "-o"]).arg(&folder).args(more));
    let text = fs::read_to_string(folder.join(format!("{scene}-modes.json"))).unwrap();
    (folder, serde_json::from_str(&text).unwrap())
}

#[test]
fn an_assembly_with_a_spall_gives_lines_modes_and_a_figure() {
    let (folder, report) = made("er16k-tb2", "modes-tb2", &["--points", "20"]);
    let freedoms = report["freedoms"].as_array().unwrap().len();
    assert_eq!(freedoms, 9 + 2 + 2 + 1);
    let angles = report["angles"].as_array().unwrap();
    assert!(angles.len() > 20);
    for angle in angles {
        for mode in angle["modes"].as_array().unwrap() {
            for list in ["amplitude", "phase_deg", "energy"] {
                assert_eq!(mode[list].as_array().unwrap().len(), freedoms);
            }
            let energy: f64 = mode["energy"].as_array().unwrap().iter().filter_map(Value::as_f64).sum();
            let largest = mode["amplitude"].as_array().unwrap().iter().filter_map(Value::as_f64).fold(0.0, f64::max);
            // Each part is rounded to a millionth.
            assert!((energy - 1.0).abs() < 1e-5 && largest == 1.0, "{mode}");
            // ω = |λ|, and the damped frequency is below the undamped one.
            let [re, im] = [0, 1].map(|i| mode["eigenvalues_1_s"][0][i].as_f64().unwrap());
            let undamped = mode["undamped_frequency_hz"].as_f64().unwrap();
            assert!((re.hypot(im) / std::f64::consts::TAU / undamped - 1.0).abs() < 1e-12);
            assert!(mode["damped_frequency_hz"].as_f64().unwrap() < undamped);
        }
    }
    // Four modes of the rings and one of the sensor among the lines.
    let lines = report["lines"].as_array().unwrap();
    assert_eq!(lines.iter().filter(|line| line["elements"].as_f64().unwrap() < 0.5).count(), 5);
    for end in ["svg", "png"] {
        assert!(folder.join(format!("er16k-tb2-modes.{end}")).metadata().unwrap().len() > 10_000);
    }
}

#[test]
fn rings_that_a_host_moves_hold_still_where_they_carry_the_load() {
    let under = |load: &str| made("6205-hosted", "modes-hosted", &["--load", load, "--points", "4", "--no-figure"]).1;
    let (report, more) = (under("800"), under("1600"));
    assert_eq!(report["freedoms"].as_array().unwrap().len(), 9);
    assert_eq!(report["shaft_load_n"][1], -800.0);
    let fastest = |report: &Value| {
        let lines = report["lines"].as_array().unwrap();
        lines.iter().map(|line| line["undamped_frequency_hz"][1].as_f64().unwrap()).fold(0.0, f64::max)
    };
    // Hertz's contact under twice the load: the sixth root of 2 as to frequencies, less the clearance's part.
    let ratio = fastest(&more) / fastest(&report);
    assert!((ratio - 2f64.powf(1.0 / 6.0)).abs() < 0.01, "{ratio}");
}
