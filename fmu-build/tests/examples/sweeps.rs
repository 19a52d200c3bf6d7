//! A sweep in parts on a cluster, in the environment that has dask.

use std::ffi::OsStr;
use std::fs;
use std::process::Command;

use super::{SWEEP, common, run_in, with_all_packages};

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_cluster_makes_the_table_of_one_run_bit_for_bit() {
    let folder = common::folder("example-sweep");
    let sweep = common::root().join("examples/sweep.toml");
    let small = folder.join("small.toml");
    fs::write(&small, fs::read_to_string(&sweep).unwrap().replace("runs = 48", "runs = 10")).unwrap();
    let (one, parts) = (folder.join("one"), folder.join("parts"));
    let words = [OsStr::new("sweep"), small.as_os_str(), OsStr::new("-o"), one.as_os_str()];
    assert!(Command::new(env!("CARGO_BIN_EXE_brinell")).args(words).status().unwrap().success());
    let command = SWEEP.replace("examples/sweep.toml", &format!("{} --parts 4", small.display()));
    run_in(with_all_packages(), &command, &parts);
    assert_eq!(fs::read(one.join("runs.parquet")).unwrap(), fs::read(parts.join("runs.parquet")).unwrap());
    assert!(parts.join("part-4-of-4/runs.parquet").is_file(), "no part was made");
}
