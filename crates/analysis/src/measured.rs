//! A recording prepared for sizing: its ball pass frequency, and its passages laid over each other.

use super::continuity::{self, Break};
use super::envelope::{self, Comb};
use super::error::SizingError;
use super::linear_prediction;
use super::passages::{self, Passages};
use super::recording::Recording;
use super::spectrum::{Band, Spectrum};
use brinell::geometry::kinematics;
use brinell::scene::Bearing;

/// Fewest passages that can be averaged and judged.
const FEWEST_PASSAGES: usize = 8;
/// Fewest samples per passage: with 64, at 40° spacing, one sample is 0.6° and a spall of a few degrees a handful.
const FEWEST_SAMPLES: usize = 64;
/// Span of the samples from which the structure's ringing is predicted [s], and fewest samples: a period of modes above
/// 2.5 kHz, and short against the way between impacts (0.7 ms over 5 degrees at 40 Hz).
const PREDICTED: f64 = 4e-4;
const FEWEST_PREDICTING: usize = 8;

/// A recording whose elements' passages are found. Passages are rows; a row spans one element spacing.
pub struct Measured {
    /// Name of the recording.
    pub name: String,
    /// The comb in the envelope's spectrum.
    pub comb: Comb,
    /// A comb elsewhere, where there is none near the ball pass frequency.
    pub elsewhere: Option<Comb>,
    /// Mean ball pass frequency [Hz].
    pub bpfo: f64,
    /// Lag of the cage behind pure rolling.
    pub slip: f64,
    /// Element spacing [degrees].
    pub spacing: f64,
    /// The passages.
    pub passages: Passages,
    /// Sampling rate [Hz].
    pub rate: f64,
    /// Where passages are shifted against those before, as behind a missing piece.
    pub(super) broken: Option<Break>,
    /// How many times the same passes within a ball pass period, if it is more than once.
    pub(super) times_a_period: Option<usize>,
    signal: Vec<f64>,
    /// High-frequency envelope of what the structure's ringing does not explain.
    envelope: Vec<f64>,
}

impl Measured {
    /// Prepares it.
    ///
    /// # Errors
    /// A recording too short, or too coarse for the ball pass frequency that its speed and the bearing imply.
    pub fn new(recording: &Recording, bearing: &Bearing) -> Result<Self, SizingError> {
        let nominal = kinematics::frequencies(bearing, 0.0, recording.speed()).bpfo;
        let (rate, name) = (recording.rate(), recording.name().to_owned());
        if rate / nominal < FEWEST_SAMPLES as f64 {
            let (samples, limit, speed) = (rate / nominal, FEWEST_SAMPLES, recording.speed());
            return Err(SizingError::TooCoarse { name, samples, rate, bpfo: nominal, speed, limit });
        }
        let count = recording.duration() * nominal;
        if count < FEWEST_PASSAGES as f64 {
            let (duration, limit) = (recording.duration(), FEWEST_PASSAGES);
            return Err(SizingError::TooShort { name, duration, passages: count, bpfo: nominal, limit });
        }
        let mut spectrum = Spectrum::of(recording.samples(), rate);
        let comb = envelope::find_comb(&mut spectrum, rate, nominal, recording.speed());
        let elsewhere = (!comb.is_significant())
            .then(|| envelope::find_elsewhere(&mut spectrum, rate, nominal, recording.speed(), comb.band))
            .filter(Comb::is_significant);
        let passages =
            Passages::find(recording.samples(), &spectrum.squared_envelope(comb.band), rate / comb.frequency);
        let order = ((PREDICTED * rate) as usize).max(FEWEST_PREDICTING);
        let impacts = linear_prediction::residual(recording.samples(), order);
        let mut spectrum = Spectrum::of(&impacts, rate);
        let mut high = spectrum.squared_envelope(Band { low: impact_band(rate), high: 0.45 * rate });
        let passages = passages.refined(recording.samples(), &high);
        high.iter_mut().for_each(|x| *x = x.max(0.0).sqrt());
        let bpfo = rate / passages.period;
        let rows = passages::cut(&high, &passages.starts, passages.period, passages::GRID);
        Ok(Self {
            name,
            bpfo,
            broken: continuity::find_break(&rows),
            times_a_period: continuity::times_a_period(&rows),
            slip: 1.0 - bpfo / nominal,
            spacing: 360.0 / bearing.element_count as f64,
            signal: recording.samples().to_vec(),
            comb,
            elsewhere,
            passages,
            rate,
            envelope: high,
        })
    }

    /// Element travel per second [degrees].
    pub fn travel(&self) -> f64 {
        self.spacing * self.bpfo
    }

    /// Points of a row that keep every sample.
    pub fn points(&self) -> usize {
        (self.passages.period.round() as usize).max(FEWEST_SAMPLES)
    }

    /// Rows of the signal that begin `share` of a period after the passages' starts.
    pub fn signal_rows(&self, share: f64, points: usize) -> Vec<Vec<f64>> {
        passages::cut(&self.signal, &self.passages.later(share).starts, self.passages.period, points)
    }

    /// Rows of the high-frequency envelope, likewise.
    pub fn envelope_rows(&self, share: f64, points: usize) -> Vec<Vec<f64>> {
        passages::cut(&self.envelope, &self.passages.later(share).starts, self.passages.period, points)
    }
}

/// Lower edge of the band of impacts [Hz]: far above the rings' modes (below 2 kHz), low enough for accelerometers.
fn impact_band(rate: f64) -> f64 {
    (0.2 * rate).min(5000.0)
}
