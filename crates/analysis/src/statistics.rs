//! Robust statistics, and a generator of random numbers that gives the same ones everywhere.

use brinell::numerics::counter_noise::{GOLDEN, mixed};

/// The value below which `share` of the values lie, between the two nearest in proportion; `None` of nothing.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut keys: Vec<i64> = values.iter().map(|&value| key(value)).collect();
    let at = share.clamp(0.0, 1.0) * (keys.len().checked_sub(1)?) as f64;
    let (_, &mut below, rest) = keys.select_nth_unstable(at as usize);
    let above = rest.iter().copied().min().unwrap_or(below);
    let (below, above) = (of_key(below), of_key(above));
    Some(below + at.fract() * (above - below))
}

/// A whole number that orders as [`f64::total_cmp`] does, which compares slower.
fn key(value: f64) -> i64 {
    turned(value.to_bits() as i64)
}

/// The value of a key.
fn of_key(key: i64) -> f64 {
    f64::from_bits(turned(key) as u64)
}

/// All bits but the sign turned around, of a negative number; done twice it changes nothing.
fn turned(bits: i64) -> i64 {
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

/// Median; 0 of nothing.
pub fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5).unwrap_or(0.0)
}

/// Mean; 0 of nothing.
pub fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}

/// Where the parabola through three neighbours at −1, 0 and 1 is highest; 0 if it has no maximum.
pub fn vertex([a, b, c]: [f64; 3]) -> f64 {
    let second = a - 2.0 * b + c;
    if second < 0.0 { 0.5 * (a - c) / second } else { 0.0 }
}

/// The least and the greatest; of nothing the infinities, the positive one first.
pub fn extent(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let wider = |[least, most]: [f64; 2], value: f64| [least.min(value), most.max(value)];
    values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], wider)
}

/// Standard deviation about the mean, with n − 1; 0 of fewer than two.
pub fn deviation(values: &[f64]) -> f64 {
    if values.len() < 2 {
        return 0.0;
    }
    let m = mean(values);
    (values.iter().map(|x| (x - m) * (x - m)).sum::<f64>() / (values.len() - 1) as f64).sqrt()
}

/// Root of the mean square; 0 of nothing.
pub fn rms(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt() }
}

/// Mean fourth power over the square of the mean square: 3 of normal noise; 0 of nothing and of silence.
pub fn kurtosis(values: &[f64]) -> f64 {
    let power = |n: i32| values.iter().map(|x| x.powi(n)).sum::<f64>();
    let squares = power(2);
    if squares > 0.0 { values.len() as f64 * power(4) / (squares * squares) } else { 0.0 }
}

/// Correlation of two series of equal length; 0 where one of them scatters by less than 0.05, for what is equal each
/// time shows nothing.
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let (mean_a, mean_b) = (mean(a), mean(b));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (x, y) in a.iter().zip(b) {
        ab += (x - mean_a) * (y - mean_b);
        aa += (x - mean_a) * (x - mean_a);
        bb += (y - mean_b) * (y - mean_b);
    }
    let least = 0.05 * 0.05 * a.len() as f64;
    if aa > least && bb > least { ab / (aa * bb).sqrt() } else { 0.0 }
}

/// Half the span between the 16 % and the 84 % quantile: the standard deviation, were the values normal.
pub fn spread(values: &[f64]) -> f64 {
    match (quantile(values, 0.1587), quantile(values, 0.8413)) {
        (Some(low), Some(high)) => 0.5 * (high - low),
        _ => 0.0,
    }
}

/// SplitMix64 (Steele, Lea and Flood 2014): the bootstrap must give equal results for equal recordings.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for each seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        let next = mixed(self.0);
        self.0 = self.0.wrapping_add(GOLDEN);
        next
    }

    /// Uniform below `count`, which must be above 0; the bias of the remainder is below count/2⁶⁴.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// Uniform in 0 … 1.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Standard normal, by Box and Muller.
    pub fn normal(&mut self) -> f64 {
        let (u, v) = (1.0 - self.uniform(), self.uniform());
        (-2.0 * libm::log(u)).sqrt() * libm::cos(2.0 * std::f64::consts::PI * v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_is_that_of_the_sorted_values() {
        let mut random = Random::new(3);
        let drawn: Vec<f64> = (0..257).map(|_| random.normal()).collect();
        let ends = [-f64::MAX, -1.0, -1e-310, -0.0, 0.0, 1e-310, 1.0, f64::MAX];
        for values in [&drawn[..], &drawn[..2], &drawn[..1], &ends] {
            let mut sorted = values.to_vec();
            sorted.sort_by(f64::total_cmp);
            for k in 0..sorted.len() {
                let share = k as f64 / (sorted.len() - 1).max(1) as f64;
                let at = share * (sorted.len() - 1) as f64;
                let below = sorted[at as usize];
                let above = sorted.get(at as usize + 1).copied().unwrap_or(below);
                let expected = below + at.fract() * (above - below);
                assert_eq!(quantile(values, share).map(f64::to_bits), Some(expected.to_bits()), "{share}");
            }
        }
        assert_eq!(quantile(&[], 0.5), None);
        for value in [0.0, 1e-310, 1.0, f64::MAX, f64::INFINITY].into_iter().flat_map(|x| [x, -x]) {
            assert_eq!(of_key(key(value)).to_bits(), value.to_bits());
        }
    }
}
