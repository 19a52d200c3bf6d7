//! Line or extended, and from which load on they cannot be distinguished.
//!
//! An extended spall, longer than the element spacing, makes the events of a line spall that is shorter by the spacing.
//! What differs is stiffness: while one more element is out of the bearing, the rings ring lower ([`ringing`]), unless
//! the load is above the **critical load** of the extended spall, at which elements inside it carry again. That load
//! depends on the depth:
//!
//! - where the scene's own rig is similar to the recording, the depth that fits best says which side of it the
//!   recording is on;
//! - where it does not, the depth is unknown, and the answer names the **critical depth**: were the spall shallower,
//!   the load would be above its critical load, and an extended spall would ring like a line spall.

use super::measured::Measured;
use super::report::Kind;
use super::waveform::ringing::{self, Ringing};
use crate::sizing::passages::fold;
use crate::sizing::waveform::{CUT, POINTS, Rig, Trial, WaveformLength};
use crate::spectrum::{Band, Spectrum};
use crate::statics::NoCriticalLoad;
use brinell::scene::{ContactLaw, Motion, Scene};

/// Difference of similarity by which one kind of spall is preferred to the other.
const CLEARLY_LIKER: f64 = 0.02;
/// Depth at which ringing is expected (m): deep enough for free elements, which is what the two kinds differ in.
const FREE_DEPTH: f64 = 1e-3;
/// Depths between which the critical one is sought (m), and halvings of that range: to a thousandth of the depth.
const DEPTHS: (f64, f64) = (1e-7, FREE_DEPTH);
const HALVINGS: usize = 14;

/// Where elements cross the spall in an averaged passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// Where an entry begins (share of a period).
    pub(crate) entry: f64,
    /// How far from it the next exit is (degrees).
    pub(crate) travel_deg: f64,
}

/// The kind of spall that a recording shows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Classification {
    pub(crate) kind: Kind,
    /// Measured, where an entry is known and there is time to ring.
    pub(crate) ringing: Option<Ringing>,
    /// Of a line spall, and of an extended one, of the scene's rig.
    pub(crate) expected: Option<[Ringing; 2]>,
    /// Of the spall that fits best (N), or why it has none; with its depth (m).
    pub(crate) critical_load: Option<Result<f64, NoCriticalLoad>>,
    depth: Option<f64>,
    /// Depth at which the load is the critical load of the extended spall with these events (m); where the depth is
    /// unknown.
    pub(super) critical_depth: Option<f64>,
    spacing: f64,
}

impl Classification {
    /// `crossing` where it is known.
    pub(crate) fn of(
        measured: &Measured,
        scene: &Scene,
        rig: Option<&Rig<'_>>,
        waveform: Option<&WaveformLength>,
        crossing: Option<Crossing>,
    ) -> Self {
        let spacing = measured.spacing;
        let trial = |length: f64, depth: f64| Trial { length, depth, law: ContactLaw::Hertz };
        let ringing = crossing.and_then(|at| measured_ringing(measured, at.entry, at.travel_deg));
        let expected = rig.zip(crossing).and_then(|(rig, Crossing { travel_deg, .. })| {
            let of = |length: f64| ringing::expected(rig, trial(length, FREE_DEPTH), spacing).ok();
            Some([of(travel_deg)?, of(travel_deg + spacing)?])
        });
        let by_ringing = by_ringing(ringing, expected);
        let critical_load = waveform.and_then(|w| ringing::critical_load(scene, trial(w.length, w.depth)).ok());
        // Above the critical load ringing shows nothing.
        let is_above = matches!(critical_load, Some(Ok(critical)) if load(scene) >= critical);
        let by_ringing_below = if is_above { Kind::Undecided } else { by_ringing };
        let kind = waveform.map_or(by_ringing, |w| by_similarity(w, spacing, by_ringing_below));
        // With two elements in the spall, or ringing as on fewer elements, it is no question.
        let critical_depth = crossing
            .filter(|_| waveform.is_none() && kind != Kind::Extended)
            .and_then(|at| critical_depth(scene, at.travel_deg + spacing));
        Self { kind, ringing, expected, critical_load, depth: waveform.map(|w| w.depth), critical_depth, spacing }
    }

    /// In words, with warnings.
    pub(crate) fn described(&self, scene: &Scene) -> String {
        let mut text = String::new();
        if let Some(Ringing { after_entry, after_exit }) = self.ringing {
            text += &format!("; rings at {after_entry:.0} Hz after entry and {after_exit:.0} Hz after exit");
            if let Some([line, extended]) = self.expected {
                text += &format!(
                    " (expected with free elements: line {:.0} and {:.0} Hz, extended {:.0} and {:.0} Hz)",
                    line.after_entry, line.after_exit, extended.after_entry, extended.after_exit
                );
            }
        }
        if self.kind == Kind::Undecided {
            let spacing = self.spacing;
            text +=
                &format!("; an extended spall, longer by one element spacing of {spacing:.1} degrees, is not excluded");
        }
        let load = load(scene);
        if let (Some(Ok(critical)), Some(depth)) = (&self.critical_load, self.depth)
            && load >= *critical
        {
            text += &format!(
                "; WARNING: the load of {load:.0} N is above the critical load of {critical:.0} N (at the depth that \
                 fits best, {:.0} um): elements inside the spall carry load, and stiffness does not distinguish an \
                 extended from a line spall",
                1e6 * depth
            );
        }
        if let Some(depth) = self.critical_depth {
            text += &format!(
                "; WARNING: were the spall shallower than {:.1} um, the load of {load:.0} N would be above the \
                 critical load of an extended one, whose inner elements then carry: it would ring like a line spall",
                1e6 * depth
            );
        }
        text
    }
}

fn load(scene: &Scene) -> f64 {
    scene.shaft.load[0].hypot(scene.shaft.load[1])
}

/// Depth (m) of a spall of `length` degrees at which the scene's load is its critical load.
fn critical_depth(scene: &Scene, length: f64) -> Option<f64> {
    let load = load(scene);
    if scene.shaft.motion != Motion::Internal || load == 0.0 {
        return None;
    }
    let (mut low, mut high) = DEPTHS;
    for _ in 0..HALVINGS {
        let depth = (low * high).sqrt();
        let critical = ringing::critical_load(scene, Trial { length, depth, law: ContactLaw::Hertz }).ok()?;
        if critical.is_ok_and(|critical| critical <= load) { low = depth } else { high = depth }
    }
    (high < DEPTHS.1).then_some(high)
}

/// Ringing between the events. A degree after the entry and half a degree after the exit are left to the events.
fn measured_ringing(measured: &Measured, entry: f64, over: f64) -> Option<Ringing> {
    let row = fold::average(&measured.signal_rows(entry, POINTS));
    let rate = measured.pass_frequency * POINTS as f64;
    let smooth = Spectrum::of(&row, rate).filtered(Band { low: 0.0, high: CUT });
    let point = |degrees: f64| (degrees / measured.spacing * POINTS as f64) as usize;
    let between = |from: f64, to: f64| ringing::strongest(smooth.get(point(from)..point(to))?, rate);
    Some(Ringing { after_entry: between(1.0, over - 1.0)?, after_exit: between(over + 0.5, measured.spacing - 0.5)? })
}

fn by_ringing(measured: Option<Ringing>, expected: Option<[Ringing; 2]>) -> Kind {
    match (measured, expected) {
        (Some(m), Some([line, extended])) => match (m.agrees(&line), m.agrees(&extended)) {
            (true, false) => Kind::Line,
            (false, true) => Kind::Extended,
            _ => Kind::Undecided,
        },
        _ => Kind::Undecided,
    }
}

fn by_similarity(waveform: &WaveformLength, spacing: f64, by_ringing: Kind) -> Kind {
    let [line, extended] = waveform.by_kind;
    let kind = if waveform.length > spacing { Kind::Extended } else { Kind::Line };
    let contradicted = by_ringing != Kind::Undecided && by_ringing != kind;
    if (line - extended).abs() < CLEARLY_LIKER || contradicted { Kind::Undecided } else { kind }
}
