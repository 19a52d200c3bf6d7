//! Random scenes with three and five degrees of freedom against the oracle.
//!
//! Differences are counted in what one step of the simulation may be wrong by. To them come the oracle's own error,
//! from a run of a hundred times the tolerance, and what it makes of a push of one unit at the start.

use crate::case::{Motion, On};
use crate::draw::{Draw, for_seeds};
use crate::oracle::spatial::{Balance, Gyroscopic, SpatialBearing, SpatialCase, SpatialRun, Stop, random};
use brinell::simulation::{Simulation, SimulationError};
use std::collections::BTreeMap;

/// Units that a difference may have: many steps follow each other, each wrong by up to one.
const LIMIT: f64 = 100.0;
/// Largest allowed difference over the largest force up to which runs are compared.
const HORIZON: f64 = 0.02;
/// Of the oracle's steps (m), and most of them.
const EXACT: f64 = 1e-15;
const BUDGET: usize = 400_000;

/// What a signal is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Length,
    Velocity,
    Across,
    Tilt,
    TiltRate,
    Angle,
    /// Angle to a shoulder from the end of an ellipse, which is shorter than its groove's radius.
    Margin,
    Force,
    Moment,
}

impl Kind {
    /// How far before it the force stands that decides on it.
    fn behind_its_force(self) -> Option<usize> {
        match self {
            Self::Angle => Some(1),
            Self::Margin => Some(2),
            _ => None,
        }
    }
}

/// Names of what is compared.
fn names(case: &SpatialCase) -> Vec<(String, Kind)> {
    let mut names = Vec::new();
    for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
        if case.rings[which].motion == Motion::Internal {
            names.extend(["x", "y", "z"].map(|axis| (format!("{name}.{axis}"), Kind::Length)));
            names.extend(["x", "y", "z"].map(|axis| (format!("{name}.v{axis}"), Kind::Velocity)));
        }
        names.extend(["x", "y", "z"].map(|axis| (format!("{name}.force.{axis}"), Kind::Force)));
        names.extend(["x", "y"].map(|axis| (format!("{name}.moment.{axis}"), Kind::Moment)));
    }
    if case.freedom == 5 && case.rings[0].motion == Motion::Internal {
        names.extend(["x", "y"].map(|axis| (format!("shaft.tilt.{axis}"), Kind::Tilt)));
        names.extend(["x", "y"].map(|axis| (format!("shaft.tilt.v{axis}"), Kind::TiltRate)));
    }
    for j in 1..=case.count {
        names.push((format!("element[{j}].path"), Kind::Length));
        names.push((format!("element[{j}].axial"), Kind::Across));
        for (side, shoulder) in ["inner", "outer"].into_iter().zip(case.shoulders_mm) {
            names.push((format!("element[{j}].force.{side}"), Kind::Force));
            names.push((format!("element[{j}].contact_angle.{side}"), Kind::Angle));
            names.extend(shoulder.map(|_| (format!("element[{j}].shoulder.{side}"), Kind::Margin)));
        }
    }
    names
}

/// The oracle's values, in the order of [`names`].
fn values(case: &SpatialCase, run: &SpatialRun<'_>) -> Vec<f64> {
    let mut values = Vec::new();
    for which in 0..2 {
        if case.rings[which].motion == Motion::Internal {
            values.extend(&run.y[10 * which..10 * which + 3]);
            values.extend(&run.y[10 * which + 5..10 * which + 8]);
        }
        values.extend(run.acting.rings[which]);
    }
    if case.freedom == 5 && case.rings[0].motion == Motion::Internal {
        values.extend(&run.y[3..5]);
        values.extend(&run.y[8..10]);
    }
    for ball in &run.acting.balls {
        values.extend(ball.place);
        for (side, touch) in ball.contacts.iter().enumerate() {
            values.extend([touch.force, touch.angle]);
            values.extend(run.bearing.margin(side, touch));
        }
    }
    values
}

/// The simulation, with the references of what is compared.
struct Subject {
    simulation: Simulation,
    references: Vec<u32>,
}

impl Subject {
    fn new(case: &SpatialCase) -> Result<Self, String> {
        let scene = brinell_scene_file::from_toml(&case.toml()).map_err(|error| error.to_string())?;
        let profiles = case.profiles();
        let simulation =
            Simulation::new(scene, profiles.iter().map(String::as_str)).map_err(|error| error.to_string())?;
        let references = names(case).iter().map(|(name, _)| simulation.reference(name)).collect::<Result<_, _>>();
        Ok(Self { references: references.map_err(|error| error.to_string())?, simulation })
    }

    fn read(&mut self) -> Result<Vec<f64>, SimulationError> {
        let mut values = vec![0.0; self.references.len()];
        self.simulation.reals(&self.references, &mut values)?;
        Ok(values)
    }

    fn say(&mut self, case: &SpatialCase, step: usize, rates: bool) -> Result<(), SimulationError> {
        let Some(host) = &case.steps[step].host else { return Ok(()) };
        let mut all = vec![("shaft.speed".to_owned(), host.speeds[0][0], host.speeds[0][1])];
        if case.housing_hz.is_some() {
            all.push(("housing.speed".to_owned(), host.speeds[1][0], host.speeds[1][1]));
        }
        for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
            let motion = case.rings[which].motion;
            let free = if case.freedom == 5 && (which == 0 || motion == Motion::Host) { 5 } else { 3 };
            match motion {
                Motion::Internal => {}
                Motion::Fixed => continue,
                Motion::Host => {
                    let places = ["#x", "#y", "#z", "tilt.#x", "tilt.#y"];
                    for (place, moves) in places.into_iter().zip(host.rings[which]).take(free) {
                        for (order, value) in ["", "v", "a"].into_iter().zip(moves) {
                            all.push((format!("{name}.{}", place.replace('#', order)), value, 0.0));
                        }
                    }
                    continue;
                }
            }
            let inputs = ["load.x", "load.y", "load.z", "load_moment.x", "load_moment.y"];
            for (input, [value, rate, _]) in inputs.into_iter().zip(host.rings[which]).take(free) {
                all.push((format!("{name}.{input}"), value, rate));
            }
        }
        for (name, value, rate) in all {
            let reference = self.simulation.reference(&name)?;
            self.simulation.set_reals(&[reference], &[value])?;
            if rates && rate != 0.0 {
                self.simulation.set_input_derivatives(&[reference], &[1], &[rate])?;
            }
        }
        Ok(())
    }

    fn start(&mut self, case: &SpatialCase) -> Result<Vec<f64>, SimulationError> {
        self.say(case, 0, false)?;
        self.simulation.initialize(0.0)?;
        self.read()
    }

    fn step(&mut self, case: &SpatialCase, step: usize) -> Result<Vec<f64>, SimulationError> {
        self.say(case, step, true)?;
        self.simulation.step(case.steps[step].length)?;
        self.read()
    }
}

/// One unit of each kind, for the largest approach (m) so far.
fn units(bearing: &SpatialBearing, case: &SpatialCase, approach: f64) -> BTreeMap<Kind, f64> {
    let length = case.tolerance * (approach + 1e-7) + 1e-14 * bearing.rho_0;
    let velocity = 1e3 * case.tolerance * (approach + 1e-7) + 1e-11 * bearing.rho_0;
    let stiff = bearing.constants().into_iter().fold(0.0, f64::max) * 1.5 * approach.sqrt();
    let damped = match case.damping {
        crate::case::Damping::HuntCrossley(chi) => chi * stiff * approach / 1.5,
        crate::case::Damping::Proportional(tau) => tau * stiff,
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

fn largest_difference(names: &[(String, Kind)], a: &[f64], b: &[f64], into: &mut BTreeMap<Kind, f64>) {
    for (((_, kind), a), b) in names.iter().zip(a).zip(b) {
        let entry = into.entry(*kind).or_insert(0.0);
        *entry = entry.max((a - b).abs());
    }
}

/// What became of a scene: how much of it was judged, and why no more.
fn judge(case: &SpatialCase) -> Result<(f64, &'static str), String> {
    let bearing = SpatialBearing::new(case);
    let host = case.steps[0].host.as_ref();
    let balance = bearing.rest(host);
    let forces = |balance: &Balance| {
        balance.held.balls.iter().flat_map(|ball| ball.contacts).fold(0.0f64, |m, touch| m.max(touch.force))
    };
    // As much is left of what difference quotients say of balls without inertia.
    let found = balance.filter(|found| found.left.max(found.held.left) <= 3e-8 * forces(found));
    let mut subject = Subject::new(case)?;
    let first = match (subject.start(case), &found) {
        (Ok(first), Some(_)) => first,
        // One that the simulation finds and the oracle does not is judged by its residual elsewhere.
        (Ok(_) | Err(_), None) => return Ok((0.0, "no balance found")),
        (Err(error), Some(_)) => return Err(format!("refused, but there is a balance: {error}")),
    };
    let (names, state) = (names(case), found.as_ref().map(|found| found.state.clone()).unwrap_or_default());
    let run = |y: Vec<f64>, tolerance: f64| SpatialRun::new(&bearing, y, host, [0.0; 2], tolerance, BUDGET);
    let approach = |run: &SpatialRun<'_>| {
        run.acting.balls.iter().flat_map(|ball| ball.contacts).fold(1e-9f64, |m, touch| m.max(touch.approach))
    };
    let (mut fine, mut coarse) = (run(state.clone(), EXACT), run(state.clone(), 100.0 * EXACT));
    let mut largest = approach(&fine);
    let unit = units(&bearing, case, largest);
    let mut pushed = run(pushed(&bearing, state, unit[&Kind::Length]), 100.0 * EXACT);
    let (mut own, mut grown) = (BTreeMap::new(), BTreeMap::new());
    compare(&names, &first, &values(case, &fine), |kind| LIMIT * unit[&kind] + 1e-9)
        .map_err(|why| format!("at the start {why}"))?;
    let (mut time, mut judged) = (0.0, 0.0);
    for (i, step) in case.steps.iter().enumerate() {
        let steps = [&mut fine, &mut coarse, &mut pushed].map(|run| run.step(step.length, step.host.as_ref()));
        if steps.contains(&Err(Stop::Left)) {
            return match subject.step(case, i) {
                Ok(_) => Err(format!("step {i}: the oracle's balls leave")),
                Err(_) => Ok((judged, "balls leave")),
            };
        }
        if steps.iter().any(Result::is_err) {
            return Ok((judged, "too many steps for the oracle"));
        }
        largest = largest.max(approach(&fine));
        let expected = values(case, &fine);
        // Where a ball without inertia has no balance.
        if !expected.iter().all(|value| value.is_finite()) {
            return Ok((judged, "a ball without a balance"));
        }
        largest_difference(&names, &values(case, &coarse), &expected, &mut own);
        largest_difference(&names, &values(case, &pushed), &values(case, &coarse), &mut grown);
        let unit = units(&bearing, case, largest);
        let allowed = |kind: Kind| LIMIT * (unit[&kind] + own[&kind] + grown[&kind]) + 1e-9 * unit[&kind];
        let scale = fine.acting.balls.iter().flat_map(|ball| ball.contacts).fold(1e-3, |m, touch| touch.force.max(m));
        if allowed(Kind::Force) > HORIZON * scale {
            return Ok((judged, "chaos, or the oracle's own error"));
        }
        let sample = subject.step(case, i).map_err(|error| format!("step {i}: {error}"))?;
        compare(&names, &sample, &expected, allowed).map_err(|why| format!("step {i}: {why}"))?;
        time += step.length;
        judged = time / case.duration();
    }
    Ok((judged, "to its end"))
}

fn compare(
    names: &[(String, Kind)],
    sample: &[f64],
    expected: &[f64],
    allowed: impl Fn(Kind) -> f64,
) -> Result<(), String> {
    for (i, ((name, kind), (a, b))) in names.iter().zip(sample.iter().zip(expected)).enumerate() {
        let mut limit = allowed(*kind);
        if let Some(behind) = kind.behind_its_force() {
            let [force, of_sample] = [expected[i - behind], sample[i - behind]];
            if *kind == Kind::Angle && of_sample == 0.0 && *a != 0.0 {
                return Err(format!("{name} is {a:e} where the contact is open"));
            }
            // One that is just touched may as well be open.
            if force <= allowed(Kind::Force) {
                continue;
            }
            if *kind == Kind::Margin {
                limit += allowed(Kind::Force) / (3.0 * force);
            }
        }
        let off = (a - b).abs();
        if !(off <= limit) {
            return Err(format!("{name} is {a:e}, the oracle says {b:e}: {off:e} apart, allowed {limit:e}"));
        }
    }
    Ok(())
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
    for_seeds(300, |_, draw: &mut Draw| {
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
    assert!(drawn.values().all(|&count| count > 25), "hardly drawn: {drawn:?}");
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
