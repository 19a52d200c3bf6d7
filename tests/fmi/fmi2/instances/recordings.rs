//! A recording has one writer: two instances never share a file, be it in one process or in two.

use crate::two::{Host, Resources};
use brinell_fmi::fmi2::*;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::{env, fs};

const FOLDER: &str = "BRINELL_TEST_RECORDINGS";

/// A healthy bearing with a recorder, that is to record into `folder`.
fn recorder(name: &str, folder: &Path) -> Host {
    let recorder = |text: String| text + "\n[recorder]\nrate_hz = 51200.0\n";
    let host = Host::with(Resources::edited("6205-healthy", "resources", recorder), name, true);
    assert_eq!(host.set_text(host.reference("recorder.folder"), folder.to_str().unwrap()), Status::Ok);
    host
}

/// Starts an instance whose recording must be refused, and gives the reason.
fn refused(host: &Host) -> String {
    assert_eq!(host.begin(None, 0.0, None), Status::Ok);
    assert_eq!(host.exit(), Status::Error, "two instances write one recording");
    host.lines().pop().unwrap().message
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("recordings-{}-{name}", std::process::id()));
    drop(fs::remove_dir_all(&folder));
    folder
}

/// Rows of a recording, by its header.
fn rows(file: &Path) -> usize {
    let bytes = fs::read(file).unwrap();
    let header = String::from_utf8_lossy(&bytes[12..]);
    let shape = header.split("'shape': (").nth(1).unwrap();
    shape.split(',').next().unwrap().parse().unwrap()
}

#[test]
fn instances_whose_names_become_one_file_name_are_told_so_at_the_start() {
    let folder = folder("names");
    let first = recorder("left bearing", &folder);
    first.start();
    assert_eq!(first.step(0.0, 5e-3), Status::Ok);
    // The folder in another spelling is the same folder.
    let there = folder.join("..").join(folder.file_name().unwrap());
    for (name, folder) in [("left bearing", &folder), ("left/bearing", &folder), ("left_bearing", &there)] {
        let second = recorder(name, folder);
        let message = refused(&second);
        for part in ["\"left bearing\"", &format!("\"{name}\""), "left_bearing.npy", "recorder.folder"] {
            assert!(message.contains(part), "{part}: {message}");
        }
        // It is refused as long as the other one lives, and leaves that one's file alone.
        assert_eq!(second.reset(), Status::Ok);
        assert_eq!(second.set_text(second.reference("recorder.folder"), folder.to_str().unwrap()), Status::Ok);
        refused(&second);
    }
    let other = recorder("right bearing", &folder);
    other.start();
    assert_eq!(first.step(5e-3, 5e-3), Status::Ok);
    assert_eq!(first.terminate(), Status::Ok);
    // 10 ms at 51.2 kHz, less the 15 that the filter waits for.
    assert_eq!(rows(&folder.join("left_bearing.npy")), 512 - 15);
    drop((first, other));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_recording_of_a_run_that_is_over_is_written_over() {
    let folder = folder("again");
    let file = folder.join("bearing.npy");
    let host = recorder("bearing", &folder);
    host.start();
    assert_eq!(host.step(0.0, 10e-3), Status::Ok);
    // The same instance, reset.
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(rows(&file), 512 - 15);
    assert_eq!(host.set_text(host.reference("recorder.folder"), folder.to_str().unwrap()), Status::Ok);
    host.start();
    assert_eq!(host.step(0.0, 5e-3), Status::Ok);
    // A terminated run can be taken up again by a saved state; its file is free with the instance.
    assert_eq!(host.terminate(), Status::Ok);
    refused(&recorder("bearing", &folder));
    drop(host);
    assert_eq!(rows(&file), 256 - 15);
    let again = recorder("bearing", &folder);
    again.start();
    assert_eq!(again.step(0.0, 2.5e-3), Status::Ok);
    drop(again);
    assert_eq!(rows(&file), 128 - 15);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_run_that_is_taken_back_to_before_its_start_is_recorded_anew() {
    let folder = folder("before");
    let host = recorder("bearing", &folder);
    let before = host.save();
    host.start();
    assert_eq!(host.step(0.0, 10e-3), Status::Ok);
    assert_eq!(host.restore(before), Status::Ok);
    host.start();
    assert_eq!(host.step(0.0, 5e-3), Status::Ok);
    assert_eq!(host.terminate(), Status::Ok);
    // The second run alone: 5 ms at 51.2 kHz, less the 15 rows that the filter waits for.
    assert_eq!(rows(&folder.join("bearing.npy")), 256 - 15);
    drop(host);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_state_that_an_instance_takes_up_without_having_been_initialized_is_recorded_from_there() {
    let folder = folder("taken-up");
    let donor = recorder("donor", &folder);
    donor.start();
    assert_eq!(donor.step(0.0, 10e-3), Status::Ok);
    let bytes = donor.serialize(donor.save());
    let host = recorder("heir", &folder);
    let state = host.deserialize(&bytes).unwrap();
    assert_eq!(host.restore(state), Status::Ok, "{:?}", host.lines());
    assert_eq!(host.step(10e-3, 10e-3), Status::Ok);
    assert_eq!(donor.step(10e-3, 10e-3), Status::Ok);
    assert_eq!((host.terminate(), donor.terminate()), (Status::Ok, Status::Ok));
    let [heirs, donors] = ["heir.npy", "donor.npy"].map(|file| fs::read(folder.join(file)).unwrap());
    // The donor had 497 rows when the state was taken, and 15 under way.
    assert_eq!((rows(&folder.join("heir.npy")), rows(&folder.join("donor.npy"))), (512, 1024 - 15));
    let values = 512 * 8 * String::from_utf8_lossy(&heirs).matches("'<f8'").count();
    assert!(heirs[heirs.len() - values..] == donors[donors.len() - values..], "other bits");
    drop((donor, host));
    fs::remove_dir_all(folder).unwrap();
}

/// Runs in the other process: begins a recording, says so, and waits for its end.
#[test]
#[ignore = "started by the test below, in a process of its own"]
fn child() {
    let Some(folder) = env::var_os(FOLDER).map(PathBuf::from) else {
        println!("skipped: started alone, there is no folder to record into");
        return;
    };
    let host = recorder("bearing", &folder);
    host.start();
    assert_eq!(host.step(0.0, 10e-3), Status::Ok);
    println!("\nrecording");
    std::io::stdout().flush().unwrap();
    std::io::stdin().read_to_end(&mut Vec::new()).unwrap();
}

fn other_process(folder: &Path) -> Child {
    let mut child = Command::new(env::current_exe().unwrap())
        .args(["fmi2::instances::recordings::child", "--exact", "--ignored", "--nocapture"])
        .env(FOLDER, folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.map(Result::unwrap).any(|line| line == "recording"), "the other process did not begin");
    child
}

#[test]
fn a_recording_of_another_process_is_left_alone_while_it_is_written_and_no_longer() {
    let folder = folder("processes");
    let mut child = other_process(&folder);
    let host = recorder("bearing", &folder);
    let message = refused(&host);
    for part in ["another process", "\"bearing\"", "bearing.npy"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    // A process that crashes leaves its file behind, and nothing that stands in the way.
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(folder.join("bearing.npy").exists());
    let again = recorder("bearing", &folder);
    again.start();
    assert_eq!(again.step(0.0, 5e-3), Status::Ok);
    drop((host, again));
    assert_eq!(rows(&folder.join("bearing.npy")), 256 - 15);
    fs::remove_dir_all(folder).unwrap();
}
