//! What the recorder's filter lets through, and what it keeps out.
//!
//! `cargo test --workspace --test motion recorder_filter -- --nocapture` prints the levels of docs/how-to/sensors.md.

use crate::counting;
use crate::support::{Named, shipped};
use RecorderFilter::{LinearPhase, None};
use brinell::numerics::low_pass::low_pass;
use brinell::scene::{Recorder, RecorderFilter, Scene};
use brinell_analysis::spectrum::power;
use std::ops::Range;

fn started(mut scene: Scene, rate: f64, filter: RecorderFilter) -> Named {
    scene.recorder = Some(Recorder { rate, filter });
    Named::recorded(scene)
}

fn recorded(scene: &str, rate: f64, filter: RecorderFilter, stop: f64, names: &[&str]) -> Vec<Vec<f64>> {
    let mut run = started(shipped(scene), rate, filter);
    run.run(1e-3, (stop * 1e3).round() as usize);
    run.columns(names)
}

/// Level of a signal in a part of its time (s), in a band (Hz): (dB).
fn level(signal: &[f64], rate: f64, time: &Range<f64>, band: &Range<f64>) -> f64 {
    let part = &signal[(time.start * rate).round() as usize..(time.end * rate).round() as usize];
    let (power, bin) = power(part, rate, 0);
    let band = &power[(band.start / bin).ceil() as usize..(band.end / bin).floor() as usize];
    let density = band.iter().sum::<f64>() / (band.len() as f64 * part.len() as f64 * rate);
    10.0 * libm::log10(density)
}

const VIBRATIONS: [&str; 4] = ["sensor.acceleration", "housing.ay", "shaft.ay", "shaft.force.y"];

#[test]
fn no_aliases_reach_the_band_below_the_rate_over_2_56() {
    let (fine, stop, window) = (819_200.0, 0.25, 0.05..0.24);
    let truth = recorded("er16k-tb1", fine, None, stop, &VIBRATIONS);
    for rate in [12_800.0, 25_600.0, 51_200.0] {
        let runs = [None, LinearPhase].map(|filter| recorded("er16k-tb1", rate, filter, stop, &VIBRATIONS));
        let mut most = f64::NEG_INFINITY;
        for (i, name) in VIBRATIONS.into_iter().enumerate() {
            // At 25.6 kHz the last one is 8 to 10 kHz.
            for (low, high) in [(0.08, 0.2), (0.2, 0.3125), (0.3125, 0.390_625)] {
                let band = low * rate..high * rate;
                let there = level(&truth[i], fine, &window, &band);
                let [before, after] = runs.each_ref().map(|run| level(&run[i], rate, &window, &band) - there);
                println!("{rate} Hz, {name} at {band:.0?} Hz: {before:+.2} dB without, {after:+.3} dB with the filter");
                // Aliases at -40 dB of a band would add 0.0004 dB if they were alone; the two grids of bins end a band
                // differently, which alone makes 0.013 dB.
                assert!(after.abs() < 0.02, "{rate} Hz, {name} at {band:.0?} Hz: {after:+.3} dB");
                most = most.max(before);
                let column = ["sensor.acceleration", "housing.ay", "shaft.force.y"].iter().position(|n| *n == name);
                if let (Some(column), true) = (column, low > 0.3) {
                    let printed = levels_in_the_guide(rate)[column];
                    // Loose elements bounce otherwise at another tolerance, which makes up to 1.8 dB.
                    assert!(
                        (printed - before).abs() < 2.0,
                        "{rate} Hz, {name}: {before:+.2} dB, in the guide {printed}"
                    );
                }
            }
        }
        assert!(most > 3.0, "without a filter nothing folds: the comparison shows nothing");
    }
}

/// Levels (dB) without a filter in the guide's row of a rate (Hz): sensor, housing, force on the shaft.
fn levels_in_the_guide(rate: f64) -> Vec<f64> {
    let (guide, number) = (include_str!("../../../docs/how-to/sensors.md"), format!("{}", rate as u64));
    let name = format!("| {} {} |", &number[..number.len() - 3], &number[number.len() - 3..]);
    let row = guide.lines().find(|line| line.starts_with(&name)).unwrap();
    let cells = row.split('|').filter(|cell| cell.contains("dB"));
    cells.map(|cell| cell.split(',').next().unwrap().trim().replace('−', "-").parse().unwrap()).collect()
}

#[test]
fn rows_are_the_low_pass_of_the_signal_and_what_the_fast_samples_fold_is_80_db_below_it() {
    let (rate, per_row, half, names) =
        (51_200.0, 16, 15, ["housing.ay", "shaft.ay", "shaft.force.y", "housing.force.x"]);
    let rows = recorded("er16k-tb1", rate, LinearPhase, 0.05, &names);
    // Twice as fast as the recorder samples; what that folds is another 15 dB lower.
    let fine = recorded("er16k-tb1", rate * per_row as f64, None, 0.05, &names);
    let h = low_pass(half * per_row, 0.5 / per_row as f64, 102.0);
    for ((name, rows), fine) in names.iter().zip(&rows).zip(&fine) {
        assert_eq!(rows.len(), 2560 - half);
        // Before its first sample the signal stood.
        let at = |i: isize| fine[i.max(0) as usize];
        let start = |row: usize| (row as isize - half as isize) * per_row as isize;
        let row = |row: usize| h.iter().zip(start(row)..).map(|(h, i)| h * at(i)).sum::<f64>();
        let mean = rows.iter().sum::<f64>() / rows.len() as f64;
        let power: f64 = rows.iter().map(|value| (value - mean) * (value - mean)).sum();
        let error: f64 = rows.iter().enumerate().map(|(k, value)| value - row(k)).map(|error| error * error).sum();
        assert!(error < 1e-8 * power, "{name}: {:.1} dB", 10.0 * libm::log10(error / power));
    }
}

#[test]
fn a_filtered_row_has_no_delay() {
    let names = ["shaft.force.y", "sensor.acceleration", "housing.ay"];
    let [plain, filtered] = [None, LinearPhase].map(|f| recorded("6205-healthy", 51_200.0, f, 0.05, &names));
    for ((name, plain), filtered) in names.iter().zip(&plain).zip(&filtered) {
        let plain = &plain[256..filtered.len()];
        let mean = plain.iter().sum::<f64>() / plain.len() as f64;
        let rms = |of: &dyn Fn(usize) -> f64| ((0..plain.len()).map(|i| of(i) * of(i)).sum::<f64>()).sqrt();
        let off = |by: usize| rms(&|i| filtered[256 - by + i] - plain[i]) / rms(&|i| plain[i] - mean);
        // A healthy bearing has a hundredth of its vibration beyond 20 kHz; a row is a sixth of a radian at its 1.4
        // kHz.
        assert!(off(0) < 0.02 && off(1) > 0.1, "{name}: {} {}", off(0), off(1));
    }
}

#[test]
fn the_first_row_is_the_balance_that_the_run_starts_from() {
    let names = ["shaft.force.y", "housing.force.y", "sensor.acceleration"];
    let found = recorded("er16k-tb1", 51_200.0, LinearPhase, 2e-3, &names);
    // The load is 500 N, and the elements weigh 0.18 N. The run starts at rest, and what the filter assumes of the time
    // before is just that.
    for (column, value) in found.iter().zip([500.0, -500.18, 0.0]) {
        assert!((column[0] - value).abs() < 0.02, "{} instead of {value}", column[0]);
    }
}

#[test]
fn rows_that_are_fetched_cost_no_allocation() {
    for filter in [None, LinearPhase] {
        let mut run = started(shipped("er16k-tb1"), 51_200.0, filter);
        let step = |run: &mut Named| {
            run.run(1e-3, 1);
            run.0.forget_samples();
        };
        // Room for the rows of a step is made once.
        (0..3).for_each(|_| step(&mut run));
        let mut saved = run.0.save();
        let ((), allocations) = counting::counted(|| {
            for _ in 0..10 {
                step(&mut run);
                run.0.save_into(&mut saved);
                run.0.restore(&saved).unwrap();
            }
        });
        assert_eq!(allocations, 0, "{filter:?}");
    }
}

#[test]
fn a_state_with_rows_that_no_run_has_under_way_is_refused() {
    let mut run = started(shipped("6205-healthy"), 51_200.0, LinearPhase);
    run.run(1e-3, 2);
    let good = run.0.save().to_bytes();
    assert!(run.0.state_from_bytes(&good).is_ok());
    // The samples taken come last.
    let mut bytes = good.clone();
    bytes[good.len() - 8..].fill(0xff);
    assert!(run.0.state_from_bytes(&bytes).unwrap_err().contains("sample"));
    // Without a filter nothing is under way, and the state is shorter by it.
    let other = started(shipped("6205-healthy"), 51_200.0, None);
    assert!(other.0.state_from_bytes(&good).unwrap_err().contains("shape"));
}
