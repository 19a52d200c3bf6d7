//! A low-pass of finite length that shifts no phase: the ideal low-pass's impulse response under Kaiser's window.
//!
//! ```text
//! h(k) = sin(2π f k)/(π k) · I₀(β √(1 − (k/K)²))/I₀(β),   |k| ≤ K
//! ```
//! with the cut-off f in cycles per sample. Its gain is ½ at f, and deviates from 1 below and from 0 above a transition
//! by at most 10^(−A/20), for β = 0.1102 (A − 8.7) and a transition (A − 7.95)/(14.36 · 2K) wide (J. F. Kaiser,
//! *Nonrecursive digital filter design using the I0-sinh window function*, 1974; valid for A > 50 dB).

use std::f64::consts::{PI, TAU};

use crate::numerics::sin_cos;

/// Coefficients h(−K) … h(K) for K = `half`, cut-off `cutoff` [cycles per sample] and attenuation `attenuation` (dB).
/// Their sum is 1.
pub fn low_pass(half: usize, cutoff: f64, attenuation: f64) -> Vec<f64> {
    let beta = 0.1102 * (attenuation - 8.7);
    // One side; the other is its mirror image, to the bit.
    let side: Vec<f64> = (0..=half)
        .map(|k| {
            let share = k as f64 / half as f64;
            let ideal = if k == 0 { 2.0 * cutoff } else { sin_cos(TAU * cutoff * k as f64).0 / (PI * k as f64) };
            ideal * bessel_i0(beta * (1.0 - share * share).sqrt()) / bessel_i0(beta)
        })
        .collect();
    let sum = side[0] + 2.0 * side[1..].iter().rev().sum::<f64>();
    (0..=2 * half).map(|i| side[i.abs_diff(half)] / sum).collect()
}

/// Modified Bessel function of the first kind and order 0: Σ ((x/2)^k / k!)². All terms are positive, so nothing
/// cancels.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut sum, mut term, mut k) = (1.0, 1.0, 1.0);
    while term > 1e-17 * sum {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bessel_function_has_the_tabulated_values() {
        // Abramowitz and Stegun, table 9.8 times e^x; 10 printed digits.
        for (x, value) in [(0.0, 1.0), (1.0, 1.266_065_878), (5.0, 27.239_871_82), (10.0, 2_815.716_628)] {
            assert!((bessel_i0(x) / value - 1.0).abs() < 5e-10, "I0({x}) = {}", bessel_i0(x));
        }
    }

    #[test]
    fn it_lets_through_and_keeps_out_what_the_design_says() {
        for (half, cutoff, attenuation) in [(135, 0.5 / 9.0, 102.0), (30, 0.25, 102.0), (60, 0.1, 102.0)] {
            let h = low_pass(half, cutoff, attenuation);
            let gain = |f: f64| {
                let side: f64 = (1..=half).map(|k| h[half + k] * libm::cos(TAU * f * k as f64)).sum();
                h[half] + 2.0 * side
            };
            let (transition, ripple) =
                ((attenuation - 7.95) / (14.36 * 2.0 * half as f64), libm::pow(10.0, -attenuation / 20.0));
            assert!((gain(0.0) - 1.0).abs() < 1e-14);
            assert!((gain(cutoff) - 0.5).abs() < 1e-3, "{}", gain(cutoff));
            for i in 0..=2000 {
                let f = 0.5 * f64::from(i) / 2000.0;
                // Kaiser's formulas are fits: good to a tenth of the ripple or so.
                if f <= cutoff - 0.5 * transition {
                    assert!((gain(f) - 1.0).abs() < 1.2 * ripple, "{f}: {}", gain(f) - 1.0);
                } else if f >= cutoff + 0.5 * transition {
                    assert!(gain(f).abs() < 1.2 * ripple, "{f}: {}", gain(f));
                }
            }
            assert!(h.iter().eq(h.iter().rev()), "it has a phase");
        }
    }
}
