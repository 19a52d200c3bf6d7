//! Several numbers at a time, with the same bits on every machine.
//!
//! A kernel is compiled for AVX-512, for AVX2 and for what every machine has; which one runs is found out at run time.
//! Additions, products, quotients and square roots are rounded one by one, never fused, so the width changes no bit, as
//! long as sums over lanes have a fixed order: they are sums of eight lanes, to which a machine with four adds its
//! groups in turn.
//!
//! Lists of numbers have a multiple of [`WIDEST`] slots. Those beyond the last number are zeros and must stay so: a
//! machine with fewer lanes leaves out what it need not look at.

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use pulp::NullaryFnOnce;
use pulp::{Arch, Scalar256b, Simd};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Lanes that every machine has, or is made to have.
pub const QUAD: usize = 4;
/// Most lanes that any machine has.
pub const WIDEST: usize = 8;

/// Slots that a list of `count` numbers takes.
pub fn padded(count: usize) -> usize {
    count.next_multiple_of(WIDEST)
}

/// Whole blocks of eight numbers.
#[inline(always)]
pub fn blocks(list: &[f64]) -> &[[f64; WIDEST]] {
    list.as_chunks().0
}

/// Whole blocks of eight numbers.
#[inline(always)]
pub fn blocks_mut(list: &mut [f64]) -> &mut [[f64; WIDEST]] {
    list.as_chunks_mut().0
}

/// Each block and part of it that holds any of the first `count` numbers.
#[inline(always)]
pub fn groups<S: Wide>(count: usize) -> impl Iterator<Item = (usize, usize)> {
    let parts = WIDEST / S::F64_LANES;
    (0..count.div_ceil(S::F64_LANES)).map(move |group| (group / parts, group % parts))
}

/// An instruction set that has registers of four numbers, or of a multiple.
pub trait Wide: Simd {
    /// The same machine with four lanes.
    type Quad: Wide;

    /// The same machine with four lanes.
    fn quad(self) -> Self::Quad;

    /// Runs a kernel as a function of its own, not as a part of the caller. A step with all of its stages written out
    /// is longer than what a processor keeps decoded, which costs a third of the speed; and what few bearings need is
    /// in no register's way there.
    fn outlined<K: Kernel>(self, kernel: K) -> K::Output;

    /// Four numbers in one register.
    fn four(self, numbers: [f64; QUAD]) -> <Self::Quad as Simd>::f64s;

    /// The larger of two numbers in each lane; `value` where either is NaN.
    fn larger(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s;

    /// The smaller of two numbers in each lane; `value` where either is NaN.
    fn smaller(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s;

    /// Adds to `sum`; four numbers to its upper or lower half.
    fn add_lanes(self, sum: [f64; WIDEST], value: Self::f64s, upper: bool) -> [f64; WIDEST];

    /// The largest of `most` and of all groups of four in `value`.
    fn largest_quads(self, most: [f64; QUAD], value: Self::f64s) -> [f64; QUAD];
}

impl Wide for Scalar256b {
    type Quad = Self;

    #[inline(always)]
    fn quad(self) -> Self {
        self
    }

    #[inline(never)]
    fn outlined<K: Kernel>(self, kernel: K) -> K::Output {
        kernel.run(self)
    }

    #[inline(always)]
    fn four(self, numbers: [f64; QUAD]) -> Self::f64s {
        pulp::cast(numbers)
    }

    #[inline(always)]
    fn larger(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s {
        self.select_f64s(self.less_than_f64s(value, limit), limit, value)
    }

    #[inline(always)]
    fn smaller(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s {
        self.select_f64s(self.less_than_f64s(limit, value), limit, value)
    }

    #[inline(always)]
    fn largest_quads(self, most: [f64; QUAD], value: Self::f64s) -> [f64; QUAD] {
        pulp::cast(self.larger(pulp::cast(most), value))
    }

    #[inline(always)]
    fn add_lanes(self, sum: [f64; WIDEST], value: Self::f64s, upper: bool) -> [f64; WIDEST] {
        let mut halves: [Self::f64s; 2] = pulp::cast(sum);
        halves[usize::from(upper)] = self.add_f64s(halves[usize::from(upper)], value);
        pulp::cast(halves)
    }
}

mod compiler;
mod partition;
pub mod row;
mod sums;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod x86;

pub use compiler::{handed_on, stay_a_branch};
pub use partition::Partition;
pub use sums::Sums;

/// What runs on several numbers at a time.
pub trait Kernel {
    /// What it gives.
    type Output;

    /// Runs; to be marked `inline(always)`, with all that it calls in its inner loops.
    fn run<S: Wide>(self, simd: S) -> Self::Output;
}

/// Runs a kernel with the widest registers of this machine.
#[cfg(not(test))]
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    widest(kernel)
}

/// Runs a kernel as a machine does that has no wide registers: the way that tests of the whole library do not take.
#[cfg(test)]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    kernel.run(Scalar256b)
}

#[inline]
fn widest<K: Kernel>(kernel: K) -> K::Output {
    match Arch::new() {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Arch::V4(simd) => simd.vectorize(On(simd, kernel)),
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Arch::V3(simd) => simd.vectorize(On(simd, kernel)),
        _ => kernel.run(Scalar256b),
    }
}

/// A kernel with the registers that it runs on.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
struct On<S, K>(S, K);

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
impl<S: Wide, K: Kernel> NullaryFnOnce for On<S, K> {
    type Output = K::Output;

    #[inline(always)]
    fn call(self) -> K::Output {
        self.1.run(self.0)
    }
}

/// What is done with each slot of some lists: `I` lists are read and `O` written.
pub trait Each<const I: usize, const O: usize> {
    /// What is summed up over the slots.
    type Sum;

    /// Several slots at a time. To be marked `inline(always)`.
    fn each<S: Wide>(&self, simd: S, from: [Lanes<S>; I], sum: &mut Self::Sum) -> [Lanes<S>; O];
}

/// Lists that are read and written together.
#[derive(Debug)]
pub struct Lists<'a, const I: usize, const O: usize> {
    /// Those that are read.
    pub from: [&'a [f64]; I],
    /// Those that are written.
    pub to: [&'a mut [f64]; O],
}

impl<const I: usize, const O: usize> Lists<'_, I, O> {
    /// Treats the first `count` slots, and perhaps some of those that fill the lists up.
    // Loops instead of `map` over arrays, which the compiler does not always resolve.
    #[inline(always)]
    pub fn for_each<S: Wide, E: Each<I, O>>(self, simd: S, count: usize, each: &E, sum: &mut E::Sum) {
        let groups = count.div_ceil(S::F64_LANES);
        let mut from: [&[S::f64s]; I] = [&[]; I];
        for (registers, list) in from.iter_mut().zip(self.from) {
            // Equal lengths, seen once, spare the check at every access.
            *registers = &S::as_simd_f64s(list).0[..groups];
        }
        let mut to: [&mut [S::f64s]; O] = std::array::from_fn(|_| Default::default());
        for (registers, list) in to.iter_mut().zip(self.to) {
            *registers = &mut S::as_mut_simd_f64s(list).0[..groups];
        }
        for k in 0..groups {
            let mut values = [Lanes::splat(simd, 0.0); I];
            for (value, list) in values.iter_mut().zip(&from) {
                value.1 = list[k];
            }
            let found = each.each(simd, values, sum);
            for (list, value) in to.iter_mut().zip(found) {
                list[k] = value.1;
            }
        }
    }
}

/// Each list from index `start` on.
#[inline(always)]
pub fn after<const I: usize>(lists: [&[f64]; I], start: usize) -> [&[f64]; I] {
    let mut rest: [&[f64]; I] = [&[]; I];
    for (rest, list) in rest.iter_mut().zip(lists) {
        *rest = &list[start..];
    }
    rest
}

/// Some numbers in one register.
#[derive(Debug, Clone, Copy)]
pub struct Lanes<S: Simd>(pub(super) S, pub(super) S::f64s);

impl<S: Wide> Lanes<S> {
    /// The same number in all lanes.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self(simd, simd.splat_f64s(value))
    }

    /// Four numbers.
    #[inline(always)]
    pub fn of(simd: S, numbers: [f64; QUAD]) -> Lanes<S::Quad> {
        Lanes(simd.quad(), simd.four(numbers))
    }

    /// Those of eight numbers that belong to one part of them, in parts of as many as there are lanes.
    #[inline(always)]
    pub fn part(simd: S, numbers: &[f64; WIDEST], part: usize) -> Self {
        Self(simd, S::as_simd_f64s(numbers).0[part])
    }

    /// Puts the numbers in their part of eight.
    #[inline(always)]
    pub fn put(self, numbers: &mut [f64; WIDEST], part: usize) {
        S::as_mut_simd_f64s(numbers).0[part] = self.1;
    }

    /// Puts the numbers at index `at` of a list.
    #[inline(always)]
    pub fn store(self, to: &mut [f64], at: usize) {
        S::as_mut_simd_f64s(&mut to[at..at + S::F64_LANES]).0[0] = self.1;
    }

    /// A function of each number by itself; the compiler takes them together where it has no branch.
    #[inline(always)]
    pub fn each(self, of: impl Fn(f64) -> f64) -> Self {
        let mut numbers = [0.0; WIDEST];
        self.put(&mut numbers, 0);
        for number in numbers.iter_mut().take(S::F64_LANES) {
            *number = of(*number);
        }
        Self::part(self.0, &numbers, 0)
    }

    /// The cubic of each number's step in a table, coefficients from the constant on, and where in that step the number
    /// is; `steps` count from the table's beginning. NaN has the first step and stays NaN.
    #[inline(always)]
    pub fn cubics(steps: Self, table: &[[f64; 4]]) -> ([Self; 4], Self) {
        let (mut numbers, mut coefficients) = ([0.0; WIDEST], [[0.0; WIDEST]; 4]);
        steps.put(&mut numbers, 0);
        for (i, number) in numbers.iter_mut().enumerate().take(S::F64_LANES) {
            let step = (*number as usize).min(table.len() - 1);
            for (coefficient, of_step) in coefficients.iter_mut().zip(table[step]) {
                coefficient[i] = of_step;
            }
            *number = step as f64;
        }
        let part = |numbers: &[f64; WIDEST]| Self::part(steps.0, numbers, 0);
        (coefficients.each_ref().map(part), steps - part(&numbers))
    }

    /// Square root.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self(self.0, self.0.sqrt_f64s(self.1))
    }

    /// Magnitude.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self(self.0, self.0.abs_f64s(self.1))
    }

    /// 0 where the number is negative; NaN stays NaN.
    #[inline(always)]
    pub fn or_zero(self) -> Self {
        self.at_least(Self::splat(self.0, 0.0))
    }

    /// The larger of two; where this is NaN, this.
    #[inline(always)]
    pub fn at_least(self, limit: Self) -> Self {
        Self(self.0, self.0.larger(self.1, limit.1))
    }

    /// The smaller of two; where this is NaN, this.
    #[inline(always)]
    pub fn at_most(self, limit: Self) -> Self {
        Self(self.0, self.0.smaller(self.1, limit.1))
    }

    /// In each lane `yes` where this is less than `limit`, else `no`; also where either is NaN.
    #[inline(always)]
    pub fn if_less(self, limit: Self, yes: Self, no: Self) -> Self {
        Self(self.0, self.0.select_f64s(self.0.less_than_f64s(self.1, limit.1), yes.1, no.1))
    }

    /// Adds to `sum`, by lanes. Groups of four go to its lower and upper half in turn, which whoever calls keeps count
    /// of.
    #[inline(always)]
    pub fn add_to(self, sum: &mut [f64; WIDEST], upper: bool) {
        *sum = self.0.add_lanes(*sum, self.1, upper);
    }

    /// Puts the largest of all groups of four and of `most` into `most`.
    #[inline(always)]
    pub fn largest_to(self, most: &mut [f64; QUAD]) {
        *most = self.0.largest_quads(*most, self.1);
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $operation:ident) => {
        impl<S: Simd> $trait for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0, self.0.$operation(self.1, other.1))
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0, self.0.neg_f64s(self.1))
    }
}

/// Sum of all lanes.
#[inline(always)]
pub fn sum_of(lanes: [f64; WIDEST]) -> f64 {
    let four: [f64; QUAD] = std::array::from_fn(|i| lanes[i] + lanes[i + QUAD]);
    (four[0] + four[2]) + (four[1] + four[3])
}

/// The largest of four lanes.
#[inline(always)]
pub fn largest_of(lanes: [f64; QUAD]) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    larger(larger(lanes[0], lanes[1]), larger(lanes[2], lanes[3]))
}

#[cfg(test)]
mod tests;
