//! A sweep in parts on a cluster, in the environment that has dask.

use std::fs;

use super::common::program::{brinell, done};
use super::{SWEEP, common, run_in};

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_cluster_makes_the_table_of_one_run_bit_for_bit() {
    let folder = common::folder("example-sweep");
    let sweep = common::root().join("examples/sweep.toml");
    let small = folder.join("small.toml");
    fs::write(&small, fs::read_to_string(&sweep).unwrap().replace("runs = 48", "runs = 10")).unwrap();
    let (one, parts) = (folder.join("one"), folder.join("parts"));
    done(brinell(&["sweep", "-o"]).arg(&one).arg(&small));
    let command = SWEEP.replace("examples/sweep.toml", &format!("{} --parts 4", small.display()));
    run_in(common::examples_python(), &command, &parts);
    assert_eq!(fs::read(one.join("runs.parquet")).unwrap(), fs::read(parts.join("runs.parquet")).unwrap());
    assert!(parts.join("part-4-of-4/runs.parquet").is_file(), "no part was made");
}
