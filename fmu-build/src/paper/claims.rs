//! What the paper claims, beside what comes out here, and apart from that what our own prototype gave: an independent
//! program with the same equations, for what the paper shows as a curve without a number.

use std::fmt::Write;

use anyhow::Result;
use brinell::geometry::hertz_constant::HertzConstants;
use brinell::geometry::kinematics::frequencies;
use brinell::scene::{Bearing, ContactLaw};
use serde::Serialize;

use super::averages::{averaged, rings};
use super::{Case, Epps, FourEvents, Passage, passage, statics};
use crate::shared::Project;

/// Figures of the paper that are read off a curve, and those of another program with rounded input (share).
const READ_OFF: f64 = 0.05;

/// Whether a claim holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// It does.
    Yes,
    /// It does not.
    No,
    /// Nothing is claimed: for orientation.
    Shown,
}

/// One claim.
#[derive(Debug, Clone, Serialize)]
pub struct Claim {
    /// What is claimed.
    pub claim: String,
    /// What comes out here.
    pub here: String,
    /// What the paper says.
    pub paper: Option<Beside>,
    /// What the prototype gave.
    pub prototype: Option<Beside>,
}

/// What is said elsewhere, and whether it agrees with what comes out here.
#[derive(Debug, Clone, Serialize)]
pub struct Beside {
    /// What is said.
    pub said: String,
    /// Whether that agrees.
    pub holds: Outcome,
}

impl Beside {
    fn new(said: &str, holds: bool) -> Option<Self> {
        let holds = if holds { Outcome::Yes } else { Outcome::No };
        Some(Self { said: said.to_owned(), holds })
    }
}

impl Claim {
    fn new(claim: &str, paper: &str, here: String, holds: bool) -> Self {
        Self { claim: claim.to_owned(), here, paper: Beside::new(paper, holds), prototype: None }
    }

    fn of_prototype(claim: &str, said: &str, here: String, holds: bool) -> Self {
        Self { claim: claim.to_owned(), here, paper: None, prototype: Beside::new(said, holds) }
    }

    fn shown(claim: &str, paper: &str, here: String) -> Self {
        let paper = Some(Beside { said: paper.to_owned(), holds: Outcome::Shown });
        Self { claim: claim.to_owned(), here, paper, prototype: None }
    }

    /// The same, which the prototype gave as well.
    fn and_prototype(self, said: &str, holds: bool) -> Self {
        Self { prototype: Beside::new(said, holds), ..self }
    }
}

fn near(value: f64, expected: f64) -> bool {
    (value / expected - 1.0).abs() <= READ_OFF
}

/// Whether a frequency (Hz) is one that is said to the nearest hundred.
fn is_about(value: f64, hundreds: f64) -> bool {
    (value - hundreds).abs() <= 50.0
}

/// Claims one below the other, for reading.
pub(super) fn table(claims: &[Claim]) -> String {
    let mut text = String::new();
    for Claim { claim, here, paper, prototype } in claims {
        let _ = writeln!(text, "{claim}\n    here:      {here}");
        for (whose, beside) in [("paper:    ", paper), ("prototype:", prototype)] {
            let Some(Beside { said, holds }) = beside else { continue };
            let holds = match holds {
                Outcome::Yes => "holds",
                Outcome::No => "DOES NOT HOLD",
                Outcome::Shown => "not judged",
            };
            let _ = writeln!(text, "    {whose} {said} – {holds}");
        }
    }
    text
}

/// Figure 1. The first of the found is under law `map`. Numbers of the floor and of the load's return are those of the
/// paper's section 5.2.
pub(super) fn four_events(found: Vec<(FourEvents, Passage)>, project: &Project) -> Result<Vec<Claim>> {
    let [(e, passage), (hertz, _)] = &found[..] else { return Ok(Vec::new()) };
    let ms =
        |map: f64, hertz: f64| format!("{:.2} ms after the leading edge (law hertz: {:.2})", 1e3 * map, 1e3 * hertz);
    let thrown = passage.mean_acceleration(0.0, e.free);
    let case = Case::shipped("er16k-tb1")?;
    let after = rings(&case, &averaged(project, &case)?).map_or(f64::NAN, |rings| rings.after_exit);
    let chatter = format!(
        "{:.2} to {:.2} ms (law hertz: {:.2} to {:.2})",
        1e3 * e.reload,
        1e3 * e.settled,
        1e3 * hertz.reload,
        1e3 * hertz.settled
    );
    let as_prototype = (e.reload - 10.1e-3).abs() < 0.2e-3 && (e.settled - 10.6e-3).abs() < 0.2e-3;
    Ok(vec![
        Claim::new(
            "Event 1: an element enters; a low-frequency step",
            "negative there, its axis pointing with the load",
            format!("housing {thrown:+.1} m/s² upwards until the element is free"),
            thrown > 0.0,
        ),
        Claim::of_prototype(
            "Event 2: it has lost its load",
            "after 0.6 ms",
            ms(e.free, hertz.free),
            (e.free - 0.6e-3).abs() < 0.05e-3,
        ),
        Claim::new(
            "Event 3: between the raceways it reaches the floor and strikes it, weakly, if at all",
            "weak",
            format!("first strike {}", ms(e.floor, hertz.floor)),
            e.floor > e.free && e.floor < e.reload,
        ),
        Claim::new(
            "Event 4: it takes up its load again at the trailing edge, with chatter, before its centre is there",
            "re-loaded before it leaves",
            chatter,
            e.reload < e.exit && e.settled < e.exit,
        )
        .and_prototype("10.1 to 10.6 ms", as_prototype),
        Claim::of_prototype(
            "It leaves loaded, and swings of the rings load it further",
            "11.0 ms, then up to ≈ 400 N",
            format!(
                "centre over the trailing edge at {:.1} ms, up to {:.0} N at {:.1} ms (law hertz: {:.0} N)",
                1e3 * e.exit,
                e.peak,
                1e3 * e.peak_at,
                hertz.peak
            ),
            near(e.exit, 11.0e-3) && e.peak_at > e.exit && near(e.peak, 400.0),
        ),
        Claim::new(
            "After it the rings ring near 1000 Hz",
            "≈ 1000 Hz",
            format!("{after:.0} Hz, 24 passages averaged"),
            is_about(after, 1000.0),
        ),
    ])
}

/// Figure 4.
pub(super) fn profile(case: &Case) -> Result<Vec<Claim>> {
    let (_, [arc, depth, path]) = passage::profile(case, passage::AROUND)?;
    let drop = path.iter().copied().fold(0.0, f64::max);
    let middle = path.iter().zip(&arc).find(|(path, _)| **path == drop).map_or(f64::NAN, |(_, arc)| *arc);
    let deepest = depth.iter().copied().fold(0.0, f64::max);
    let stand_in = "measured, not published";
    Ok(vec![
        Claim::shown(
            "Profile of the etched spall",
            stand_in,
            format!("a stand-in: 0.8 mm long, {:.0} µm deep, rough as assumed", 1e6 * deepest),
        ),
        Claim::of_prototype(
            "A rigid element never reaches the floor: its path has a cusp in the middle, where it touches both edges",
            "drop 16.8 µm (90° edges)",
            format!("drop {:.1} µm at {:+.0} µm from the middle", 1e6 * drop, 1e6 * middle),
            near(drop, 16.8e-6) && drop < deepest && middle.abs() < 20e-6,
        ),
    ])
}

/// Figure 5. The first of the found is under law `map`. The paper prints what was measured on; of its curves no figure
/// is known here.
pub(super) fn epps(case: &Case, found: &[Epps]) -> Result<Vec<Claim>> {
    let [map, hertz] = found else { return Ok(Vec::new()) };
    let hz = |rings: Option<f64>| rings.unwrap_or(f64::NAN);
    let force = |e: &Epps| format!("{:.0} → {:.0} → {:.0} N", e.force[0], e.force[1], e.force[2]);
    let (_, [arc, depth, _]) = passage::profile(case, passage::AROUND)?;
    let below = || arc.iter().zip(&depth).filter(|(_, depth)| **depth > 0.0).map(|(arc, _)| *arc);
    let length = below().fold(f64::MIN, f64::max) - below().fold(f64::MAX, f64::min);
    let load = -case.scene.shaft.load[1];
    let (least, half) = map.unloaded_and_loaded();
    let thrown = map.passage.mean_acceleration(0.0, least);
    let [entering, loaded] = [(0.0, least), (least, 1.5 * map.traverse)].map(|(a, b)| map.passage.shaken(a, b));
    Ok(vec![
        Claim::new(
            "What Epps measured on: an etched spall in the outer raceway of a 6205",
            "0.8 mm long, 1500 N, 25 Hz",
            format!("{:.2} mm (a stand-in), {load:.0} N, {:.0} Hz", 1e3 * length, case.shaft_speed()),
            near(length, 0.8e-3) && near(load, 1500.0) && near(case.shaft_speed(), 25.0),
        ),
        Claim::new(
            "An element passes 0.8 mm at the cage's speed, from edge to edge",
            "0.54 ms follows from that, without slip",
            format!("{:.2} ms", 1e3 * map.traverse),
            near(map.traverse, 0.54e-3),
        ),
        Claim::new(
            "Event 1: the element enters; a step of the housing away from the load",
            "negative there, its axis pointing with the load",
            format!(
                "{thrown:+.1} m/s² upwards in the mean, until the force is least {:.2} ms after the edge",
                1e3 * least
            ),
            thrown > 0.0,
        ),
        Claim::new(
            "Event 4: it takes up its load again, which shakes the housing more than the entry; 2 and 3 do not come, \
             as the floor is out of reach",
            "re-loading is an event of its own",
            format!(
                "half its force again {:.2} ms after the edge; up to {loaded:.0} m/s² from the least force on, \
                 {entering:.0} before",
                1e3 * half
            ),
            map.force[1] > 0.0 && least < half && half < 1.2 * map.traverse && loaded > entering,
        ),
        Claim::of_prototype(
            "Force of the outer raceway: before, least, as the load is taken up again",
            "780 → 99 → 1281 N (90° edges)",
            format!("{} (law hertz: {})", force(map), force(hertz)),
            near(map.force[0], 780.0) && near(map.force[2], 1281.0) && near(hertz.force[1], 99.0),
        ),
        Claim::of_prototype(
            "The path of the loaded element is deeper than that of a rigid one, by its approach",
            "16.8 µm for the rigid one",
            format!("{:.1} µm (law hertz: {:.1}), rigid {:.1}", 1e6 * map.deepest, 1e6 * hertz.deepest, 1e6 * map.drop),
            map.deepest > map.drop && near(map.drop, 16.8e-6),
        ),
        Claim::of_prototype(
            "Ringing after the spall",
            "1174 Hz",
            format!("{:.0} Hz (law hertz: {:.0})", hz(map.rings), hz(hertz.rings)),
            near(hz(map.rings), 1174.0),
        ),
        Claim::shown(
            "Acceleration, path and force over the spall",
            "curves; the sensor and the housing behind them are not given",
            "the same signals in paper-fig5.csv, under both laws".to_owned(),
        ),
    ])
}

/// Figure 6: TB1, TB2 at 500 and 600 N, and the same 30 µm deep.
pub(super) fn averages(found: &[[f64; 2]]) -> Vec<Claim> {
    let [tb1, low, high, shallow_low, shallow_high] = found else { return Vec::new() };
    // Elements stiffen as F^(1/3), rings ring as the root of that: 3 % of 500 to 600 N are the load's own.
    let rises = |low: &[f64; 2], high: &[f64; 2]| high[0] / low[0] > 1.1;
    let both = |low: &[f64; 2], high: &[f64; 2]| format!("{:.0} → {:.0} Hz after the entry", low[0], high[0]);
    let rings = |spall: &str, after: &str, value: f64, paper: f64| {
        let claim = format!("{spall}, 500 N: the rings ring near {paper:.0} Hz after the {after}");
        Claim::new(&claim, &format!("≈ {paper:.0} Hz"), format!("{value:.0} Hz"), is_about(value, paper))
    };
    vec![
        rings("Line spall (TB1)", "entry", tb1[0], 1000.0),
        rings("Line spall (TB1)", "exit", tb1[1], 1000.0),
        rings("Extended spall (TB2)", "entry", low[0], 600.0),
        rings("Extended spall (TB2)", "exit", low[1], 600.0),
        Claim::new(
            "From 500 to 600 N TB2's frequency rises, at the nominal depth of 100 µm",
            "rises",
            both(low, high),
            rises(low, high),
        ),
        Claim::new(
            "The same with an effective depth of 30 µm, assumed",
            "rises",
            both(shallow_low, shallow_high),
            rises(shallow_low, shallow_high),
        ),
    ]
}

/// The test bearings.
pub(super) fn test_bearings() -> Result<Vec<Claim>> {
    let mut claims = Vec::new();
    let spacing = |case: &Case| 360.0 / case.scene.bearing.element_count as f64;
    for (name, scene, kind, expected) in
        [("TB1", "er16k-tb1", "line", [56.5, 77.0, 88.8]), ("TB2", "er16k-tb2", "extended", [27.8, 47.3, 58.6])]
    {
        let case = Case::shipped(scene)?.with_law(ContactLaw::Hertz);
        let length = case.length();
        let is = if length < spacing(&case) { "line" } else { "extended" };
        claims.push(Claim::new(
            &format!("{name}: {kind} spall"),
            if name == "TB1" { "15.8°" } else { "55.8°" },
            format!("{length:.1}°, elements {:.0}° apart: {is}", spacing(&case)),
            is == kind,
        ));
        let found = statics::stiffness(&case)?;
        let shown = |k: [f64; 3]| k.map(|k| format!("{k:.1}")).join(" / ");
        claims.push(Claim::of_prototype(
            &format!("{name}: stiffness along the load over the cage angle, 500 N: least / mean / greatest (N/µm)"),
            &shown(expected),
            shown(found),
            found.iter().zip(expected).all(|(&found, expected)| near(found, expected)),
        ));
    }
    for (label, scene) in [("at the nominal depth of 100 µm", "er16k-tb2"), ("30 µm deep, assumed", "er16k-tb2-30um")]
    {
        let load = statics::critical_load(&Case::shipped(scene)?.with_law(ContactLaw::Hertz))?;
        claims.push(Claim::new(
            &format!("TB2 {label}: elements on the floor carry again between 500 and 600 N"),
            "500 to 600 N",
            load.map_or("never".to_owned(), |load| format!("{load:.0} N")),
            load.is_some_and(|load| (500.0..600.0).contains(&load)),
        ));
    }
    Ok(claims)
}

/// The bearing's dimensions.
pub(super) fn dimensions() -> Result<Vec<Claim>> {
    let case = Case::shipped("er16k-tb1")?;
    let bearing: &Bearing = &case.scene.bearing;
    let constants = HertzConstants::of(bearing);
    let bpfo = frequencies(bearing, 0.0, 10.0).bpfo;
    let mass = 1e3 * bearing.mass_of_element();
    let groove = 2e3 * bearing.element_diameter * bearing.conformity_outer;
    let exactly = |name: &str, paper: f64, here: f64| {
        Claim::new(name, &format!("{paper}"), format!("{here:.4}"), (here / paper - 1.0).abs() < 1e-9)
    };
    let k = [constants.inner, constants.outer, constants.in_series()];
    Ok(vec![
        exactly("Elements", 9.0, bearing.element_count as f64),
        exactly("Diameter of an element (mm)", 7.94, 1e3 * bearing.element_diameter),
        exactly("Pitch diameter (mm)", 39.32, 1e3 * bearing.pitch_diameter),
        exactly("Diameter of the grooves (mm)", 8.19, groove),
        Claim::of_prototype(
            "Hertz constants inner / outer / in series (N/m^1.5)",
            "2.770e10 / 2.929e10 / 1.007e10",
            k.map(|k| format!("{k:.3e}")).join(" / "),
            k.iter().zip([2.770e10, 2.929e10, 1.007e10]).all(|(k, paper)| (k / paper - 1.0).abs() < 5e-4),
        ),
        Claim::of_prototype("Mass of an element (g)", "2.044", format!("{mass:.3}"), (mass - 2.044).abs() < 5e-4),
        Claim::new("BPFO at 10 Hz (Hz)", "35.9", format!("{bpfo:.2}"), (bpfo - 35.9).abs() < 0.05),
    ])
}
