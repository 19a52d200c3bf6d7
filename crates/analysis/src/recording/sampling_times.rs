//! Whether the samples of a recording are evenly spaced, by the column that carries their times.
//!
//! Printed times are rounded: a step between two of them may differ from the sampling period by one unit of the last
//! digit, and so may times that went through single precision. What is beyond that is a hole, a repeated sample, a
//! clock set back, or jitter. A single lost sample shows where the last digit is at most half a period, two show up
//! to a whole one; coarser times are refused. A slow drift of the clock passes.
//!
//! The period is a median, so that holes do not stretch it; the rate is the mean one, which is sharper once there are
//! none.

use crate::statistics;

/// Steps over which the period is taken: the digits' share in it is then 1/64 of a unit.
const STRIDE: usize = 64;
/// Difference of a step from the period beside the digits' (share of the period). At 0.45 of the rate, the top of the
/// band that is used, it is a phase of 0.06 rad: noise 25 dB below the signal.
const JITTER: f64 = 0.02;
/// Difference that digits explain at most (share of the period): a lost sample makes it 1, a repeated one −1.
const EXPLAINED: f64 = 0.9;
/// Stretches in which the rate is checked, and largest difference of one from the mean of all: what a given rate
/// may differ from the file's.
const STRETCHES: usize = 16;
const DRIFT: f64 = 0.01;
/// Share of uneven steps from which they are the rule: jitter, and no column of times if it is not called so.
const RULE: f64 = 0.1;
/// Share of uneven steps up to which a column of any other name is taken to count samples.
const COUNTER: f64 = 0.01;
/// Times on each side of a step whose digits are examined: zeros at the end of one may not be printed.
const SIDE: usize = 8;

/// What is wrong with the times. Times and lengths are in the column's own unit, samples are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum Uneven {
    /// A time is infinite or not a number.
    #[error("the time of sample {index} is {value}: times must be finite")]
    NotFinite { index: usize, value: f64 },
    /// Samples are missing.
    #[error(
        "a hole of {} after {} (sample {index}): about {missing} samples are missing; holes in all: {holes}. Cut the \
         recording there",
        quantity(.length, .unit), quantity(.at, .unit)
    )]
    Hole { index: usize, at: f64, length: f64, missing: f64, holes: usize, unit: String },
    /// Two samples at one time.
    #[error("samples {index} and {} have one time, {}: is one of them repeated?", .index + 1, quantity(.at, .unit))]
    Repeated { index: usize, at: f64, unit: String },
    /// The clock goes back.
    #[error(
        "the time goes back after {} (sample {index}), to {}: it must rise, or be left out with --rate and --channel",
        quantity(.at, .unit), quantity(.to, .unit)
    )]
    Backward { index: usize, at: f64, to: f64, unit: String },
    /// The digits do not distinguish samples.
    #[error(
        "times are given to {}, samples come every {}: whether some are missing is not known. Give the times more \
         digits, or leave this column out with --rate and --channel",
        quantity(.digit, .unit), quantity(.period, .unit)
    )]
    Coarse { digit: f64, period: f64, unit: String },
    /// Steps differ by more than digits explain.
    #[error(
        "{count} of {of} steps are uneven, the first of {} after {} (sample {index}): samples come every {}, and \
         {limit:.1} % of that is allowed there, digits included",
        quantity(.step, .unit), quantity(.at, .unit), quantity(.period, .unit)
    )]
    Jitter { index: usize, at: f64, step: f64, period: f64, limit: f64, count: usize, of: usize, unit: String },
    /// The clock's rate changes.
    #[error(
        "samples come every {} around {} and every {} in the mean: {limit} % of difference is allowed",
        quantity(.period, .unit), quantity(.at, .unit), quantity(.mean, .unit)
    )]
    Drift { period: f64, at: f64, mean: f64, limit: f64, unit: String },
}

fn quantity(value: &f64, unit: &str) -> String {
    let number = if value.abs() < 1e-3 { format!("{value:.4e}") } else { format!("{value:.6}") };
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}

/// Samples per unit of time, all in all; `None` of fewer than two, or where time does not rise.
pub(super) fn mean_rate(times: &[f64]) -> Option<f64> {
    let span = times.last()? - times.first()?;
    let rate = (times.len() - 1) as f64 / span;
    (rate.is_finite() && rate > 0.0).then_some(rate)
}

/// Whether a column without a telling name looks like times: nine of ten steps are alike, or it rises and never falls.
pub(crate) fn rises(column: &[f64]) -> bool {
    let steps: Vec<f64> = column.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let usual = statistics::median(&steps);
    let alike = steps.iter().filter(|&&step| (step - usual).abs() < 0.5 * usual).count();
    let never_falls = steps.iter().all(|&step| step >= 0.0) && column.last() > column.first();
    never_falls || (usual > 0.0 && alike as f64 >= (1.0 - RULE) * steps.len() as f64)
}

/// Whether a column counts samples one by one, and not time.
pub(crate) fn counts(column: &[f64]) -> bool {
    period(column) == 1.0 && column.iter().all(|x| x.fract() == 0.0)
}

/// Times, or what counts samples like them.
pub(super) struct Clock<'a> {
    times: &'a [f64],
    unit: &'a str,
    /// Sampling period: a median.
    period: f64,
    /// Digits after the point of each time, less than none where it ends in zeros; empty where all steps are even as it
    /// is.
    decimals: Vec<i8>,
    /// Whether all times could have gone through single precision.
    single: bool,
    /// Samples before uneven steps.
    uneven: Vec<usize>,
}

impl<'a> Clock<'a> {
    /// Takes times in `unit`.
    ///
    /// # Errors
    /// A time that is not finite.
    pub(crate) fn new(times: &'a [f64], unit: &'a str) -> Result<Self, Uneven> {
        if let Some(index) = times.iter().position(|t| !t.is_finite()) {
            return Err(Uneven::NotFinite { index, value: times[index] });
        }
        let mut clock =
            Self { times, unit, period: period(times), decimals: Vec::new(), single: false, uneven: Vec::new() };
        clock.uneven = clock.beyond_limit();
        if !clock.uneven.is_empty() {
            clock.decimals = times.iter().map(|&t| decimals(t)).collect();
            let single = |(&t, &n): (&f64, &i8)| (t - f64::from(t as f32)).abs() <= 0.51 * unit_of_digit(n.max(0));
            clock.single = times.iter().zip(&clock.decimals).all(single);
            clock.uneven = clock.beyond_limit();
        }
        Ok(clock)
    }

    /// A column of any name, if it ticks from sample to sample: all but a few steps are even.
    pub(super) fn hidden_in(column: &'a [f64]) -> Option<Self> {
        let period = period(column);
        let few = COUNTER * column.len() as f64;
        let far = |pair: &&[f64]| !((pair[1] - pair[0] - period).abs() <= EXPLAINED * period);
        // First without a look at digits, which takes its time.
        if column.len() < 3 || !(period > 0.0) || column.windows(2).filter(far).count() as f64 > few {
            return None;
        }
        Self::new(column, "").ok().filter(|clock| clock.uneven.len() as f64 <= few)
    }

    /// Checks times.
    ///
    /// # Errors
    /// The first step that is uneven, or a rate that drifts.
    pub(crate) fn check(&self) -> Result<(), Uneven> {
        self.uneven.first().map_or_else(|| self.drift(), |&first| Err(self.fault(first)))
    }

    /// Looks for holes in what ticks. What jumps back may begin anew, as an angle does.
    ///
    /// # Errors
    /// The first hole.
    pub(super) fn check_for_holes(&self) -> Result<(), Uneven> {
        let hole = self.uneven.iter().find(|&&i| self.is_hole(i));
        hole.map_or(Ok(()), |&first| Err(self.fault(first)))
    }

    fn step(&self, i: usize) -> f64 {
        self.times[i + 1] - self.times[i]
    }

    fn is_hole(&self, i: usize) -> bool {
        self.step(i) >= 1.5 * self.period
    }

    fn beyond_limit(&self) -> Vec<usize> {
        let even = |i: usize| self.step(i) > 0.0 && (self.step(i) - self.period).abs() <= self.limit(i);
        (0..self.times.len().saturating_sub(1)).filter(|&i| !even(i)).collect()
    }

    /// Largest difference of the step after sample `i` from the period.
    fn limit(&self, i: usize) -> f64 {
        (self.digit(i) + JITTER * self.period).min(EXPLAINED * self.period)
    }

    /// What digits, or single precision, may add to the step after sample `i` or take away.
    fn digit(&self, i: usize) -> f64 {
        let latest = self.times[i].abs().max(self.times[i + 1].abs());
        let double = latest.next_up() - latest;
        if self.decimals.is_empty() {
            return double;
        }
        let finest = |range: &[i8]| {
            unit_of_digit(range.iter().copied().filter(|&decimals| decimals != ANY).max().unwrap_or_default())
        };
        // Each side by itself: where a fixed number of digits is printed in all, the point moves, and the digit with
        // it.
        let count = self.times.len();
        let before = finest(&self.decimals[(i + 1).saturating_sub(SIDE)..(i + 1).max(SIDE.min(count))]);
        let after = finest(&self.decimals[(i + 1).min(count.saturating_sub(SIDE))..(i + 1 + SIDE).min(count)]);
        let single = if self.single { f64::from((latest as f32).next_up() - latest as f32) } else { 0.0 };
        before.max(after).max(double).max(single)
    }

    /// What is wrong with the step after sample `index`.
    fn fault(&self, index: usize) -> Uneven {
        let (at, step, period, unit) = (self.times[index], self.step(index), self.period, self.unit.to_owned());
        let digit = self.digit(index);
        let holes = self.uneven.iter().filter(|&&i| self.is_hole(i)).count();
        if step < 0.0 {
            return Uneven::Backward { index, at, to: self.times[index + 1], unit };
        }
        if let Some(rate) = mean_rate(self.times).filter(|_| digit > period) {
            return Uneven::Coarse { digit, period: 1.0 / rate, unit };
        }
        if step == 0.0 {
            Uneven::Repeated { index, at, unit }
        } else if self.is_hole(index) && (holes as f64) < RULE * self.times.len() as f64 {
            let length = step - period;
            Uneven::Hole { index, at, length, missing: (length / period).round().max(1.0), holes, unit }
        } else {
            let (count, of, limit) = (self.uneven.len(), self.times.len() - 1, 100.0 * self.limit(index) / period);
            Uneven::Jitter { index, at, step, period, limit, count, of, unit }
        }
    }

    /// Whether every stretch has the mean rate.
    fn drift(&self) -> Result<(), Uneven> {
        let stretch = (self.times.len() / STRETCHES).max(STRIDE);
        let last = self.times.len().saturating_sub(1);
        let Some(rate) = mean_rate(self.times) else { return Ok(()) };
        let mean = 1.0 / rate;
        let differs = |&i: &usize| {
            let off = (self.times[i + stretch] - self.times[i] - stretch as f64 * mean).abs();
            off > DRIFT * mean * stretch as f64 + self.digit(i).max(self.digit(i + stretch - 1))
        };
        match (0..(last + 1).saturating_sub(stretch)).find(differs) {
            None => Ok(()),
            Some(i) => {
                let period = (self.times[i + stretch] - self.times[i]) / stretch as f64;
                let (at, unit) = (self.times[i + stretch / 2], self.unit.to_owned());
                Err(Uneven::Drift { period, at, mean, limit: 100.0 * DRIFT, unit })
            }
        }
    }
}

/// Sampling period: the median over strides.
fn period(times: &[f64]) -> f64 {
    let stride = STRIDE.min(times.len().saturating_sub(1) / 4).max(1);
    let strides: Vec<f64> = times.windows(stride + 1).map(|w| w[stride] - w[0]).collect();
    statistics::median(&strides) / stride as f64
}

/// Decimals of 0, which may have any: its neighbours say which.
const ANY: i8 = i8::MIN;

/// Digits after the point that a number needs to read back the same; where none, zeros before it, less than none.
fn decimals(value: f64) -> i8 {
    let text = value.to_string();
    match text.split_once('.') {
        Some((_, fraction)) => fraction.len().min(127) as i8,
        None if value == 0.0 => ANY,
        None => -((text.len() - text.trim_end_matches('0').len()).min(127) as i8),
    }
}

fn unit_of_digit(decimals: i8) -> f64 {
    libm::pow(10.0, -f64::from(decimals))
}
