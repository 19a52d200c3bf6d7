//! Hermite's polynomial of degree five: value, rate and second derivative at both ends of a step; error of order h⁶.

use crate::numerics::number::Number;

/// The polynomial at a share of a step of this length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Quintic {
    h: f64,
    share: f64,
}

impl Quintic {
    /// For a step of `h` (s), and a share of it.
    #[inline(always)]
    pub(crate) fn new(h: f64, share: f64) -> Self {
        Self { h, share }
    }

    /// Value and rate from the values, rates and second derivatives at both ends.
    #[inline(always)]
    pub(crate) fn at<T: Number<Plain = T>>(&self, values: [T; 2], rates: [T; 2], seconds: [T; 2]) -> (T, T) {
        let number = |number: f64| values[0].plain(number);
        let s = number(self.share);
        let [x, rate, second, third, fourth, fifth] = self.coefficients(values, rates, seconds);
        let value = x + s * (rate + s * (number(0.5) * second + s * (third + s * (fourth + s * fifth))));
        let to_fifth = number(3.0) * third + s * (number(4.0) * fourth + s * number(5.0) * fifth);
        let slope = rate + s * (second + s * to_fifth);
        (value, slope / number(self.h))
    }

    /// Second derivative over the whole step, as a cubic in the share of it.
    pub(crate) fn second_derivative(&self, values: [f64; 2], rates: [f64; 2], seconds: [f64; 2]) -> [f64; 4] {
        let [_, _, second, third, fourth, fifth] = self.coefficients(values, rates, seconds);
        [second, 6.0 * third, 12.0 * fourth, 20.0 * fifth].map(|coefficient| coefficient / (self.h * self.h))
    }

    /// Coefficients of the polynomial in the share of the step, that of the square doubled.
    #[inline(always)]
    fn coefficients<T: Number<Plain = T>>(&self, [x, end]: [T; 2], rates: [T; 2], seconds: [T; 2]) -> [T; 6] {
        let number = |number: f64| x.plain(number);
        let (h, half) = (number(self.h), number(0.5));
        let [rate, end_rate] = [h * rates[0], h * rates[1]];
        let [second, end_second] = [h * h * seconds[0], h * h * seconds[1]];
        let difference = end - x - rate - half * second;
        let turn = end_rate - rate - second;
        let change = end_second - second;
        [
            x,
            rate,
            second,
            number(10.0) * difference - number(4.0) * turn + half * change,
            number(-15.0) * difference + number(7.0) * turn - change,
            number(6.0) * difference - number(3.0) * turn + half * change,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_degree_five_comes_out_as_it_is() {
        let x = |t: f64| 1.0 + t * (2.0 + t * (-3.0 + t * (0.5 + t * (4.0 - t))));
        let rate = |t: f64| 2.0 + t * (-6.0 + t * (1.5 + t * (16.0 - 5.0 * t)));
        let second = |t: f64| -6.0 + t * (3.0 + t * (48.0 - 20.0 * t));
        let h = 0.7;
        for share in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let ends = [0.0, h];
            let (value, slope) = Quintic::new(h, share).at(ends.map(x), ends.map(rate), ends.map(second));
            assert!((value - x(share * h)).abs() < 1e-14 && (slope - rate(share * h)).abs() < 1e-13, "{share}");
        }
    }
}
