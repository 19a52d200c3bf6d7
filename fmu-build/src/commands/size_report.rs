//! The page of `size --report`: the answer, and for each recording its spectrum, the envelope's with the lines of all
//! kinds of fault, the averaged passage, and how strong the comb of each kind is.

use anyhow::Result;
use brinell::geometry::kinematics::frequencies;
use brinell::scene::Scene;
use brinell_analysis::recording::Recording;
use brinell_analysis::sizing::{Figure, RecordingReport, Report};
use brinell_analysis::spectra::{CombReport, EnvelopeSpectrum};
use brinell_analysis::spectrum;
use minijinja::context;
use serde_json::{Value, json};

use crate::package::render;

const PAGE: &str = include_str!("../../assets/size.html");
/// Size of a chart (px).
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 200.0;
/// Columns in which the lowest and the highest value are drawn.
const COLUMNS: usize = 900;
/// Harmonics of each kind of fault that are marked.
const HARMONICS: u32 = 3;
/// Powers so far below the highest are drawn on the lower edge (dB).
const LOWEST: f64 = -80.0;

/// The page.
///
/// # Errors
/// Of its template.
pub(super) fn page(report: &Report, recordings: &[Recording], scene: &Scene, answer: &str) -> Result<String> {
    let figures = report.recordings.iter().zip(&report.figures).zip(recordings);
    let parts: Vec<Value> =
        figures.map(|((one, figure), recording)| part(one, figure, recording, scene, &report.reason)).collect();
    let parts = minijinja::value::Serde(parts);
    render(
        "size.html",
        PAGE,
        context! { answer, parts, program => env!("CARGO_PKG_VERSION"), width => WIDTH, height => HEIGHT },
    )
}

fn part(one: &RecordingReport, figure: &Figure, recording: &Recording, scene: &Scene, reason: &str) -> Value {
    let comb = |kind: &str, comb: &CombReport| {
        json!([
            kind,
            format!("{:.2}", comb.frequency_hz),
            format!("{:.1}", 100.0 * comb.share),
            format!("{:.1}", 100.0 * comb.alone)
        ])
    };
    let combs = [
        comb("outer raceway (BPFO)", &one.combs.outer),
        comb("inner raceway (BPFI)", &one.combs.inner),
        comb("rolling element (2 BSF)", &one.combs.element),
    ];
    json!({
        "name": one.name,
        "facts": format!(
            "{:.3} s at {:.0} Hz, shaft {:.3} Hz", recording.duration(), recording.rate(), recording.speed()
        ),
        "fault": one.fault,
        "speaks_for": one.speaks_for,
        "speaks_against": one.speaks_against,
        "combs": combs,
        "reason": one.reason.as_deref().unwrap_or(reason),
        "charts": [
            signal_spectrum(recording),
            envelope_spectrum(recording, scene),
            passage(one, figure),
            level(one, figure),
        ],
    })
}

fn signal_spectrum(recording: &Recording) -> Value {
    let (power, width) = spectrum::power(recording.samples(), recording.rate(), 0);
    let highest = power.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let level: Vec<f64> = power.iter().map(|p| (10.0 * libm::log10((p / highest).max(1e-30))).max(LOWEST)).collect();
    let frequency: Vec<f64> = (0..level.len()).map(|i| i as f64 * width).collect();
    chart("Spectrum (dB below the highest line)", "Hz", &frequency, &level, &[])
}

fn envelope_spectrum(recording: &Recording, scene: &Scene) -> Value {
    let nominal = frequencies(&scene.bearing, 0.0, recording.speed());
    let title = "Spectrum of the squared envelope";
    let Some(envelope) = EnvelopeSpectrum::of(recording.samples(), recording.rate(), nominal, recording.speed()) else {
        return chart(&format!("{title}: the recording is too short or too coarse"), "Hz", &[], &[], &[]);
    };
    let marks: Vec<(f64, String)> = [("BPFO", nominal.bpfo), ("BPFI", nominal.bpfi), ("2 BSF", 2.0 * nominal.bsf)]
        .into_iter()
        .flat_map(|(name, hertz)| (1..=HARMONICS).map(move |k| (f64::from(k) * hertz, format!("{k} × {name}"))))
        .chain([(recording.speed(), "shaft".to_owned())])
        .collect();
    let title = format!("{title}, {:.0} to {:.0} Hz", envelope.band.low, envelope.band.high);
    chart(&title, "Hz", &envelope.frequency, &envelope.amplitude, &marks)
}

fn passage(one: &RecordingReport, figure: &Figure) -> Value {
    chart("Averaged passage: signal", "degrees of element travel", &figure.angle, &figure.signal, &events(one))
}

fn level(one: &RecordingReport, figure: &Figure) -> Value {
    let title = "Averaged passage: level of the high-frequency envelope (dB)";
    chart(title, "degrees of element travel", &figure.angle, &figure.level, &events(one))
}

fn events(one: &RecordingReport) -> Vec<(f64, String)> {
    let edges = one.edges_deg.into_iter().flat_map(|[lead, trail]| [(lead, "leading edge"), (trail, "trailing edge")]);
    let impacts = one.impacts_deg.iter().map(|&at| (at, "impact"));
    edges.chain(impacts).map(|(at, name)| (at, name.to_owned())).collect()
}

/// A curve in pixels, with what is marked on its axis.
fn chart(title: &str, unit: &str, x: &[f64], y: &[f64], marks: &[(f64, String)]) -> Value {
    let ends =
        |values: &[f64]| values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
    let ((left, right), (low, high)) = (ends(x), ends(y));
    let across = |value: f64| WIDTH * (value - left) / (right - left).max(f64::MIN_POSITIVE);
    let down = |value: f64| HEIGHT * (high - value) / (high - low).max(f64::MIN_POSITIVE);
    let mut points = String::new();
    let every = x.len().div_ceil(COLUMNS).max(1);
    for (x, y) in x.chunks(every).zip(y.chunks(every)) {
        let (low, high) = ends(y);
        points += &format!("{:.1},{:.1} {:.1},{:.1} ", across(x[0]), down(low), across(x[0]), down(high));
    }
    let marks = marks.iter().filter(|(at, _)| (left..=right).contains(at));
    let marks: Vec<Value> =
        marks.map(|(at, name)| json!({ "x": format!("{:.1}", across(*at)), "name": name })).collect();
    let axis = format!("{left:.4} to {right:.4} {unit}");
    let [low, high] = [low, high].map(|value| format!("{value:.3e}"));
    json!({ "title": title, "axis": axis, "low": low, "high": high, "points": points, "marks": marks })
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
        assert_eq!(chart["marks"], json!([{ "x": "450.0", "name": "middle" }]));
    }
}
