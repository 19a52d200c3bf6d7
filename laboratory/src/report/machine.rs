//! The machine that times were taken on, and the clock that they were taken with.

use std::fs;

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
