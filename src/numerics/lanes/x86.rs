//! AVX2 and AVX-512. The machine's own maximum and minimum give their second operand where either is NaN.

use super::{Kernel, On, QUAD, WIDEST, Wide};
use pulp::x86::{V3, V4};
use pulp::{Simd, cast};

impl Wide for V3 {
    #[inline(always)]
    fn outlined<K: Kernel>(self, kernel: K) -> K::Output {
        self.vectorize(On(self, kernel))
    }

    type Quad = Self;

    #[inline(always)]
    fn quad(self) -> Self {
        self
    }

    #[inline(always)]
    fn four(self, numbers: [f64; QUAD]) -> Self::f64s {
        cast(numbers)
    }

    #[inline(always)]
    fn larger(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s {
        cast(self.avx._mm256_max_pd(cast(limit), cast(value)))
    }

    #[inline(always)]
    fn smaller(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s {
        cast(self.avx._mm256_min_pd(cast(limit), cast(value)))
    }

    #[inline(always)]
    fn largest_quads(self, most: [f64; QUAD], value: Self::f64s) -> [f64; QUAD] {
        pulp::cast(self.larger(pulp::cast(most), value))
    }

    #[inline(always)]
    fn add_lanes(self, sum: [f64; WIDEST], value: Self::f64s, upper: bool) -> [f64; WIDEST] {
        let mut halves: [Self::f64s; 2] = cast(sum);
        halves[usize::from(upper)] = self.add_f64s(halves[usize::from(upper)], value);
        cast(halves)
    }
}

impl Wide for V4 {
    #[inline(always)]
    fn outlined<K: Kernel>(self, kernel: K) -> K::Output {
        self.vectorize(On(self, kernel))
    }

    type Quad = V3;

    #[inline(always)]
    fn quad(self) -> V3 {
        *self
    }

    #[inline(always)]
    fn four(self, numbers: [f64; QUAD]) -> <V3 as Simd>::f64s {
        cast(numbers)
    }

    #[inline(always)]
    fn larger(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s {
        cast(self.avx512f._mm512_max_pd(cast(limit), cast(value)))
    }

    #[inline(always)]
    fn smaller(self, value: Self::f64s, limit: Self::f64s) -> Self::f64s {
        cast(self.avx512f._mm512_min_pd(cast(limit), cast(value)))
    }

    #[inline(always)]
    fn largest_quads(self, most: [f64; QUAD], value: Self::f64s) -> [f64; QUAD] {
        let [low, high]: [<V3 as Simd>::f64s; 2] = cast(value);
        self.quad().largest_quads(self.quad().largest_quads(most, low), high)
    }

    #[inline(always)]
    fn add_lanes(self, sum: [f64; WIDEST], value: Self::f64s, _: bool) -> [f64; WIDEST] {
        cast(self.add_f64s(cast(sum), value))
    }
}
