//! What the commands write is whole or not there: under a limit on the size of files, which ends a write as a full disk
//! does, a file of the same name stays as it was, and no part of a new one is left.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

use crate::common;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const BEFORE: &[u8] = b"of an earlier run";

/// Runs the program with files of at most so many bytes.
fn limited(bytes: usize, arguments: &[&str]) -> Output {
    // A write beyond the limit is then an error and no signal. The shell counts blocks of 512 bytes.
    let script = "trap '' XFSZ; ulimit -f $0; exec \"$@\"";
    let mut command = Command::new("sh");
    command.args(["-c", script, &(bytes / 512).to_string(), env!("CARGO_BIN_EXE_brinell")]).args(arguments);
    command.output().unwrap()
}

/// Names and contents of all that is in a folder.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(&path).unwrap())).collect()
}

/// The command must fail, name the file and what to do, and leave `files` of the folder as they were.
#[track_caller]
fn fails_and_leaves(folder: &Path, files: &[&str], bytes: usize, arguments: &[&str]) {
    let before: BTreeMap<_, _> = files.iter().map(|name| ((*name).to_owned(), BEFORE.to_vec())).collect();
    for name in files {
        fs::write(folder.join(name), BEFORE).unwrap();
    }
    let output = limited(bytes, arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "{said}");
    let after = contents(folder);
    let sizes: Vec<_> = after.iter().map(|(name, bytes)| (name, bytes.len())).collect();
    assert!(after == before, "left behind: {sizes:?}; it said: {said}");
    assert!(said.contains(&folder.display().to_string()), "the path: {said}");
    assert!(said.contains("File too large") && said.contains("folder"), "the reason and what to do: {said}");
}

/// Bytes that do not get shorter by packing, in place of a library.
fn library(folder: &Path) -> PathBuf {
    let mut state = 1u64;
    let bytes: Vec<u8> = (0..1 << 20)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 56) as u8
        })
        .collect();
    let path = folder.join("library.so");
    fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn an_fmu_that_does_not_fit_leaves_the_earlier_one() {
    let folder = common::folder("whole-fmu");
    let out = folder.join("out");
    fs::create_dir(&out).unwrap();
    let (library, out_name) = (library(&folder).display().to_string(), out.display().to_string());
    let arguments = ["build", "6205-healthy", "--library", &library, "-o", &out_name];
    fails_and_leaves(&out, &["6205-healthy.fmu"], 1 << 19, &arguments);
    // Where there is room, the same command gives the whole of it.
    assert!(limited(1 << 22, &arguments).status.success());
    assert!(fs::metadata(out.join("6205-healthy.fmu")).unwrap().len() > 1 << 20);
    assert_eq!(contents(&out).len(), 1);
}

#[test]
fn signals_that_do_not_fit_leave_the_earlier_ones() {
    let out = common::folder("whole-run");
    let name = out.display().to_string();
    let arguments = ["run", "6205-healthy", "--stop", "0.02", "--step", "1e-4", "--no-figure", "-o", &name];
    fails_and_leaves(&out, &["6205-healthy.csv"], 1 << 15, &arguments);
    let output = limited(1 << 24, &arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    // A heading, the start and 200 steps.
    assert_eq!(fs::read_to_string(out.join("6205-healthy.csv")).unwrap().lines().count(), 202);
}

#[test]
fn a_recording_that_does_not_fit_leaves_the_earlier_one() {
    let folder = common::folder("whole-recording");
    let (out, file) = (folder.join("out"), folder.join("recorded.toml"));
    fs::create_dir(&out).unwrap();
    let text = common::scene_text("6205-healthy").replace("6205-healthy", "recorded");
    fs::write(&file, format!("{text}\n[recorder]\nrate_hz = 51200.0\n")).unwrap();
    let (name, file) = (out.display().to_string(), file.display().to_string());
    let arguments = ["run", &file, "--stop", "0.1", "--step", "0.01", "--no-figure", "-o", &name];
    fails_and_leaves(&out, &["recorded.csv", "recorded.npy"], 1 << 17, &arguments);
    assert!(limited(1 << 24, &arguments).status.success());
    let recording = fs::read(out.join("recorded.npy")).unwrap();
    assert!(recording.starts_with(b"\x93NUMPY") && recording.len() > 1 << 18, "{} bytes", recording.len());
    let names: Vec<_> = contents(&out).into_keys().collect();
    assert_eq!(names, ["-envelope.csv", "-envelope.json", ".csv", ".npy"].map(|end| format!("recorded{end}")));
}

#[test]
fn a_table_of_stiffness_that_does_not_fit_leaves_the_earlier_one() {
    let out = common::folder("whole-stiffness");
    let name = out.display().to_string();
    let arguments = ["stiffness", "6205-healthy", "--no-figure", "-o", &name];
    fails_and_leaves(&out, &["6205-healthy-stiffness.csv"], 1 << 14, &arguments);
}

#[test]
fn a_pressure_that_does_not_fit_leaves_the_earlier_one() {
    let out = common::folder("whole-contact");
    let name = out.display().to_string();
    let at = ["--on", "outer", "--angle", "0", "--force", "100", "--resolution", "32"];
    let arguments = [&["contact", "6205-healthy"], &at[..], &["--no-figure", "-o", &name]].concat();
    fails_and_leaves(&out, &["6205-healthy-contact.json"], 512, &arguments);
    fs::remove_file(out.join("6205-healthy-contact.json")).unwrap();
    let output = limited(1 << 16, &arguments);
    // The summary fits, the pressures do; the planes' stresses do not.
    assert!(!output.status.success());
    let names: Vec<_> = contents(&out).into_keys().collect();
    let ends = ["-depth.csv", "-pressure.csv", "-surface.csv", ".json"];
    assert_eq!(names, ends.map(|end| format!("6205-healthy-contact{end}")));
}

#[test]
fn a_figure_that_does_not_fit_leaves_the_earlier_one() {
    common::python();
    let out = common::folder("whole-figure");
    let name = out.display().to_string();
    let arguments = ["run", "6205-healthy", "--stop", "0.01", "--step", "1e-3", "-o", &name];
    for file in ["6205-healthy.svg", "6205-healthy.png"] {
        fs::write(out.join(file), BEFORE).unwrap();
    }
    // The signals fit, their figure does not.
    let output = limited(1 << 15, &arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && said.contains("6205-healthy.svg was not written"), "{said}");
    let after = contents(&out);
    assert_eq!(
        after.keys().collect::<Vec<_>>(),
        ["6205-healthy.csv", "6205-healthy.png", "6205-healthy.svg"],
        "{said}"
    );
    assert!(after["6205-healthy.svg"] == BEFORE && after["6205-healthy.png"] == BEFORE, "{said}");
}
