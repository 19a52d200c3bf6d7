//! A structure's own ringing, predicted from what went before.
//!
//! A structure that rings answers each impact with decaying oscillations, in which every sample follows from the ones
//! before,
//! ```text
//! x(i) = − Σ a(k) x(i − k) + e(i),   k = 1 … p
//! ```
//! The residual e holds what does not follow: the impacts themselves, and noise. The a(k) come from the recording's
//! autocorrelation by the recursion of Levinson and Durbin, whose filter is always stable. The span of p samples must
//! stay short against the time between two impacts, for the second would else be predicted from the first.
//!
//! In a stretch in which nothing happens e is noise, and the prediction can be carried on ([`Ringing::ahead`]): what
//! still rings of the last passage when the next element comes is known and can be taken off. Its a(k) are those of
//! least squares within the stretch, for decaying oscillations are no stationary process.

use crate::spectrum;

/// Share of white noise added to the autocorrelation: keeps the recursion off rounding where the recorder's filter
/// leaves nothing.
const FLOOR: f64 = 1e-6;

/// Share of the stretch's power added to the diagonal of the least squares: a thousandth of the amplitude is taken for
/// noise.
const RIDGE: f64 = 1e-6;

/// The residual of a prediction from `order` samples.
pub(crate) fn residual(signal: &[f64], order: usize) -> Vec<f64> {
    let filter = filter(&spectrum::autocorrelation(signal, order));
    (0..signal.len()).map(|i| filter.iter().take(i + 1).enumerate().map(|(k, a)| a * signal[i - k]).sum()).collect()
}

/// How a stretch rings on.
pub(crate) struct Ringing {
    /// −a(k), from k = 1 on.
    weights: Vec<f64>,
}

impl Ringing {
    /// Least squares over a stretch; `None` where it is too short for `order` unknowns, or not finite.
    pub(crate) fn of(stretch: &[f64], order: usize) -> Option<Self> {
        if stretch.len() < 3 * order {
            return None;
        }
        let power = stretch.iter().map(|x| x * x).sum::<f64>();
        let (mut normal, mut known) = (vec![vec![0.0; order]; order], vec![0.0; order]);
        for i in order..stretch.len() {
            for k in 0..order {
                for l in 0..order {
                    normal[k][l] += stretch[i - 1 - k] * stretch[i - 1 - l];
                }
                known[k] += stretch[i - 1 - k] * stretch[i];
            }
        }
        for (k, row) in normal.iter_mut().enumerate() {
            row[k] += RIDGE * power + f64::MIN_POSITIVE;
        }
        // The normal equations, solved with orthogonal transformations: their matrix is nearly singular except for the
        // ridge.
        Some(Self { weights: brinell_eigen::least_squares(&normal, &known).ok()? })
    }

    /// What follows `past`, if nothing happens.
    pub(crate) fn ahead(&self, past: &[f64], count: usize) -> Vec<f64> {
        let mut all = past[past.len().saturating_sub(self.weights.len())..].to_vec();
        let known = all.len();
        for _ in 0..count {
            let next = self.weights.iter().zip(all.iter().rev()).map(|(w, x)| w * x).sum();
            all.push(next);
        }
        all.split_off(known)
    }
}

/// 1, a(1) … a(p) of an autocorrelation at lags 0 … p.
fn filter(correlation: &[f64]) -> Vec<f64> {
    let mut a = vec![1.0];
    let mut error = correlation[0] * (1.0 + FLOOR);
    for m in 1..correlation.len() {
        let sum: f64 = a.iter().enumerate().map(|(k, x)| x * correlation[m - k]).sum();
        let reflection = if error > 0.0 { -sum / error } else { 0.0 };
        a.push(0.0);
        let before = a.clone();
        for k in 1..=m {
            a[k] = before[k] + reflection * before[m - k];
        }
        error *= 1.0 - reflection * reflection;
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Random;

    /// A resonator that decays by a tenth in seven samples and turns by a radian in each.
    fn rung(impacts: &[f64]) -> Vec<f64> {
        let (mut a, mut b) = (0.0, 0.0);
        let next = |&impact: &f64| {
            (a, b) = (impact + 2.0 * 0.985 * libm::cos(1.0) * a - 0.985 * 0.985 * b, a);
            a
        };
        impacts.iter().map(next).collect()
    }

    #[test]
    fn of_a_structure_that_rings_the_impacts_are_left() {
        let mut random = Random::new(1);
        let impacts: Vec<f64> = (0..20_000).map(|i| if i % 100 == 0 { 10.0 } else { 0.1 * random.normal() }).collect();
        let left = residual(&rung(&impacts), 8);
        // 20 000 samples give each coefficient within 1/√20 000 = 0.007, and the resonator's amplitude is six times the
        // impact's: 0.5 of 10.
        let worst = impacts.iter().zip(&left).skip(200).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 0.5, "{worst}");
    }

    #[test]
    fn ringing_goes_on_as_it_was() {
        let mut impacts = vec![0.0; 260];
        impacts[0] = 1.0;
        let all = rung(&impacts);
        let ahead = Ringing::of(&all[..200], 6).unwrap().ahead(&all[..200], 60);
        let scale = all[190..200].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        // The ridge takes a thousandth of the amplitude for noise.
        assert!(ahead.iter().zip(&all[200..]).all(|(a, b)| (a - b).abs() < 0.05 * scale));
        assert!(Ringing::of(&all[..10], 6).is_none());
    }
}
