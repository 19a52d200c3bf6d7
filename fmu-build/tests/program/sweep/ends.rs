//! A sweep that its user ends, and signals that somebody has taken away.

use super::*;

#[test]
fn signals_that_were_taken_away_are_made_again_with_the_same_bits_and_told() {
    let folder = common::folder("sweep-gone");
    let (path, out) = (file(&folder, &QUICK.replace("runs = 24", "runs = 6")), folder.join("out"));
    sweep(&path, &out, &["--signals"]);
    let before = bits(&out);
    for run in [1, 4] {
        fs::remove_file(out.join(format!("signals/run-{run:07}.npy"))).unwrap();
    }
    let told = sweep(&path, &out, &["--signals"]);
    assert!(told.contains("6 runs, 0 of them made now") && told.contains("signals of 2 runs were gone"), "{told}");
    assert!(bits(&out) == before, "other bits");
    assert_eq!(fs::read_to_string(out.join("rows.log")).unwrap().lines().count(), 6, "a row for each run");
    assert!(!sweep(&path, &out, &["--signals"]).contains("gone"));
}

/// Ends a program that has written so many rows by the signal of Ctrl-C, and gives what it said and its status.
#[cfg(unix)]
fn interrupted(mut command: Command, rows: impl Fn() -> bool) -> (String, Option<i32>) {
    let mut child = command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    while !rows() && child.try_wait().unwrap().is_none() {
        thread::sleep(Duration::from_millis(2));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    (String::from_utf8(output.stderr).unwrap(), output.status.code())
}

#[cfg(unix)]
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[cfg(unix)]
#[test]
fn a_sweep_that_is_interrupted_leaves_the_table_of_what_is_done_and_nothing_under_way() {
    let folder = common::folder("sweep-interrupted");
    let path = file(&folder, &QUICK.replace("runs = 24", "runs = 400"));
    let out = folder.join("out");
    let rows = || fs::read_to_string(out.join("rows.log")).unwrap_or_default().lines().count();
    let (told, status) = interrupted(program(&path, &out, &["--jobs", "2", "--signals"]), || rows() >= 3);
    // As a shell counts the signal.
    assert_eq!(status, Some(130), "{told}");
    let whole = ["README.md", "design.txt", "lock", "rows.log", "runs.parquet", "signals"];
    assert_eq!(names(&out), whole, "{told}");
    let kept = table(&out).1.len();
    assert!(kept >= 3 && kept == rows() && kept == names(&out.join("signals")).len(), "{kept} of {}", rows());
    let left = format!("the same command makes the other {} runs", 400 - kept);
    assert!(told.contains(&left) && told.contains(&format!("{kept} runs, {kept} of them made now")), "{told}");
}

#[cfg(unix)]
#[test]
fn a_run_that_is_interrupted_leaves_the_table_of_what_was_simulated_and_nothing_temporary() {
    let folder = common::folder("run-interrupted");
    let mut run = brinell(&["run", "6205-healthy", "--stop", "1000", "--no-figure", "-o"]);
    run.arg(&folder);
    let (told, status) = interrupted(run, || !names(&folder).is_empty());
    assert_eq!((status, names(&folder)), (Some(130), vec!["6205-healthy.csv".to_owned()]), "{told}");
    // Communication points are 0.1 ms apart.
    let text = fs::read_to_string(folder.join("6205-healthy.csv")).unwrap();
    let (rows, last) = (text.lines().count() - 1, text.lines().last().unwrap().split(',').next().unwrap());
    let last: f64 = last.parse().unwrap();
    assert!(text.starts_with("time [s],") && (last - 1e-4 * (rows - 1) as f64).abs() < 1e-9, "{rows} rows to {last} s");
    assert!(told.contains("interrupted: ") && told.contains("holds what was simulated, up to"), "{told}");
}
