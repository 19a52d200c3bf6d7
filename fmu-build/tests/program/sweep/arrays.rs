//! Signals of all runs in one array.

use super::*;

/// Half of the runs fail.
fn failing() -> String {
    QUICK.replace("[random]", "solver.max_steps = [1000000, 3]\n[random]")
}

/// Shape of an array, and its numbers.
fn array(out: &Path) -> (Vec<usize>, Vec<f64>) {
    let bytes = fs::read(out.join("signals.npy")).unwrap();
    let head = String::from_utf8_lossy(&bytes[..128]).into_owned();
    let shape = head.split("'shape': (").nth(1).unwrap().split(')').next().unwrap();
    let shape = shape.split(", ").map(|number| number.parse().unwrap()).collect();
    (shape, bytes[128..].chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect())
}

#[test]
fn an_array_has_what_the_files_of_the_runs_have_in_the_tables_order() {
    let folder = common::folder("sweep-array");
    let path = file(&folder, &failing());
    let (one, files) = (folder.join("one"), folder.join("files"));
    assert!(done(&mut program(&path, &one, &["--signals", "array"])).out.ends_with("signals.npy\n"));
    sweep(&path, &files, &["--signals"]);
    let (shape, numbers) = array(&one);
    assert_eq!(shape, [24, 512, 1]);
    let errors = column(&one, "error");
    for (run, (error, samples)) in errors.iter().zip(numbers.chunks_exact(512)).enumerate() {
        let of_file = files.join(format!("signals/run-{run:07}.npy"));
        if of_file.exists() {
            let (_, rows) = npy(&of_file, 2);
            assert_eq!(samples, rows.iter().map(|row| row[1]).collect::<Vec<_>>(), "run {run}");
        } else {
            assert!(*error != Field::Null && samples.iter().all(|sample| sample.is_nan()), "run {run}");
        }
    }
    assert!(!one.join("signals").exists(), "single runs are left beside the array");
    let card = fs::read_to_string(one.join("README.md")).unwrap();
    assert!(card.contains("`signals.npy` has the signals of all runs, for `numpy.load`"), "{card}");
    assert!(card.contains("-o FOLDER --signals array`"), "{card}");
    let script = "import sys, numpy\nprint(numpy.load(sys.argv[1]).shape)";
    let shape = common::run_text(common::python(), &folder, script, [one.join("signals.npy")]);
    assert_eq!(shape.trim(), "(24, 512, 1)");
}

#[test]
fn an_array_in_parts_grown_or_taken_away_has_the_bits_of_one_made_at_once() {
    let folder = common::folder("sweep-array-parts");
    let path = file(&folder, &failing());
    let (one, parts, grown) = (folder.join("one"), folder.join("parts"), folder.join("grown"));
    let array_of = |path: &Path, out: &Path, more: &[&str]| sweep(path, out, &[&["--signals", "array"], more].concat());
    array_of(&path, &one, &[]);
    for part in ["2/3", "3/3"] {
        array_of(&path, &parts, &["--part", part]);
    }
    assert_eq!(array(&parts.join("part-2-of-3")).0, [8, 512, 1]);
    assert!(array_of(&path, &parts, &[]).contains("24 runs, 8 of them made now, 12 failed"));
    same_bits(&one, &parts);
    assert!(!parts.join("part-2-of-3/signals.npy").exists(), "a second copy of its signals");
    file(&folder, &failing().replace("runs = 24", "runs = 8"));
    array_of(&path, &grown, &[]);
    assert_eq!(array(&grown).0, [8, 512, 1]);
    file(&folder, &failing());
    assert!(array_of(&path, &grown, &[]).contains("24 runs, 16 of them made now"));
    same_bits(&one, &grown);
    assert!(array_of(&path, &grown, &[]).contains("24 runs, 0 of them made now"));
    fs::remove_file(grown.join("signals.npy")).unwrap();
    assert!(array_of(&path, &grown, &[]).contains("the signals of 12 runs were gone and were made again"));
    same_bits(&one, &grown);
}

#[test]
fn a_run_of_another_length_is_named_and_the_array_stays_as_it_was() {
    let folder = common::folder("sweep-array-lengths");
    let short = QUICK.replace("runs = 24", "runs = 1").replace("stop_s = 0.03", "stop_s = 0.02");
    let (other, out) = (folder.join("other"), folder.join("out"));
    sweep(&file(&folder, &short), &other, &["--signals", "array"]);
    let path = file(&folder, &QUICK.replace("runs = 24", "runs = 3"));
    sweep(&path, &out, &["--signals", "array"]);
    let before = fs::read(out.join("signals.npy")).unwrap();
    fs::create_dir(out.join("signals")).unwrap();
    fs::copy(other.join("signals.npy"), out.join("signals/run-0000002.npy")).unwrap();
    let why = refused(&path, &out, &["--signals", "array"]);
    assert!(why.contains("run 2 has 256 samples of 1 sensors, and run 0 has 512 of 1"), "{why}");
    assert_eq!(fs::read(out.join("signals.npy")).unwrap(), before);
    fs::write(out.join("signals.npy"), "mine").unwrap();
    let why = refused(&path, &out, &["--signals", "array"]);
    assert!(why.contains("signals.npy is no array that a sweep has written: take it away"), "{why}");
}
