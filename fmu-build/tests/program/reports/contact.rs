//! The command `contact`: its files are there and agree with its summary, a figure can be drawn of them, and what is no
//! contact is refused before anything is written.
#![allow(clippy::unwrap_used)]

use crate::common;
use crate::common::program::{Table, brinell, done};
use std::fs;
use std::path::Path;

use serde_json::Value;

/// What the program prints about a contact in the scene er16k-tb1.
fn contact(on: &str, angle: &str, force: &str, folder: &Path, more: &[&str]) -> Value {
    let mut contact = brinell(&["contact", "er16k-tb1", "--on", on, "--angle", angle, "--force", force, "-o"]);
    serde_json::from_str(&done(contact.arg(folder).args(more)).out).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, &value| most.max(value))
}

#[test]
fn a_ball_at_the_edge_of_a_spall_gives_a_summary_tables_and_a_figure() {
    common::python();
    let folder = common::folder("contact-edge");
    let report = contact("outer", "7.85", "300", &folder, &["--resolution", "64"]);
    let stem = |end: &str| folder.join(format!("er16k-tb1-contact{end}"));
    assert_eq!(report, serde_json::from_str::<Value>(&fs::read_to_string(stem(".json")).unwrap()).unwrap());

    // What is written adds up to the force that was asked for.
    let [pressure, x] = ["pressure [Pa]", "x [m]"].map(|head| Table::read(&stem("-pressure.csv")).column(head));
    let cell: f64 = (0..2).map(|k| 1e-6 * number(&report["cell_um"][k])).product();
    let force = cell * pressure.iter().sum::<f64>();
    assert!((force / 300.0 - 1.0).abs() < 1e-5, "{force}");
    let found = &report["found"];
    let most = largest(&pressure);
    assert!((1e-6 * most / number(&found["max_pressure_mpa"]) - 1.0).abs() < 1e-9);
    assert!((x.len() as f64 * cell * 1e6 / number(&found["area_mm2"]) - 1.0).abs() < 1e-9);

    // The edge lies 15.8/2 − 7.85 degrees from the ball; beyond it, where the spall is, nothing presses.
    let edge = number(&report["edges_mm"][1]);
    let surface = Table::read(&stem("-surface.csv"));
    let width = 1e-3 * number(&report["cell_um"][0]);
    assert!(x.iter().all(|x| 1e3 * x > edge - width), "{edge}");
    for (x, depth) in surface.column("x [m]").iter().zip(surface.column("depth [m]")) {
        let wanted = if 1e3 * x < edge { 100e-6 } else { 0.0 };
        assert!((1e3 * x - edge).abs() < width || (depth - wanted).abs() < 1e-12, "{x}: {depth}");
    }

    let line = Table::read(&stem("-depth.csv"));
    let stress = |key: &str| 1e6 * number(&report["stress"][key]["von_mises_mpa"]);
    // A parabola through the highest three points is above each of them, and neither is at an end.
    for (column, key) in [("stress.von_mises [Pa]", "below_middle"), ("hertz.von_mises [Pa]", "hertz")] {
        let highest = largest(&line.column(column));
        assert!((1e-15..1e-3).contains(&(stress(key) / highest - 1.0)), "{key}: {highest}");
    }
    let plane = Table::read(&stem("-plane.csv"));
    assert!((largest(&plane.column("stress.von_mises [Pa]")) / stress("in_planes") - 1.0).abs() < 1e-9);
    let notes = report["notes"].to_string();
    assert!(notes.contains("ISO 76") && notes.contains("an edge is at the contact"), "{notes}");
    for end in [".svg", ".png"] {
        assert!(stem(end).metadata().unwrap().len() > 10_000, "{end}");
    }
}

#[test]
fn on_a_smooth_raceway_the_summary_is_hertzs() {
    let folder = common::folder("contact-smooth");
    let report = contact("inner", "0", "20", &folder, &["--no-figure", "--resolution", "128"]);
    assert!(report["notes"].to_string().contains("has no defect"), "{report}");
    // Circles for paraboloids are some thousandths of pressure and approach under 20 N, the grid a few 1e-4.
    for key in ["approach_um", "max_pressure_mpa"] {
        let ratio = number(&report["found"][key]) / number(&report["hertz"][key]);
        assert!((ratio - 1.0).abs() < 5e-3, "{key}: {ratio}");
    }
    let [found, hertz] = ["below_middle", "hertz"].map(|key| &report["stress"][key]);
    assert!((number(&found["von_mises_mpa"]) / number(&hertz["von_mises_mpa"]) - 1.0).abs() < 5e-3, "{found} {hertz}");
    assert!((number(&found["at_mm"][2]) / number(&hertz["at_mm"][2]) - 1.0).abs() < 1e-2, "{found} {hertz}");
    assert!(!folder.join("er16k-tb1-contact.svg").exists());
}
