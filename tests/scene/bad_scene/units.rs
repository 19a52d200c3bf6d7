//! Values in another unit than their key's: asked about, with the value that was probably meant.

use super::{GOOD, accepted, refused};

/// What is asked about the good scene with `old` replaced by `new`, all in one text.
#[track_caller]
fn asked(old: &str, new: &str) -> String {
    accepted(old, new);
    let asked = brinell_scene_file::unit_questions(&GOOD.replace(old, new));
    asked.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

#[test]
fn nothing_is_asked_about_a_usual_scene() {
    assert_eq!(asked("slip = 0.0", "slip = 0.0"), "");
}

/// What stands in the good scene, what takes its place, and the question.
const ASKED: [(&str, &str, &str); 31] = [
    (
        "gravity_m_s2 = [0.0, -9.81]",
        "gravity_m_s2 = [0.0, -9810.0]",
        "line 3: gravity_m_s2 = -9810: -9.81 m/s2 given in mm/s2?",
    ),
    ("gravity_m_s2 = [0.0, -9.81]", "gravity_m_s2 = [0.0, -1.0]", "-9.80665 m/s2 given in multiples of g?"),
    (
        "radial_clearance_um = 5.0",
        "radial_clearance_um = 0.005",
        "line 9: bearing.radial_clearance_um = 0.005: 5 um given in millimetres?",
    ),
    ("radial_clearance_um = 5.0", "radial_clearance_um = -5e-6", "-5 um given in metres?"),
    ("radial_clearance_um = 5.0", "radial_clearance_um = 3000.0", "3 um given in nanometres?"),
    ("radial_clearance_um = 5.0", "internal_clearance_um = 0.01", "10 um given in millimetres?"),
    ("density_kg_m3 = 7800.0", "density_kg_m3 = 7.8", "7800 kg/m3 given in g/cm3?"),
    ("density_kg_m3 = 7800.0", "density_kg_m3 = 7.8e-9", "7800 kg/m3 given in t/mm3?"),
    ("density_kg_m3 = 7800.0", "element_mass_g = 0.00204", "2.04 g given in kilograms?"),
    ("youngs_modulus_gpa = 207.0", "youngs_modulus_gpa = 0.207", ""),
    ("poissons_ratio = 0.3", "poissons_ratio = 0.3\nouter_compliance_m_n = 6.5e-5", "6.5e-8 m/N given in mm/N?"),
    (
        "poissons_ratio = 0.3",
        "poissons_ratio = 0.3\nhertz_inner_n_m1_5 = 3.2e5",
        "1.01193e10 N/m^1.5 given in N/mm^1.5?",
    ),
    ("law = \"hertz\"", "law = \"hertz\"\nlargest_force_n = 2.0", "2000 N given in kN?"),
    ("[cage]", "[film]\nviscosity_pa_s = 5.0\npressure_viscosity_1_pa = 2e-8\n[cage]", "0.005 Pa s given in mPa s?"),
    (
        "[cage]",
        "[film]\nviscosity_pa_s = 0.04\npressure_viscosity_1_pa = 2e-8\nlayer_um = 0.02\n[cage]",
        "20 um given in millimetres?",
    ),
    ("length_deg = 15.8", "length_mm = 0.03", "30 mm given in metres?"),
    ("length_deg = 15.8", "length_deg = 0.2757", "radians?"),
    ("length_deg = 15.8", "length_mm = 120.0", "0.12 mm given in micrometres?"),
    ("depth_um = 100.0", "depth_um = 0.1", "line 23: defect.depth_um = 0.1: 100 um given in millimetres?"),
    ("depth_um = 100.0", "depth_um = 1e-4", "100 um given in metres?"),
    ("speed_hz = 10.0", "speed_hz = 600.0", "line 27: shaft.speed_hz = 600: 10 Hz given in rev/min?"),
    ("speed_hz = 10.0", "speed_hz = -600", "-10 Hz given in rev/min?"),
    ("load_n = [0.0, -500.0]", "load_n = [0.0, -0.5]", "line 28: shaft.load_n = -0.5: -500 N given in kN?"),
    ("load_n = [0.0, -500.0]", "load_n = [0.0, -500000.0]", "-500 N given in mN?"),
    ("stiffness_n_m = 1.51056e7", "mass_kg = 6638", "line 31: housing.mass_kg = 6638: 6.638 kg given in grams?"),
    ("stiffness_n_m = 1.51056e7", "mass_kg = 0.006638", "6.638 kg given in tonnes?"),
    ("stiffness_n_m = 1.51056e7", "stiffness_n_m = 15105.6", "1.51056e7 N/m given in N/mm?"),
    ("stiffness_n_m = 1.51056e7", "stiffness_n_m = 15.1056", "1.51056e7 N/m given in N/um?"),
    ("mass_kg = 1.0", "mass_kg = 30.0", "0.03 kg given in grams?"),
    ("mass_kg = 1.0", "mode = [{ frequency_hz = 2.3, damping_ratio = 0.03, gain = 1.0 }]", "2300 Hz given in kHz?"),
    ("step_s = 1e-4", "step_s = 0.1", "0.0001 s given in milliseconds?"),
];

#[test]
fn a_value_off_by_a_thousand_is_asked_about_with_what_was_probably_meant() {
    for (old, new, question) in ASKED {
        let asked = asked(old, new);
        assert!(asked.contains(question) && asked.lines().count() <= 1, "`{question}` is not: {asked}");
        assert_eq!(asked.is_empty(), question.is_empty(), "{new}: {asked}");
    }
}

#[test]
fn usual_values_far_from_each_other_are_not_asked_about() {
    for (old, new) in [
        ("radial_clearance_um = 5.0", "radial_clearance_um = 0.0"),
        ("radial_clearance_um = 5.0", "radial_clearance_um = -20.0"),
        ("load_n = [0.0, -500.0]", "load_n = [0.0, 0.0]"),
        ("load_n = [0.0, -500.0]", "load_n = [0.0, -20000.0]"),
        ("load_n = [0.0, -500.0]", "load_n = [0.0, -5.0]"),
        ("length_deg = 15.8", "length_mm = 0.1"),
        ("length_deg = 15.8", "length_deg = 55.8"),
        ("depth_um = 100.0", "depth_um = 1.0"),
        ("speed_hz = 10.0", "speed_hz = 450.0"),
        ("stiffness_n_m = 1.51056e7", "stiffness_n_m = 1e9"),
        ("gravity_m_s2 = [0.0, -9.81]", "gravity_m_s2 = [0.0, -1.62]"),
        ("gravity_m_s2 = [0.0, -9.81]", "gravity_m_s2 = [0.0, 0.0]"),
    ] {
        assert_eq!(asked(old, new), "", "{new}");
    }
}

#[test]
fn a_value_beyond_its_limits_is_refused_with_the_question() {
    for (old, new, parts) in [
        ("diameter_mm = 7.94", "diameter_mm = 0.00794", ["is 0.00794:", "; 7.94 mm given in metres?"]),
        ("density_kg_m3 = 7800.0", "element_mass_g = 2040.0", ["by their mass", "; 2.04 g given in milligrams?"]),
        ("modulus_gpa = 207.0", "modulus_gpa = 207000.0", ["is 207000:", "; 207 GPa given in MPa?"]),
        ("modulus_gpa = 207.0", "modulus_gpa = 2.07e11", ["is 2.07e11:", "; 207 GPa given in Pa?"]),
        ("modulus_gpa = 207.0", "modulus_gpa = 3e7", ["is 3e7:", "; 206.843 GPa given in psi?"]),
        ("groove_diameter_mm = 8.19", "groove_diameter_mm = 0.00819", ["is 0.00819:", "; 8.19 mm given in metres?"]),
        (
            "groove_diameter_mm = 8.19",
            "groove_diameter_mm = 0.3224",
            ["at least 0.5001", "; 8.18896 mm given in inches?"],
        ),
        ("radial_clearance_um = 5.0", "radial_clearance_um = 5000.0", ["at most 3970", "; 5 um given in nanometres?"]),
        ("edge_slope_deg = 90.0", "edge_slope_deg = 1.5707963", ["flanks of", "; 90 degrees given in radians?"]),
        ("depth_um = 100.0", "depth_um = 100000.0", ["below 3970", "; 100 um given in nanometres?"]),
        ("length_deg = 15.8", "length_mm = 6500.0", ["below 148.4", "; 6.5 mm given in micrometres?"]),
        (
            "length_deg = 15.8",
            "length_mm = 0.0012",
            ["is 0.0012 mm: it must be at least 0.00794 mm", "; 1.2 mm given in metres?"],
        ),
        ("rate_hz = 51200.0", "rate_hz = 51.2", ["at least 100", "; 51200 Hz given in kHz?"]),
        ("step_s = 1e-4", "step_s = 0.2", ["at most 0.1", "; 0.0002 s given in milliseconds?"]),
    ] {
        refused(old, new, &parts);
    }
    let film = |viscosity: &str, growth: &str| {
        format!("[film]\nviscosity_pa_s = {viscosity}\npressure_viscosity_1_pa = {growth}\n[cage]")
    };
    refused("[cage]", &film("40.0", "2e-8"), &["at most 10; 0.04 Pa s given in mPa s?"]);
    refused("[cage]", &film("0.04", "20.0"), &["at most 4e-8; 2e-8 1/Pa given in 1/GPa?"]);
}

#[test]
fn a_bearing_of_the_catalogue_has_the_dimensions_by_which_is_asked() {
    let bearing = &GOOD[GOOD.find("element_count").unwrap()..GOOD.find("[contact]").unwrap()];
    let asked = asked(bearing, "catalogue = \"NU205\"\nradial_clearance_um = 0.02\n");
    assert!(asked.contains("20 um given in millimetres?"), "{asked}");
    let text = GOOD.replace(bearing, "catalogue = \"6205\"\n").replace("-500.0", "-1.5");
    let asked = brinell_scene_file::unit_questions(&text);
    assert!(asked.len() == 1 && asked[0].to_string().contains("-1500 N given in kN?"), "{asked:?}");
}

#[test]
fn what_is_usual_is_told_with_where_that_is_from() {
    let asked = asked("speed_hz = 10.0", "speed_hz = 600.0");
    assert!(asked.contains("Usual are 0 to 510 Hz (speed times pitch diameter to 1.2e6 mm/min"), "{asked}");
}
