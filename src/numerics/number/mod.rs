//! What a formula needs to be written once: for one number, for several side by side, and for [dual numbers](Dual) that
//! carry derivatives along.
//!
//! Selection is free of branches, so that lanes can do it, and takes the derivatives of the branch that holds.

mod dual;
mod scalar;

pub use dual::Dual;
pub use scalar::Scalar;

use super::lanes::{Lanes, WIDEST, Wide};
use super::ninth_root;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, several of them side by side, or one with derivatives.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<Self::Plain, Output = Self>
    + Sub<Self::Plain, Output = Self>
    + Mul<Self::Plain, Output = Self>
{
    /// What constants are, of which there is nothing to derive: a product with one costs no more than it must.
    type Plain: Number<Plain: Copy>;

    /// A constant.
    fn plain(self, value: f64) -> Self::Plain;
    /// The same value everywhere.
    fn all(self, value: f64) -> Self;
    /// √x
    fn sqrt(self) -> Self;
    /// x^(1/9)
    fn ninth_root(self) -> Self;
    /// `yes` where this is less than `limit`, else `no`; also where either is NaN.
    fn if_less(self, limit: Self, yes: Self, no: Self) -> Self;
    /// 0 for a negative value. NaN stays NaN: a force of zero would hide it.
    fn or_zero(self) -> Self;
    /// The smaller of two.
    fn at_most(self, limit: Self) -> Self;
    /// Two functions of each number, worked out together: `of` gives their derivatives of any `order`.
    fn pair(self, order: usize, of: &impl Fn(f64, usize) -> [f64; 2]) -> [Self; 2];
}

impl Number for f64 {
    type Plain = f64;

    #[inline(always)]
    fn plain(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn all(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn ninth_root(self) -> f64 {
        ninth_root(self)
    }

    #[inline(always)]
    fn if_less(self, limit: f64, yes: f64, no: f64) -> f64 {
        if self < limit { yes } else { no }
    }

    #[inline(always)]
    fn or_zero(self) -> f64 {
        if self < 0.0 { 0.0 } else { self }
    }

    #[inline(always)]
    fn at_most(self, limit: f64) -> f64 {
        self.min(limit)
    }

    #[inline(always)]
    fn pair(self, order: usize, of: &impl Fn(f64, usize) -> [f64; 2]) -> [f64; 2] {
        of(self, order)
    }
}

impl<S: Wide> Number for Lanes<S> {
    type Plain = Self;

    #[inline(always)]
    fn plain(self, value: f64) -> Self {
        Lanes::splat(self.0, value)
    }

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Lanes::splat(self.0, value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes::sqrt(self)
    }

    #[inline(always)]
    fn ninth_root(self) -> Self {
        let mut numbers = [0.0; WIDEST];
        self.put(&mut numbers, 0);
        for number in numbers.iter_mut().take(S::F64_LANES) {
            *number = ninth_root(*number);
        }
        Self::part(self.0, &numbers, 0)
    }

    #[inline(always)]
    fn if_less(self, limit: Self, yes: Self, no: Self) -> Self {
        Lanes::if_less(self, limit, yes, no)
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
    fn pair(self, order: usize, of: &impl Fn(f64, usize) -> [f64; 2]) -> [Self; 2] {
        let (mut first, mut second) = ([0.0; WIDEST], [0.0; WIDEST]);
        self.put(&mut first, 0);
        // A loop over numbers side by side, which the compiler takes together where the function has no branch.
        for (first, second) in first.iter_mut().zip(&mut second).take(S::F64_LANES) {
            [*first, *second] = of(*first, order);
        }
        [Self::part(self.0, &first, 0), Self::part(self.0, &second, 0)]
    }
}
