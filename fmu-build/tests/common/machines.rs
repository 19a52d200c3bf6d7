//! How programs of other machines are compiled and started here.
#![allow(dead_code, clippy::unwrap_used)] // each test binary uses a part of this

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use fmu_build::platforms::{Platform, Target, Toolchain, toolchain};
use fmu_build::shared::Project;

/// Compiles something of the package `tests/host` for a target, and gives the folder that it is in.
pub(crate) fn compiled(target: Target, what: &[&str]) -> PathBuf {
    let package = super::common::root().join("tests/host");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("host");
    let toolchain = Toolchain::new(&Project::find(), &package, target, false).unwrap();
    let output = toolchain
        .set_up(&mut Command::new(toolchain::cargo()))
        .current_dir(&package)
        .args(["build", "--release", "--locked", "--target", target.triple, "--target-dir"])
        .arg(&folder)
        .args(what)
        // The library that Wine lacks has no unwinding.
        .env("CARGO_PROFILE_RELEASE_PANIC", "abort")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder.join(target.triple).join("release")
}

/// Puts a library of Windows that Wine 8 lacks into a folder of programs.
pub(crate) fn bring_what_wine_lacks(folder: &Path) {
    let windows = Platform::named("win64").unwrap().targets[0];
    let stub = compiled(windows, &["--example", "bcryptprimitives"]).join("examples/bcryptprimitives.dll");
    fs::copy(stub, folder.join("bcryptprimitives.dll")).unwrap();
}

/// Starts a program of Windows.
pub(crate) fn wine(program: &Path) -> Command {
    let mut command = Command::new("wine");
    command
        .arg(program)
        .env("WINEPREFIX", Path::new(env!("CARGO_TARGET_TMPDIR")).join("wine"))
        .env("WINEDEBUG", "-all");
    command
}

/// Starts a program of Linux on ARM.
pub(crate) fn qemu(program: &Path) -> Command {
    let mut command = Command::new("qemu-aarch64");
    command.arg(program).env("QEMU_LD_PREFIX", "/usr/aarch64-linux-gnu");
    command
}

/// A path of this machine as Windows' programs name it: Wine shows the whole file system as drive Z.
pub(crate) fn on_windows(path: &Path) -> String {
    format!("Z:{}", path.to_str().unwrap().replace('/', "\\"))
}
