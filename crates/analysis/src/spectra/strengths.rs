//! Strengths of passages, and whether they repeat with the turns of a shaft.
//!
//! What turns with the shaft passes through the load zone once a turn, and unbalance presses once a turn on what does
//! not. Either makes passages louder and softer with the shaft's own period, which is an order of the passages that
//! only one kind of fault has: with a shaft at 1/5.4 of the passages' frequency they are those of the inner raceway of
//! a 6205, with one at 1/3.6 of it those of the outer one. That tells the kinds over a dozen turns, where lines of a
//! spectrum are too wide to be distinguished.
//!
//! A bearing's elements differ, and make a pattern that repeats each time all of them have passed, whatever turns. It
//! is taken out first. Of what is left counts the share of the variance that [`HARMONICS`] of the shaft explain, less
//! what as many numbers explain of chance.

use super::lines::{log_blocks, steps};
use crate::statistics;
use std::f64::consts::TAU;

/// Harmonics of the shaft.
const HARMONICS: usize = 4;
/// Passages that are looked at: over more the phase of a wandering cage is lost.
const MOST: usize = 256;
/// Parts of a passage; half of them, where the envelope is loudest, are its strength.
const PARTS: usize = 24;
/// Fewest passages, as a multiple of the numbers that are fitted to them.
const TIMES: usize = 3;
/// Root mean square about their mean (nepers of power) up to which strengths are even: over recorded spalls of the
/// inner raceway they have 0.6 to 1.3, of the outer one 0.15 to 1.6, and simulated ones less.
const EVEN: f64 = 0.3;
/// Deviation of the shaft's order from that of pure rolling: slip changes it by 0.7 of its share inside, all of it
/// outside.
const NEAR: f64 = 0.01;

/// Strengths of passages one after the other, as logarithms, without the pattern of the bearing's elements.
pub(super) struct Strengths {
    values: Vec<f64>,
    elements: usize,
}

impl Strengths {
    /// Of passages at a frequency (Hz) in a squared envelope that is sampled at `rate` (Hz).
    ///
    /// # Errors
    /// Too few uneven passages for this number of elements.
    pub(super) fn of(squared_envelope: &[f64], rate: f64, frequency: f64, elements: usize) -> Result<Self, String> {
        let block = ((rate / (2.0 * PARTS as f64 * frequency)) as usize).max(1);
        let logs = log_blocks(squared_envelope, block);
        let pace = frequency * block as f64 / rate;
        let mut folded = [0.0; PARTS];
        for (i, log) in logs.iter().enumerate() {
            folded[((i as f64 * pace).fract() * PARTS as f64) as usize % PARTS] += log;
        }
        let loudness = |first: usize| (0..PARTS / 2).map(|part| folded[(first + part) % PARTS]).sum::<f64>();
        let loudest = (0..PARTS).max_by(|&a, &b| loudness(a).total_cmp(&loudness(b))).unwrap_or(0);
        let begin = loudest as f64 / PARTS as f64;
        let count = ((logs.len() as f64 * pace - begin) as usize).min(MOST);
        let strength = |passage: usize| {
            let at = |share: f64| (((passage as f64 + begin + share) / pace) as usize).min(logs.len());
            statistics::mean(&logs[at(0.0)..at(0.5)])
        };
        let mut values: Vec<f64> = (0..count).map(strength).collect();
        let fewest = TIMES * elements.max(2 * HARMONICS);
        if count < fewest {
            if statistics::deviation(&values) > EVEN {
                return Err(format!(
                    "{count} passages do not tell whether their strengths repeat with a shaft: {fewest} are needed"
                ));
            }
            values.fill(0.0);
        }
        without_pattern(&mut values, elements);
        Ok(Self { values, elements })
    }

    /// Share of their variance, and of what even strengths may have, that repeats with a shaft of which the passages
    /// are the `order`-th harmonic; 0 in the mean of chance.
    pub(super) fn share(&self, order: f64) -> f64 {
        let count = self.values.len();
        let all = square(&self.values);
        // A tenth of a turn of the highest harmonic over all passages.
        let step = 0.1 * order / (HARMONICS * count) as f64;
        let explained = |order: f64| {
            let mut left = self.values.clone();
            let mut taken: Vec<Vec<f64>> = Vec::new();
            for wave in (0..2 * HARMONICS).map(|k| self.wave(k, order)) {
                let wave = taken.iter().fold(wave, |wave, other| without(wave, other));
                left = without(left, &wave);
                taken.push(wave);
            }
            let free = count.saturating_sub(self.elements + 2 * HARMONICS).max(1) as f64;
            let [all, left] = [all / (free + (2 * HARMONICS) as f64), square(&left) / free];
            (all - left) / (all + EVEN * EVEN)
        };
        steps(order * (1.0 - NEAR), order * (1.0 + NEAR), step).map(explained).fold(0.0, f64::max)
    }

    /// Cosine or sine of a harmonic of the shaft, passage by passage, without the elements' pattern.
    fn wave(&self, k: usize, order: f64) -> Vec<f64> {
        let (harmonic, quarter) = ((k / 2 + 1) as f64, (k % 2) as f64 * 0.25);
        let of = |passage: usize| libm::cos(TAU * (harmonic * passage as f64 / order - quarter));
        let mut wave: Vec<f64> = (0..self.values.len()).map(of).collect();
        without_pattern(&mut wave, self.elements);
        wave
    }
}

/// Takes out what repeats with all elements' passing.
fn without_pattern(values: &mut [f64], elements: usize) {
    for first in 0..elements {
        let own: Vec<f64> = values.iter().skip(first).step_by(elements).copied().collect();
        let mean = statistics::mean(&own);
        values.iter_mut().skip(first).step_by(elements).for_each(|value| *value -= mean);
    }
}

/// A list less its part along another.
fn without(mut values: Vec<f64>, along: &[f64]) -> Vec<f64> {
    let product: f64 = values.iter().zip(along).map(|(a, b)| a * b).sum();
    let share = product / square(along).max(f64::MIN_POSITIVE);
    values.iter_mut().zip(along).for_each(|(value, along)| *value -= share * along);
    values
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Random;

    /// Shares of strengths that follow a shaft with one of two orders, over 60 passages by nine unequal elements.
    fn shares(louder: f64) -> [f64; 2] {
        let (rate, frequency, mut random) = (8000.0, 54.0, Random::new(5));
        let elements: Vec<f64> = (0..9).map(|_| random.normal()).collect();
        let sample = |i: usize| {
            let passage = i as f64 / rate * frequency;
            let strength = louder * libm::cos(TAU * passage.floor() / 5.4152) + elements[passage as usize % 9];
            libm::exp(strength) * (0.1 + libm::exp(-8.0 * passage.fract()))
        };
        let mut noisy = |i: usize| sample(i) * -libm::log(1.0 - random.uniform());
        let envelope: Vec<f64> = (0..(60.5 * rate / frequency) as usize).map(&mut noisy).collect();
        let strengths = Strengths::of(&envelope, rate, frequency, 9).unwrap();
        [5.4152, 3.5848].map(|order| strengths.share(order))
    }

    #[test]
    fn strengths_repeat_with_the_shaft_that_makes_them_and_with_no_other() {
        let [own, other] = shares(1.0);
        assert!(own > 0.6 && other < 0.2, "{own} {other}");
        let [none, other] = shares(0.0);
        assert!(none < 0.2 && other < 0.2, "{none} {other}");
    }

    #[test]
    fn too_few_passages_are_refused_by_their_number_unless_they_are_even() {
        let of = |louder: f64| {
            let sample = |i: usize| if (i / 148).is_multiple_of(2) { 1.0 } else { louder };
            let envelope: Vec<f64> = (0..4000).map(sample).collect();
            Strengths::of(&envelope, 8000.0, 54.0, 9)
        };
        let refused = of(4.0).err().unwrap();
        assert!(refused.starts_with("26 passages") && refused.ends_with("27 are needed"), "{refused}");
        assert_eq!(of(1.2).unwrap().share(5.4152), 0.0);
    }
}
