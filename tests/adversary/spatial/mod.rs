//! Random scenes with three and five degrees of freedom against the oracle.
//!
//! Differences are counted in what one step of the simulation may be wrong by. To them come the oracle's own error,
//! from a run of a hundred times the tolerance, and what it makes of a push of one unit at the start.

mod subject;

use crate::case::{Damping, Motion, On};
use crate::draw::{Draw, for_seeds};
use crate::oracle::spatial::{Ball, Gyroscopic, SpatialBearing, SpatialCase, SpatialRun, Stop, random};
use crate::units::{HORIZON, KEPT_PATH, LIMIT, differences};
use std::collections::BTreeMap;
use subject::{Kind, Subject, names, values};

/// Of the oracle's steps (m), and most of them.
const EXACT: f64 = 1e-15;
const BUDGET: usize = 400_000;

/// One unit of each kind, for the largest approach (m) so far.
fn units(bearing: &SpatialBearing, case: &SpatialCase, approach: f64) -> BTreeMap<Kind, f64> {
    let path = if case.defects.is_empty() { 0.0 } else { KEPT_PATH * bearing.radius };
    let length = case.tolerance * (approach + 1e-7) + 1e-14 * bearing.rho_0 + path;
    let velocity = 1e3 * case.tolerance * (approach + 1e-7) + 1e-11 * bearing.rho_0;
    let stiff = bearing.constants().into_iter().fold(0.0, f64::max) * 1.5 * approach.sqrt();
    let damped = match case.damping {
        Damping::HuntCrossley(chi) => chi * stiff * approach / 1.5,
        Damping::Proportional(tau) => tau * stiff,
    };
    let force = (length * stiff + velocity * damped) * (1.0 + case.count as f64 / 3.0);
    // Across the groove a ball is held a tenth as stiffly as along the normal.
    let short = case.conformities.into_iter().fold(f64::INFINITY, f64::min) * case.diameter_mm * 1e-3 - bearing.radius;
    let angle = 10.0 * length / short;
    BTreeMap::from([
        (Kind::Length, length),
        (Kind::Velocity, velocity),
        (Kind::Across, 10.0 * length),
        (Kind::Tilt, length / bearing.rho_0),
        (Kind::TiltRate, velocity / bearing.rho_0),
        (Kind::Angle, angle),
        (Kind::Margin, angle),
        (Kind::Force, force),
        (Kind::Moment, force * bearing.rho_0),
    ])
}

/// An oracle, another whose difference quotients go half as far, from a balance of its own, and what becomes of that
/// one when it is pushed.
struct Oracles<'a> {
    case: &'a SpatialCase,
    bearing: &'a SpatialBearing,
    names: Vec<(String, Kind)>,
    runs: [SpatialRun<'a>; 3],
    /// Largest differences of the first two so far, and of the last two.
    own: BTreeMap<Kind, f64>,
    grown: BTreeMap<Kind, f64>,
    /// Largest approach (m) so far.
    largest: f64,
}

impl<'a> Oracles<'a> {
    fn new(case: &'a SpatialCase, [bearing, rough]: [&'a SpatialBearing; 2], state: Vec<f64>) -> Self {
        let host = case.steps[0].host.as_ref();
        let run = |bearing, state, exact| SpatialRun::new(bearing, state, host, [0.0; 2], exact, BUDGET);
        let roughly = rough.rest(host).map_or_else(|| state.clone(), |found| found.state);
        let fine = run(bearing, state, EXACT);
        let largest = deepest(&fine);
        let off = pushed(bearing, roughly.clone(), units(bearing, case, largest)[&Kind::Length]);
        let runs = [fine, run(rough, roughly, 100.0 * EXACT), run(rough, off, 100.0 * EXACT)];
        let (own, grown) = (BTreeMap::new(), BTreeMap::new());
        let mut oracles = Self { case, bearing, names: names(case), runs, own, grown, largest };
        let [fine, coarse, _] = oracles.values();
        differences(&oracles.names, &coarse, &fine, &mut oracles.own);
        oracles
    }

    fn values(&self) -> [Vec<f64>; 3] {
        self.runs.each_ref().map(|run| values(self.case, run))
    }

    fn step(&mut self, i: usize) -> Result<(), Stop> {
        let step = &self.case.steps[i];
        let taken = self.runs.each_mut().map(|run| run.step(step.length, step.host.as_ref()));
        if taken.contains(&Err(Stop::Left)) {
            return Err(Stop::Left);
        }
        taken.into_iter().collect::<Result<(), _>>()?;
        self.largest = self.largest.max(deepest(&self.runs[0]));
        let [fine, coarse, pushed] = self.values();
        differences(&self.names, &coarse, &fine, &mut self.own);
        differences(&self.names, &pushed, &coarse, &mut self.grown);
        Ok(())
    }

    /// What a difference may be.
    fn allowed(&self) -> BTreeMap<Kind, f64> {
        let more = |kind| {
            [&self.own, &self.grown].into_iter().map(|found| found.get(&kind).copied().unwrap_or(0.0)).sum::<f64>()
        };
        let units = units(self.bearing, self.case, self.largest);
        units.into_iter().map(|(kind, unit)| (kind, LIMIT * (unit + more(kind)) + 1e-9 * unit)).collect()
    }
}

/// Largest approach (m) now.
fn deepest(run: &SpatialRun<'_>) -> f64 {
    run.acting.balls.iter().flat_map(|ball| ball.contacts).fold(1e-9, |m, touch| touch.approach.max(m))
}

fn largest_force(balls: &[Ball]) -> f64 {
    balls.iter().flat_map(|ball| ball.contacts).fold(0.0, |m, touch| touch.force.max(m))
}

/// What became of a scene: how much of it was judged, and why no more.
fn judge(case: &SpatialCase) -> Result<(f64, &'static str), String> {
    let [bearing, mut rough] = [0, 1].map(|_| SpatialBearing::new(case));
    rough.quotients = 0.5;
    // As much is left of what difference quotients say of balls without inertia.
    let found = bearing.rest(case.steps[0].host.as_ref());
    let found = found.filter(|found| found.left.max(found.held.left) <= 3e-8 * largest_force(&found.held.balls));
    let mut subject = Subject::new(case)?;
    let (first, state) = match (subject.start(case), found) {
        (Ok(first), Some(found)) => (first, found.state),
        // One that the simulation finds and the oracle does not is judged by its residual elsewhere.
        (Ok(_) | Err(_), None) => return Ok((0.0, "no balance found")),
        (Err(error), Some(_)) => return Err(format!("refused, but there is a balance: {error}")),
    };
    let mut oracles = Oracles::new(case, [&bearing, &rough], state);
    let allowed = oracles.allowed().into_iter().map(|(kind, allowed)| (kind, allowed + 1e-9)).collect();
    compare(&oracles.names, &first, &oracles.values()[0], &allowed).map_err(|why| format!("at the start {why}"))?;
    let (mut time, mut judged) = (0.0, 0.0);
    for (i, step) in case.steps.iter().enumerate() {
        let before = oracles.runs[0].acting.balls.clone();
        match oracles.step(i) {
            Ok(()) => {}
            Err(Stop::Budget) => return Ok((judged, "too many steps for the oracle")),
            Err(Stop::Lost) => return Ok((judged, "a ball without inertia has no balance")),
            Err(Stop::Left) if subject.step(case, i).is_ok() => {
                return Err(format!("step {i}: the oracle's balls leave"));
            }
            Err(Stop::Left) => return Ok((judged, "balls leave")),
        }
        let ([expected, ..], allowed) = (oracles.values(), oracles.allowed());
        let after = &oracles.runs[0].acting.balls;
        if !expected.iter().all(|value| value.is_finite()) {
            return Ok((judged, "a ball without inertia has no balance"));
        }
        if allowed[&Kind::Force] > HORIZON * largest_force(after).max(1e-3) {
            return Ok((judged, "chaos, or the oracle's own error"));
        }
        let sample = match subject.step(case, i) {
            Ok(sample) => sample,
            Err(error) if error.to_string().contains("contact angle") && is_steep([&before, after]) => {
                return Ok((judged, "a contact leans by 80 degrees"));
            }
            Err(error) => return Err(format!("step {i}: {error}")),
        };
        compare(&oracles.names, &sample, &expected, &allowed).map_err(|why| format!("step {i}: {why}"))?;
        time += step.length;
        judged = time / case.duration();
    }
    Ok((judged, "to its end"))
}

fn compare(
    names: &[(String, Kind)],
    sample: &[f64],
    expected: &[f64],
    allowed: &BTreeMap<Kind, f64>,
) -> Result<(), String> {
    for (i, ((name, kind), (a, b))) in names.iter().zip(sample.iter().zip(expected)).enumerate() {
        let mut limit = allowed[kind];
        if let Some(behind) = kind.behind_its_force() {
            let [force, of_sample] = [expected[i - behind], sample[i - behind]];
            if *kind == Kind::Angle && of_sample == 0.0 && *a != 0.0 {
                return Err(format!("{name} is {a:e} where the contact is open"));
            }
            // One that is just touched may as well be open.
            if force <= allowed[&Kind::Force] {
                continue;
            }
            if *kind == Kind::Margin {
                limit += allowed[&Kind::Force] / (3.0 * force);
            }
        }
        let off = (a - b).abs();
        if !(off <= limit) {
            return Err(format!("{name} is {a:e}, the oracle says {b:e}: {off:e} apart, allowed {limit:e}"));
        }
    }
    Ok(())
}

/// Whether a contact leans by 80 degrees before or after a step, where the simulation gives up.
fn is_steep(balls: [&[Ball]; 2]) -> bool {
    let touches = balls.into_iter().flatten().flat_map(|ball| ball.contacts);
    touches.into_iter().any(|touch| touch.force > 0.0 && touch.angle.abs().to_degrees() >= 80.0)
}

/// The state with every ball and the shaft moved by so much.
fn pushed(bearing: &SpatialBearing, mut y: Vec<f64>, length: f64) -> Vec<f64> {
    for j in 0..bearing.count {
        let at = y.len() - 4 * bearing.count + 4 * j;
        let part = ((j as f64 + 0.5) * 1.9).sin();
        y[at] += length * part;
        y[at + 2] += length * (part - 0.3);
    }
    (0..3).for_each(|a| y[a] += length);
    y
}

#[test]
fn every_random_scene_in_space_is_a_possible_one() {
    let drawn = std::sync::Mutex::new(BTreeMap::new());
    for_seeds(100, |_, draw: &mut Draw| {
        let case = random(draw);
        let on_ball = case.defects.iter().any(|defect| matches!(defect.on, On::Element { .. }));
        for (what, is) in [
            ("host moves the shaft", case.rings[0].motion == Motion::Host),
            ("host moves the housing", case.rings[1].motion == Motion::Host),
            ("balls without inertia", !case.inertia),
            ("gyroscopic couple", case.gyroscopic != Gyroscopic::Nobody),
            ("defect on a ball", on_ball),
            ("several defects", case.defects.len() > 1),
            ("operating angle left open", case.operating_deg.is_none()),
            ("shoulder", case.shoulders_mm != [None; 2]),
        ] {
            *drawn.lock().unwrap().entry(what).or_insert(0) += usize::from(is);
        }
        brinell_scene_file::from_toml(&case.toml()).map(|_| ()).map_err(|error| format!("{error}\n{}", case.toml()))
    });
    let drawn = drawn.into_inner().unwrap();
    println!("{drawn:?}");
    assert!(drawn.values().all(|&count| count > 8), "hardly drawn: {drawn:?}");
}

#[test]
fn random_scenes_in_space_agree_with_the_oracle() {
    let judged = std::sync::Mutex::new(BTreeMap::<_, Vec<f64>>::new());
    for_seeds(12, |_, draw| {
        let case = random(draw);
        let (share, why) = judge(&case).map_err(|why| format!("{why}\n{}{:?}", case.toml(), case.steps))?;
        judged.lock().unwrap().entry((case.inertia, why)).or_default().push(share);
        Ok(())
    });
    let judged = judged.into_inner().unwrap();
    for ((inertia, why), shares) in &judged {
        let with = if *inertia { "with" } else { "without" };
        let part = 100.0 * shares.iter().sum::<f64>() / shares.len() as f64;
        println!("{} {with} inertia: {why}, {part:.0} % of their time", shares.len());
    }
    let all: Vec<f64> = judged.into_values().flatten().collect();
    let part = all.iter().sum::<f64>() / all.len() as f64;
    println!("{} scenes, {:.0} % of their time judged", all.len(), 100.0 * part);
    // Bounces and balances that nobody finds leave some unjudged.
    assert!(part > 0.4, "{all:?}");
}
