//! The examples and the guide: every command of `docs/guide.md` runs, on a short case, and its result is looked at.
//! They have a Python environment of their own, made from `examples/requirements.txt`.
#![allow(clippy::unwrap_used)]

mod common;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fmu_build::project::Project;
use fmu_build::python::Python;
use serde_json::Value;

const RIGID: &str = "python examples/step_by_step.py --stop 0.06";
const RESPONSE: &str = "python examples/rotor_ross.py response --short";
const LINEAR: &str = "python examples/rotor_ross.py linear --short";
const SWEEP: &str = "python examples/sweep.py --runs 8 --stop 0.1";
/// What this file's environment does itself.
const SET_UP: [&str; 2] =
    ["python3 -m venv target/examples-env", "target/examples-env/bin/pip install -r examples/requirements.txt"];

fn python() -> &'static Python {
    static PYTHON: OnceLock<Python> = OnceLock::new();
    PYTHON.get_or_init(|| {
        let requirements = fs::read_to_string(common::root().join("examples/requirements.txt")).unwrap();
        let python = Python::prepare_from(&Project::find(), "examples-python", &requirements).unwrap();
        python.with_variable("BRINELL_FMU", env!("CARGO_BIN_EXE_fmu-build"))
    })
}

/// Runs a command of the guide with a folder of its own, and reads its last line.
fn run(command: &str, folder: &Path) -> Value {
    let mut words = command.strip_prefix("python ").unwrap().split(' ');
    let script = common::root().join(words.next().unwrap());
    let arguments = words.map(OsString::from).chain(["-o".into(), folder.into()]);
    let said = python().run_file(&script, arguments).unwrap_or_else(|error| panic!("{error:#}"));
    serde_json::from_str(said.lines().last().unwrap()).unwrap()
}

fn has_figure(stem: PathBuf) {
    for suffix in ["svg", "png"] {
        let path = stem.with_extension(suffix);
        assert!(path.metadata().is_ok_and(|file| file.len() > 10_000), "{}", path.display());
    }
}

/// Blocks of the guide in this language.
fn blocks(language: &str) -> Vec<String> {
    let guide = fs::read_to_string(common::root().join("docs/guide.md")).unwrap();
    let fence = format!("```{language}\n");
    let parts = guide.split(&fence).skip(1);
    parts.map(|part| part.split("```").next().unwrap().to_owned()).collect()
}

#[test]
fn every_command_of_the_guide_is_run_here() {
    let known = [RIGID, RESPONSE, LINEAR, SWEEP];
    let commands: Vec<_> =
        blocks("sh").iter().flat_map(|block| block.lines().map(str::to_owned).collect::<Vec<_>>()).collect();
    for command in &commands {
        assert!(known.contains(&command.as_str()) || SET_UP.contains(&command.as_str()), "not run: {command}");
    }
    for command in known {
        assert!(commands.iter().any(|found| found == command), "not in the guide: {command}");
    }
}

#[test]
fn the_code_in_the_guide_runs() {
    let code = blocks("python");
    assert_eq!(code.len(), 1);
    let root = common::root().display().to_string();
    let folder = common::folder("guide");
    let script = folder.join("guide.py");
    let text = code[0]
        .replace("\"examples\"", &format!("{:?}", format!("{root}/examples")))
        .replace("\"target/examples\"", &format!("{:?}", folder.display().to_string()));
    fs::write(&script, text).unwrap();
    python().run_file(&script, [""; 0]).unwrap_or_else(|error| panic!("{error:#}"));
}

#[test]
fn two_bearings_carry_a_rigid_rotor() {
    let folder = common::folder("example-rigid");
    let said = run(RIGID, &folder);
    has_figure(folder.join("step_by_step"));
    // 1000 N and 6 kg, 0.18 m and 0.22 m from the bearings 0.40 m apart. Over two passages the mean of the ringing
    // and of the momentum that the rotor gains is within 5 % of it.
    for (name, share) in [("mean_force_left_n", 0.45), ("mean_force_right_n", 0.55)] {
        let (found, expected) = (said[name].as_f64().unwrap(), share * (1000.0 + 6.0 * 9.81));
        assert!((found / expected - 1.0).abs() < 0.05, "{name}: {found}, expected {expected}");
    }
    assert!(said["largest_sensor_m_s2"].as_f64().unwrap() > 1.0, "the spall is felt: {said}");
}

#[test]
fn a_ross_rotor_shows_the_passage_frequency_of_a_spalled_bearing() {
    let folder = common::folder("example-ross");
    let said = run(RESPONSE, &folder);
    has_figure(folder.join("rotor_ross"));
    let order = said["bpfo_order"].as_f64().unwrap();
    // 9/2 (1 − 7.94/39.32)
    assert!((order - 3.591_302_1).abs() < 1e-6, "{order}");
    let at = |bearing: &str| said[format!("place_um_{bearing}")][format!("{order:.3}")].as_f64().unwrap();
    // A healthy bearing has the frequency too, by its varying compliance; the full case has a ratio of 34.
    assert!(at("spalled") > 10.0 * at("healthy"), "{said}");
}

#[test]
fn small_motion_of_a_ross_rotor_is_that_with_a_linear_bearing() {
    let folder = common::folder("example-linear");
    let said = run(LINEAR, &folder);
    has_figure(folder.join("rotor_ross_linear"));
    // What is asked of the coupling: response 2 %, frequency of the free decay 0.5 %.
    for (name, limit) in [("largest_error_disk", 0.02), ("largest_error_bearing", 0.02), ("decay_hz_error", 0.005)] {
        let found = said[name].as_f64().unwrap().abs();
        assert!(found < limit, "{name}: {found}, limit {limit}");
    }
}

#[test]
fn a_sweep_runs_its_design() {
    let folder = common::folder("example-sweep");
    let said = run(SWEEP, &folder);
    assert_eq!((said["runs"].as_u64(), said["failed"].as_u64()), (Some(8), Some(0)), "{said}");
    // Started again it has nothing to do.
    assert_eq!(run(SWEEP, &folder)["runs"].as_u64(), Some(0));
}

#[test]
fn a_sweep_keeps_every_run_once_whatever_happens() {
    let folder = common::folder("example-faults");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/sweep_faults.py");
    let said = python()
        .run_file(&script, [common::root().join("examples"), folder])
        .unwrap_or_else(|error| panic!("{error:#}"));
    assert!(said.contains("kept 14"), "{said}");
}
