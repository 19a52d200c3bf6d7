//! The moving bearing and the cross-section on the page of a run, beside the run's table.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::page::{beside_the_table, page};

#[test]
fn the_moving_bearing_is_the_run_and_opens_with_an_element_over_the_defect() {
    let path = page("page-moving", "6205-two-defects", &["--stop", "0.2", "--columns", "*"]);
    assert_eq!(beside_the_table(&path, &format!("{MOVING}{OPENS}")), "moving\ncarries");
}

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
print("moving")
"##;

#[test]
fn the_page_opens_with_a_ball_over_the_defect_that_carries() {
    let path = page("page-opens", "er16k-inner", &["--stop", "0.5", "--columns", "*"]);
    for path in [path.as_path(), in_space()] {
        assert_eq!(beside_the_table(path, OPENS), "carries", "{}", path.display());
    }
}

/// The page of a bearing in space whose inner ring has a defect and tilts, drawn once for two tests.
fn in_space() -> &'static Path {
    static PAGE: OnceLock<PathBuf> = OnceLock::new();
    PAGE.get_or_init(|| page("page-in-space", "7205-inner", &["--stop", "0.1", "--columns", "*"]))
}

/// The ball nearest to the first defect when the page opens: it is inside, and the defect carries.
const OPENS: &str = r##"
k = round((motion["opens"] - motion["start"]) / motion["step"])
defect = motion["defects"][0]
turned = numbers(motion["shaft"]["angle"])[k] if defect["on"] == "inner" else 0.0
angles = np.array([numbers(angle)[k] for angle in motion["angle"]])
away = np.abs((angles - turned - defect["angle"] + np.pi) % (2 * np.pi) - np.pi)
nearest = int(np.argmin(away))
force = numbers(motion["force"][defect["on"]][nearest])
assert motion[defect["on"]] * away[nearest] <= max(abs(end[0]) for end in defect["surface"]), away
assert force[k] > 0.2 * force.max(), (nearest, force[k], force.max())
print("carries")
"##;

#[test]
fn the_cross_section_is_the_run_where_balls_move_across_the_grooves() {
    // The outer ring tilts nowhere; the inner one does with five degrees of freedom.
    let path = page("page-section", "7205-preloaded", &["--stop", "0.01", "--columns", "*"]);
    for path in [path.as_path(), in_space()] {
        assert_eq!(beside_the_table(path, SECTION), "true", "{}", path.display());
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
