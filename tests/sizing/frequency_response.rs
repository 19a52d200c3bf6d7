//! Modes out of responses that are known, noisy, or none.

use brinell::scene::SensorMode;
use brinell_analysis::spectra::{Fit, FrequencyResponse, ResponseError, response};
use brinell_eigen::c64;
use std::f64::consts::TAU;
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

/// A response at frequencies (Hz) as a table.
fn lines(frequencies: impl Iterator<Item = f64>, response: impl Fn(f64) -> c64) -> String {
    let mut text = "frequency_hz,real,imaginary\n".to_owned();
    for frequency in frequencies {
        let value = response(frequency);
        writeln!(text, "{frequency},{:?},{:?}", value.re, value.im).unwrap();
    }
    text
}

/// Lines `step` (Hz) apart, so many.
fn every(step: f64, count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(move |k| f64::from(k) * step)
}

/// Modes out of a table.
fn fit(text: &str) -> Result<Fit, ResponseError> {
    FrequencyResponse::from_csv(text).and_then(|of| of.fit())
}

/// All of the modes, every 10 Hz up to 12 kHz.
fn good() -> String {
    lines(every(10.0, 1200), |frequency| response(&modes(), frequency))
}

#[test]
fn modes_come_back_from_their_own_response() {
    let mut polar = "frequency_hz,magnitude,phase_deg\n".to_owned();
    for frequency in every(10.0, 1200) {
        let value = response(&modes(), frequency);
        writeln!(polar, "{frequency},{:?},{:?}", value.norm(), value.arg().to_degrees()).unwrap();
    }
    for text in [good(), polar] {
        let fit = fit(&text).unwrap();
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
    let noise = |frequency: f64| {
        let k = (frequency / 10.0) as u64;
        let uniform = |n: u64| (n.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40) as f64 / f64::from(1 << 24) - 0.5;
        c64::new(uniform(2 * k + 1), uniform(2 * k + 2)) * 0.12
    };
    let noisy = lines(every(10.0, 1200), |frequency| response(&modes(), frequency) + noise(frequency));
    let fit = fit(&noisy).unwrap();
    assert!(fit.modes.len() == 4 && (0.01..0.06).contains(&fit.misfit), "{fit:?}");
    for (found, mode) in fit.modes.iter().zip(modes()) {
        assert!((found.frequency / mode.frequency - 1.0).abs() < 5e-3, "{found:?} {mode:?}");
        assert!((found.gain - mode.gain).abs() < 0.05, "{found:?} {mode:?}");
    }
}

/// The same response to an impulse, sampled at steps of `step` (s) over 0.1 s: each mode's −s²/(s² + 2ζωs + ω²) is
/// −δ + e^(−ζωt) (2ζω cos ωd t + (ω² − 2ζ²ω²)/ωd sin ωd t), and −ωs/(…) is −ω e^(−ζωt) (cos ωd t − ζω/ωd sin ωd t).
/// The first sample holds the impulses and this share of the rest.
fn impulse_table(modes: &[SensorMode], step: f64, first: f64) -> String {
    let mut text = "time_s,response_1_s\n".to_owned();
    for k in 0..(0.1 / step) as usize {
        let t = k as f64 * step;
        let of = |mode: &SensorMode| {
            let (w, zeta) = (TAU * mode.frequency, mode.damping_ratio);
            let (decay, ringing) = (zeta * w, w * (1.0 - zeta * zeta).sqrt());
            let (sin, cos) = (ringing * t).sin_cos();
            let bend = 2.0 * decay * cos + (w * w - 2.0 * decay * decay) / ringing * sin;
            (-decay * t).exp() * (mode.gain * bend - mode.quadrature_gain * w * (cos - decay / ringing * sin))
        };
        let smooth: f64 = modes.iter().map(of).sum();
        let directly = (1.0 - modes.iter().map(|mode| mode.gain).sum::<f64>()) / step;
        writeln!(text, "{t:?},{:?}", if k == 0 { first * smooth + directly } else { smooth }).unwrap();
    }
    text
}

#[test]
fn an_impulse_response_gives_the_same_modes_whatever_share_of_the_jump_its_first_sample_has() {
    for (count, step) in [(1, 5e-6), (4, 1e-5)] {
        let [half, whole] = [0.5, 1.0].map(|first| fit(&impulse_table(&modes()[..count], step, first)).unwrap());
        // What the sum has beside the constant is s Δt²/12 of the jump h(0+) = Σ(2ζωΓ − ωΚ), 3000/s here: at a quarter
        // of the rate 1e-3 at 5 µs and 2e-3 at 10 µs, which modes cannot take.
        assert!(half.modes.len() == count && whole.modes.len() == count, "{half:?} {whole:?}");
        assert!(half.misfit < 3e-3 && (half.misfit - whole.misfit).abs() < 1e-9, "{half:?} {whole:?}");
        for ((half, whole), mode) in half.modes.iter().zip(&whole.modes).zip(modes()) {
            for found in [half, whole] {
                assert!((found.frequency / mode.frequency - 1.0).abs() < 1e-4, "{found:?} {mode:?}");
                assert!((found.gain - mode.gain).abs() < 2e-3, "{found:?} {mode:?}");
                assert!((found.quadrature_gain - mode.quadrature_gain).abs() < 2e-3, "{found:?} {mode:?}");
            }
        }
    }
}

#[test]
fn a_table_may_begin_at_0_hz_where_nothing_is_measured() {
    let good = good();
    let with = |line: &str| good.replacen('\n', &format!("\n{line}\n"), 1);
    for line in ["0,1,0", "0.0,0.0,0.0", "0,-37,2"] {
        assert_eq!(fit(&with(line)), fit(&good), "{line}");
    }
    let refused = fit(&with("-10,1,0")).unwrap_err().to_string();
    assert!(refused.contains("frequency_hz -10") && refused.contains("at least 0"), "{refused}");
}

#[test]
fn a_turned_sign_is_refused_by_its_name_and_so_is_what_modes_explain_nothing_of() {
    let turned = |modes: &[SensorMode], turn: fn(c64) -> c64| {
        fit(&lines(every(50.0, 600), |frequency| turn(response(modes, frequency)))).unwrap_err().to_string()
    };
    // A mode so small that 1 alone misses 5 % of the response.
    let small = SensorMode { frequency: 2_300.0, damping_ratio: 0.03, gain: 0.02, quadrature_gain: 0.0 };
    for modes in [&modes()[..], &[small]] {
        let refused = turned(modes, |value| -value);
        assert!(refused.contains("the response's sign is turned"), "{refused}");
        let refused = turned(modes, |value| value.conj());
        assert!(refused.contains("the sign of its phase is turned"), "{refused}");
    }
    // 5 % of 1 that turn round and round: a delay, which is no mode.
    let refused = turned(&[], |value| value * c64::new(0.998, 0.05));
    assert!(refused.contains("at least half of what distinguishes it from 1"), "{refused}");
}

#[test]
fn no_mode_is_made_where_nothing_is_measured_or_a_scene_may_have_none() {
    for (low, high) in [(100, 2000), (100, 800), (1200, 5000), (3000, 8000)] {
        let text = lines((low..high).step_by(10).map(f64::from), |frequency| response(&modes(), frequency));
        let within = |mode: &SensorMode| (f64::from(low)..f64::from(high)).contains(&mode.frequency);
        match fit(&text) {
            Ok(fit) => assert!(fit.modes.iter().all(within), "{low} to {high} Hz: {fit:?}"),
            Err(error) => assert!(matches!(error, ResponseError::Misfit { .. }), "{low} to {high} Hz: {error}"),
        }
    }
    // Half a million samples a second and more: a mode of 3 MHz is within the lines, but in no scene.
    let fast = SensorMode { frequency: 3e6, ..modes()[0] };
    let fit = fit(&lines(every(1e4, 400), |frequency| response(&[fast], frequency)));
    assert!(fit.is_err(), "{fit:?}");
}

#[test]
fn what_is_no_response_is_refused_with_what_it_is() {
    let refused = |text: &str| fit(text).unwrap_err().to_string();
    let good = good();
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
