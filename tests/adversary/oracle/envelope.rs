//! How far out the centre of a rigid element comes over a profile, by trying every corner and every straight piece.
//!
//! The profile is R(φ), linear in φ between its corners. Over the point (φ, R) the centre on the ray at angle ψ is at
//! ρ = R cos d − √(r² − R² sin² d), d = φ − ψ; the element touches where ρ is least. There its circle and the profile have one
//! tangent, (T − C)·T′ = 0 with the point T, its derivative by φ and the centre C; and as |T − C| = r all along,
//! dρ/dψ = −ρ (T − C)·e_t / (T − C)·e_r.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// What is touched: the smooth raceway, a corner, or the inside of a straight piece that is seen so many turns away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    Raceway,
    Corner(usize),
    Piece(usize, i8),
}

pub struct Envelope {
    r: f64,
    raceway: f64,
    /// (φ, R) in order; the first and the last lie on the raceway.
    corners: Vec<(f64, f64)>,
    /// Angles at which the touched feature changes, ascending, in [−π, π].
    pub changes: Vec<f64>,
    /// What is touched before each of them, and after the last.
    between: Vec<Feature>,
}

/// Parts of a straight piece that are tried.
const PARTS: usize = 16;

impl Envelope {
    /// `points` are arcs and depths [m].
    pub fn new(points: &[(f64, f64)], r: f64, raceway: f64) -> Self {
        let mut corners: Vec<(f64, f64)> = points.iter().map(|&(s, h)| (s / raceway, raceway + h)).collect();
        let ends = [corners[0], corners[corners.len() - 1]];
        if ends[0].1 != raceway {
            corners.insert(0, (ends[0].0, raceway));
        }
        if ends[1].1 != raceway {
            corners.push((ends[1].0, raceway));
        }
        let mut envelope = Self { r, raceway, corners, changes: Vec::new(), between: Vec::new() };
        envelope.find_changes();
        envelope
    }

    /// ρ over a point at angular distance `d`; infinite beyond the element's reach.
    fn centre(&self, radius: f64, d: f64) -> f64 {
        let (sin, cos) = d.sin_cos();
        let square = self.r * self.r - radius * radius * sin * sin;
        if square > 0.0 && d.abs() < FRAC_PI_2 { radius * cos - square.sqrt() } else { f64::INFINITY }
    }

    fn piece(&self, i: usize, turns: i8) -> [(f64, f64); 2] {
        let shift = TAU * f64::from(turns);
        [self.corners[i], self.corners[i + 1]].map(|(phi, radius)| (phi + shift, radius))
    }

    /// (T − C)·T′ over the cosine part of T − C, that is dρ/dφ; −∞ or +∞ where the circle does not reach.
    fn tangency(&self, ends: [(f64, f64); 2], phi: f64, psi: f64) -> f64 {
        let slope = (ends[1].1 - ends[0].1) / (ends[1].0 - ends[0].0);
        let radius = ends[0].1 + slope * (phi - ends[0].0);
        let (sin, cos) = (phi - psi).sin_cos();
        let (across, square) = (radius * sin, self.r * self.r - radius * radius * sin * sin);
        if square <= 0.0 || (phi - psi).abs() >= FRAC_PI_2 {
            return if phi < psi { f64::NEG_INFINITY } else { f64::INFINITY };
        }
        slope * cos - radius * sin + across * (slope * sin + radius * cos) / square.sqrt()
    }

    /// Lowest ρ between two angles of a piece, and where, `None` if it is at an end.
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
        Some((self.centre(radius_at(ends, phi), phi - psi), phi))
    }

    /// The touched feature and ρ, over everything there is.
    pub fn touched(&self, psi: f64) -> (Feature, f64) {
        let (first, last) = (self.corners[0].0, self.corners[self.corners.len() - 1].0);
        let mut best = (Feature::Raceway, f64::INFINITY);
        let inside = [-1.0, 0.0, 1.0].iter().any(|turn| psi + turn * TAU > first && psi + turn * TAU < last);
        if !inside {
            best.1 = self.raceway - self.r;
        }
        for (i, &(phi, radius)) in self.corners.iter().enumerate() {
            let rho = self.centre(radius, within_half_a_turn(phi - psi));
            if rho < best.1 {
                best = (Feature::Corner(i), rho);
            }
        }
        for turns in [-1i8, 0, 1] {
            for i in 0..self.corners.len() - 1 {
                self.try_piece(i, turns, psi, &mut best);
            }
        }
        best
    }

    fn try_piece(&self, i: usize, turns: i8, psi: f64, best: &mut (Feature, f64)) {
        let ends = self.piece(i, turns);
        let [from, to] = [ends[0].0, ends[1].0];
        // No point of the piece is nearer than its smaller radius at its smaller distance.
        let nearest = if from <= psi && psi <= to { 0.0 } else { (from - psi).abs().min((to - psi).abs()) };
        if to <= from || self.centre(ends[0].1.min(ends[1].1), nearest) > best.1 + 1e-14 * self.raceway {
            return;
        }
        for part in 0..PARTS {
            let at = |k: usize| if k == PARTS { to } else { from + (to - from) * (k as f64 / PARTS as f64) };
            // Inside a piece is lower than its own ends, if only by less than a rounding.
            let own = best.0 == Feature::Corner(i) || best.0 == Feature::Corner(i + 1);
            let ties = if own { 1e-14 * self.raceway } else { 0.0 };
            if let Some((rho, _)) = self.lowest(ends, (at(part), at(part + 1)), psi)
                && rho <= best.1 + ties
            {
                *best = (Feature::Piece(i, turns), rho);
            }
        }
    }

    /// P and dP/dψ while a feature stays touched.
    pub fn path(&self, feature: Feature, psi: f64) -> (f64, f64) {
        let (phi, radius) = match feature {
            Feature::Raceway => return (0.0, 0.0),
            Feature::Corner(i) => self.corners[i],
            Feature::Piece(i, turns) => {
                let ends = self.piece(i, turns);
                if ends[0].1 == ends[1].1 {
                    return (ends[0].1 - self.raceway, 0.0);
                }
                let phi = self.lowest(ends, (ends[0].0, ends[1].0), psi).map_or_else(
                    || if self.tangency(ends, ends[0].0, psi) >= 0.0 { ends[0].0 } else { ends[1].0 },
                    |found| found.1,
                );
                (phi, radius_at(ends, phi))
            }
        };
        let d = within_half_a_turn(phi - psi);
        let (across, rho) = (radius * d.sin(), self.centre(radius, d));
        let along = (self.r * self.r - across * across).sqrt();
        (rho - (self.raceway - self.r), -rho * across / along)
    }

    /// Angle beyond the profile within which it may still be touched.
    fn reach(&self) -> f64 {
        let lowest = self.corners.iter().map(|c| c.1).fold(f64::INFINITY, f64::min);
        let (mut low, mut high) = (0.0, (self.r / self.raceway).asin());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.centre(lowest, middle) < self.raceway - self.r { low = middle } else { high = middle }
        }
        high
    }

    fn find_changes(&mut self) {
        let (first, last) = (self.corners[0].0, self.corners[self.corners.len() - 1].0);
        let mut at: Vec<f64> = (0..=360).map(|i| -PI + TAU * f64::from(i) / 360.0).collect();
        let reach = 1.001 * self.reach() + 1e-9;
        let (from, to) = (first - reach, last + reach);
        let count = 400 + 8 * self.corners.len();
        at.extend((0..=count).map(|i| from + (to - from) * (i as f64 / count as f64)));
        at.extend(self.corners.iter().map(|c| c.0));
        at.retain(|psi| (-PI..=PI).contains(psi));
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

    /// What is touched around an angle within half a turn that is no change itself.
    pub fn feature(&self, psi: f64) -> Feature {
        self.between[self.changes.partition_point(|&change| change <= psi)]
    }

    /// Between which angles the same feature stays touched as at this one.
    pub fn stretch(&self, psi: f64) -> [f64; 2] {
        let next = self.changes.partition_point(|&change| change <= psi);
        [next.checked_sub(1).map_or(-PI, |i| self.changes[i]), self.changes.get(next).copied().unwrap_or(PI)]
    }

    /// Whether the element meets an edge with nothing but its side, so that its centre would have to leap.
    pub fn leaps(&self) -> bool {
        let steep = |feature: Feature, at: f64| {
            let (path, slope) = self.path(feature, at);
            // 89.99°; where it leaps the side is met to within the 3e-14 rad of a change.
            !(slope.abs() <= 1e4 * (self.raceway - self.r + path))
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

fn within_half_a_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

fn radius_at(ends: [(f64, f64); 2], phi: f64) -> f64 {
    ends[0].1 + (ends[1].1 - ends[0].1) * ((phi - ends[0].0) / (ends[1].0 - ends[0].0))
}
