//! Every scene that cannot exist is refused with the quantity, its key, its value and the limit.
//!
//! Each test changes one good scene in one place and reads the message as a user would.

mod at_once;
mod bodies;
mod defect;
mod film;
mod keys;
mod rollers;
mod units;
mod words;

use brinell::scene::Scene;

const GOOD: &str = r#"
name = "er16k-tb1"
gravity_m_s2 = [0.0, -9.81]
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
damping = "hunt-crossley"
damping_chi_s_m = 0.5
[cage]
slip = 0.0
initial_angle_deg = -90.0
[defect]
angle_deg = -90.0
length_deg = 15.8
depth_um = 100.0
edge_slope_deg = 90.0
[shaft]
motion = "internal"
speed_hz = 10.0
load_n = [0.0, -500.0]
[housing]
motion = "internal"
stiffness_n_m = 1.51056e7
[sensor]
mass_kg = 1.0
[solver]
tolerance = 1e-5
[recorder]
rate_hz = 51200.0
[experiment]
stop_s = 0.1
step_s = 1e-4
"#;

/// The message for the good scene with `old` replaced by `new`.
#[track_caller]
fn message(old: &str, new: &str) -> String {
    assert_eq!(GOOD.matches(old).count(), 1, "`{old}` must stand once in the good scene");
    match brinell_scene_file::from_toml(&GOOD.replace(old, new)) {
        Ok(_) => panic!("`{new}` was accepted"),
        Err(error) => error.to_string(),
    }
}

#[track_caller]
fn refused(old: &str, new: &str, parts: &[&str]) {
    let message = message(old, new);
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[track_caller]
fn accepted(old: &str, new: &str) -> Scene {
    assert_eq!(GOOD.matches(old).count(), 1, "`{old}` must stand once in the good scene");
    match brinell_scene_file::from_toml(&GOOD.replace(old, new)) {
        Ok(scene) => scene,
        Err(error) => panic!("`{new}` was refused: {error}"),
    }
}

#[test]
fn the_scene_that_every_test_here_spoils_is_good() {
    brinell_scene_file::from_toml(GOOD).unwrap();
}

#[test]
fn broken_toml_is_refused_with_its_line() {
    refused("[bearing]", "[bearing", &["line 4"]);
}

#[test]
fn a_value_of_the_wrong_type_is_refused_with_its_line() {
    refused("element_count = 9", "element_count = -9", &["line 5", "-9"]);
    refused("element_count = 9", "element_count = 9.5", &["line 5", "9.5"]);
    refused("speed_hz = 10.0", "speed_hz = \"10\"", &["line 27"]);
}

#[test]
fn a_name_that_cannot_be_a_file_name_is_refused() {
    for name in ["", "a/b", "a b", "é", &"x".repeat(65)] {
        refused("er16k-tb1", name, &[&format!("name \"{name}\""), "1 to 64"]);
    }
}

#[test]
fn a_bearing_without_elements_is_refused() {
    refused("element_count = 9", "element_count = 0", &["bearing.element_count", "is 0", "at least 1"]);
}

#[test]
fn negative_quantities_are_refused() {
    let minus = |key: &str, of: &str, limit: &str| {
        let old = GOOD.lines().find(|line| line.starts_with(key)).unwrap();
        refused(old, &format!("{key} = -1.5"), &[of, "is -1.5", limit]);
    };
    minus("element_diameter_mm", "element diameter (bearing.element_diameter_mm)", "at least 0.01");
    minus("pitch_diameter_mm", "pitch diameter (bearing.pitch_diameter_mm)", "at least 0.01");
    minus("youngs_modulus_gpa", "Young's modulus (bearing.youngs_modulus_gpa)", "at least 0.001");
    minus("density_kg_m3", "density of the elements (bearing.density_kg_m3)", "above 0");
    minus("damping_chi_s_m", "contact damping (contact.damping_chi_s_m)", "at least 0");
    minus("slip", "cage slip (cage.slip)", "at least 0");
    minus("depth_um", "spall depth (defect.depth_um)", "above 0");
    minus("edge_slope_deg", "edge slope (defect.edge_slope_deg)", "above 0");
    minus("stiffness_n_m", "housing stiffness (housing.stiffness_n_m)", "at least 0");
    minus("mass_kg", "sensor mass (sensor.mass_kg)", "at least 1e-9");
    minus("tolerance", "tolerance (solver.tolerance)", "at least 1e-12");
    minus("rate_hz", "recorder rate (recorder.rate_hz)", "above 0");
    minus("stop_s", "stop time (experiment.stop_s)", "above 0");
    minus("step_s", "communication step (experiment.step_s)", "above 0");
}

#[test]
fn a_recorder_that_filters_has_a_lowest_rate_and_a_known_filter() {
    let rate = GOOD.lines().find(|line| line.starts_with("rate_hz")).unwrap();
    refused(rate, "rate_hz = 99.0", &["recorder.rate_hz", "linear-phase", "is 99", "at least 100"]);
    refused(rate, &format!("{rate}\nfilter = \"butterworth\""), &["butterworth", "linear-phase", "none"]);
    assert!(brinell_scene_file::from_toml(&GOOD.replace(rate, "rate_hz = 99.0\nfilter = \"none\"")).is_ok());
}

#[test]
fn no_quantity_may_be_nan_or_infinite() {
    let of = |value: &str, line: &str| {
        let (key, _) = line.split_once(" = ").unwrap();
        let spoilt = format!("{key} = {value}");
        let message = message(&format!("\n{line}\n"), &format!("\n{spoilt}\n"));
        let shown = if value == "nan" { "NaN" } else { "inf" };
        assert!(message.contains(key) && message.contains(shown), "{spoilt}: {message}");
    };
    let number = |line: &&str| {
        line.split_once(" = ").is_some_and(|(key, value)| key != "element_count" && value.parse::<f64>().is_ok())
    };
    let lines: Vec<&str> = GOOD.lines().filter(number).collect();
    assert_eq!(lines.len(), 21);
    for line in lines {
        of("nan", line);
        of("inf", line);
    }
    refused("[0.0, -9.81]", "[nan, -9.81]", &["gravity (gravity_m_s2) is NaN"]);
    refused("[0.0, -500.0]", "[0.0, inf]", &["load on the shaft (shaft.load_n) is inf"]);
}

#[test]
fn a_spall_length_is_told_by_the_key_that_is_given() {
    refused("length_deg = 15.8", "length_deg = -1.0", &["spall length (defect.length_deg) is -1:", "above 0"]);
    refused("length_deg = 15.8", "length_mm = nan", &["spall length, in mm (defect.length_mm) is NaN"]);
}

#[test]
fn elements_that_overlap_on_the_pitch_circle_are_refused() {
    // 39.32 mm × sin(π/16) = 7.67095 mm.
    let parts = ["element diameter (bearing.element_diameter_mm) is 7.94", "16 elements", "39.32 mm", "above 7.67095"];
    refused("element_count = 9", "element_count = 16", &parts);
    accepted("element_count = 9", "element_count = 15");
    for (pitch, meant) in [("0.03932", "39.32 mm given in metres?"), ("1.548", "39.3192 mm given in inches?")] {
        let parts = ["on a pitch circle of", meant];
        refused("pitch_diameter_mm = 39.32", &format!("pitch_diameter_mm = {pitch}"), &parts);
    }
}

#[test]
fn a_groove_narrower_than_the_element_is_refused() {
    let parts = ["inner ring", "bearing.groove_diameter_mm", "is 0.49", "at least 0.5001"];
    refused("groove_diameter_mm = 8.19", "groove_diameter_mm = 7.7812", &parts);
    refused("groove_diameter_mm = 8.19", "groove_diameter_mm = 7.94", &["is 0.5:"]);
    let outer = "conformity_inner = 0.52\nconformity_outer = 0.5";
    refused("groove_diameter_mm = 8.19", outer, &["outer ring", "conformity_outer", "is 0.5:"]);
}

#[test]
fn groove_diameter_and_conformity_exclude_each_other() {
    let both = "groove_diameter_mm = 8.19\nconformity_inner = 0.52\nconformity_outer = 0.52";
    refused("groove_diameter_mm = 8.19", both, &["bearing.groove_diameter_mm and bearing.conformity_inner"]);
    refused("groove_diameter_mm = 8.19", "", &["one of bearing.groove_diameter_mm and bearing.conformity_inner"]);
    let half = "conformity_inner = 0.52";
    refused("groove_diameter_mm = 8.19", half, &["bearing.conformity_outer is missing"]);
}

#[test]
fn a_preload_beyond_the_elastic_range_leaves_no_room() {
    // 0.0075 × 7.94 mm = 59.55 µm.
    let parts = ["radial clearance (bearing.radial_clearance_um) is -60", "below -59.55", "overlap"];
    refused("radial_clearance_um = 5.0", "radial_clearance_um = -60.0", &parts);
    refused("radial_clearance_um = 5.0", "radial_clearance_um = -9000.0", &["is -9000"]);
    let parts = ["is -250", "bearing.internal_clearance_um is twice as much"];
    refused("radial_clearance_um = 5.0", "internal_clearance_um = -500.0", &parts);
}

#[test]
fn usual_preloads_and_very_loose_bearings_are_accepted() {
    for clearance in ["-20.0", "-5.0", "0.0", "1000.0", "3970.0"] {
        accepted("radial_clearance_um = 5.0", &format!("radial_clearance_um = {clearance}"));
    }
}

#[test]
fn a_clearance_above_the_elements_radius_is_refused() {
    let parts = ["bearing.radial_clearance_um) is 3971", "at most 3970"];
    refused("radial_clearance_um = 5.0", "radial_clearance_um = 3971.0", &parts);
    let parts = ["is 4500", "at most 3970", "bearing.internal_clearance_um is twice as much"];
    refused("radial_clearance_um = 5.0", "internal_clearance_um = 9000.0", &parts);
}

#[test]
fn a_pitch_circle_without_room_for_an_inner_raceway_is_refused() {
    let text = GOOD.replace("element_count = 9", "element_count = 2").replace("39.32", "7.941");
    let message = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
    assert!(message.contains("(bearing.pitch_diameter_mm) is 7.941") && message.contains("above 7.945"), "{message}");
}

#[test]
fn poissons_ratio_lies_between_minus_1_and_one_half() {
    for value in ["-1.0", "0.5"] {
        let parts = ["Poisson's ratio (bearing.poissons_ratio)", "above -1 and below 0.5"];
        refused("poissons_ratio = 0.3", &format!("poissons_ratio = {value}"), &parts);
    }
    accepted("poissons_ratio = 0.3", "poissons_ratio = 0.0");
}

#[test]
fn an_element_needs_a_density_or_a_mass() {
    let parts = ["one of bearing.density_kg_m3 and bearing.element_mass_g"];
    refused("density_kg_m3 = 7800.0", "", &parts);
    refused("density_kg_m3 = 7800.0", "element_mass_g = 0.0", &["is 0:", "at least 1e-9"]);
    // 2.044 g to four digits, so the density to half a unit in the fourth: 2e-4.
    let scene = accepted("density_kg_m3 = 7800.0", "element_mass_g = 2.044");
    assert!((scene.bearing.density / 7800.0 - 1.0).abs() < 3e-4, "{}", scene.bearing.density);
}

#[test]
fn hertz_constants_that_override_must_be_positive() {
    let with = |key: &str| format!("density_kg_m3 = 7800.0\n{key} = 0.0");
    for key in ["hertz_inner_n_m1_5", "hertz_outer_n_m1_5"] {
        refused("density_kg_m3 = 7800.0", &with(key), &[key, "is 0:", "at least 1"]);
    }
}

#[test]
fn an_outer_compliance_is_neither_negative_nor_that_of_a_rubber_mount() {
    let with = |value: &str| format!("density_kg_m3 = 7800.0\nouter_compliance_m_n = {value}");
    for (value, shown) in [("-0.001", "is -0.001:"), ("0.01", "is 0.01:")] {
        refused("density_kg_m3 = 7800.0", &with(value), &["bearing.outer_compliance_m_n", shown, "0", "0.001"]);
    }
    accepted("density_kg_m3 = 7800.0", &with("6.5e-8"));
}

#[test]
fn a_damping_constant_of_the_other_model_is_refused() {
    let parts = ["contact.damping_tau_s = 0.001", "\"hunt-crossley\"", "contact.damping_chi_s_m"];
    refused("damping_chi_s_m = 0.5", "damping_tau_s = 1e-3", &parts);
    let parts = ["contact.damping_chi_s_m = 0.5", "\"proportional\"", "contact.damping_tau_s"];
    refused("\"hunt-crossley\"", "\"proportional\"", &parts);
    let none = "damping = \"hunt-crossley\"\ndamping_chi_s_m = 0.5";
    refused(none, "damping = \"proportional\"", &["contact.damping_tau_s is missing"]);
    refused(none, "damping = \"proportional\"\ndamping_tau_s = -1.0", &["contact.damping_tau_s) is -1"]);
    accepted(none, "damping = \"proportional\"\ndamping_tau_s = 1e-5");
}

#[test]
fn a_cage_slips_between_0_and_1() {
    refused("slip = 0.0", "slip = 1.01", &["cage slip (cage.slip) is 1.01", "at most 1"]);
    accepted("slip = 0.0", "slip = 1.0");
}

#[test]
fn a_load_on_a_ring_that_is_not_internal_is_refused() {
    for motion in ["host", "fixed"] {
        let parts = ["shaft.load_n = [0.0, -500.0]", &format!("shaft.motion is \"{motion}\""), "\"internal\""];
        refused("motion = \"internal\"\nspeed_hz", &format!("motion = \"{motion}\"\nspeed_hz"), &parts);
    }
    let mut scene = brinell_scene_file::from_toml(GOOD).unwrap();
    scene.shaft.motion = brinell::scene::Motion::Host;
    let message = scene.check().unwrap_err().to_string();
    assert!(message.contains("(shaft.load_n) is [0, -500]: it must be [0, 0]"), "{message}");
}

#[test]
fn mass_damping_or_stiffness_of_a_ring_that_is_not_internal_are_refused() {
    let ring = "motion = \"internal\"\nstiffness_n_m = 1.51056e7";
    for key in ["mass_kg", "damping_n_s_m", "stiffness_n_m"] {
        let parts = [&format!("housing.{key} = 2"), "housing.motion is \"host\""];
        refused(ring, &format!("motion = \"host\"\n{key} = 2.0"), &parts.map(|part| part as &str));
    }
}

#[test]
fn a_ring_without_mass_is_refused() {
    refused("stiffness_n_m = 1.51056e7", "mass_kg = 0.0", &["housing mass (housing.mass_kg) is 0", "at least 1e-6"]);
    // A host may set no less either: the model description would have a start value beyond its limit.
    refused(
        "stiffness_n_m = 1.51056e7",
        "mass_kg = 1e-7",
        &["housing mass (housing.mass_kg) is 1e-7", "at least 1e-6"],
    );
}

#[test]
fn two_rings_that_nothing_holds_are_refused() {
    let parts = ["shaft.stiffness_n_m, housing.stiffness_n_m", "is 0"];
    refused("stiffness_n_m = 1.51056e7", "stiffness_n_m = 0.0", &parts);
}

#[test]
fn a_sensor_on_a_fixed_housing_is_refused() {
    let ring = "motion = \"internal\"\nstiffness_n_m = 1.51056e7";
    refused(ring, "motion = \"fixed\"", &["sensor", "housing.motion is \"fixed\""]);
    accepted(ring, "motion = \"host\"");
}

#[test]
fn a_sensor_without_a_spring_is_refused() {
    let parts = ["sensor stiffness (sensor.stiffness_n_m) is 0", "above 0"];
    refused("mass_kg = 1.0", "stiffness_n_m = 0.0", &parts);
}

#[test]
fn a_tolerance_outside_its_range_is_refused() {
    let parts = ["tolerance (solver.tolerance) is", "at least 1e-12 and at most 0.1"];
    for value in ["0.0", "9e-13", "0.2"] {
        refused("tolerance = 1e-5", &format!("tolerance = {value}"), &parts);
    }
    for value in ["1e-12", "0.1"] {
        accepted("tolerance = 1e-5", &format!("tolerance = {value}"));
    }
}

#[test]
fn a_budget_of_no_step_at_all_is_refused() {
    let parts = ["most integration steps (solver.max_steps) is 0", "at least 1"];
    refused("tolerance = 1e-5", "max_steps = 0", &parts);
    accepted("tolerance = 1e-5", "max_steps = 1");
}

#[test]
fn a_communication_step_beyond_the_stop_time_is_refused() {
    refused("step_s = 1e-4", "step_s = 0.2", &["(experiment.step_s) is 0.2", "at most 0.1"]);
}

#[test]
fn a_value_in_the_wrong_unit_is_refused() {
    // Pascals where gigapascals are asked for; revolutions per minute would pass unless absurd.
    refused("youngs_modulus_gpa = 207.0", "youngs_modulus_gpa = 207e9", &["2.07e11", "at most 10000"]);
    refused("speed_hz = 10.0", "speed_hz = 6e5", &["shaft speed (shaft.speed_hz) is 600000", "at most 10000"]);
}

#[test]
fn a_shaft_may_stand_or_turn_backwards() {
    for speed in ["0.0", "-10.0"] {
        accepted("speed_hz = 10.0", &format!("speed_hz = {speed}"));
    }
}

#[test]
fn a_parameter_that_a_host_spoils_is_refused() {
    let mut scene = brinell_scene_file::from_toml(GOOD).unwrap();
    scene.bearing.radial_clearance = f64::NAN;
    let message = scene.check().unwrap_err().to_string();
    assert!(message.contains("radial clearance (bearing.radial_clearance_um) is NaN"), "{message}");
}
