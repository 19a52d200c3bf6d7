//! Modes out of responses that are known, noisy, or none.
#![allow(clippy::unwrap_used)]

use crate::spectra::frequency_response::*;
use std::fmt::Write;

fn modes() -> Vec<SensorMode> {
    [[900.0, 0.02, 0.7, 0.0], [2_300.0, 0.04, 0.5, 0.1], [2_450.0, 0.01, -0.3, 0.0], [9_000.0, 0.03, 0.1, -0.05]]
        .map(|[frequency, damping_ratio, gain, quadrature_gain]| SensorMode {
            frequency,
            damping_ratio,
            gain,
            quadrature_gain,
        })
        .to_vec()
}

/// Lines of 10 Hz up to 12 kHz, each changed by `noise`, as a table.
fn table(modes: &[SensorMode], polar: bool, noise: impl Fn(usize) -> c64) -> String {
    let mut text =
        if polar { "frequency_hz,magnitude,phase_deg\n" } else { "frequency_hz,real,imaginary\n" }.to_owned();
    for k in 1..=1200 {
        let frequency = f64::from(k) * 10.0;
        let value = response(modes, frequency) + noise(k as usize);
        let [a, b] = if polar { [value.norm(), value.arg().to_degrees()] } else { [value.re, value.im] };
        writeln!(text, "{frequency},{a:?},{b:?}").unwrap();
    }
    text
}

#[test]
fn modes_come_back_from_their_own_response() {
    for polar in [false, true] {
        let fit = FrequencyResponse::from_csv(&table(&modes(), polar, |_| c64::new(0.0, 0.0))).unwrap().fit().unwrap();
        assert!(fit.modes.len() == 4 && fit.misfit < 1e-9, "{fit:?}");
        for (found, mode) in fit.modes.iter().zip(modes()) {
            let numbers = |of: &SensorMode| [of.frequency / 1e4, of.damping_ratio, of.gain, of.quadrature_gain];
            for (a, b) in numbers(found).into_iter().zip(numbers(&mode)) {
                assert!((a - b).abs() < 1e-9, "{found:?} {mode:?}");
            }
        }
    }
}

#[test]
fn noise_costs_as_much_as_it_is_and_no_mode_too_many() {
    // A hash of the line's number: as good as noise, and the same every time. rms 0.05 of a response of rms 1.9.
    let noise = |k: usize| {
        let uniform = |n: u64| (n.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40) as f64 / f64::from(1 << 24) - 0.5;
        c64::new(uniform(2 * k as u64 + 1), uniform(2 * k as u64 + 2)) * 0.12
    };
    let fit = FrequencyResponse::from_csv(&table(&modes(), false, noise)).unwrap().fit().unwrap();
    assert!(fit.modes.len() == 4 && (0.01..0.06).contains(&fit.misfit), "{fit:?}");
    for (found, mode) in fit.modes.iter().zip(modes()) {
        assert!((found.frequency / mode.frequency - 1.0).abs() < 5e-3, "{found:?} {mode:?}");
        assert!((found.gain - mode.gain).abs() < 0.05, "{found:?} {mode:?}");
    }
}

#[test]
fn an_impulse_response_gives_the_same_modes() {
    // δ(t) in the first sample, and each mode's answer to it: −Γ δ + Γ e^(−ζ ω t) (2 ζ ω cos + …) sampled at 200 kHz.
    let (modes, step) = (&modes()[..1], 5e-6);
    let [w, zeta, gain] = [TAU * modes[0].frequency, modes[0].damping_ratio, modes[0].gain];
    let (decay, ringing) = (zeta * w, w * (1.0 - zeta * zeta).sqrt());
    let mut text = "time_s,response_1_s\n".to_owned();
    for k in 0..20_000 {
        let t = f64::from(k) * step;
        let (sin, cos) = (ringing * t).sin_cos();
        // Of −s²/(s² + 2ζωs + ω²): −δ + e^(−ζωt) (2ζω cos ωd t + (ω² − 2ζ²ω²)/ωd sin ωd t).
        let mut value = gain * (-decay * t).exp() * (2.0 * decay * cos + (w * w - 2.0 * decay * decay) / ringing * sin);
        if k == 0 {
            // Half of the first sample's width belongs to the time before; the impulses are whole.
            value = 0.5 * value + (1.0 - gain) / step;
        }
        writeln!(text, "{t:?},{value:?}").unwrap();
    }
    let fit = FrequencyResponse::from_csv(&text).unwrap().fit().unwrap();
    // The trapezoidal sum misses (2π f Δt)²/12 of an oscillation, 1 % at a quarter of the rate and little at 900 Hz.
    assert!((fit.modes[0].frequency / modes[0].frequency - 1.0).abs() < 1e-3, "{fit:?}");
    assert!((fit.modes[0].gain - gain).abs() < 0.02 && fit.misfit < 0.02, "{fit:?}");
}

#[test]
fn what_is_no_response_is_refused_with_what_it_is() {
    let refused = |text: &str| FrequencyResponse::from_csv(text).and_then(|of| of.fit()).unwrap_err().to_string();
    let good = table(&modes(), false, |_| c64::new(0.0, 0.0));
    assert!(refused(&good.replace("imaginary", "phase")).contains("phase"));
    assert!(refused(&good.replace("\n30.0,", "\n10.0,").replace("\n30,", "\n10,")).contains("frequency_hz 10"));
    assert!(refused(&good.lines().take(5).collect::<Vec<_>>().join("\n")).contains("4 lines"));
    assert!(refused("nothing").contains("numbers"));
    // A response of 5 at rest: no structure.
    let shifted: String = good
        .lines()
        .enumerate()
        .map(|(k, line)| match line.split(',').collect::<Vec<_>>()[..] {
            [frequency, _, _] if k > 0 => format!("{frequency},{},{}\n", if k % 2 == 0 { 5.0 } else { -5.0 }, 0.0),
            _ => format!("{line}\n"),
        })
        .collect();
    assert!(refused(&shifted).contains("10 %"), "{}", refused(&shifted));
}
