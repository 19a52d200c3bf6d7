//! Labels in the words of public collections, and a floor of noise.

use super::{QUICK, all, column, file, scene_of, sweep, words};
use crate::common;
use parquet::record::Field;

#[test]
fn runs_are_labelled_in_the_words_of_public_collections_and_the_healthy_are_not_silent() {
    let folder = common::folder("sweep-field-labels");
    let text = QUICK
        .replace("runs = 24", "runs = 8")
        .replace("\"inner\"]", "\"inner\", \"element\"]")
        .replace("noise_db = [0, 30]", "noise_rms_m_s2 = 0.25\nnoise_color = \"pink\"");
    let (path, out) = (file(&folder, &text), folder.join("out"));
    sweep(&path, &out, &[]);
    let number = |name: &str| all(&out, name);
    let text = |name: &str| words(&out, name);
    assert_eq!(text("fault_type")[..4], ["normal", "outer", "inner", "rolling_element"]);
    assert_eq!(text("fault_location")[..2], ["none", "test_bearing"]);
    assert_eq!(number("fault_size_mm"), [0.0, 1.0, 1.0, 1.0, 0.0, 2.0, 2.0, 2.0]);
    // From the bearing's dimensions, without slip.
    let bearing = brinell_scene_file::from_toml(&common::scene_text("er16k-tb1")).unwrap().bearing;
    let (count, ratio) = (bearing.element_count as f64, bearing.element_diameter / bearing.pitch_diameter);
    let orders = [
        ("bpfo", 0.5 * count * (1.0 - ratio)),
        ("bpfi", 0.5 * count * (1.0 + ratio)),
        ("bsf", 0.5 * (1.0 - ratio * ratio) / ratio),
        ("ftf", 0.5 * (1.0 - ratio)),
    ];
    for (name, expected) in orders {
        // Labels have 13 digits.
        assert!(number(name).iter().all(|order| (order / expected - 1.0).abs() < 1e-11), "{name} {expected}");
    }
    assert_eq!(number("load"), number("label_load_n"));
    assert!(number("fs").iter().all(|rate| *rate == 25_600.0) && text("load_unit").iter().all(|unit| unit == "N"));
    let hertz = number("label_speed_hz");
    assert!(number("speed_rpm").iter().zip(hertz).all(|(rpm, hertz)| (rpm / 60.0 / hertz - 1.0).abs() < 1e-11));
    // Pink noise of 0.25: in 20 ms a third of it is too slow to vary; a healthy bearing alone moves by thousandths.
    assert!(number("rms_m_s2").iter().all(|rms| *rms > 0.1), "{:?}", number("rms_m_s2"));
}

#[test]
fn a_growing_spall_has_its_bearing_and_how_far_it_has_come_beside_it_and_an_axial_load_stays() {
    let folder = common::folder("sweep-growth");
    let text = "scene = \"6205-combined\"\nruns = 4\nstop_s = 0.02\nsettle_s = 0.005\nrate_hz = 25600\n\
        kinds = [\"outer\", \"healthy\"]\n[set]\nsolver.tolerance = 1e-3\n[growth]\ndefect.length_mm = [0.2, 0.4]\n\
        [random]\nshaft.load_n = [300, 500]\n";
    let (path, out) = (file(&folder, text), folder.join("out"));
    assert!(sweep(&path, &out, &[]).contains(" 0 failed"));
    let numbers = [0.2, 0.4].map(Field::Double);
    assert_eq!(column(&out, "bearing"), [0, 0, 1, 1].map(Field::Long));
    assert_eq!(column(&out, "defect.length_mm")[..2], numbers);
    assert_eq!(column(&out, "label_growth"), [Field::Double(0.0), Field::Double(1.0), Field::Null, Field::Null]);
    let loads = column(&out, "shaft.load_n");
    assert!(loads[0] == loads[1] && loads[1] != loads[2] && loads[2] == loads[3], "{loads:?}");
    let scene = brinell_scene_file::from_toml(&scene_of(&path, &out, "0")).unwrap();
    let shipped = common::scene_text("6205-combined");
    assert_eq!(scene.shaft.axial.load, brinell_scene_file::from_toml(&shipped).unwrap().shaft.axial.load);
    assert_ne!(scene.shaft.axial.load, 0.0);
}
