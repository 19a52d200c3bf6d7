//! Random scenes over the whole space of keys, and what a host may do with them.
//!
//! Quantities are drawn against each other: a load by the approach that it causes, a support by the contacts'
//! stiffness, a speed by how far it turns the cage in the time that can be computed. Otherwise most scenes would be
//! either rigid or broken.

pub mod draw;
mod inputs;
mod parts;
mod scale;
pub(crate) mod shape;
pub(crate) mod space;
mod uneven;

pub use shape::bowl;

use crate::bearing::Bearing;
use crate::case::{Case, Damping, Defect, Grooves, Motion, On, Ring, Step};
use crate::draw::Draw;
use inputs::Inputs;
use parts::{Elements, Wish};
use scale::Scale;
use shape::Around;
use space::Space;
use std::f64::consts::{PI, TAU};

/// What is counted.
#[derive(Debug, Clone, Default)]
pub struct Kind {
    pub on: &'static str,
    pub defect: &'static str,
    pub motion: &'static str,
    pub speed: &'static str,
    pub outer_ring: &'static str,
    pub elements: &'static str,
    pub bodies: &'static str,
}

/// Element contacts' time steps that an oracle's run may take.
const WORK: f64 = 3e5;
/// Phase of the fastest motion in one step of the oracle.
pub const PHASE: f64 = 0.03;

/// A random scene of the whole space.
pub fn random(draw: &mut Draw) -> (Kind, Case) {
    let parts_draw = draw.independent();
    scene(draw, Space::Whole, Some(parts_draw))
}

/// One of dry balls and plain sensors, as all were once; what failed then has its seed there.
pub fn of_dry_balls(draw: &mut Draw) -> (Kind, Case) {
    scene(draw, Space::Whole, None)
}

/// One whose defect is on an outer raceway at rest, as all were once; what failed then has its seed there.
pub fn on_the_outer_raceway(draw: &mut Draw) -> (Kind, Case) {
    scene(draw, Space::OuterRaceway, None)
}

/// What rolls and what lies between is drawn from `parts_draw`; dry balls without.
fn scene(draw: &mut Draw, space: Space, mut parts_draw: Option<Draw>) -> (Kind, Case) {
    let mut case = bearing(draw);
    let elements = parts_draw.as_mut().map_or(Elements::Balls, Elements::random);
    if let Some(parts_draw) = &mut parts_draw
        && elements == Elements::Rollers
    {
        parts::rollers(parts_draw, &mut case);
    }
    let scale = loads_and_damping(draw, &mut case);
    rings(draw, &mut case, &scale);
    if let Some(parts_draw) = &mut parts_draw {
        parts::add(parts_draw, &mut case, elements, &scale);
    }
    let (motion_of, rolls) = (motion_name(&case), parts::name(&case));
    let mut kind = Kind { on: "none", defect: "no defect", motion: motion_of, elements: rolls, ..Kind::default() };
    if draw.chance(0.8) {
        let on = space.body(draw, case.count);
        let (name, defect) = defect(draw, space, &scale, on, f64::INFINITY);
        (kind.on, kind.defect) = (space::body_name(defect.on), name);
        case.defects.push(defect);
        for _ in 0..space.more(draw) {
            more(draw, space, &scale, &mut case);
            kind.on = space::bodies_name(&case.defects);
        }
    }
    if let Some(parts_draw) = &parts_draw {
        kind.bodies = uneven::add(&mut parts_draw.independent(), &mut case, &scale);
    }
    case.cage_deg = draw.between(-180.0, 180.0);
    let way = space.way(draw, &mut case);
    kind.outer_ring = if case.housing_hz.is_some() { "outer ring turns" } else { "outer ring does not turn" };
    let time = time(&case, &scale) * draw.log(0.03, 1.0);
    let wish = parts_draw.as_mut().map(|parts_draw| Wish::random(parts_draw, &case)).unwrap_or_default();
    kind.speed = motion(draw, &mut case, &scale, time, (way, wish));
    (kind, case)
}

/// Straight rollers as a user has them: loose on the unloaded side, turning slowly. Whoever asks has a damping and an
/// angle of the cage for them.
pub fn slow_straight_rollers(draw: &mut Draw) -> Case {
    let (count, diameter_mm) = (5 + draw.below(16), draw.log(3.0, 30.0));
    let load = draw.log(30.0, 3000.0);
    let shaft = Ring { motion: Motion::Internal, load: [0.0, -load], mass: 3.0, damping: 1400.0, stiffness: 0.0 };
    let mut case = Case {
        gravity: [0.0, -9.81],
        count,
        diameter_mm,
        pitch_mm: diameter_mm * draw.between(1.05, 1.5) / (PI / count as f64).sin(),
        clearance_um: draw.log(1.0, 60.0),
        rings: [shaft, Ring::FIXED],
        speed_hz: draw.log(0.5, 8.0) * draw.sign(),
        steps: vec![Step { length: 1e-6, host: None }],
        ..Case::at_rest()
    };
    parts::rollers(draw, &mut case);
    case.roller.iter_mut().for_each(|roller| roller.crowned = false);
    case
}

/// A defect of a body that is no longer than so much (m).
fn defect(draw: &mut Draw, space: Space, scale: &Scale, on: On, most: f64) -> (&'static str, Defect) {
    let around = Around { r: scale.r, bearer: scale.bearer(on), on, most, approach: scale.approach };
    let (name, shape) = match space.topography(draw) {
        true => ("topography", shape::topography(draw, &around)),
        false => shape::random(draw, &around),
    };
    let mut defect = Defect { on, angle_deg: draw.between(-180.0, 180.0), shape };
    if !scale.rollers {
        space.tilt(draw, &mut defect, scale.r);
    }
    (name, defect)
}

/// One more defect, of any body or beside the last one.
fn more(draw: &mut Draw, space: Space, scale: &Scale, case: &mut Case) {
    let last = case.defects[case.defects.len() - 1].clone();
    let beside = draw.chance(0.6);
    let on = if beside { last.on } else { space.body(draw, case.count) };
    let (_, mut defect) = defect(draw, space, scale, on, scale.r);
    if beside {
        let bearer = scale.bearer(on);
        let gap = draw.log(1e-3, 2.0) * scale.r;
        let away = 0.5 * (last.shape.length(bearer) + defect.shape.length(bearer)) + gap;
        defect.angle_deg = last.angle_deg + (away / bearer).to_degrees() * draw.sign();
    }
    case.defects.push(defect);
}

fn bearing(draw: &mut Draw) -> Case {
    let count = match draw.below(10) {
        0 => 1 + draw.below(3),
        1 => 30 + draw.below(31),
        _ => 3 + draw.below(20),
    };
    let diameter_mm = if draw.chance(0.9) { draw.log(1.0, 60.0) } else { draw.log(0.05, 1000.0) };
    let clearance = match draw.below(6) {
        0 => 0.0,
        1 => -draw.between(0.0, 0.0075),
        2 => draw.log(1e-3, 1.0 / 3.0),
        _ => draw.log(1e-5, 3e-3),
    } * diameter_mm;
    // Elements do not overlap, and the inner raceway has a radius.
    let chord = if count > 1 { diameter_mm / (PI / count as f64).sin() } else { 0.0 };
    let smallest = chord.max(1.3 * (diameter_mm + clearance));
    let conformity = |draw: &mut Draw| match draw.below(10) {
        0 => draw.log(0.5001, 0.505),
        1 => draw.log(0.6, 20.0),
        _ => draw.between(0.505, 0.56),
    };
    let grooves = if draw.chance(0.5) {
        Grooves::Equal(conformity(draw) * 2.0 * diameter_mm)
    } else {
        Grooves::Each(conformity(draw), conformity(draw))
    };
    let usual = draw.chance(0.5);
    let density = if usual { 7800.0 } else { draw.log(500.0, 2e4) };
    let mass_g = draw.chance(0.2).then(|| density * PI / 6.0 * diameter_mm.powi(3) * 1e-6 * draw.log(0.1, 10.0));
    Case {
        gravity: match draw.below(4) {
            0 => [0.0; 2],
            1 => {
                let size = draw.log(0.1, 1e3);
                draw.vector(size)
            }
            _ => [0.0, -9.81],
        },
        count,
        diameter_mm,
        pitch_mm: smallest * if draw.chance(0.5) { draw.between(1.001, 1.3) } else { draw.log(1.001, 5.0) },
        grooves,
        clearance_um: clearance * 1e3,
        modulus_gpa: if usual { 207.0 } else { draw.log(1.0, 1000.0) },
        poisson: if usual { 0.3 } else { draw.between(-0.5, 0.49) },
        // Of every fourth bearing, without a draw of its own: silicon nitride.
        element: (count % 4 == 3).then_some([310.0, 0.26]),
        density: (mass_g.is_none() || draw.chance(0.5)).then_some(density),
        mass_g,
        hertz: [0, 1].map(|_| draw.chance(0.1).then(|| draw.log(1e8, 1e11))),
        slip: if draw.chance(0.7) { 0.0 } else { draw.between(0.0, 1.0) },
        tolerance: draw.pick(&[1e-5, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9]),
        ..Case::at_rest()
    }
}

fn loads_and_damping(draw: &mut Draw, case: &mut Case) -> Scale {
    let r = case.diameter_mm * 0.5e-3;
    let approach = r * draw.log(1e-5, 4e-3);
    let bearing = Bearing::smooth(case);
    let [k_i, k_o] = [0, 1].map(|side| bearing.growth[side].force(0.5 * approach)[1]);
    let stiffness = k_i * k_o / (k_i + k_o);
    let omega = ((k_i + k_o) / bearing.mass).sqrt();
    case.compliance = if draw.chance(0.7) { 0.0 } else { draw.log(1e-3, 10.0) / k_o };
    case.damping = if draw.chance(0.6) {
        // Up to where the damper's rate is ten times the element's frequency.
        let strong = 10.0 * bearing.mass * omega / (k_i * approach);
        Damping::HuntCrossley(if draw.chance(0.15) { 0.0 } else { draw.log(1e-3, 1.0) * strong.min(100.0) })
    } else {
        Damping::Proportional(if draw.chance(0.15) { 0.0 } else { (draw.log(1e-3, 3.0) / omega).min(1.0) })
    };
    let inner = bearing.rho_0 - bearing.clearance - r;
    let rollers = case.roller.is_some();
    Scale { r, rollers, raceway: bearing.rho_0 + r, inner, approach, stiffness, mass: bearing.mass, omega }
}

/// What moves the rings, and with what.
fn rings(draw: &mut Draw, case: &mut Case, scale: &Scale) {
    use Motion::{Fixed, Host, Internal};
    let motions =
        [(Internal, Internal), (Internal, Fixed), (Host, Internal), (Internal, Host), (Host, Host), (Host, Fixed)];
    let (shaft, housing) = draw.pick(&motions);
    let force = scale.stiffness * scale.approach / 1.5 * (case.count as f64 / 5.0).max(1.0);
    for (which, motion) in [shaft, housing].into_iter().enumerate() {
        let mut ring = Ring { motion, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 };
        if motion == Internal {
            if which == 0 || draw.chance(0.3) {
                let size = if draw.chance(0.1) { 0.0 } else { force * draw.log(0.1, 1.0) };
                ring.load = draw.vector(size);
            }
            ring.mass = (scale.mass * draw.log(2.0, 1e5)).max(1e-6);
            // A ring is held, if by nothing else than the other one.
            let held = which == 1 || housing != Internal && draw.chance(0.3) || draw.chance(0.2);
            if held {
                ring.stiffness = scale.stiffness * draw.log(1e-3, 10.0);
            }
            let critical = 2.0 * ((ring.stiffness + scale.stiffness) * ring.mass).sqrt();
            ring.damping = if draw.chance(0.2) { 0.0 } else { critical * draw.log(1e-3, 2.0) };
        }
        case.rings[which] = ring;
    }
    if housing != Fixed && draw.chance(0.4) {
        let mass = scale.mass * draw.log(1.0, 1e3);
        let frequency = scale.omega * draw.log(0.01, 1.0);
        let stiffness = mass * frequency * frequency;
        case.sensor = Some([mass, stiffness, 2.0 * mass * frequency * draw.log(1e-3, 0.5)]);
    }
}

fn motion_name(case: &Case) -> &'static str {
    match case.rings.map(|ring| ring.motion) {
        [Motion::Internal, Motion::Internal] => "both internal",
        [Motion::Internal, Motion::Fixed] => "shaft internal, housing fixed",
        [Motion::Internal, Motion::Host] => "shaft internal, housing hosted",
        [Motion::Host, Motion::Internal] => "shaft hosted, housing internal",
        [Motion::Host, Motion::Host] => "both hosted",
        _ => "shaft hosted, housing fixed",
    }
}

/// Largest angular frequency or rate of decay (1/s) of a case under its loads.
pub fn fastest(case: &Case, approach: [f64; 2]) -> f64 {
    let bearing = Bearing::smooth(case);
    let turns = case.steps.iter().filter_map(|step| step.host).flat_map(|host| host.speeds.map(|[speed, _]| speed));
    let speed = turns.chain(bearing.speeds).fold(0.0f64, |most, speed| most.max(speed.abs()));
    let (mut stiff, mut damped) = (0.0, 0.0);
    for side in 0..2 {
        let [force, k] = bearing.growth[side].force(approach[side].max(0.0));
        stiff += k;
        damped += match case.damping {
            Damping::HuntCrossley(chi) => chi * force,
            Damping::Proportional(tau) => tau * k,
        };
        damped += bearing.oil.as_ref().map_or(0.0, |oil| oil.strongest(side));
    }
    let loaded = (case.count as f64 / 3.0).max(1.0);
    let mut rate = ((stiff / bearing.mass).sqrt() + damped / bearing.mass).max(bearing.ripple(2.0 * speed));
    for ring in case.rings.iter().filter(|ring| ring.motion == Motion::Internal) {
        let own = ((ring.stiffness + loaded * stiff) / ring.mass).sqrt() + (ring.damping + loaded * damped) / ring.mass;
        rate = f64::max(rate, own);
    }
    if let Some([mass, stiffness, damping]) = case.sensor {
        let mass = if case.rings[1].motion == Motion::Internal { mass.min(case.rings[1].mass) } else { mass };
        rate = rate.max((stiffness / mass).sqrt() + damping / mass);
    }
    case.modes.iter().fold(rate, |rate, mode| rate.max(TAU * mode.frequency_hz * (1.0 + 2.0 * mode.damping_ratio)))
}

/// Time (s) that an oracle of the usual step can go through.
fn time(case: &Case, scale: &Scale) -> f64 {
    let rate = fastest(case, [scale.approach; 2]);
    WORK / case.count as f64 * PHASE / rate
}

/// Speeds, steps and inputs for a run of so many seconds, in which the rings turn in these proportions.
fn motion(draw: &mut Draw, case: &mut Case, scale: &Scale, time: f64, (way, wish): ([f64; 2], Wish)) -> &'static str {
    let past = Bearing::smooth(case).past(case.defects.first().map(|defect| defect.on), way);
    // As far as the defect is long, or a part of it.
    let bearer = case.defects.first().map_or(scale.raceway, |defect| scale.bearer(defect.on));
    let length = case.defects.first().map_or(scale.r, |defect| defect.shape.length(bearer));
    let travel = length / bearer * draw.log(0.05, 3.0);
    let faster = way[0].abs().max(way[1].abs());
    let size = (travel / time / past.abs().max(1e-6)).min(0.9 * TAU * 1e4 / faster) * draw.sign();
    // One element near one end of the defect, on its way in.
    if let Some(Defect { on, angle_deg, .. }) = case.defects.first().cloned()
        && draw.chance(0.8)
    {
        let half = (0.5 * length / bearer).min(PI);
        let at = -(size * past).signum() * half * draw.between(0.0, 1.3);
        let element = draw.below(case.count) as f64 * 360.0 / case.count as f64;
        match on {
            On::Outer => case.cage_deg = case.rings_deg[1] + angle_deg + at.to_degrees() - element,
            On::Inner => case.cage_deg = case.rings_deg[0] + angle_deg + at.to_degrees() - element,
            // With its outer or its inner side; the element's own frame turns with its centre's direction.
            On::Element { .. } => {
                let there = if draw.chance(0.5) { 0.0 } else { 180.0 } - at.to_degrees();
                case.defects.iter_mut().filter(|d| d.on.is_body_of(on)).for_each(|d| d.angle_deg += there - angle_deg);
            }
        }
    }
    let standing = draw.chance(0.05);
    let size = if standing { 0.0 } else { wish.size.unwrap_or(size) };
    case.speed_hz = size * way[0] / TAU;
    case.housing_hz = case.housing_hz.map(|_| size * way[1] / TAU);
    let count = 2 + draw.below(12);
    // Short steps first: bounces let nobody say much about the last.
    let shares: Vec<f64> = (0..count).map(|i| draw.log(0.05, 1.0) * (0.1 + i as f64)).collect();
    let whole: f64 = shares.iter().sum();
    let lengths: Vec<f64> = shares.into_iter().map(|share| time * share / whole).collect();
    let ways = ["steady", "steady", "ramp", "reversal", "jumps"];
    let drawn = if standing { "standing" } else { draw.pick(&ways) };
    let way = wish.way.filter(|_| !standing).unwrap_or(drawn);
    let mut inputs = Inputs::new(draw, case, scale, time);
    for (i, length) in lengths.into_iter().enumerate() {
        let silent = i > 0 && draw.chance(0.2);
        let host = inputs.next(draw, way, length);
        case.steps.push(Step { length, host: (!silent).then_some(host) });
    }
    way
}
