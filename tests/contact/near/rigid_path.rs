//! The rigid element's path against the oracle, which tries every corner and every straight piece of profiles of many
//! kinds.

use crate::support::draw::Draw;
use brinell::contact::rolled_path::RigidPath;
use brinell::contact::rolling::{RacewaySide, Rolling};
use brinell_oracle::envelope::{Envelope, Pair};
use std::f64::consts::TAU;
use std::sync::LazyLock;

type Points = Vec<(f64, f64)>;

/// A bearing, a profile on it, and the path.
struct Case {
    element: f64,
    raceway: f64,
    points: Points,
    path: RigidPath,
}

impl Case {
    fn new(element: f64, raceway: f64, points: Points) -> Self {
        Self { path: RigidPath::new(&points, Rolling::outer_ring(element, raceway)).unwrap(), element, raceway, points }
    }

    /// The same seen in a mirror.
    fn mirrored(&self) -> Self {
        let points = self.points.iter().rev().map(|&(arc, depth)| (-arc, depth)).collect();
        Self::new(self.element, self.raceway, points)
    }

    /// First and last knot.
    fn extent(&self) -> (f64, f64) {
        let knots = self.path.knots();
        (knots[0], knots[knots.len() - 1])
    }

    /// The path at an angle.
    fn at(&self, angle: f64) -> f64 {
        let ((first, last), knots) = (self.extent(), self.path.knots());
        if angle <= first || angle >= last {
            return 0.0;
        }
        self.path.at(knots.partition_point(|&k| k <= angle) - 1, angle).path
    }

    fn oracle(&self) -> Envelope {
        Envelope::at_single_angles(std::slice::from_ref(&self.points), Pair::OuterRing, self.element, self.raceway)
    }
}

/// Points at random distances with random depths, raised ones among them; steep, and as often as not with a wall.
fn rough(random: &mut Draw) -> Points {
    let (depth, step) = (random.between(1e-6, 3e-4), random.between(3e-6, 3e-4));
    let (count, raised) = (random.within(3.0, 40.0) as usize, random.within(0.0, 0.3));
    let mut arc = random.within(-5e-3, 5e-3);
    let mut points = vec![(arc, 0.0)];
    for _ in 0..count {
        if random.part() < 0.85 {
            arc += random.within(0.02, 1.0) * step;
        }
        if points.len() >= 2 && points[points.len() - 2].0 == arc {
            arc += step;
        }
        points.push((arc, depth * (random.part() - raised)));
    }
    points.push((arc + step * random.part() + 1e-7, 0.0));
    points
}

/// Flat or sloping floors between sloping, steep and vertical walls, some with a raised rim.
fn floored(random: &mut Draw) -> Points {
    let depth = random.between(3e-6, 5e-4);
    let mut arc = random.within(-2e-2, 0.0);
    let mut points = vec![(arc, 0.0)];
    let wall = |random: &mut Draw, height: f64| match (random.part() * 4.0) as u32 {
        0 => 0.0,
        1 => height / random.within(1.0, 89.5).to_radians().tan(),
        2 => height / random.within(0.1, 5.0).to_radians().tan(),
        _ => height / random.within(60.0, 89.9).to_radians().tan(),
    };
    if random.part() < 0.3 {
        arc += random.between(1e-5, 1e-3);
        points.push((arc, -0.3 * depth * random.part()));
    }
    for _ in 0..random.within(1.0, 4.0) as usize {
        let floor = depth * random.within(0.2, 1.0);
        arc += wall(random, (floor - points[points.len() - 1].1).abs());
        points.push((arc, floor));
        arc += random.between(1e-5, 1e-2);
        let tilt = if random.part() < 0.5 { 0.0 } else { 0.5 * depth * (random.part() - 0.5) };
        points.push((arc, floor + tilt));
    }
    arc += wall(random, points[points.len() - 1].1);
    if random.part() < 0.3 {
        points.push((arc, -0.3 * depth * random.part()));
        arc += random.between(1e-5, 1e-3);
    }
    points.push((arc, 0.0));
    points
}

fn spall(length: f64, depth: f64, slope: f64) -> Points {
    let half = 0.5 * length;
    let run = (depth / slope.to_radians().tan()).min(0.999 * half);
    vec![(-half, 0.0), (-half + run, depth), (half - run, depth), (half, 0.0)]
}

/// Rims and floors that are high and deep beside the element, up to half its radius.
fn rugged(random: &mut Draw, element: f64) -> Points {
    let mut arc = 0.0;
    let mut points = vec![(arc, 0.0)];
    for _ in 0..random.within(1.0, 6.0) as usize {
        arc += random.between(1e-3, 1.0) * element;
        points.push((arc, element * random.within(-0.3, 0.3) * random.part()));
    }
    points.push((arc + random.between(1e-3, 1.0) * element, 0.0));
    points
}

/// Profiles whose pieces span far more than an element, up to nine tenths of the raceway.
fn long(random: &mut Draw, raceway: f64) -> Points {
    let length = TAU * raceway * random.within(0.1, 0.9);
    let depth = random.between(1e-5, 5e-4);
    match (random.part() * 3.0) as u32 {
        0 => vec![(-0.5 * length, 0.0), (0.5 * length * random.within(-0.9, 0.9), depth), (0.5 * length, 0.0)],
        1 => vec![(-0.5 * length, 0.0), (0.5 * length, depth), (0.5 * length, 0.0)],
        _ => spall(length, depth, random.between(0.3, 89.0)),
    }
}

/// Profiles of each kind in turn.
static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    let mut random = Draw::new(11);
    let case = |k: usize| {
        // A long path of a large bearing has millions of pieces.
        let element = random.between(2e-3, if k % 5 == 4 { 5e-3 } else { 2e-2 });
        let raceway = element * random.within(2.2, 14.0);
        let points = match k % 5 {
            0 => rough(&mut random),
            1 => floored(&mut random),
            2 => {
                let (depth, slope) = (random.between(2e-6, 3e-4), random.between(0.5, 89.0));
                let run = depth / slope.to_radians().tan();
                spall(2.0 * run + random.between(1e-5, 2e-2), depth, slope)
            }
            3 => rugged(&mut random, element),
            _ => long(&mut random, raceway),
        };
        Case::new(element, raceway, points)
    };
    (0..250).map(case).collect()
});

#[test]
fn the_path_is_the_envelope_of_all_corners_and_pieces() {
    let mut random = Draw::new(3);
    for (k, case) in CASES.iter().enumerate() {
        let (oracle, (first, last), knots) = (case.oracle(), case.extent(), case.path.knots());
        for i in 0..150 {
            // A little beyond both ends, and close to a knot every third time.
            let near = knots[(random.part() * knots.len() as f64) as usize];
            let angle = match i % 3 {
                0 => near + random.within(-1.0, 1.0) * random.between(1e-9, 1e-3),
                _ => random.within(first - 1e-3, last + 1e-3),
            };
            let error = (case.at(angle) - oracle.touched(angle).1).abs();
            // Rounding of radii of up to 0.3 m, and the cubics' own error.
            assert!(error < 3e-15, "profile {k} is off by {error:e} m");
        }
    }
}

#[test]
fn each_body_s_path_over_random_profiles_is_the_envelope() {
    // Radii of the ER16K of `er16k-tb1` (m).
    const ELEMENT: f64 = 3.97e-3;
    const OUTER: f64 = 23.6325e-3;
    const INNER: f64 = 15.6875e-3;
    let mut random = Draw::new(11);
    for (pair, raceway, raceway_radius, on_element) in [
        (Pair::OuterRing, RacewaySide::Outer, OUTER, false),
        (Pair::ElementOutside, RacewaySide::Outer, OUTER, true),
        (Pair::InnerRing, RacewaySide::Inner, INNER, false),
        (Pair::ElementInside, RacewaySide::Inner, INNER, true),
    ] {
        let rolling = Rolling { element_radius: ELEMENT, raceway_radius, raceway, on_element };
        for depth in [5e-6, 80e-6] {
            for _ in 0..20 {
                let mut arc = -0.4e-3;
                let mut point = |i: i32| {
                    arc += random.within(1e-6, 61e-6);
                    (arc, if i == 0 || i == 24 { 0.0 } else { depth * random.within(-0.15, 0.85) })
                };
                let points: Points = (0..25).map(&mut point).collect();
                let path = RigidPath::new(&points, rolling).unwrap();
                let oracle = Envelope::at_single_angles(&[points], pair, ELEMENT, raceway_radius);
                let (from, to) = (path.knots()[0], path.knots()[path.knots().len() - 1]);
                for _ in 0..100 {
                    let angle = random.within(from, to);
                    let piece = path.knots().partition_point(|&knot| knot <= angle) - 1;
                    let off = (path.at(piece, angle).path - oracle.touched(angle).1).abs();
                    assert!(off < 1e-16, "{pair:?} at {angle}: {off:e}");
                }
            }
        }
    }
}

/// What the search for the path's pieces rests on.
#[test]
fn the_touched_point_moves_in_one_direction_only() {
    for (k, case) in CASES.iter().enumerate() {
        let (oracle, (first, last)) = (case.oracle(), case.extent());
        let mut before = f64::NEG_INFINITY;
        for i in 0..=1000 {
            let angle = first + (last - first) * f64::from(i) / 1000.0;
            let (feature, _) = oracle.touched(angle);
            let touched = oracle.point(feature, angle).map_or(angle, |(touched, _)| touched);
            // Where a straight piece is touched hardly depends on the angle when it is nearly as round as the element.
            assert!(touched >= before - 1e-9, "profile {k} at {angle}: back by {:e}", before - touched);
            before = before.max(touched);
        }
    }
}

#[test]
fn a_profile_in_a_mirror_has_the_path_in_a_mirror() {
    for (k, case) in CASES.iter().enumerate() {
        let (mirrored, (first, last)) = (case.mirrored(), case.extent());
        for i in 0..=500 {
            let angle = first + (last - first) * f64::from(i) / 500.0;
            let difference = (case.at(angle) - mirrored.at(-angle)).abs();
            // Rounding of radii of up to 0.3 m.
            assert!(difference < 1e-15, "profile {k} differs by {difference:e} m");
        }
    }
}

#[test]
fn the_path_is_continuous() {
    for (k, case) in CASES.iter().enumerate() {
        let (path, knots, (first, last)) = (&case.path, case.path.knots(), case.extent());
        let ends = [path.at(0, first).path, path.at(knots.len() - 2, last).path];
        let between = (1..knots.len() - 1).map(|i| path.at(i, knots[i]).path - path.at(i - 1, knots[i]).path);
        for jump in between.chain(ends) {
            // A knot is known to 1e-13 rad, and the path's slopes differ there by less than the radius, 0.3 m a radian.
            assert!(jump.abs() < 3e-14, "profile {k} jumps by {jump:e} m");
        }
    }
}
