//! One scene through the simulation and the oracle, and how far apart they are.
//!
//! Differences are in the units of [`crate::units`]. To them come the oracle's own error, from a run with halved steps,
//! and what the oracle makes of a push of one unit at the start: elements that bounce make small differences large. A
//! scene is judged as long as all that is small beside the forces themselves.

use crate::case::{Case, Motion, Shape, Step};
use crate::oracle::balance;
use crate::oracle::run::{Pace, Run, Stop};
use crate::oracle::signals::{Kind, signals};
use crate::oracle::surfaces::closest;
use crate::oracle::turning::quadratic;
use crate::oracle::{Bearing, ELEMENTS, SENSOR};
use crate::random_case::fastest;
use crate::subject::{Refusal, Subject};
use crate::units::{HORIZON, LIMIT, differences, largest_force, position_error, rounding, slope_error, units};
use brinell::contact::error::ContactError;
use brinell::simulation::SimulationError;
use brinell::surface::SurfaceError;
use std::collections::BTreeMap;

/// Phase of the fastest motion in one step of the oracle; its reference takes half of it.
const PHASE: f64 = crate::random_case::PHASE;
/// Steps times elements of the oracle's first run.
const WORK: f64 = 8e5;

pub enum Verdict {
    Agreed(Measure),
    /// The simulation gave an error.
    Refused(Refusal),
    /// The oracle cannot say.
    Undecided(&'static str),
    Failed(String),
}

impl Verdict {
    /// Why a scene is not one that agreed.
    pub fn why_not(self) -> Option<String> {
        match self {
            Self::Agreed(_) => None,
            Self::Refused(error) => Some(error.to_string()),
            Self::Undecided(why) => Some(why.to_owned()),
            Self::Failed(why) => Some(why),
        }
    }
}

/// How well a scene agreed.
#[derive(Debug, Clone, Copy, Default)]
pub struct Measure {
    /// Largest difference of a force over the largest force, at the start and later.
    pub start: f64,
    pub error: f64,
    /// Largest difference in units.
    pub units: f64,
    /// Part of the run up to which it was judged.
    pub judged: f64,
}

pub fn judge(case: &Case) -> Verdict {
    let names = signals(case);
    let mut subject = match Subject::new(case) {
        Ok(subject) => subject,
        Err(error @ Refusal::Simulation(SimulationError::Contact(ContactError::NoWayOut { .. }))) => {
            return if Bearing::new(case).leaps() {
                Verdict::Refused(error)
            } else {
                Verdict::Failed(format!("no edge is so steep: {error}"))
            };
        }
        Err(error @ Refusal::Simulation(SimulationError::Surface(SurfaceError::Overlap { .. }))) => {
            let gap = closest(&Bearing::smooth(case), case);
            // Roundings of the arcs.
            return if gap < 1e-6 + 1e-13 {
                Verdict::Refused(error)
            } else {
                Verdict::Failed(format!("no defects are nearer than {gap:e} m: {error}"))
            };
        }
        Err(error) => return Verdict::Refused(error),
    };
    if closest(&Bearing::smooth(case), case) < 1e-6 - 1e-13 {
        return Verdict::Failed("defects that overlap are not refused".to_owned());
    }
    if case.defects.iter().any(|defect| matches!(defect.shape, Shape::Topography(_))) {
        return Verdict::Failed("a rigid path over a topography is not refused".to_owned());
    }
    let first = match subject.start(case) {
        Ok(first) => first,
        Err(error @ SimulationError::Equilibrium(_)) => return refused_start(case, error),
        Err(error) => return Verdict::Refused(error.into()),
    };
    let bearing = Bearing::new(case);
    match start(&bearing, case, &first, &names) {
        Ok(found) => compare(&bearing, case, (subject, &first), &names, found),
        Err(why) => Verdict::Failed(why),
    }
}

/// A scene that finds no balance at the start: whether the oracle finds one.
fn refused_start(case: &Case, error: SimulationError) -> Verdict {
    let (left, largest) = balance::best(&Bearing::new(case), case);
    if left <= 1e-6 * largest {
        return Verdict::Failed(format!("refused, but {left:e} N of {largest:e} N is all that is left: {error}"));
    }
    Verdict::Refused(error.into())
}

/// The oracle's state vector from the signals at the start.
pub fn start_state(case: &Case, names: &[(String, Kind)], sample: &[f64]) -> Vec<f64> {
    let values: BTreeMap<&str, f64> = names.iter().map(|(name, _)| name.as_str()).zip(sample.iter().copied()).collect();
    let mut y = vec![0.0; Bearing::smooth(case).state_count()];
    for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
        if case.rings[which].motion == Motion::Internal {
            for (i, part) in ["x", "y", "vx", "vy"].into_iter().enumerate() {
                y[4 * which + i] = values[format!("{name}.{part}").as_str()];
            }
        }
    }
    let hosted = case.steps[0].host.map_or([0.0; 3], |host| host.rings[1][1]);
    (y[SENSOR], y[SENSOR + 1]) =
        if case.rings[1].motion == Motion::Host { (hosted[0], hosted[1]) } else { (y[5], y[7]) };
    for j in 0..case.count {
        y[ELEMENTS + 2 * j] = values[format!("element[{}].path", j + 1).as_str()];
    }
    y
}

/// Whether the start is a balance, and its forces are the oracle's: largest force, and largest difference over it.
pub fn start(bearing: &Bearing, case: &Case, first: &[f64], names: &[(String, Kind)]) -> Result<(f64, f64), String> {
    let run = Run::new(bearing, start_state(case, names, first), case.steps[0].host.as_ref(), Pace::STANDING);
    let contacts = run.acting.contacts.iter().flatten();
    let elastic = (0..2).map(|side| bearing.growth[side].force(run.largest[side].max(0.0))[1]).fold(0.0, f64::max);
    let stiffest = contacts.clone().map(|contact| contact.steep).fold(elastic, f64::max);
    let loads = case.rings.iter().flat_map(|ring| ring.load).fold(0.0f64, |m, f| m.max(f.abs()));
    let body =
        bearing.mass * (bearing.gravity[0].hypot(bearing.gravity[1]) + bearing.rho_0 * run.outside.turns[0][1].powi(2));
    let largest = contacts.fold(loads, |m, contact| m.max(contact.force));
    // The search for a balance counts 1e-12 N as none.
    let limit = 1e-9 * (largest + body) + (rounding(bearing) + position_error(case)) * stiffest + 1e-12;
    // The slope of the path turns the damper's rate with the speed past the defect, and directs the force.
    let leaning = |j: usize, side: usize| {
        let (turns, contact) = (&run.outside.turns, run.acting.contacts[j][side]);
        let seat = bearing.seat(j, turns[0], &bearing.motions(&run.outside, 0.0, &run.y), &run.y);
        let Some(over) = bearing.over(side, j, &seat, turns, &run.stretches[j]) else { return 0.0 };
        let distance = over.surface.envelope.distance(over.path);
        let kappa = (over.slope / distance).atan();
        let leans = contact.force * kappa.sin().abs() * kappa.cos().powi(2) / distance;
        (contact.by_rate * over.rate.abs() + leans) * slope_error(bearing, over.surface, over.psi)
    };
    // A damper that pushes with an infinite slope at first may leap over a balance between two numbers of a path: then
    // what is left changes its sign there.
    let leaps = |j: usize| {
        let left = |by: f64| {
            let mut y = run.y.clone();
            y[ELEMENTS + 2 * j] += by;
            let there = Run::new(bearing, y, case.steps[0].host.as_ref(), Pace::STANDING);
            bearing.own(j).mass * (there.rates()[ELEMENTS + 2 * j + 1] + there.carried(j))
        };
        let [inwards, outwards] = [-1.0, 1.0].map(|by| left(by * rounding(bearing)));
        if inwards > 0.0 && outwards < 0.0 { inwards - outwards } else { 0.0 }
    };
    let limits: Vec<f64> = (0..bearing.count).map(|j| limit + leaning(j, 0) + leaning(j, 1) + leaps(j)).collect();
    let limit: f64 = limits.iter().sum();
    for j in 0..bearing.count {
        let limit = limits[j];
        let along = bearing.own(j).mass * (run.rates()[ELEMENTS + 2 * j + 1] + run.carried(j));
        if !(along.abs() <= limit) {
            let contacts = run.acting.contacts[j];
            return Err(format!(
                "at the start {along:e} N push element {} (limit {limit:e} N): {contacts:?}, {:?}, body {body:e}",
                j + 1,
                run.stretches[j]
            ));
        }
    }
    for (which, ring) in case.rings.iter().enumerate().filter(|(_, ring)| ring.motion == Motion::Internal) {
        for a in 0..2 {
            let net = ring.mass * run.acting.accelerations[which][a];
            if !(net.abs() <= limit) {
                return Err(format!("at the start {net:e} N push ring {which} along {a} (limit {limit:e} N)"));
            }
        }
    }
    let mut worst = 0.0f64;
    for (((name, kind), a), b) in names.iter().zip(first).zip(run.values(0.0)) {
        if *kind == Kind::Force {
            worst = worst.max((a - b).abs());
            if !((a - b).abs() <= limit) {
                return Err(format!("at the start {name} is {a:e} N, the oracle says {b:e} N"));
            }
        }
    }
    Ok((largest, worst / largest.max(1e-30)))
}

/// The oracle with its usual steps, with half of them, and with the usual ones after a push at the start.
struct Oracles<'a> {
    runs: [Run<'a>; 3],
    own: BTreeMap<Kind, f64>,
    grown: BTreeMap<Kind, f64>,
}

impl<'a> Oracles<'a> {
    fn new(bearing: &'a Bearing, case: &Case, start: &[f64]) -> Self {
        let host = case.steps[0].host.as_ref();
        let first = Run::new(bearing, start.to_vec(), host, Pace::STANDING).largest;
        let h = PHASE / fastest(case, first.map(|approach| 1.5 * approach.max(1e-9)));
        let pace = Pace { h, fewest: 1, budget: (WORK / case.count as f64) as usize };
        let units = units(bearing, case, first);
        let moved = Run::moved(bearing, start, units[&Kind::Length], units[&Kind::Velocity]);
        let run = |y: &[f64], pace: Pace| Run::new(bearing, y.to_vec(), host, pace);
        let runs = [run(start, pace), run(start, pace.halved()), run(&moved, pace)];
        Self { runs, own: BTreeMap::new(), grown: BTreeMap::new() }
    }

    /// Whether the oil films at either end of the last step, of this length (s), press the contacts together by more
    /// than three quarters of a per cent of an element's diameter.
    fn films_press(&self, length: f64) -> bool {
        let run = &self.runs[1];
        [0.0, length].into_iter().any(|before| {
            let films = run.bearing().films(&run.outside.turns.map(|turn| quadratic(turn, -before)));
            let left = run.bearing().clearance - films[0] - films[1];
            left < -0.0075 * 2.0 * run.bearing().r * (1.0 - 1e-9)
        })
    }

    /// The finer run's signals after the next step.
    fn step(&mut self, names: &[(String, Kind)], step: &Step) -> Result<Vec<f64>, Stop> {
        let Self { runs: [coarse, fine, pushed], own, grown } = self;
        let [coarse, fine, pushed] = [coarse, fine, pushed].map(|run| run.step(step.length, step.host.as_ref()));
        let (coarse, fine, pushed) = match (coarse, fine, pushed) {
            (Ok(coarse), Ok(fine), Ok(pushed)) => (coarse, fine, pushed),
            (Err(Stop::Left), Err(Stop::Left), Err(Stop::Left)) => return Err(Stop::Left),
            (Err(Stop::Budget), ..) | (_, Err(Stop::Budget), _) | (.., Err(Stop::Budget)) => return Err(Stop::Budget),
            _ => return Err(Stop::Lost),
        };
        differences(names, &coarse, &fine, own);
        differences(names, &coarse, &pushed, grown);
        Ok(fine)
    }
}

fn compare(
    bearing: &Bearing,
    case: &Case,
    (mut subject, first): (Subject, &[f64]),
    names: &[(String, Kind)],
    (force, residual): (f64, f64),
) -> Verdict {
    let mut oracles = Oracles::new(bearing, case, &start_state(case, names, first));
    let mut measure = Measure { start: residual, ..Measure::default() };
    let (mut time, mut scale) = (0.0, force);
    for (i, step) in case.steps.iter().enumerate() {
        let expected = match oracles.step(names, step) {
            Ok(expected) => expected,
            Err(Stop::Budget) => return measure.or("too many steps for the oracle"),
            Err(Stop::Lost) => return measure.or("the oracle's own error"),
            Err(Stop::Left) => {
                return match subject.step(case, i) {
                    Err(error) => Verdict::Refused(error.into()),
                    Ok(_) => {
                        Verdict::Failed(format!("step {i}: by the oracle an element or a ring leaves, here they stay"))
                    }
                };
            }
        };
        let units = units(bearing, case, oracles.runs[1].largest);
        let allowed = |kind: Kind| units[&kind] + oracles.grown[&kind] + oracles.own[&kind];
        scale = largest_force(names, &expected).fold(scale, f64::max);
        if LIMIT * allowed(Kind::Force) > HORIZON * scale {
            let own = LIMIT * oracles.own[&Kind::Force] > 0.5 * HORIZON * scale;
            return measure.or(if own { "the oracle's own error" } else { "chaos" });
        }
        let sample = match subject.step(case, i) {
            Ok(sample) => sample,
            Err(error @ SimulationError::ThickFilms { .. }) if oracles.films_press(step.length) => {
                return Verdict::Refused(error.into());
            }
            Err(error) => return Verdict::Failed(format!("step {i} fails where the oracle does not: {error}")),
        };
        time += step.length;
        measure.judged = time / case.duration();
        for (((name, kind), a), b) in names.iter().zip(&sample).zip(&expected) {
            let off = (a - b).abs();
            if *kind == Kind::Force {
                measure.error = measure.error.max(off / scale);
            }
            measure.units = measure.units.max(off / allowed(*kind));
            if !(off <= LIMIT * allowed(*kind)) {
                return Verdict::Failed(format!(
                    "step {i}: {name} is {a:e}, the oracle says {b:e}: {off:e} apart, allowed {:e} (its own error \
                     {:e}, growth {:e}); forces up to {scale:e} N",
                    LIMIT * allowed(*kind),
                    oracles.own[kind],
                    oracles.grown[kind]
                ));
            }
        }
    }
    Verdict::Agreed(measure)
}

impl Measure {
    /// What was judged of a run until the oracle could not go on.
    fn or(self, why: &'static str) -> Verdict {
        if self.judged == 0.0 { Verdict::Undecided(why) } else { Verdict::Agreed(self) }
    }
}
