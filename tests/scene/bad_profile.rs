//! Every measured surface that cannot be used is refused with the line or position, the value and the limit.

use brinell::scene::{Bearing, Defect, DefectShape};
use brinell::surface::{Profile, Surface};

fn er16k() -> Bearing {
    match brinell_scene_file::from_toml(include_str!("../../scenes/er16k-tb1.toml")) {
        Ok(scene) => scene.bearing,
        Err(error) => panic!("{error}"),
    }
}

/// The message for a file with this text.
#[track_caller]
fn refused(text: &str, parts: &[&str]) {
    let shape = DefectShape::Profile("trace.csv".to_owned());
    let message = match Surface::load(&Defect::outer(0.0, shape.clone()), Some(text), &er16k()) {
        Ok(_) => panic!("`{text}` was accepted"),
        Err(error) => error.to_string(),
    };
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn a_missing_file_is_refused_with_its_name() {
    let shape = DefectShape::Profile("trace.csv".to_owned());
    let message = Surface::load(&Defect::outer(0.0, shape.clone()), None, &er16k()).unwrap_err().to_string();
    assert_eq!(message, "defect profile \"trace.csv\": the file is missing");
}

#[test]
fn an_empty_trace_is_refused() {
    for text in ["", "\n\n", "# only a comment\n"] {
        refused(text, &["empty", "arc_mm,depth_um"]);
    }
}

#[test]
fn a_trace_of_one_point_is_refused() {
    refused("arc_mm,depth_um\n", &["0 points along arc_mm", "at least 2"]);
    refused("arc_mm,depth_um\n0.0,1.0\n", &["1 points along arc_mm", "at least 2"]);
}

#[test]
fn a_trace_without_a_header_is_refused() {
    refused("0.0,1.0\n0.1,1.0\n", &["line 1", "column arc_mm is missing", "\"0.0,1.0\""]);
}

#[test]
fn a_missing_column_is_refused() {
    refused("# trace\narc_mm\n0.0\n0.1\n", &["line 2", "column depth_um is missing"]);
    refused("arc_mm,axial_mm\n0.0,1.0\n", &["column depth_um is missing"]);
}

#[test]
fn an_unknown_column_is_refused() {
    refused("arc_mm,depth_mm\n0,1\n", &["line 1", "unknown column \"depth_mm\"", "arc_mm, depth_um"]);
    refused("arc_mm;depth_um\n0;1\n", &["unknown column \"arc_mm;depth_um\""]);
}

#[test]
fn a_repeated_column_is_refused() {
    refused("arc_mm,arc_mm,depth_um\n0,1,2\n", &["line 1", "arc_mm stands twice"]);
}

#[test]
fn a_line_with_too_many_or_too_few_values_is_refused() {
    refused("arc_mm,depth_um\n0,1\n0.1\n", &["line 3", "1 values", "2 columns"]);
    refused("arc_mm,depth_um\n0,1\n0,1,2\n", &["line 3", "3 values", "2 columns"]);
}

#[test]
fn a_value_that_is_not_a_number_is_refused() {
    refused("arc_mm,depth_um\n0,1\n0.1,deep\n", &["line 3", "depth_um is \"deep\""]);
}

#[test]
fn a_value_that_is_not_finite_is_refused() {
    refused("arc_mm,depth_um\n0,1\n0.1,nan\n", &["line 3", "depth_um is NaN"]);
    refused("arc_mm,depth_um\n-inf,1\n0.1,0\n", &["line 2", "arc_mm is -inf"]);
}

#[test]
fn an_unsorted_or_repeated_arc_is_refused() {
    refused("arc_mm,depth_um\n0.1,0\n0.0,1\n", &["line 3", "arc_mm is 0", "above 0.1"]);
    refused("arc_mm,depth_um\n0.1,0\n# c\n0.1,1\n", &["line 4", "arc_mm is 0.1", "above 0.1"]);
}

#[test]
fn a_trace_longer_than_the_raceway_is_refused() {
    // 2π × 23.6325 mm.
    refused("arc_mm,depth_um\n0,0\n150,0\n", &["150.000000 mm long", "below 148.487377 mm", "circumference"]);
}

#[test]
fn a_trace_deeper_than_an_elements_radius_is_refused() {
    refused("arc_mm,depth_um\n0,0\n1,3971\n2,0\n", &["depth is 3971.000 um", "below 3970.000 um"]);
    refused("arc_mm,depth_um\n0,0\n1,-4000\n2,0\n", &["depth is -4000.000 um"]);
}

#[test]
fn a_trace_whose_rims_rise_by_an_elements_radius_above_its_floor_is_refused() {
    refused("arc_mm,depth_um\n0,0\n1,-2000\n1.5,2000\n2,0\n", &["it is 4000.000 um", "below 3970.000 um"]);
}

#[test]
fn a_topography_with_a_hole_is_refused_with_its_position() {
    let text = "arc_mm,axial_mm,depth_um\n0,0,1\n0,1,1\n0.5,0,1\n";
    refused(text, &["no depth at arc_mm = 0.5, axial_mm = 1", "3 points", "2 by 2", "needs 4"]);
}

#[test]
fn a_topography_that_is_not_a_rectangle_is_refused() {
    let text = "arc_mm,axial_mm,depth_um\n0,0,1\n0,1,1\n0.5,0,1\n0.5,1.1,1\n";
    refused(text, &["no depth at arc_mm = 0, axial_mm = 1.1", "2 by 3"]);
}

#[test]
fn a_topography_that_gives_a_point_twice_is_refused() {
    let text = "arc_mm,axial_mm,depth_um\n0,0,1\n0,1,1\n0.5,0,1\n0.5,1,1\n0,1,2\n";
    refused(text, &["line 6", "arc_mm = 0, axial_mm = 1", "second time"]);
}

#[test]
fn a_topography_of_one_line_is_refused() {
    let text = "arc_mm,axial_mm,depth_um\n0,0,1\n0.5,0,1\n";
    refused(text, &["1 points along axial_mm", "at least 2"]);
}

#[test]
fn a_topography_deeper_than_an_elements_radius_is_refused() {
    let text = "arc_mm,axial_mm,depth_um\n0,0,1\n0,1,1\n0.5,0,9000\n0.5,1,1\n";
    refused(text, &["depth is 9000.000 um, 0.250000 mm from the middle"]);
}

#[test]
fn points_that_describe_no_profile_are_refused() {
    let message = |points| Profile::from_points(points).unwrap_err().to_string();
    assert!(message(vec![(0.0, 0.0)]).contains("1 points"));
    assert!(message(vec![(0.0, 0.0), (-1.0, 0.0)]).contains("point 1: its arc"));
    assert!(message(vec![(0.0, 0.0), (0.0, 1.0), (0.0, 0.0)]).contains("point 2: at most two"));
    assert!(message(vec![(0.0, f64::NAN), (0.0, 1.0)]).contains("point 0: arc and depth"));
}
