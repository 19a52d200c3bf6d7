//! The command `stiffness`: its files are there, whole, and agree with each other.
#![allow(clippy::unwrap_used)]

use crate::common;
use crate::common::program::{Table, brinell, done};
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of what the command makes of a scene, and what it prints.
fn made(scene: &Path, folder: &str, more: &[&str]) -> (PathBuf, String) {
    let folder = common::folder(folder);
    (folder.clone(), done(brinell(&["stiffness", "-o"]).arg(&folder).arg(scene).args(more)).out)
}

#[test]
fn a_scene_with_a_defect_gives_two_tables_and_a_figure() {
    // Its contact map ends below the critical load.
    let (folder, _) = made(&common::scene("er16k-tb2"), "stiffness-tb2", &["--points", "20"]);
    let table = Table::read(&folder.join("er16k-tb2-stiffness.csv"));
    let [free, healthy] = ["stiffness.free", "stiffness.healthy"].map(|name| table.column(name));
    assert!(free.len() > 20);
    assert!(free.iter().zip(&healthy).all(|(free, healthy)| 0.0 < *free && free < healthy), "a defect takes stiffness");
    let variations = Table::read(&folder.join("er16k-tb2-critical-load.csv")).rows;
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
    let scene = common::scene_text("6205-spall-5deg").replace("element_count = 9", "element_count = 3");
    let scene = scene.replace("law = \"map\"", "law = \"hertz\"");
    let path = common::folder("unloaded").join("unloaded.toml");
    fs::write(&path, scene.replace("radial_clearance_um = 5.0", "radial_clearance_um = 30.0")).unwrap();
    let (folder, _) = made(&path, "stiffness-unloaded", &["--points", "20"]);
    let variations = Table::read(&folder.join("6205-spall-5deg-critical-load.csv")).rows;
    assert!(variations.iter().all(|row| row[4] == 0.0));
    assert!(folder.join("6205-spall-5deg-stiffness.png").metadata().unwrap().len() > 10_000);
}

#[test]
fn a_healthy_bearing_has_no_critical_load_and_a_hosted_one_takes_a_load() {
    let more = ["--load", "800", "--points", "10", "--no-figure"];
    let (folder, _) = made(&common::scene("6205-hosted"), "stiffness-hosted", &more);
    let table = Table::read(&folder.join("6205-hosted-stiffness.csv"));
    assert!(table.column("load.y").iter().all(|load| *load == -800.0));
    assert!(table.column("critical_load").iter().all(|load| load.is_nan()));
    assert!(!folder.join("6205-hosted-critical-load.csv").exists());
}

#[test]
fn a_bearing_without_a_critical_load_has_its_table_and_is_told_why() {
    // Opposite the load: the ring goes away from the spall.
    let text = common::scene_text("er16k-tb1").replace("law = \"map\"", "law = \"hertz\"");
    let scene = common::folder("stiffness-above").join("above.toml");
    fs::write(&scene, text.replace("\nangle_deg = -90.0", "\nangle_deg = 90.0")).unwrap();
    let (folder, told) = made(&scene, "stiffness-without-critical-load", &["--points", "10", "--no-figure"]);
    assert!(told.contains("stiffness along the load: least"), "{told}");
    assert!(told.contains("critical load: none; under ") && told.contains("a tenth of an element's radius"), "{told}");
    let table = Table::read(&folder.join("er16k-tb1-stiffness.csv"));
    assert!(table.rows.len() > 10 && table.column("stiffness.free").iter().all(|free| *free > 0.0));
    assert!(table.column("critical_load").iter().all(|load| load.is_nan()));
    assert!(!folder.join("er16k-tb1-critical-load.csv").exists());
}
