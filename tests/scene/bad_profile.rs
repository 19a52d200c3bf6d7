//! Measured surfaces that cannot be used, beside those of `answers_to_traces.txt`.

use brinell::scene::{Defect, DefectShape};
use brinell::surface::{Profile, Surface};

#[test]
fn a_missing_file_is_refused_with_its_name() {
    let bearing = brinell_scene_file::from_toml(super::answers::GOOD).unwrap().bearing;
    let defect = Defect::outer(0.0, DefectShape::Profile("trace.csv".into()));
    let message = Surface::load(&defect, None, &bearing).unwrap_err().to_string();
    assert_eq!(message, "defect profile \"trace.csv\": the file is missing");
}

#[test]
fn points_that_describe_no_profile_are_refused() {
    let message = |points| Profile::from_points(points).unwrap_err().to_string();
    assert!(message(vec![(0.0, 0.0)]).contains("1 points"));
    assert!(message(vec![(0.0, 0.0), (-1.0, 0.0)]).contains("point 1: its arc"));
    assert!(message(vec![(0.0, 0.0), (0.0, 1.0), (0.0, 0.0)]).contains("point 2: at most two"));
    assert!(message(vec![(0.0, f64::NAN), (0.0, 1.0)]).contains("point 0: arc and depth"));
}
