//! All faults of a file in one answer: of keys, kinds, words, names, limits and of values that belong together.

use super::GOOD;

/// What is said of the good scene with these changes.
#[track_caller]
fn said(changes: &[(&str, &str)]) -> Vec<String> {
    let text = changes.iter().fold(GOOD.to_owned(), |text, (old, new)| {
        assert_eq!(text.matches(old).count(), 1, "`{old}` must stand once");
        text.replace(old, new)
    });
    let message = match brinell_scene_file::from_toml(&text) {
        Ok(_) => panic!("{changes:?} were accepted"),
        Err(error) => error.to_string(),
    };
    message.lines().skip(1).map(|line| line.trim().to_owned()).collect()
}

/// One fault of every kind, each of which hid others.
const EACH: [(&str, &str, &str); 11] = [
    ("gravity_m_s2 = [0.0, -9.81]", "gravity_m_s2 = [0.0]", "line 3: gravity_m_s2 is a list of one value: it must be"),
    (
        "element_count = 9",
        "element_count = \"nine\"",
        "line 5: bearing.element_count is \"nine\": it must be a whole number",
    ),
    (
        "poissons_ratio = 0.3",
        "poissons_ratio = 0.7",
        "line 11: Poisson's ratio (bearing.poissons_ratio) is 0.7: it must be",
    ),
    (
        "law = \"hertz\"",
        "law = \"herz\"",
        "line 14: contact.law is \"herz\": it must be \"hertz\", \"map\", or \"love\"",
    ),
    ("damping_chi_s_m = 0.5", "damping_tau_s = 1e-5", "line 16: contact.damping_tau_s = 0.00001 does not belong to"),
    ("slip = 0.0", "slipp = 0.0", "line 18: cage.slipp is unknown: did you mean slip?"),
    (
        "length_deg = 15.8",
        "length_deg = 15.8\nlength_mm = 3",
        "line 22: defect.length_deg and defect.length_mm exclude",
    ),
    ("speed_hz = 10.0\n", "", "line 26: shaft.speed_hz is missing"),
    (
        "stiffness_n_m = 1.51056e7",
        "speed_hz = \"5\"",
        "line 31: housing.speed_hz is \"5\": it must be a number, without quotes",
    ),
    ("tolerance = 1e-5", "tolerance = 1.0", "line 35: tolerance (solver.tolerance) is 1: it must be"),
    ("step_s = 1e-4", "step_s = 0.2", "line 40: communication step (experiment.step_s) is 0.2: it must be at most 0.1"),
];

#[test]
fn one_fault_of_every_kind_hides_none_of_the_others() {
    let changes: Vec<(&str, &str)> = EACH.iter().map(|(old, new, _)| (*old, *new)).collect();
    let said = said(&changes);
    assert_eq!(said.len(), EACH.len(), "{said:#?}");
    for (line, (.., told)) in said.iter().zip(EACH) {
        assert!(line.starts_with(told), "`{told}` is not: {line}");
    }
}

#[test]
fn any_two_faults_are_told_together() {
    for (k, first) in EACH.iter().enumerate() {
        for second in &EACH[k + 1..] {
            // A line that is taken out, or put in, moves what follows.
            let told = |of: &str| of.split_once(": ").unwrap().1.to_owned();
            let said = said(&[(first.0, first.1), (second.0, second.1)]);
            assert_eq!(said.len(), 2, "{said:#?}");
            for wanted in [told(first.2), told(second.2)] {
                assert!(said.iter().any(|line| line.contains(&wanted)), "`{wanted}` is missing in {said:#?}");
            }
        }
    }
}

#[test]
fn a_name_that_the_catalogue_has_not_hides_nothing_and_nothing_is_said_of_a_bearing_in_its_place() {
    let bearing = &GOOD[GOOD.find("element_count").unwrap()..GOOD.find("[contact]").unwrap()];
    // Deeper and longer than any other bearing bears: nobody knows of this one.
    let said = said(&[
        (bearing, "catalogue = \"6299\"\n"),
        ("length_deg = 15.8", "length_mm = 90.0"),
        ("depth_um = 100.0", "depth_um = 20000.0"),
        ("step_s = 1e-4", "step_s = \"1e-4\""),
    ]);
    assert_eq!(said.len(), 2, "{said:#?}");
    assert!(
        said[0].starts_with("line 5: bearing.catalogue = \"6299\" is not in the catalogue (did you mean 62"),
        "{said:#?}"
    );
    assert!(said[1].starts_with("line 33: experiment.step_s is \"1e-4\""), "{said:#?}");
}

#[test]
fn faults_of_one_of_several_tables_are_told_with_its_lines() {
    let several = "[[defect]]\nangle_deg = 0.0\nlength_mm = 1.0\ndepth_um = \"50\"\n[[defect]]\nangle_deg = 90.0\n\
                   length_mm = 500.0\ndepth_um = 5000.0\n[[defect]]\nangle_deg = 90.0\nlength_mm = 1.0\non \
                   = \"outside\"\n";
    let defect = &GOOD[GOOD.find("[defect]").unwrap()..GOOD.find("[shaft]").unwrap()];
    let said = said(&[(defect, several)]);
    let wanted = [
        "line 23: defect.depth_um is \"50\": it must be a number, without quotes",
        "line 26: [[defect]] number 2: spall length (defect.length_deg or defect.length_mm) is 500 mm",
        "line 27: [[defect]] number 2: spall depth (defect.depth_um) is 5000",
        "line 28: one of defect.depth_um and defect.profile is needed, neither is given",
        "line 31: defect.on is \"outside\": it must be \"outer\"",
    ];
    assert_eq!(said.len(), wanted.len(), "{said:#?}");
    for (line, told) in said.iter().zip(wanted) {
        assert!(line.starts_with(told), "`{told}` is not: {line}");
    }
}

#[test]
fn tables_of_the_wrong_kind_and_missing_ones_hide_nothing() {
    let said = said(&[
        ("[shaft]\nmotion = \"internal\"\nspeed_hz = 10.0\nload_n = [0.0, -500.0]\n", ""),
        ("name = \"er16k-tb1\"", "name = \"er16k tb1\"\nfilm = 3"),
        ("depth_um = 100.0", "depth_um = 4000.0"),
    ]);
    let wanted = [
        "[shaft] is missing, it needs at least motion, speed_hz",
        "line 2: name \"er16k tb1\": 1 to 64 characters",
        "line 3: [film] is 3: it must be one table [film]",
        "line 24: spall depth (defect.depth_um) is 4000: it must be below 3970",
    ];
    assert_eq!(said.len(), wanted.len(), "{said:#?}");
    for (line, told) in said.iter().zip(wanted) {
        assert!(line.starts_with(told), "`{told}` is not: {line}");
    }
}

#[test]
fn of_a_file_that_is_not_toml_the_first_fault_is_told_and_shown() {
    for (good, bad, told) in [
        // Neither the lines that follow an open bracket nor the second line of an open text are faults of their own.
        ("load_n = [0.0, -500.0]", "load_n = [0.0, -500.0", "TOML parse error at line 29, column 1\n"),
        ("name = \"er16k-tb1\"", "name = 'er16k\ntb1'", "TOML parse error at line 2, column 14\n"),
        ("[housing]", "[shaft]", "TOML parse error at line 29, column 2\n"),
        ("poissons_ratio = 0.3", "poissons_ratio = 0,3\nspeed_hz 10.0", "TOML parse error at line 11, column 19\n"),
    ] {
        assert_eq!(GOOD.matches(good).count(), 1, "{good}");
        let message = brinell_scene_file::from_toml(&GOOD.replace(good, bad)).unwrap_err().to_string();
        assert!(message.starts_with(&format!("scene file: {told}")), "`{told}` is not: {message}");
        // Where, an empty line, the line itself, a caret below what is wrong in it, and why.
        assert_eq!(message.lines().count(), 5, "{message}");
        assert_eq!(message.matches('^').count().min(1), 1, "{message}");
    }
}
