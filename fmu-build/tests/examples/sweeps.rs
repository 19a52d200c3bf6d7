//! Thousands of runs of FMUs, in the environment that has dask and pyarrow.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use super::{CLUSTER, LABELLED, MEASURED, SCHEDULER, SIZED, SWEEP, WORKER, common, last, run_in, with_all_packages};

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_sweep_runs_its_design() {
    let folder = common::folder("example-sweep");
    let said = last(&run_in(with_all_packages(), SWEEP, &folder));
    assert_eq!((said["runs"].as_u64(), said["failed"].as_u64()), (Some(8), Some(0)), "{said}");
    // Started again it has nothing to do.
    assert_eq!(last(&run_in(with_all_packages(), SWEEP, &folder))["runs"].as_u64(), Some(0));
    // Another design does not get into the same folder.
    let script = common::root().join("examples/sweep.py");
    let other = ["--seed".into(), "2".into(), "-o".into(), folder.into_os_string()];
    let said = with_all_packages().run_file::<OsString>(&script, other).unwrap_err().to_string();
    assert!(said.contains("another design"), "{said}");
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_labelled_sweep_says_beside_each_signal_what_it_is_a_run_of() {
    let folder = common::folder("example-labelled");
    let said = last(&run_in(with_all_packages(), LABELLED, &folder));
    assert_eq!((said["runs"].as_u64(), said["failed"].as_u64()), (Some(8), Some(0)), "{said}");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/sweep_labels.py");
    let said = with_all_packages().run_file(&script, [folder]).unwrap_or_else(|error| panic!("{error:#}"));
    assert!(said.contains("8 labelled"), "{said}");
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_sweep_measures_with_noise_a_filter_and_a_speed_that_changes() {
    let folder = common::folder("example-measured");
    // In place of the guide's.
    let profile = folder.join("up.csv");
    fs::write(&profile, "time_s,speed_hz\n0,10\n0.1,30\n0.2,30\n").unwrap();
    let said =
        last(&run_in(with_all_packages(), &MEASURED.replace("up.csv", profile.to_str().unwrap()), &folder.join("out")));
    assert_eq!((said["runs"].as_u64(), said["failed"].as_u64()), (Some(12), Some(0)), "{said}");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/sweep_measured.py");
    let said = with_all_packages().run_file(&script, [folder.join("out")]).unwrap_or_else(|error| panic!("{error:#}"));
    assert!(said.contains("12 measured"), "{said}");
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_sweep_that_cannot_be_is_refused_in_a_line_and_without_a_traceback() {
    let folder = common::folder("example-refused");
    let script = common::root().join("examples/sweep.py");
    let profile = folder.join("short.csv");
    fs::write(&profile, "time_s,speed_hz\n0,10\n0.1,30\n").unwrap();
    let profile = profile.to_str().unwrap();
    for (words, expected) in [
        ("--grid shaft.speed_hz=ten", "shaft.speed_hz: 'ten' is no number"),
        ("--grid shaft.speed_hz", "it must be KEY=V,V,"),
        ("--random shaft.load_n=300", "two numbers LOW:HIGH"),
        ("--random shaft.load_n=500:300", "the lower one first"),
        ("--grid defect.length_mm=1 --grid defect.length_deg=3", "exclude each other"),
        ("--grid defect.depth=3", "defect.depth is unknown: did you mean depth_um?"),
        ("--grid bearing.element_count=9.5", "element_count"),
        ("--runs 0", "--runs is 0: it must be at least 1"),
        ("--settle 0.5", "--settle is 0.5 s: it must be from 0 to below --stop, 0.3 s"),
        ("--rate 10", "--rate is 10.0 Hz: it must be from 100"),
        ("--noise-db 300", "from -60 to 200 dB"),
        ("--write mp3", "'mp3' is none of wav, npy"),
        ("--kinds inner,cage", "--kinds: cage is none of"),
        ("--base nowhere.toml", "there is no such scene file"),
        (&format!("--speed-profile {profile}"), "it ends at 0.1 s: it must go to 0.3 s"),
        (&format!("--speed-profile {profile} --grid shaft.speed_hz=10"), "exclude each other"),
    ] {
        let words = words.split(' ').map(OsString::from).chain(["-o".into(), folder.join("out").into()]);
        let said = with_all_packages()
            .run_file(&script, words.chain(["--workers".into(), "1".into()]))
            .unwrap_err()
            .to_string();
        assert!(said.contains(expected) && !said.contains("Traceback"), "{expected}: {said}");
    }
}

#[test]
#[ignore = "sizes a long run; `size` has tests of its own"]
fn a_sweep_sizes_spalls_on_request() {
    let said = last(&run_in(with_all_packages(), SIZED, &common::folder("example-sized")));
    assert_eq!((said["runs"].as_u64(), said["failed"].as_u64()), (Some(1), Some(0)), "{said}");
    assert_eq!(said["sized"].as_u64(), Some(1), "{said}");
}

#[test]
#[ignore = "starts four processes of dask; the sweep that workers leave has a cluster as well"]
fn a_sweep_runs_on_a_cluster_that_is_there() {
    let folder = common::folder("example-cluster");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/sweep_cluster.py");
    let arguments = [SCHEDULER.into(), WORKER.into(), CLUSTER.into(), folder.into_os_string()];
    let said =
        last(&with_all_packages().run_file::<OsString>(&script, arguments).unwrap_or_else(|error| panic!("{error:#}")));
    assert_eq!((said["runs"].as_u64(), said["failed"].as_u64()), (Some(8), Some(0)), "{said}");
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_sweep_keeps_every_run_once_whatever_happens() {
    let folder = common::folder("example-faults");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/sweep_faults.py");
    let said = with_all_packages()
        .run_file(&script, [common::root().join("examples"), folder])
        .unwrap_or_else(|error| panic!("{error:#}"));
    assert!(said.contains("kept 14"), "{said}");
}
