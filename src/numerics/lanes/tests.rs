//! Every width gives the same bits.

use super::*;

/// Something with every operation.
struct Everything;

impl Each<1, 1> for Everything {
    type Sum = ([f64; WIDEST], bool);

    #[inline(always)]
    fn each<S: Wide>(&self, simd: S, [x]: [Lanes<S>; 1], sum: &mut Self::Sum) -> [Lanes<S>; 1] {
        let one = Lanes::splat(simd, 1.0);
        let y = ((x * x + one).sqrt() - x.or_zero() / (x.abs() + one)).at_most(-x + one);
        y.add_to(&mut sum.0, sum.1);
        sum.1 = S::F64_LANES == QUAD && !sum.1;
        [y]
    }
}

struct OnList<'a>(&'a [f64], &'a mut [f64]);

impl Kernel for OnList<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) -> f64 {
        let (mut sum, count) = (([0.0; WIDEST], false), self.0.len());
        Lists { from: [self.0], to: [self.1] }.for_each(simd, count, &Everything, &mut sum);
        sum_of(sum.0)
    }
}

#[test]
fn every_width_gives_the_same_bits() {
    for count in [8, 16, 40] {
        let x: Vec<f64> = (0..count).map(|i| (i as f64 - 5.3) * 0.77).collect();
        let (mut wide, mut narrow) = (vec![0.0; count], vec![0.0; count]);
        let sums = [widest(OnList(&x, &mut wide)), OnList(&x, &mut narrow).run(Scalar256b)];
        assert_eq!(sums[0].to_bits(), sums[1].to_bits());
        for i in 0..count {
            let expected = ((x[i] * x[i] + 1.0).sqrt() - x[i].max(0.0) / (x[i].abs() + 1.0)).min(-x[i] + 1.0);
            assert_eq!((wide[i].to_bits(), narrow[i].to_bits()), (expected.to_bits(), expected.to_bits()));
        }
    }
}

#[test]
fn nan_stays_nan() {
    for count in [8, 24] {
        let (mut x, mut wide, mut narrow) = (vec![1.0; count], vec![0.0; count], vec![0.0; count]);
        x[2] = f64::NAN;
        widest(OnList(&x, &mut wide));
        OnList(&x, &mut narrow).run(Scalar256b);
        assert!(wide[2].is_nan() && narrow[2].is_nan());
        assert!(wide[1].is_finite() && narrow[3].is_finite());
    }
}
