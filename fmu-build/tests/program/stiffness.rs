//! The command `stiffness`: its files are there, whole, and agree with each other.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::fs;

use fmu_build::commands::{Options, stiffness};
use fmu_build::package::Model;
use fmu_build::shared::Project;

/// Header and rows of a CSV file.
fn read(path: &std::path::Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let header = lines.next().unwrap().split(',').map(str::to_owned).collect();
    (header, lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect())
}

fn made(model: &Model, folder: &str, options: Options) -> std::path::PathBuf {
    let folder = common::folder(folder);
    stiffness::command(&Project::find(), model, options, &folder).unwrap();
    folder
}

#[test]
fn a_scene_with_a_defect_gives_two_tables_and_a_figure() {
    // Its contact map ends below the critical load.
    let model = common::model("er16k-tb2");
    let folder = made(&model, "stiffness-tb2", Options { load: None, points: Some(20), figure: true, json: false });
    let (header, rows) = read(&folder.join("er16k-tb2-stiffness.csv"));
    let column = |name: &str| header.iter().position(|cell| cell.starts_with(name)).unwrap();
    assert!(rows.len() > 20 && rows.iter().all(|row| row.len() == header.len()));
    let (free, healthy) = (column("stiffness.free"), column("stiffness.healthy"));
    assert!(rows.iter().all(|row| row[free] > 0.0 && row[free] < row[healthy]), "a defect takes stiffness away");
    let (_, variations) = read(&folder.join("er16k-tb2-critical-load.csv"));
    for varied in [0.0, 1.0, 2.0] {
        let loads: Vec<f64> = variations.iter().filter(|row| row[0] == varied).map(|row| row[4]).collect();
        assert!(loads.len() >= 5);
        // Up with depth, down with clearance and compliance.
        assert!(loads.windows(2).all(|pair| (pair[1] > pair[0]) == (varied == 0.0)), "{varied}: {loads:?}");
    }
    for end in ["svg", "png"] {
        assert!(folder.join(format!("er16k-tb2-stiffness.{end}")).metadata().unwrap().len() > 10_000);
    }
}

#[test]
fn a_critical_load_of_0_is_drawn_too() {
    // The ring stands between two of its three elements, and the third lies in the defect.
    let scene = fs::read_to_string(common::root().join("scenes/6205-spall-5deg.toml")).unwrap();
    let scene = scene.replace("element_count = 9", "element_count = 3").replace("law = \"map\"", "law = \"hertz\"");
    let path = common::folder("unloaded").join("unloaded.toml");
    fs::write(&path, scene.replace("radial_clearance_um = 5.0", "radial_clearance_um = 30.0")).unwrap();
    let options = Options { load: None, points: Some(20), figure: true, json: false };
    let folder = made(&Model::read(&path).unwrap(), "stiffness-unloaded", options);
    let (_, variations) = read(&folder.join("6205-spall-5deg-critical-load.csv"));
    assert!(variations.iter().all(|row| row[4] == 0.0));
    assert!(folder.join("6205-spall-5deg-stiffness.png").metadata().unwrap().len() > 10_000);
}

#[test]
fn a_healthy_bearing_has_no_critical_load_and_a_hosted_one_takes_a_load() {
    let folder = made(
        &common::model("6205-hosted"),
        "stiffness-hosted",
        Options { load: Some(800.0), points: Some(10), figure: false, json: false },
    );
    let (header, rows) = read(&folder.join("6205-hosted-stiffness.csv"));
    let load = header.iter().position(|cell| cell.starts_with("load.y")).unwrap();
    assert!(rows.iter().all(|row| row[load] == -800.0));
    let critical = header.iter().position(|cell| cell.starts_with("critical_load")).unwrap();
    assert!(rows.iter().all(|row| row[critical].is_nan()));
    assert!(!folder.join("6205-hosted-critical-load.csv").exists());
}

#[test]
fn a_bearing_without_a_critical_load_has_its_table_and_is_told_why() {
    let folder = common::folder("stiffness-without-critical-load");
    let text = fs::read_to_string(common::root().join("scenes/er16k-tb1.toml")).unwrap();
    // Opposite the load: the ring goes away from the spall.
    let text = text.replace("law = \"map\"", "law = \"hertz\"").replace("\nangle_deg = -90.0", "\nangle_deg = 90.0");
    let scene = folder.join("above.toml");
    fs::write(&scene, text).unwrap();
    let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_brinell"));
    let output = program.args(["stiffness", "--no-figure", "--points", "10", "-o"]).arg(&folder).arg(&scene).output();
    let output = output.unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(told.contains("stiffness along the load: least"), "{told}");
    assert!(told.contains("critical load: none; under ") && told.contains("a tenth of an element's radius"), "{told}");
    let (header, rows) = read(&folder.join("er16k-tb1-stiffness.csv"));
    let column = |name: &str| header.iter().position(|cell| cell.starts_with(name)).unwrap();
    assert!(rows.len() > 10 && rows.iter().all(|row| row[column("stiffness.free")] > 0.0));
    assert!(rows.iter().all(|row| row[column("critical_load")].is_nan()));
    assert!(!folder.join("er16k-tb1-critical-load.csv").exists());
}
