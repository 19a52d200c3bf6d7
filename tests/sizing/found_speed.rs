//! The shaft's speed out of its own lines.

use brinell::scene::Bearing;
use brinell_analysis::spectra::find_speed;
use brinell_analysis::statistics::Random;
use std::f64::consts::TAU;

const RATE: f64 = 4000.0;

/// Eight seconds of noise with the first six lines of each frequency (Hz), so high.
fn made(lines: &[(f64, f64)]) -> Vec<f64> {
    let mut random = Random::new(8);
    let sample = |i: usize| {
        let t = i as f64 / RATE;
        let of = |&(f, high): &(f64, f64)| (1..=6).map(|k| high * libm::sin(TAU * f64::from(k) * f * t)).sum::<f64>();
        lines.iter().map(of).sum::<f64>() + random.normal()
    };
    (0..32_000).map(sample).collect()
}

fn found(lines: &[(f64, f64)], limits: [f64; 2]) -> Result<f64, String> {
    let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
    find_speed("made", &made(lines), RATE, &bearing, limits).map_err(|error| error.to_string())
}

#[test]
fn the_shaft_is_found_although_the_passages_over_a_spall_are_louder() {
    // A step of the search is 0.025 Hz; a line of 8 s is 0.5 Hz wide, in the fifth harmonic 0.1 Hz of the shaft.
    for lines in [vec![(12.6, 0.2)], vec![(12.6, 0.2), (3.5848 * 12.6, 0.8)], vec![(12.6, 0.2), (5.4152 * 12.6, 0.8)]] {
        let speed = found(&lines, [9.0, 17.0]).unwrap();
        assert!((speed - 12.6).abs() < 0.1, "{lines:?}: {speed}");
    }
}

#[test]
fn a_range_with_an_octave_is_refused_a_second_shaft_is_named_and_noise_has_no_speed() {
    // Of 6.3 and 12.6 Hz each has lines at the places of the other: no range holds both.
    let why = found(&[(12.6, 0.2)], [6.3, 12.6]).unwrap_err();
    assert!(why.contains("at most 1.9 times the first"), "{why}");
    let why = found(&[(12.6, 0.2), (17.1, 0.2)], [10.0, 18.0]).unwrap_err();
    assert!(why.contains("not unique") && why.contains("17.1"), "{why}");
    let why = found(&[], [10.0, 18.0]).unwrap_err();
    assert!(why.contains("no lines of a shaft of 10 to 18 Hz"), "{why}");
}
