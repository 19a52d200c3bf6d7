//! A disk that is full: a small file system that only a child process sees, or `/dev/full`.

use super::chance::Chance;
use super::stage::FullDisk;
use brinell_tests::resources::scratch;
use std::env;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Tells the child where its small file system is.
const SMALL: &str = "BRINELL_SMALL_DISK";

/// Runs a test of this program in a process that has a file system of 512 kB. An error with the reason where the system
/// does not let one make that: it takes Linux and namespaces of users.
pub(super) fn run_on_a_small_disk(test: &str) -> Result<(), String> {
    let folder = scratch().join(format!("small-disk-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let unshare = |script: &str| {
        let mut command = Command::new("unshare");
        command.args(["--user", "--map-root-user", "--mount", "sh", "-c", script]).arg(&folder);
        command
    };
    const MOUNT: &str = "mount -t tmpfs -o size=512k tmpfs \"$0\"";
    let possible = unshare(MOUNT).output().map_err(|cause| cause.to_string())?;
    if !possible.status.success() {
        return Err(String::from_utf8_lossy(&possible.stderr).trim().to_owned());
    }
    let mut command = unshare(&format!("{MOUNT} && exec \"$@\""));
    command.arg(env::current_exe().unwrap()).args([test, "--exact", "--ignored", "--nocapture"]).env(SMALL, &folder);
    let status = command.status().unwrap();
    let _ = fs::remove_dir(&folder);
    assert!(status.success(), "the test on a small disk failed");
    Ok(())
}

/// Whether this process has a small file system.
pub(super) fn is_small() -> bool {
    env::var_os(SMALL).is_some()
}

/// The small file system of this process, emptied and then filled up except for some pages.
pub(super) fn nearly_full(chance: &mut Chance) -> FullDisk {
    let folder = PathBuf::from(env::var_os(SMALL).expect("started by another test"));
    for entry in fs::read_dir(&folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() { fs::remove_dir_all(path).unwrap() } else { fs::remove_file(path).unwrap() }
    }
    let mut ballast = File::create(folder.join("ballast")).unwrap();
    let mut written = 0;
    while ballast.write_all(&[0; 4096]).is_ok() {
        written += 4096;
    }
    ballast.set_len(written - 4096 * chance.below(64).min(written as usize / 4096) as u64).unwrap();
    let records = folder.join("records");
    // Sometimes not even the folder can be made.
    if chance.one_in(2) {
        drop(fs::create_dir(&records));
    }
    FullDisk::Small(records)
}

/// Makes the recording of this file name lead to `/dev/full`.
#[cfg(unix)]
pub(super) fn lead_to_dev_full(folder: &Path, file: &str) {
    fs::create_dir_all(folder).unwrap();
    drop(std::os::unix::fs::symlink("/dev/full", folder.join(file)));
}

#[cfg(not(unix))]
pub(super) fn lead_to_dev_full(_: &Path, _: &str) {}
