//! Bands, envelopes and smoothing against what tones and pulses must give.

use brinell_spectrum::{Band, Spectrum, gaussian, running_mean};
use std::f64::consts::PI;

fn tone(frequency: f64, rate: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| libm::cos(2.0 * PI * frequency * i as f64 / rate)).collect()
}

#[test]
fn the_envelope_of_a_tone_in_the_band_is_its_amplitude() {
    let signal: Vec<f64> = tone(3000.0, 40_000.0, 4001).iter().map(|x| 2.5 * x).collect();
    let envelope = Spectrum::of(&signal, 40_000.0).squared_envelope(Band { low: 2000.0, high: f64::INFINITY });
    // Away from the ends only leakage of the tone that does not fit the length is left.
    for x in &envelope[1000..3000] {
        assert!((x.sqrt() - 2.5).abs() < 0.01, "{}", x.sqrt());
    }
}

#[test]
fn a_tone_outside_the_band_is_gone() {
    let mut spectrum = Spectrum::of(&tone(1000.0, 40_000.0, 4000), 40_000.0);
    let left = spectrum.filtered(Band { low: 2000.0, high: 8000.0 });
    // 1000 Hz fits 4000 samples exactly: rounding only.
    assert!(left.iter().all(|x| x.abs() < 1e-12));
}

#[test]
fn smoothing_keeps_a_constant_and_the_area_of_a_pulse() {
    let mut signal = vec![0.0; 201];
    signal[100] = 1.0;
    let smooth = gaussian(&signal, 5.0);
    // A Gaussian of σ = 5 peaks at 1/(5√(2π)); cutting it at 4σ loses 6e-5 of its area.
    assert!((smooth[100] * 5.0 * (2.0 * PI).sqrt() - 1.0).abs() < 1e-4);
    assert!((smooth.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    assert!(running_mean(&[3.0; 9], 2).iter().all(|x| (x - 3.0).abs() < 1e-15));
}
