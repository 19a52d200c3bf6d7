//! How near two rigid circles come to each other over a profile on one of them, by trying every corner and every
//! straight piece.
//!
//! The profile is B(φ) from the centre of the body that has it, linear in φ between its corners; the other circle has
//! the radius C. With the touched point T at angle d = φ − ψ from the line of centres, the other circle's centre is at
//! ```text
//! outer ring             ρ  = B cos d − √(C² − B² sin² d)      least, B = R_o + h, C = r
//! inner ring, and
//! an element inside      |q| = B cos d + √(C² − B² sin² d)     greatest, B = R_i − h, C = r or B = r − h, C = R_i
//! an element outside     ρ  = √(C² − B² sin² d) − B cos d      least, B = r − h, C = R_o
//! ```
//! and the path P is ρ over the smooth body's, or what is left of the smooth body's |q|: always the least. Where it
//! touches inside a piece the circles have one tangent there, dP/dφ = 0. As |T − C| stays C all along, dP/dψ over the
//! distance of the centres is the touched point's way across their line over its way along it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Which bodies roll over each other; the first has the profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pair {
    OuterRing,
    InnerRing,
    /// An element on the outer raceway, and on the inner one.
    ElementOutside,
    ElementInside,
}

/// What is touched: the smooth body, a corner, or the inside of a straight piece that is seen so many turns away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    Smooth,
    Corner(usize),
    Piece(usize, i8),
}

pub struct Envelope {
    pair: Pair,
    /// Radii of the smooth body with the profile and of the other, and the distance of their centres.
    pub own: f64,
    other: f64,
    apart: f64,
    /// (φ, B) in order; the first and the last of each profile lie on the smooth body.
    corners: Vec<(f64, f64)>,
    /// Numbers of the first and the last corner of each profile.
    profiles: Vec<[usize; 2]>,
    /// Angles at which the touched feature changes, ascending, in [−π, π].
    pub changes: Vec<f64>,
    /// What is touched before each of them, and after the last.
    between: Vec<Feature>,
}

/// Parts of a straight piece that are tried.
const PARTS: usize = 16;

impl Envelope {
    /// `profiles` are arcs and depths (m) around the middle of the first, in order and within one turn, `r` and
    /// `raceway` the radii of element and raceway.
    pub fn new(profiles: &[Vec<(f64, f64)>], pair: Pair, r: f64, raceway: f64) -> Self {
        let mut envelope = Self::at_single_angles(profiles, pair, r, raceway);
        envelope.find_changes();
        envelope
    }

    /// The same for single angles only: where what is touched changes is not sought.
    pub fn at_single_angles(profiles: &[Vec<(f64, f64)>], pair: Pair, r: f64, raceway: f64) -> Self {
        let (own, other, apart) = match pair {
            Pair::OuterRing => (raceway, r, raceway - r),
            Pair::InnerRing => (raceway, r, raceway + r),
            Pair::ElementOutside => (r, raceway, raceway - r),
            Pair::ElementInside => (r, raceway, raceway + r),
        };
        let out = if pair == Pair::OuterRing { 1.0 } else { -1.0 };
        let (mut corners, mut ends) = (Vec::new(), Vec::new());
        for points in profiles {
            let from = corners.len();
            let radius = |h: f64| own + out * h;
            let [first, last] = [points[0], points[points.len() - 1]];
            if radius(first.1) != own {
                corners.push((first.0 / own, own));
            }
            corners.extend(points.iter().map(|&(s, h)| (s / own, radius(h))));
            if radius(last.1) != own {
                corners.push((last.0 / own, own));
            }
            ends.push([from, corners.len() - 1]);
        }
        Self { pair, own, other, apart, corners, profiles: ends, changes: Vec::new(), between: Vec::new() }
    }

    /// Roundings of a path.
    fn tie(&self) -> f64 {
        1e-14 * self.own.max(self.other)
    }

    /// √(C² − B² sin² d), if the other circle reaches.
    fn root(&self, radius: f64, d: f64) -> Option<f64> {
        let across = radius * d.sin();
        let square = self.other * self.other - across * across;
        (square > 0.0 && d.abs() < FRAC_PI_2).then(|| square.sqrt())
    }

    /// P over a point at angular distance `d`; infinite beyond reach.
    fn over(&self, radius: f64, d: f64) -> f64 {
        let (Some(root), along) = (self.root(radius, d), radius * d.cos()) else { return f64::INFINITY };
        match self.pair {
            Pair::OuterRing => along - root - self.apart,
            Pair::ElementOutside => root - along - self.apart,
            Pair::InnerRing | Pair::ElementInside => self.apart - (along + root),
        }
    }

    /// Distance of the centres at a path.
    pub fn distance(&self, path: f64) -> f64 {
        match self.pair {
            Pair::OuterRing | Pair::ElementOutside => self.apart + path,
            Pair::InnerRing | Pair::ElementInside => self.apart - path,
        }
    }

    /// Of two radii the one that is touched first.
    fn foremost(&self, a: f64, b: f64) -> f64 {
        if self.pair == Pair::OuterRing { a.min(b) } else { a.max(b) }
    }

    fn piece(&self, i: usize, turns: i8) -> [(f64, f64); 2] {
        let shift = TAU * f64::from(turns);
        [self.corners[i], self.corners[i + 1]].map(|(phi, radius)| (phi + shift, radius))
    }

    /// dP/dφ along a piece; −∞ or +∞ where the other circle does not reach.
    fn tangency(&self, ends: [(f64, f64); 2], phi: f64, psi: f64) -> f64 {
        let slope = (ends[1].1 - ends[0].1) / (ends[1].0 - ends[0].0);
        let (radius, d) = (ends[0].1 + slope * (phi - ends[0].0), phi - psi);
        let Some(root) = self.root(radius, d) else {
            return if phi < psi { f64::NEG_INFINITY } else { f64::INFINITY };
        };
        let (sin, cos) = d.sin_cos();
        let (along, shrinks) = (slope * cos - radius * sin, radius * sin * (slope * sin + radius * cos) / root);
        match self.pair {
            Pair::OuterRing => along + shrinks,
            Pair::ElementOutside => -along - shrinks,
            Pair::InnerRing | Pair::ElementInside => shrinks - along,
        }
    }

    /// Lowest P between two angles of a piece, and where, `None` if it is at an end.
    fn lowest(&self, ends: [(f64, f64); 2], (mut low, mut high): (f64, f64), psi: f64) -> Option<(f64, f64)> {
        if !(self.tangency(ends, low, psi) <= 0.0 && self.tangency(ends, high, psi) >= 0.0) {
            return None;
        }
        for _ in 0..90 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.tangency(ends, middle, psi) < 0.0 { low = middle } else { high = middle }
        }
        let phi = 0.5 * (low + high);
        Some((self.over(radius_at(ends, phi), phi - psi), phi))
    }

    /// The touched feature and P, over everything there is.
    pub fn touched(&self, psi: f64) -> (Feature, f64) {
        let mut best = (Feature::Smooth, f64::INFINITY);
        let inside = |[first, last]: &[usize; 2], psi: f64| psi > self.corners[*first].0 && psi < self.corners[*last].0;
        let around = [-1.0, 0.0, 1.0].map(|turn| psi + turn * TAU);
        if !self.profiles.iter().any(|profile| around.iter().any(|&psi| inside(profile, psi))) {
            best.1 = 0.0;
        }
        for (i, &(phi, radius)) in self.corners.iter().enumerate() {
            let path = self.over(radius, within_half_a_turn(phi - psi));
            if path < best.1 {
                best = (Feature::Corner(i), path);
            }
        }
        for turns in [-1i8, 0, 1] {
            for i in self.profiles.iter().flat_map(|&[first, last]| first..last) {
                self.try_piece(i, turns, psi, &mut best);
            }
        }
        best
    }

    fn try_piece(&self, i: usize, turns: i8, psi: f64, best: &mut (Feature, f64)) {
        let ends = self.piece(i, turns);
        let [from, to] = [ends[0].0, ends[1].0];
        // No point of the piece is lower than its foremost radius at its smallest distance.
        let nearest = if from <= psi && psi <= to { 0.0 } else { (from - psi).abs().min((to - psi).abs()) };
        if to <= from || self.over(self.foremost(ends[0].1, ends[1].1), nearest) > best.1 + self.tie() {
            return;
        }
        for part in 0..PARTS {
            let at = |k: usize| if k == PARTS { to } else { from + (to - from) * (k as f64 / PARTS as f64) };
            // Inside a piece is lower than its own ends, if only by less than a rounding.
            let own = best.0 == Feature::Corner(i) || best.0 == Feature::Corner(i + 1);
            let ties = if own { self.tie() } else { 0.0 };
            if let Some((path, _)) = self.lowest(ends, (at(part), at(part + 1)), psi)
                && path <= best.1 + ties
            {
                *best = (Feature::Piece(i, turns), path);
            }
        }
    }

    /// The touched point's angle and radius while a feature stays touched; `None` on the smooth body.
    pub fn point(&self, feature: Feature, psi: f64) -> Option<(f64, f64)> {
        match feature {
            Feature::Smooth => None,
            Feature::Corner(i) => Some(self.corners[i]),
            Feature::Piece(i, turns) => {
                let ends = self.piece(i, turns);
                let phi = self.lowest(ends, (ends[0].0, ends[1].0), psi).map_or_else(
                    || if self.tangency(ends, ends[0].0, psi) >= 0.0 { ends[0].0 } else { ends[1].0 },
                    |found| found.1,
                );
                Some((phi, radius_at(ends, phi)))
            }
        }
    }

    /// P and dP/dψ while a feature stays touched.
    pub fn path(&self, feature: Feature, psi: f64) -> (f64, f64) {
        if let Feature::Piece(i, _) = feature
            && self.corners[i].1 == self.corners[i + 1].1
        {
            let out = self.corners[i].1 - self.own;
            return (if self.pair == Pair::OuterRing { out } else { -out }, 0.0);
        }
        let Some((phi, radius)) = self.point(feature, psi) else { return (0.0, 0.0) };
        let d = within_half_a_turn(phi - psi);
        let (across, path) = (radius * d.sin(), self.over(radius, d));
        let along = (self.other * self.other - across * across).sqrt();
        (path, -self.distance(path) * across / along)
    }

    /// d⁴P/dψ⁴ over the touched point, by its Taylor series; straight pieces have less.
    pub fn fourth(&self, feature: Feature, psi: f64) -> f64 {
        let Some((phi, radius)) = self.point(feature, psi) else { return 0.0 };
        // Of d = φ − ψ, which falls as ψ grows.
        let (s, c) = within_half_a_turn(phi - psi).sin_cos();
        let across = [s, -c, -s / 2.0, c / 6.0, s / 24.0].map(|x| radius * x);
        let mut square = [0.0; 5];
        for n in 0..5 {
            square[n] = -(0..=n).map(|k| across[k] * across[n - k]).sum::<f64>();
        }
        square[0] += self.other * self.other;
        let mut root = [square[0].sqrt(); 5];
        for n in 1..5 {
            let inner: f64 = (1..n).map(|k| root[k] * root[n - k]).sum();
            root[n] = (square[n] - inner) / (2.0 * root[0]);
        }
        let along = radius * c / 24.0;
        24.0 * match self.pair {
            Pair::OuterRing => along - root[4],
            Pair::ElementOutside => root[4] - along,
            Pair::InnerRing | Pair::ElementInside => -along - root[4],
        }
    }

    /// C²/√(C² − B² sin² d) at the touched point: how roundings of the radii come into P.
    pub fn steepened(&self, feature: Feature, psi: f64) -> f64 {
        let Some((phi, radius)) = self.point(feature, psi) else { return self.other };
        self.root(radius, within_half_a_turn(phi - psi)).map_or(f64::INFINITY, |root| self.other * self.other / root)
    }

    /// Angle beyond the profile within which it may still be touched.
    fn reach(&self) -> f64 {
        let foremost = self.corners.iter().map(|c| c.1).fold(self.own, |a, b| self.foremost(a, b));
        let (mut low, mut high) = (0.0, if self.other < self.own { (self.other / self.own).asin() } else { FRAC_PI_2 });
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.over(foremost, middle) < 0.0 { low = middle } else { high = middle }
        }
        high
    }

    fn find_changes(&mut self) {
        let mut at: Vec<f64> = (0..=360).map(|i| -PI + TAU * f64::from(i) / 360.0).collect();
        let reach = 1.001 * self.reach() + 1e-9;
        for &[first, last] in &self.profiles {
            let (from, to) = (self.corners[first].0 - reach, self.corners[last].0 + reach);
            let count = 400 + 8 * (last - first + 1);
            let within = (0..=count).map(|i| from + (to - from) * (i as f64 / count as f64));
            at.extend(within.map(within_half_a_turn));
        }
        at.extend(self.corners.iter().map(|c| within_half_a_turn(c.0)));
        at.sort_by(f64::total_cmp);
        at.dedup();
        let features: Vec<(f64, Feature)> = at.into_iter().map(|psi| (psi, self.touched(psi).0)).collect();
        let mut changes = Vec::new();
        for pair in features.windows(2) {
            self.bisect(pair[0], pair[1], &mut changes);
        }
        let ends = [&[-PI], &changes[..], &[PI]].concat();
        self.between = ends.windows(2).map(|pair| self.touched(0.5 * (pair[0] + pair[1])).0).collect();
        self.changes = changes;
    }

    /// Between how many changes and the next an angle lies; on a change beyond it.
    pub fn stretch(&self, psi: f64) -> usize {
        self.changes.partition_point(|&change| change <= psi)
    }

    /// What is touched along a stretch.
    pub fn feature(&self, stretch: usize) -> Feature {
        self.between[stretch]
    }

    /// The angles at which a stretch begins and ends.
    pub fn ends(&self, stretch: usize) -> [f64; 2] {
        [stretch.checked_sub(1).map_or(-PI, |i| self.changes[i]), self.changes.get(stretch).copied().unwrap_or(PI)]
    }

    /// Whether the two meet an edge with nothing but the other's side, so that its centre would have to leap.
    pub fn leaps(&self) -> bool {
        let steep = |feature: Feature, at: f64| {
            let (path, slope) = self.path(feature, at);
            // 89.99°; where it leaps the side is met to within the 3e-14 rad of a change.
            !(slope.abs() <= 1e4 * self.distance(path))
        };
        let meet = self.changes.iter().zip(self.between.windows(2));
        meet.flat_map(|(&at, pair)| pair.iter().map(move |&feature| (feature, at)))
            .any(|(feature, at)| steep(feature, at))
    }

    fn bisect(&self, left: (f64, Feature), right: (f64, Feature), changes: &mut Vec<f64>) {
        if left.1 == right.1 {
            return;
        }
        let middle = 0.5 * (left.0 + right.0);
        // 3e-14 rad is less than 1e-15 m along the raceway of a small bearing.
        if right.0 - left.0 < 3e-14 || middle <= left.0 || middle >= right.0 {
            changes.push(middle);
            return;
        }
        let middle = (middle, self.touched(middle).0);
        self.bisect(left, middle, changes);
        self.bisect(middle, right, changes);
    }
}

pub fn within_half_a_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

fn radius_at(ends: [(f64, f64); 2], phi: f64) -> f64 {
    ends[0].1 + (ends[1].1 - ends[0].1) * ((phi - ends[0].0) / (ends[1].0 - ends[0].0))
}
