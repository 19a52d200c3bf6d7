//! The file of a sweep and the folder that it is run in.

use super::*;

#[test]
fn a_folder_of_another_sweep_is_refused_with_what_is_different() {
    let folder = common::folder("sweep-other");
    let short = QUICK.replace("runs = 24", "runs = 3");
    let (path, out) = (file(&folder, &short), folder.join("out"));
    sweep(&path, &out, &[]);
    let kept = table(&out);
    for (text, more, parts) in [
        (short.replace("seed = 3", "seed = 4"), &[][..], ["`seed = 3`", "`seed = 4`"]),
        (short.replace("[1, 2]", "[1, 2.5]"), &[], ["`grid.defect.length_mm = [1, 2]`", "[1, 2.5]"]),
        (short.replace("er16k-tb1", "er16k-tb2"), &[], ["er16k-tb1", "er16k-tb2"]),
        (short.clone(), &["--signals"], ["`signals = \"none\"`", "`signals = \"npy\"`"]),
    ] {
        file(&folder, &text);
        let said = refused(&path, &out, more);
        assert!(parts.iter().all(|part| said.contains(part)) && said.contains("holds another sweep"), "{said}");
    }
    // Words that change nothing are no other sweep: the table has other words and the same rows.
    file(&folder, &format!("# the same\n{}", short.replace("seed = 3", "seed   = 3  # again")));
    sweep(&path, &out, &[]);
    assert_eq!(table(&out), kept);
    // Nor may two programs write into one folder.
    let lock = File::create(out.join("lock")).unwrap();
    lock.lock().unwrap();
    assert!(refused(&path, &out, &[]).contains("another program sweeps in this folder"));
}

#[test]
fn the_example_is_a_sweep_and_names_every_key() {
    let folder = common::folder("sweep-example");
    let text = fs::read_to_string(common::root().join("examples/sweep.toml")).unwrap();
    // Each body at each point of the grid once; the file makes them twice, with other random values.
    let once = file(&folder, &text.replacen("runs = 48", "runs = 24", 1));
    let told = sweep(&once, &folder.join("out"), &["--signals"]);
    assert!(told.contains("24 runs, 24 of them made now, 0 failed"), "{told}");
    // The others can be made as well.
    let shipped = common::root().join("examples/sweep.toml");
    for run in 24..48 {
        let scene = scene_of(&shipped, &folder.join("out"), &run.to_string());
        brinell_scene_file::from_toml(&scene).unwrap_or_else(|refusal| panic!("run {run}: {refusal}"));
    }
    let noise = ["noise_db", "noise_rms_m_s2", "noise_color", "noise_spectrum"];
    let others = ["runs", "seed", "stop_s", "settle_s", "rate_hz", "filter", "kinds", "speed_profiles"];
    for key in noise.into_iter().chain(others).chain(["split", "split_by"]) {
        assert!(text.contains(&format!("\n{key} = ")) || text.contains(&format!("\n# {key} = ")), "{key}");
    }
}

#[test]
fn a_grid_in_another_order_is_another_sweep() {
    let folder = common::folder("sweep-order");
    let ordered = |grid: &str| QUICK.replace("runs = 24", "runs = 2").replace("defect.length_mm = [1, 2]", grid);
    let path = file(&folder, &ordered("defect.length_mm = [1, 2]\ndefect.depth_um = [40, 50]"));
    let out = folder.join("out");
    sweep(&path, &out, &[]);
    // Runs take its points in another order, and lengths would stand in the column of depths.
    file(&folder, &ordered("defect.depth_um = [40, 50]\ndefect.length_mm = [1, 2]"));
    let said = refused(&path, &out, &[]);
    assert!(said.contains("holds another sweep") && said.contains("columns = "), "{said}");
}

#[test]
fn the_table_has_its_units_its_origin_and_nothing_of_the_machine_inside() {
    let folder = common::folder("sweep-origin");
    let text = QUICK.replace("runs = 24", "runs = 2");
    let (path, out) = (file(&folder, &text), folder.join("out"));
    sweep(&path, &out, &[]);
    let reader = SerializedFileReader::new(File::open(out.join("runs.parquet")).unwrap()).unwrap();
    let pairs = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let of = |key: &str| pairs.iter().find(|pair| pair.key == key).and_then(|pair| pair.value.as_deref());
    for (column, unit) in [
        ("shaft.load_n", "N"),
        ("defect.length_mm", "mm"),
        ("noise_db", "dB"),
        ("speed_rpm", "1/min"),
        ("rms_m_s2", "m/s2"),
        ("kurtosis", "1"),
        ("run", "1"),
    ] {
        assert_eq!(of(&format!("unit:{column}")), Some(unit), "{column}");
    }
    assert_eq!(of("unit:kind"), None, "words have no unit");
    let scene = common::scene_text("er16k-tb1");
    assert_eq!(of("brinell.sweep"), Some(text.as_str()));
    assert_eq!(of("brinell.scene"), Some(scene.as_str()));
    assert_eq!(of("brinell.version"), Some(env!("CARGO_PKG_VERSION")));
    // Made again elsewhere it has the same bits: also its metadata.
    let elsewhere = folder.join("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    sweep(&file(&elsewhere, &text), &elsewhere.join("out"), &["--jobs", "1"]);
    same_bits(&out, &elsewhere.join("out"));
}
