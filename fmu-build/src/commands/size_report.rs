//! The page of `size --report`: the answer in five lines, the recordings beside each other, and for each its spectrum,
//! the envelope's with the lines of all kinds of fault, the averaged passage, and how strong the lines of each kind
//! are.

use anyhow::Result;
use brinell::geometry::kinematics::frequencies;
use brinell::scene::Scene;
use brinell_analysis::recording::Recording;
use brinell_analysis::sizing::{Fault, Grade, Standing};
use brinell_analysis::sizing::{Figure, RecordingReport, Report};
use brinell_analysis::spectra::{Comb, EnvelopeSpectrum};
use brinell_analysis::{spectrum, statistics};
use minijinja::context;
use serde_json::{Value, json};

use crate::package::render;
use crate::shared::digits;

const PAGE: &str = include_str!("../../assets/size.html");
/// Size of a chart without its axes (px).
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 200.0;
/// Numbers on an axis, about.
const ACROSS: f64 = 10.0;
const DOWN: f64 = 4.0;
/// Columns in which the lowest and the highest value are drawn.
const COLUMNS: usize = 900;
/// Harmonics of each kind of fault that are marked.
const HARMONICS: u32 = 3;
/// What a passage is drawn over.
const TRAVEL: &str = "travel of the element (degrees)";
/// Powers so far below the highest are drawn on the lower edge (dB).
const LOWEST: f64 = -80.0;

/// The damaged part and how plainly it shows.
pub(super) fn damaged(fault: Fault, grade: Grade) -> String {
    let part = match fault {
        Fault::Outer => "outer raceway",
        Fault::Inner => "inner raceway",
        Fault::Element => "rolling element",
        Fault::Undecided => return "undecided whether a part is damaged, and which".to_owned(),
        Fault::None => return "no fault found".to_owned(),
    };
    format!("{part} damaged ({})", grade.name())
}

/// The length of the spall.
pub(super) fn length(report: &Report) -> String {
    match (report.length_mm, report.uncertainty_mm, report.length_deg, report.at_least_deg) {
        (Some(mm), Some(half), Some(degrees), _) => {
            format!("spall of {mm:.2} ± {half:.2} mm ({degrees:.2} ± {:.2} degrees)", half * degrees / mm)
        }
        (.., least) => at_least(least),
    }
}

/// The same of one recording.
pub(super) fn recorded_length(one: &RecordingReport) -> String {
    match (one.length_deg, one.uncertainty_deg) {
        (Some(length), Some(half)) => format!("{length:.2} ± {half:.2} degrees"),
        _ => at_least(one.at_least_deg),
    }
}

fn at_least(degrees: Option<f64>) -> String {
    degrees.map_or("no length".to_owned(), |degrees| format!("spall of at least {degrees:.2} degrees"))
}

/// What is read first: five lines.
fn answer(report: &Report) -> Value {
    let standing = match report.standing {
        Some(Standing::Firm) => ", at two speeds alike",
        Some(Standing::Provisional) => ", provisional: from one speed",
        None => "",
    };
    let certainty = match report.grade {
        Grade::Clear => "clear: the lines of this part are strong, and at least five times those of any other",
        Grade::Likely => "likely: the lines of this part lead, but are weak or have a rival",
        Grade::Possible => "possible: the recordings do not decide",
        Grade::None => "no fault found",
    };
    let assumed = if report.assumed.is_empty() { "nothing".to_owned() } else { report.assumed.join("; ") };
    json!([
        ["Part", damaged(report.fault, report.grade)],
        ["Length", format!("{}{standing}", length(report))],
        ["Certainty", certainty],
        ["Assumed", assumed],
        ["Next", report.next],
    ])
}

/// The page.
///
/// # Errors
/// Of its template.
pub(super) fn page(report: &Report, recordings: &[Recording], scene: &Scene, found: &str) -> Result<String> {
    let figures = report.recordings.iter().zip(&report.figures).zip(recordings);
    let parts: Vec<Value> = figures.map(|((one, figure), recording)| part(one, figure, recording, scene)).collect();
    let parts = minijinja::value::Serde(parts);
    let answer = minijinja::value::Serde(answer(report));
    let reasons: Vec<String> = report.reason.split("; ").map(str::to_owned).collect();
    let (bearing, load) = (&scene.bearing, scene.shaft.load[0].hypot(scene.shaft.load[1]));
    let machine = format!(
        "Bearing with {} elements of {} mm on a pitch circle of {} mm, load {load:.0} N{}.",
        bearing.element_count,
        digits(2e3 * bearing.element_radius()),
        digits(1e3 * bearing.pitch_diameter),
        if report.assumed.iter().any(|assumed| assumed.starts_with("load")) { " (assumed)" } else { "" }
    );
    let program = env!("CARGO_PKG_VERSION");
    let size = context! { width => WIDTH, height => HEIGHT };
    render("size.html", PAGE, context! { found, answer, reasons, machine, parts, program, ..size })
}

fn part(one: &RecordingReport, figure: &Figure, recording: &Recording, scene: &Scene) -> Value {
    let nominal = frequencies(&scene.bearing, 0.0, recording.speed());
    let comb = |kind: &str, rolling: f64, comb: &Comb| {
        json!([
            kind,
            format!("{rolling:.2}"),
            format!("{:.2}", comb.frequency),
            format!("{:.1}", 100.0 * comb.share),
            format!("{:.1}", 100.0 * comb.alone)
        ])
    };
    let combs = [
        comb("outer raceway (BPFO)", nominal.bpfo, &one.combs.outer),
        comb("inner raceway (BPFI)", nominal.bpfi, &one.combs.inner),
        comb("rolling element (2 BSF)", 2.0 * nominal.bsf, &one.combs.element),
    ];
    let events = events(one);
    json!({
        "name": one.name,
        "facts": format!(
            "{:.3} s at {:.0} Hz, shaft {:.3} Hz", recording.duration(), recording.rate(), recording.speed()
        ),
        "answer": damaged(one.fault, one.grade),
        "length": recorded_length(one),
        "speed": format!("{:.2} Hz", recording.speed()),
        "speaks_for": one.speaks_for,
        "speaks_against": one.speaks_against,
        "combs": combs,
        "reason": one.reason,
        "charts": [
            signal_spectrum(recording),
            envelope_spectrum(one, recording, scene),
            chart("Averaged passage: signal (unit of the recording)", TRAVEL, &figure.angle, &figure.signal, &events),
            chart(
                "Averaged passage: level of the high-frequency envelope (dB)",
                TRAVEL,
                &figure.angle,
                &figure.level,
                &events
            ),
        ],
    })
}

fn signal_spectrum(recording: &Recording) -> Value {
    let (power, width) = spectrum::power(recording.samples(), recording.rate(), 0);
    let highest = power.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let level: Vec<f64> = power.iter().map(|p| (10.0 * libm::log10((p / highest).max(1e-30))).max(LOWEST)).collect();
    let frequency: Vec<f64> = (0..level.len()).map(|i| 1e-3 * i as f64 * width).collect();
    chart("Spectrum of the signal (dB, highest line 0)", "frequency (kHz)", &frequency, &level, &[])
}

fn envelope_spectrum(one: &RecordingReport, recording: &Recording, scene: &Scene) -> Value {
    let nominal = frequencies(&scene.bearing, 0.0, recording.speed());
    let title = "Spectrum of the squared envelope";
    let Some(envelope) = EnvelopeSpectrum::of(recording.samples(), recording.rate(), nominal, recording.speed()) else {
        return chart(&format!("{title}: the recording is too short or too coarse"), "frequency (Hz)", &[], &[], &[]);
    };
    // Where the combs are, not where pure rolling has them.
    let combs = [("BPFO", &one.combs.outer), ("BPFI", &one.combs.inner), ("2 BSF", &one.combs.element)];
    let marks: Vec<(f64, String)> = combs
        .into_iter()
        .flat_map(|(name, comb)| (1..=HARMONICS).map(move |k| (f64::from(k) * comb.frequency, times(k, name))))
        .chain([(recording.speed(), "shaft".to_owned())])
        .collect();
    let [low, high] = [envelope.band.low, envelope.band.high].map(|hertz| 1e-3 * hertz);
    let title = format!("{title} of {low:.1} to {high:.1} kHz (share of its mean)");
    chart(&title, "frequency (Hz)", &envelope.frequency, &envelope.amplitude, &marks)
}

fn times(count: u32, name: &str) -> String {
    if count == 1 { name.to_owned() } else { format!("{count} × {name}") }
}

fn events(one: &RecordingReport) -> Vec<(f64, String)> {
    let edges = one.edges_deg.into_iter().flat_map(|[lead, trail]| [(lead, "leading edge"), (trail, "trailing edge")]);
    let impacts = one.impacts_deg.iter().map(|&at| (at, "impact"));
    edges.chain(impacts).map(|(at, name)| (at, name.to_owned())).collect()
}

/// A curve in pixels, with numbers on its axes and what is marked.
fn chart(title: &str, axis: &str, x: &[f64], y: &[f64], marks: &[(f64, String)]) -> Value {
    let ends = |values: &[f64]| statistics::extent(values.iter().copied());
    let ([left, right], [low, high]) = (ends(x), ends(y));
    let across = |value: f64| WIDTH * (value - left) / (right - left).max(f64::MIN_POSITIVE);
    let down = |value: f64| HEIGHT * (high - value) / (high - low).max(f64::MIN_POSITIVE);
    let mut points = String::new();
    let every = x.len().div_ceil(COLUMNS).max(1);
    for (x, y) in x.chunks(every).zip(y.chunks(every)) {
        let [low, high] = ends(y);
        points += &format!("{:.1},{:.1} {:.1},{:.1} ", across(x[0]), down(low), across(x[0]), down(high));
    }
    let mut marks: Vec<&(f64, String)> = marks.iter().filter(|(at, _)| (left..=right).contains(at)).collect();
    marks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let named = |at: String, name: &str| json!({ "at": at, "name": name });
    let marks: Vec<Value> = marks.into_iter().map(|(at, name)| named(format!("{:.1}", across(*at)), name)).collect();
    let x_ticks = ticks(left, right, ACROSS).into_iter().map(|(at, name)| named(format!("{:.1}", across(at)), &name));
    let y_ticks = ticks(low, high, DOWN).into_iter().map(|(at, name)| named(format!("{:.1}", down(at)), &name));
    let (x_ticks, y_ticks): (Vec<Value>, Vec<Value>) = (x_ticks.collect(), y_ticks.collect());
    json!({
        "title": title, "axis": axis, "points": points, "marks": marks, "x_ticks": x_ticks, "y_ticks": y_ticks
    })
}

/// About so many numbers between two ends, one, two or five of a power of ten apart, and as they are written.
fn ticks(low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
    let wide = (high - low) / count;
    if !(wide.is_finite() && wide > 0.0) {
        return Vec::new();
    }
    let power = libm::floor(libm::log10(wide));
    let ten = libm::pow(10.0, power);
    let step = ten * [1.0, 2.0, 5.0, 10.0].into_iter().find(|&times| times * ten >= wide).unwrap_or(10.0);
    let (from, to) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    let written = |value: f64| {
        if (1e-3..1e5).contains(&step) {
            format!("{value:.*}", (-libm::floor(libm::log10(step * 1.000_001))).max(0.0) as usize)
        } else {
            format!("{value:.1e}")
        }
    };
    (from..=to).map(|k| k as f64 * step).map(|value| (value, written(value))).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_chart_spans_its_box_keeps_single_peaks_and_marks_what_lies_inside() {
        let x: Vec<f64> = (0..100_000).map(f64::from).collect();
        let y: Vec<f64> = x.iter().map(|&x| if x == 54_321.0 { 1.0 } else { 0.0 }).collect();
        let chart = chart("t", "Hz", &x, &y, &[(49_999.5, "middle".to_owned()), (2e5, "beyond".to_owned())]);
        let points: Vec<[f64; 2]> = chart["points"]
            .as_str()
            .unwrap()
            .split_whitespace()
            .map(|point| {
                let (x, y) = point.split_once(',').unwrap();
                [x.parse().unwrap(), y.parse().unwrap()]
            })
            .collect();
        // The one peak is at the top, all else at the bottom; a column is a pixel wide.
        let top: Vec<&[f64; 2]> = points.iter().filter(|point| point[1] == 0.0).collect();
        assert!(top.len() == 1 && (top[0][0] - WIDTH * 0.54321).abs() < 1.1, "{top:?}");
        assert!(points.iter().all(|point| (0.0..=WIDTH).contains(&point[0]) && (0.0..=HEIGHT).contains(&point[1])));
        assert_eq!(chart["marks"], json!([{ "at": "450.0", "name": "middle" }]));
    }

    #[test]
    fn numbers_on_an_axis_are_round_and_inside() {
        let names = |low, high, count| ticks(low, high, count).into_iter().map(|(_, name)| name).collect::<Vec<_>>();
        assert_eq!(names(-80.0, 0.0, 4.0), ["-80", "-60", "-40", "-20", "0"]);
        assert_eq!(names(-0.31, 0.42, 4.0), ["-0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(names(0.0, 2.2e-4, 4.0), ["0.0e0", "1.0e-4", "2.0e-4"]);
        assert!(names(1.0, 1.0, 4.0).is_empty() && names(f64::INFINITY, f64::NEG_INFINITY, 4.0).is_empty());
    }
}
