//! Hostile recordings: holes of any length in any place, clocks that stutter, numbers that can be read in two ways, signals that
//! saturate, files cut short. `size` refuses them, says that nothing is resolved, or gives the length of the whole recording.

#[path = "../support/machine.rs"]
mod machine;

use brinell::simulation::Simulation;
use brinell_analysis::recording::{Recording, Source, Speed};
use brinell_analysis::report::{Report, Verdict};
use brinell_analysis::spall_size::size;
use brinell_analysis::statistics::Random;
use machine::{RATE, scene, signal};
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

const SPEED: f64 = 10.0;

/// Reads a file of these bytes; an error as what the user sees of it.
fn read_as(ending: &str, bytes: &[u8], rate: Option<f64>) -> Result<Recording, String> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let name = format!("recording-{}-{}.{ending}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, bytes).unwrap();
    let source = Source { rate, speed: Speed::Constant(SPEED), signal: None };
    let read = Recording::read(&path, &source);
    std::fs::remove_file(&path).unwrap();
    read.map_err(|error| error.to_string())
}

fn read(text: &str) -> Result<Recording, String> {
    read_as("csv", text.as_bytes(), None)
}

#[track_caller]
fn refused(read: Result<Recording, String>, parts: &[&str]) {
    let message = match read {
        Ok(recording) => panic!("accepted: {} samples at {} Hz", recording.samples().len(), recording.rate()),
        Err(message) => message,
    };
    for part in parts {
        assert!(message.contains(part), "'{part}' is missing in: {message}");
    }
}

/// Noise of half a second: enough for what is refused before anything is sized.
fn noise(count: usize) -> Vec<f64> {
    let mut random = Random::new(5);
    (0..count).map(|_| random.normal()).collect()
}

/// Two columns, the time as `print` writes it.
fn timed(heading: &str, times: impl Iterator<Item = f64>, samples: &[f64], print: &dyn Fn(f64) -> String) -> String {
    let mut text = heading.to_owned();
    for (time, sample) in times.zip(samples) {
        writeln!(text, "{};{sample:.6}", print(time)).unwrap();
    }
    text
}

/// Times of `count` samples at `rate`, of which those from `from` on come `hole` later.
fn times(rate: f64, count: usize, from: usize, hole: f64) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| i as f64 / rate + if i >= from { hole } else { 0.0 })
}

fn sized(recording: Recording) -> Report {
    size(&[recording], &scene()).unwrap()
}

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
            let found = read_as("csv", text.as_bytes(), if factor == 1.0 { None } else { rate });
            refused(found, &["a hole of", &format!("about {:.0} samples are missing", hole * RATE)]);
        }
    }
    // An angle that begins anew at each turn has no hole there.
    let angles = (0..6000).map(|i| (3600.0 * f64::from(i) / RATE) % 360.0);
    let text = timed("angle [deg];acc\n", angles, &samples, &seconds);
    assert_eq!(read_as("csv", text.as_bytes(), rate).unwrap().samples().len(), 6000);
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
        let count = (5.0 * rate) as usize;
        let samples = noise(count);
        for (name, print) in print {
            let text = timed("time [s];acc\n", times(rate, count, count, 0.0), &samples, print);
            let text = if name == "decimal comma" { text.replace('.', ",") } else { text };
            let recording = read(&text).unwrap_or_else(|why| panic!("{rate} Hz, {name}: {why}"));
            // A unit of the coarsest digit over 5 s.
            assert!((recording.rate() / rate - 1.0).abs() < 1e-5 / 5.0 + 1e-12, "{name}: {}", recording.rate());
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

#[test]
fn a_recording_with_a_hole_is_never_sized() {
    let samples = signal(5.0, SPEED, 0.03);
    let whole = sized(Recording::new("whole", samples.clone(), RATE, SPEED).unwrap());
    assert!((whole.length_deg.unwrap() / 5.0 - 1.0).abs() < 0.1);
    for missing in [5e-3, 10e-3, 20e-3, 40e-3] {
        let gone = (2.0 * RATE) as usize..((2.0 + missing) * RATE) as usize;
        let kept = |i: &usize| !gone.contains(i);
        let times = (0..samples.len()).filter(kept).map(|i| i as f64 / RATE);
        let rest: Vec<f64> = (0..samples.len()).filter(kept).map(|i| samples[i]).collect();
        let text = timed("time [s];acceleration\n", times, &rest, &|t| format!("{t:.6}"));
        refused(read(&text), &["a hole of", "after 1.99", "time [s]"]);
        // Without times the passages themselves show it.
        let report = sized(Recording::new("without times", rest, RATE, SPEED).unwrap());
        let right = report.length_deg.is_some_and(|length| (length / 5.0 - 1.0).abs() < 0.1);
        assert!(report.verdict == Verdict::Unresolved || right, "{missing} s: {:?}", report.length_deg);
    }
}

#[test]
fn decimal_commas_keep_their_fractions_and_what_can_be_read_in_two_ways_is_refused_by_line() {
    let values = noise(500);
    let comma =
        |digits: usize| -> String { values.iter().map(|v| format!("{v:.digits$}\n").replace('.', ",")).collect() };
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    for digits in [2, 3, 6] {
        for (heading, separator) in
            [("", ""), ("acceleration\n", ""), ("recorder 7\nacceleration [m/s2]\n", ";"), ("acc;\n", ";")]
        {
            let text = heading.to_owned() + &comma(digits).replace('\n', &format!("{separator}\r\n"));
            let found = read_as("csv", text.as_bytes(), Some(RATE)).unwrap();
            for (x, v) in found.samples().iter().zip(&values) {
                // Printed digits, of the sample and of the mean.
                assert!((x + mean - v).abs() < 1.01 * 10f64.powi(-(digits as i32)), "{digits} digits: {x} for {v}");
            }
        }
    }
    let rate = Some(RATE);
    for (text, parts) in [
        // One number with one digit behind the comma, or two whole ones.
        ("1,5\n2,7\n3,1\n", &["line 1", "'1,5'", "names above two columns"][..]),
        ("12,345\n13,344\n", &["line 1", "'12,345'"]),
        // Decimals with a nought in front, below two names; and beside a sign.
        ("time,acc\n0,015\n1,025\n", &["line 2", "'0,015'", "line 1"]),
        ("0,015\n1,-5\n", &["line 1", "'0,015'", "line 2", "'1,-5'"]),
        // Commas between numbers and in them.
        ("0,000,1,234\n0,001,1,345\n", &["line 1", "'0,000,1,234'"]),
        // A point and a comma.
        ("t;a\n0.001;0,5\n", &["line 2", "point", "comma"]),
        ("a;b\n1;0,5\n2;1.234\n", &["line 3", "'1.234'", "line 2 a comma"]),
        ("a;b\n1;1.234,5\n", &["line 2", "'1.234,5' is not a number"]),
        // Thousands.
        ("a;b\n1;1,234\n2;999\n3;2,345\n", &["line 2", "'1,234'", "thousands"]),
        ("a;b\n1;1,234,567\n", &["line 2", "is not a number"]),
    ] {
        refused(read_as("csv", text.as_bytes(), rate), parts);
    }
    // Signs, names and points tell; so do blanks.
    for (text, expected) in [
        ("left,right\n2,5\n1,7\n", [2.0, 1.0]),
        ("2,-5\n1,7\n", [2.0, 1.0]),
        ("2.5,3\n1.5,4\n", [2.5, 1.5]),
        ("2,5,\n1,7,\n", [2.0, 1.0]),
        ("1,5 7\n0,5 7\n", [1.5, 0.5]),
        ("-0,5\n1,5\n", [-0.5, 1.5]),
        ("0,5\n1\n2,5\n", [0.5, 1.0]),
        ("1,50e-3\n2,50e-3\n", [1.5e-3, 2.5e-3]),
    ] {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("commas-{}.csv", std::process::id()));
        std::fs::write(&path, text).unwrap();
        let source = Source { rate, speed: Speed::Constant(SPEED), signal: Some("1".to_owned()) };
        let found = Recording::read(&path, &source).unwrap_or_else(|why| panic!("{text}: {why}"));
        let difference = found.samples()[1] - found.samples()[0];
        assert!((difference - (expected[1] - expected[0])).abs() < 1e-12, "{text}: {difference}");
    }
}

/// What the recorder of a scene writes in 20 ms, and its folder.
fn recorded(scene_text: &str) -> Vec<u8> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("recorder-{}", std::process::id()));
    let scene = brinell::scene::Scene::from_toml(scene_text).unwrap();
    let mut simulation = Simulation::new(scene, None).unwrap();
    simulation.record_into(folder.to_str().unwrap());
    simulation.initialize(0.0).unwrap();
    let mut recording = brinell::recording::Recording::begin(&simulation, "bearing").unwrap().unwrap();
    for _ in 0..20 {
        simulation.step(1e-3).unwrap();
    }
    recording.store(&mut simulation).unwrap();
    let bytes = std::fs::read(recording.path()).unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    bytes
}

#[test]
fn the_recorders_own_file_is_read_by_name_with_the_rate_of_its_times() {
    let healthy = include_str!("../../scenes/6205-healthy.toml");
    let bytes = recorded(&(healthy.to_owned() + "\n[recorder]\nrate_hz = 51200.0\n"));
    let recording = read_as("npy", &bytes, None).unwrap();
    assert!((recording.rate() / RATE - 1.0).abs() < 1e-9);
    // 20 ms, less the rows that the filter has still under way.
    const ROWS: usize = 1024 - 15;
    assert_eq!(recording.samples().len(), ROWS);
    assert!(recording.samples().iter().any(|x| x.abs() > 1e-6));
    refused(read_as("npy", &bytes, Some(25_600.0)), &["25600 Hz", "the file states 51200"]);
    // Rows are taken out, and their number in the header changed.
    let header = 12 + u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
    let row = (bytes.len() - header) / ROWS;
    let text = String::from_utf8(bytes[12..header].to_vec()).unwrap().replace("(1009,)", "(909,) ");
    let (before, after) = (&bytes[header..header + 400 * row], &bytes[header + 500 * row..]);
    let holed = [&bytes[..12], text.as_bytes(), before, after].concat();
    refused(read_as("npy", &holed, None), &["time", "a hole of 0.001953 s after 0.007793 s", "about 100 samples"]);
    for cut in [bytes.len() - 1, bytes.len() - row, header + row / 2, header, header - 1, 20, 0] {
        assert!(read_as("npy", &bytes[..cut], None).is_err(), "{cut} bytes");
    }
    refused(read_as("npy", &[&bytes[..], &[0; 8]].concat(), None), &["bytes of numbers"]);
    // Without a sensor there is no acceleration to take: what there is is listed.
    let at = healthy.find("[sensor]").unwrap();
    let after = healthy[at..].find("\n[").map_or("", |next| &healthy[at + next..]);
    let bytes = recorded(&format!("{}{after}\n[recorder]\nrate_hz = 51200.0\n", &healthy[..at]));
    refused(read_as("npy", &bytes, None), &["which is the signal", "time", "shaft.ay", "element[9].path"]);
}

/// Plain bytes of a `.npy` file of one row of doubles.
fn npy(samples: &[f64]) -> Vec<u8> {
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", samples.len());
    header += &" ".repeat((64 - (header.len() + 11) % 64) % 64);
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(samples.iter().flat_map(|x| x.to_le_bytes()));
    bytes
}

/// A `.wav` file of 16 bits and one channel.
fn wav(samples: &[f64], rate: u32) -> Vec<u8> {
    let data: Vec<u8> = samples.iter().flat_map(|&x| (x as i16).to_le_bytes()).collect();
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((36 + data.len() as u32).to_le_bytes());
    bytes.extend(b"WAVEfmt \x10\0\0\0\x01\0\x01\0");
    bytes.extend(rate.to_le_bytes());
    bytes.extend((2 * rate).to_le_bytes());
    bytes.extend(b"\x02\0\x10\0data");
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes
}

#[test]
fn a_file_cut_short_is_refused_at_any_byte() {
    let samples: Vec<f64> = noise(500).iter().map(|x| (1000.0 * x).round()).collect();
    for (ending, bytes) in [("npy", npy(&samples)), ("wav", wav(&samples, 51_200))] {
        let rate = Some(RATE);
        assert_eq!(read_as(ending, &bytes, rate).unwrap().samples().len(), 500);
        for cut in 0..bytes.len() {
            assert!(read_as(ending, &bytes[..cut], rate).is_err(), "{cut} of {} bytes of .{ending}", bytes.len());
        }
    }
}

#[test]
fn a_rate_that_contradicts_the_file_is_refused_and_without_the_files_own_nothing_is_resolved() {
    let samples = signal(5.0, SPEED, 0.03);
    let time = times(RATE, samples.len(), samples.len(), 0.0);
    let text = timed("time [s];acc\n", time, &samples, &|t| format!("{t:.6}"));
    for rate in [RATE / 2.0, 0.98 * RATE, 1.02 * RATE, 2.0 * RATE, 51.2] {
        refused(read_as("csv", text.as_bytes(), Some(rate)), &["the file states 51200", "1 %"]);
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
    assert!(size(&[wrong], &scene()).unwrap_err().to_string().contains("is the rate or the speed of 600 Hz wrong?"));
}

#[test]
fn the_unit_the_sign_and_an_offset_of_the_signal_do_not_matter() {
    let samples = signal(5.0, SPEED, 0.03);
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
    let samples = signal(5.0, SPEED, 0.03);
    for factor in [1e300, 1e160, 1e-160, 1e-300] {
        let read = Recording::new("made", samples.iter().map(|x| factor * x).collect(), RATE, SPEED);
        refused(read.map_err(|why| why.to_string()), &["differ by 1e-100", "within ±1e100"]);
    }
    let samples: Vec<f64> = samples.iter().map(|x| x.signum() * f64::MAX).collect();
    refused(read_as("npy", &npy(&samples), Some(RATE)), &["within ±1e100"]);
}

#[test]
fn a_saturated_recording_is_refused_and_one_clipped_too_little_to_matter_is_sized_right() {
    let samples = signal(5.0, SPEED, 0.03);
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
    let samples = signal(5.0, SPEED, 0.03);
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
        refused(read_as("csv", lines.join("\n").as_bytes(), Some(RATE)), &["line 701", part]);
    }
}

#[test]
fn a_gap_that_was_filled_with_zeros_or_the_last_value_gives_no_wrong_length() {
    let samples = signal(5.0, SPEED, 0.03);
    for seconds in [5e-3, 0.5] {
        for at in [0.0, 2.0] {
            for last in [false, true] {
                let (from, to) = ((at * RATE) as usize, ((at + seconds) * RATE) as usize);
                let mut filled = samples.clone();
                let value = if last { samples[from] } else { 0.0 };
                filled[from..to].fill(value);
                let found = Recording::new("filled", filled, RATE, SPEED).map(|recording| sized(recording).length_deg);
                let right = found.as_ref().is_ok_and(|f| f.is_none_or(|length| (length / 5.0 - 1.0).abs() < 0.1));
                assert!(right || found.is_err(), "{seconds} s at {at} s: {found:?}");
            }
        }
    }
}
