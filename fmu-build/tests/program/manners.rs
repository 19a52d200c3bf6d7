//! How much the program says, and how it helps: quiet and detailed runs, completions, JSON of tables.
#![allow(clippy::unwrap_used)]

use std::process::Command;

use serde_json::Value;

/// Standard output and standard error.
fn said(words: &[&str]) -> (String, String) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_brinell"));
    // A folder for each: tests that run beside each other would take one away from under the other.
    let folder = tempfile::tempdir().unwrap();
    let output = program.current_dir(&folder).args(words).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (text(output.stdout), text(output.stderr))
}

#[test]
fn a_quiet_run_says_nothing_but_its_files_and_a_detailed_one_its_steps() {
    let run = ["run", "6205-healthy", "--stop", "0.01", "--no-figure"];
    let (out, errors) = said(&[&run[..], &["--quiet"]].concat());
    assert_eq!((out.as_str(), errors.as_str()), ("6205-healthy.csv\n", ""));
    let (_, errors) = said(&[&run[..], &["-v"]].concat());
    assert!(errors.contains("integration steps and ") && errors.contains(" rejected in "), "{errors}");
}

#[test]
fn shells_complete_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let (out, _) = said(&["completions", shell]);
        assert!(["sweep", "paper", "size"].iter().all(|command| out.contains(command)), "{shell}: {out}");
    }
}

#[test]
fn tables_are_json_as_well() {
    let (out, _) = said(&["catalogue", "6205", "--json"]);
    let bearing: Value = serde_json::from_str::<Vec<Value>>(&out).unwrap().remove(0);
    // Z/2 (1 − D/D_pw) times a turn, and the maker's 14.0 and 7.85 kN.
    let order = bearing["bpfo_orders"].as_f64().unwrap();
    assert!((order - 4.5 * (1.0 - 7.94 / 39.04)).abs() < 1e-9, "{bearing}");
    for (rating, maker) in [("dynamic_rating_n", 14.0e3), ("static_rating_n", 7.85e3)] {
        assert!((bearing[rating].as_f64().unwrap() / maker - 1.0).abs() < 0.02, "{bearing}");
    }
    let (out, errors) = said(&["stiffness", "er16k-tb2", "--json", "--no-figure", "--points", "20"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    // By law hertz 3598 N (docs/evidence/validation.md); the stiffest place is healthy, 58 N/µm.
    assert!((found["critical_load_n"].as_f64().unwrap() - 3598.0).abs() < 1.0, "{out}");
    assert!((found["stiffness_n_m"]["greatest"].as_f64().unwrap() / 58e6 - 1.0).abs() < 0.02, "{out}");
    assert!(errors.contains("er16k-tb2-stiffness.csv"), "{errors}");
    let (out, _) = said(&["scenes", "--json"]);
    let scenes: Vec<Value> = serde_json::from_str(&out).unwrap();
    assert!(scenes.iter().any(|scene| scene["name"] == "er16k-tb1"), "{out}");
}
