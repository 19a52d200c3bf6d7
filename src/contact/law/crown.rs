//! A crowned roller's line contact as one smooth function of its approach.
//!
//! The lamina law's sum is Q = K δ^(10/9) c(δ) with K the constant of the straight roller and
//! ```text
//! c = (1/n_s) Σ_k max(0, 1 − P_k/δ)^(10/9),   0 ≤ c < 1
//! ```
//! the part of the roller that carries. Over s = √(δ/(δ + P̄)), P̄ the mean depth, all approaches from nothing to
//! without end are 0 to 1, and c is near a straight line at both ends: c ~ s where the crown is a parabola in its
//! middle, 1 − c ~ (20/9)(1 − s) where it is flat pressed. So c is tabulated once at `NODES` equal steps of s with
//! its exact slopes, as cubic Hermite pieces; where those would not be monotonic, slopes are lessened until they are
//! (Fritsch and Carlson 1980). A lamina that begins to carry does so with an infinite second derivative, which the
//! pieces round off over one step of some 0.1 % of the approach. With 40 laminae the force is wrong by at most 2e-5 of
//! itself above the mean depth and by 5e-5 above a tenth of it, in those steps alone, where the stiffness is wrong by 2
//! and by 6 %; 40 laminae and 640 differ by 2e-4. The force is one of one variable, so its energy is its integral.

use crate::geometry::line_contact::LINE_ORDER;
use crate::numerics::lanes::{Lanes, Wide};
use crate::numerics::lists::opened;
use crate::numerics::ninth_root;
use crate::numerics::number::{Number, Pair};
use std::sync::{Arc, Mutex, Weak};

/// Steps of the table.
const NODES: usize = 2048;

/// The part of a crowned roller that carries, as a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Crown {
    /// Of the laminae (m).
    depths: Vec<f64>,
    /// P̄ (m).
    mean_depth: f64,
    /// Coefficients of c over the distance from the step's beginning, in steps.
    cubics: Vec<[f64; 4]>,
}

/// Tables that are in use, and the last one that was asked for: setting a scene up asks for its roller's several times,
/// and so does every run of a sweep.
static KNOWN: Mutex<Known> = Mutex::new(Known { last: None, in_use: Vec::new() });

struct Known {
    last: Option<Arc<Crown>>,
    in_use: Vec<Weak<Crown>>,
}

/// Force and derivatives over K δ^(10/9).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carrying {
    /// Of Q: c.
    pub part: f64,
    /// Of δ Q′.
    pub slope: f64,
    /// Of δ² Q″.
    pub second: f64,
}

impl Crown {
    /// As [`new`](Self::new), once for all who ask while it is in use.
    pub fn shared(depths: &[f64]) -> Arc<Self> {
        let found = opened(&KNOWN)
            .and_then(|known| known.in_use.iter().filter_map(Weak::upgrade).find(|crown| crown.depths == depths));
        // Outside of the lock: others need not wait while a table is made.
        let crown = found.unwrap_or_else(|| Arc::new(Self::new(depths)));
        let Some(mut known) = opened(&KNOWN) else { return crown };
        if !known.in_use.iter().any(|other| other.as_ptr() == Arc::as_ptr(&crown)) {
            known.in_use.retain(|other| other.strong_count() > 0);
            known.in_use.push(Arc::downgrade(&crown));
        }
        known.last = Some(Arc::clone(&crown));
        crown
    }

    /// The crown of these depths (m) of a roller's laminae, not all of them 0.
    pub fn new(depths: &[f64]) -> Self {
        let mean_depth = depths.iter().sum::<f64>() / depths.len() as f64;
        let node = |i: usize| {
            let s = i as f64 / NODES as f64;
            // δ/P̄ = s²/(1 − s²); at the end it is infinite.
            let approach = mean_depth * s * s / ((1.0 - s) * (1.0 + s));
            node(depths, approach, s)
        };
        let nodes: Vec<[f64; 2]> = (0..=NODES).map(node).collect();
        let cubics = nodes.windows(2).map(|pair| monotonic([pair[0], pair[1]])).collect();
        Self { depths: depths.to_vec(), mean_depth, cubics }
    }

    /// P̄ (m).
    pub fn mean_depth(&self) -> f64 {
        self.mean_depth
    }

    /// c and the order n = δ Q′/Q of the force at an approach (m), 10/9 where nothing carries; or their derivatives by
    /// the approach of the given `order`. The second derivative of n is left out: it jumps at every step of the table,
    /// and no contact at rest asks for it.
    #[inline(always)]
    pub fn part_and_order(&self, delta: f64, order: usize) -> [f64; 2] {
        let Carrying { part, slope, second } = self.carrying(delta);
        let n = if part > 0.0 { slope / part } else { LINE_ORDER };
        // δ c′ and δ n′ from c, δ Q′ and δ² Q″, all over K δ^(10/9).
        let by_ln = slope - LINE_ORDER * part;
        match order {
            0 => [part, n],
            // Where nothing carries yet, or only what carries straight from the first.
            _ if part <= 0.0 || delta <= 0.0 => [0.0; 2],
            1 => [by_ln / delta, (n + second / part - n * n) / delta],
            _ => [(second - 2.0 * LINE_ORDER * by_ln - (LINE_ORDER - 1.0) * LINE_ORDER * part) / (delta * delta), 0.0],
        }
    }

    /// What carries at an approach (m) that is not negative.
    #[inline(always)]
    pub fn carrying(&self, delta: f64) -> Carrying {
        let square = delta / (delta + self.mean_depth);
        let s = square.sqrt();
        let steps = s * NODES as f64;
        // NaN has piece 0 and stays NaN.
        let piece = (steps as usize).min(NODES - 1);
        let t = steps - piece as f64;
        let [a, b, c, d] = self.cubics[piece];
        let part = a + t * (b + t * (c + t * d));
        let by_s = (b + t * (2.0 * c + t * (3.0 * d))) * NODES as f64;
        let by_s_twice = (2.0 * c + 6.0 * d * t) * (NODES as f64 * NODES as f64);
        // δ ds/dδ = s (1 − s²)/2, and its derivative by s.
        let (pace, pace_by_s) = (0.5 * s * (1.0 - square), 0.5 - 1.5 * square);
        let slope = 10.0 / 9.0 * part + pace * by_s;
        let second = slope / 9.0 + pace * ((10.0 / 9.0 + pace_by_s) * by_s + pace * by_s_twice);
        Carrying { part, slope, second }
    }
}

impl Pair for Crown {
    #[inline(always)]
    fn of(&self, x: f64, order: usize) -> [f64; 2] {
        self.part_and_order(x, order)
    }

    #[inline(always)]
    fn of_lanes<S: Wide>(&self, delta: Lanes<S>) -> [Lanes<S>; 2] {
        let number = |number: f64| delta.plain(number);
        let square = delta / (delta + number(self.mean_depth));
        let s = square.sqrt();
        let ([a, b, c, d], t) = Lanes::cubics(s * number(NODES as f64), &self.cubics);
        let part = a + t * (b + t * (c + t * d));
        let by_s = (b + t * (number(2.0) * c + t * (number(3.0) * d))) * number(NODES as f64);
        let pace = number(0.5) * s * (number(1.0) - square);
        let slope = number(10.0 / 9.0) * part + pace * by_s;
        [part, number(0.0).if_less(part, slope / part, number(LINE_ORDER))]
    }
}

/// c and its slope over one step of s.
fn node(depths: &[f64], approach: f64, s: f64) -> [f64; 2] {
    let count = depths.len() as f64;
    let mean = depths.iter().sum::<f64>() / count;
    if approach == 0.0 {
        // Laminae without depth carry from the first, straight: the middle one of an odd number, or a flat middle.
        return [depths.iter().filter(|&&depth| depth == 0.0).count() as f64 / count, 0.0];
    }
    if approach.is_infinite() {
        // c = 1 − (10/9) P̄/δ + …, δ = P̄ s²/(1 − s²).
        return [1.0, 20.0 / 9.0 / NODES as f64];
    }
    let (mut part, mut by_ln) = (0.0, 0.0);
    for depth in depths.iter().filter(|&&depth| depth < approach) {
        let x = 1.0 - depth / approach;
        let root = ninth_root(x);
        part += x * root;
        by_ln += 10.0 / 9.0 * root * (depth / approach);
    }
    // dc/ds = δ c′/(s (1 − s²)/2)
    let pace = 0.5 * s * mean / (approach + mean);
    let by_s = if by_ln > 0.0 { by_ln / pace } else { 0.0 };
    [part / count, by_s / count / NODES as f64]
}

/// The cubic between two values with slopes per step, slopes lessened where it would not be monotonic. That of
/// `numerics::polynomials::hermite` adds its terms in another order, and rollers would have other bits.
fn monotonic([[from, leaving], [to, arriving]]: [[f64; 2]; 2]) -> [f64; 4] {
    let rise = to - from;
    let (leaving, arriving) = (leaving.min(3.0 * rise), arriving.min(3.0 * rise));
    [from, leaving, 3.0 * rise - 2.0 * leaving - arriving, leaving + arriving - 2.0 * rise]
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::Scalar256b;

    #[test]
    fn several_numbers_have_the_bits_of_each() {
        let crown = Crown::new(&depths(40));
        for i in 0..2000 {
            let first = f64::from(i * i) * 1e-12;
            let numbers = [first, 1.01 * first, if i == 7 { f64::NAN } else { 1e-3 * first }, 0.0, 0.0, 0.0, 0.0, 0.0];
            let found = Lanes::part(Scalar256b, &numbers, 0).pair(0, &crown);
            let mut lanes = [[0.0; 8]; 2];
            found.iter().zip(&mut lanes).for_each(|(found, lanes)| found.put(lanes, 0));
            for k in 0..4 {
                let alone = crown.part_and_order(numbers[k], 0);
                let bits = |number: f64| if number.is_nan() { 0 } else { number.to_bits() };
                assert_eq!([0, 1].map(|n| bits(lanes[n][k])), alone.map(bits), "{:e}", numbers[k]);
            }
        }
    }
    use crate::geometry::line_contact::logarithmic_depth;

    /// Crown of ISO/TS 16281 on a roller of 7.5 × 9 mm.
    fn depths(laminae: u32) -> Vec<f64> {
        let x = |k: u32| 9e-3 * ((f64::from(k) + 0.5) / f64::from(laminae) - 0.5);
        (0..laminae).map(|k| logarithmic_depth(7.5e-3, 9e-3, x(k))).collect()
    }

    /// The lamina law itself: Q and Q′ over K.
    fn sum(depths: &[f64], delta: f64) -> [f64; 2] {
        let over = |depth: &f64| (delta - depth).max(0.0);
        let mean = |power: f64| depths.iter().map(over).map(|over| over.powf(power)).sum::<f64>() / depths.len() as f64;
        let carrying = depths.iter().filter(|&&depth| depth < delta).map(|depth| (delta - depth).powf(1.0 / 9.0));
        [mean(10.0 / 9.0), 10.0 / 9.0 * carrying.sum::<f64>() / depths.len() as f64]
    }

    #[test]
    fn the_table_is_the_lamina_law_to_what_it_says() {
        // Laminae, least approach over the mean depth, largest error of force and of stiffness.
        for (laminae, least, limits) in [
            (40, 1.0, [2e-5, 0.02]),
            (40, 0.1, [5e-5, 0.07]),
            (640, 0.1, [4e-6, 0.005]),
            // All carry.
            (40, 10.0, [1e-12, 1e-10]),
        ] {
            let depths = depths(laminae);
            let crown = Crown::new(&depths);
            let mut worst = [0.0f64; 2];
            // Evenly over two decades; and where the stiffness rises steepest, as a lamina begins to carry.
            let first = least * crown.mean_depth();
            let even = (0..20_000).map(|i| first * 10f64.powf(f64::from(i) / 1e4));
            let beside = |&depth: &f64| {
                let off = (2..80).map(|k| 2f64.powf(-0.25 * f64::from(k)));
                off.flat_map(move |off| [depth * (1.0 - off), depth * (1.0 + off)])
            };
            // The other half is the same in a mirror.
            let steep = depths[..depths.len() / 2]
                .iter()
                .flat_map(beside)
                .filter(|delta| *delta >= first && *delta < 100.0 * first);
            for delta in even.chain(steep) {
                let [force, stiffness] = sum(&depths, delta);
                let Carrying { part, slope, .. } = crown.carrying(delta);
                let straight = delta * ninth_root(delta);
                worst[0] = worst[0].max((part * straight / force - 1.0).abs());
                worst[1] = worst[1].max((slope * straight / delta / stiffness - 1.0).abs());
            }
            println!("{laminae} laminae from {least} on: {worst:?}");
            assert!(worst[0] < limits[0] && worst[1] < limits[1], "{laminae} {least}: {worst:?}");
        }
    }

    #[test]
    fn laminae_without_depth_carry_from_the_first() {
        // The middle one of an odd number; and most of a long roller's.
        let long = |k: u32| logarithmic_depth(3e-3, 20e-3, 20e-3 * ((f64::from(k) + 0.5) / 40.0 - 0.5));
        for depths in [depths(41), (0..40).map(long).collect()] {
            let flat = depths.iter().filter(|&&depth| depth == 0.0).count() as f64 / depths.len() as f64;
            assert!(flat > 0.0);
            let crown = Crown::new(&depths);
            assert_eq!(crown.part_and_order(0.0, 0), [flat, 10.0 / 9.0]);
            assert_eq!([1, 2].map(|order| crown.part_and_order(0.0, order)), [[0.0; 2]; 2]);
            for part in [1e-12, 1e-9, 1e-8, 1e-7] {
                let delta = part * crown.mean_depth();
                let Carrying { part, slope, .. } = crown.carrying(delta);
                let [force, stiffness] = sum(&depths, delta);
                let straight = delta * ninth_root(delta);
                // A step of the table in which others begin to carry; nothing else does.
                assert!((part / flat - 1.0).abs() < 1e-12 && (part * straight / force - 1.0).abs() < 1e-12);
                assert!((slope * straight / delta / stiffness - 1.0).abs() < 1e-12, "{delta:e}");
            }
        }
    }

    #[test]
    fn force_and_stiffness_grow_with_the_approach() {
        let crown = Crown::new(&depths(40));
        let (mut force, mut last) = (-1.0, 0.0);
        for i in 0..1_000_000 {
            let delta = 5e-5 * (f64::from(i) / 1e6).powi(2);
            let now = crown.carrying(delta);
            let value = now.part * delta * ninth_root(delta);
            assert!(value >= force && now.part >= last && now.part <= 1.0 && now.slope >= 0.0, "{delta:e}: {now:?}");
            (force, last) = (value, now.part);
        }
    }

    #[test]
    fn beyond_all_laminae_the_whole_roller_carries() {
        let depths = depths(40);
        let crown = Crown::new(&depths);
        for delta in [1e-3, 1.0, 1e6] {
            let expected = sum(&depths, delta)[0] / delta.powf(10.0 / 9.0);
            assert!((crown.carrying(delta).part / expected - 1.0).abs() < 1e-9, "{delta}");
        }
        assert!(crown.carrying(f64::NAN).part.is_nan());
        assert_eq!(crown.part_and_order(0.0, 0), [0.0, 10.0 / 9.0]);
        assert_eq!(crown.part_and_order(0.0, 1), [0.0; 2]);
    }
}
