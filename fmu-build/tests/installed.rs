//! What users install, as `cargo fmu dist` made it: into an empty Python environment, without Rust and without the
//! source in sight. The programs for other machines run under Wine and QEMU and must build the same FMU to the byte.
//!
//! `.ci/platforms wheels` makes what these tests look at.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

mod common;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use fmu_build::project::Project;

/// The one file of `target/dist` whose name has these parts.
fn made(start: &str, end: &str) -> PathBuf {
    let folder = Project::find().results("dist");
    let entries = fs::read_dir(&folder).unwrap_or_else(|_| panic!("{}: first `cargo fmu dist`", folder.display()));
    let mut found: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    let fits = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_str().unwrap();
        name.starts_with(start) && name.ends_with(end)
    };
    found.retain(fits);
    assert_eq!(found.len(), 1, "{start}…{end}: {found:?}");
    found.remove(0)
}

fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// Names of all that is in a folder.
fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

/// A user's machine: an empty folder to stand in, an empty home, nothing in the path but the system and `bin`.
fn user(name: &str, program: &Path, bin: &Path) -> (PathBuf, Command) {
    let home = common::folder(&format!("{name}-home"));
    let here = common::folder(name);
    let mut command = Command::new(program);
    command.current_dir(&here).env_clear().env("HOME", &home);
    command.env("PATH", std::env::join_paths([bin, Path::new("/usr/bin"), Path::new("/bin")]).unwrap());
    // Where packages come from, and by which certificates.
    let kept = |name: &str| name.starts_with("PIP_") || name.starts_with("SSL_") || name.ends_with("_proxy");
    command.envs(std::env::vars().filter(|(name, _)| kept(name)));
    (here, command)
}

/// An environment with the wheel and what draws figures, and its folder of programs.
fn environment() -> PathBuf {
    let wheel = made("brinell-", "manylinux_2_17_x86_64.whl");
    let folder = common::folder("wheel-env");
    let done = Command::new("python3").args(["-m", "venv"]).arg(&folder).status().unwrap();
    assert!(done.success());
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    let what = format!("{}[figures]", wheel.display());
    let output = Command::new(folder.join("bin/python")).args(install).arg(what).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    folder.join("bin")
}

/// Apart, so that the nightly run can leave them to `.ci/platforms`.
mod all_platforms {
    use super::*;

    #[test]
    #[ignore = "needs what `cargo fmu dist` makes"]
    fn a_wheel_in_an_empty_environment_builds_drives_and_draws_and_leaves_nothing_else() {
        let bin = environment();
        let (here, mut demo) = user("wheel-demo", &bin.join("brinell"), &bin);
        assert!(Command::new("which").arg("cargo").env("PATH", "/usr/bin:/bin").status().is_ok_and(|s| !s.success()));
        let output = demo.arg("demo").output().unwrap();
        assert!(output.status.success(), "{}", said(&output));
        assert_eq!(names(&here), BTreeSet::from(["brinell-demo".to_owned()]));
        let drawn = names(&here.join("brinell-demo"));
        assert!(
            ["6205-epps.fmu", "demo.png", "demo.svg", "events.csv"].iter().all(|&n| drawn.contains(n)),
            "{drawn:?}"
        );
        // The figure in the README is of the same numbers.
        let svg = fs::read_to_string(here.join("brinell-demo/demo.svg")).unwrap();
        assert!(svg.len() > 100_000, "{} bytes", svg.len());

        let (here, mut build) = user("wheel-build", &bin.join("brinell"), &bin);
        let output = build.args(["build", "er16k-tb1"]).output().unwrap();
        assert!(output.status.success(), "{}", said(&output));
        assert_eq!(names(&here), BTreeSet::from(["er16k-tb1.fmu".to_owned()]));
        for platform in ["linux64", "win64", "darwin64", "aarch64-linux"] {
            assert!(said(&output).contains(&format!("{platform}: ")), "{}", said(&output));
        }

        let (here, mut python) = user("wheel-module", &bin.join("python"), &bin);
        let code = "import brinell; run = brinell.run('er16k-tb1', stop=0.01); print(run, run['shaft.y'][-1])";
        let output = python.args(["-c", code]).output().unwrap();
        assert!(output.status.success() && said(&output).contains("101 points until 0.0"), "{}", said(&output));
        assert_eq!(names(&here), BTreeSet::new());
    }

    #[test]
    #[ignore = "needs what `cargo fmu dist` makes, Wine and QEMU"]
    fn the_programs_for_windows_and_arm_build_the_fmu_that_the_one_for_linux_builds() {
        let folder = common::folder("archives");
        let unpacked = |end: &str| {
            let archive = made("brinell-", end);
            let name =
                archive.file_name().unwrap().to_str().unwrap().trim_end_matches(".tar.gz").trim_end_matches(".zip");
            let unpack = "import shutil, sys; shutil.unpack_archive(sys.argv[1], sys.argv[2])";
            let done = Command::new("python3").args(["-c", unpack]).arg(&archive).arg(&folder).status().unwrap();
            assert!(done.success());
            let found = names(&folder.join(name));
            assert!(
                ["LICENSE-MIT", "README.md", "scenes", "third-party-program.txt"].iter().all(|&n| found.contains(n))
            );
            folder.join(name)
        };
        let mut fmus = Vec::new();
        for (end, start) in
            [("linux64.tar.gz", None), ("win64.zip", Some("wine")), ("-aarch64-linux.tar.gz", Some("qemu-aarch64"))]
        {
            let top = unpacked(end);
            let program = top.join(if end.contains("win64") { "brinell.exe" } else { "brinell" });
            if start == Some("wine") {
                let stub = Path::new(env!("CARGO_TARGET_TMPDIR")).join("machine-win64/bcryptprimitives.dll");
                fs::copy(&stub, top.join("bcryptprimitives.dll")).unwrap_or_else(|e| panic!("{}: {e}", stub.display()));
            }
            let first = start.map_or(program.clone(), PathBuf::from);
            let (here, mut command) = user(&format!("archive-{}", program.display().to_string().len()), &first, &top);
            if start.is_some() {
                command.arg(&program);
            }
            let prefix = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wine");
            command.env("WINEPREFIX", prefix).env("WINEDEBUG", "-all").env("QEMU_LD_PREFIX", "/usr/aarch64-linux-gnu");
            let output = command.args(["build", "6205-epps"]).output().unwrap();
            assert!(output.status.success(), "{end}: {}", said(&output));
            assert_eq!(names(&here), BTreeSet::from(["6205-epps.fmu".to_owned()]), "{end}");
            fmus.push((end, fs::read(here.join("6205-epps.fmu")).unwrap()));
        }
        for (end, fmu) in &fmus {
            assert!(*fmu == fmus[0].1, "{end}: another FMU, {} and {} bytes", fmu.len(), fmus[0].1.len());
        }
    }
}
