//! Random numbers that are a function of where they stand: no generator, no state, equal bits on every machine.

use super::trigonometry::sin_cos;
use std::f64::consts::TAU;

/// A number of the standard normal distribution that depends on nothing but `seed`, `course` and `index` (Box and
/// Muller 1958).
pub fn gaussian(seed: u64, course: u64, index: i64) -> f64 {
    let key = bits(seed, course, index);
    // In (0, 1), never 0.
    let uniform = |bits: u64| ((bits >> 11) as f64 + 0.5) * (1.0 / (1u64 << 53) as f64);
    let (radius, angle) = (uniform(mixed(key)), uniform(mixed(key ^ OTHER)));
    (-2.0 * libm::log(radius)).sqrt() * sin_cos(TAU * angle).1
}

/// `count` numbers of a `course` that depend on `seed` alone, of this root mean square and of sum 0.
pub fn centred_draw(count: usize, rms: f64, seed: u64, course: u64) -> Vec<f64> {
    let drawn: Vec<f64> = (0..count).map(|j| gaussian(seed, course, j as i64)).collect();
    let centred = centred(&drawn);
    let present = (centred.iter().map(|x| x * x).sum::<f64>() / count as f64).sqrt();
    // One alone has nothing to be uneven against.
    let scale = if present > 0.0 { rms / present } else { 0.0 };
    centred.iter().map(|x| scale * x).collect()
}

/// Numbers less their mean, so that their sum is 0.
pub fn centred(numbers: &[f64]) -> Vec<f64> {
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    numbers.iter().map(|x| x - mean).collect()
}

/// A number that is uniform in [0, 1) and depends on nothing but `seed`, `course` and `index`.
pub fn uniform(seed: u64, course: u64, index: i64) -> f64 {
    (mixed(bits(seed, course, index)) >> 11) as f64 / (1u64 << 53) as f64
}

/// 64 random bits that depend on nothing but `seed`, `course` and `index`: a seed for what is drawn within.
pub fn bits(seed: u64, course: u64, index: i64) -> u64 {
    mixed(mixed(mixed(seed) ^ course) ^ index as u64)
}

/// Any number that is not 0: it makes a second number for the same index.
const OTHER: u64 = 0x5851_f42d_4c95_7f2d;

/// What SplitMix64's state (Steele, Lea and Flood 2014) grows by from one number to the next: 2⁶⁴ over the golden
/// ratio.
pub const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The number that SplitMix64 (Steele, Lea and Flood 2014) gives in state `x`. Every bit of it depends on every bit of
/// `x`, and no two states give the same.
pub fn mixed(x: u64) -> u64 {
    let x = x.wrapping_add(GOLDEN);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_normal_and_depend_on_seed_course_and_index() {
        let draw = |seed, course, n: i64| (0..n).map(|k| gaussian(seed, course, k)).collect::<Vec<_>>();
        let numbers = draw(1, 1, 100_000);
        let moment = |power: i32| numbers.iter().map(|x| x.powi(power)).sum::<f64>() / numbers.len() as f64;
        // Four standard errors of 100 000: 0.003, 0.0045, 0.012, 0.03.
        assert!(moment(1).abs() < 0.013 && (moment(2) - 1.0).abs() < 0.018, "{} {}", moment(1), moment(2));
        assert!(moment(3).abs() < 0.05 && (moment(4) - 3.0).abs() < 0.13, "{} {}", moment(3), moment(4));
        let few = draw(1, 1, 5);
        for other in [draw(2, 1, 5), draw(1, 0, 5), draw(1, 2, 5)] {
            assert!(few.iter().zip(&other).all(|(a, b)| a != b));
        }
        let even: Vec<f64> = (0..100_000).map(|k| uniform(1, 1, k)).collect();
        // Four standard errors: 0.0037 of the mean, 0.0012 of the variance.
        let mean = even.iter().sum::<f64>() / even.len() as f64;
        let variance = even.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / even.len() as f64;
        assert!((mean - 0.5).abs() < 0.0037 && (variance - 1.0 / 12.0).abs() < 0.0012, "{mean} {variance}");
        assert!(even.iter().all(|x| (0.0..1.0).contains(x)));
        // The first number of SplitMix64 from 0, as published with it.
        assert_eq!(mixed(0), 0xe220_a839_7b1d_cdaf);
    }
}
