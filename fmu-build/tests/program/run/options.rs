//! What `run` can be told, as a program: columns and formats of its table, a speed that changes, noise, sound.
#![allow(clippy::unwrap_used)]

use crate::common;
use crate::common::program::{Table, brinell, npy, refused};
use std::f64::consts::TAU;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

/// A scene that is quick: of law `hertz`, without a defect.
const QUICK: &str = "6205-healthy";

/// Runs a scene without a figure, and gives what it says beside its files.
#[track_caller]
fn run(scene: impl AsRef<OsStr>, out: &Path, more: &[&str]) -> String {
    super::run(scene, out, &[&["--no-figure"], more].concat()).err
}

/// What a run of the quick scene has written.
fn table(out: &Path) -> Table {
    Table::read(&out.join(QUICK).with_extension("csv"))
}

/// A changed copy of the quick scene.
fn changed(folder: &Path, by: impl Fn(&str) -> String) -> PathBuf {
    let path = folder.join("changed.toml");
    fs::write(&path, by(&common::scene_text(QUICK))).unwrap();
    path
}

/// Rate and samples of a run's sound.
fn wav(out: &Path) -> (u32, Vec<f32>) {
    let mut reader = hound::WavReader::open(out.join("6205-healthy.wav")).unwrap();
    (reader.spec().sample_rate, reader.samples::<f32>().map(Result::unwrap).collect())
}

fn rms(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    (values.map(|x| (x - mean) * (x - mean)).sum::<f64>() / count).sqrt()
}

#[test]
fn the_columns_that_are_asked_for_have_the_same_bits_in_every_format() {
    let folder = common::folder("run-columns");
    let (whole, part) = (folder.join("whole"), folder.join("part"));
    run(QUICK, &whole, &["--stop", "0.01"]);
    let asked = ["--stop", "0.01", "--columns", "shaft.x,sensor.acceleration,element[*].force.outer,solver.steps"];
    for format in ["csv", "npy", "parquet"] {
        run(QUICK, &part, &[&asked[..], &["--format", format]].concat());
    }
    let all = table(&whole);
    let some = table(&part);
    assert_eq!(some.heads.len(), 13, "time, three and nine: {:?}", some.heads);
    assert_eq!(some.rows.len(), 101);
    for name in &some.heads {
        assert_eq!(some.column(name), all.column(name), "{name}");
    }
    let (header, rows) = npy(&part.join("6205-healthy-signals.npy"), 13);
    assert!(header.contains("('element[9].force.outer', '<f8')") && header.contains("(101,)"), "{header}");
    assert_eq!(rows, some.rows);
    let file = fs::File::open(part.join("6205-healthy.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let names: Vec<String> =
        reader.metadata().file_metadata().schema().get_fields().iter().map(|f| f.name().to_owned()).collect();
    assert_eq!(names, some.names());
    let units = reader.metadata().file_metadata().key_value_metadata().unwrap();
    assert!(units.iter().any(|pair| pair.key == "unit:shaft.x" && pair.value.as_deref() == Some("m")), "{units:?}");
    let text = common::scene_text(QUICK);
    assert!(units.iter().any(|pair| pair.key == "brinell.scene" && pair.value.as_ref() == Some(&text)), "{units:?}");
    let read: Vec<Vec<f64>> = reader
        .get_row_iter(None)
        .unwrap()
        .map(|row| (0..13).map(|index| row.as_ref().unwrap().get_double(index).unwrap()).collect())
        .collect();
    assert_eq!(read, some.rows);
}

#[test]
fn the_shaft_turns_as_the_profile_says_and_the_run_ends_with_it() {
    let folder = common::folder("run-profile");
    let (profile, out) = (folder.join("up.csv"), folder.join("out"));
    fs::write(&profile, "time_s,speed_hz\n0,10\n0.02,10\n0.06,30\n0.08,0\n0.1,-20\n").unwrap();
    let columns = ["--columns", "shaft.speed,cage.*,shaft.force.y"];
    run(QUICK, &out, &[&["--speed-profile", profile.to_str().unwrap()], &columns[..]].concat());
    let table = table(&out);
    let [time, speed, angle] = ["time", "shaft.speed", "cage.angle"].map(|name| table.column(name));
    assert_eq!(time.len(), 1001);
    // Turns of the shaft until each row of the profile, by trapezia.
    let turns_until = [(0.0, 10.0, 0.0), (0.02, 10.0, 0.2), (0.06, 30.0, 1.0), (0.08, 0.0, 1.3), (0.1, -20.0, 1.1)];
    let mut most = 0.0f64;
    for i in 0..time.len() {
        let next = turns_until.iter().position(|row| row.0 >= time[i] - 1e-12).unwrap().max(1);
        let ((t0, f0, n0), (t1, f1, _)) = (turns_until[next - 1], turns_until[next]);
        let f = f0 + (f1 - f0) * (time[i] - t0) / (t1 - t0);
        assert!((speed[i] / TAU - f).abs() < 1e-9, "{} s: {} Hz", time[i], speed[i] / TAU);
        let turns = n0 + 0.5 * (f0 + f) * (time[i] - t0);
        // Pure rolling: a 6205's cage makes ½ (1 − γ) of the shaft's turns, 0.398316.
        let ratio = 0.5 * (1.0 - 7.94 / 39.04);
        let cage = (angle[i] - angle[0] - ratio * TAU * turns + 9.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        most = most.max(cage.abs());
    }
    // Rounding of a thousand steps.
    assert!(most < 1e-9, "the cage is {most} rad off");
    assert!(table.column("shaft.force.y").iter().all(|force| (force - 1500.0).abs() < 400.0));
}

#[test]
fn noise_is_of_the_sensors_alone_as_strong_as_asked_and_the_same_again() {
    let folder = common::folder("run-noise");
    // Shaken by a load that turns, and recorded.
    let scene = changed(&folder, |text| format!("{text}\n[recorder]\nrate_hz = 12800.0\n"));
    let made = |name: &str, more: &[&str]| {
        let out = folder.join(name);
        run(&scene, &out, &[&["--stop", "0.2"], more].concat());
        (table(&out), fs::read(out.join("6205-healthy.npy")).unwrap())
    };
    let (clean, recorded) = made("clean", &[]);
    let noisy = made("noisy", &["--noise-db", "10"]);
    assert!(noisy == made("again", &["--noise-db", "10"]), "other bits");
    let ((noisy, noisy_recorded), (other, _)) = (noisy, made("other", &["--noise-db", "10", "--noise-seed", "2"]));
    for name in clean.names() {
        let same = clean.column(name) == noisy.column(name);
        assert_eq!(same, name != "sensor.acceleration", "{name}");
    }
    let [before, after] = [&clean, &noisy].map(|table| table.column("sensor.acceleration"));
    let ratio = rms(before.iter().copied()) / rms(before.iter().zip(&after).map(|(a, b)| b - a));
    // Four standard errors of 2001 draws are 0.55 dB.
    assert!((20.0 * ratio.log10() - 10.0).abs() < 0.55, "{} dB", 20.0 * ratio.log10());
    assert_ne!(after, other.column("sensor.acceleration"));
    assert!(recorded.len() == noisy_recorded.len() && recorded != noisy_recorded);
}

#[test]
fn a_large_table_has_what_is_measured_and_how_the_rings_move_unless_all_is_asked_for() {
    let folder = common::folder("run-large-table");
    let long = ["--stop", "0.15", "--step", "1e-5"];
    let said = run("7205-preloaded", &folder, &long);
    assert!(said.contains("note: 15001 points: the table has 16 of 162 columns; --columns '*' gives all"), "{said}");
    let file = folder.join("7205-preloaded.csv");
    let table = Table::read(&file);
    let names = table.names();
    assert_eq!((names.len(), table.rows.len()), (17, 15_001), "{names:?}");
    for name in ["time", "sensor.acceleration", "shaft.z", "shaft.force.z", "probe.x", "cage.angle"] {
        assert!(names.contains(&name), "{name} in {names:?}");
    }
    let size = fs::metadata(&file).unwrap().len();
    assert!(size < 6_000_000, "{size} bytes");
    run("7205-preloaded", &folder, &["--stop", "0.0001", "--step", "1e-5"]);
    assert_eq!(Table::read(&file).heads.len(), 163);
}

#[test]
fn the_recorders_file_keeps_what_columns_name() {
    let folder = common::folder("recorded-columns");
    let scene = changed(&folder, |text| format!("{text}\n[recorder]\nrate_hz = 12800.0\n"));
    let (all, some, none) = (folder.join("all"), folder.join("some"), folder.join("none"));
    run(&scene, &all, &["--stop", "0.01"]);
    run(&scene, &some, &["--stop", "0.01", "--columns", "sensor.*"]);
    let said = run(&scene, &none, &["--stop", "0.01", "--columns", "shaft.load.y"]);
    assert!(said.contains("the recorder samples nothing that --columns names"), "{said}");
    assert!(!none.join("6205-healthy.npy").exists());
    let text = "import sys\nimport numpy as np\n\
                a, b = (np.load(f'{folder}/6205-healthy.npy') for folder in sys.argv[1:])\n\
                assert b.dtype.names == ('time', 'sensor.acceleration') and len(a.dtype.names) > 20, b.dtype.names\n\
                assert len(b) > 50 and all((a[name] == b[name]).all() for name in b.dtype.names)\n";
    common::run_text(common::python(), &folder, text, [&all, &some]);
}

#[test]
fn sound_is_what_the_recorder_filters_at_the_rate_and_scale_that_are_asked_for() {
    let folder = common::folder("run-wav");
    let scene = changed(&folder, |text| format!("{text}\n[recorder]\nrate_hz = 12800.0\n"));
    let wav = |name: &str| wav(&folder.join(name));
    run(&scene, &folder.join("own"), &["--stop", "0.05", "--wav", "--wav-scale", "20"]);
    let (rate, samples) = wav("own");
    let path = folder.join("own/6205-healthy.npy");
    let fields = String::from_utf8_lossy(&fs::read(&path).unwrap()[12..2000]).matches("'<f8'").count();
    let (header, rows) = npy(&path, fields);
    let index = header.split("'<f8'").position(|field| field.contains("'sensor.acceleration'")).unwrap();
    let expected: Vec<f32> = rows.iter().map(|row| (row[index] / 20.0) as f32).collect();
    // The filter's reach is taken off the end.
    assert_eq!((rate, samples.len()), (12_800, 640 - 15));
    assert_eq!(samples, expected);
    // Without a recorder in the scene there is sound, and no recording; another rate is another filter's.
    let said = run(QUICK, &folder.join("usual"), &["--stop", "0.05", "--wav"]);
    assert!(said.contains("51200 Hz, 1 is 1 m/s2"), "{said}");
    assert_eq!((wav("usual").0, wav("usual").1.len()), (51_200, 2560 - 15));
    assert!(!folder.join("usual/6205-healthy.npy").exists());
    run(&scene, &folder.join("other"), &["--stop", "0.05", "--wav", "--wav-rate", "25600"]);
    assert_eq!((wav("other").0, wav("other").1.len()), (25_600, 1280 - 15));
}

#[test]
fn sound_that_players_clip_is_warned_of_with_the_share_that_they_clip() {
    let folder = common::folder("run-clipped");
    let said = run(QUICK, &folder, &["--stop", "0.05", "--wav", "--wav-scale", "0.1"]);
    let (_, samples) = wav(&folder);
    let beyond = samples.iter().filter(|sample| sample.abs() > 1.0).count() as f64;
    assert!(beyond > 0.0 && beyond < samples.len() as f64, "{beyond} of {}", samples.len());
    let warning = said.lines().find(|line| line.starts_with("warning: ")).unwrap_or_else(|| panic!("{said}"));
    let share: f64 = warning.split(" %").next().unwrap().rsplit(' ').next().unwrap().parse().unwrap();
    // Six digits are told.
    assert!((share / (100.0 * beyond / samples.len() as f64) - 1.0).abs() < 1e-5, "{warning}");
    let enough: f64 = warning.split("--wav-scale above ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    let said = run(QUICK, &folder, &["--stop", "0.05", "--wav", "--wav-scale", &(1.0001 * enough).to_string()]);
    assert!(!said.contains("warning"), "{said}");
}

#[test]
fn a_run_ends_at_its_stop_time_with_a_shorter_step_where_that_is_no_multiple_of_the_step() {
    let folder = common::folder("run-stop");
    run(QUICK, &folder, &["--stop", "0.05", "--step", "7e-3"]);
    let time = table(&folder).column("time");
    assert_eq!((time.len(), time[8]), (9, 0.05));
    assert!((time[7] - 0.049).abs() < 1e-15, "{time:?}");
    // A profile is run to its end.
    let profile = folder.join("speeds.csv");
    fs::write(&profile, "time_s,speed_hz\n0,10\n0.0105,20\n").unwrap();
    run(QUICK, &folder, &["--speed-profile", profile.to_str().unwrap(), "--step", "1e-3"]);
    let [time, speed] = ["time", "shaft.speed"].map(|name| table(&folder).column(name));
    assert_eq!((time.len(), time[11]), (12, 0.0105));
    // The mean of the whole: rounding of a dozen sums.
    assert!((speed[11] / TAU - 20.0).abs() < 1e-12, "{}", speed[11] / TAU);
}

#[test]
fn columns_may_name_the_time_and_are_told_apart_once() {
    let folder = common::folder("run-rough-columns");
    let out = folder.join("out");
    run(QUICK, &out, &["--stop", "0.001", "--columns", "time,shaft.x,shaft.*", "--columns", "shaft.x,tim*"]);
    let table = table(&out);
    let names = table.names();
    assert_eq!(names[0], "time");
    let mut once = names.clone();
    once.sort();
    once.dedup();
    assert_eq!(once.len(), names.len(), "{names:?}");
}

#[test]
fn a_table_does_not_take_the_place_of_a_profile() {
    let folder = common::folder("run-spares-profiles");
    let depth = |k: i32| (f64::from(100 - k.abs()) / 4.0).min(5.0);
    let points = (-100..=100).map(|k| format!("{:.3},{:.2}\n", 0.005 * f64::from(k), depth(k)));
    let trace: String = std::iter::once("arc_mm,depth_um\n".to_owned()).chain(points).collect();
    fs::write(folder.join("dent.csv"), &trace).unwrap();
    let defect = "\n[[defect]]\nangle_deg = -90.0\nprofile = \"dent.csv\"\n";
    let scene = changed(&folder, |text| text.replace("\"6205-healthy\"", "\"dent\"") + defect);
    let said = refused(brinell(&["run", "--stop", "1e-3", "-o"]).arg(&folder).arg(&scene));
    assert!(said.contains("is the profile of a defect, dent.csv"), "{said}");
    assert_eq!(fs::read_to_string(folder.join("dent.csv")).unwrap(), trace);
    // Another folder, or another kind of table, is fine.
    run(&scene, &folder, &["--stop", "1e-3", "--format", "npy"]);
    run(&scene, &folder.join("out"), &["--stop", "1e-3"]);
}
