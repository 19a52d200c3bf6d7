//! Fourier transforms of eight sequences at a time, one in each lane.
//!
//! For a filter the order of the frequencies is of no concern, so the forward transform (decimation in frequency,
//! radices 4, 2, 3, 5) leaves them in the order of reversed digits and the backward one (decimation in time) takes them
//! so: both in place. Lanes never mix, hence no shuffles, and the bits do not depend on the vector width of the
//! machine. Padding is not worked on: with `HALF` the second half of the sequence counts as zero before the forward
//! transform and is not formed by the backward one.
//!
//! Not normalised: backward after forward gives the sequence times its length.

use std::f64::consts::TAU;

use libm::sincos;
use pulp::Simd;

/// Sequences transformed together.
pub(super) const LANES: usize = 8;

/// One complex number of each sequence.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Eight {
    pub(super) re: [f64; LANES],
    pub(super) im: [f64; LANES],
}

/// A part of [`Eight`] in registers.
type Z<S> = (<S as Simd>::f64s, <S as Simd>::f64s);

/// One stage: every block is cut in `radix` parts that are combined.
#[derive(Debug, Clone)]
struct Stage {
    radix: usize,
    part: usize,
    /// e^(−2πi q k/block) for q = 0…part, k = 1…radix.
    turns: Vec<[f64; 2]>,
}

/// Plan for one length.
#[derive(Debug, Clone)]
pub(super) struct BatchedFft {
    length: usize,
    stages: Vec<Stage>,
    /// Where the forward transform leaves each frequency.
    slots: Vec<usize>,
}

/// The smallest length that is at least `least`, a multiple of four, and a product of twos, threes and fives.
pub(super) fn good_length(least: usize) -> usize {
    let mut length = least.max(4).next_multiple_of(4);
    loop {
        let mut rest = length;
        for prime in [2, 3, 5] {
            while rest.is_multiple_of(prime) {
                rest /= prime;
            }
        }
        if rest == 1 {
            return length;
        }
        length += 4;
    }
}

impl BatchedFft {
    /// Plan for a length from [`good_length`].
    pub(super) fn new(length: usize) -> Self {
        let mut stages = Vec::new();
        let mut slots = vec![0; length];
        let (mut block, mut weight) = (length, 1);
        while block > 1 {
            let radix = [4, 2, 3, 5].into_iter().find(|r| block.is_multiple_of(*r)).unwrap_or(block);
            let part = block / radix;
            let turn = |q: usize, k: usize| {
                let (sine, cosine) = sincos(TAU * ((q * k) % block) as f64 / block as f64);
                [cosine, -sine]
            };
            stages.push(Stage {
                radix,
                part,
                turns: (0..part).flat_map(|q| (1..radix).map(move |k| turn(q, k))).collect(),
            });
            for (frequency, slot) in slots.iter_mut().enumerate() {
                *slot += frequency / weight % radix * part;
            }
            weight *= radix;
            block = part;
        }
        Self { length, stages, slots }
    }

    /// Length of the sequences.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// Where the forward transform leaves each frequency.
    pub(super) fn slots(&self) -> &[usize] {
        &self.slots
    }

    /// Forward transform in place; with `HALF` the second half of `data` is not read.
    #[inline(always)]
    pub(super) fn forward<S: Simd, const HALF: bool>(&self, simd: S, data: &mut [Eight]) {
        let mut first = true;
        for stage in &self.stages {
            for block in data.chunks_exact_mut(stage.radix * stage.part) {
                match stage.radix {
                    4 if HALF && first => stage.down::<S, FourOfHalf, 4>(simd, block),
                    4 => stage.down::<S, Four<false>, 4>(simd, block),
                    2 => stage.down::<S, Two, 2>(simd, block),
                    3 => stage.down::<S, Three<false>, 3>(simd, block),
                    _ => stage.down::<S, Five<false>, 5>(simd, block),
                }
            }
            first = false;
        }
    }

    /// Backward transform in place; with `HALF` the second half of `data` is left as waste.
    #[inline(always)]
    pub(super) fn backward<S: Simd, const HALF: bool>(&self, simd: S, data: &mut [Eight]) {
        for (n, stage) in self.stages.iter().enumerate().rev() {
            for block in data.chunks_exact_mut(stage.radix * stage.part) {
                match stage.radix {
                    4 if HALF && n == 0 => stage.up::<S, Four<true>, 4, 2>(simd, block),
                    4 => stage.up::<S, Four<true>, 4, 4>(simd, block),
                    2 => stage.up::<S, Two, 2, 2>(simd, block),
                    3 => stage.up::<S, Three<true>, 3, 3>(simd, block),
                    _ => stage.up::<S, Five<true>, 5, 5>(simd, block),
                }
            }
        }
    }
}

impl Stage {
    #[inline(always)]
    fn down<S: Simd, B: Butterfly<R>, const R: usize>(&self, simd: S, block: &mut [Eight]) {
        for (q, turns) in self.turns.chunks_exact(R - 1).enumerate().take(self.part) {
            for piece in 0..LANES / S::F64_LANES {
                let mut x = [zero(simd); R];
                for k in 0..R {
                    x[k] = load::<S>(&block[q + k * self.part], piece);
                }
                x = B::of(simd, x);
                if self.part > 1 {
                    for k in 1..R {
                        x[k] = turned(simd, x[k], turns[k - 1]);
                    }
                }
                for k in 0..R {
                    store::<S>(&mut block[q + k * self.part], piece, x[k]);
                }
            }
        }
    }

    /// Only the first `KEPT` parts of the result are stored.
    #[inline(always)]
    fn up<S: Simd, B: Butterfly<R>, const R: usize, const KEPT: usize>(&self, simd: S, block: &mut [Eight]) {
        for (q, turns) in self.turns.chunks_exact(R - 1).enumerate().take(self.part) {
            for piece in 0..LANES / S::F64_LANES {
                let mut x = [zero(simd); R];
                for k in 0..R {
                    x[k] = load::<S>(&block[q + k * self.part], piece);
                }
                if self.part > 1 {
                    for k in 1..R {
                        x[k] = turned(simd, x[k], [turns[k - 1][0], -turns[k - 1][1]]);
                    }
                }
                x = B::of(simd, x);
                for k in 0..KEPT {
                    store::<S>(&mut block[q + k * self.part], piece, x[k]);
                }
            }
        }
    }
}

/// Multiplies each number by a real factor of its own.
#[inline(always)]
pub(super) fn scale<S: Simd>(simd: S, data: &mut [Eight], factors: &[[f64; LANES]]) {
    for (value, factors) in data.iter_mut().zip(factors) {
        for piece in 0..LANES / S::F64_LANES {
            let (z, factor) = (load::<S>(value, piece), S::as_simd_f64s(factors).0[piece]);
            store::<S>(value, piece, (simd.mul_f64s(z.0, factor), simd.mul_f64s(z.1, factor)));
        }
    }
}

#[inline(always)]
fn load<S: Simd>(from: &Eight, piece: usize) -> Z<S> {
    (S::as_simd_f64s(&from.re).0[piece], S::as_simd_f64s(&from.im).0[piece])
}

#[inline(always)]
fn store<S: Simd>(to: &mut Eight, piece: usize, value: Z<S>) {
    S::as_mut_simd_f64s(&mut to.re).0[piece] = value.0;
    S::as_mut_simd_f64s(&mut to.im).0[piece] = value.1;
}

#[inline(always)]
fn zero<S: Simd>(simd: S) -> Z<S> {
    (simd.splat_f64s(0.0), simd.splat_f64s(0.0))
}

#[inline(always)]
fn plus<S: Simd>(simd: S, a: Z<S>, b: Z<S>) -> Z<S> {
    (simd.add_f64s(a.0, b.0), simd.add_f64s(a.1, b.1))
}

#[inline(always)]
fn minus<S: Simd>(simd: S, a: Z<S>, b: Z<S>) -> Z<S> {
    (simd.sub_f64s(a.0, b.0), simd.sub_f64s(a.1, b.1))
}

/// Times a real number.
#[inline(always)]
fn times<S: Simd>(simd: S, a: Z<S>, factor: f64) -> Z<S> {
    let factor = simd.splat_f64s(factor);
    (simd.mul_f64s(a.0, factor), simd.mul_f64s(a.1, factor))
}

/// Times a complex number.
#[inline(always)]
fn turned<S: Simd>(simd: S, a: Z<S>, turn: [f64; 2]) -> Z<S> {
    let (c, s) = (simd.splat_f64s(turn[0]), simd.splat_f64s(turn[1]));
    let re = simd.sub_f64s(simd.mul_f64s(a.0, c), simd.mul_f64s(a.1, s));
    (re, simd.add_f64s(simd.mul_f64s(a.0, s), simd.mul_f64s(a.1, c)))
}

/// a − ib and a + ib forward, a + ib and a − ib backward.
#[inline(always)]
fn beside<S: Simd, const BACK: bool>(simd: S, a: Z<S>, b: Z<S>) -> [Z<S>; 2] {
    let less = (simd.add_f64s(a.0, b.1), simd.sub_f64s(a.1, b.0));
    let more = (simd.sub_f64s(a.0, b.1), simd.add_f64s(a.1, b.0));
    if BACK { [more, less] } else { [less, more] }
}

/// The transform of `R` numbers. A type and no function that is passed on: called through the latter, each operation
/// on a register is a call of its own, because what passes it on is not compiled for the processor that has the
/// register.
trait Butterfly<const R: usize> {
    fn of<S: Simd>(simd: S, numbers: [Z<S>; R]) -> [Z<S>; R];
}

struct Two;
struct Three<const BACK: bool>;
struct Four<const BACK: bool>;
/// [`Four`] with c = d = 0, forward.
struct FourOfHalf;
struct Five<const BACK: bool>;

impl Butterfly<2> for Two {
    #[inline(always)]
    fn of<S: Simd>(simd: S, [a, b]: [Z<S>; 2]) -> [Z<S>; 2] {
        [plus(simd, a, b), minus(simd, a, b)]
    }
}

impl<const BACK: bool> Butterfly<3> for Three<BACK> {
    #[inline(always)]
    fn of<S: Simd>(simd: S, [a, b, c]: [Z<S>; 3]) -> [Z<S>; 3] {
        // cos 60° and sin 60°.
        let sum = plus(simd, b, c);
        let middle = minus(simd, a, times(simd, sum, 0.5));
        let [x, y] = beside::<S, BACK>(simd, middle, times(simd, minus(simd, b, c), 0.866_025_403_784_438_6));
        [plus(simd, a, sum), x, y]
    }
}

impl<const BACK: bool> Butterfly<4> for Four<BACK> {
    #[inline(always)]
    fn of<S: Simd>(simd: S, [a, b, c, d]: [Z<S>; 4]) -> [Z<S>; 4] {
        let (even, odd) = (plus(simd, a, c), plus(simd, b, d));
        let [x, y] = beside::<S, BACK>(simd, minus(simd, a, c), minus(simd, b, d));
        [plus(simd, even, odd), x, minus(simd, even, odd), y]
    }
}

impl Butterfly<4> for FourOfHalf {
    #[inline(always)]
    fn of<S: Simd>(simd: S, [a, b, _, _]: [Z<S>; 4]) -> [Z<S>; 4] {
        let [x, y] = beside::<S, false>(simd, a, b);
        [plus(simd, a, b), x, minus(simd, a, b), y]
    }
}

impl<const BACK: bool> Butterfly<5> for Five<BACK> {
    #[inline(always)]
    fn of<S: Simd>(simd: S, [a, b, c, d, e]: [Z<S>; 5]) -> [Z<S>; 5] {
        // Cosines and sines of 72° and 144°.
        const COSINES: [f64; 2] = [0.309_016_994_374_947_45, -0.809_016_994_374_947_5];
        const SINES: [f64; 2] = [0.951_056_516_295_153_5, 0.587_785_252_292_473_1];
        let (s1, s2, d1, d2) = (plus(simd, b, e), plus(simd, c, d), minus(simd, b, e), minus(simd, c, d));
        let m1 = plus(simd, a, sum_of(simd, [s1, s2], COSINES));
        let m2 = plus(simd, a, sum_of(simd, [s1, s2], [COSINES[1], COSINES[0]]));
        let [x1, x4] = beside::<_, BACK>(simd, m1, sum_of(simd, [d1, d2], SINES));
        let [x2, x3] = beside::<_, BACK>(simd, m2, sum_of(simd, [d1, d2], [SINES[1], -SINES[0]]));
        [plus(simd, a, plus(simd, s1, s2)), x1, x2, x3, x4]
    }
}

/// f₀ p + f₁ q
#[inline(always)]
fn sum_of<S: Simd>(simd: S, [p, q]: [Z<S>; 2], factors: [f64; 2]) -> Z<S> {
    plus(simd, times(simd, p, factors[0]), times(simd, q, factors[1]))
}

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;

    fn sample(length: usize) -> Vec<Eight> {
        let value = |n: usize| ((n * 37) % 101) as f64 - 50.0;
        (0..length)
            .map(|i| Eight {
                re: std::array::from_fn(|l| value(i * 17 + l * 3)),
                im: std::array::from_fn(|l| value(i * 5 + l * 29 + 7)),
            })
            .collect()
    }

    #[test]
    fn forward_transform_equals_the_sum_it_stands_for_at_every_radix() {
        for length in [4, 8, 12, 20, 36, 60, 64, 100, 216, 256] {
            let plan = BatchedFft::new(length);
            let input = sample(length);
            let mut data = input.clone();
            plan.forward::<_, false>(Scalar::new(), &mut data);
            for frequency in 0..length {
                let found = data[plan.slots()[frequency]];
                let [mut re, mut im] = [0.0; 2];
                for (i, x) in input.iter().enumerate() {
                    let (s, c) = (-TAU * ((i * frequency) % length) as f64 / length as f64).sin_cos();
                    re += x.re[3] * c - x.im[3] * s;
                    im += x.re[3] * s + x.im[3] * c;
                }
                // Sums of up to 256 terms of 50: rounding of the direct sum.
                assert!((found.re[3] - re).abs() < 1e-10 && (found.im[3] - im).abs() < 1e-10, "{length} {frequency}");
            }
        }
    }

    #[test]
    fn backward_after_forward_is_the_sequence_times_its_length_also_where_half_of_it_is_padding() {
        for length in [4, 12, 40, 128, 180] {
            let plan = BatchedFft::new(length);
            let mut input = sample(length);
            let mut data = input.clone();
            plan.forward::<_, false>(Scalar::new(), &mut data);
            plan.backward::<_, false>(Scalar::new(), &mut data);
            let check = |data: &[Eight], input: &[Eight]| {
                for (a, b) in data.iter().zip(input) {
                    // Values up to 50 × 180, some ten roundings.
                    assert!((a.re[5] - b.re[5] * length as f64).abs() < 1e-10, "{length}");
                    assert!((a.im[5] - b.im[5] * length as f64).abs() < 1e-10, "{length}");
                }
            };
            check(&data, &input);
            // What stands in the second half must not matter.
            data.clone_from(&input);
            plan.forward::<_, true>(Scalar::new(), &mut data);
            let forward = data.clone();
            plan.backward::<_, true>(Scalar::new(), &mut data);
            check(&data[..length / 2], &input[..length / 2]);
            input[length / 2..].fill(Eight::default());
            plan.forward::<_, false>(Scalar::new(), &mut input);
            assert_eq!(forward, input);
        }
    }

    #[test]
    fn good_lengths_are_products_of_small_primes_and_not_far_above() {
        assert_eq!([1, 5, 64, 65, 109, 200, 254].map(good_length), [4, 8, 64, 72, 120, 200, 256]);
    }
}
