//! What a user reads when something is wrong: the reason, once.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::fs;
use std::process::{Command, Output};

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_brinell")).args(arguments).output().unwrap()
}

#[track_caller]
fn once(said: &str, words: &str) {
    assert_eq!(said.matches(words).count(), 1, "`{words}` once in: {said}");
}

#[test]
fn a_reader_that_has_gone_ends_the_program_without_a_word() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let ended = Command::new(env!("CARGO_BIN_EXE_brinell")).arg("scenes").stdout(writer).output().unwrap();
    assert!(!ended.status.success());
    assert_eq!(String::from_utf8(ended.stderr).unwrap(), "");
}

#[cfg(unix)]
#[test]
fn a_library_that_cannot_be_loaded_is_said_once() {
    common::python();
    let folder = common::folder("no-library");
    let (library, out) = (folder.join("no.so").display().to_string(), folder.display().to_string());
    fs::write(&library, "no library").unwrap();
    let scene = common::root().join("scenes/6205-healthy.toml").display().to_string();
    assert!(program(&["build", &scene, "--library", &library, "-o", &out]).status.success());
    let output = program(&["check", &folder.join("6205-healthy.fmu").display().to_string()]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success());
    once(&said, "Failed to load shared library");
}

#[test]
fn a_new_scene_runs_as_it_is_and_is_not_written_over() {
    let folder = common::folder("new-scene");
    let into = folder.display().to_string();
    let new = ["new", "mine", "--bearing", "6206-2RS", "--defect", "inner:1.2mm", "--output", &into];
    assert!(program(&new).status.success());
    let scene = folder.join("mine.toml").display().to_string();
    let run = program(&["run", &scene, "--no-figure", "--stop", "0.002", "--output", &into]);
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let again = String::from_utf8(program(&new).stderr).unwrap();
    once(&again, "is there already and stays as it is");
    let unknown = String::from_utf8(program(&["new", "other", "--bearing", "30205"]).stderr).unwrap();
    once(&unknown, "6204, 6205, 6206");
    for (name, found) in [("NJ205", "\nNU205 "), ("6205-2RS", "\n6205 "), ("nu20", "\nNU203 ")] {
        once(&String::from_utf8(program(&["catalogue", name]).stdout).unwrap(), found);
    }
    let listed = String::from_utf8(program(&["catalogue", "62"]).stdout).unwrap();
    once(&listed, "Case Western Reserve University's bearing data, drive end");
    let count = |word: &str| listed.lines().filter(|line| line.contains(word)).count();
    // 6200, 6201 and 6202; 6204 and 6206 to 6212.
    assert_eq!((count("assumed"), count("table A-9")), (3, 8), "{listed}");
    assert!(!listed.contains("\n60"), "{listed}");
}

#[test]
fn depths_of_a_profile_that_may_be_meant_in_millimetres_are_asked_about() {
    let folder = common::folder("depths");
    let healthy = fs::read_to_string(common::root().join("scenes/6205-healthy.toml")).unwrap();
    let scene = folder.join("dented.toml").display().to_string();
    let healthy = healthy.replace("[contact]", "[contact]\nlaw = \"hertz\"");
    fs::write(&scene, healthy + "\n[[defect]]\nangle_deg = -90.0\nprofile = \"dent.csv\"\n").unwrap();
    let out = folder.join("out").display().to_string();
    let said = |depth: &str| {
        let rows = format!("arc_mm,depth_um\n-0.5,0\n-0.4,{depth}\n0.4,{depth}\n0.5,0\n");
        fs::write(folder.join("dent.csv"), rows).unwrap();
        let output = program(&["run", &scene, "--stop", "1e-4", "--no-figure", "-o", &out]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{said}");
        said
    };
    once(&said("0.05"), "note: dent.csv: its depths reach 0.05 um: 50 um given in millimetres? Usual are 0.5 to");
    assert!(!said("50").contains("dent.csv: its depths"));
}

#[test]
fn scenes_that_are_written_have_the_schema_beside_them_that_they_name() {
    let folder = common::folder("schema-beside");
    let into = folder.display().to_string();
    let schema = folder.join("scene.schema.json");
    for command in [&["new", "mine"][..], &["scenes", "6205-epps"]] {
        let output = program(&[command, &["--output", &into]].concat());
        assert!(output.status.success());
        once(&String::from_utf8(output.stdout).unwrap(), "scene.schema.json");
        assert_eq!(fs::read(&schema).unwrap(), program(&["schema"]).stdout);
        fs::remove_file(&schema).unwrap();
    }
    // Somebody else's stays.
    fs::write(&schema, "{}").unwrap();
    assert!(program(&["new", "other", "--output", &into]).status.success());
    assert_eq!(fs::read_to_string(&schema).unwrap(), "{}");
}

#[test]
fn lines_stay_those_of_the_file_where_a_response_becomes_modes() {
    let folder = common::folder("response-lines");
    let text = fs::read_to_string(common::root().join("scenes/6205-spall-5deg.toml")).unwrap();
    let table = (1..60).map(|k| format!("{},{},{}\n", 50 * k, 1.0 / f64::from(k), 0.1)).collect::<String>();
    fs::write(folder.join("frf.csv"), format!("frequency_hz,real,imaginary\n{table}")).unwrap();
    let spoilt =
        text.replace("\n[sensor]\n", "\n[sensor]\nresponse = \"frf.csv\"\n").replace("stop_s = ", "stop_s = -");
    let line = 1 + spoilt.lines().position(|line| line.starts_with("stop_s")).unwrap();
    let scene = folder.join("scene.toml").display().to_string();
    fs::write(&scene, &spoilt).unwrap();
    let said = String::from_utf8(program(&["run", &scene]).stderr).unwrap();
    once(&said, &format!("line {line}: stop time (experiment.stop_s)"));
    // A file that is not there hides nothing.
    fs::write(&scene, spoilt.replace("frf.csv", "none.csv")).unwrap();
    let said = String::from_utf8(program(&["run", &scene]).stderr).unwrap();
    once(&said, "sensor.response \"none.csv\"");
    once(&said, &format!("line {line}: stop time (experiment.stop_s)"));
}

#[test]
fn a_recording_that_cannot_be_read_is_told_with_its_cause_once() {
    let folder = common::folder("no-recording");
    let missing = folder.join("missing.npy");
    for path in [&missing, &folder] {
        let shown = path.display().to_string();
        let output = program(&["size", &shown, "--scene", "6205-healthy", "--rate", "20000", "--speed", "10"]);
        let cause = fs::read(path).unwrap_err();
        assert_eq!(String::from_utf8(output.stderr).unwrap(), format!("error: {shown}: {cause}\n"));
        assert!(!output.status.success());
    }
}

#[test]
fn a_sampling_rate_that_is_none_is_told_so_also_where_the_file_states_its_own() {
    let folder = common::folder("no-rate");
    for (name, heading, time) in [("own", "time_s,a", "0.001,"), ("none", "a", "")] {
        let path = folder.join(format!("{name}.csv"));
        fs::write(&path, format!("{heading}\n{}1\n{time}2\n", time.replace('1', "0"))).unwrap();
        for rate in ["0", "-5", "nan"] {
            let arguments = ["--scene", "6205-healthy", "--rate", rate, "--speed", "10"];
            let output = program(&[&["size", path.to_str().unwrap()][..], &arguments].concat());
            let said = String::from_utf8(output.stderr).unwrap();
            let rate = rate.replace("nan", "NaN");
            let told = format!("error: {name}.csv: sampling rate {rate} Hz: it must be finite and above 0\n");
            assert_eq!(said, told);
        }
    }
}
