//! The machine and the commit that times were taken on, and the clock that they were taken with.

use std::fs;
use std::process::Command;

use cpu_time::ThreadTime;

/// One line: processor, registers, cores, system, load, commit.
pub(super) fn description() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let processor = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    let load = fs::read_to_string("/proc/loadavg")
        .ok()
        .and_then(|text| Some(format!(", {} programs running on average in the last minute", text.split(' ').next()?)));
    format!(
        "{}{}, {cores} cores, {} {}{}, commit {}",
        processor.unwrap_or_else(|| "processor unknown".to_owned()),
        registers(),
        std::env::consts::OS,
        std::env::consts::ARCH,
        load.unwrap_or_default(),
        commit().unwrap_or_else(|| "unknown".to_owned())
    )
}

/// How wide its registers are, on which ratios of times depend.
fn registers() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f") {
            " with AVX-512"
        } else if std::arch::is_x86_feature_detected!("avx2") {
            " with AVX2"
        } else {
            " without AVX2"
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    ""
}

/// The commit of the sources here, and whether they have changed since.
fn commit() -> Option<String> {
    let git = |words: &[&str]| {
        let output = Command::new("git").args(words).output().ok().filter(|output| output.status.success())?;
        Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let changed = !git(&["status", "--porcelain", "--untracked-files=no"])?.is_empty();
    Some(git(&["rev-parse", "--short=8", "HEAD"])? + if changed { " with changes" } else { "" })
}

/// CPU seconds of this thread that a run takes.
pub(super) fn timed<E>(run: impl FnOnce() -> Result<(), E>) -> Result<f64, E> {
    let start = ThreadTime::now();
    run()?;
    Ok(start.elapsed().as_secs_f64())
}

/// CPU seconds of the fastest of at least three runs of each kind, in turn: each run says what it took.
pub(super) fn fastest<const N: usize, E>(mut runs: [&mut dyn FnMut() -> Result<f64, E>; N]) -> Result<[f64; N], E> {
    let (mut best, mut spent, mut turns) = ([f64::INFINITY; N], 0.0, 0);
    // Three turns, and more of what is over in an instant.
    while turns < 3 || (spent < 0.06 && turns < 50) {
        for (best, run) in best.iter_mut().zip(&mut runs) {
            let taken = run()?;
            spent += taken;
            *best = best.min(taken);
        }
        turns += 1;
        if spent > 20.0 {
            break;
        }
    }
    Ok(best)
}
