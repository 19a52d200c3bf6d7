//! What a formula needs to be written once: for one number, for several side by side, and for [dual numbers](Dual) that
//! carry derivatives along.
//!
//! Selection is free of branches, so that lanes can do it, and takes the derivatives of the branch that holds.

mod dual;
mod scalar;

pub use dual::Dual;
pub use scalar::Scalar;

use super::elementary::ninth_root::{first, ninth_root, root_from};
use super::lanes::{Lanes, Wide};
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
    /// The same with the derivatives of both sides' mean at 0, as a difference across it has.
    #[inline(always)]
    fn or_zero_across(self) -> Self {
        self.or_zero()
    }
    /// The smaller of two.
    fn at_most(self, limit: Self) -> Self;
    /// Two functions of each number, or their derivatives of any `order`.
    fn pair(self, order: usize, of: &impl Pair) -> [Self; 2];
}

/// Two functions of a number that are worked out together.
pub trait Pair {
    /// Their derivatives of any `order`.
    fn of(&self, x: f64, order: usize) -> [f64; 2];

    /// Both of several numbers, with the same bits as of each.
    fn of_lanes<S: Wide>(&self, x: Lanes<S>) -> [Lanes<S>; 2];
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
    fn pair(self, order: usize, of: &impl Pair) -> [f64; 2] {
        of.of(self, order)
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
        root_from(self, self.each(first), |number| Lanes::splat(self.0, number))
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
    fn pair(self, order: usize, of: &impl Pair) -> [Self; 2] {
        // Registers carry no derivatives, so that nobody asks for those.
        debug_assert_eq!(order, 0);
        of.of_lanes(self)
    }
}
