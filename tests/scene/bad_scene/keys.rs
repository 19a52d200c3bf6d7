//! Keys that are unknown, missing, or ask for what is not modelled: all of them at once, with what was meant.

use super::{GOOD, refused};

#[test]
fn an_unknown_key_is_refused_with_its_line_and_name() {
    refused("slip = 0.0", "slipp = 0.0", &["line 18: cage.slipp is unknown: did you mean slip?"]);
    refused("[solver]", "[solwer]", &["line 34: [solwer] is unknown: did you mean solver?"]);
    // Without its unit, with another one, in the wrong table; and one that nothing is like.
    refused("depth_um = 100.0", "depth = 100.0", &["line 23: defect.depth is unknown: did you mean depth_um?"]);
    refused("speed_hz = 10.0", "speed_rpm = 600.0", &["shaft.speed_rpm is unknown: did you mean speed_hz?"]);
    refused("mass_kg = 1.0", "slip = 1.0", &["sensor.slip is unknown: it belongs to [cage]"]);
    refused("slip = 0.0", "colour = 0.0", &["cage.colour is unknown: known here are initial_angle_deg, irregularity"]);
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
    let message = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
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
    let message = brinell_scene_file::from_toml("").unwrap_err().to_string();
    for part in
        ["4 faults", "name is missing", "[bearing] is missing, it needs at least element_count, ", "motion, speed_hz"]
    {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn a_defect_said_in_other_words_is_answered_with_how_it_is_said() {
    let only = "not modelled: defects are said by a table [defect], or by several [[defect]], whose key `on` \
                is \"outer\", \"inner\" or \"element\"";
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
fn other_elements_are_answered_with_those_that_there_are_and_other_wishes_with_what_there_is() {
    let with = |key: &str| format!("element_count = 9\n{key}");
    for key in ["needle_length_mm = 8.0", "rollers = 9", "element_type = \"roller\"", "element_length_mm = 8.0"] {
        let name = key.split(' ').next().unwrap();
        let elements = "not modelled: rolling elements are said by bearing.element, \"ball\" or \"cylindrical-roller\"";
        refused("element_count = 9", &with(key), &[&format!("bearing.{name} is {elements}")]);
    }
    // A catalogue's name for a bearing, by another key than the catalogue's.
    for key in ["bearing_type = \"NU205\"", "designation = \"NU 205 ECP\"", "series = \"NJ\"", "model = \"22210\""] {
        let name = key.split(' ').next().unwrap();
        let by_name = "not modelled: a bearing is given by its dimensions or by bearing.catalogue, its rolling \
                       elements by bearing.element";
        refused("element_count = 9", &with(key), &[&format!("bearing.{name} is {by_name}")]);
        refused("[bearing]", &format!("{key}\n[bearing]"), &[&format!("{name} is {by_name}")]);
    }
    refused("element_count = 9", &with("contact_angle_deg = 15.0"), &["no axial load, no contact angle"]);
    refused("element_count = 9", &with("lubricant = \"oil\""), &["an oil film is said by a table [film]"]);
    // A slip of the pen is none of these.
    refused("element_count = 9", "element_cout = 9", &["bearing.element_cout is unknown: did you mean element_count?"]);
}

#[test]
fn a_name_that_the_catalogue_has_not_is_refused_with_those_that_it_has() {
    let named = |name: &str| format!("catalogue = \"{name}\"\nelement_count = 9");
    for name in ["6299", "NU299", "22205", ""] {
        refused(
            "element_count = 9",
            &named(name),
            &[&format!("bearing.catalogue = {name:?} is no"), "6204, 6205, 6206"],
        );
    }
}

#[test]
fn a_vector_of_the_plane_has_two_components_neither_fewer_nor_more() {
    for (list, given) in [("[0.0, -500.0, 0.0]", "3 values"), ("[-500.0]", "one value"), ("[]", "0 values")] {
        let parts =
            [&format!("line 28: shaft.load_n is a list of {given}: ") as &str, "it must be a list of two numbers"];
        refused("load_n = [0.0, -500.0]", &format!("load_n = {list}"), &parts);
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

/// Four bodies, two rings and a run with something wrong each.
fn spoilt() -> String {
    GOOD.replace("element_diameter_mm = 7.94", "element_diameter_mm = -1.5")
        .replace("poissons_ratio = 0.3", "poissons_ratio = 0.7")
        .replace("damping_chi_s_m = 0.5", "damping_chi_s_m = -0.5")
        .replace("depth_um = 100.0", "depth_um = 0")
        .replace("load_n = [0.0, -500.0]", "load_n = [0.0, nan]")
        .replace("step_s = 1e-4", "step_s = 2e9")
}

const OF_VALUES: [&str; 6] = [
    "  line 6: element diameter (bearing.element_diameter_mm) is -1.5: it must be at least 0.01 and at most 2000",
    "  line 11: Poisson's ratio (bearing.poissons_ratio) is 0.7: it must be above -1 and below 0.5",
    "  line 16: contact damping (contact.damping_chi_s_m) is -0.5: it must be at least 0 and at most 1000",
    "  line 23: spall depth (defect.depth_um) is 0: it must be above 0 and at most 1e9",
    "  line 28: load on the shaft (shaft.load_n) is NaN: it must be at least -1e9 and at most 1e9",
    "  line 40: communication step (experiment.step_s) is 2e9: it must be above 0 and at most 1e9",
];

#[test]
fn all_values_outside_their_limits_are_told_at_once() {
    let message = brinell_scene_file::from_toml(&spoilt()).unwrap_err().to_string();
    let lines: Vec<&str> = message.lines().collect();
    assert_eq!(lines[0], "scene file: 6 faults", "{message}");
    assert_eq!(lines[1..], OF_VALUES, "{message}");
}

#[test]
fn wrong_keys_do_not_hide_wrong_values_nor_values_wrong_keys() {
    let text = spoilt()
        .replace("edge_slope_deg", "edge_slop_deg")
        .replace("speed_hz = 10.0\n", "")
        .replace("mass_kg = 1.0", "mass_kg = \"1.0\"");
    let message = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
    let parts = [
        "9 faults",
        "defect.edge_slop_deg is unknown: did you mean edge_slope_deg?",
        "shaft.speed_hz is missing",
        "line 32: sensor.mass_kg is \"1.0\": it must be a number, without quotes",
    ];
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn faults_that_concern_several_values_are_told_beside_one_another() {
    let text = GOOD
        .replace("length_deg = 15.8", "length_deg = 400.0")
        .replace("depth_um = 100.0", "depth_um = 5000.0")
        .replace("stop_s = 0.1", "stop_s = 1e-5")
        .replace("stiffness_n_m = 1.51056e7", "stiffness_n_m = 0.0");
    let message = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
    let parts =
        ["4 faults", "spall length (", "spall depth (", "it must be at most 0.00001", "nothing holds the bearing"];
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
    // Keys that exclude each other hide neither a wrong value nor those of another table.
    let text = GOOD
        .replace("groove_diameter_mm = 8.19", "groove_diameter_mm = 8.19\nconformity_inner = 0.52")
        .replace("motion = \"internal\"\nspeed_hz", "motion = \"host\"\nmass_kg = 3.0\nspeed_hz")
        .replace("tolerance = 1e-5", "tolerance = 1.0");
    let message = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
    for part in [
        "4 faults",
        "bearing.groove_diameter_mm and bearing.conformity_inner exclude each other",
        "shaft.load_n = [0.0, -500.0] has no effect",
        "shaft.mass_kg = 3 has no effect",
        "line 37: tolerance (solver.tolerance) is 1: it must be",
    ] {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn one_fault_is_told_with_its_line_and_what_follows_from_it_is_not() {
    // The diameter alone: groove, clearance and overlap would be wrong because of it.
    let text = GOOD.replace("element_diameter_mm = 7.94", "element_diameter_mm = -1.5");
    let message = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
    let wanted = "scene file: line 6: element diameter (bearing.element_diameter_mm) is -1.5: it must be";
    assert!(message.starts_with(wanted), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
}
