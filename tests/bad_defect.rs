//! Defects that cannot be: each is refused with the quantity, its value and the limit.
#![allow(clippy::unwrap_used)]

use brinell::scene::Scene;
use brinell::simulation::Simulation;

const BEARING: &str = r#"
name = "bad"
[bearing]
element_count = 9
element_diameter_mm = 7.94
pitch_diameter_mm = 39.32
groove_diameter_mm = 8.19
radial_clearance_um = 5.0
youngs_modulus_gpa = 207.0
poissons_ratio = 0.3
density_kg_m3 = 7800.0
[contact]
law = "hertz"
[shaft]
motion = "internal"
speed_hz = 10.0
load_n = [0.0, -500.0]
"#;

/// What a scene with these keys of its defect and, after a line `---`, further lines is refused with.
fn refusal(defect: &str) -> String {
    let (defect, more) = defect.split_once("---").unwrap_or((defect, ""));
    let text = format!("{BEARING}{more}\n[housing]\nmotion = \"fixed\"\n[defect]\nangle_deg = 0.0\n{defect}\n");
    match Scene::from_toml(&text).map_err(|error| error.to_string()) {
        Err(message) => message,
        Ok(scene) => Simulation::new(scene, None).unwrap_err().to_string(),
    }
}

#[test]
fn every_defect_that_cannot_be_is_told_with_its_value_and_the_limit() {
    let cases: [(&str, &[&str]); 13] = [
        ("on = \"element\"\nelement = 10\nlength_mm = 1\ndepth_um = 50", &["defect.element is 10", "1 to 9"]),
        ("on = \"element\"\nelement = 0\nlength_mm = 1\ndepth_um = 50", &["defect.element is 0", "1 to 9"]),
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
            &["length", "88.7", "nine tenths of the circumference of the inner raceway"],
        ),
        (
            "on = \"element\"\nelement = 1\nlength_mm = 22.5\ndepth_um = 50",
            &["length", "22.5", "nine tenths of the circumference of an element"],
        ),
        (
            "on = \"element\"\nelement = 1\nlength_mm = 3\ndepth_um = 800",
            &["defect.depth_um) is 800", "below 794", "a fifth of the radius of an element"],
        ),
        (
            "on = \"inner\"\nlength_mm = 3\ndepth_um = 4000",
            &["defect.depth_um) is 4000", "below 3970", "the radius of an element"],
        ),
        ("on = \"cage\"\nlength_mm = 3\ndepth_um = 40", &["unknown variant `cage`", "`outer`, `inner`", "`element`"]),
    ];
    for (defect, wanted) in cases {
        let message = refusal(defect);
        for part in wanted {
            assert!(message.contains(part), "{defect}\n{message}\nlacks {part:?}");
        }
    }
}

#[test]
fn angles_and_speeds_of_rings_must_be_numbers_within_their_limits() {
    let scene = Scene::from_toml(&format!("{BEARING}\n[housing]\nmotion = \"fixed\"\n")).unwrap();
    let mut without_angle = scene.clone();
    without_angle.shaft_initial_angle = f64::NAN;
    let message = without_angle.check().unwrap_err().to_string();
    assert!(message.contains("shaft.initial_angle_deg") && message.contains("NaN"), "{message}");
    let mut too_fast = scene;
    too_fast.housing_speed = Some(1e9);
    let message = too_fast.check().unwrap_err().to_string();
    assert!(message.contains("housing.speed_hz") && message.contains("10000"), "{message}");
}
