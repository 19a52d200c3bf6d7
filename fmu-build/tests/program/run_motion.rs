//! The moving bearing and the cross-section on the page of a run, beside the run's table.
#![allow(clippy::unwrap_used)]

use crate::common;
use crate::run_page::page;
use std::fs;
use std::path::Path;

#[test]
fn the_moving_bearing_is_the_run_and_opens_with_an_element_over_the_defect() {
    let path = page("page-moving", "6205-two-defects", &["--stop", "0.2", "--columns", "*"]);
    let said = beside_the_table(&path, MOVING);
    assert_eq!(said.trim(), "moving");
}

/// What a script says of the motion in a page and of the run's table.
fn beside_the_table(page: &Path, script: &str) -> String {
    let file = page.with_extension("py");
    fs::write(&file, format!("{MOTION_DATA}{script}")).unwrap();
    let table = page.with_extension("csv");
    common::python().run_file(&file, [page, &table]).unwrap_or_else(|error| panic!("{error:#}"))
}

/// Reads the motion in a page, and the table.
const MOTION_DATA: &str = r##"
import base64
import json
import sys
import numpy as np

text = open(sys.argv[1], encoding="utf-8").read()
data, _ = json.JSONDecoder().raw_decode(text[text.index("const DATA = ") + len("const DATA = "):])
motion = data["motion"]
numbers = lambda packed: np.frombuffer(base64.b64decode(packed), "<f4").astype(float)
with open(sys.argv[2], encoding="utf-8") as file:
    names = [cell.rsplit(" [", 1)[0] for cell in file.readline().strip().split(",")]
    table = dict(zip(names, np.loadtxt(file, delimiter=",").T))
"##;

/// The motion in the page beside the table. Single precision: 6e-8 of the largest angle or path.
const MOVING: &str = r##"
every = motion["every"]
for j in range(1, 10):
    for mine, name, sign in ((motion["gap"]["outer"], "path", -1), (motion["force"]["outer"], "force.outer", 1)):
        there = sign * table[f"element[{j}].{name}"][::every]
        here = numbers(mine[j - 1])
        assert len(here) == len(there) and np.abs(here - there).max() <= 1e-7 * np.abs(there).max(), (j, name)
    turned = numbers(motion["angle"][j - 1]) - table[f"element[{j}].angle"][::every]
    assert np.abs((turned + np.pi) % (2 * np.pi) - np.pi).max() < 1e-5, j
# It opens with a ball over the outer raceway's spall that carries.
k = round((motion["opens"] - motion["start"]) / motion["step"])
angles = np.array([numbers(angle)[k] for angle in motion["angle"]])
away = np.abs((angles - motion["defects"][0]["angle"] + np.pi) % (2 * np.pi) - np.pi)
nearest = int(np.argmin(away))
force = numbers(motion["force"]["outer"][nearest])
assert motion["outer"] * away[nearest] <= max(abs(end[0]) for end in motion["defects"][0]["surface"]), away
assert force[k] > 0.2 * force.max(), (nearest, force[k], force.max())
print("moving")
"##;

#[test]
fn the_page_opens_with_a_ball_over_the_defect_that_carries() {
    for (scene, stop) in [("er16k-inner", "0.5"), ("7205-inner", "0.1")] {
        let path = page(&format!("page-opens-{scene}"), scene, &["--stop", stop, "--columns", "*"]);
        let said = beside_the_table(&path, OPENS);
        assert_eq!(said.trim(), "carries", "{scene}");
    }
}

/// The ball nearest to an inner defect when the page opens: it is inside, and the defect carries.
const OPENS: &str = r##"
k = round((motion["opens"] - motion["start"]) / motion["step"])
(defect,), shaft = motion["defects"], numbers(motion["shaft"]["angle"])[k]
angles = np.array([numbers(angle)[k] for angle in motion["angle"]])
away = np.abs((angles - shaft - defect["angle"] + np.pi) % (2 * np.pi) - np.pi)
nearest = int(np.argmin(away))
force = numbers(motion["force"]["inner"][nearest])
assert motion["inner"] * away[nearest] <= max(abs(end[0]) for end in defect["surface"]), away
assert force[k] > 0.2 * force.max(), (nearest, force[k], force.max())
print("carries")
"##;

#[test]
fn the_cross_section_is_the_run_where_balls_move_across_the_grooves() {
    // The outer ring tilts nowhere; the inner one does with five degrees of freedom.
    for scene in ["7205-preloaded", "7205-inner"] {
        let path = page(&format!("page-section-{scene}"), scene, &["--stop", "0.01", "--columns", "*"]);
        let said = beside_the_table(&path, SECTION);
        assert_eq!(said.trim(), "true", "{scene}");
    }
}

/// The cross-section in the page beside the table.
const SECTION: &str = r##"
section, every = motion["section"], motion["every"]
radius = motion["radius"]
for j in range(1, motion["count"] + 1):
    of = lambda name: table[f"element[{j}].{name}"][::every]
    for side in ("outer", "inner"):
        groove, angle, force = section[side], numbers(motion["contact"][side][j - 1]), of(f"force.{side}")
        assert np.abs(angle - of(f"contact_angle.{side}")).max() < 1e-6, (j, side)
        # The ellipse reaches as far as the model says what it leaves to the shoulder.
        reach = groove["half_length"] * np.cbrt(force) / groove["radius"]
        if groove["shoulder"] is not None:
            left = groove["shoulder"] - np.abs(angle) - reach
            assert np.abs(left - of(f"shoulder.{side}")).max() < 1e-6, (j, side)
        if any(defect["on"] == side for defect in motion["defects"]):
            continue
        # A force and an approach of its size go together: damping of 1/2 s/m adds 5 % at 0.1 m/s, after an impact.
        gap = numbers(motion["gap"][side][j - 1])
        pressed = force > 1.0
        assert pressed.sum() > 10 and (gap[pressed] < 0).all(), (j, side)
        ratios = force[pressed] / (-gap[pressed]) ** 1.5
        low, middle, high = np.quantile(ratios, [0.1, 0.5, 0.9])
        assert high - low < 0.05 * middle, (j, side, low, high)
print("true")
"##;
