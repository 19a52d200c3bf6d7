//! How far ahead a run with impacts can be known: elements that hang loose between the rings bounce, and every bounce
//! makes small differences larger.

use crate::support::{Named, shipped};
use brinell::scene::{Recorder, RecorderFilter};
use std::fmt::Write;
use std::ops::Range;

/// Simulated time (s): three passages over the spall.
const STOP: f64 = 0.1;
/// Samples per second: event times are known to 1 µs.
const RATE: f64 = 1e6;
/// The tightest tolerance: what the others are compared with.
const TIGHTEST: f64 = 1e-12;

/// Samples of one run.
struct Run {
    acceleration: Vec<f64>,
    /// One list for each element.
    paths: Vec<Vec<f64>>,
    outer: Vec<Vec<f64>>,
    inner: Vec<Vec<f64>>,
    /// Integration steps taken, and those refused.
    steps: [i32; 2],
}

impl Run {
    /// `er16k-tb1` at a tolerance, element 5 (on the unloaded side) moved by `moved` (m) at the start.
    fn new(tolerance: f64, moved: f64) -> Self {
        Self::of("er16k-tb1", tolerance, moved)
    }

    /// Any of the test bearing's scenes so.
    fn of(scene: &str, tolerance: f64, moved: f64) -> Self {
        let mut scene = shipped(scene);
        scene.tolerance = tolerance;
        // Instants at which contacts begin are looked for, so nothing is filtered.
        scene.recorder = Some(Recorder { rate: RATE, filter: RecorderFilter::None });
        let mut bearing = Named::recorded(scene);
        move_element(&mut bearing, 5, moved);
        bearing.run(1e-4, (STOP / 1e-4).round() as usize);
        let steps = ["solver.steps", "solver.rejected_steps"].map(|name| bearing.count(name));
        let of_elements = |what: &str| {
            let names: Vec<String> = (1..=9).map(|j| format!("element[{j}].{what}")).collect();
            bearing.columns(&names.iter().map(String::as_str).collect::<Vec<_>>())
        };
        Self {
            acceleration: bearing.columns(&["housing.ay"]).remove(0),
            paths: of_elements("path"),
            outer: of_elements("force.outer"),
            inner: of_elements("force.inner"),
            steps,
        }
    }

    /// Largest difference of any path up to and at about a time.
    fn distance(&self, other: &Run, time: f64) -> f64 {
        let window = window(time - 1e-3, time);
        let pairs = self.paths.iter().zip(&other.paths);
        pairs.fold(0.0f64, |m, (a, b)| {
            a[window.clone()].iter().zip(&b[window.clone()]).fold(m, |m, (a, b)| m.max((a - b).abs()))
        })
    }

    /// Contacts begun by elements up to a time.
    fn bounces(&self, time: f64) -> usize {
        let begun =
            |force: &Vec<f64>| force[window(0.0, time)].windows(2).filter(|f| f[0] == 0.0 && f[1] > 0.0).count();
        self.inner.iter().chain(&self.outer).map(begun).sum()
    }

    fn rms(&self, from: f64, to: f64) -> f64 {
        let window = &self.acceleration[window(from, to)];
        (window.iter().map(|a| a * a).sum::<f64>() / window.len() as f64).sqrt()
    }

    /// Rms of the acceleration's difference over that of the acceleration.
    fn error(&self, exact: &Run, from: f64, to: f64) -> f64 {
        let window = window(from, to);
        let pairs = self.acceleration[window.clone()].iter().zip(&exact.acceleration[window.clone()]);
        (pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / window.len() as f64).sqrt() / exact.rms(from, to)
    }

    /// When the outer contact of the element that enters first is lost, when it strikes again, and when the
    /// acceleration is largest in this passage (s).
    fn events(&self) -> [f64; 3] {
        let outer = &self.outer[0];
        let lost = (4e-3 * RATE) as usize + outer[(4e-3 * RATE) as usize..].iter().position(|&f| f == 0.0).unwrap();
        let struck = lost + outer[lost..].iter().position(|&f| f > 0.0).unwrap();
        let passage = window(4e-3, 16e-3);
        let peak = passage.max_by(|&a, &b| self.acceleration[a].abs().total_cmp(&self.acceleration[b].abs())).unwrap();
        [lost, struck, peak].map(|i| i as f64 / RATE)
    }
}

fn window(from: f64, to: f64) -> Range<usize> {
    (from * RATE) as usize..(to * RATE) as usize
}

/// By way of the state's bytes, which hold the path bit by bit.
fn move_element(bearing: &mut Named, element: usize, by: f64) {
    let path = bearing.0.state_vector()[element - 1];
    let mut bytes = bearing.0.save().to_bytes();
    let offset = bytes.windows(8).position(|eight| eight == path.to_le_bytes()).unwrap();
    bytes[offset..offset + 8].copy_from_slice(&(path + by).to_le_bytes());
    let state = bearing.0.state_from_bytes(&bytes).unwrap();
    bearing.0.restore(&state).unwrap();
    assert_eq!(bearing.0.state_vector()[element - 1], path + by);
}

/// Times of the first table (s).
const TIMES: [f64; 8] = [2e-3, 5e-3, 10e-3, 15e-3, 20e-3, 30e-3, 50e-3, 100e-3];
/// Tolerances of the second.
const TOLERANCES: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-7, 1e-9];
/// Windows of the second (s).
const WINDOWS: [(f64, f64); 4] = [(0.0, 10e-3), (10e-3, 20e-3), (20e-3, 30e-3), (50e-3, 100e-3)];

/// How a difference of 1e-12 m grows.
fn growth([exact, moved]: [&Run; 2]) -> String {
    let mut growth = "| ms | contacts begun | largest difference of any path, m |\n|---:|---:|---:|\n".to_owned();
    for time in TIMES {
        writeln!(growth, "| {:.0} | {} | {:.1e} |", 1e3 * time, exact.bounces(time), moved.distance(exact, time))
            .unwrap();
    }
    growth
}

/// What does not depend on how well a run is known: the dry bearing's and the oiled one's.
fn outline(runs: [(&str, &Run); 2]) -> String {
    let mut text = "| | contact lost | struck again | `housing.ay` largest | its rms, 0–50 ms | 50–100 ms |\n\
                    |---|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for (name, run) in runs {
        let [lost, struck, peak] = run.events();
        let largest = run.acceleration[(peak * RATE) as usize].abs();
        let rms = [run.rms(0.0, 50e-3), run.rms(50e-3, 100e-3)];
        writeln!(
            text,
            "| {name} | {:.3} ms | {:.3} ms | {largest:.2} m/s² at {:.3} ms | {:.3} m/s² | {:.3} m/s² |",
            1e3 * lost,
            1e3 * struck,
            1e3 * peak,
            rms[0],
            rms[1]
        )
        .unwrap();
    }
    text
}

/// What oil changes for contacts and for steps.
fn oil([dry, oiled]: [&Run; 2]) -> String {
    let [before, after] = [dry, oiled].map(|run| run.events()[1]);
    let [dry, oiled] = [("er16k-tb1", TOLERANCES[2]), ("er16k-tb1-oil", TOLERANCES[2])]
        .map(|(scene, tolerance)| Run::of(scene, tolerance, 0.0).steps);
    format!(
        "With oil the force of a contact begins where the gap begins to close, {:.1} ms before the outer raceway is\n\
         touched. Loaded elements hardly change. A run takes fewer steps, because nothing bounces: {} in 0.1 s at the\n\
         default tolerance, {} of them rejected; the dry bearing takes {} and rejects {}.\n",
        1e3 * (before - after),
        oiled[0],
        oiled[1],
        dry[0],
        dry[1]
    )
}

/// How a difference grows in the dry bearing, how with oil and what that changes besides, and what growth makes of
/// tolerances: each with the place that it has on the page.
pub fn tables() -> [(&'static str, String); 3] {
    let exact = Run::new(TIGHTEST, 0.0);
    let moved = Run::new(TIGHTEST, 1e-12);
    let (from, to) = (5e-3, 50e-3);
    let tenfold = (moved.distance(&exact, to) / moved.distance(&exact, from)).log10();
    let (milliseconds, contacts) = (1e3 * (to - from) / tenfold, exact.bounces(to) as f64 / tenfold);
    let mut dry = growth([&exact, &moved]);
    writeln!(
        dry,
        "\nFrom 5 to 50 ms the difference grows tenfold every {milliseconds:.1} ms, or every {contacts:.0} contacts \
         begun. Later the paths differ by the whole play."
    )
    .unwrap();
    let oiled = [0.0, 1e-12].map(|moved| Run::of("er16k-tb1-oil", TIGHTEST, moved));
    let changed = oil([&exact, &oiled[0]]);
    let oiled = growth([&oiled[0], &oiled[1]]) + "\n" + &outline([("dry", &exact), ("with oil", &oiled[0])]);

    let mut text = "| tolerance | error of `housing.ay`, 0–10 ms | 10–20 ms | 20–30 ms | 50–100 ms | its rms, 0–50 ms \
                    | 50–100 ms | contact lost | struck again | `housing.ay` largest \
                    |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    let line = |name: String, run: &Run| {
        let errors = WINDOWS.map(|(from, to)| format!("{:.0e}", run.error(&exact, from, to))).join(" | ");
        let rms = [run.rms(0.0, 50e-3), run.rms(50e-3, 100e-3)].map(|a| format!("{a:.3} m/s²")).join(" | ");
        let events = run.events().map(|t| format!("{:.3} ms", 1e3 * t)).join(" | ");
        format!("| {name} | {errors} | {rms} | {events} |\n")
    };
    for tolerance in TOLERANCES {
        text += &line(format!("{tolerance:.0e}"), &Run::new(tolerance, 0.0));
    }
    text += &line("1e-12, moved by 1e-12 m".to_owned(), &moved);
    text += &line("1e-12".to_owned(), &exact);
    [("growth", dry), ("tolerances", text), ("with oil", oiled + "\n" + &changed)]
}

#[test]
fn bounces_make_a_small_difference_ten_million_times_larger_in_fifty_milliseconds() {
    let (exact, moved) = (Run::new(1e-11, 0.0), Run::new(1e-11, 1e-12));
    // Before anything bounces the element keeps its 1e-12 m; after half the time it could have been anything between.
    assert!(moved.distance(&exact, 5e-3) < 2e-12, "{:e}", moved.distance(&exact, 5e-3));
    let late = moved.distance(&exact, 50e-3);
    // The play of a loose element is some 10 µm at least, and 100 µm over the spall.
    assert!(late > 1e-8 && late < 1.1e-4, "{late:e}");
}

#[test]
fn events_and_rms_values_do_not_depend_on_the_tolerance() {
    let (loose, tight) = (Run::new(1e-4, 0.0), Run::new(1e-9, 0.0));
    for (a, b) in loose.events().into_iter().zip(tight.events()) {
        // Two samples.
        assert!((a - b).abs() <= 2.0 / RATE, "{a} {b}");
    }
    for (from, to) in [(0.0, 50e-3), (50e-3, STOP)] {
        let (a, b) = (loose.rms(from, to), tight.rms(from, to));
        // The loose elements' share of the acceleration is some 2 %, and uncorrelated parts add in squares.
        assert!((a / b - 1.0).abs() < 5e-3, "{a} {b}");
    }
    assert!(loose.error(&tight, 50e-3, STOP) > 1e-3, "nothing was lost: the comparison shows nothing");
}

#[test]
fn oil_lets_a_small_difference_die_away() {
    let [exact, moved] = [0.0, 1e-12].map(|moved| Run::of("er16k-tb1-oil", 1e-11, moved));
    // A loose element is pushed to where its film lets it come, wherever it came from. What is left is the rounding of
    // paths of up to 100 µm, 1e-20 m, made larger by the few impacts that stay.
    for time in [10e-3, 20e-3, 50e-3, STOP] {
        assert!(moved.distance(&exact, time) < 1e-12, "{time}: {:e}", moved.distance(&exact, time));
    }
    assert!(exact.bounces(STOP) > 100, "nothing bounced: the comparison shows nothing");
}

#[test]
fn with_oil_nothing_bounces_and_steps_are_fewer() {
    let [dry, oiled] = ["er16k-tb1", "er16k-tb1-oil"].map(|scene| Run::of(scene, TOLERANCES[2], 0.0).steps);
    assert!(oiled[0] < dry[0] && oiled[1] < dry[1], "{dry:?} {oiled:?}");
}
