//! Foreign faults: what knocks in a machine and is no spall of an outer raceway has no length.

use super::{RATE, SECONDS, SPEED, sized};
use brinell_analysis::recording::Recording;
use brinell_analysis::sizing::Verdict;
use brinell_analysis::statistics::Random;
use std::f64::consts::TAU;

/// A recording of a machine that knocks `order` times a turn, each knock ringing at 9 kHz. A load zone makes the
/// knocks louder and softer `modulation` times a turn, 0 for always alike; `scatter` is that of their times, of their
/// distance.
fn knocking(order: f64, modulation: f64, scatter: f64) -> Vec<f64> {
    let mut random = Random::new(11);
    let mut signal: Vec<f64> = (0..(SECONDS * RATE) as usize).map(|_| 0.05 * random.normal()).collect();
    for k in 0..(SECONDS * order * SPEED) as usize {
        let time = (k as f64 + 0.3 + scatter * random.normal()) / (order * SPEED);
        let loud = if modulation > 0.0 { 0.5 + 0.5 * libm::cos(TAU * modulation * SPEED * time) } else { 1.0 };
        let first = (time.max(0.0) * RATE).ceil() as usize;
        for (i, sample) in signal.iter_mut().enumerate().skip(first).take((5e-3 * RATE) as usize) {
            let after = i as f64 / RATE - time;
            *sample += loud * libm::exp(-after / 0.6e-3) * libm::sin(TAU * 9000.0 * after);
        }
    }
    signal
}

#[track_caller]
fn has_no_length(what: &str, signal: Vec<f64>) {
    let report = sized(Recording::new(what, signal, RATE, SPEED).unwrap());
    assert_eq!(report.verdict, Verdict::Unresolved, "{what}: {:?} degrees", report.length_deg);
    assert_eq!(report.length_deg, None, "{what}");
}

#[test]
fn a_fault_of_the_inner_raceway_or_of_a_ball_has_no_length() {
    // Orders of a 6205: inner raceway in and out of the load zone with the shaft, ball twice a turn of its own.
    has_no_length("inner raceway", knocking(5.4152, 1.0, 0.005));
    has_no_length("ball", knocking(4.7135, 0.3983, 0.005));
}

#[test]
fn gears_loose_parts_and_a_second_bearing_have_no_length() {
    let mesh: Vec<f64> = {
        let mut random = Random::new(3);
        let tooth = |t: f64, n: f64| libm::sin(TAU * 23.0 * n * SPEED * t) / n;
        let at = |i: usize| i as f64 / RATE;
        (0..(SECONDS * RATE) as usize)
            .map(|i| (1..8).map(|n| tooth(at(i), f64::from(n))).sum::<f64>() + 0.05 * random.normal())
            .collect()
    };
    has_no_length("gear mesh", mesh);
    has_no_length("loose part, once a turn", knocking(1.0, 0.0, 0.002));
    has_no_length("another bearing's outer raceway", knocking(3.052, 0.0, 0.005));
}
