//! What is made of a run's signal: level, peakedness, the envelope's lines at the passage frequency of the outer
//! raceway, and when an element passes a defect there.

use std::f64::consts::{PI, TAU};

use brinell::numerics::{sin_cos, wrap};
use brinell_analysis::spectrum::{Band, Spectrum};
use brinell_analysis::statistics::{mean, median, rms};

/// Multiples of the passage frequency at which the envelope is evaluated.
pub(in crate::sweep) const HARMONICS: usize = 5;

/// Figures of a signal.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::sweep) struct Statistics {
    /// Root mean square without the mean, and largest deviation from it (m/s²).
    pub(in crate::sweep) rms: f64,
    pub(in crate::sweep) peak: f64,
    /// Fourth moment over the squared second one: 3 for normal noise.
    pub(in crate::sweep) kurtosis: f64,
    /// Amplitudes of the envelope at multiples of the passage frequency (m/s²); none of a signal shorter than a
    /// passage.
    pub(in crate::sweep) envelope: Option<[f64; HARMONICS]>,
}

impl Statistics {
    /// Those of a signal at even times; `passages` is how many elements have passed a point of the outer raceway at
    /// each sample ([`passages`]), so that with a speed that changes the lines stay where they are.
    pub(in crate::sweep) fn of(signal: &[f64], passages: &[f64]) -> Self {
        let middle = mean(signal);
        let signal: Vec<f64> = signal.iter().map(|value| value - middle).collect();
        let rms = rms(&signal);
        let fourth = signal.iter().map(|x| (x * x) * (x * x)).sum::<f64>() / signal.len() as f64;
        let peak = signal.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let all = Band { low: 0.0, high: f64::INFINITY };
        let envelope: Vec<f64> =
            Spectrum::of(&signal, 1.0).squared_envelope(all).into_iter().map(|square| square.max(0.0).sqrt()).collect();
        let level = mean(&envelope);
        let last = signal.len().saturating_sub(1).max(1) as f64;
        let window: Vec<f64> = (0..signal.len()).map(|i| 0.5 - 0.5 * sin_cos(TAU * i as f64 / last).1).collect();
        let total: f64 = window.iter().sum();
        let line = |k: usize| {
            let mut sum = [0.0; 2];
            for ((value, weight), passed) in envelope.iter().zip(&window).zip(passages) {
                let (sine, cosine) = sin_cos(TAU * (k as f64 * passed).fract());
                let weighed = weight * (value - level);
                sum = [sum[0] + weighed * cosine, sum[1] + weighed * sine];
            }
            2.0 * sum[0].hypot(sum[1]) / total
        };
        let passed: f64 = passages.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
        let envelope = (passed >= 1.0).then(|| std::array::from_fn(|k| line(k + 1)));
        Self { rms, peak, kurtosis: fourth / (rms * rms * rms * rms), envelope }
    }
}

/// How many of `count` elements have passed a point of the outer raceway at these `times` (s), by the cage's speed
/// against that ring (rad/s) at the instants `at` (s), between which it changes evenly.
pub(in crate::sweep) fn passages(at: &[f64], speed: &[f64], count: usize, times: &[f64]) -> Vec<f64> {
    let mut passed = vec![0.0];
    for (at, speed) in at.windows(2).zip(speed.windows(2)) {
        let turned = 0.5 * (speed[0] + speed[1]) * (at[1] - at[0]);
        passed.push(passed[passed.len() - 1] + count as f64 * turned / TAU);
    }
    let between = |t: &f64| {
        let after = at.partition_point(|at| at <= t).clamp(1, at.len() - 1);
        let along = (t - at[after - 1]) / (at[after] - at[after - 1]);
        passed[after - 1] + along * (passed[after] - passed[after - 1])
    };
    times.iter().map(between).collect()
}

/// What one element does at each sample.
pub(in crate::sweep) struct OneElement<'a> {
    /// Its angle (rad), and its force on the outer raceway (N).
    pub(in crate::sweep) angle: &'a [f64],
    pub(in crate::sweep) force: &'a [f64],
}

/// The first passage of a defect of the outer raceway.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sweep) struct Passage {
    /// When an element loses half its force over the defect, and when it has regained it (s).
    pub(in crate::sweep) unloaded: f64,
    pub(in crate::sweep) loaded_again: f64,
    /// How far it turns in between (rad): a lower bound of a line spall's length.
    pub(in crate::sweep) turned: f64,
}

impl Passage {
    /// The first after `settle` (s) of a defect at an angle (rad), among so many elements.
    pub(in crate::sweep) fn first(time: &[f64], elements: &[OneElement<'_>], defect: f64, settle: f64) -> Option<Self> {
        let reach = 0.75 * PI / elements.len() as f64 + 0.3;
        let end = *time.last()?;
        for OneElement { angle, force } in elements {
            let loaded: Vec<f64> = force.iter().copied().filter(|&force| force > 0.0).collect();
            let half = 0.5 * median(&loaded);
            let near: Vec<bool> = angle.iter().map(|angle| wrap(angle - defect).abs() < reach).collect();
            let light = |i: usize| near[i] && force[i] < half && time[i] > settle;
            let begins = (1..time.len()).filter(|&i| light(i) && !light(i - 1) && near[i - 1]);
            for first in begins {
                let Some(again) = (first..time.len()).find(|&i| !light(i)) else { continue };
                if near[again] && time[first] - settle < 0.5 * (end - settle) {
                    let turned = wrap(angle[again] - angle[first]);
                    return Some(Self { unloaded: time[first], loaded_again: time[again], turned });
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn an_amplitude_that_swings_with_the_passages_shows_as_their_first_line_alone() {
        // A carrier of 0.2 per sample, 3 (1 + 0.5 cos 2π p), with 100 passages in 20 000 samples.
        let count = 20_000;
        let passages: Vec<f64> = (0..count).map(|i| 100.0 * f64::from(i) / f64::from(count)).collect();
        let swing = |p: f64| 3.0 * (1.0 + 0.5 * sin_cos(TAU * p.fract()).1);
        let signal: Vec<f64> =
            (0..count).zip(&passages).map(|(i, &p)| swing(p) * sin_cos(TAU * (0.2 * f64::from(i)).fract()).1).collect();
        let found = Statistics::of(&signal, &passages);
        // The Hann window's side lobes, 1/100³ of a line.
        let envelope = found.envelope.unwrap();
        assert!((envelope[0] - 1.5).abs() < 1e-4, "{found:?}");
        assert!(envelope[1..].iter().all(|&line| line < 1e-4), "{found:?}");
        // √(9 (1 + 1/8)/2), and for a sine of amplitude a: <a⁴> 3/8 over (<a²>/2)²; <a²> = 9·9/8, <a⁴> = 81·(1 + 3/4 +
        // 3/128).
        assert!((found.rms - (9.0_f64 * 1.125 / 2.0).sqrt()).abs() < 1e-4, "{found:?}");
        let fourth = 81.0 * (1.0 + 0.75 + 3.0 / 128.0) * 3.0 / 8.0;
        assert!((found.kurtosis - fourth / (81.0 * 1.125 * 1.125 / 4.0)).abs() < 1e-3, "{found:?}");
        assert!((found.peak - 4.5).abs() < 1e-2, "{found:?}");
    }

    #[test]
    fn a_signal_shorter_than_a_passage_has_no_lines_whichever_way_the_cage_turns() {
        let signal: Vec<f64> = (0..1000).map(|i| sin_cos(0.3 * f64::from(i)).0).collect();
        let times: Vec<f64> = (0..1000).map(|i| 1e-3 * f64::from(i)).collect();
        for (hertz, has) in [(0.9 / 9.0, false), (1.1 / 9.0, true), (-1.1 / 9.0, true), (0.0, false)] {
            let passed = passages(&times, &[TAU * hertz; 1000], 9, &times);
            assert_eq!(Statistics::of(&signal, &passed).envelope.is_some(), has, "{hertz} Hz");
        }
        // From 1 to 3 Hz in 0.999 s: half of that many times 4 Hz, and at half of the time 0.4995 (1 + 2)/2.
        let speed: Vec<f64> = times.iter().map(|t| TAU * (1.0 + 2.0 * t / 0.999)).collect();
        let passed = passages(&times, &speed, 9, &[0.0, 0.4995, 0.999]);
        for (found, expected) in passed.iter().zip([0.0, 9.0 * 0.4995 * 1.5, 9.0 * 0.999 * 2.0]) {
            // Between two instants the count goes straight: 9 · 2/0.999 · (1 ms)²/8.
            assert!((found - expected).abs() < 3e-6, "{found} {expected}");
        }
    }

    #[test]
    fn a_passage_is_where_an_element_loses_its_force_over_the_defect_and_not_elsewhere() {
        // Two turns of one of nine elements; without force from −0.1 to 0.15 rad about a defect at 1 rad, and opposite.
        let count = 4000;
        let time: Vec<f64> = (0..count).map(|i| f64::from(i) / f64::from(count)).collect();
        let angle: Vec<f64> = time.iter().map(|t| 2.0 * TAU * t).collect();
        let force: Vec<f64> = angle
            .iter()
            .map(|&a| {
                let away = wrap(a - 1.0);
                if (-0.1..0.15).contains(&away) || away.abs() > 3.0 { 0.0 } else { 100.0 }
            })
            .collect();
        let idle = vec![0.0; count as usize];
        let mut elements = vec![OneElement { angle: &angle, force: &force }];
        elements.extend((1..9).map(|_| OneElement { angle: &angle, force: &idle }));
        let found = Passage::first(&time, &elements, 1.0, 0.01).map(|p| (p.unloaded, p.loaded_again, p.turned));
        let (unloaded, again, turned) = found.unwrap_or_default();
        // A sample is 3.1 mrad.
        assert!((2.0 * TAU * unloaded - 0.9).abs() < 4e-3 && (2.0 * TAU * again - 1.15).abs() < 4e-3, "{found:?}");
        assert!((turned - 0.25).abs() < 8e-3, "{found:?}");
        assert_eq!(Passage::first(&time, &elements, -1.5, 0.01), None);
    }
}
