//! Defects of every body: one by one, several together, and a cage that turns back over them.

mod anywhere;
mod line_spall;
mod lines;
mod reversals;
mod several;

use std::f64::consts::TAU;

/// Amplitude of a line (Hz) of a signal with one value every `step` (s), by Hann's window: a start that dies away does
/// not smear it.
fn amplitude(signal: &[f64], frequency: f64, step: f64) -> f64 {
    let count = signal.len() as f64;
    let (mut re, mut im, mut sum) = (0.0, 0.0, 0.0);
    for (k, value) in signal.iter().enumerate() {
        let window = 0.5 - 0.5 * (TAU * k as f64 / count).cos();
        let (sin, cos) = (TAU * frequency * k as f64 * step).sin_cos();
        (re, im, sum) = (re + window * value * cos, im - window * value * sin, sum + window);
    }
    2.0 * re.hypot(im) / sum
}
