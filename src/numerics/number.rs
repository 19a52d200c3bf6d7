//! What a formula needs to be written once, for one number and for several side by side.

use super::lanes::{Lanes, WIDEST, Wide};
use std::ops::{Add, Mul, Sub};

/// A number, or several of them side by side.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// √x
    fn sqrt(self) -> Self;
    /// 0 for a negative value. NaN stays NaN: a force of zero would hide it.
    fn or_zero(self) -> Self;
    /// The smaller of two.
    fn at_most(self, limit: Self) -> Self;
    /// The same value everywhere.
    fn all(self, value: f64) -> Self;
    /// A function of each.
    fn each(self, function: impl Fn(f64) -> f64) -> Self;
    /// Two functions of each, found together.
    fn each_pair(self, function: impl Fn(f64) -> [f64; 2]) -> [Self; 2];
}

impl Number for f64 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        if self < 0.0 { 0.0 } else { self }
    }

    #[inline(always)]
    fn at_most(self, limit: Self) -> Self {
        self.min(limit)
    }

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        function(self)
    }

    #[inline(always)]
    fn each_pair(self, function: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        function(self)
    }
}

impl<S: Wide> Number for Lanes<S> {
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes::sqrt(self)
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        Lanes::or_zero(self)
    }

    #[inline(always)]
    fn at_most(self, limit: Self) -> Self {
        Lanes::at_most(self, limit)
    }

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Lanes::splat(self.0, value)
    }

    #[inline(always)]
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        let mut numbers = [0.0; WIDEST];
        self.put(&mut numbers, 0);
        for number in numbers.iter_mut().take(S::F64_LANES) {
            *number = function(*number);
        }
        Self::part(self.0, &numbers, 0)
    }

    #[inline(always)]
    fn each_pair(self, function: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        let (mut first, mut second) = ([0.0; WIDEST], [0.0; WIDEST]);
        self.put(&mut first, 0);
        // A loop over numbers side by side, which the compiler takes together where the function has no branch.
        for (first, second) in first.iter_mut().zip(&mut second).take(S::F64_LANES) {
            [*first, *second] = function(*first);
        }
        [Self::part(self.0, &first, 0), Self::part(self.0, &second, 0)]
    }
}
