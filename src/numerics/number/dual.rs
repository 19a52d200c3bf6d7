//! Dual numbers: a value with its derivatives by `K` directions, which every operation carries along exactly.
//!
//! They nest: of a dual number of dual numbers the derivatives have derivatives. Where a function has a kink the
//! derivatives are those of the branch that holds; at the kink itself those of the side on which it is constant, or
//! where a function says so the mean of both.

use super::{Number, Pair};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<N, const K: usize> {
    /// Value.
    pub value: N,
    /// Its derivative by each direction.
    pub by: [N; K],
}

/// Roots no smaller than this are divided by: 0 has a root without a slope, and 0 · ∞ would be NaN in every contact
/// without force. Far below any length, and its square is a number.
const LEAST_ROOT: f64 = 1e-60;

impl<N: Number, const K: usize> Dual<N, K> {
    /// A constant.
    #[inline(always)]
    pub fn constant(value: N) -> Self {
        Self { value, by: [value.all(0.0); K] }
    }

    /// The variable of one direction.
    #[inline(always)]
    pub fn variable(value: N, direction: usize) -> Self {
        let mut dual = Self::constant(value);
        dual.by[direction] = value.all(1.0);
        dual
    }

    /// A function of this with these value and slope at it.
    #[inline(always)]
    fn lifted(self, value: N, slope: N) -> Self {
        // Loops: an array's own functions are not resolved where there are many derivatives.
        let mut by = self.by;
        for k in 0..K {
            by[k] = slope * by[k];
        }
        Self { value, by }
    }

    #[inline(always)]
    fn with(self, other: Self, value: N, by: impl Fn(N, N) -> N) -> Self {
        let mut found = self.by;
        for k in 0..K {
            found[k] = by(found[k], other.by[k]);
        }
        Self { value, by: found }
    }
}

impl<N: Number, const M: usize> Dual<N, M> {
    /// The same where what this has its derivatives by are numbers with derivatives themselves.
    #[inline(always)]
    pub fn chained<const K: usize>(&self, of: &[Dual<N, K>]) -> Dual<N, K> {
        let mut found = Dual::constant(self.value);
        for (by, of) in self.by.iter().zip(of) {
            for k in 0..K {
                found.by[k] = found.by[k] + *by * of.by[k];
            }
        }
        found
    }
}

impl<N: Number, const K: usize> Number for Dual<N, K> {
    type Plain = N;

    #[inline(always)]
    fn plain(self, value: f64) -> N {
        self.value.all(value)
    }

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Self::constant(self.value.all(value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        let least = root.all(LEAST_ROOT);
        self.lifted(root, root.all(0.5) / root.if_less(least, least, root))
    }

    #[inline(always)]
    fn ninth_root(self) -> Self {
        let (root, least) = (self.value.ninth_root(), self.value.all(LEAST_ROOT));
        let ninefold = self.value.all(9.0) * self.value.if_less(least, least, self.value);
        self.lifted(root, root / ninefold)
    }

    #[inline(always)]
    fn if_less(self, limit: Self, yes: Self, no: Self) -> Self {
        let choose = |yes: N, no: N| self.value.if_less(limit.value, yes, no);
        yes.with(no, choose(yes.value, no.value), choose)
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        let (zero, mut by) = (self.value.all(0.0), self.by);
        for k in 0..K {
            by[k] = zero.if_less(self.value, by[k], zero);
        }
        Self { value: self.value.or_zero(), by }
    }

    #[inline(always)]
    fn or_zero_across(self) -> Self {
        let (zero, half) = (self.value.all(0.0), self.value.all(0.5));
        let mut found = self.or_zero();
        for k in 0..K {
            let at_zero = self.value.if_less(zero, zero, half * self.by[k]);
            found.by[k] = zero.if_less(self.value, self.by[k], at_zero);
        }
        found
    }

    #[inline(always)]
    fn at_most(self, limit: Self) -> Self {
        self.with(limit, self.value.at_most(limit.value), |this, that| limit.value.if_less(self.value, that, this))
    }

    #[inline(always)]
    fn pair(self, order: usize, of: &impl Pair) -> [Self; 2] {
        let (values, slopes) = (self.value.pair(order, of), self.value.pair(order + 1, of));
        [self.lifted(values[0], slopes[0]), self.lifted(values[1], slopes[1])]
    }
}

/// Sums and differences, of two numbers and with a constant.
macro_rules! termwise {
    ($($trait:ident $method:ident $operator:tt;)*) => {$(
        impl<N: Number, const K: usize> $trait for Dual<N, K> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(other, self.value $operator other.value, |a, b| a $operator b)
            }
        }

        impl<N: Number, const K: usize> $trait<N> for Dual<N, K> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, constant: N) -> Self {
                Self { value: self.value $operator constant, ..self }
            }
        }
    )*};
}
termwise! { Add add +; Sub sub -; }

impl<N: Number, const K: usize> Mul for Dual<N, K> {
    type Output = Self;

    // The product rule.
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, self.value * other.value, |a, b| a * other.value + b * self.value)
    }
}

impl<N: Number, const K: usize> Div for Dual<N, K> {
    type Output = Self;

    // The quotient rule.
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        self.with(other, quotient, |a, b| (a - b * quotient) / other.value)
    }
}

impl<N: Number, const K: usize> Neg for Dual<N, K> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let mut by = self.by;
        for k in 0..K {
            by[k] = -by[k];
        }
        Self { value: -self.value, by }
    }
}

impl<N: Number, const K: usize> Mul<N> for Dual<N, K> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, constant: N) -> Self {
        self.lifted(self.value * constant, constant)
    }
}

// What vectors and matrices of dual numbers ask for.
macro_rules! assigning {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<N: Number, const K: usize> $trait for Dual<N, K> {
            #[inline(always)]
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    };
}

assigning!(AddAssign, add_assign, +);
assigning!(SubAssign, sub_assign, -);
assigning!(MulAssign, mul_assign, *);

impl<N: Number + num_traits::Zero, const K: usize> num_traits::Zero for Dual<N, K> {
    #[inline(always)]
    fn zero() -> Self {
        Self { value: N::zero(), by: [N::zero(); K] }
    }

    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.by.iter().all(N::is_zero)
    }
}

impl<N: Number + num_traits::Zero + num_traits::One, const K: usize> num_traits::One for Dual<N, K> {
    #[inline(always)]
    fn one() -> Self {
        Self { value: N::one(), by: [N::zero(); K] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::lanes::{Lanes, Wide};
    use crate::numerics::number::Scalar;
    use proptest::prelude::*;

    /// x² and its derivatives except for their factors, which the formula takes times 0.
    struct Square;

    impl Pair for Square {
        fn of(&self, x: f64, order: usize) -> [f64; 2] {
            [x.powi(2 - order as i32); 2]
        }

        fn of_lanes<S: Wide>(&self, x: Lanes<S>) -> [Lanes<S>; 2] {
            [x * x; 2]
        }
    }

    /// Every operation in one formula.
    fn formula<T: Scalar>(x: T, y: T) -> T {
        let root = (x * x + y * y).sqrt();
        let bounded = (x - y).or_zero() + x.at_most(y) * T::Plain::from(0.5);
        let [chosen, other] = [x.if_less(y, x * y, x / y), (x * y).pair(0, &Square)[0]];
        (root.ninth_root() - -bounded / root) * chosen + T::angle_of([x, y]) + other * T::from(0.0)
    }

    /// A central difference of two step lengths, whose largest errors cancel.
    fn quotient(f: impl Fn(f64) -> f64) -> f64 {
        let over = |h: f64| (f(h) - f(-h)) / (2.0 * h);
        (4.0 * over(1e-4) - over(2e-4)) / 3.0
    }

    type Once = Dual<f64, 2>;
    type Twice = Dual<Once, 2>;

    proptest! {
        #[test]
        fn derivatives_and_second_derivatives_are_those_of_the_formula(x in 0.3..3.0f64, y in 0.3..3.0f64) {
            // Away from the kink, farther than differences reach.
            prop_assume!((x - y).abs() > 1e-3);
            let once = |x: f64, y: f64| formula(Once::variable(x, 0), Once::variable(y, 1));
            let twice = formula(
                Twice::variable(Once::variable(x, 0), 0),
                Twice::variable(Once::variable(y, 1), 1),
            );
            let found = once(x, y);
            prop_assert_eq!(found.value.to_bits(), formula(x, y).to_bits());
            let along = |k: usize, h: f64| if k == 0 { (x + h, y) } else { (x, y + h) };
            for k in 0..2 {
                let first = quotient(|h| { let (x, y) = along(k, h); formula(x, y) });
                // Truncation 1e-16/0.3⁵, rounding 1e-16/1e-4.
                prop_assert!((found.by[k] - first).abs() < 1e-10, "{k}: {} {first}", found.by[k]);
                // Another order of the same operations.
                prop_assert!((twice.by[k].value - found.by[k]).abs() < 1e-13);
                for l in 0..2 {
                    let second = quotient(|h| { let (x, y) = along(l, h); once(x, y).by[k] });
                    prop_assert!((twice.by[k].by[l] - second).abs() < 1e-9, "{k} {l}: {} {second}", twice.by[k].by[l]);
                }
            }
        }

        #[test]
        fn a_root_has_the_derivatives_of_what_it_is_the_root_of(x in 0.1..10.0f64) {
            // y³ = x from the plain cube root.
            let x = Twice::variable(Once::variable(x, 0), 0);
            let root = x.value().cbrt();
            let y = Twice::root_of(root, 3.0 * root * root, |y| y * y * y - x);
            let (first, second) = (1.0 / (3.0 * root * root), -2.0 / 9.0 * root.powi(-5));
            prop_assert!((y.by[0].value / first - 1.0).abs() < 1e-12);
            prop_assert!((y.by[0].by[0] / second - 1.0).abs() < 1e-11);
        }

        #[test]
        fn a_surface_carries_slopes_and_differences_of_second_derivatives(x in -1.0..1.0f64, y in -1.0..1.0f64) {
            // f = x³ y²: third derivatives by differences are exact except for rounding.
            let second = |[x, y]: [f64; 2]| Ok::<_, ()>([6.0 * x * y * y, 6.0 * x * x * y, 2.0 * x * x * x]);
            let of = |x: Twice, y: Twice| {
                let (a, b) = (x.value(), y.value());
                let first = [a * a * a * b * b, 3.0 * a * a * b * b, 2.0 * a * a * a * b];
                Twice::surface([x, y], first, 1e-3, &mut { second }).unwrap()
            };
            let x = Twice::variable(Once::variable(x, 0), 0);
            let y = Twice::variable(Once::variable(y, 1), 1);
            let [two, three] = [2.0, 3.0].map(Twice::from);
            let exact = [x * x * x * y * y, three * x * x * y * y, two * x * x * x * y];
            for (found, exact) in of(x, y).into_iter().zip(exact) {
                for k in 0..2 {
                    prop_assert!((found.by[k].value - exact.by[k].value).abs() < 1e-13);
                    for l in 0..2 {
                        prop_assert!((found.by[k].by[l] - exact.by[k].by[l]).abs() < 1e-5);
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_has_no_slope_and_nan_stays_nan() {
        let zero = Once::variable(0.0, 0).or_zero();
        for found in [zero, zero.sqrt(), zero.ninth_root(), zero.sqrt() * Once::constant(1e12)] {
            assert_eq!((found.value, found.by), (0.0, [0.0; 2]));
        }
        let nan = Once::variable(f64::NAN, 0);
        assert!(nan.or_zero().value.is_nan() && nan.sqrt().value.is_nan());
    }
}
