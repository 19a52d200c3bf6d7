//! Second derivatives of the equivalent approach near a defect: against differences of its exact first derivatives.
//!
//! Slopes are continuous and their derivatives step: of a map from cell to cell, of a grid where a cell comes to carry
//! or ceases to. A point is left out where such a step lies between the points of its differences, which shows in them
//! alone: differences over h, h/2 and h/4, extrapolated two by two (Richardson), do not agree then. Below its smallest
//! contact law `love` leaps by some per cent of the slope itself, whichever side of that contact rounding finds; such a
//! point is left out where its slope is not between its neighbours'. How many points may be left out is limited.

use std::cell::RefCell;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use crate::er16k::{INNER, OUTER};
use crate::nu205;
use brinell::contact::element_on_raceway::ElementOnRaceway;
use brinell::contact::equivalent::SecondDerivatives;
use brinell::contact::love::{EdgeSoftness, LoveContact, Resolution};
use brinell::contact::map::{MapPlan, MapSpecification};
use brinell::contact::near_defect::{LoveSolvers, NearDefect, NearLove, NearMap};
use brinell::contact::rolled_path::RigidPath;
use brinell::contact::rolling::{RacewaySide, Rolling};
use brinell::numerics::number::Dual;
use brinell::scene::Bearing;
use brinell::surface::{Profile, Surface};

const LARGEST: f64 = 10e-6;
const DISTANCE: f64 = 19.7e-3;
/// Steps of differences along the path and along the raceway (m): a change of the pressed cells is some 1e-8 m of path
/// and 1e-7 m of raceway away from the next.
const STEPS: [f64; 2] = [1e-9, 1e-8];

/// A law on a surface of this radius (m).
struct Near {
    law: NearDefect,
    radius: f64,
    solvers: RefCell<LoveSolvers>,
}

impl Near {
    fn new(law: NearDefect, radius: f64) -> Self {
        Self { law, radius, solvers: RefCell::default() }
    }

    fn cell(&self, s: f64) -> usize {
        self.law.knots().partition_point(|&knot| knot * self.radius <= s).clamp(1, self.law.knots().len() - 1) - 1
    }

    /// Δ, ∂Δ/∂u and ∂Δ/∂s in a cell.
    fn first(&self, cell: usize, u: f64, s: f64) -> Option<[f64; 3]> {
        let found = self.law.approach(cell, u, s / self.radius, DISTANCE, true, &mut self.solvers.borrow_mut()).ok()?;
        Some([found.value, found.by_path, found.by_angle / self.radius])
    }

    fn second(&self, cell: usize, u: f64, s: f64) -> Option<SecondDerivatives> {
        let dual = Dual::<f64, 2>::variable;
        let (u, angle) = (dual(u, 0), dual(s / self.radius, 1));
        let found =
            self.law.approach(cell, u, angle, Dual::from(DISTANCE), true, &mut self.solvers.borrow_mut()).ok()?;
        let ([uu, us], [_, ss]) = (found.by_path.by, found.by_angle.by);
        Some(SecondDerivatives { uu, us: us / self.radius, ss: ss / (self.radius * self.radius) })
    }
}

/// Derivative of a function at 0 from central differences over `step` and its parts. `None` where they do not agree to
/// `limit`: a step of the derivative lies between them, or of the function.
fn derivative<const N: usize>(step: f64, limit: f64, mut f: impl FnMut(f64) -> Option<[f64; N]>) -> Option<[f64; N]> {
    let mut over = [[0.0; N]; 3];
    for (k, out) in over.iter_mut().enumerate() {
        let h = step / f64::from(1 << k);
        let (after, before) = (f(h)?, f(-h)?);
        *out = std::array::from_fn(|n| (after[n] - before[n]) / (2.0 * h));
    }
    let [long, short] = [0, 1].map(|k| std::array::from_fn::<f64, N, _>(|n| (4.0 * over[k + 1][n] - over[k][n]) / 3.0));
    let (here, beside) = (f(0.0)?, f(0.25 * step)?);
    let leaps = |n: usize| (beside[n] - here[n]).abs() > 0.25 * step * (2.0 * long[n].abs() + limit);
    (0..N).all(|n| (long[n] - short[n]).abs() <= limit && !leaps(n)).then_some(long)
}

/// What became of the points of a test.
#[derive(Debug, Default)]
struct Points {
    compared: usize,
    /// Of them on the continuation below the smallest contact.
    continued: usize,
    left_out: usize,
}

fn agree(at: [f64; 2], found: f64, expected: f64, limit: f64) {
    assert!((found - expected).abs() <= limit, "at {at:?}: {found:e}, by differences {expected:e}, limit {limit:e}");
}

/// Compares at points that fill the raceway and the path above the first touch evenly. `rounding` is that of slopes.
fn compare(near: &Near, first_touch: impl Fn(f64) -> f64, count: usize, rounding: f64) -> Points {
    let ends = [near.law.knots()[0], near.law.knots()[near.law.knots().len() - 1]].map(|angle| angle * near.radius);
    let mut points = Points::default();
    for n in 0..count {
        let [q, t] = crate::spread(n);
        let s = ends[0] + q * (ends[1] - ends[0]);
        let (u, cell) = (first_touch(s) + (1.7 * t - 0.2) * LARGEST, near.cell(s));
        let (Some([value, ..]), Some(second)) = (near.first(cell, u, s), near.second(cell, u, s)) else { continue };
        let size = second.uu.abs().max(second.us.abs()).max(second.ss.abs());
        // Rounding of differences over a quarter of a step, extrapolated: 4/3 × 4 × rounding/step.
        let [by_u, by_s] = STEPS.map(|step| 6.0 * rounding / step + 1e-9 * size);
        let along_u = |h: f64| near.first(cell, u + h, s).map(|[_, du, ds]| [du, ds]);
        let along_s = |h: f64| near.first(cell, u, s + h).map(|[_, du, ds]| [du, ds]);
        let (Some(along_u), Some(along_s)) = (derivative(STEPS[0], by_u, along_u), derivative(STEPS[1], by_s, along_s))
        else {
            points.left_out += 1;
            continue;
        };
        points.compared += 1;
        agree([u, s], second.uu, along_u[0], 2.0 * by_u);
        agree([u, s], second.us, along_s[0], 2.0 * by_s);
        if matches!(near.law, NearDefect::Love(_)) && second.uu == 0.0 && second.us != 0.0 {
            assert!(value < 0.1 * LARGEST, "{value:e}: no contact is continued up to there");
            points.continued += 1;
            continue;
        }
        agree([u, s], second.us, along_u[1], 2.0 * by_u);
        agree([u, s], second.ss, along_s[1], 2.0 * by_s);
    }
    points
}

/// A shallow dent of which elements touch the floor, as if it were measured.
fn dent() -> Surface {
    let depth = |s: f64| {
        let flank = ((0.35e-3 - s.abs()) / 0.1e-3).clamp(0.0, 1.0);
        flank * (8e-6 + 0.6e-6 * (17e3 * s).sin() + 0.4e-6 * (31e3 * s + 1.0).sin())
    };
    let points = (-80..=80).map(|k| (f64::from(k) * 5e-6, depth(f64::from(k) * 5e-6))).collect();
    Surface::Profile(Profile::from_points(points).unwrap())
}

/// Surfaces with both kinds of element on both raceways, with soft edges and without.
fn cases() -> Vec<(&'static str, ElementOnRaceway, Surface, bool)> {
    let spall = |length: f64, slope: f64| Surface::Profile(Profile::spall(length, 100e-6, slope));
    vec![
        ("ball outside, edges", OUTER, spall(2.4e-3, FRAC_PI_2), false),
        ("ball outside, soft edges", OUTER, spall(2.4e-3, FRAC_PI_2), true),
        ("ball inside, short and soft", INNER, spall(0.5e-3, FRAC_PI_2), true),
        ("ball inside, flanks", INNER, spall(2.4e-3, 0.6), false),
        ("ball outside, dent", OUTER, dent(), false),
        ("crowned roller inside, edges", nu205(RacewaySide::Inner, true), spall(1.2e-3, FRAC_PI_2), false),
        ("straight roller outside, soft edges", nu205(RacewaySide::Outer, false), spall(1.2e-3, FRAC_PI_2), true),
    ]
}

fn specification(soft: bool) -> MapSpecification {
    MapSpecification {
        accuracy: 3e-2,
        tolerated: Some(0.5),
        resolution: Resolution { columns: 24, rows: 12 },
        edges: soft.then(|| EdgeSoftness::of_steps(0.3)),
        ..MapSpecification::new(LARGEST)
    }
}

fn grid(element: ElementOnRaceway, surface: &Surface, soft: bool) -> LoveContact {
    let of = specification(soft);
    LoveContact::with_edges(element, surface, 1.8 * LARGEST, of.resolution, of.edges).unwrap()
}

#[test]
fn second_derivatives_of_a_map_are_differences_of_its_slopes() {
    for (name, element, surface, soft) in cases() {
        let map = crate::built(&surface, element, specification(soft));
        let radius = element.raceway_radius;
        let near = Near::new(NearDefect::Map(NearMap::new(Arc::new(map), radius)), radius);
        let grid = grid(element, &surface, soft);
        // Slopes of 1 at most, from Hermite coefficients that are a few times as large: some ten roundings.
        let points = compare(&near, |s| grid.first_touch(s), 2000, 2e-15);
        assert!(points.compared > 1000 && points.left_out < 100, "{name}: {points:?}");
    }
}

#[test]
fn second_derivatives_of_law_love_are_differences_of_its_slopes() {
    for (name, element, surface, soft) in cases() {
        let radius = element.raceway_radius;
        let unmapped = MapPlan::new(&surface, element, specification(soft)).unwrap().into_love();
        let near = Near::new(NearDefect::Love(Box::new(NearLove::new(unmapped, radius))), radius);
        let grid = grid(element, &surface, soft);
        // Slopes of 1 at most, from solutions whose matrix has a condition of 1e3.
        let points = compare(&near, |s| grid.first_touch(s), 400, 2e-13);
        assert!(points.compared > 200 && points.left_out < 100, "{name}: {points:?}");
    }
}

#[test]
fn below_the_smallest_contact_of_law_love_they_are_those_of_the_continued_value() {
    let step = 1e-7;
    let (mut compared, mut turning) = (0, 0);
    for (name, element, surface, soft) in cases().drain(..5) {
        let mut contact = grid(element, &surface, soft);
        let (from, to) = surface.extent();
        for n in 0..200 {
            let [q, t] = crate::spread(n);
            let s = from + q * (to - from).min(0.4e-3);
            let u = contact.first_touch(s) - 0.05 * LARGEST * t;
            let (found, ds) = (contact.second_derivatives(u, s).unwrap(), contact.solve(u, s).unwrap().ds);
            let mut by_s = |s: f64| derivative(step, 1e-7, |h| Some([contact.solve(u, s + h).ok()?.value]));
            let (Some([slope]), Some([ss])) = (by_s(s), derivative(step, 0.1, |h| by_s(s + h))) else { continue };
            let us = derivative(step, 1e-2, |h| Some([contact.solve(u, s + h).ok()?.du]));
            let uss = derivative(step, 1e5, |h| Some([contact.second_derivatives(u, s + h).ok()?.us]));
            let (Some([us]), Some([uss])) = (us, uss) else { continue };
            compared += 1;
            assert_eq!(found.uu, 0.0);
            // The path from which Δ is continued is found to 1e-9 of the smallest contact, 3e-16 m, of which curvatures
            // of 1e6 /m make 3e-10 in slopes over 0.1 µm.
            let size = found.us.abs().max(found.ss.abs());
            assert!((found.us - us).abs() < 1e-2 + 1e-6 * size, "{name} at {u:e} {s:e}: {} {us}", found.us);
            // ∂Δ/∂s lacks (u − u₀) ∂²Δ/∂u∂s, hence u − u₀; ∂²Δ/∂s² lacks that times ∂³Δ/∂u∂s². With a single column
            // under the edge slopes do not turn, and nothing is lacking.
            let turns = us.abs() > 1.0;
            let lacking = if turns { (slope - ds) / us * uss } else { 0.0 };
            turning += usize::from(turns);
            // Differences of differences over 0.1 µm, of values that are exact to 1e-18 m.
            let limit = 1e-2 + 1e-6 * (found.ss.abs() + lacking.abs());
            assert!((found.ss + lacking - ss).abs() < limit, "{name} at {u:e} {s:e}: {} {lacking} {ss}", found.ss);
        }
    }
    assert!(compared > 200 && turning > 50, "{compared} {turning}");
}

#[test]
fn second_derivatives_of_a_rigid_path_are_differences_of_its_slope() {
    let balls = Bearing::steel_balls(9, 7.94e-3, 39.32e-3);
    for (raceway, on_element) in
        [RacewaySide::Outer, RacewaySide::Inner].into_iter().flat_map(|side| [(side, false), (side, true)])
    {
        let rolling = Rolling::of(&balls, raceway, on_element);
        let radius = rolling.bearer_radius();
        let spall = |slope: f64| Profile::spall(2.4e-3, 60e-6, slope);
        let Surface::Profile(dent) = dent() else { unreachable!() };
        for (name, profile) in [("edges", spall(FRAC_PI_2)), ("flanks", spall(0.6)), ("dent", dent)] {
            let path = RigidPath::new(profile.points(), rolling).unwrap();
            let near = Near::new(NearDefect::Hertz(path), radius);
            // Slopes are 0.3 at most; at the intervals' ends their derivative steps by less than a millionth.
            let points = compare(&near, |_| 0.0, 4000, 1e-15);
            assert!(points.compared > 3900, "{raceway:?} {on_element} {name}: {points:?}");
        }
    }
}

/// P″ over a sharp edge at the angle `d` from it, of P in `Rolling`'s table.
fn second_over_an_edge(rolling: &Rolling, d: f64) -> f64 {
    let [bearer, other] = [rolling.raceway_radius, rolling.element_radius];
    let [bearer, other] = if rolling.on_element { [other, bearer] } else { [bearer, other] };
    let (across, along) = (bearer * d.sin(), bearer * d.cos());
    let root = (other * other - across * across).sqrt();
    // Of √(C² − B² sin² d); that of B cos d is −B cos d.
    let of_root = (across * across - along * along) / root - (across * along).powi(2) / root.powi(3);
    match (rolling.raceway, rolling.on_element) {
        (RacewaySide::Outer, false) => -along - of_root,
        (RacewaySide::Outer, true) => of_root + along,
        (RacewaySide::Inner, _) => along - of_root,
    }
}

#[test]
fn second_derivatives_of_the_path_over_a_sharp_edge_are_those_of_the_closed_form() {
    let balls = Bearing::steel_balls(9, 7.94e-3, 39.32e-3);
    for raceway in [RacewaySide::Outer, RacewaySide::Inner] {
        for on_element in [false, true] {
            let rolling = Rolling::of(&balls, raceway, on_element);
            let half = 1.2e-3 / rolling.bearer_radius();
            let spall = Profile::spall(2.4e-3, 0.5e-3, FRAC_PI_2);
            let path = RigidPath::new(spall.points(), rolling).unwrap();
            for n in 1..1000 {
                let past = half * f64::from(n) / 1000.0;
                let expected = second_over_an_edge(&rolling, past);
                for (piece, angle) in [(0, past - half), (1, half - past)] {
                    let found = path.second_derivative(piece, angle);
                    // width² P⁗/12 with P⁗ = 3/r³ at the edge, where intervals are 1.25e-3 r wide: 4e-7; 1.2 mm past
                    // it, κ being 18°, twice as much.
                    assert!((found / expected - 1.0).abs() < 1e-6, "{rolling:?} {past}: {found:e} {expected:e}");
                }
            }
        }
    }
}
