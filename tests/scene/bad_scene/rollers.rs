//! Cylindrical rollers that cannot be, or that the lamina law is not for.

use super::GOOD;
use brinell::scene::{Roller, RollerProfile, Scene};

const BALLS: &str = "groove_diameter_mm = 8.19";
const ROLLERS: &str = "element = \"cylindrical-roller\"\nroller_length_mm = 9.0";

/// The good scene with rollers, then with `old` replaced by `new`.
fn read(old: &str, new: &str) -> Result<Scene, String> {
    let rollers = GOOD.replace(BALLS, ROLLERS);
    assert_eq!(rollers.matches(old).count(), 1, "`{old}` must stand once");
    brinell_scene_file::from_toml(&rollers.replace(old, new)).map_err(|error| error.to_string())
}

#[track_caller]
fn refused(old: &str, new: &str, parts: &[&str]) {
    let Err(message) = read(old, new) else { panic!("`{new}` was accepted") };
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn rollers_are_crowned_and_cut_into_forty_laminae_where_nothing_else_is_said() {
    let roller = |new: &str| read("roller_length_mm = 9.0", new).unwrap().bearing.roller().unwrap().clone();
    let usual = Roller { length: 9e-3, profile: RollerProfile::Logarithmic, laminae: 40 };
    assert_eq!(roller("roller_length_mm = 9.0"), usual);
    assert_eq!(roller("roller_length_mm = 9.0\nroller_profile = \"log\""), usual);
    let straight = roller("roller_length_mm = 9.0\nroller_profile = \"straight\"\nroller_laminae = 10");
    assert_eq!(straight, Roller { profile: RollerProfile::Straight, laminae: 10, ..usual });
}

#[test]
fn a_roller_shorter_than_a_disc_or_longer_than_three_diameters_is_refused() {
    for (length, value) in [("2.3", "is 2.3"), ("24.0", "is 24"), ("-9.0", "is -9")] {
        let line = format!("roller_length_mm = {length}");
        refused("roller_length_mm = 9.0", &line, &["bearing.roller_length_mm", value, "at least"]);
    }
    refused("roller_length_mm = 9.0", "roller_length_mm = 24.0", &["2.382", "23.82", "needle"]);
    assert!(read("roller_length_mm = 9.0", "roller_length_mm = 23.82").is_ok());
}

#[test]
fn too_few_laminae_are_refused() {
    let laminae = |count: &str| format!("roller_length_mm = 9.0\nroller_laminae = {count}");
    refused("roller_length_mm = 9.0", &laminae("9"), &["bearing.roller_laminae", "is 9", "at least 10"]);
    refused("roller_length_mm = 9.0", &laminae("1001"), &["is 1001", "at most 1000"]);
}

#[test]
fn a_relief_that_is_not_known_is_refused() {
    let cubic = "roller_length_mm = 9.0\nroller_profile = \"cubic\"";
    refused("roller_length_mm = 9.0", cubic, &["bearing.roller_profile", "\"cubic\"", "\"log\"", "\"straight\""]);
}

#[test]
fn a_measured_crown_has_a_plain_name_and_near_a_defect_the_law_hertz() {
    let crowned = |name: &str| format!("roller_length_mm = 9.0\nroller_profile = \"{name}\"");
    assert!(read("roller_length_mm = 9.0", &crowned("crown.csv")).is_ok());
    refused("roller_length_mm = 9.0", &crowned("../crown.csv"), &["bearing.roller_profile", "without a folder"]);
    let law = GOOD.replace(BALLS, ROLLERS).replace("roller_length_mm = 9.0", &crowned("crown.csv"));
    let message =
        brinell_scene_file::from_toml(&law.replace("law = \"hertz\"", "law = \"map\"")).unwrap_err().to_string();
    assert!(message.contains("contact.law is \"map\"") && message.contains("crown.csv"), "{message}");
}

#[test]
fn grooves_and_hertz_constants_of_balls_are_refused_with_rollers() {
    for key in
        ["groove_diameter_mm", "conformity_inner", "conformity_outer", "hertz_inner_n_m1_5", "hertz_outer_n_m1_5"]
    {
        let line = format!("roller_length_mm = 9.0\n{key} = 8.19");
        refused("roller_length_mm = 9.0", &line, &[&format!("bearing.{key}"), "only balls", "cylindrical-roller"]);
    }
}

#[test]
fn keys_of_rollers_are_refused_with_balls() {
    for line in ["roller_length_mm = 9.0", "roller_profile = \"log\"", "roller_laminae = 40"] {
        let text = GOOD.replace(BALLS, &format!("{BALLS}\n{line}"));
        let message = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
        let key = format!("bearing.{}", line.split(' ').next().unwrap());
        assert!(message.contains(&key) && message.contains("cylindrical-roller"), "{message}");
    }
}

#[test]
fn rollers_need_their_length_and_no_groove() {
    refused("\nroller_length_mm = 9.0", "", &["bearing.roller_length_mm", "missing"]);
    let message = read("\nroller_length_mm = 9.0", "").unwrap_err();
    assert!(!message.contains("groove"), "{message}");
    refused("roller_length_mm", "roller_lenght_mm", &["bearing.roller_lenght_mm", "did you mean roller_length_mm?"]);
    // Together with another fault of the keys both are told.
    let both = read("\nroller_length_mm = 9.0", "\nlenght = 3").unwrap_err();
    assert!(both.contains("roller_length_mm") && both.contains("lenght") && !both.contains("one of"), "{both}");
}

#[test]
fn another_kind_of_roller_is_refused_with_those_that_there_are() {
    refused("\"cylindrical-roller\"", "\"tapered-roller\"", &["tapered-roller", "\"cylindrical-roller\"", "\"ball\""]);
}

#[test]
fn rollers_of_another_material_than_steel_are_refused() {
    for modulus in ["199.0", "213.0", "310.0"] {
        let line = format!("youngs_modulus_gpa = {modulus}");
        refused("youngs_modulus_gpa = 207.0", &line, &["bearing.youngs_modulus_gpa", "steel", "at least 200"]);
    }
    refused("poissons_ratio = 0.3", "poissons_ratio = 0.28", &["bearing.poissons_ratio", "is 0.28", "steel"]);
}

#[test]
fn a_defect_off_a_rollers_track_is_refused() {
    let tilted = "on = \"element\"\nelement = 1\ntilt_deg = 3.0\nangle_deg = -90.0\nlength_mm = 1.0";
    refused("angle_deg = -90.0\nlength_deg = 15.8", tilted, &["defect.tilt_deg", "is 3", "roller"]);
}

#[test]
fn tilt_and_axial_load_are_refused_as_not_modelled() {
    refused("speed_hz = 10.0", "speed_hz = 10.0\naxial_load_n = 10.0", &["axial", "one plane"]);
    refused("roller_length_mm = 9.0", "roller_length_mm = 9.0\nmisalignment_deg = 0.1", &["misalignment", "one plane"]);
}

#[test]
fn a_bearing_of_the_catalogue_does_not_become_one_with_other_elements() {
    let rollers = "element = \"cylindrical-roller\"\ncatalogue = \"6205\"";
    refused("element = \"cylindrical-roller\"", rollers, &["6205", "balls", "bearing.element"]);
    let balls = "element = \"ball\"\ncatalogue = \"NU205\"";
    refused("element = \"cylindrical-roller\"", balls, &["NU205", "cylindrical rollers", "bearing.element"]);
}

#[test]
fn a_roller_bearing_of_the_catalogue_needs_nothing_beside_its_name() {
    let named = |keys: &str| {
        let from = GOOD.find("element_count").unwrap();
        let to = GOOD.find("[contact]").unwrap();
        brinell_scene_file::from_toml(&format!("{}{keys}\n{}", &GOOD[..from], &GOOD[to..])).map(|scene| scene.bearing)
    };
    let bearing = named("catalogue = \"NU 205 ECP\"").unwrap();
    let roller = bearing.roller().unwrap();
    assert_eq!((bearing.element_count, bearing.element_diameter, roller.length), (13, 7.5e-3, 9e-3));
    assert_eq!(roller.profile, RollerProfile::Logarithmic);
    let straight = named("catalogue = \"NU205\"\nroller_profile = \"straight\"\nroller_length_mm = 8.5").unwrap();
    assert_eq!(straight.roller().unwrap().length, 8.5e-3);
    let groove = named("catalogue = \"NU205\"\nconformity_inner = 0.52").unwrap_err().to_string();
    assert!(groove.contains("conformity_inner") && groove.contains("only balls"), "{groove}");
}

#[test]
fn what_is_worked_out_for_balls_only_is_refused_of_rollers() {
    let film = "[film]\nviscosity_pa_s = 0.04\npressure_viscosity_1_pa = 2e-8\n[cage]";
    refused("[cage]", film, &["[film]: it is worked out for balls only", "cylindrical-roller"]);
    refused("[contact]", "[contact]\nedge = \"step\"", &["contact.edge = \"step\": it is worked out for balls only"]);
}
