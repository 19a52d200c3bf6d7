//! Values of the wrong kind and words that are not known: what must stand there, what was probably meant, no program's
//! words.

use super::{GOOD, message, refused};

#[test]
fn a_word_that_is_not_known_is_told_with_those_that_are_and_the_nearest() {
    let cases = [
        ("law = \"hertz\"", "law = \"herz\"", "line 14: contact.law is \"herz\"", "\"hertz\""),
        ("\"hunt-crossley\"", "\"hunt_crosley\"", "line 15: contact.damping is \"hunt_crosley\"", "\"hunt-crossley\""),
        ("law = \"hertz\"", "law = \"map\"\nedge = \"stepp\"", "line 15: contact.edge is \"stepp\"", "\"step\""),
        (
            "angle_deg = -90.0\nlength",
            "on = \"iner\"\nangle_deg = 1\nlength",
            "line 21: defect.on is \"iner\"",
            "\"inner\"",
        ),
        ("element_count = 9", "element = \"bal\"\nelement_count = 9", "line 5: bearing.element is \"bal\"", "\"ball\""),
        (
            "element_count = 9",
            "element_inertia = \"non\"\nelement_count = 9",
            "line 5: bearing.element_inertia is \"non\"",
            "\"none\"",
        ),
        (
            "motion = \"internal\"\nspeed",
            "motion = \"intern\"\nspeed",
            "line 26: shaft.motion is \"intern\"",
            "\"internal\"",
        ),
        (
            "rate_hz = 51200.0",
            "rate_hz = 51200\nfilter = \"linear phase\"",
            "line 38: recorder.filter",
            "\"linear-phase\"",
        ),
        ("element_count = 9", "catalogue = \"6250\"", "line 5: bearing.catalogue = \"6250\" is not in", "6205"),
        ("element_count = 9", "catalogue = \"NU250\"", "line 5: bearing.catalogue = \"NU250\" is not in", "NU205"),
    ];
    for (old, new, told, meant) in cases {
        refused(old, new, &[told, &format!("did you mean {meant}?")]);
    }
    let rollers = "element = \"cylindrical-roller\"\nroller_length_mm = 9.0\nroller_profile = \"straigt\"";
    refused(
        "groove_diameter_mm = 8.19",
        rollers,
        &["line 10: bearing.roller_profile is", "did you mean \"straight\"?"],
    );
    // Nothing is like it.
    let said = message("law = \"hertz\"", "law = \"finite-elements\"");
    assert!(said.contains("it must be \"hertz\", \"map\", or \"love\"") && !said.contains("did you mean"), "{said}");
}

#[test]
fn a_key_that_holds_a_list_is_no_table() {
    let said = message("gravity_m_s2 = [0.0, -9.81]", "gravty_m_s2 = [0.0, -9.81]");
    assert_eq!(said, "scene file: line 3: gravty_m_s2 is unknown: did you mean gravity_m_s2?");
}

#[test]
fn what_kind_of_value_a_key_takes_is_said_in_plain_words() {
    let cases = [
        (
            "element_count = 9",
            "element_count = 9.5",
            "line 5: bearing.element_count is 9.5: it must be a whole number, 0 or more",
        ),
        (
            "element_count = 9",
            "element_count = \"nine\"",
            "line 5: bearing.element_count is \"nine\": it must be a whole number",
        ),
        (
            "speed_hz = 10.0",
            "speed_hz = \"10\"",
            "line 27: shaft.speed_hz is \"10\": it must be a number, without quotes",
        ),
        ("speed_hz = 10.0", "speed_hz = [10]", "line 27: shaft.speed_hz is a list of one value: it must be a number"),
        ("speed_hz = 10.0", "speed_hz = true", "line 27: shaft.speed_hz is true: it must be a number"),
        ("name = \"er16k-tb1\"", "name = 16", "line 2: name is 16: it must be a text in quotes"),
        (
            "[0.0, -500.0]",
            "[0.0, \"-500\"]",
            "line 28: shaft.load_n is a list of 2 values: it must be a list of two numbers",
        ),
        ("[0.0, -500.0]", "-500.0", "line 28: shaft.load_n is -500.0: it must be a list of two numbers"),
        ("[sensor]\nmass_kg = 1.0", "[sensor.mode]", "[sensor.mode] is a table: it must be [[sensor.mode]]"),
        ("[housing]", "[[housing]]", "[housing] is 1 tables: it must be one table [housing]"),
        ("[sensor]\nmass_kg = 1.0", "[sensors]", "[sensors] is unknown: did you mean sensor?"),
    ];
    for (old, new, told) in cases {
        refused(old, new, &[told]);
    }
    let text = GOOD
        .replace("name = \"er16k-tb1\"", "name = \"er16k-tb1\"\nprobe = 3\nsensor = 1")
        .replace("[sensor]\nmass_kg = 1.0\n", "");
    let said = brinell_scene_file::from_toml(&text).unwrap_err().to_string();
    assert!(said.contains("line 3: [probe] is 3: it must be one table [probe]"), "{said}");
    assert!(said.contains("line 4: [sensor] is 1: it must be a table [sensor], or several [[sensor]]"), "{said}");
}

#[test]
fn no_message_has_words_of_the_language_that_the_program_is_written_in() {
    const HUGE: &str = "999999999999999999999999999999999999999999";
    let spoilt = [
        "true",
        "\"x\"",
        "[]",
        "[1, \"a\"]",
        "1979-05-27",
        "{ a = 1 }",
        "-1.5",
        "99999999999",
        "9223372036854775808",
        HUGE,
        "-99999999999999999999",
    ];
    for line in GOOD.lines().filter(|line| line.contains(" = ")) {
        let (key, _) = line.split_once(" = ").unwrap();
        for value in spoilt {
            let text = GOOD.replacen(&format!("\n{line}\n"), &format!("\n{key} = {value}\n"), 1);
            let Err(error) = brinell_scene_file::from_toml(&text) else { continue };
            let said = error.to_string();
            for word in [
                "f64",
                "u32",
                "u64",
                "usize",
                "i64",
                "invalid type",
                "unknown variant",
                "missing field",
                "`",
                "expected",
            ] {
                assert!(!said.contains(word), "{key} = {value}: `{word}` in: {said}");
            }
            assert!(said.contains("line "), "{key} = {value}: {said}");
        }
    }
}

#[test]
fn a_whole_number_has_at_most_64_bits_and_a_seed_may_have_all_of_them() {
    refused(
        "load_n = [0.0, -500.0]",
        "load_n = [0, 99999999999999999999]",
        &["line 28", "shaft.load_n", "at most 1e9"],
    );
    let seed = |seed: &str| GOOD.replace("[cage]", &format!("[cage]\nseed = {seed}"));
    assert!(brinell_scene_file::from_toml(&seed("18446744073709551615")).is_ok());
    // Beside another fault it is as right as alone.
    let said = |text: &str| brinell_scene_file::from_toml(text).unwrap_err().to_string();
    let spoilt = seed("18446744073709551615").replace("motion = \"internal\"", "motoin = \"internal\"");
    assert!(said(&spoilt).contains("motoin") && !said(&spoilt).contains("seed"), "{}", said(&spoilt));
    let long = said(&seed("18446744073709551616"));
    assert!(long.contains("cage.seed is 18446744073709551616: a whole number must have at most 64 bits"), "{long}");
    assert!(long.contains("line "), "{long}");
    assert!(said(&seed("-1")).contains("cage.seed is -1: it must be a whole number, 0 or more"));
}
