//! Length of a spall of the outer raceway from vibration recordings, with its uncertainty, or why there is none.
//!
//! Each recording is sized by likeness to the scene's own rig if the scene describes the rig ([`waveform_length`]), else by the
//! events of its passages, which needs nothing but the bearing's dimensions ([`event_length`]). A rig that sounds like the
//! recording also tells a line spall from an extended one; otherwise ringing does ([`ringing`]), or nothing does.
//!
//! Several recordings are of one spall: their lengths are averaged with their statistical weights, and a scatter that is larger than
//! these explain widens the interval. What all share (what the events mean, the contact's law) is not averaged away.

use super::error::SizingError;
use super::event_length::{self, EventLength, Unresolved};
use super::measured::Measured;
use super::passages;
use super::recording::Recording;
use super::report::{Figure, Kind, Method, RecordingReport, Report, Verdict};
use super::ringing::{self, Ringing};
use super::spectrum::{Band, Spectrum};
use super::statistics;
use super::synthesis::{CUT, Maps, POINTS, Rig, Trial};
use super::waveform_length::{self, WaveformLength};
use crate::scene::{Bearing, ContactLaw, Scene};

/// Coverage factor of the stated interval: 95 % of a normal distribution.
const COVERAGE: f64 = 2.0;
/// Difference of likeness by which one kind of spall is preferred to the other.
const CLEARLY_LIKER: f64 = 0.02;
/// Significance of the comb from which likeness is asked: less than the events need, for to be alike is a proof of its own. Short
/// recordings lose many harmonics to the shaft's.
const HEARD: f64 = 5.0;
/// Scatter between recordings of one spall, as a share of the length, from which they contradict each other.
const CONTRADICTION: f64 = 0.2;
/// Statistical uncertainty that is always granted [degrees]: events are sought on a grid of samples.
const FLOOR: f64 = 0.02;

/// Sizes the spall in recordings of one bearing. The scene gives bearing, load and rig; its defect is not looked at.
///
/// # Errors
/// Recordings that cannot be sized whatever the bearing's state: too short, or too coarse for their speed.
pub fn size(recordings: &[Recording], scene: &Scene) -> Result<Report, SizingError> {
    size_with(recordings, scene, &|_| None, &mut |_| ())
}

/// The same with contact maps from elsewhere, saying after each recording what it gave.
///
/// # Errors
/// As [`size`].
pub fn size_with(
    recordings: &[Recording],
    scene: &Scene,
    maps: Maps<'_>,
    done: &mut dyn FnMut(&RecordingReport),
) -> Result<Report, SizingError> {
    let measured: Vec<Measured> =
        recordings.iter().map(|recording| Measured::new(recording, &scene.bearing)).collect::<Result<_, _>>()?;
    let sized: Vec<Sized> = measured
        .into_iter()
        .map(|measured| {
            let sized = Sized::of(measured, scene, maps);
            done(&sized.report());
            sized
        })
        .collect();
    let first = sized.first().ok_or(SizingError::NoRecordings)?;
    let slips: Vec<f64> = sized.iter().map(|s| s.measured.slip).collect();
    let mut report = Report {
        verdict: Verdict::Unresolved,
        length_mm: None,
        length_deg: None,
        uncertainty_mm: None,
        kind: Kind::Undecided,
        bpfo_hz: first.measured.bpfo,
        slip: statistics::mean(&slips),
        passages: sized.iter().map(|s| s.measured.passages.starts.len()).sum(),
        reason: String::new(),
        method: None,
        critical_load_n: None,
        recordings: sized.iter().map(Sized::report).collect(),
        figures: sized.iter().map(|s| s.figure(&scene.bearing)).collect(),
    };
    let lengths: Vec<&Length> = sized.iter().filter_map(|s| s.length.as_ref().ok()).collect();
    match combine(&lengths, sized.len()) {
        Err(why) => {
            let each =
                sized.iter().filter_map(|s| s.length.as_ref().err().map(|e| format!("{}: {e}", s.measured.name)));
            report.reason = std::iter::once(why).chain(each).collect::<Vec<_>>().join("; ");
        }
        Ok((length, uncertainty)) => {
            let millimetres = 1e3 * scene.bearing.outer_raceway_radius() * length.to_radians() / length;
            report.verdict = Verdict::Resolved;
            report.length_deg = Some(length);
            report.length_mm = Some(length * millimetres);
            report.uncertainty_mm = Some(COVERAGE * uncertainty * millimetres);
            report.kind = common_kind(&lengths);
            report.method = lengths.first().map(|l| l.method);
            report.critical_load_n = sized.iter().find_map(|s| s.critical_load);
            report.reason = basis(&report, &sized, scene);
        }
    }
    Ok(report)
}

/// A recording with what was found in it.
struct Sized {
    measured: Measured,
    length: Result<Length, Unresolved>,
    events: Option<EventLength>,
    waveform: Option<WaveformLength>,
    /// To the scene's rig, whether that was taken for the recording's or not.
    likeness: Option<f64>,
    ringing: Option<Ringing>,
    expected: Option<[Ringing; 2]>,
    critical_load: Option<f64>,
}

/// Length of one recording [degrees].
#[derive(Debug, Clone)]
struct Length {
    length: f64,
    statistical: f64,
    systematic: f64,
    method: Method,
    kind: Kind,
}

impl Sized {
    fn of(measured: Measured, scene: &Scene, maps: Maps<'_>) -> Self {
        let events = event_length::estimate(&measured, scene);
        let rig = Rig::new(scene, measured.bpfo, maps);
        let heard = rig.as_ref().filter(|_| measured.comb.significance >= HEARD);
        let heard = heard.map(|rig| waveform_length::estimate(&measured, scene, rig));
        let likeness = heard.as_ref().map(|heard| heard.as_ref().map_or_else(|other| other.likeness, |w| w.likeness));
        let waveform = heard.and_then(Result::ok);
        let spacing = measured.spacing;
        // Where an entry begins [share of a period], and how far from it the next exit is [degrees].
        let entry = match (&waveform, &events) {
            (Some(w), _) => Some((w.entry, w.length.rem_euclid(spacing))),
            (None, Ok(e)) => Some(((e.first + e.onset) / spacing, e.length)),
            _ => None,
        };
        let ringing = entry.and_then(|(at, over)| measured_ringing(&measured, at, over));
        let trial = |length: f64, depth: f64| Trial { length, depth, law: ContactLaw::Hertz };
        let expected = rig.as_ref().zip(entry).and_then(|(rig, (_, over))| {
            let of = |length: f64| ringing::expected(rig, trial(length, TRIAL_DEPTH), spacing).ok();
            Some([of(over)?, of(over + spacing)?])
        });
        let critical_load = rig
            .as_ref()
            .zip(waveform.as_ref())
            .and_then(|(rig, w)| ringing::critical_load(rig, trial(w.length, w.depth)).ok().flatten());
        let by_ringing = kind_by_ringing(ringing, expected);
        let length = match (&waveform, &events) {
            (Some(w), _) if too_uncertain(w) => {
                Err(Unresolved::TooUncertain(w.length, COVERAGE * w.statistical.hypot(w.systematic)))
            }
            (Some(w), _) => Ok(Length {
                length: w.length,
                statistical: w.statistical,
                systematic: w.systematic,
                method: Method::Waveform,
                kind: kind_by_likeness(w, spacing, by_ringing),
            }),
            (None, Ok(e)) => {
                let extended = if by_ringing == Kind::Extended { spacing } else { 0.0 };
                Ok(Length {
                    length: e.length + extended,
                    statistical: e.statistical,
                    systematic: e.systematic,
                    method: Method::Events,
                    kind: by_ringing,
                })
            }
            (None, Err(why)) => Err(why.clone()),
        };
        Self { measured, length, events: events.ok(), waveform, likeness, ringing, expected, critical_load }
    }

    fn report(&self) -> RecordingReport {
        let length = self.length.as_ref().ok();
        RecordingReport {
            name: self.measured.name.clone(),
            verdict: if length.is_some() { Verdict::Resolved } else { Verdict::Unresolved },
            length_deg: length.map(|l| l.length),
            uncertainty_deg: length.map(|l| COVERAGE * l.statistical.hypot(l.systematic).hypot(FLOOR)),
            method: length.map(|l| l.method),
            bpfo_hz: self.measured.bpfo,
            significance: self.measured.comb.significance,
            onset_deg: self.events.as_ref().map(|e| e.onset),
            blows_deg: self.events.as_ref().map_or_else(Vec::new, |e| e.blows.clone()),
            edges_deg: self.edges(),
            passages: self.measured.passages.starts.len(),
            likeness: self.likeness,
            ringing_hz: self.ringing.map(pair),
            expected_ringing_hz: self.expected.map(|e| e.map(pair)),
            reason: self.length.as_ref().err().map(ToString::to_string),
        }
    }

    /// Both edges [degrees], from where angles count.
    fn edges(&self) -> Option<[f64; 2]> {
        let length = self.length.as_ref().ok()?.length;
        let onset = if self.waveform.is_some() { 0.0 } else { self.events.as_ref()?.onset };
        Some([onset, onset + length])
    }

    fn figure(&self, bearing: &Bearing) -> Figure {
        let measured = &self.measured;
        let from = match (&self.waveform, &self.events) {
            (Some(w), _) => w.entry * measured.spacing,
            (None, Some(e)) => e.first,
            _ => 0.0,
        };
        let [angle, signal, level] = event_length::averaged_passage(measured, from);
        let rate = measured.bpfo * signal.len() as f64;
        let low = Spectrum::of(&signal, rate).filtered(Band { low: 0.5 * measured.bpfo, high: CUT });
        let norm = |signal: &[f64]| (signal.iter().map(|x| x * x).sum::<f64>() / signal.len() as f64).sqrt();
        let model = self.waveform.as_ref().map(|w| {
            let scale = norm(&low) / norm(&w.model);
            let share = |degrees: f64| ((degrees + from) / measured.spacing).rem_euclid(1.0);
            let point = |degrees: f64| (share(degrees) * w.model.len() as f64) as usize % w.model.len();
            angle.iter().map(|&degrees| scale * w.model[point(degrees)]).collect()
        });
        let path = self.edges().map(|[entry, exit]| {
            let sunk = |degrees: f64| event_length::depth_at(bearing, (degrees - entry).min(exit - degrees).max(0.0));
            angle.iter().map(|&degrees| sunk(degrees)).collect()
        });
        Figure { name: measured.name.clone(), angle, signal, level, low, model, path }
    }
}

/// Whether the interval is wider than the length: short spalls all sound alike but for their loudness.
fn too_uncertain(waveform: &WaveformLength) -> bool {
    2.0 * COVERAGE * waveform.statistical.hypot(waveform.systematic) > waveform.length
}

/// Depth at which ringing is expected [m]: deep enough for free elements, which is what the two kinds differ in.
const TRIAL_DEPTH: f64 = 1e-3;

fn pair(ringing: Ringing) -> [f64; 2] {
    [ringing.after_entry, ringing.after_exit]
}

/// Ringing between the events; half a degree after each is left to the event itself.
fn measured_ringing(measured: &Measured, entry: f64, over: f64) -> Option<Ringing> {
    let row = passages::average(&measured.signal_rows(entry, POINTS));
    let rate = measured.bpfo * POINTS as f64;
    let smooth = Spectrum::of(&row, rate).filtered(Band { low: 0.0, high: CUT });
    let point = |degrees: f64| (degrees / measured.spacing * POINTS as f64) as usize;
    let between = |from: f64, to: f64| ringing::strongest(smooth.get(point(from)..point(to))?, rate);
    Some(Ringing { after_entry: between(1.0, over - 1.0)?, after_exit: between(over + 0.5, measured.spacing - 0.5)? })
}

fn kind_by_ringing(measured: Option<Ringing>, expected: Option<[Ringing; 2]>) -> Kind {
    match (measured, expected) {
        (Some(m), Some([line, extended])) => match (m.agrees(&line), m.agrees(&extended)) {
            (true, false) => Kind::Line,
            (false, true) => Kind::Extended,
            _ => Kind::Undecided,
        },
        _ => Kind::Undecided,
    }
}

fn kind_by_likeness(waveform: &WaveformLength, spacing: f64, by_ringing: Kind) -> Kind {
    let [line, extended] = waveform.by_kind;
    let kind = if waveform.length > spacing { Kind::Extended } else { Kind::Line };
    let contradicted = by_ringing != Kind::Undecided && by_ringing != kind;
    if (line - extended).abs() < CLEARLY_LIKER || contradicted { Kind::Undecided } else { kind }
}

/// Mean and standard uncertainty of lengths [degrees] of one spall; or why there is none.
fn combine(lengths: &[&Length], of: usize) -> Result<(f64, f64), String> {
    if 2 * lengths.len() <= of {
        return Err(format!("{} of {of} recordings give a length", lengths.len()));
    }
    let weight = |l: &Length| 1.0 / (l.statistical * l.statistical + FLOOR * FLOOR);
    let total: f64 = lengths.iter().map(|l| weight(l)).sum();
    let mean = lengths.iter().map(|l| weight(l) * l.length).sum::<f64>() / total;
    let all: Vec<f64> = lengths.iter().map(|l| l.length).collect();
    let scatter = statistics::deviation(&all);
    if scatter > CONTRADICTION * mean {
        return Err(format!("the recordings contradict each other: {all:.2?} degrees are not one spall"));
    }
    let systematic = lengths.iter().map(|l| l.systematic).fold(0.0, f64::max);
    let statistical = (1.0 / total).sqrt().max(scatter / (all.len() as f64).sqrt());
    Ok((mean, statistical.hypot(systematic)))
}

fn common_kind(lengths: &[&Length]) -> Kind {
    let kind = lengths.first().map_or(Kind::Undecided, |l| l.kind);
    if lengths.iter().all(|l| l.kind == kind) { kind } else { Kind::Undecided }
}

/// What a resolved answer rests on, and its warnings.
fn basis(report: &Report, sized: &[Sized], scene: &Scene) -> String {
    let mut text = match report.method {
        Some(Method::Waveform) => "likeness of the averaged passage to the scene's rig".to_owned(),
        _ => "way from the entry's onset to the last blow".to_owned(),
    };
    if let Some(Ringing { after_entry, after_exit }) = sized.iter().find_map(|s| s.ringing) {
        text += &format!("; rings at {after_entry:.0} Hz after entry and {after_exit:.0} Hz after exit");
        if let Some([line, extended]) = sized.iter().find_map(|s| s.expected) {
            text += &format!(
                " (expected: line {:.0} and {:.0} Hz, extended {:.0} and {:.0} Hz)",
                line.after_entry, line.after_exit, extended.after_entry, extended.after_exit
            );
        }
    }
    if report.kind == Kind::Undecided {
        text += &format!(
            "; an extended spall, longer by one element spacing of {:.1} degrees, is not excluded",
            360.0 / scene.bearing.element_count as f64
        );
    }
    let load = scene.shaft.load[0].hypot(scene.shaft.load[1]);
    if let Some(critical) = report.critical_load_n.filter(|&critical| load >= critical) {
        text += &format!(
            "; WARNING: the load of {load:.0} N is above the critical load of {critical:.0} N (at the depth that fits best): elements inside the spall carry \
             load, and stiffness does not tell an extended from a line spall"
        );
    }
    let lost = sized.iter().filter(|s| s.length.is_err()).count();
    if lost > 0 {
        text += &format!("; {lost} of {} recordings unresolved", sized.len());
    }
    text
}
