//! Spall length from the events of the passages: an estimate that needs no model of the machine.
//!
//! With r the element's and R_o the raceway's radius, 1/r_e = 1/r − 1/R_o, an element that is s past a sharp edge has
//! sunk by P(s) = s²/(2 r_e) (the circles' own P differs by less than 1 % at 5°). It is free when P(s_u) equals the
//! elastic approach δ of both its contacts:
//! ```text
//! s_u = √(2 r_e δ),   δ = (Q/K)^(2/3),   Q = 5F/Z
//! ```
//! **Entry.** The edge is where 15 % of the force is lost, if it is sharp; a rounded edge lets go earlier, by at most
//! the way s_r from there to half the excursion. **Exit.** The last impact falls when the element, squeezed between
//! trailing edge and inner ring, takes up its load again: not before L − s_u, not after L. With both taken at the
//! middle of their ranges, and S the way from the entry's onset to the last impact,
//! ```text
//! L = S + (s_u − s_r)/2,   u² = (s_u² + s_r²)/12 + u_statistical²
//! ```
//! **Limit.** An element never gets free, and there are no two separate events, unless it can sink by its approach and
//! the clearance by which the inner ring can follow: P(L/2) > δ + G_r. Shorter is unresolved. Where Q is unknown, s_u
//! is the way from the entry's onset to its extreme, an upper bound that holds in any case.

use super::continuity::Break;
use super::entry::{self, Entry};
use super::events::{self, Impact};
use super::measured::Measured;
use super::passages;
use super::statistics::{self, Random};
use brinell::geometry::hertz_constant::HertzConstants;
use brinell::scene::{Bearing, Motion, Scene};

/// Share of a period before the first impact.
const LEAD: f64 = 0.3;
/// The window of a jump: the way in which an impact's envelope rises [degrees], but not less than this time [s].
const JUMP: (f64, f64) = (0.25, 1.2e-4);
/// Clearness of the entry's excursion below which it is not taken for one.
const CLEAR: f64 = 3.0;
/// The same for an entry far before a single impact, where there is more to mistake.
const CLEAR_FAR: f64 = 8.0;
/// Sampling rate that impacts close to each other need [Hz]: echoes fade faster the higher the band, and 5 to 11 kHz is
/// just enough.
const ENOUGH_RATE: f64 = 24_000.0;
/// Length from which impacts are not close [degrees].
const LONG: f64 = 3.0;
/// Share of the length beyond which its 95 % interval says nothing.
pub(super) const UNCERTAIN: f64 = 0.25;
/// Resamplings of the passages.
const RESAMPLINGS: usize = 60;

/// Length by events. Angles in degrees of the outer raceway.
#[derive(Debug, Clone, PartialEq)]
pub struct EventLength {
    /// Length.
    pub length: f64,
    /// Standard uncertainty from the scatter of passages.
    pub statistical: f64,
    /// Standard uncertainty from what the events mean.
    pub systematic: f64,
    /// Shortest length that could have been resolved.
    pub limit: f64,
    /// First impact after the start of a passage's period.
    pub first: f64,
    /// Onset of the entry, relative to the first impact.
    pub onset: f64,
    /// Impacts, relative to the first.
    pub impacts: Vec<f64>,
}

/// Why there is no length. Angles in degrees.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unresolved {
    /// Nothing repeats with the ball pass frequency.
    #[error(
        "nothing repeats with the ball pass frequency: its comb stands {0:.1} standard deviations above chance, limit {1:.1}"
    )]
    NoPattern(f64, f64),
    /// Something else repeats.
    #[error(
        "nothing repeats with the ball pass frequency: its comb stands {0:.1} standard deviations above chance, limit {1:.1}; but one at \
         {2:.2} Hz stands {3:.1} above it: are speed, rate and bearing right, or is it not the outer raceway?"
    )]
    OtherPattern(f64, f64, f64, f64),
    /// Impacts and echoes cannot be told apart in what the rate leaves.
    #[error(
        "{0:.2} degrees at a sampling rate of {1:.0} Hz: below {2:.0} Hz the band above the rings' modes is too narrow to tell a second impact that \
         close from an echo"
    )]
    LowRate(f64, f64, f64),
    /// A piece is missing.
    #[error(
        "the passages after about {0:.2} s are shifted by {1:.1} degrees against those before: is a piece of the \
         recording missing, or did the cage skid? Cut the recording there"
    )]
    Broken(f64, f64),
    /// More than one passage in a period.
    #[error(
        "the same passes {0} times in each ball pass period: are rate and speed right, or are there several spalls?"
    )]
    SeveralTimes(usize),
    /// No impact stands out.
    #[error("no impact stands out of the averaged passages: largest jump of the envelope below {0:.1} dB")]
    NoImpact(f64),
    /// Onset and impacts cannot be told apart.
    #[error(
        "one impact per passage and no clear entry before it (clearness {0:.1}, limit {1:.1}): entry and exit are not apart"
    )]
    OneImpact(f64, f64),
    /// No entry.
    #[error(
        "{0:.2} degrees between first and last impact, but no clear entry before them (clearness {1:.1}, limit {2:.1})"
    )]
    NoEntry(f64, f64, f64),
    /// Impacts fill the spacing.
    #[error("impacts over {0:.1} of {1:.1} degrees of spacing: first and last cannot be told")]
    NoSilence(f64, f64),
    /// The halves of the recording disagree.
    #[error("odd and even passages disagree: {0:.2} and {1:.2} degrees")]
    Halves(f64, f64),
    /// Too short.
    #[error("{0:.2} degrees, uncertain by {1:.2}: not surely above {2:.2}, below which an element never gets free")]
    TooShort(f64, f64, f64),
    /// Too uncertain.
    #[error("{0:.2} degrees, uncertain by {1:.2} (95 %): more than a quarter of it")]
    TooUncertain(f64, f64),
}

/// Sizes the recording by its events.
///
/// # Errors
/// The reason why it cannot be.
pub fn estimate(measured: &Measured, scene: &Scene) -> Result<EventLength, Unresolved> {
    let comb = &measured.comb;
    if !comb.is_significant() {
        let limit = super::envelope::SIGNIFICANT;
        return Err(match &measured.elsewhere {
            Some(other) => Unresolved::OtherPattern(comb.significance, limit, other.frequency, other.significance),
            None => Unresolved::NoPattern(comb.significance, limit),
        });
    }
    if let Some(Break { passage, shift }) = measured.broken {
        let at = measured.passages.starts[passage.min(measured.passages.starts.len() - 1)] / measured.rate;
        return Err(Unresolved::Broken(at, shift * measured.spacing));
    }
    if let Some(times) = measured.times_a_period {
        return Err(Unresolved::SeveralTimes(times));
    }
    let grid = Grid::new(measured);
    let envelopes = measured.envelope_rows(0.0, grid.points);
    let impacts = events::impacts(&decibels(passages::average(&envelopes)), grid.width, grid.smallest);
    let impacts = events::without_echoes(impacts, &envelopes, grid.width, grid.degree * measured.travel());
    let Some(first) = impacts.first().copied() else { return Err(Unresolved::NoImpact(grid.smallest)) };
    let span = grid.span(&impacts);
    if span > 0.6 * measured.spacing {
        return Err(Unresolved::NoSilence(span, measured.spacing));
    }
    let share = first.at / grid.points as f64 - LEAD;
    let rows = Rows {
        signal: measured.signal_rows(share, grid.points),
        envelope: measured.envelope_rows(share, grid.points),
        impact: LEAD * grid.points as f64,
        last: LEAD * grid.points as f64 + span * grid.degree,
        far: impacts.len() == 1,
    };
    let everything: Vec<usize> = (0..rows.signal.len()).collect();
    let Some((entry, way)) = rows.way(&everything, &grid) else { return Err(unclear(&rows, span, 0.0)) };
    if entry.clearness < rows.clear() {
        return Err(unclear(&rows, span, entry.clearness));
    }
    check_halves(&rows, &grid, way)?;
    let statistical = bootstrap(&rows, &grid).hypot(entry.uncertainty / grid.degree);
    let rounding = entry.half_way / grid.degree;
    let onset_to_extreme = (entry.extreme - entry.at) / grid.degree;
    let bearing = &scene.bearing;
    let unloading = approach(scene).map_or(onset_to_extreme, |d| sunk_after(bearing, d).min(onset_to_extreme));
    let length = way + 0.5 * (unloading - rounding);
    let systematic = ((unloading * unloading + rounding * rounding) / 12.0).sqrt();
    let approach = depth_at(bearing, unloading);
    // A jump is measured between two windows: two of them blur what lies closer.
    let free = 2.0 * sunk_after(bearing, approach + bearing.radial_clearance.max(0.0));
    let limit = free.hypot(2.0 * grid.width as f64 / grid.degree);
    let uncertainty = statistical.hypot(systematic);
    if length - uncertainty < limit {
        return Err(Unresolved::TooShort(length, uncertainty, limit));
    }
    if measured.rate < ENOUGH_RATE && length < LONG {
        return Err(Unresolved::LowRate(length, measured.rate, ENOUGH_RATE));
    }
    if 2.0 * uncertainty > UNCERTAIN * length {
        return Err(Unresolved::TooUncertain(length, 2.0 * uncertainty));
    }
    let impacts = impacts.iter().map(|b| (b.at - first.at).rem_euclid(grid.points as f64) / grid.degree).collect();
    let onset = (entry.at - rows.impact) / grid.degree;
    let first = first.at / grid.degree;
    Ok(EventLength { length, statistical, systematic, limit, first, onset, impacts })
}

fn unclear(rows: &Rows, span: f64, clearness: f64) -> Unresolved {
    if rows.far { Unresolved::OneImpact(clearness, CLEAR_FAR) } else { Unresolved::NoEntry(span, clearness, CLEAR) }
}

/// The averaged passage that a figure shows: degrees from `from`, signal, envelope level [dB]. `from` is in degrees
/// after the start of a passage's period.
pub fn averaged_passage(measured: &Measured, from: f64) -> [Vec<f64>; 3] {
    let grid = Grid::new(measured);
    let share = from / measured.spacing - LEAD;
    let degrees = (0..grid.points).map(|i| i as f64 / grid.degree - LEAD * measured.spacing).collect();
    let signal = passages::average(&measured.signal_rows(share, grid.points));
    [degrees, signal, decibels(passages::average(&measured.envelope_rows(share, grid.points)))]
}

/// The grid on which passages are averaged.
struct Grid {
    points: usize,
    /// Points per degree.
    degree: f64,
    /// Points of the jump's window.
    width: usize,
    /// Smallest jump that is no accident [dB].
    smallest: f64,
}

impl Grid {
    fn new(measured: &Measured) -> Self {
        let points = measured.points();
        let degree = points as f64 / measured.spacing;
        let width = ((JUMP.0).max(JUMP.1 * measured.travel()) * degree).round().max(2.0) as usize;
        // The level of noise scatters by 5.6 dB; a jump is the difference of two means over all passages. Six
        // deviations.
        let smallest = (6.0 * 5.6 / (measured.passages.starts.len() as f64).sqrt()).max(3.0);
        Self { points, degree, width, smallest }
    }

    /// From first to last impact [degrees].
    fn span(&self, impacts: &[Impact]) -> f64 {
        match (impacts.first(), impacts.last()) {
            (Some(a), Some(b)) => (b.at - a.at).rem_euclid(self.points as f64) / self.degree,
            _ => 0.0,
        }
    }
}

struct Rows {
    signal: Vec<Vec<f64>>,
    envelope: Vec<Vec<f64>>,
    /// First and last impact [grid points].
    impact: f64,
    last: f64,
    /// There is one impact: the entry may lie far before it.
    far: bool,
}

impl Rows {
    fn clear(&self) -> f64 {
        if self.far { CLEAR_FAR } else { CLEAR }
    }

    /// Entry, and the way from it to the last impact [degrees], in the average over the chosen rows.
    fn way(&self, chosen: &[usize], grid: &Grid) -> Option<(Entry, f64)> {
        let signal = average_of(&self.signal, chosen);
        let level = decibels(average_of(&self.envelope, chosen));
        let reach = (0.4 * grid.degree) as usize;
        let impact = events::jump_near(&level, grid.width, self.impact, reach);
        let last = events::jump_near(&level, grid.width, self.last, reach);
        let entry = if self.far {
            entry::far_entry(&signal, impact, grid.degree)?
        } else {
            entry::entry(&signal, impact, self.last - self.impact, grid.degree)?
        };
        Some((entry, (last - entry.at) / grid.degree))
    }
}

fn check_halves(rows: &Rows, grid: &Grid, way: f64) -> Result<(), Unresolved> {
    let half = |from: usize| -> Vec<usize> { (from..rows.signal.len()).step_by(2).collect() };
    let ways = [0, 1].map(|from| rows.way(&half(from), grid).map_or(0.0, |(_, way)| way));
    if (ways[0] - ways[1]).abs() > 0.25 * way {
        return Err(Unresolved::Halves(ways[0], ways[1]));
    }
    Ok(())
}

fn bootstrap(rows: &Rows, grid: &Grid) -> f64 {
    let count = rows.signal.len();
    let mut random = Random::new(count as u64);
    let ways: Vec<f64> = (0..RESAMPLINGS)
        .filter_map(|_| {
            let chosen: Vec<usize> = (0..count).map(|_| random.below(count)).collect();
            rows.way(&chosen, grid).map(|(_, way)| way)
        })
        .collect();
    statistics::spread(&ways)
}

fn decibels(mut amplitudes: Vec<f64>) -> Vec<f64> {
    amplitudes.iter_mut().for_each(|x| *x = 20.0 * libm::log10(*x + f64::MIN_POSITIVE));
    amplitudes
}

fn average_of(rows: &[Vec<f64>], chosen: &[usize]) -> Vec<f64> {
    let mut sum = vec![0.0; rows.first().map_or(0, Vec::len)];
    for &k in chosen {
        for (s, x) in sum.iter_mut().zip(&rows[k]) {
            *s += x;
        }
    }
    sum.iter_mut().for_each(|s| *s /= chosen.len() as f64);
    sum
}

/// Approach of the most loaded element's two contacts together [m]; Q = 5F/Z holds for usual clearances (Stribeck).
pub(super) fn approach(scene: &Scene) -> Option<f64> {
    let load = scene.shaft.load[0].hypot(scene.shaft.load[1]);
    if scene.shaft.motion != Motion::Internal || load == 0.0 {
        return None;
    }
    let force = 5.0 * load / scene.bearing.element_count as f64;
    let ratio = force / HertzConstants::of(&scene.bearing).in_series();
    Some(libm::cbrt(ratio * ratio))
}

/// Shortest length that the scene's load and clearance allow [degrees], where the load is known.
pub(super) fn limit(scene: &Scene) -> Option<f64> {
    let free = approach(scene)? + scene.bearing.radial_clearance.max(0.0);
    Some(2.0 * sunk_after(&scene.bearing, free))
}

/// 1/r_e [1/m].
fn relative_curvature(bearing: &Bearing) -> f64 {
    2.0 / bearing.element_diameter - 1.0 / bearing.outer_raceway_radius()
}

/// Way past an edge [degrees] after which an element has sunk by `depth` [m].
fn sunk_after(bearing: &Bearing, depth: f64) -> f64 {
    ((2.0 * depth / relative_curvature(bearing)).sqrt() / bearing.outer_raceway_radius()).to_degrees()
}

/// How far [m] an element has sunk `degrees` past an edge.
pub fn depth_at(bearing: &Bearing, degrees: f64) -> f64 {
    let s = degrees.to_radians() * bearing.outer_raceway_radius();
    0.5 * s * s * relative_curvature(bearing)
}
