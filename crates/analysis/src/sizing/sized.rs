//! The length of the spall in one recording, and all that a report says of it.

use super::event_length;
use super::event_length::{AveragedPassage, EventLength};
use super::kind::{Classification, Crossing};
use super::measured::Measured;
use super::raceway::{self, Raceway};
use super::report::{Figure, Kind, Method, RecordingReport, Verdict};
use super::unresolved::Unresolved;
use super::waveform::Ringing;
use crate::sizing::waveform::{CUT, Maps, Mismatch, Rig, WaveformLength, waveform_length};
use crate::spectra::Fault;
use crate::spectrum::{Band, Spectrum};
use crate::statistics::rms;
use brinell::scene::Scene;

/// Coverage factor of the stated interval: 95 % of a normal distribution.
pub(super) const COVERAGE: f64 = 2.0;
/// Share of the variance at BPFO from which similarity is asked: less than the events need, for similarity is a proof
/// of its own.
const ENOUGH_FOR_SIMILARITY: f64 = 0.02;
/// Harmonics of the passage frequency below the cut from which passages have a shape that can be compared: of one or
/// two harmonics any passage is like any other.
const HARMONICS: f64 = 5.0;
/// Statistical uncertainty that is always granted (degrees): events are sought on a grid of samples.
pub(super) const FLOOR: f64 = 0.02;

/// A recording with its results.
pub(super) struct Sized {
    pub(super) measured: Measured,
    passage: AveragedPassage,
    pub(super) length: Result<Length, Unresolved>,
    pub(super) events: Option<EventLength>,
    waveform: Option<WaveformLength>,
    /// To the scene's rig, whether that was taken for the recording's or not.
    similarity: Option<f64>,
    pub(super) classification: Classification,
}

/// Length of one recording (degrees).
#[derive(Debug, Clone)]
pub(super) struct Length {
    pub(super) length: f64,
    pub(super) statistical: f64,
    pub(super) systematic: f64,
    pub(super) method: Method,
    pub(super) kind: Kind,
}

impl Sized {
    pub(super) fn of(mut measured: Measured, scene: &Scene, maps: Maps<'_>) -> Self {
        let rig = Rig::new(scene, measured.bpfo, maps);
        let passage = AveragedPassage::of(&measured);
        let whole = measured.broken.is_none() && measured.times_a_period.is_none();
        let combs = &measured.combs;
        let outer = match measured.fault {
            Fault::Outer => true,
            Fault::None => combs.outer.share >= combs.inner.share.max(combs.element.share).max(ENOUGH_FOR_SIMILARITY),
            _ => false,
        };
        let shaped = CUT >= HARMONICS * measured.bpfo;
        let trials = rig.as_ref().filter(|_| outer && whole && shaped);
        let trials = trials.map(|rig| waveform_length::estimate(&measured, scene, rig));
        let similarity = trials.as_ref().map(|trials| match trials {
            Ok(waveform) => waveform.similarity,
            Err(Mismatch::OtherRig(similarity) | Mismatch::Healthy { similarity, .. }) => *similarity,
        });
        let events = match trials {
            Some(Err(Mismatch::Healthy { similarity, surely })) => {
                if surely {
                    measured.fault = Fault::None;
                }
                Err(Unresolved::Healthy(similarity))
            }
            _ => event_length::estimate(&measured, &passage, scene),
        };
        let waveform = trials.and_then(Result::ok).filter(|_| measured.reversed.is_none());
        let spacing = measured.spacing;
        let crossing = match (&waveform, &events) {
            (Some(w), _) => Some(Crossing { entry: w.entry, travel_deg: w.length.rem_euclid(spacing) }),
            (None, Ok(e)) => Some(Crossing { entry: (e.first + e.onset) / spacing, travel_deg: e.length }),
            _ => None,
        };
        // Stiffness over the cage's angle tells kinds of spalls outside.
        let crossing = crossing.filter(|_| measured.raceway == Raceway::Outer);
        let classification = Classification::of(&measured, scene, rig.as_ref(), waveform.as_ref(), crossing);
        let length = match (&waveform, &events) {
            (Some(w), _) => of_waveform(w, scene, classification.kind),
            (None, Ok(e)) => {
                let extended = if classification.kind == Kind::Extended { spacing } else { 0.0 };
                Ok(Length {
                    length: e.length + extended,
                    statistical: e.statistical,
                    systematic: e.systematic,
                    method: Method::Events,
                    kind: classification.kind,
                })
            }
            (None, Err(why)) => Err(why.clone()),
        };
        Self { measured, passage, length, events: events.ok(), waveform, similarity, classification }
    }

    pub(super) fn report(&self) -> RecordingReport {
        // What one recording tells of the inner raceway by itself.
        let alone = self.inside_alone();
        let length = self.length.as_ref().ok().filter(|_| alone.is_none());
        let [mut speaks_for, mut speaks_against] = self.measured.combs.evidence();
        match &self.measured.speed_check {
            Ok(confirmed) => speaks_for.extend(confirmed.clone()),
            Err(other) => speaks_against.push(other.clone()),
        }
        RecordingReport {
            name: self.measured.name.clone(),
            verdict: if length.is_some() { Verdict::Resolved } else { Verdict::Unresolved },
            fault: self.measured.fault,
            grade: self.measured.grade,
            speaks_for,
            speaks_against,
            combs: self.measured.combs,
            length_deg: length.map(|l| l.length),
            uncertainty_deg: length.map(|l| COVERAGE * l.statistical.hypot(l.systematic).hypot(FLOOR)),
            method: length.map(|l| l.method),
            bpfo_hz: self.measured.bpfo,
            modulation: self.measured.modulation,
            onset_deg: self.events.as_ref().map(|e| self.first_impact(e) + e.onset),
            impacts_deg: self.events.as_ref().map_or_else(Vec::new, |e| self.impacts(e)),
            edges_deg: length.map(|found| [0.0, found.length]),
            passages: self.measured.passages.starts.len(),
            similarity: self.similarity,
            at_least_deg: self.at_least(),
            used_s: self.measured.cut.map(|cut| cut.used),
            ringing_hz: self.classification.ringing.map(Ringing::pair),
            expected_ringing_hz: self.classification.expected.map(|e| e.map(Ringing::pair)),
            reason: alone.as_ref().or(self.length.as_ref().err()).map(ToString::to_string),
        }
    }

    /// Why the length by events on the inner raceway is none of a single recording.
    pub(super) fn inside_alone(&self) -> Option<Unresolved> {
        let is_inside = self.measured.raceway == Raceway::Inner && self.length.is_ok();
        is_inside.then(|| Unresolved::InsideAlone(self.span().unwrap_or(0.0)))
    }

    /// From first to last impact (degrees), where that is all that is known of the length: no entry is seen, or where
    /// it is depends on the passages that are averaged.
    pub(super) fn at_least(&self) -> Option<f64> {
        match &self.length {
            Err(Unresolved::NoEntry(span, ..)) => Some(*span),
            Err(Unresolved::Halves(..) | Unresolved::TooUncertain(..)) => self.span(),
            Ok(_) if self.measured.raceway == Raceway::Inner => self.span(),
            _ => None,
        }
    }

    fn span(&self) -> Option<f64> {
        self.passage.impacts().last().copied().filter(|&span| span > 0.0)
    }

    /// The leading edge after the start of a passage's period (degrees): where all angles of a report count from.
    fn leading_edge(&self) -> Option<f64> {
        let of_waveform = self.waveform.as_ref().map(|w| w.entry * self.measured.spacing);
        of_waveform.or_else(|| self.events.as_ref().map(|e| e.first + e.onset))
    }

    /// The first impact after the leading edge (degrees), by similarity within the period that a figure shows.
    fn first_impact(&self, events: &EventLength) -> f64 {
        match &self.waveform {
            Some(w) => event_length::shown(events.first - w.entry * self.measured.spacing, self.measured.spacing),
            None => -events.onset,
        }
    }

    fn impacts(&self, events: &EventLength) -> Vec<f64> {
        events.impacts.iter().map(|impact| self.first_impact(events) + impact).collect()
    }

    /// How deep an element sinks while it rolls (m): to the floor of the most alike spall, or until it is free of its
    /// load; `None` where neither is known.
    fn deepest(&self, scene: &Scene) -> Option<f64> {
        let free = raceway::approach(scene).map(|approach| approach + scene.bearing.radial_clearance.max(0.0));
        let floor = self.waveform.as_ref().map(|w| w.depth);
        floor.into_iter().chain(free).reduce(f64::min)
    }

    pub(super) fn figure(&self, scene: &Scene) -> Figure {
        let measured = &self.measured;
        // Without a leading edge a passage is best seen from its first impact.
        let from = self.leading_edge().or_else(|| self.passage.first_impact()).unwrap_or(0.0);
        let [angle, signal, level] = self.passage.curves(measured, from);
        let rate = measured.pass_frequency * signal.len() as f64;
        let low = Spectrum::of(&signal, rate).filtered(Band { low: 0.5 * measured.pass_frequency, high: CUT });
        let model = self.waveform.as_ref().map(|w| {
            let scale = rms(&low) / rms(&w.model);
            let share = |degrees: f64| ((degrees + from) / measured.spacing).rem_euclid(1.0);
            let point = |degrees: f64| (share(degrees) * w.model.len() as f64) as usize % w.model.len();
            angle.iter().map(|&degrees| scale * w.model[point(degrees)]).collect()
        });
        let path = self.length.as_ref().ok().zip(self.deepest(scene)).map(|(found, deepest)| {
            let sunk = |degrees: f64| {
                let past = degrees.min(found.length - degrees).max(0.0);
                measured.raceway.depth_at(&scene.bearing, past).min(deepest)
            };
            angle.iter().map(|&degrees| sunk(degrees)).collect()
        });
        Figure { name: measured.name.clone(), angle, signal, level, low, model, path }
    }
}

/// The length by similarity, unless it is shorter than what can be resolved: a guessed load, clearance or edge would
/// make as much of it.
fn of_waveform(waveform: &WaveformLength, scene: &Scene, kind: Kind) -> Result<Length, Unresolved> {
    let WaveformLength { length, statistical, systematic, .. } = *waveform;
    let uncertainty = statistical.hypot(systematic).hypot(FLOOR);
    let limit = raceway::shortest_length(scene, Raceway::Outer);
    if limit.is_some_and(|limit| length - COVERAGE * uncertainty < limit) {
        return Err(Unresolved::TooShort(length, uncertainty, limit.unwrap_or_default()));
    }
    // Wider than the length itself: short spalls differ in loudness only.
    if 2.0 * COVERAGE * uncertainty > length {
        return Err(Unresolved::TooUncertain(length, COVERAGE * uncertainty));
    }
    Ok(Length { length, statistical, systematic, method: Method::Waveform, kind })
}
