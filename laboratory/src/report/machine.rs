//! The machine that times were taken on, and the clock that they were taken with.

use std::fs;
use std::time::Duration;

use cpu_time::ThreadTime;

/// One line: processor, cores, system, load.
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
        "{}, {cores} cores, {} {}{}",
        processor.unwrap_or_else(|| "processor unknown".to_owned()),
        std::env::consts::OS,
        std::env::consts::ARCH,
        load.unwrap_or_default()
    )
}

/// CPU seconds of this thread that the fastest of at least three runs took; `run` is given a fresh copy by `fresh`.
pub(super) fn fastest<T, E>(fresh: impl Fn() -> T, mut run: impl FnMut(&mut T) -> Result<(), E>) -> Result<f64, E> {
    let (mut best, mut spent, mut runs) = (f64::INFINITY, Duration::ZERO, 0);
    // Three runs, and more of what is over in an instant.
    while runs < 3 || (spent < Duration::from_millis(60) && runs < 50) {
        let mut copy = fresh();
        let start = ThreadTime::now();
        run(&mut copy)?;
        let taken = start.elapsed();
        spent += taken;
        runs += 1;
        best = best.min(taken.as_secs_f64());
        if spent > Duration::from_secs(20) {
            break;
        }
    }
    Ok(best)
}
