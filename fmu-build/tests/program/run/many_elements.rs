//! Files and figures of bearings with so many elements that a field for each of their signals makes a header that
//! `numpy.load` refuses.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::fs;

use super::run;
use crate::common::program::{brinell, refused};

/// Both NumPy files by default arguments, against the table of another run.
const CHECK: &str = r#"
import sys
from pathlib import Path

import numpy as np

folder, count = Path(sys.argv[1]), int(sys.argv[2])
names = open(folder / "many.csv", encoding="utf-8").readline().strip().split(",")
rows = np.loadtxt(folder / "many.csv", delimiter=",", skiprows=1)
csv = {name.split(" [")[0]: rows[:, k] for k, name in enumerate(names)}
table, recording = np.load(folder / "many-signals.npy"), np.load(folder / "many.npy")
assert table["element.path"].shape == (len(rows), count) and len(recording) > 10
for j in (1, 2, count):
    for what in ("angle", "path", "force.inner", "force.outer"):
        assert np.array_equal(table[f"element.{what}"][:, j - 1], csv[f"element[{j}].{what}"]), (j, what)
        # Neither is filtered, and both have the start; the cage's angle is recorded once.
        assert what == "angle" or recording[f"element.{what}"][0, j - 1] == csv[f"element[{j}].{what}"][0], (j, what)
for name in ("time", "shaft.y", "sensor.acceleration", "solver.steps"):
    assert np.array_equal(table[name], csv[name]), name
assert np.ptp(recording["element.force.outer"][0]) > 0
print("as documented")
"#;

#[test]
fn numpy_loads_tables_and_recordings_of_many_elements_and_figure_and_page_are_drawn() {
    let count = 120;
    let folder = common::folder("many-elements");
    let scene = folder.join("many.toml");
    let mut text = common::scene_text("6205-healthy");
    for (key, value) in [("name", "\"many\""), ("element_count", &*count.to_string()), ("pitch_diameter_mm", "400.0")] {
        let line = text.lines().find(|line| line.starts_with(key)).unwrap().to_owned();
        text = text.replace(&line, &format!("{key} = {value}"));
    }
    fs::write(&scene, text + "\n[recorder]\nrate_hz = 25600.0\n").unwrap();
    let run = |more: &[&str]| run(&scene, &folder, &[&["--stop", "4e-3", "--step", "1e-3"], more].concat());
    run(&["--no-figure"]);
    run(&["--format", "npy", "--html"]);
    let said = common::run_text(common::python(), &folder, CHECK, [folder.display().to_string(), count.to_string()]);
    assert_eq!(said.trim(), "as documented");
    for drawn in ["many.png", "many.html"] {
        assert!(fs::metadata(folder.join(drawn)).unwrap().len() > 10_000, "{drawn}");
    }
    // `size` reads the recording, and names its columns.
    let mut size = brinell(&["size", "--speed", "25", "--column", "none", "--no-figure", "--scene"]);
    let said = refused(size.arg(&scene).arg(folder.join("many.npy")));
    assert!(said.contains("among 371 columns") && said.contains("element[1].path, element[2].path"), "{said}");
}
