//! Defects of other bodies than the outer ring, and rings that turn.

use super::{accepted, refused};

/// The good scene's spall.
const SPALL: &str = "length_deg = 15.8\ndepth_um = 100.0\nedge_slope_deg = 90.0\n";

#[test]
fn every_defect_that_cannot_be_is_told_with_its_value_and_the_limit() {
    let cases: [(&str, &[&str]); 13] = [
        ("on = \"element\"\nelement = 10\nlength_mm = 1\ndepth_um = 50", &["defect.element is 10", "1 to 9"]),
        ("on = \"element\"\nelement = 0\nlength_mm = 1\ndepth_um = 50", &["(defect.element) is 0:", "at least 1"]),
        ("on = \"element\"\nlength_mm = 1\ndepth_um = 50", &["defect.element", "defect.on is \"element\""]),
        ("element = 2\nlength_mm = 1\ndepth_um = 50", &["defect.element is 2", "defect.on = \"element\""]),
        ("on = \"inner\"\ntilt_deg = 3\nlength_mm = 1\ndepth_um = 50", &["defect.tilt_deg is 3", "\"element\""]),
        (
            "on = \"element\"\nelement = 1\ntilt_deg = 3\nprofile = \"trace.csv\"",
            &["defect.tilt_deg is 3", "must be 0", "defect.profile"],
        ),
        (
            "on = \"element\"\nelement = 1\ntilt_deg = 10\nlength_mm = 1\ndepth_um = 50",
            &["defect.length_mm) is 1", "defect.tilt_deg", "more than 1.378"],
        ),
        (
            "on = \"element\"\nelement = 1\ntilt_deg = 91\nlength_mm = 1\ndepth_um = 50",
            &["defect.tilt_deg", "91", "90"],
        ),
        (
            "on = \"inner\"\nlength_deg = 324\ndepth_um = 50",
            &["length", "88.7", "mm, nine tenths of the circumference of the inner raceway"],
        ),
        (
            "on = \"element\"\nelement = 1\nlength_mm = 22.5\ndepth_um = 50",
            &["length", "22.5", "mm, nine tenths of the circumference of an element"],
        ),
        (
            "on = \"element\"\nelement = 1\nlength_mm = 3\ndepth_um = 800",
            &["defect.depth_um) is 800", "below 794", "a fifth of the radius of an element"],
        ),
        (
            "on = \"inner\"\nlength_mm = 3\ndepth_um = 4000",
            &["defect.depth_um) is 4000", "below 3970", "the radius of an element"],
        ),
        (
            "on = \"cage\"\nlength_mm = 3\ndepth_um = 40",
            &["defect.on is \"cage\"", "\"outer\", \"inner\", or \"element\""],
        ),
    ];
    for (defect, wanted) in cases {
        refused(SPALL, &format!("{defect}\n"), wanted);
    }
}

#[test]
fn angles_and_speeds_of_rings_must_be_numbers_within_their_limits() {
    let mut without_angle = accepted("slip = 0.0", "slip = 0.0");
    without_angle.shaft_initial_angle = f64::NAN;
    let message = without_angle.check().unwrap_err().to_string();
    assert!(message.contains("shaft.initial_angle_deg") && message.contains("NaN"), "{message}");
    let housing = "[housing]\nmotion = \"internal\"";
    refused(housing, &format!("{housing}\nspeed_hz = 10001.0"), &["housing.speed_hz", "10001", "10000"]);
}
