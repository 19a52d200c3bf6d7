//! How the force of a contact without damping grows with its approach: Hertz's point contact, or the laminae of a
//! roller after ISO/TS 16281.
//!
//! ```text
//! point    Q = K δ^(3/2)
//! laminae  Q = (K/n) Σ max(0, δ − P_k)^(10/9),   K = 2^(10/9) · 35948 L^(8/9) N/mm^(10/9), L in mm
//! ```
//! The sum has a corner in its slope wherever a lamina begins to carry. What is integrated is the sum between 2048
//! steps of s = √(δ/(δ + P̄)): Q/(K δ^(10/9)) as a cubic through its values and slopes at both ends of a step, slopes
//! no steeper than three times the rise. How far that is from the sum is a test of the crate's own.

use crate::case::Case;

/// Steps of the table.
const STEPS: usize = 2048;

/// Growth of one contact's force.
#[derive(Debug, Clone)]
pub enum Growth {
    Point(f64),
    Line { constant: f64, crown: Option<Crown> },
}

/// What a crown leaves of a straight roller's force, and its slope, at the table's nodes.
#[derive(Debug, Clone)]
pub struct Crown {
    mean: f64,
    nodes: Vec<[f64; 2]>,
}

impl Growth {
    /// That of a case's roller, if it has one.
    pub fn of_roller(case: &Case) -> Option<Self> {
        let roller = case.roller?;
        let (d, l) = (case.diameter_mm, roller.length_mm);
        let millimetres = 2f64.powf(10.0 / 9.0) * 35948.0 * l.powf(8.0 / 9.0);
        let depth = |k: u32| {
            let x = l * ((f64::from(k) + 0.5) / f64::from(roller.laminae) - 0.5);
            let crown = |factor: f64, share: f64| -factor * d * (1.0 - share * share).ln();
            let end = 2.0 * x.abs() - (l - 2.5 * d);
            1e-3 * if l <= 2.5 * d {
                crown(0.00035, 2.0 * x / l)
            } else if end <= 0.0 {
                0.0
            } else {
                crown(0.0005, end / (2.5 * d))
            }
        };
        let crown = roller.crowned.then(|| Crown::new(&(0..roller.laminae).map(depth).collect::<Vec<_>>()));
        Some(Self::Line { constant: millimetres * 1000f64.powf(10.0 / 9.0), crown })
    }

    /// K.
    pub fn constant(&self) -> f64 {
        match self {
            Self::Point(constant) | Self::Line { constant, .. } => *constant,
        }
    }

    /// Force (N) and its slope (N/m) at an approach (m) that is not negative.
    pub fn force(&self, delta: f64) -> [f64; 2] {
        match self {
            Self::Point(k) => [k * delta * delta.sqrt(), 1.5 * k * delta.sqrt()],
            Self::Line { constant, crown } => {
                let ninth = delta.powf(1.0 / 9.0);
                let straight = [constant * delta * ninth, 10.0 / 9.0 * constant * ninth];
                let Some(crown) = crown else { return straight };
                let [part, by_delta] = crown.part(delta);
                [straight[0] * part, straight[1] * part + straight[0] * by_delta]
            }
        }
    }

    /// The approach (m) under a force (N).
    pub fn approach(&self, force: f64) -> f64 {
        if let Self::Point(k) = self {
            return (force / k).cbrt().powi(2);
        }
        let (mut low, mut high) = (0.0, 1e-9);
        while self.force(high)[0] < force {
            high *= 2.0;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if self.force(middle)[0] < force { low = middle } else { high = middle }
        }
        high
    }
}

impl Crown {
    fn new(depths: &[f64]) -> Self {
        let mean = depths.iter().sum::<f64>() / depths.len() as f64;
        let node = |i: usize| {
            let s = i as f64 / STEPS as f64;
            if i == 0 {
                // Laminae without depth carry from the first, straight.
                let flat = depths.iter().filter(|&&depth| depth == 0.0).count() as f64 / depths.len() as f64;
                return [flat, 0.0];
            }
            if i == STEPS {
                return [1.0, 20.0 / 9.0];
            }
            let delta = mean * s * s / (1.0 - s * s);
            let shares = depths.iter().filter(|&&depth| depth < delta).map(|depth| depth / delta);
            let part: f64 = shares.clone().map(|share| (1.0 - share).powf(10.0 / 9.0)).sum();
            let by_log: f64 = shares.map(|share| 10.0 / 9.0 * (1.0 - share).powf(1.0 / 9.0) * share).sum();
            // ds/d(ln δ) = s (1 − s²)/2
            let by_s = by_log / (0.5 * s * (1.0 - s * s));
            [part / depths.len() as f64, by_s / depths.len() as f64]
        };
        Self { mean, nodes: (0..=STEPS).map(node).collect() }
    }

    /// The part of a straight roller's force that is left, and its derivative by the approach.
    fn part(&self, delta: f64) -> [f64; 2] {
        let s = (delta / (delta + self.mean)).sqrt();
        let at = ((s * STEPS as f64) as usize).min(STEPS - 1);
        let (width, [from, to]) = (1.0 / STEPS as f64, [self.nodes[at], self.nodes[at + 1]]);
        let t = s / width - at as f64;
        let rise = to[0] - from[0];
        let [leaving, arriving] = [from[1], to[1]].map(|slope| (slope * width).min(3.0 * rise));
        // Hermite's basis.
        let part = from[0] + rise * t * t * (3.0 - 2.0 * t) + leaving * t * (1.0 - t) * (1.0 - t)
            - arriving * t * t * (1.0 - t);
        let by_t = 6.0 * rise * t * (1.0 - t) + leaving * (1.0 - t) * (1.0 - 3.0 * t) + arriving * t * (3.0 * t - 2.0);
        let by_delta = if delta == 0.0 { 0.0 } else { by_t / width * 0.5 * s * (1.0 - s * s) / delta };
        [part, by_delta]
    }
}

#[test]
fn forces_have_their_slopes_and_a_crown_takes_the_ends_away() {
    let depths: Vec<f64> = (0..40).map(|k| 1e-7 * f64::from(k).powi(2)).collect();
    let crowned = Growth::Line { constant: 1e10, crown: Some(Crown::new(&depths)) };
    for growth in [Growth::Point(1e10), Growth::Line { constant: 1e10, crown: None }, crowned.clone()] {
        for delta in [1e-7, 3e-6, 1e-4] {
            let [force, slope] = growth.force(delta);
            let step = 1e-6 * delta;
            let quotient = (growth.force(delta + step)[0] - growth.force(delta - step)[0]) / (2.0 * step);
            // Rounding of the difference, and corners of the laminae.
            assert!((quotient / slope - 1.0).abs() < 1e-3, "{growth:?} {delta}: {slope} {quotient}");
            assert!((growth.approach(force) / delta - 1.0).abs() < 1e-12);
        }
    }
    // The sum itself, between nodes and beyond all laminae.
    for delta in [3.3e-5, 1.1e-4, 2e-3] {
        let sum: f64 = depths.iter().map(|depth| f64::max(0.0, delta - depth).powf(10.0 / 9.0)).sum();
        assert!((crowned.force(delta)[0] / (1e10 * sum / 40.0) - 1.0).abs() < 1e-4, "{delta}");
    }
}
