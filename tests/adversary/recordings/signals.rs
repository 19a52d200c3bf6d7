//! Signals: pieces missing, saturation, silence, units, rates and speeds that are not the recording's.

use super::machine::{scene, signal};
use super::{
    RATE, SECONDS, SEMICOLONS, SPEED, noise, npy, read, read_as, read_with, refused, sized, timed, times, wav,
};
use brinell_analysis::recording::Recording;
use brinell_analysis::sizing::{Verdict, size};
use brinell_analysis::statistics::Random;
use std::sync::LazyLock;

/// A recording of a spall of five degrees, over two seconds.
fn whole() -> Vec<f64> {
    static WHOLE: LazyLock<Vec<f64>> = LazyLock::new(|| signal(5.0, SPEED, 0.03)[..(SECONDS * RATE) as usize].to_vec());
    WHOLE.clone()
}

#[test]
fn a_recording_with_a_hole_is_never_sized() {
    let samples = whole();
    let whole = sized(Recording::new("whole", samples.clone(), RATE, SPEED).unwrap());
    assert!((whole.length_deg.unwrap() / 5.0 - 1.0).abs() < 0.1);
    for missing in [5e-3, 10e-3, 20e-3, 40e-3] {
        let gone = (1.0 * RATE) as usize..((1.0 + missing) * RATE) as usize;
        let kept = |i: &usize| !gone.contains(i);
        let times = (0..samples.len()).filter(kept).map(|i| i as f64 / RATE);
        let rest: Vec<f64> = (0..samples.len()).filter(kept).map(|i| samples[i]).collect();
        let text = timed("time [s];acceleration\n", times, &rest, &|t| format!("{t:.6}"));
        refused(read(&text), &["a hole of", "after 0.99", "time [s]"]);
        // Without times the passages themselves show it.
        let report = sized(Recording::new("without times", rest, RATE, SPEED).unwrap());
        let right = report.length_deg.is_some_and(|length| (length / 5.0 - 1.0).abs() < 0.1);
        assert!(report.verdict == Verdict::Unresolved || right, "{missing} s: {:?}", report.length_deg);
    }
}

#[test]
fn a_rate_that_contradicts_the_file_is_refused_and_without_the_files_own_nothing_is_resolved() {
    let samples = whole();
    let time = times(RATE, samples.len(), samples.len(), 0.0);
    let text = timed("time [s];acc\n", time, &samples, &|t| format!("{t:.6}"));
    for rate in [RATE / 2.0, 0.98 * RATE, 1.02 * RATE, 2.0 * RATE, 51.2] {
        refused(read_with("csv", text.as_bytes(), Some(rate), SEMICOLONS), &["the file states 51200", "1 %"]);
    }
    refused(read_as("wav", &wav(&samples, 51_200), Some(48_000.0)), &["48000 Hz", "the file states 51200.000 Hz"]);
    // Times in milliseconds under a heading of seconds, and the other way about.
    let milliseconds: Vec<f64> = times(RATE, samples.len(), samples.len(), 0.0).map(|t| 1e3 * t).collect();
    let wrong = read(&timed("time [s];acc\n", milliseconds.into_iter(), &samples, &|t| format!("{t:.3}"))).unwrap();
    assert!(size(&[wrong], &scene()).unwrap_err().to_string().contains("at least 64"));
    let wrong = read(&text.replacen("[s]", "[ms]", 1)).unwrap();
    assert!(size(&[wrong], &scene()).unwrap_err().to_string().contains("at least 8"));
    // Nothing states the rate.
    refused(read_as("npy", &npy(&samples), None), &["states no sampling rate"]);
    for rate in [0.5 * RATE, 0.9 * RATE, 1.1 * RATE, 2.0 * RATE] {
        let report = sized(read_as("npy", &npy(&samples), Some(rate)).unwrap());
        assert_eq!(report.verdict, Verdict::Unresolved, "{rate} Hz: {:?}", report.length_deg);
    }
    // Revolutions a minute for hertz.
    let wrong = Recording::new("made", samples, RATE, 60.0 * SPEED).unwrap();
    assert!(size(&[wrong], &scene()).unwrap_err().to_string().contains("is the rate or the speed of 1200 Hz wrong?"));
}

#[test]
fn the_unit_the_sign_and_an_offset_of_the_signal_do_not_matter() {
    let samples = whole();
    let length = |factor: f64, offset: f64| {
        let changed = samples.iter().map(|x| factor * x + offset).collect();
        sized(Recording::new("made", changed, RATE, SPEED).unwrap()).length_deg.unwrap()
    };
    let expected = length(1.0, 0.0);
    for (factor, offset) in
        [(2f64.powi(-300), 0.0), (2f64.powi(300), 0.0), (9.80665, 0.0), (1e-9, 0.0), (-1.0, 0.0), (1.0, 1e6)]
    {
        // Rounding moves an event by far less than the thousandth of a degree; a sample is 0.03 degrees.
        let found = length(factor, offset);
        assert!((found - expected).abs() < 1e-3, "times {factor} plus {offset}: {found}, not {expected}");
    }
}

#[test]
fn numbers_that_are_too_large_or_too_small_to_be_squared_are_refused() {
    let samples = whole();
    for factor in [1e300, 1e160, 1e-160, 1e-300] {
        let read = Recording::new("made", samples.iter().map(|x| factor * x).collect(), RATE, SPEED);
        refused(read.map_err(|why| why.to_string()), &["differ by 1e-100", "within ±1e100"]);
    }
    let samples: Vec<f64> = samples.iter().map(|x| x.signum() * f64::MAX).collect();
    refused(read_as("npy", &npy(&samples), Some(RATE)), &["within ±1e100"]);
}

#[test]
fn a_saturated_recording_is_refused_and_one_clipped_too_little_to_matter_is_sized_right() {
    let samples = whole();
    let peak = samples.iter().fold(0.0f64, |peak, x| peak.max(x.abs()));
    let mut random = Random::new(11);
    let (mut refusals, mut answers) = (0, 0);
    for level in [0.7, 0.5, 0.3, 0.2, 0.1, 0.05, 0.01] {
        // One-sided, two-sided, and with the noise of what comes behind the amplifier that saturates.
        for (low, noise) in [(-level, 0.0), (-1.0, 0.0), (-level, 1e-3)] {
            let limits = (low * peak, level * peak);
            let clip = |x: &f64| x.clamp(limits.0, limits.1) + noise * limits.1 * random.normal();
            let clipped: Vec<f64> = samples.iter().map(clip).collect();
            let share =
                samples.iter().filter(|x| **x < limits.0 || **x > limits.1).count() as f64 / samples.len() as f64;
            match Recording::new("clipped", clipped, RATE, SPEED) {
                Err(why) => {
                    refusals += 1;
                    assert!(why.to_string().contains("clipped; limit 0.1 %"), "{why}");
                    assert!(share > 1e-3, "refused for {share} of the samples");
                }
                Ok(recording) => {
                    answers += 1;
                    let found = sized(recording).length_deg;
                    let right = found.is_none_or(|length| (length / 5.0 - 1.0).abs() < 0.1);
                    assert!(right, "level {level}, lower {low}, noise {noise}, {share} clipped: {found:?}");
                }
            }
        }
    }
    assert!(refusals >= 10 && answers >= 4, "{refusals} refused, {answers} answered");
}

#[test]
fn a_loud_hum_is_not_taken_for_clipping() {
    let samples = whole();
    let peak = samples.iter().fold(0.0f64, |peak, x| peak.max(x.abs()));
    let hum = |i: usize| 5.0 * peak * (std::f64::consts::TAU * 50.0 * i as f64 / RATE).sin();
    let loud = samples.iter().enumerate().map(|(i, x)| x + hum(i)).collect();
    let found = sized(Recording::new("loud", loud, RATE, SPEED).unwrap()).length_deg;
    assert!(found.is_none_or(|length| (length / 5.0 - 1.0).abs() < 0.1), "{found:?}");
}

#[test]
fn silent_stuck_and_broken_signals_are_refused() {
    let good = noise(60_000);
    for (samples, part) in [
        (vec![0.0; 60_000], "all 60000 samples are 0"),
        (vec![-3.25; 60_000], "all 60000 samples are -3.25"),
        (Vec::new(), "number of samples 0"),
    ] {
        refused(read_as("npy", &npy(&samples), Some(RATE)), &[part]);
    }
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for index in [0, 17, 59_999] {
            let mut samples = good.clone();
            samples[index] = value;
            refused(read_as("npy", &npy(&samples), Some(RATE)), &[&format!("sample {index} is {value}")]);
        }
    }
    // A word where a number should be, a cell too few, a line cut off.
    let lines: Vec<String> = good[..1000].iter().map(|x| format!("1;{x:.6}")).collect();
    for (changed, part) in
        [("1;over", "'over' is not a number"), ("1", "1 columns"), ("1;", "1 columns"), ("1;2;3", "3 columns")]
    {
        let mut lines = lines.clone();
        changed.clone_into(&mut lines[700]);
        refused(read_with("csv", lines.join("\n").as_bytes(), Some(RATE), SEMICOLONS), &["line 701", part]);
    }
}

#[test]
fn a_gap_that_was_filled_with_zeros_or_the_last_value_gives_no_wrong_length() {
    let samples = whole();
    let mut lengths = 0;
    for seconds in [5e-3, 0.5] {
        for at in [0.0, 1.0] {
            for last in [false, true] {
                let (from, to) = ((at * RATE) as usize, ((at + seconds) * RATE) as usize);
                let mut filled = samples.clone();
                let value = if last { samples[from] } else { 0.0 };
                filled[from..to].fill(value);
                let found = Recording::new("filled", filled, RATE, SPEED).map(|recording| sized(recording).length_deg);
                let right = found.as_ref().is_ok_and(|f| f.is_none_or(|length| (length / 5.0 - 1.0).abs() < 0.1));
                assert!(right || found.is_err(), "{seconds} s at {at} s: {found:?}");
                lengths += usize::from(matches!(found, Ok(Some(_))));
            }
        }
    }
    // The short ones hide nothing.
    assert!(lengths >= 4, "{lengths} of 8");
}
