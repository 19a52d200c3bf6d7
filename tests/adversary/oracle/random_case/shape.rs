//! Random defects.

use crate::case::{Length, On, Shape, Topography};
use crate::draw::Draw;

/// What a defect is drawn for.
pub(crate) struct Around {
    /// Radius of an element and of the body with the defect (m).
    pub(crate) r: f64,
    pub(crate) bearer: f64,
    pub(crate) on: On,
    /// How long it may be (m).
    pub(crate) most: f64,
    /// How far elements are pressed into the raceways (m).
    pub(crate) approach: f64,
}

impl Around {
    /// How long a defect may be over the body's circumference.
    fn longest(&self) -> f64 {
        if self.on == On::Outer { 0.9 } else { 0.88 }
    }

    fn limited(&self, length: f64) -> f64 {
        length.min(self.most)
    }

    /// How deep a defect may be (m).
    fn deepest(&self) -> f64 {
        if matches!(self.on, On::Element { .. }) { 0.19 * self.r } else { 0.9 * self.r }
    }
}

/// A defect, and what it is called.
pub(crate) fn random(draw: &mut Draw, around: &Around) -> (&'static str, Shape) {
    type Drawn = fn(&mut Draw, &Around) -> Shape;
    let kinds: [(&str, Drawn); 8] = [
        ("steep spall", steep),
        ("sloping spall", sloping),
        ("dent", dent),
        ("bump with rims", bump),
        ("spike", spike),
        ("zigzag", zigzag),
        ("flat-floored trace", trace),
        ("rough trace", rough),
    ];
    let (name, shape) = draw.pick(&kinds);
    (name, shape(draw, around))
}

/// A patch of random depth, which law `hertz` has no answer to.
pub(super) fn topography(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let (depth, rows, columns) = (depth(draw, around, length), 3 + draw.below(6), 2 + draw.below(4));
    let along = |k: usize, count: usize, length: f64| length * 1e3 * (k as f64 / (count - 1) as f64 - 0.5);
    Shape::Topography(Topography {
        arcs: (0..rows).map(|k| along(k, rows, length)).collect(),
        axials: (0..columns).map(|k| along(k, columns, length)).collect(),
        depths: (0..rows * columns).map(|_| depth * 1e6 * draw.unit()).collect(),
    })
}

/// How long a defect is (m): from a contact's width to a few elements', seldom a large part of the raceway.
fn length(draw: &mut Draw, around: &Around) -> f64 {
    let whole = std::f64::consts::TAU * around.bearer;
    if draw.chance(0.1) {
        return around.limited(draw.between(0.05, around.longest()) * whole);
    }
    let length = draw.log(0.02, 3.0) * around.r;
    around.limited(if around.on == On::Outer { length } else { length.min(around.longest() * whole) })
}

/// A depth (m): about an approach, or what the element's circle reaches in this length, or more than it reaches.
fn depth(draw: &mut Draw, around: &Around, length: f64) -> f64 {
    let sag = length * length / (8.0 * around.r);
    let most = around.deepest();
    match draw.below(3) {
        0 => draw.log(0.1, 30.0) * around.approach,
        1 => draw.log(0.01, 3.0) * sag,
        _ => draw.log(1e-4, 1.0) * most,
    }
    .min(most)
}

fn spall(draw: &mut Draw, around: &Around, length: f64, depth: f64, slope_deg: f64) -> Shape {
    let length = if draw.chance(0.5) {
        Length::Degrees((length / around.bearer).to_degrees())
    } else {
        Length::Millimetres(length * 1e3)
    };
    Shape::Spall { length, depth_um: depth * 1e6, slope_deg }
}

fn steep(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let depth = depth(draw, around, length);
    let slope = if draw.chance(0.7) { 90.0 } else { draw.between(70.0, 90.0) };
    spall(draw, around, length, depth.min(0.99 * length), slope)
}

fn sloping(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let slope = draw.log(0.05, 70.0);
    // Flanks meet at most on the floor.
    let most = 0.5 * length * slope.to_radians().tan() * if draw.chance(0.2) { 1.0 - 1e-9 } else { 0.99 };
    let depth = depth(draw, around, length).min(most);
    spall(draw, around, length, depth, slope)
}

/// Points of a trace from arcs as shares of its length and depths (m).
fn points(length: f64, shares: impl Iterator<Item = (f64, f64)>) -> Shape {
    Shape::Trace(shares.map(|(share, depth)| (share * length * 1e3, depth * 1e6)).collect())
}

/// (1 − x²)² of the width, sampled.
pub fn bowl(share: f64) -> f64 {
    let x = 2.0 * share - 1.0;
    if x.abs() >= 1.0 { 0.0 } else { (1.0 - x * x) * (1.0 - x * x) }
}

fn dent(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let depth = depth(draw, around, length);
    let count = 4 + draw.below(20);
    points(length, (0..=count).map(|i| i as f64 / count as f64).map(|share| (share, depth * bowl(share))))
}

/// A hollow with raised rims, or a hill.
fn bump(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let depth = depth(draw, around, length) * if draw.chance(0.7) { 1.0 } else { -0.1 };
    let rim = draw.log(0.05, 5.0) * around.approach.min(0.1 * around.r);
    let (width, count) = (draw.between(0.1, 0.3), 12 + draw.below(20));
    let shape = |share: f64| {
        let rims = bowl(share / width) + bowl((1.0 - share) / width);
        depth * bowl((share - width) / (1.0 - 2.0 * width)) - rim * rims
    };
    points(length, (0..=count).map(|i| i as f64 / count as f64).map(|share| (share, shape(share))))
}

fn spike(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let height = draw.log(0.05, 5.0) * around.approach.min(0.1 * around.r);
    let (at, half) = (draw.between(0.2, 0.8), draw.log(1e-4, 0.1));
    let depth = if draw.chance(0.5) { 0.0 } else { depth(draw, around, length) };
    points(length, [(0.0, 0.0), (at - half, depth), (at, -height), (at + half, depth), (1.0, 0.0)].into_iter())
}

fn zigzag(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let depth = depth(draw, around, length) * if draw.chance(0.8) { 1.0 } else { -0.1 };
    let teeth = 1 + draw.below(12);
    let count = 2 * teeth;
    points(length, (0..=count).map(|i| (i as f64 / count as f64, if i % 2 == 1 { depth } else { 0.0 })))
}

/// A floor between flanks that begin or end in a wall, or do not.
fn trace(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let depth = depth(draw, around, length);
    let mut wall = || if draw.chance(0.5) { depth } else { 0.0 };
    let ends = [wall(), wall()];
    let [from, to] = [draw.between(0.01, 0.4), draw.between(0.6, 0.99)];
    points(length, [(0.0, ends[0]), (from, depth), (to, depth), (1.0, ends[1])].into_iter())
}

fn rough(draw: &mut Draw, around: &Around) -> Shape {
    let length = length(draw, around);
    let (depth, count) = (depth(draw, around, length), 3 + draw.below(40));
    let raised = if draw.chance(0.3) { 0.1 } else { 0.0 };
    let mut share = 0.0;
    let mut found = vec![(0.0, 0.0)];
    for _ in 0..count {
        share += draw.log(0.05, 1.0);
        found.push((share, depth * (draw.unit() - raised)));
    }
    let last = found.len() - 1;
    if draw.chance(0.7) {
        found[last].1 = 0.0;
    }
    points(length, found.into_iter().map(move |(at, depth)| (at / share, depth)))
}
