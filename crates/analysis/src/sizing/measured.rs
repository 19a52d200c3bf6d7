//! A recording prepared for sizing: what passes in it and how often, and its passages laid over each other.

use super::raceway::Raceway;
use crate::recording::{Recording, SizingError};
use crate::sizing::passages::{Break, LoadZone, Passages, continuity, fold, linear_prediction};
use crate::spectra::shaft_lines::ShaftLines;
use crate::spectra::{Combs, Fault, Grade, other_speed};
use crate::spectrum::{Band, Spectrum};
use crate::statistics;
use brinell::geometry::kinematics;
use brinell::scene::Bearing;

/// Fewest passages that can be averaged and judged.
const FEWEST_PASSAGES: usize = 8;
/// Fewest samples per passage: with 64, at 40° spacing, one sample is 0.6° and a spall of a few degrees a handful.
const FEWEST_SAMPLES: usize = 64;
/// Span of the samples from which the structure's ringing is predicted (s), and fewest samples: a period of modes above
/// 2.5 kHz, and short against the time between impacts (0.7 ms over 5 degrees at 40 Hz).
const PREDICTED: f64 = 4e-4;
const FEWEST_PREDICTING: usize = 8;
/// Ratio of kurtosis backwards in time to that forwards from which a recording is reversed: noise alone has 1.00 ±
/// 0.02.
const REVERSED: f64 = 1.05;

/// Sampling rate (Hz) that events need: echoes fade faster the higher the band, and 5 to 11 kHz is just enough. Below,
/// an echo is taken for the last impact, whatever the length that comes out.
pub(super) const ENOUGH_RATE: f64 = 24_000.0;
/// Share of the variance from which something repeats elsewhere so plainly that "no fault" may be of a wrong speed.
const LOUD_ELSEWHERE: f64 = 0.1;
/// Parts into which a recording is cut at most: an eighth and more is lost with each.
const MOST_CUTS: usize = 3;

/// A recording whose elements' passages are known. Passages are rows; a row spans one element spacing.
pub struct Measured {
    /// Name of the recording.
    pub name: String,
    /// Shaft speed (Hz).
    pub speed: f64,
    /// The combs of the three kinds of fault.
    pub combs: Combs,
    /// The kind of fault that they look like; undecided where another speed would suit them as well.
    pub fault: Fault,
    /// The raceway over which passages are taken to be: the outer one unless the fault is the inner's.
    pub raceway: Raceway,
    /// How plainly they show it.
    pub grade: Grade,
    /// What confirms the stated speed, in words, or as an error what speaks for another one.
    pub(super) speed_check: Result<Option<String>, String>,
    /// Sharpness of the impacts forwards and backwards in time, where they are sharper backwards.
    /// A bearing without a spall may be sharper so, too: it is recognised first.
    pub(super) reversed: Option<[f64; 2]>,
    /// A strong comb elsewhere (Hz, share of the variance), where there is none near the bearing's frequencies.
    pub(super) elsewhere: Option<[f64; 2]>,
    /// How often an element passes the defect, in the mean (Hz).
    pub pass_frequency: f64,
    /// Mean ball pass frequency of the outer ring (Hz).
    pub bpfo: f64,
    /// Lag of the cage behind pure rolling.
    pub slip: f64,
    /// Element spacing (degrees).
    pub spacing: f64,
    /// The passages, on the inner raceway those in the load zone.
    pub passages: Passages,
    /// Strong passages over weak ones: quantiles at 90 and 10 % of the root mean square above 5 kHz.
    pub modulation: f64,
    /// Sampling rate (Hz).
    pub rate: f64,
    /// Where passages are shifted against those before, as behind a missing piece.
    pub(crate) broken: Option<Break>,
    /// What was cut off because of such a shift.
    pub(super) cut: Option<Cut>,
    /// How many times the same passes within a period, if it is more than once.
    pub(super) times_a_period: Option<usize>,
    signal: Vec<f64>,
    /// High-frequency envelope of what the structure's ringing does not explain.
    envelope: Vec<f64>,
}

/// The stretch that is used of a recording whose passages are shifted against each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cut {
    /// The stretch (s).
    pub(super) used: [f64; 2],
    /// About the end of what comes before the first shift (s), and the shift (degrees).
    pub(super) at: f64,
    pub(super) shift: f64,
}

impl Measured {
    /// Prepares it. Where passages are shifted against those before (the cage skidded, or a piece is missing), the
    /// longer part is used if nothing is shifted in that, and if not, the longer part of that.
    ///
    /// # Errors
    /// A recording too short, or too coarse for the ball pass frequency that its speed and the bearing imply.
    pub fn new(recording: &Recording, bearing: &Bearing) -> Result<Self, SizingError> {
        let whole = Self::uncut(recording, bearing)?;
        let Some((at, shift)) = whole.broken.map(|b| (whole.time_of(b.passage), b.shift * whole.spacing)) else {
            return Ok(whole);
        };
        let (rate, samples) = (recording.rate(), recording.samples());
        let mut used = [0, samples.len()];
        let mut broken = whole.broken.map(|found| whole.longer_part(found));
        for _ in 0..MOST_CUTS {
            let Some([from, to]) = broken else { break };
            used = [used[0] + from, (used[0] + to).min(used[1])];
            // What is left may be too short.
            let piece = samples.get(used[0]..used[1]).map(<[f64]>::to_vec).unwrap_or_default();
            let Ok(piece) = Recording::new(recording.name(), piece, rate, recording.speed()) else { break };
            let Ok(part) = Self::uncut(&piece, bearing) else { break };
            broken = part.broken.map(|found| part.longer_part(found));
            if broken.is_none() && part.fault == whole.fault {
                let used = used.map(|sample| sample as f64 / rate);
                return Ok(Self { cut: Some(Cut { used, at, shift }), ..part });
            }
        }
        Ok(whole)
    }

    /// Begin of a passage (s).
    fn time_of(&self, passage: usize) -> f64 {
        self.passages.starts.get(passage).map_or(0.0, |start| start / self.rate)
    }

    /// The longer part before or after a break, without what may lie on both sides of it (samples).
    fn longer_part(&self, found: Break) -> [usize; 2] {
        let starts = &self.passages.starts;
        let start = |passage: usize| starts.get(passage).copied().unwrap_or(self.signal.len() as f64) as usize;
        let parts = [
            [0, start(found.passage.saturating_sub(found.within))],
            [start(found.passage + found.within), self.signal.len()],
        ];
        if parts[0][1] > parts[1][1] - parts[1][0] { parts[0] } else { parts[1] }
    }

    fn uncut(recording: &Recording, bearing: &Bearing) -> Result<Self, SizingError> {
        let frequencies = kinematics::frequencies(bearing, 0.0, recording.speed());
        let nominal = frequencies.bpfo;
        check_size(recording, nominal)?;
        let (rate, name) = (recording.rate(), recording.name().to_owned());
        let mut spectrum = Spectrum::of(recording.samples(), rate);
        let shaft = ShaftLines::of(recording.samples(), rate);
        let turning = shaft.speed_near(recording.speed());
        let combs = Combs::find(&mut spectrum, rate, frequencies, recording.speed(), turning);
        let speed_check = other_speed::check((&shaft, &mut spectrum), rate, &combs, frequencies, recording.speed());
        let other = &combs.elsewhere;
        let elsewhere = combs.fault() == Fault::None && other.share >= LOUD_ELSEWHERE.max(other.limit());
        let elsewhere = elsewhere.then_some([other.frequency, other.share]);
        let is_doubtful = speed_check.is_err() || elsewhere.is_some();
        let fault = if is_doubtful { Fault::Undecided } else { combs.fault() };
        let grade = if is_doubtful { Grade::Possible } else { combs.grade() };
        let raceway = Raceway::of(fault);
        let comb = if raceway == Raceway::Inner { &combs.inner } else { &combs.outer };
        let band = Band { low: impact_band(rate), high: 0.45 * rate };
        let loud = spectrum.squared_envelope(band);
        let order = ((PREDICTED * rate) as usize).max(FEWEST_PREDICTING);
        let impacts = linear_prediction::residual(recording.samples(), order);
        let mut impacts = Spectrum::of(&impacts, rate);
        let reversed = reversed(recording.samples(), &mut impacts, order, rate, band);
        let mut high = impacts.squared_envelope(band);
        let most = if rate < ENOUGH_RATE { fold::MOST_WITHOUT_EVENTS } else { fold::MOST };
        let even = Passages::even(recording.samples().len(), rate / comb.frequency, most);
        let inside = raceway == Raceway::Inner;
        let zone = |envelope: &[f64]| LoadZone::of(&fold::cut(envelope, &even.starts, even.period, fold::GRID));
        let (zone, modulation) = (zone(&high), zone(&loud).modulation);
        let even = if inside { even.chosen(&zone.inside) } else { even };
        let band = spectrum.squared_envelope(comb.band);
        let by_band = even.clone().found(recording.samples(), &band, inside).refined(recording.samples(), &high);
        let passages = if inside {
            // Echoes are loud in the one, first impacts weak in the other.
            let by_impacts = even.found(recording.samples(), &high, inside).refined(recording.samples(), &high);
            if by_impacts.contrast(&high) > by_band.contrast(&high) { by_impacts } else { by_band }
        } else {
            by_band
        };
        high.iter_mut().for_each(|x| *x = x.max(0.0).sqrt());
        let pass_frequency = rate / passages.period;
        let turning = bearing.element_count as f64 * recording.speed();
        let bpfo = if inside { turning - pass_frequency } else { pass_frequency };
        let rows = fold::cut(&high, &passages.starts, passages.period, fold::GRID);
        Ok(Self {
            name,
            speed: recording.speed(),
            pass_frequency,
            bpfo,
            broken: continuity::find_break(&rows),
            cut: None,
            times_a_period: continuity::times_a_period(&rows),
            slip: 1.0 - bpfo / nominal,
            spacing: 360.0 / bearing.element_count as f64,
            signal: recording.samples().to_vec(),
            combs,
            fault,
            grade,
            raceway,
            speed_check,
            reversed,
            elsewhere,
            passages,
            modulation,
            rate,
            envelope: high,
        })
    }

    /// Of what is used of the recording (s).
    pub(super) fn duration(&self) -> f64 {
        self.signal.len() as f64 / self.rate
    }

    /// Element travel per second (degrees).
    pub fn travel(&self) -> f64 {
        self.spacing * self.pass_frequency
    }

    /// Points of a row that keep every sample.
    pub fn points(&self) -> usize {
        (self.passages.period.round() as usize).max(FEWEST_SAMPLES)
    }

    /// Rows of the signal that begin `share` of a period after the passages' starts.
    pub fn signal_rows(&self, share: f64, points: usize) -> Vec<Vec<f64>> {
        fold::cut(&self.signal, &self.passages.later(share).starts, self.passages.period, points)
    }

    /// Rows of the high-frequency envelope, likewise.
    pub fn envelope_rows(&self, share: f64, points: usize) -> Vec<Vec<f64>> {
        fold::cut(&self.envelope, &self.passages.later(share).starts, self.passages.period, points)
    }
}

/// Whether a recording has enough samples in a passage and enough passages over the outer raceway, `nominal` a second.
fn check_size(recording: &Recording, nominal: f64) -> Result<(), SizingError> {
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
    Ok(())
}

/// Kurtosis of a prediction's residual in the band of impacts forwards and backwards in time, if the latter is larger.
/// A structure rings after an impact and not before it: the causal prediction takes the ringing off and leaves the
/// impact. Backwards it would have to know the impact in advance, and leaves more. Recorded and simulated faults have
/// 1.1 to 3.5 times as much kurtosis forwards, those that are lost in noise as much.
fn reversed(signal: &[f64], residual: &mut Spectrum, order: usize, rate: f64, band: Band) -> Option<[f64; 2]> {
    let backwards: Vec<f64> = signal.iter().rev().copied().collect();
    let backwards = linear_prediction::residual(&backwards, order);
    let sharpness = |residual: &mut Spectrum| {
        let filtered = residual.filtered(band);
        statistics::kurtosis(filtered.get(order..).unwrap_or_default())
    };
    let [forwards, backwards] = [sharpness(residual), sharpness(&mut Spectrum::of(&backwards, rate))];
    (backwards > REVERSED * forwards).then_some([forwards, backwards])
}

/// Lower edge of the band of impacts (Hz): far above the rings' modes (below 2 kHz), low enough for accelerometers.
fn impact_band(rate: f64) -> f64 {
    (0.2 * rate).min(5000.0)
}
