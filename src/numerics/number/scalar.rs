//! One number at a time, by itself or with derivatives: what tables, searches and jumps between branches can be asked
//! with.

use super::{Dual, Number};
use crate::numerics::direction_angle;
use num_traits::{One, Zero};
use std::ops::{AddAssign, MulAssign, SubAssign};

/// A number, or a [dual](Dual) one.
pub trait Scalar:
    Number<Plain: From<f64>> + From<f64> + nalgebra::Scalar + Zero + One + AddAssign + SubAssign + MulAssign
{
    /// The number without its derivatives.
    fn value(self) -> f64;

    /// Another number with the derivatives of this one.
    fn moved_to(self, value: f64) -> Self;

    /// Angle (rad) of a direction given by its parts along x and y.
    fn angle_of(direction: [Self; 2]) -> Self;

    /// How deep derivatives are nested: 0 of a plain number.
    const DEPTH: usize;

    /// Whether it has derivatives. A constant, so that a branch that is not taken is not compiled.
    const CHANGES: bool = Self::DEPTH > 0;

    /// The number at which `residual` vanishes, known to be `root` without its derivatives; `slope` is the residual's
    /// there. Each of Newton's steps gives one more order of derivatives, exactly.
    #[inline(always)]
    fn root_of(root: f64, slope: f64, mut residual: impl FnMut(Self) -> Self) -> Self {
        let mut found = Self::from(root);
        for _ in 0..Self::DEPTH {
            found = (found - residual(found) * Self::Plain::from(1.0 / slope)).moved_to(root);
        }
        found
    }

    /// A function of two numbers and its derivatives by them, [f, f_x, f_y], of which the values are `first`. `second`
    /// gives [f_xx, f_xy, f_yy] anywhere near; it is not asked for plain numbers. Third derivatives, which dual numbers
    /// of dual numbers need, are central differences of the second over `step`.
    ///
    /// # Errors
    /// Those of `second`.
    fn surface<E>(
        at: [Self; 2],
        first: [f64; 3],
        step: f64,
        second: &mut impl FnMut([f64; 2]) -> Result<[f64; 3], E>,
    ) -> Result<[Self; 3], E>;

    /// Numbers of this kind whose values are `of` the values at a point; derivatives are central differences.
    ///
    /// # Errors
    /// Those of `of`.
    fn differenced<E>(
        at: [Self; 2],
        step: f64,
        of: &mut impl FnMut([f64; 2]) -> Result<[f64; 3], E>,
    ) -> Result<[Self; 3], E>;
}

impl Scalar for f64 {
    const DEPTH: usize = 0;

    #[inline(always)]
    fn value(self) -> f64 {
        self
    }

    #[inline(always)]
    fn moved_to(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn angle_of([x, y]: [f64; 2]) -> f64 {
        direction_angle([x, y])
    }

    #[inline(always)]
    fn surface<E>(
        _: [f64; 2],
        first: [f64; 3],
        _: f64,
        _: &mut impl FnMut([f64; 2]) -> Result<[f64; 3], E>,
    ) -> Result<[f64; 3], E> {
        Ok(first)
    }

    fn differenced<E>(
        at: [f64; 2],
        _: f64,
        of: &mut impl FnMut([f64; 2]) -> Result<[f64; 3], E>,
    ) -> Result<[f64; 3], E> {
        of(at)
    }
}

impl<N: Scalar, const K: usize> From<f64> for Dual<N, K> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self::constant(N::from(value))
    }
}

impl<N: Scalar, const K: usize> Scalar for Dual<N, K> {
    const DEPTH: usize = N::DEPTH + 1;

    #[inline(always)]
    fn value(self) -> f64 {
        self.value.value()
    }

    #[inline(always)]
    fn moved_to(self, value: f64) -> Self {
        Self { value: self.value.moved_to(value), ..self }
    }

    #[inline(always)]
    fn angle_of([x, y]: [Self; 2]) -> Self {
        let square = x.value * x.value + y.value * y.value;
        let by = std::array::from_fn(|k| (x.value * y.by[k] - y.value * x.by[k]) / square);
        Self { value: N::angle_of([x.value, y.value]), by }
    }

    fn surface<E>(
        [x, y]: [Self; 2],
        first: [f64; 3],
        step: f64,
        second: &mut impl FnMut([f64; 2]) -> Result<[f64; 3], E>,
    ) -> Result<[Self; 3], E> {
        let at = [x.value, y.value];
        let [f, f_x, f_y] = N::surface(at, first, step, second)?;
        let [xx, xy, yy] = N::differenced(at, step, second)?;
        let along =
            |value: N, by_x: N, by_y: N| Self { value, by: std::array::from_fn(|k| by_x * x.by[k] + by_y * y.by[k]) };
        Ok([along(f, f_x, f_y), along(f_x, xx, xy), along(f_y, xy, yy)])
    }

    fn differenced<E>(
        [x, y]: [Self; 2],
        step: f64,
        of: &mut impl FnMut([f64; 2]) -> Result<[f64; 3], E>,
    ) -> Result<[Self; 3], E> {
        let mut found = N::differenced([x.value, y.value], step, of)?.map(Self::constant);
        for k in 0..K {
            let along = [x.by[k].value(), y.by[k].value()];
            let length = along[0].abs().max(along[1].abs());
            if length == 0.0 {
                continue;
            }
            let share = step / length;
            let mut at = |share: f64| of([x.value() + share * along[0], y.value() + share * along[1]]);
            let (after, before) = (at(share)?, at(-share)?);
            for ((found, after), before) in found.iter_mut().zip(after).zip(before) {
                found.by[k] = N::from((after - before) / (2.0 * share));
            }
        }
        Ok(found)
    }
}
