//! Spall length from the events of the passages: an estimate that needs no model of the machine.
//!
//! An element that is s past a sharp edge has sunk by P(s) = s²/(2 r_e) ([`Raceway`] has r_e of
//! either raceway). It is free when P(s_u) equals the elastic approach δ of both its contacts:
//! ```text
//! s_u = √(2 r_e δ),   δ = (Q/K)^(2/3),   Q = 5F/Z
//! ```
//! **Entry.** The edge is where 15 % of the force is lost, if it is sharp; a rounded edge lets go earlier, by at most
//! the travel s_r from there to half the excursion. **Exit.** The last impact falls when the element, squeezed between
//! trailing edge and inner ring, takes up its load again: not before L − s_u, not after L. With both taken at the
//! middle of their ranges, and S the travel from the entry's onset to the last impact,
//! ```text
//! L = S + (s_u − s_r)/2,   u² = (s_u² + s_r²)/12 + (v τ)² + (ε L)² + u_statistical²
//! ```
//! v τ is the travel of an element while the housing answers (`ANSWER`), ε what machines differ by (`MACHINES`).
//! **Limit.** An element never gets free, and there are no two separate events, unless it can sink by its approach and
//! the clearance by which the inner ring can follow: P(L/2) > δ + G_r. Shorter is unresolved. Where Q is unknown, s_u
//! is the travel from the entry's onset to its extreme, an upper bound that holds in any case.

use crate::sizing::measured::{ENOUGH_RATE, Measured};
use crate::sizing::passages::{Break, Classified, Entry, Impact, MODULATED, RESAMPLINGS, entry, events, fold};
use crate::sizing::raceway;
use crate::sizing::raceway::Raceway;
use crate::sizing::unresolved::Unresolved;
use crate::spectra::Fault;
use crate::statistics;
use crate::statistics::Random;
use brinell::scene::Scene;

/// Share of a period before the first impact.
const LEAD: f64 = 0.3;
/// The window of a jump: the travel in which an impact's envelope rises (degrees), but not less than [`JUMP_TIME`].
const JUMP_TRAVEL: f64 = 0.25;
/// Shortest window of a jump (s).
const JUMP_TIME: f64 = 1.2e-4;
/// Clearness of the entry's excursion below which it is not taken for one.
const CLEAR: f64 = 3.0;
/// The same for an entry far before a single impact, where there is more to mistake.
const CLEAR_FAR: f64 = 8.0;
/// Impacts that a spall makes at most: on its floor or where the element is caught, and at its end. With more, the
/// last cannot be identified.
const MOST_IMPACTS: usize = 2;
/// Standard uncertainty of the time between a force and what a sensor shows of it (s): 64 µs are a radian of 2.5 kHz,
/// up to which housings follow an entry, 35 µs an impact's window of 0.12 ms as a rectangle.
const ANSWER: f64 = 7.3e-5;
/// Standard uncertainty of a length, as a share, between one machine and another, outside and inside. Outside the mean
/// error of 5 degrees is 0 % on one recorded rig and 11 % on another: half of that. Inside entries wander by a tenth of
/// the length, and are 16 % too early on one rig of two.
const MACHINES: [f64; 2] = [0.055, 0.08];
/// Half the least share of the envelope's variation that spalls of 2 degrees make up, over six recordings of one rig in
/// pieces of a second, and what follows from a limit below and above.
const RECORDED: f64 = 0.18;
const SEEN: &str = "A spall of 2 degrees as loud as recorded ones (37 % and more) would have been seen";
const NOT_SEEN: &str = "In so short a recording a spall of 2 degrees need not be seen: give five seconds";
/// Share of the length beyond which its 95 % interval says nothing.
pub(super) const UNCERTAIN: f64 = 1.0 / 3.0;
/// Share of the resamplings in which entry and impacts must be detected again.
const STABLE: f64 = 0.8;
/// Consecutive stretches that are laid beside each other, and passages in one: each must be sized by itself.
const STRETCHES: usize = 4;
const STRETCH: usize = 30;

/// Length by events. Angles in degrees of the raceway that is sized.
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

/// The averaged passage of a recording with its impacts, found once.
pub struct AveragedPassage {
    grid: Grid,
    classified: Classified,
}

impl AveragedPassage {
    /// Of all passages.
    pub fn of(measured: &Measured) -> Self {
        let grid = Grid::new(measured);
        let envelopes = measured.envelope_rows(0.0, grid.points);
        let classified = grid.classified(&envelopes, &(0..envelopes.len()).collect::<Vec<_>>());
        Self { grid, classified }
    }

    /// All impacts without echoes [degrees after the first], however many there are.
    pub fn impacts(&self) -> Vec<f64> {
        self.grid.after_first(&self.classified.impacts)
    }

    /// The first impact (degrees after the start of a passage's period), if there is one.
    pub fn first_impact(&self) -> Option<f64> {
        self.classified.impacts.first().map(|impact| impact.at / self.grid.degree)
    }

    /// What a figure shows: degrees from `from`, signal, envelope level (dB). `from` is in degrees after the start of a
    /// passage's period.
    pub fn curves(&self, measured: &Measured, from: f64) -> [Vec<f64>; 3] {
        let grid = &self.grid;
        let share = from / measured.spacing - LEAD;
        let degrees = (0..grid.points).map(|i| i as f64 / grid.degree - LEAD * measured.spacing).collect();
        let signal = fold::average(&measured.signal_rows(share, grid.points));
        [degrees, signal, decibels(fold::average(&measured.envelope_rows(share, grid.points)))]
    }
}

/// Sizes the recording by its events.
///
/// # Errors
/// The reason why it cannot be.
pub fn estimate(measured: &Measured, passage: &AveragedPassage, scene: &Scene) -> Result<EventLength, Unresolved> {
    check_fault(measured)?;
    if let Some(Break { passage, shift, .. }) = measured.broken {
        let at = passage as f64 / measured.pass_frequency;
        return Err(Unresolved::Broken(at, shift * measured.spacing));
    }
    if let Some(times) = measured.times_a_period {
        return Err(Unresolved::SeveralTimes(times));
    }
    if measured.rate < ENOUGH_RATE {
        return Err(Unresolved::LowRate(measured.rate, ENOUGH_RATE));
    }
    let AveragedPassage { grid, classified: Classified { impacts, doubtful } } = passage;
    let Some(first) = impacts.first().copied() else { return Err(Unresolved::NoImpact(grid.smallest)) };
    let span = grid.span(impacts);
    if span > 0.6 * measured.spacing {
        return Err(Unresolved::NoSilence(span, measured.spacing));
    }
    let all = grid.after_first(impacts);
    if all.len() > MOST_IMPACTS {
        return Err(Unresolved::ManyImpacts(all));
    }
    let later = |rise: &Impact| (rise.at - first.at).rem_euclid(grid.points as f64) / grid.degree;
    if let Some(rise) = doubtful.iter().map(later).find(|&rise| rise > span) {
        return Err(Unresolved::PerhapsLast(span, rise));
    }
    let share = first.at / grid.points as f64 - LEAD;
    let rows =
        Rows { signal: measured.signal_rows(share, grid.points), envelope: measured.envelope_rows(share, grid.points) };
    let picked = Picked {
        impact: LEAD * grid.points as f64,
        last: LEAD * grid.points as f64 + span * grid.degree,
        far: impacts.len() == 1,
    };
    if picked.far && measured.raceway == Raceway::Inner {
        return Err(Unresolved::OneInside(measured.modulation));
    }
    let everything: Vec<usize> = (0..rows.signal.len()).collect();
    let travel = rows.travel(&picked, &everything, grid);
    let (entry, travel_deg) = travel.ok_or_else(|| unclear(&picked, span, 0.0))?;
    if entry.clearness < picked.clear() {
        return Err(unclear(&picked, span, entry.clearness));
    }
    check_halves(&rows, &picked, grid, travel_deg)?;
    let statistical = rows.scatter(grid, travel_deg)?.hypot(entry.uncertainty / grid.degree);
    let rounding = entry.half_way / grid.degree;
    let onset_to_extreme = (entry.extreme - entry.at) / grid.degree;
    let (bearing, raceway) = (&scene.bearing, measured.raceway);
    let unloading =
        raceway::approach(scene).map_or(onset_to_extreme, |d| raceway.sunk_after(bearing, d).min(onset_to_extreme));
    let length = travel_deg + 0.5 * (unloading - rounding);
    let meaning = ((unloading * unloading + rounding * rounding) / 12.0).sqrt();
    let machines = MACHINES[usize::from(raceway == Raceway::Inner)];
    let systematic = meaning.hypot(ANSWER * measured.travel()).hypot(machines * length);
    let approach = raceway.depth_at(bearing, unloading);
    // A jump is measured between two windows: two of them blur what lies closer.
    let free = 2.0 * raceway.sunk_after(bearing, approach + bearing.radial_clearance.max(0.0));
    let limit = free.hypot(2.0 * grid.width as f64 / grid.degree);
    let uncertainty = statistical.hypot(systematic);
    if length - uncertainty < limit {
        return Err(Unresolved::TooShort(length, uncertainty, limit));
    }
    if 2.0 * uncertainty > UNCERTAIN * length {
        return Err(Unresolved::TooUncertain(length, 2.0 * uncertainty));
    }
    let onset = (entry.at - picked.impact) / grid.degree;
    let first = first.at / grid.degree;
    Ok(EventLength { length, statistical, systematic, limit, first, onset, impacts: all })
}

/// Whether the recording looks like a fault that can be sized.
fn check_fault(measured: &Measured) -> Result<(), Unresolved> {
    if let Err(text) = &measured.speed_check {
        return Err(Unresolved::OtherSpeed(text.clone()));
    }
    if let (Some([forwards, backwards]), Fault::Inner | Fault::Outer) = (measured.reversed, measured.fault) {
        return Err(Unresolved::Reversed(forwards, backwards));
    }
    let combs = &measured.combs;
    match (measured.fault, &measured.elsewhere) {
        (_, Some([frequency, share])) => Err(Unresolved::OtherPattern(combs.described(), *frequency, 100.0 * share)),
        (Fault::None, _) => {
            let limit = combs.strongest().limit();
            let excluded = if limit < RECORDED { SEEN } else { NOT_SEEN };
            Err(Unresolved::NoPattern(combs.described(), 100.0 * limit, excluded))
        }
        (Fault::Element, _) => Err(Unresolved::OfElement(combs.described())),
        (Fault::Undecided, _) if combs.is_too_short() => {
            Err(Unresolved::TooFewTurns(measured.speed * measured.duration()))
        }
        (Fault::Undecided, _) => Err(Unresolved::TwoKinds(combs.described())),
        (Fault::Inner, _) if measured.modulation < MODULATED => {
            Err(Unresolved::NoLoadZone(measured.modulation, MODULATED))
        }
        (Fault::Inner | Fault::Outer, _) => Ok(()),
    }
}

fn unclear(picked: &Picked, span: f64, clearness: f64) -> Unresolved {
    if picked.far { Unresolved::OneImpact(clearness, CLEAR_FAR) } else { Unresolved::NoEntry(span, clearness, CLEAR) }
}

/// A position (degrees) as it is seen in the period that [`AveragedPassage::curves`] shows.
pub(super) fn shown(position: f64, spacing: f64) -> f64 {
    (position + LEAD * spacing).rem_euclid(spacing) - LEAD * spacing
}

/// The grid on which passages are averaged.
struct Grid {
    points: usize,
    /// Points per degree.
    degree: f64,
    /// Points of the jump's window.
    width: usize,
    /// Smallest jump that is no accident (dB).
    smallest: f64,
    /// Points per second.
    rate: f64,
    /// Whether the raceway turns with the shaft.
    turns: bool,
}

impl Grid {
    fn new(measured: &Measured) -> Self {
        let points = measured.points();
        let degree = points as f64 / measured.spacing;
        let width = (JUMP_TRAVEL.max(JUMP_TIME * measured.travel()) * degree).round().max(2.0) as usize;
        // The level of noise scatters by 5.6 dB; a jump is the difference of two means over all passages. Six
        // deviations.
        let smallest = (6.0 * 5.6 / (measured.passages.starts.len() as f64).sqrt()).max(3.0);
        let (rate, turns) = (degree * measured.travel(), measured.raceway == Raceway::Inner);
        Self { points, degree, width, smallest, rate, turns }
    }

    /// Impacts in the mean of the chosen rows, without echoes.
    fn classified(&self, envelopes: &[Vec<f64>], chosen: &[usize]) -> Classified {
        let level = decibels(fold::average(chosen.iter().map(|&k| &envelopes[k])));
        let impacts = events::impacts(&level, self.width, self.smallest, self.turns);
        events::classify_echoes(impacts, envelopes, chosen, self.width, self.rate, self.turns)
    }

    /// Where impacts are [degrees after the first].
    fn after_first(&self, impacts: &[Impact]) -> Vec<f64> {
        let Some(first) = impacts.first() else { return Vec::new() };
        impacts.iter().map(|b| (b.at - first.at).rem_euclid(self.points as f64) / self.degree).collect()
    }

    /// From first to last impact (degrees).
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
}

/// The impacts between which a travel is measured.
struct Picked {
    /// First and last impact (grid points).
    impact: f64,
    last: f64,
    /// There is one impact: the entry may lie far before it.
    far: bool,
}

impl Picked {
    fn clear(&self) -> f64 {
        if self.far { CLEAR_FAR } else { CLEAR }
    }
}

impl Rows {
    /// Entry, and the travel from it to the last impact (degrees), in the average over the chosen rows.
    fn travel(&self, picked: &Picked, chosen: &[usize], grid: &Grid) -> Option<(Entry, f64)> {
        let average = |rows: &[Vec<f64>]| fold::average(chosen.iter().map(|&k| &rows[k]));
        let (signal, level) = (average(&self.signal), decibels(average(&self.envelope)));
        let reach = (0.4 * grid.degree) as usize;
        let impact = events::jump_near(&level, grid.width, picked.impact, reach);
        let last = events::jump_near(&level, grid.width, picked.last, reach);
        let entry = if picked.far {
            entry::far_entry(&signal, impact, grid.degree)?
        } else {
            entry::entry(&signal, impact, picked.last - picked.impact, grid.degree)?
        };
        Some((entry, (last - entry.at) / grid.degree))
    }

    /// The same with impacts picked anew in these rows.
    fn picked_travel(&self, chosen: &[usize], grid: &Grid) -> Option<f64> {
        let impacts = grid.classified(&self.envelope, chosen).impacts;
        let impact = impacts.first()?.at;
        let last = impact + grid.span(&impacts) * grid.degree;
        let picked = Picked { impact, last, far: impacts.len() == 1 };
        self.travel(&picked, chosen, grid).map(|(_, travel_deg)| travel_deg)
    }

    /// Standard uncertainty of the travel (degrees) with all that is picked anew in each resample of the passages: half
    /// of the half-width that holds 95 % of them, and not less than consecutive stretches of the recording scatter.
    fn scatter(&self, grid: &Grid, travel_deg: f64) -> Result<f64, Unresolved> {
        let count = self.signal.len();
        let mut random = Random::new(count as u64);
        let resample = |_| (0..count).map(|_| random.below(count)).collect::<Vec<_>>();
        let all: Vec<Vec<usize>> = (0..RESAMPLINGS).map(resample).collect();
        let travels: Vec<f64> = all.iter().filter_map(|chosen| self.picked_travel(chosen, grid)).collect();
        if travels.len() < (STABLE * RESAMPLINGS as f64) as usize {
            return Err(Unresolved::Unstable(RESAMPLINGS - travels.len(), RESAMPLINGS));
        }
        let off: Vec<f64> = travels.iter().map(|picked| (picked - travel_deg).abs()).collect();
        let resampled = 0.5 * statistics::quantile(&off, 0.95).unwrap_or(0.0);
        let stretches = (count / STRETCH).min(STRETCHES);
        let stretch = |k: usize| (k * count / stretches..(k + 1) * count / stretches).collect::<Vec<_>>();
        let found: Vec<f64> = (0..stretches).filter_map(|k| self.picked_travel(&stretch(k), grid)).collect();
        Ok(resampled.max(statistics::deviation(&found) / (found.len().max(1) as f64).sqrt()))
    }
}

fn check_halves(rows: &Rows, picked: &Picked, grid: &Grid, travel_deg: f64) -> Result<(), Unresolved> {
    let half = |from: usize| -> Vec<usize> { (from..rows.signal.len()).step_by(2).collect() };
    let travels = [0, 1].map(|from| rows.travel(picked, &half(from), grid).map_or(0.0, |(_, travel_deg)| travel_deg));
    if (travels[0] - travels[1]).abs() > 0.25 * travel_deg {
        return Err(Unresolved::Halves(travels[0], travels[1]));
    }
    Ok(())
}

fn decibels(mut amplitudes: Vec<f64>) -> Vec<f64> {
    amplitudes.iter_mut().for_each(|x| *x = 20.0 * libm::log10(*x + f64::MIN_POSITIVE));
    amplitudes
}
