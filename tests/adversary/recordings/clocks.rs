//! Clocks: holes, stutters, digits, units.

use super::{RATE, SEMICOLONS, noise, read, read_with, refused, timed, times};
use brinell_analysis::recording::TextFormat;
use brinell_analysis::statistics::Random;

#[test]
fn a_hole_of_any_length_anywhere_is_refused_with_its_time_and_its_length() {
    let samples = noise(6000);
    // One sample, and from 0.1 ms to 1 s.
    for hole in [1.0 / RATE, 1e-4, 5e-3, 10e-3, 20e-3, 40e-3, 1.0] {
        for from in [1, 70, 3000, 5999] {
            let text = timed("time [s];acc\n", times(RATE, 6000, from, hole), &samples, &|t| format!("{t:.7}"));
            let at = (from - 1) as f64 / RATE;
            let missing = (hole * RATE).round();
            let length =
                if hole < 1e-3 { format!("a hole of {:.1}", 1e5 * hole) } else { format!("a hole of {hole:.5}") };
            let sample = format!("(sample {})", from - 1);
            let about = format!("about {missing} samples");
            // Digits of 0.1 µs: of short holes two are shown, to be compared.
            let parts = if hole < 1e-3 { [&sample[..], &about, "time [s]"] } else { [&sample[..], &about, &length] };
            refused(read(&text), &parts);
            if at >= 1e-3 {
                refused(read(&text), &[&format!("after {at:.6} s")]);
            }
        }
    }
}

#[test]
fn a_hole_is_refused_whatever_the_column_is_called_that_shows_it() {
    let samples = noise(6000);
    let rate = Some(RATE);
    let seconds = |t: f64| format!("{t:.7}");
    for (heading, factor) in [
        ("t;acc\n", 1.0),
        ("Time (ms);acc\n", 1e3),
        ("time_us;acc\n", 1e6),
        ("Zeit [s];acc\n", 1.0),
        ("Elapsed time;acc\n", 1.0),
        ("X_Value;acc\n", 1.0),
        ("X [s];acc\n", 1.0),
        ("s;g\n", 1.0),
        ("abscissa;acc\n", 1.0),
        ("Nr;acc\n", RATE),
        ("shaft angle [deg];acc\n", 3600.0),
        ("", 1.0),
        ("", 1e3),
        ("", RATE),
    ] {
        for (from, hole) in [(3000, 20e-3), (10, 5e-3), (5990, 256.0 / RATE)] {
            let times = times(RATE, 6000, from, hole).map(|t| factor * t);
            let text =
                timed(heading, times, &samples, &|t| if factor == RATE { format!("{t:.0}") } else { seconds(t) });
            let found = read_with("csv", text.as_bytes(), if factor == 1.0 { None } else { rate }, SEMICOLONS);
            refused(found, &["a hole of", &format!("about {:.0} samples are missing", hole * RATE)]);
        }
    }
    // An angle that begins anew at each turn has no hole there.
    let angles = (0..6000).map(|i| (3600.0 * f64::from(i) / RATE) % 360.0);
    let text = timed("angle [deg];acc\n", angles, &samples, &seconds);
    assert_eq!(read_with("csv", text.as_bytes(), rate, SEMICOLONS).unwrap().samples().len(), 6000);
}

#[test]
fn whole_recordings_are_accepted_however_their_times_are_printed() {
    let print: [(&str, &dyn Fn(f64) -> String); 8] = [
        ("1 us", &|t| format!("{t:.6}")),
        ("10 us", &|t| format!("{t:.5}")),
        ("0.1 us, cut off", &|t| format!("{:.7}", (t * 1e7).floor() / 1e7)),
        ("all digits", &|t| format!("{t}")),
        ("exponents", &|t| format!("{t:.8e}")),
        ("single precision", &|t| format!("{}", t as f32)),
        ("Unix time", &|t| format!("{:.6}", 1.75e9 + t)),
        ("decimal comma", &|t| format!("{t:.6}").replace('.', ",")),
    ];
    for rate in [10_000.0, 12_000.0, 25_600.0, 44_100.0, 48_000.0, 51_200.0] {
        let count = (0.5 * rate) as usize;
        let samples = noise(count);
        for (name, print) in print {
            let text = timed("time [s];acc\n", times(rate, count, count, 0.0), &samples, print);
            let comma = name == "decimal comma";
            let text = if comma { text.replace('.', ",") } else { text };
            let format = TextFormat { decimal: comma.then_some(','), ..SEMICOLONS };
            let recording = read_with("csv", text.as_bytes(), None, format)
                .unwrap_or_else(|why| panic!("{rate} Hz, {name}: {why}"));
            // A unit of the coarsest digit over 0.5 s.
            assert!((recording.rate() / rate - 1.0).abs() < 1e-5 / 0.5 + 1e-12, "{name}: {}", recording.rate());
            assert_eq!(recording.samples().len(), count);
        }
    }
}

#[test]
fn a_clock_that_drifts_slowly_is_accepted_and_one_that_changes_its_rate_is_not() {
    let samples = noise(60_000);
    let drifting = |share: f64| {
        // A rate that is higher by `share` in the middle than at both ends.
        let mut t = 0.0;
        let times = (0..60_000).map(move |i| {
            let now = t;
            t += (1.0 - share * (std::f64::consts::PI * f64::from(i) / 60_000.0).sin()) / RATE;
            now
        });
        read(&timed("time [s];acc\n", times, &samples, &|t| format!("{t:.6}")))
    };
    // 100 ppm is a poor quartz.
    assert!(drifting(1e-4).is_ok());
    assert!(drifting(5e-3).is_ok());
    refused(drifting(5e-2), &["1 % of difference is allowed"]);
}

#[test]
fn random_clocks_are_told_apart_by_one_sample() {
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let rate = 5e3 * (3.0 * random.uniform()).exp();
        let count = 300 + random.below(1000);
        let start = [0.0, 1.0, 1e3, 1.75e9][random.below(4)];
        // From half a period down to what double precision has, rounded or cut off.
        let digits = (-(0.5 / rate).log10()).ceil() as usize + random.below(4);
        let cut = if random.below(2) == 0 { 0.5 * 10f64.powi(-(digits as i32)) } else { 0.0 };
        let print = |t: f64| format!("{:.digits$}", start + t - cut);
        let samples = noise(count);
        let whole = read(&timed("time;acc\n", times(rate, count, count, 0.0), &samples, &print));
        let unit = 10f64.powi(-(digits as i32)).max(start * 2.0 * f64::EPSILON);
        // Nearer to half a period the count of lost samples, not the hole, may be off by one.
        if unit < 0.45 / rate {
            let found = whole.unwrap_or_else(|why| panic!("seed {seed}: {rate} Hz, {digits} digits: {why}"));
            assert!((found.rate() / rate - 1.0).abs() < 2.0 * unit * rate / (count - 1) as f64, "seed {seed}");
            let (from, missing) = (1 + random.below(count - 1), 1 + random.below(100));
            let times = times(rate, count, from, missing as f64 / rate);
            let holed = read(&timed("time;acc\n", times, &samples, &print));
            let said = [format!("(sample {})", from - 1), format!("about {missing} samples are missing")];
            assert!(holed.as_ref().is_err_and(|e| said.iter().all(|s| e.contains(s))), "seed {seed}: {holed:.200?}");
        }
    }
}

#[test]
fn repeated_backward_and_jittering_times_are_refused() {
    let samples = noise(6000);
    let with = |change: &dyn Fn(usize, f64) -> f64| {
        let times = (0..6000).map(|i| change(i, i as f64 / RATE));
        read(&timed("time [s];acc\n", times, &samples, &|t| format!("{t:.9}")))
    };
    refused(with(&|i, t| if i == 2000 { t - 1.0 / RATE } else { t }), &["samples 1999 and 2000 have one time"]);
    refused(with(&|i, t| if i >= 2000 { t - 0.01 } else { t }), &["goes back after 0.039043 s (sample 1999)"]);
    refused(with(&|i, t| if i >= 3000 { t - 3000.0 / RATE } else { t }), &["goes back", "to 0.0000e0 s"]);
    refused(with(&|_, t| -t), &["goes back"]);
    refused(with(&|i, t| t + 0.05 / RATE * (i as f64 * 2.3).sin()), &["steps are uneven", "2.0 % of that"]);
    refused(with(&|i, t| if i == 70 { t + 0.3 / RATE } else { t }), &["2 of 5999 steps are uneven", "sample 69"]);
    refused(with(&|i, t| if i == 70 { f64::NAN } else { t }), &["time of sample 70 is NaN"]);
    refused(with(&|_, _| 1.5), &["samples 0 and 1 have one time"]);
    // One hundredth of a sample is what a good counter leaves.
    assert!(with(&|i, t| t + 0.005 / RATE * (i as f64 * 2.3).sin()).is_ok());
    // Samples that come when they like are no recording, named or not.
    let mut random = Random::new(3);
    let ragged: Vec<f64> = (0..6000)
        .scan(0.0, |t, _| {
            *t += random.uniform() / RATE;
            Some(*t)
        })
        .collect();
    for heading in ["time [s];acc\n", ""] {
        refused(read(&timed(heading, ragged.iter().copied(), &samples, &|t| t.to_string())), &["steps are uneven"]);
    }
}

#[test]
fn times_with_too_few_digits_to_show_a_hole_are_refused_for_that() {
    let samples = noise(60_000);
    let printed = |heading: &str, print: &dyn Fn(f64) -> String| {
        read(&timed(heading, times(RATE, 60_000, 60_000, 0.0), &samples, print))
    };
    refused(printed("time [s];acc\n", &|t| format!("{t:.4}")), &["times are given to 1.0000e-4 s", "more digits"]);
    // Five digits in all, as some programs print: fine for 0.1 s, then too few.
    let five = |t: f64| format!("{t:.*}", if t < 0.1 { 5 } else { 4 });
    refused(printed("time [s];acc\n", &five), &["times are given to 1.0000e-4 s"]);
    assert!((printed("time [ms];acc\n", &|t| format!("{:.3}", 1e3 * t)).unwrap().rate() - RATE).abs() < 0.1);
}
