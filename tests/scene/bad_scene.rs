//! What holds of all messages, and of scenes that are made or changed without a file. Each message by itself:
//! `answers_to_scenes.txt`.

use super::answers::GOOD;
use brinell::scene::{Motion, Roller, RollerProfile, Scene};

const BALLS: &str = "groove_diameter_mm = 8.19";
const ROLLERS: &str = "element = \"cylindrical-roller\"\nroller_length_mm = 9.0";

/// The good scene with these changes, as it is read.
#[track_caller]
fn read(changes: &[(&str, &str)]) -> Result<Scene, String> {
    let text = changes.iter().fold(GOOD.to_owned(), |text, (old, new)| {
        assert_eq!(text.matches(old).count(), 1, "`{old}` must stand once");
        text.replace(old, new)
    });
    brinell_scene_file::from_toml(&text).map_err(|error| error.to_string())
}

#[track_caller]
fn refused(changes: &[(&str, &str)]) -> String {
    read(changes).err().unwrap_or_else(|| panic!("{changes:?} were accepted"))
}

#[test]
fn no_quantity_may_be_nan_or_infinite() {
    let number = |line: &&str| {
        line.split_once(" = ").is_some_and(|(key, value)| key != "element_count" && value.parse::<f64>().is_ok())
    };
    let lines: Vec<&str> = GOOD.lines().filter(number).collect();
    assert_eq!(lines.len(), 21);
    for line in lines {
        let (key, _) = line.split_once(" = ").unwrap();
        for (value, shown) in [("nan", "NaN"), ("inf", "inf")] {
            let spoilt = format!("\n{key} = {value}\n");
            let message = refused(&[(&format!("\n{line}\n"), &spoilt)]);
            assert!(message.contains(key) && message.contains(shown), "{spoilt}: {message}");
        }
    }
}

#[test]
fn no_message_has_words_of_the_language_that_the_program_is_written_in() {
    const HUGE: &str = "999999999999999999999999999999999999999999";
    let values =
        "true|\"x\"|[]|[1, \"a\"]|1979-05-27|{ a = 1 }|-1.5|99999999999|9223372036854775808|-99999999999999999999";
    let words =
        ["f64", "u32", "u64", "usize", "i64", "invalid type", "unknown variant", "missing field", "`", "expected"];
    let mut refusals = 0;
    for line in GOOD.lines().filter(|line| line.contains(" = ")) {
        let (key, _) = line.split_once(" = ").unwrap();
        for value in values.split('|').chain([HUGE]) {
            let text = format!("\n{GOOD}").replacen(&format!("\n{line}\n"), &format!("\n{key} = {value}\n"), 1);
            let Err(error) = brinell_scene_file::from_toml(&text) else { continue };
            let message = error.to_string();
            refusals += 1;
            for word in words {
                assert!(!message.contains(word), "{key} = {value}: `{word}` in: {message}");
            }
            assert!(message.contains("line "), "{key} = {value}: {message}");
        }
    }
    // 30 keys and 11 values; that few of them fit.
    assert!(refusals > 250, "{refusals}");
}

/// A fault of every kind, each of which hid others.
const EACH: [(&str, &str); 11] = [
    ("gravity_m_s2 = [0.0, -9.81]", "gravity_m_s2 = [0.0]"),
    ("element_count = 9", "element_count = \"nine\""),
    ("poissons_ratio = 0.3", "poissons_ratio = 0.7"),
    ("law = \"hertz\"", "law = \"herz\""),
    ("damping_chi_s_m = 0.5", "damping_tau_s = 1e-5"),
    ("slip = 0.0", "slipp = 0.0"),
    ("length_deg = 15.8", "length_deg = 15.8\nlength_mm = 3"),
    ("speed_hz = 10.0\n", ""),
    ("stiffness_n_m = 1.51056e7", "speed_hz = \"5\""),
    ("tolerance = 1e-5", "tolerance = 1.0"),
    ("step_s = 1e-4", "step_s = 0.2"),
];

#[test]
fn no_fault_hides_another() {
    // Lines that are taken out, or put in, move what follows.
    let without_line =
        |line: &str| line.trim_start().trim_start_matches("scene file: ").split_once(": ").unwrap().1.to_owned();
    let alone: Vec<String> = EACH.iter().map(|fault| without_line(&refused(&[*fault]))).collect();
    let told = |faults: &[(&str, &str)]| -> Vec<String> { refused(faults).lines().skip(1).map(without_line).collect() };
    assert_eq!(told(&EACH), alone);
    for j in 0..EACH.len() {
        for k in j + 1..EACH.len() {
            assert_eq!(told(&[EACH[j], EACH[k]]), [alone[j].clone(), alone[k].clone()]);
        }
    }
}

#[test]
fn an_empty_file_is_told_all_that_it_needs() {
    let message = brinell_scene_file::from_toml("").unwrap_err().to_string();
    for table in ["[bearing]", "[shaft]", "[housing]"] {
        assert!(message.contains(&format!("{table} is missing")), "{table}: {message}");
    }
}

#[test]
fn a_scene_that_a_host_or_a_program_spoils_is_refused() {
    let spoilt = |spoil: fn(&mut Scene)| {
        let mut scene = read(&[]).unwrap();
        spoil(&mut scene);
        scene.check().unwrap_err().to_string()
    };
    for (message, part) in [
        (spoilt(|scene| scene.bearing.radial_clearance = f64::NAN), "(bearing.radial_clearance_um) is NaN"),
        (spoilt(|scene| scene.shaft.motion = Motion::Host), "(shaft.load_n) is [0, -500]: it must be [0, 0]"),
        (spoilt(|scene| scene.shaft_initial_angle = f64::NAN), "(shaft.initial_angle_deg) is NaN"),
    ] {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn an_elements_mass_becomes_the_density() {
    // 2.044 g to four digits, so the density to half a unit in the fourth: 2e-4.
    let scene = read(&[("density_kg_m3 = 7800.0", "element_mass_g = 2.044")]).unwrap();
    assert!((scene.bearing.density / 7800.0 - 1.0).abs() < 3e-4, "{}", scene.bearing.density);
}

#[test]
fn rollers_are_crowned_and_cut_into_forty_laminae_where_nothing_else_is_said() {
    let roller = |new: &str| {
        let scene = read(&[(BALLS, ROLLERS), ("roller_length_mm = 9.0", new)]).unwrap();
        scene.bearing.roller().unwrap().clone()
    };
    let usual = Roller { length: 9e-3, profile: RollerProfile::Logarithmic, laminae: 40 };
    assert_eq!(roller("roller_length_mm = 9.0"), usual);
    assert_eq!(roller("roller_length_mm = 9.0\nroller_profile = \"log\""), usual);
    let straight = roller("roller_length_mm = 9.0\nroller_profile = \"straight\"\nroller_laminae = 10");
    assert_eq!(straight, Roller { profile: RollerProfile::Straight, laminae: 10, ..usual });
}

#[test]
fn a_roller_bearing_of_the_catalogue_needs_nothing_beside_its_name() {
    let own = &GOOD[GOOD.find("element_count").unwrap()..GOOD.find("[contact]").unwrap()];
    let named = |keys: &str| read(&[(own, &format!("{keys}\n"))]).map(|scene| scene.bearing);
    let bearing = named("catalogue = \"NU 205 ECP\"").unwrap();
    let roller = bearing.roller().unwrap();
    assert_eq!((bearing.element_count, bearing.element_diameter, roller.length), (13, 7.5e-3, 7.8e-3));
    assert_eq!(roller.profile, RollerProfile::Logarithmic);
    let straight = named("catalogue = \"NU205\"\nroller_profile = \"straight\"\nroller_length_mm = 8.5").unwrap();
    assert_eq!(straight.roller().unwrap().length, 8.5e-3);
    let groove = named("catalogue = \"NU205\"\nconformity_inner = 0.52").unwrap_err();
    assert!(groove.contains("conformity_inner") && groove.contains("only balls"), "{groove}");
}
