//! A scene file is read into SI units, and what it leaves out gets the documented default.

use brinell::scene::{ContactLaw, Damping, DefectShape, Motion, Remark, Scene};
use std::f64::consts::PI;

const SHORT: &str = r#"
name = "er16k-tb1"
[bearing]
element_count = 9
element_diameter_mm = 7.94
pitch_diameter_mm = 39.32
groove_diameter_mm = 8.19
youngs_modulus_gpa = 207
poissons_ratio = 0.3
density_kg_m3 = 7800
[shaft]
motion = "internal"
speed_hz = 10
[housing]
motion = "internal"
"#;

fn read(text: &str) -> Scene {
    brinell_scene_file::from_toml(text).unwrap()
}

const SPALL: &str = "[defect]\nangle_deg = -90\nlength_deg = 15.8\ndepth_um = 100\n";

fn near(value: f64, expected: f64) -> bool {
    // Two roundings of the conversion.
    (value - expected).abs() <= 4.0 * f64::EPSILON * expected.abs()
}

#[test]
fn quantities_arrive_in_si_units() {
    let scene = read(&format!("{SHORT}[sensor]\n{SPALL}"));
    assert!(near(scene.bearing.element_diameter, 7.94e-3));
    assert!(near(scene.bearing.pitch_diameter, 39.32e-3));
    assert_eq!(scene.bearing.radial_clearance, 5e-6);
    assert_eq!(scene.bearing.youngs_modulus, 207e9);
    assert!(near(scene.bearing.conformity_inner, 8.19 / 15.88));
    assert_eq!(scene.bearing.conformity_inner, scene.bearing.conformity_outer);
    assert!(near(scene.shaft_speed, 20.0 * PI));
    assert!(near(scene.cage.initial_angle, -PI / 2.0));
    let defect = &scene.defects[0];
    assert!(near(defect.angle, -PI / 2.0));
    let DefectShape::Spall { length, depth, edge_slope } = defect.shape else { panic!("not a spall") };
    assert!(near(length, 15.8 / 180.0 * PI * 23.6325e-3), "{length}");
    assert_eq!(depth, 1e-4);
    assert!(near(edge_slope, PI / 2.0));
}

#[test]
fn the_raceways_of_the_er16k_have_their_radii() {
    let bearing = read(SHORT).bearing;
    assert!(near(bearing.outer_raceway_radius(), 23.6325e-3));
    // A difference: its rounding is that of the larger numbers.
    assert!((bearing.inner_raceway_radius() - 15.6875e-3).abs() < 1e-17);
}

#[test]
fn a_length_in_millimetres_equals_the_same_arc_in_degrees() {
    let length = |text: &str| match read(text).defects.remove(0).shape {
        DefectShape::Spall { length, .. } => length,
        DefectShape::Profile(_) => panic!("not a spall"),
    };
    let degrees = length(&format!("{SHORT}{SPALL}"));
    let arc = format!("length_mm = {:?}", degrees * 1e3);
    assert!(near(length(&format!("{SHORT}{}", SPALL.replace("length_deg = 15.8", &arc))), degrees));
}

#[test]
fn what_is_left_out_gets_the_documented_default() {
    let scene = read(SHORT);
    assert_eq!(scene.bearing.outer_compliance, 0.0);
    assert_eq!(scene.description, "");
    assert_eq!(scene.gravity, [0.0, -9.81]);
    assert_eq!(scene.contact.law, ContactLaw::Hertz);
    assert_eq!(scene.contact.damping, Damping::HuntCrossley(0.5));
    assert_eq!(scene.cage.slip, 0.0);
    assert_eq!(scene.defects, []);
    assert_eq!((scene.shaft.mass, scene.shaft.damping, scene.shaft.stiffness), (3.2638, 1376.8, 0.0));
    assert_eq!((scene.housing.mass, scene.housing.damping, scene.housing.stiffness), (6.638, 2210.7, 1.51056e7));
    assert_eq!(scene.shaft.load, [0.0, 0.0]);
    assert_eq!(scene.sensors, []);
    assert_eq!(scene.tolerance, 1e-5);
    assert_eq!(scene.recorder, None);
    assert_eq!((scene.experiment.stop, scene.experiment.step), (0.5, 1e-4));
}

#[test]
fn a_defect_asks_for_the_map_unless_a_law_is_given() {
    let scene = read(&format!("{SHORT}{SPALL}"));
    assert_eq!(scene.contact.law, ContactLaw::Map);
    let scene = read(&format!("{SHORT}{SPALL}[contact]\nlaw = \"love\""));
    assert_eq!(scene.contact.law, ContactLaw::Love);
}

#[test]
fn an_empty_sensor_table_is_the_15_khz_resonator() {
    let sensor = read(&format!("{SHORT}[sensor]")).sensors.remove(0);
    assert_eq!((sensor.mass, sensor.stiffness, sensor.damping), (1.0, 8.8826e9, 9424.8));
    let frequency = (sensor.stiffness / sensor.mass).sqrt() / (2.0 * PI);
    // The stiffness is printed with five digits.
    assert!((frequency / 15e3 - 1.0).abs() < 1e-5, "{frequency}");
}

#[test]
fn an_open_groove_is_remarked_upon_and_usual_ones_are_not() {
    assert_eq!(read(SHORT).remarks(), []);
    let grooves = "conformity_inner = 0.6\nconformity_outer = 126.0";
    let scene = read(&SHORT.replace("groove_diameter_mm = 8.19", grooves));
    assert_eq!(scene.remarks(), [Remark::OpenGroove { ring: "outer", conformity: 126.0 }]);
    let told = scene.remarks()[0].to_string();
    assert!(told.contains("gets a ball's point contacts: cylindrical rollers are bearing.element"), "{told}");
}

#[test]
fn a_hosted_ring_has_no_mass_of_its_own() {
    let text = SHORT.replace("motion = \"internal\"", "motion = \"host\"");
    let scene = read(&text);
    assert_eq!(scene.shaft.motion, Motion::Host);
    assert_eq!((scene.shaft.mass, scene.housing.stiffness), (0.0, 0.0));
}

#[test]
fn the_model_identifier_is_a_c_identifier() {
    assert_eq!(read(SHORT).model_identifier(), "Brinell_er16k_tb1");
    for name in ["6205-epps", "-", "_a", "9", "a--b_C-7"] {
        let identifier = read(&SHORT.replace("er16k-tb1", name)).model_identifier();
        let (first, rest) = identifier.split_at(1);
        assert!(first.chars().all(|c| c.is_ascii_alphabetic()), "{identifier}");
        assert!(rest.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'), "{identifier}");
    }
}

#[test]
fn a_scene_built_in_rust_is_that_of_the_shortest_file() {
    let file = read(
        r#"
        name = "bearing"
        [bearing]
        element_count = 9
        element_diameter_mm = 7.94
        pitch_diameter_mm = 39.04
        conformity_inner = 0.52
        conformity_outer = 0.52
        youngs_modulus_gpa = 207.0
        poissons_ratio = 0.3
        density_kg_m3 = 7800.0
        [shaft]
        motion = "internal"
        speed_hz = 0.0
        [housing]
        motion = "internal"
        [sensor]
        [defect]
        angle_deg = -90.0
        length_mm = 2.0
        depth_um = 50.0
        "#,
    );
    let bearing = brinell::scene::Bearing::steel_balls(9, 7.94 / 1e3, 39.04 / 1e3);
    let builder = Scene::builder(bearing).sensor(brinell::scene::Sensor::default());
    let built = builder.clone().spall((-90f64).to_radians(), 2.0 / 1e3, 50.0 / 1e6).build().unwrap();
    assert_eq!(built, file);
    assert_eq!(builder.build().unwrap().contact.law, ContactLaw::Hertz);
}

#[test]
fn contact_laws_have_the_numbers_and_names_of_the_published_interface() {
    let interface = [(1, "hertz", ContactLaw::Hertz), (2, "map", ContactLaw::Map), (3, "love", ContactLaw::Love)];
    for (number, name, law) in interface {
        assert_eq!((law.number(), law.described().0, ContactLaw::numbered(number)), (number, name, Some(law)));
        let scene = read(&format!("{SHORT}[contact]\nlaw = \"{name}\""));
        assert_eq!(scene.contact.law, law);
    }
    assert_eq!(ContactLaw::ALL.len(), interface.len());
    assert_eq!([0, 4, i32::MIN].map(ContactLaw::numbered), [None; 3]);
}

#[test]
fn a_bearing_of_the_catalogue_is_the_one_with_its_dimensions_and_a_key_beside_the_name_wins() {
    let dimensions = "element_count = 9\nelement_diameter_mm = 7.94\npitch_diameter_mm = 39.32\ngroove_diameter_mm = \
                      8.19\n\
                      youngs_modulus_gpa = 207\npoissons_ratio = 0.3\ndensity_kg_m3 = 7800\n";
    assert!(SHORT.contains(dimensions));
    let with = |keys: &str| read(&SHORT.replace(dimensions, keys)).bearing;
    let published = "element_count = 9\nelement_diameter_mm = 7.94\npitch_diameter_mm = 39.04\nconformity_inner = \
                     0.52\n\
                     conformity_outer = 0.52\nyoungs_modulus_gpa = 207\npoissons_ratio = 0.3\ndensity_kg_m3 = 7800\n";
    let catalogued = with("catalogue = \"6205\"\n");
    // The middle of class N, 5 to 20 um.
    assert_eq!(catalogued, with(&format!("{published}internal_clearance_um = 12.5\n")));
    assert_eq!(catalogued, with("catalogue = \"6205-2RS\"\n"));
    let clearance = |keys: &str| 2e6 * with(keys).radial_clearance;
    for (keys, expected) in [
        ("catalogue = \"SKF 6205-2Z/C3\"\n", 20.5),
        ("catalogue = \"6205/C3\"\nradial_clearance_um = 4\n", 8.0),
        ("catalogue = \"608\"\n", 7.5),
        ("catalogue = \"NU312\"\n", 55.0),
        (published, 10.0),
    ] {
        assert!(near(clearance(keys), expected), "{keys}: {}", clearance(keys));
    }
    let hybrid = with("catalogue = \"6205/HC5C3\"\nelement_poissons_ratio = 0.27\n");
    let material = (hybrid.element_youngs_modulus, hybrid.element_poissons_ratio, hybrid.density);
    assert_eq!(material, (Some(310e9), Some(0.27), 3200.0));
    let own = with(&format!("{published}element_youngs_modulus_gpa = 310\nelement_density_kg_m3 = 3200\n"));
    assert_eq!((own.element_youngs_modulus, own.element_poissons_ratio, own.density), (Some(310e9), None, 3200.0));
    let other = with("catalogue = \"6205\"\nelement_count = 8\ngroove_diameter_mm = 8.19\nelement_mass_g = 2.0\n");
    assert_eq!(other.element_count, 8);
    assert!(near(other.conformity_outer, 8.19 / 15.88) && other.element_mass == Some(2e-3));
}

#[test]
fn nothing_is_asked_about_shipped_scenes() {
    let scenes = super::shipped_scenes::scenes();
    assert!(scenes.len() > 15, "{}", scenes.len());
    for (name, text) in scenes {
        let asked = brinell_scene_file::unit_questions(&text);
        assert!(asked.is_empty(), "{name}: {}", asked[0]);
    }
}
