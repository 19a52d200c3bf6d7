//! `brinell sweep` as a program: equal bits however it is run, rows for runs that fail, faults with their lines.
#![allow(clippy::unwrap_used)]

mod arrays;
mod card;
mod ends;
mod files;
mod labels;
mod noise;
mod oracle;
mod rings;
mod rivals;

use crate::common;
use crate::common::program::{brinell, done, npy};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

/// Quick: law `hertz`, 30 ms.
const QUICK: &str = r#"
scene = "er16k-tb1"
runs = 24
seed = 3
stop_s = 0.03
settle_s = 0.01
rate_hz = 25600
kinds = ["healthy", "outer", "inner"]
noise_db = [0, 30]
[set]
contact.law = "hertz"
[grid]
defect.length_mm = [1, 2]
[random]
shaft.load_n = [300, 900]
shaft.speed_hz = [10, 40]
"#;

fn program(file: &Path, out: &Path, more: &[&str]) -> Command {
    let mut command = brinell(&["sweep", "-o"]);
    command.arg(out).arg(file).args(more);
    command
}

#[track_caller]
fn sweep(file: &Path, out: &Path, more: &[&str]) -> String {
    done(&mut program(file, out, more)).err
}

#[track_caller]
fn refused(file: &Path, out: &Path, more: &[&str]) -> String {
    crate::common::program::refused(&mut program(file, out, more))
}

/// The scene of a run.
fn scene_of(file: &Path, out: &Path, run: &str) -> String {
    done(&mut program(file, out, &["--scene-of", run])).out
}

fn file(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("sweep.toml");
    fs::write(&path, text).unwrap();
    path
}

/// Names of the columns, and rows.
fn table(out: &Path) -> (Vec<String>, Vec<Vec<Field>>) {
    let reader = SerializedFileReader::new(File::open(out.join("runs.parquet")).unwrap()).unwrap();
    let rows: Vec<Vec<(String, Field)>> =
        reader.get_row_iter(None).unwrap().map(|row| row.unwrap().into_columns()).collect();
    let names = rows[0].iter().map(|(name, _)| name.clone()).collect();
    (names, rows.into_iter().map(|row| row.into_iter().map(|(_, field)| field).collect()).collect())
}

fn column(out: &Path, name: &str) -> Vec<Field> {
    let (names, rows) = table(out);
    let index = names.iter().position(|known| known == name).unwrap_or_else(|| panic!("no {name} in {names:?}"));
    rows.into_iter().map(|row| row[index].clone()).collect()
}

/// Numbers of a column, where there are some.
fn numbers(out: &Path, name: &str) -> Vec<Option<f64>> {
    let number = |field| match field {
        Field::Double(number) => Some(number),
        Field::Long(number) => Some(number as f64),
        Field::Null => None,
        other => panic!("{name}: {other:?}"),
    };
    column(out, name).into_iter().map(number).collect()
}

/// Numbers of a column that has one in each row.
fn all(out: &Path, name: &str) -> Vec<f64> {
    numbers(out, name).into_iter().map(|number| number.unwrap_or_else(|| panic!("{name} lacks one"))).collect()
}

/// Words of a column of text.
fn words(out: &Path, name: &str) -> Vec<String> {
    let word = |field: Field| match field {
        Field::Str(word) => word,
        Field::Null => "null".to_owned(),
        other => panic!("{name} is no column of text: {other}"),
    };
    column(out, name).into_iter().map(word).collect()
}

/// Every file of a sweep that is to have the same bits, by its name.
fn bits(out: &Path) -> Vec<(String, Vec<u8>)> {
    let kept = ["runs.parquet", "README.md"];
    let mut files = kept.map(|name| (name.to_owned(), fs::read(out.join(name)).unwrap())).to_vec();
    files.extend(fs::read(out.join("signals.npy")).ok().map(|array| ("signals.npy".to_owned(), array)));
    if let Ok(entries) = fs::read_dir(out.join("signals")) {
        let of = |path: PathBuf| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(path).unwrap());
        files.extend(entries.map(|entry| of(entry.unwrap().path())));
    }
    files.sort();
    files
}

#[track_caller]
fn same_bits(one: &Path, other: &Path) {
    let (one, other) = (bits(one), bits(other));
    let names = |files: &[(String, Vec<u8>)]| files.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&one), names(&other));
    let unlike: Vec<&str> = one.iter().zip(&other).filter(|(a, b)| a.1 != b.1).map(|(a, _)| a.0.as_str()).collect();
    assert!(unlike.is_empty(), "other bits in {unlike:?}");
}

#[test]
fn parts_of_a_sweep_made_anywhere_join_to_the_bits_of_one_run() {
    let folder = common::folder("sweep-parts");
    let path = file(&folder, QUICK);
    let (one, parts) = (folder.join("one"), folder.join("parts"));
    sweep(&path, &one, &["--signals"]);
    for (part, runs) in [("2/5", 5), ("5/5", 4), ("1/5", 5), ("4/5", 5)] {
        let told = sweep(&path, &parts, &["--signals", "--part", part]);
        assert!(told.contains(&format!("{runs} runs, {runs} of them made now")), "{part}: {told}");
    }
    assert_eq!(table(&parts.join("part-2-of-5")).1, [1, 6, 11, 16, 21].map(|run| table(&one).1[run].clone()));
    // A row that was torn, and a part that nobody made, are made by the run that joins.
    let journal = parts.join("part-4-of-5/rows.log");
    let torn = fs::read(&journal).unwrap();
    fs::write(&journal, &torn[..torn.len() - 9]).unwrap();
    assert!(sweep(&path, &parts, &["--signals"]).contains("24 runs, 6 of them made now"));
    same_bits(&one, &parts);
    // Parts of another sweep are none of this one.
    file(&folder, &QUICK.replace("seed = 3", "seed = 4"));
    fs::remove_file(parts.join("design.txt")).unwrap();
    assert!(refused(&path, &parts, &["--signals"]).contains("part-"));
}

#[test]
fn a_sweep_has_the_same_bits_on_any_number_of_threads_and_a_longer_one_begins_with_it() {
    let folder = common::folder("sweep-threads");
    let path = file(&folder, QUICK);
    let (one, four, grown) = (folder.join("one"), folder.join("four"), folder.join("grown"));
    let told = sweep(&path, &one, &["--jobs", "1", "--signals"]);
    assert!(told.contains("24 runs, 24 of them made now, 0 failed"), "{told}");
    sweep(&path, &four, &["--jobs", "4", "--signals"]);
    same_bits(&one, &four);
    assert_eq!(bits(&one).len(), 26, "a table, its card and a file for each run");
    // From a third of the runs to all of them.
    file(&folder, &QUICK.replace("runs = 24", "runs = 8"));
    sweep(&path, &grown, &["--signals"]);
    assert_eq!(table(&grown).1, table(&one).1[..8]);
    file(&folder, QUICK);
    let told = sweep(&path, &grown, &["--signals"]);
    assert!(told.contains("24 runs, 16 of them made now"), "{told}");
    same_bits(&one, &grown);
    // Fewer than there are would leave rows that nobody asked for.
    file(&folder, &QUICK.replace("runs = 24", "runs = 8"));
    assert!(refused(&path, &grown, &["--signals"]).contains("holds run 8: runs must be at least 9"));
}

#[test]
fn a_sweep_that_is_killed_goes_on_where_it_was_and_has_the_bits_of_one_that_was_not() {
    let folder = common::folder("sweep-killed");
    let path = file(&folder, QUICK);
    let (killed, whole) = (folder.join("killed"), folder.join("whole"));
    let rows = || fs::read_to_string(killed.join("rows.log")).unwrap_or_default().lines().count();
    let mut kills = 0;
    for at_least in [3, 10, 17] {
        let mut child = program(&path, &killed, &["--jobs", "2", "--signals", "parquet"])
            .stderr(Stdio::null())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        while rows() < at_least && child.try_wait().unwrap().is_none() {
            thread::sleep(Duration::from_millis(2));
        }
        child.kill().unwrap();
        kills += usize::from(!child.wait().unwrap().success());
        let kept = rows();
        assert!(kept >= at_least, "{kept} rows");
        // A table that is there is whole.
        if killed.join("runs.parquet").exists() {
            table(&killed);
        }
        // What a machine that loses its power may leave: half a row.
        let log = fs::read_to_string(killed.join("rows.log")).unwrap();
        fs::write(killed.join("rows.log"), format!("{log}{}", &log[..log.len() / 40])).unwrap();
    }
    assert!(kills >= 2, "the sweep was over before it could be ended");
    let told = sweep(&path, &killed, &["--signals", "parquet"]);
    assert!(told.contains("24 runs,") && !told.contains(" 24 of them"), "{told}");
    sweep(&path, &whole, &["--signals", "parquet"]);
    same_bits(&killed, &whole);
    let signals = File::open(whole.join("signals/run-0000003.parquet")).unwrap();
    let signals = SerializedFileReader::new(signals).unwrap();
    let pairs = signals.metadata().file_metadata().key_value_metadata().unwrap();
    let scene = pairs.iter().find(|pair| pair.key == "brinell.scene").unwrap().value.as_deref().unwrap();
    assert_eq!(scene, scene_of(&path, &whole, "3"));
    let left: Vec<_> = fs::read_dir(&killed).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 6, "design, lock, rows, table, card and signals: {left:?}");
}

#[test]
fn maps_of_spalls_have_half_the_rows_unless_the_sweep_says_otherwise_and_those_of_traces_the_usual_ones() {
    let folder = common::folder("sweep-cells");
    let cells = |scene: &str, set: &str| {
        let path = file(&folder, &format!("scene = \"{scene}\"\nruns = 1\n[set]\n{set}\n"));
        let scene: toml::Table = scene_of(&path, &folder.join("out"), "0").parse().unwrap();
        scene["contact"].get("cells").map(toml::Value::to_string)
    };
    let some = |cells: &str| Some(cells.to_owned());
    assert_eq!(cells("er16k-tb1", ""), some("[48, 16]"));
    assert_eq!(cells("er16k-tb1", "contact.cells = [32, 24]"), some("[32, 24]"));
    assert_eq!(cells("er16k-tb1", "contact.law = \"hertz\""), None);
    assert_eq!(cells("6205-epps", ""), None);
}

#[test]
fn each_run_has_the_bits_of_brinell_run_of_its_scene() {
    let folder = common::folder("sweep-as-run");
    let text = QUICK.replace("noise_db = [0, 30]\n", "").replace("runs = 24", "runs = 6");
    let (path, out) = (file(&folder, &text), folder.join("out"));
    sweep(&path, &out, &["--signals"]);
    for run in [0, 4] {
        let (scene, alone) = (folder.join("scene.toml"), folder.join("alone"));
        fs::write(&scene, scene_of(&path, &out, &run.to_string())).unwrap();
        let mut command = brinell(&["run", "--stop", "0.03", "--step", "3.90625e-5", "--no-figure", "--format", "npy"]);
        done(command.args(["--columns", "sensor.acceleration", "-o"]).arg(&alone).arg(&scene));
        let (_, kept) = npy(&out.join(format!("signals/run-{run:07}.npy")), 2);
        let (_, alone) = npy(&alone.join(format!("run-{run:07}-signals.npy")), 2);
        assert_eq!(kept[..], alone[alone.len() - kept.len()..], "run {run}");
        // 30 ms hold 768 samples, 10 ms 256.
        assert_eq!((kept.len(), alone.len()), (512, 769));
    }
}

#[test]
fn a_run_that_fails_is_a_row_with_its_error_and_the_others_go_on() {
    let folder = common::folder("sweep-failing");
    let text = QUICK.replace("[random]", "solver.max_steps = [1000000, 3]\n[random]");
    let (path, out) = (file(&folder, &text), folder.join("out"));
    let told = sweep(&path, &out, &["--signals", "wav"]);
    assert!(told.contains("24 runs, 24 of them made now, 12 failed"), "{told}");
    let (steps, errors, rms) = (column(&out, "solver.max_steps"), column(&out, "error"), column(&out, "rms_m_s2"));
    for ((most, error), rms) in steps.iter().zip(&errors).zip(&rms) {
        match (most, error, rms) {
            (Field::Long(1_000_000), Field::Null, Field::Double(rms)) => assert!(*rms > 0.0),
            (Field::Long(3), Field::Str(said), Field::Null) => {
                assert!(said.contains("3 steps") || said.contains("max_steps"), "{said}")
            }
            other => panic!("{other:?}"),
        }
    }
    let sounds = fs::read_dir(out.join("signals")).unwrap().count();
    assert_eq!(sounds, 12, "signals of runs that did not fail");
    // A run that failed is made: it would fail again.
    assert!(sweep(&path, &out, &["--signals", "wav"]).contains("24 runs, 0 of them made now, 12 failed"));
}

#[test]
fn rows_say_what_they_are_runs_of() {
    let folder = common::folder("sweep-labels");
    let text = QUICK.replace("[random]", "bearing.element_count = [8, 9]\n[random]\ndefect.angle_deg = [-120, -60]");
    let (path, out) = (file(&folder, &text), folder.join("out"));
    sweep(&path, &out, &[]);
    assert!(!out.join("signals").exists());
    let text = |name: &str| words(&out, name);
    assert_eq!(text("kind")[..4], ["healthy", "outer", "inner", "healthy"]);
    assert_eq!(text("label_kind"), text("kind"));
    let number = |name: &str| numbers(&out, name);
    let healthy: Vec<bool> = text("kind").iter().map(|kind| kind == "healthy").collect();
    for (label, key) in [
        ("label_length_mm", "defect.length_mm"),
        ("label_angle_deg", "defect.angle_deg"),
        ("label_load_n", "shaft.load_n"),
    ] {
        for ((label_of, value), healthy) in number(label).into_iter().zip(number(key)).zip(&healthy) {
            if *healthy && label != "label_load_n" {
                assert_eq!((label_of, value), (None, None), "{label} and {key} of a healthy run");
            } else {
                // Metres and back again, and a vector's length.
                assert!((label_of.unwrap() / value.unwrap() - 1.0).abs() < 1e-11, "{label}: {label_of:?} {value:?}");
            }
        }
    }
    // The passage frequency of the outer raceway, Z/2 (1 − D/d) n, except for the cage's slip, of which there is none.
    for ((bpfo, count), speed) in
        number("bpfo_hz").iter().zip(number("bearing.element_count")).zip(number("shaft.speed_hz"))
    {
        let expected = 0.5 * count.unwrap() * (1.0 - 7.94 / 39.325) * speed.unwrap();
        // The pitch diameter under clearance.
        assert!((bpfo.unwrap() / expected - 1.0).abs() < 1e-3, "{bpfo:?} {expected}");
    }
    // Only a defect of the outer raceway is passed where the elements' angles say; 2 mm are 4.8 degrees.
    let (unloaded, kinds) = (number("unloaded_deg"), text("kind"));
    assert!(unloaded.iter().zip(&kinds).all(|(found, kind)| found.is_none() || kind == "outer"));
    assert!(unloaded.iter().flatten().count() > 0);
    assert!(number("steps").iter().all(|steps| steps.unwrap() > 768.0));
}

#[test]
fn a_sweep_measures_with_noise_a_filter_and_a_speed_that_changes() {
    let folder = common::folder("sweep-measured");
    fs::write(folder.join("up.csv"), "time_s,speed_hz\n0,10\n0.03,40\n").unwrap();
    fs::write(folder.join("even.csv"), "time_s,speed_hz\n0,20\n1,20\n").unwrap();
    let measured = QUICK
        .replace("shaft.speed_hz = [10, 40]\n", "")
        .replace("runs = 24", "filter = true\nspeed_profiles = [\"up.csv\", \"even.csv\"]\nruns = 24");
    let path = file(&folder, &measured);
    let (noisy, clean) = (folder.join("noisy"), folder.join("clean"));
    sweep(&path, &noisy, &[]);
    file(&folder, &measured.replace("noise_db = [0, 30]\n", ""));
    sweep(&path, &clean, &[]);
    let profiles = column(&noisy, "speed_profile");
    for (speed, profile) in all(&noisy, "label_speed_hz").into_iter().zip(&profiles) {
        // The mean of 20 to 40 Hz over the last 20 ms, to a sample of 512.
        let expected = if profile.to_string().contains("up") { 30.0 } else { 20.0 };
        assert!((speed - expected).abs() < 0.03, "{profile}: {speed}");
    }
    let levels = all(&noisy, "rms_m_s2").into_iter().zip(all(&clean, "rms_m_s2"));
    for ((noisy, clean), ratio) in levels.zip(all(&noisy, "noise_db")) {
        let expected = clean * (1.0 + 10f64.powf(-ratio / 10.0)).sqrt();
        // Noise of some 500 samples: four standard deviations of its own level and of what it shares with the signal.
        assert!((noisy / expected - 1.0).abs() < 0.25, "{noisy} {clean} at {ratio} dB");
    }
}

#[test]
fn runs_of_other_loads_clearances_and_lengths_share_one_contact_map_whatever_the_number_of_threads() {
    let folder = common::folder("sweep-maps");
    let text = "scene = \"er16k-tb1\"\nruns = 12\nstop_s = 0.01\nsettle_s = 0.002\nrate_hz = 25600\n\
        [set]\ncontact.cells = [24, 12]\ncontact.map_accuracy = 0.02\n\
        [grid]\nbearing.radial_clearance_um = [3, 5, 6.5, 7]\n[random]\nshaft.load_n = [100, 450]\n\
        defect.length_mm = [4, 6]\n";
    let path = file(&folder, text);
    let maps_of = |jobs: &str| -> Vec<(String, Vec<u8>)> {
        let (out, cache) = (folder.join(format!("out-{jobs}")), folder.join(format!("cache-{jobs}")));
        let told = done(program(&path, &out, &["--jobs", jobs]).env("BRINELL_CACHE", &cache)).err;
        assert!(told.contains("12 runs, 12 of them made now, 0 failed"), "{told}");
        let entries = fs::read_dir(cache.join("maps")).unwrap().map(|entry| entry.unwrap().path());
        entries
            .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(path).unwrap()))
            .collect()
    };
    let (one, two) = (maps_of("1"), maps_of("2"));
    assert_eq!(one.len(), 1, "maps {:?}", one.iter().map(|(name, _)| name).collect::<Vec<_>>());
    assert!(one == two, "a map has other bits on two threads");
    same_bits(&folder.join("out-1"), &folder.join("out-2"));
    // Other clearances are other runs all the same.
    let rms = column(&folder.join("out-1"), "rms_m_s2");
    assert!(rms.iter().enumerate().all(|(k, one)| !rms[..k].contains(one)), "{rms:?}");
}
