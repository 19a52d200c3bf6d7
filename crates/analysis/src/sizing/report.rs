//! What sizing reports: the answer first, then what it rests on.

use crate::spectra::{Combs, Fault, Grade};
use serde::Serialize;

/// Whether there is a length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// There is.
    Resolved,
    /// There is none, and `reason` says why.
    #[default]
    Unresolved,
}

/// How far a length can be relied upon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Standing {
    /// Lengths at two speeds agree in degrees.
    Firm,
    /// One speed, or speeds too close to each other: an event at a fixed time looks like one at a fixed angle.
    Provisional,
}

/// What kind of spall it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Shorter than the element spacing.
    Line,
    /// Longer than the element spacing.
    Extended,
    /// Either: an extended spall sounds like a line spall one spacing shorter, unless the rig's stiffness
    /// differs.
    #[default]
    Undecided,
}

/// How the length was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// From the entry's onset to the last impact.
    Events,
    /// By similarity to the scene's own rig.
    Waveform,
}

/// The answer for all recordings together.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Report {
    /// Whether there is a length.
    pub verdict: Verdict,
    /// How far the length can be relied upon, where there is one.
    pub standing: Option<Standing>,
    /// Part of the bearing that the recordings look damaged in.
    pub fault: Fault,
    /// How plainly they show it.
    pub grade: Grade,
    /// Arc on the raceway of that fault (mm).
    pub length_mm: Option<f64>,
    /// The same (degrees).
    pub length_deg: Option<f64>,
    /// Length that the spall has at least (degrees), where there is no length: see the recordings.
    pub at_least_deg: Option<f64>,
    /// Half-width of the interval that holds the length with 95 % confidence (mm).
    pub uncertainty_mm: Option<f64>,
    /// Kind of spall.
    pub kind: Kind,
    /// Ball pass frequency of the outer ring in the first recording (Hz).
    pub bpfo_hz: f64,
    /// Lag of the cage behind pure rolling at the stated speed, mean over the recordings.
    pub slip: f64,
    /// Passages used, of all recordings.
    pub passages: usize,
    /// What the answer rests on, and its warnings; or why there is none.
    pub reason: String,
    /// What was taken for granted because nobody gave it.
    pub assumed: Vec<String>,
    /// Which recording would settle what is open.
    pub next: String,
    /// How the length was found.
    pub method: Option<Method>,
    /// Smallest load at which elements inside the spall carry load again (N), where the scene's rig could be used.
    pub critical_load_n: Option<f64>,
    /// Why there is none, where the scene's rig could be used.
    pub critical_load_reason: Option<String>,
    /// Depth of an extended spall with these events below which the load is above its critical load (µm), where the
    /// depth is unknown.
    pub critical_depth_um: Option<f64>,
    /// Each recording by itself.
    pub recordings: Vec<RecordingReport>,
    /// What a figure shows, one for each recording.
    #[serde(skip)]
    pub figures: Vec<Figure>,
}

/// The answer of one recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecordingReport {
    /// Name of the recording.
    pub name: String,
    /// Whether it gives a length.
    pub verdict: Verdict,
    /// What its combs look like.
    pub fault: Fault,
    /// How plainly they show it.
    pub grade: Grade,
    /// What speaks for the kind that leads, in words.
    pub speaks_for: Vec<String>,
    /// What speaks against it, or for another speed.
    pub speaks_against: Vec<String>,
    /// The combs, beside each other.
    pub combs: Combs,
    /// Length [degrees of the raceway of that fault].
    pub length_deg: Option<f64>,
    /// Half-width of its 95 % interval (degrees).
    pub uncertainty_deg: Option<f64>,
    /// How it was found.
    pub method: Option<Method>,
    /// Ball pass frequency of the outer ring (Hz).
    pub bpfo_hz: f64,
    /// Passages used; on the inner raceway those in the load zone.
    pub passages: usize,
    /// Strength of strong passages over that of weak ones, 90 against 10 % quantile of the root mean square above 5
    /// kHz: an inner raceway's load zone.
    pub modulation: f64,
    /// Onset of the entry (degrees), where there is one; as all angles from the leading edge: 0 by events, which take
    /// the onset for the edge.
    pub onset_deg: Option<f64>,
    /// Impacts, likewise.
    pub impacts_deg: Vec<f64>,
    /// Both edges, likewise: 0 and the length.
    pub edges_deg: Option<[f64; 2]>,
    /// Similarity to the scene's rig, 0 to 1, where the scene describes one: with the best spall, or without a spall
    /// where that is as good. A length rests on it from 0.9 on.
    pub similarity: Option<f64>,
    /// Length that the spall has at least (degrees): from first to last impact, where its entry is not seen.
    pub at_least_deg: Option<f64>,
    /// The stretch that was used (s), where passages after it or before it are shifted against it.
    pub used_s: Option<[f64; 2]>,
    /// Frequencies of ringing after entry and after exit (Hz), where they could be measured.
    pub ringing_hz: Option<[f64; 2]>,
    /// Those expected of a line spall, and of an extended one, of the scene's rig (Hz).
    pub expected_ringing_hz: Option<[[f64; 2]; 2]>,
    /// Why there is no length.
    pub reason: Option<String>,
}

/// The averaged passage of one recording, for a figure. Angles in degrees of element travel from the leading edge;
/// where none is found from the first impact, or from the start of a passage's period.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name of the recording.
    pub name: String,
    /// Angle (degrees).
    pub angle: Vec<f64>,
    /// Averaged signal, in the recording's unit.
    pub signal: Vec<f64>,
    /// Averaged level of the high-frequency envelope (dB).
    pub level: Vec<f64>,
    /// The signal below the band of impacts, in which entries show and similarity is measured.
    pub low: Vec<f64>,
    /// The most alike simulated passage, scaled to `low`, where similarity gave the length.
    pub model: Option<Vec<f64>>,
    /// Rigid path of an element's centre over a spall of the answer's length (m), down to the floor of the most alike
    /// spall or until it is free of its load; none where neither is known.
    pub path: Option<Vec<f64>>,
}
