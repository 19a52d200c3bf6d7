//! Keys that are unknown, missing, or ask for what is not modelled: all of them at once, with what was meant.

use super::{GOOD, refused};
use brinell::scene::Scene;

#[test]
fn an_unknown_key_is_refused_with_its_line_and_name() {
    refused("slip = 0.0", "slipp = 0.0", &["line 18: cage.slipp is unknown: did you mean slip?"]);
    refused("[solver]", "[solwer]", &["line 34: [solwer] is unknown: did you mean solver?"]);
    // Without its unit, with another one, in the wrong table; and one that nothing is like.
    refused("depth_um = 100.0", "depth = 100.0", &["line 23: defect.depth is unknown: did you mean depth_um?"]);
    refused("speed_hz = 10.0", "speed_rpm = 600.0", &["shaft.speed_rpm is unknown: did you mean speed_hz?"]);
    refused("mass_kg = 1.0", "slip = 1.0", &["sensor.slip is unknown: it belongs to [cage]"]);
    refused("slip = 0.0", "colour = 0.0", &["cage.colour is unknown: known here are slip, initial_angle_deg"]);
}

#[test]
fn all_unknown_and_missing_keys_are_told_at_once() {
    let text = GOOD
        .replace("pitch_diameter_mm = 39.32\n", "")
        .replace("groove_diameter_mm = 8.19\n", "")
        .replace("density_kg_m3", "densty_kg_m3")
        .replace("slip = 0.0", "slipp = 0.0")
        .replace("depth_um = 100.0\n", "")
        .replace("[housing]\nmotion = \"internal\"\nstiffness_n_m = 1.51056e7\n", "");
    let message = Scene::from_toml(&text).unwrap_err().to_string();
    let lines: Vec<&str> = message.lines().collect();
    let expected = [
        "scene file: 6 faults",
        "  [housing] is missing, it needs at least motion",
        "  line 4: bearing.pitch_diameter_mm is missing",
        "  line 4: one of bearing.groove_diameter_mm and bearing.conformity_inner is needed, neither is given",
        // Meant, so not missing as well.
        "  line 10: bearing.densty_kg_m3 is unknown: did you mean density_kg_m3?",
        "  line 16: cage.slipp is unknown: did you mean slip?",
        "  line 18: one of defect.depth_um and defect.profile is needed, neither is given",
    ];
    assert_eq!(lines, expected, "{message}");
}

#[test]
fn an_empty_file_is_told_all_that_it_needs() {
    let message = Scene::from_toml("").unwrap_err().to_string();
    for part in
        ["4 faults", "name is missing", "[bearing] is missing, it needs at least element_count, ", "motion, speed_hz"]
    {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn a_defect_said_in_other_words_is_answered_with_how_it_is_said() {
    let only = "not modelled: defects are said by a table [defect], or by several [[defect]], whose key `on` is \"outer\", \
                \"inner\" or \"element\"";
    let angle = "angle_deg = -90.0\nlength_deg";
    for key in ["race", "raceway", "location", "ring", "inner", "on_ring"] {
        let more = format!("angle_deg = -90.0\n{key} = \"inner\"\nlength_deg");
        refused(angle, &more, &[&format!("line 22: defect.{key} is {only}")]);
    }
    for table in ["inner_defect", "defect_inner", "inner-race", "defects", "spall"] {
        refused("[solver]", &format!("[{table}]\nlength_deg = 3.0\n[solver]"), &[&format!("[{table}] is {only}")]);
    }
    // A trace is no race.
    refused(angle, "angle_deg = -90.0\ntrace = \"a.csv\"\nlength_deg", &["defect.trace is unknown"]);
    refused("[shaft]", "[defect.inner]\nlength_deg = 3.0\n[shaft]", &[&format!("[defect.inner] is {only}")]);
}

#[test]
fn rollers_are_answered_with_balls_and_other_wishes_with_what_there_is() {
    let with = |key: &str| format!("element_count = 9\n{key}");
    for key in
        ["element = \"roller\"", "roller_length_mm = 8.0", "element_type = \"roller\"", "element_length_mm = 8.0"]
    {
        let name = key.split(' ').next().unwrap();
        refused(
            "element_count = 9",
            &with(key),
            &[&format!("bearing.{name} is not modelled: rolling elements are balls")],
        );
    }
    // A catalogue's name for a bearing of rollers, or of balls.
    for key in ["bearing_type = \"NU205\"", "designation = \"NU 205 ECP\"", "series = \"NJ\"", "model = \"22210\""] {
        let name = key.split(' ').next().unwrap();
        let balls = "not modelled: a bearing is given by its dimensions or by bearing.catalogue, and its rolling elements are balls";
        refused("element_count = 9", &with(key), &[&format!("bearing.{name} is {balls}")]);
        refused("[bearing]", &format!("{key}\n[bearing]"), &[&format!("{name} is {balls}")]);
    }
    refused("element_count = 9", &with("contact_angle_deg = 15.0"), &["no axial load, no contact angle"]);
    refused("element_count = 9", &with("lubricant = \"oil\""), &["contacts without lubricant"]);
    // A slip of the pen is none of these.
    refused("element_count = 9", "element_cout = 9", &["bearing.element_cout is unknown: did you mean element_count?"]);
}

#[test]
fn a_name_that_the_catalogue_has_not_is_refused_with_those_that_it_has() {
    let named = |name: &str| format!("catalogue = \"{name}\"\nelement_count = 9");
    for name in ["6299", "NU205", ""] {
        refused(
            "element_count = 9",
            &named(name),
            &[&format!("bearing.catalogue = {name:?} is no"), "6204, 6205, 6206"],
        );
    }
}

#[test]
fn a_vector_of_the_plane_has_two_components_neither_fewer_nor_more() {
    for list in ["[0.0, -500.0, 0.0]", "[-500.0]", "[]"] {
        refused("load_n = [0.0, -500.0]", &format!("load_n = {list}"), &["invalid length", "a list of two values"]);
    }
}

#[test]
fn a_missing_key_is_refused_with_its_name() {
    refused("pitch_diameter_mm = 39.32", "", &["line 4: bearing.pitch_diameter_mm is missing"]);
    refused("motion = \"internal\"\nspeed_hz", "speed_hz", &["line 25: shaft.motion is missing"]);
}

#[test]
fn a_missing_table_is_refused_with_its_name() {
    refused(
        "[housing]\nmotion = \"internal\"\nstiffness_n_m = 1.51056e7",
        "",
        &["[housing] is missing, it needs at least motion"],
    );
}
