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
fn all_faults_of_a_sweep_are_told_with_their_lines() {
    let folder = common::folder("sweep-faults");
    let path = file(
        &folder,
        r#"scene = "er16k-tb1"
run = 5
seed = -1
kinds = ["outer", "iner"]
noise_db = [30, 10]
settle_s = 0.5
[set]
contact.law = "herz"
[grid]
defect.depth_um = [50, -50]
cage.slipp = [0.1]
shaft.load_n = 5
[random]
defect.length_mm = [2, 1]
housing.mass_kg = [1, 2]
defect.depth_um = [1, 2]
bearing.element_count = [8.5, 10]
"#,
    );
    let said = refused(&path, &folder.join("out"), &[]);
    for part in [
        "line 2: run is unknown: did you mean runs?",
        "line 3: seed is -1: it must be a whole number from 0",
        "line 4: kinds: \"iner\" is none of healthy, outer, inner, element; did you mean inner?",
        "line 5: noise_db is [30, 10]: it must be a ratio, or a list of two, the lower one first, from -60 to 200",
        "line 6: settle_s is 0.5: it must be a number, from 0 to below stop_s",
        "line 8: contact.law is \"herz\"",
        "did you mean \"hertz\"?",
        "line 10: ",
        "is -50",
        "line 11: cage.slipp is unknown: did you mean slip?",
        "line 12: grid.shaft.load_n is 5: it must be a list of values, one at least",
        "line 14: random.defect.length_mm is [2, 1]: it must be a list of two numbers, the lower one first",
        "line 16: defect.depth_um stands in line 10 already",
    ] {
        assert!(said.contains(part), "`{part}` is missing in: {said}");
    }
    assert!(!said.contains("line 15"), "{said}");
    assert!(!folder.join("out").exists(), "a folder of a sweep that cannot be");
    for (text, part) in [
        ("scene = \"er16k-tb1", "TOML parse error at line 1, column 19\n"),
        ("runs = 1\n", "scene is missing"),
        ("scene = \"er16k-tb3\"\n", "line 1: scene: er16k-tb3: neither a file nor a shipped scene; did you mean"),
        ("scene = \"er16k-tb1\"\n[random]\nshaft.load_n = [1, 2]\n", "runs is missing"),
        (
            "scene = \"6205-two-defects\"\n[grid]\ndefect.depth_um = [50]\n",
            "line 3: defect.depth_um: the scene has several",
        ),
        (
            "scene = \"6205-healthy\"\nspeed_profiles = [\"up.csv\"]\n[grid]\nshaft.speed_hz = [5]\n",
            "exclude each other",
        ),
    ] {
        let said = refused(&file(&folder, text), &folder.join("out"), &[]);
        assert!(said.contains(part), "`{part}` is missing in: {said}");
    }
}

#[test]
fn the_example_is_a_sweep_and_names_every_key() {
    let folder = common::folder("sweep-example");
    let example = common::root().join("examples/sweep.toml");
    let text = fs::read_to_string(&example).unwrap();
    let told = sweep(&example, &folder.join("out"), &["--signals"]);
    assert!(told.contains("48 runs, 48 of them made now, 0 failed"), "{told}");
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
    let scene = fs::read_to_string(common::root().join("scenes/er16k-tb1.toml")).unwrap();
    assert_eq!(of("brinell.sweep"), Some(text.as_str()));
    assert_eq!(of("brinell.scene"), Some(scene.as_str()));
    assert_eq!(of("brinell.version"), Some(env!("CARGO_PKG_VERSION")));
    // Made again elsewhere it has the same bits: also its metadata.
    let elsewhere = folder.join("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    sweep(&file(&elsewhere, &text), &elsewhere.join("out"), &["--jobs", "1"]);
    same_bits(&out, &elsewhere.join("out"));
}
