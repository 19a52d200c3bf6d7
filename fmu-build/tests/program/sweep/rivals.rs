//! A key of a sweep takes the place of the keys of its scene that say the same in another way.

use super::*;

/// Lines that each scene here has.
const BEARING: &str = "name = \"rivals\"\nshaft.motion = \"internal\"\nshaft.speed_hz = 10\n\
    housing.motion = \"internal\"\nbearing.catalogue = \"6205\"\n";
const SPATIAL: &str = "bearing.degrees_of_freedom = 3\nshaft.load_n = [0.0, -300.0, 100.0]\n";
const DEFECT: &str = "defect.angle_deg = -90\n";

/// What a scene has beside them, and the ways to say one thing, by keys and values.
type Ways = &'static [&'static [(&'static str, &'static str)]];
const EACH_TAKES_ANOTHERS_PLACE: [(&str, Ways); 6] = [
    (
        SPATIAL,
        &[
            &[("bearing.radial_clearance_um", "5.0")],
            &[("bearing.internal_clearance_um", "10.0")],
            &[("bearing.axial_clearance_um", "100.0")],
            &[("bearing.contact_angle_deg", "12.0")],
        ],
    ),
    (
        "",
        &[
            &[("bearing.groove_diameter_mm", "8.3")],
            &[("bearing.conformity_inner", "0.52"), ("bearing.conformity_outer", "0.53")],
        ],
    ),
    (
        "",
        &[
            &[("bearing.element_diameter_offsets_um", "[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]")],
            &[("bearing.element_diameter_rms_um", "0.5"), ("bearing.element_diameter_seed", "1")],
        ],
    ),
    (
        "cage.seed = 1\n",
        &[&[("cage.spacing_deg", "[0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]")], &[("cage.spacing_rms_deg", "0.1")]],
    ),
    (
        DEFECT,
        &[
            &[("defect.profile", "\"pit.csv\"")],
            &[("defect.profile.file", "\"pit.csv\""), ("defect.profile.invert", "true")],
            &[("defect.length_deg", "2.0"), ("defect.depth_um", "50.0"), ("defect.edge_slope_deg", "45.0")],
            &[("defect.length_mm", "1.0"), ("defect.depth_um", "40.0")],
        ],
    ),
    ("", &[&[("sensor.direction_deg", "90.0")], &[("sensor.direction", "[0.0, 1.0, 0.0]")]]),
];

/// A sweep of one run, its grid these keys, in a scene of these lines.
fn swept(folder: &Path, scene: &str, keys: &[(&str, &str)]) -> PathBuf {
    fs::write(folder.join("scene.toml"), scene).unwrap();
    let grid: String = keys.iter().map(|(key, value)| format!("{key} = [{value}]\n")).collect();
    file(folder, &format!("scene = \"scene.toml\"\n[grid]\n{grid}"))
}

fn lines(keys: &[(&str, &str)]) -> String {
    keys.iter().map(|(key, value)| format!("{key} = {value}\n")).collect()
}

#[test]
fn a_swept_key_takes_the_place_of_those_that_say_the_same_in_another_way() {
    let folder = common::folder("sweep-rivals");
    fs::write(folder.join("pit.csv"), "arc_mm,depth_um\n-0.5,0\n0,40\n0.5,0\n").unwrap();
    for (more, ways) in EACH_TAKES_ANOTHERS_PLACE {
        for (given, old) in ways.iter().enumerate() {
            for (_, new) in ways.iter().enumerate().filter(|(index, _)| *index != given) {
                let path = swept(&folder, &format!("{BEARING}{more}{}", lines(old)), new);
                let scene = scene_of(&path, &folder.join("out"), "0");
                let has = |(key, value): &(&str, &str)| {
                    scene.contains(&format!("\n{} = {value}\n", key.rsplit('.').next().unwrap()))
                };
                assert!(new.iter().all(has), "{new:?} in {scene}");
                assert!(!has(&old[0]), "{old:?} in {scene}");
            }
        }
    }
}

#[test]
fn recorded_figures_of_a_cage_take_the_place_of_others_and_one_figure_does_not_take_theirs() {
    let folder = common::folder("sweep-recorded");
    let (recorded, wander) = (("cage.irregularity", "\"recorded\""), ("cage.wander", "0.001"));
    let figures = [("cage.spacing_rms_deg", "0.1"), ("cage.jitter_rms_deg", "0.1"), wander];
    let cage = |keys: &[(&str, &str)]| format!("{BEARING}cage.seed = 1\n{}", lines(keys));
    let path = swept(&folder, &cage(&figures), &[recorded]);
    let scene = scene_of(&path, &folder.join("out"), "0");
    assert!(scene.contains("irregularity") && !scene.contains("rms_deg") && !scene.contains("wander"), "{scene}");
    // The others of the recorded figures would be 0 in silence.
    let path = swept(&folder, &cage(&[recorded]), &[wander]);
    let said = refused(&path, &folder.join("out"), &[]);
    assert!(said.contains("cage.irregularity and cage.wander exclude each other: give only one"), "{said}");
}

#[test]
fn a_name_takes_the_place_of_the_bearing_that_the_scene_has() {
    let folder = common::folder("sweep-names");
    let own = "name = \"own\"\nshaft.motion = \"internal\"\nshaft.speed_hz = 10\nhousing.motion = \"internal\"\n\
        bearing.element_count = 7\nbearing.element_diameter_mm = 9.0\nbearing.pitch_diameter_mm = 40.0\n\
        bearing.groove_diameter_mm = 9.4\nbearing.internal_clearance_um = 3.0\nbearing.youngs_modulus_gpa = 210\n\
        bearing.poissons_ratio = 0.3\nbearing.density_kg_m3 = 7800\n";
    for (name, count, clearance) in [("6205", 9, 6.25e-6), ("6206/C3", 9, 10.25e-6), ("NU 205", 13, 16.25e-6)] {
        let path = swept(&folder, own, &[("bearing.catalogue", &format!("{name:?}"))]);
        let bearing = brinell_scene_file::from_toml(&scene_of(&path, &folder.join("out"), "0")).unwrap().bearing;
        assert_eq!((bearing.element_count, bearing.radial_clearance), (count, clearance), "{name}");
        assert_eq!(bearing.youngs_modulus, 210e9);
    }
    // What the sweep says beside the name stays.
    let path = swept(&folder, own, &[("bearing.catalogue", "\"6205/C3\""), ("bearing.internal_clearance_um", "8.0")]);
    let bearing = brinell_scene_file::from_toml(&scene_of(&path, &folder.join("out"), "0")).unwrap().bearing;
    assert_eq!((bearing.element_count, bearing.radial_clearance), (9, 4e-6));
}
