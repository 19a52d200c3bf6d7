//! Modes of a structure out of its measured response, by vector fitting.
//!
//! The response H is the acceleration at the sensor over that of the outer ring. Poles are found by Gustavsen and
//! Semlyen's iteration (IEEE Trans. Power Delivery 14 (1999) 1052–1061): with poles a_k given, least squares yield
//! numerator p and denominator σ of H = p/σ over those poles; the zeros of σ are the next poles. Gains then follow by
//! least squares from
//! ```text
//! H(s) = 1 − Σ (Γ s² + Κ ω s) / (s² + 2 ζ ω s + ω²)
//! ```
//! which passes slow motion unchanged, as every structure does: whatever a table has at 0 Hz, where accelerometers hear
//! nothing, H(0) = 1.
//!
//! **Modes lie within the band of the lines.** Poles outside of it are what the iteration makes of noise and of a sum
//! that is not an integral; where a structure rings there, nobody has measured.
//!
//! **An impulse response's first sample** holds the impulse that passes directly, 1 − ΣΓ over the step, and of the
//! smooth part h(0+) at the jump the half or the whole, as whoever sampled it decided. The difference, and what the sum
//! over samples differs from the integral, (ω Δt)²/12 of a mode, are the same at all frequencies. So a constant is
//! fitted beside the modes and left out of them.

use crate::recording::{TextFormat, csv};
use brinell::scene::{MOST_SENSOR_MODES, SensorMode};
use brinell_eigen::{c64, eigenvalues, least_squares};
use std::f64::consts::TAU;

/// Largest misfit of modes that are used: rms of what they miss over that of the response.
pub(super) const LARGEST_MISFIT: f64 = 0.1;
/// Misfit below which no further mode is tried.
const GOOD_MISFIT: f64 = 0.005;
/// Share of what distinguishes a response from 1 that modes may miss: most of a wide band is 1 whatever rings in it.
const LEAST_EXPLAINED: f64 = 0.5;
/// Largest constant that the sampling of an impulse response makes, as a share of slow motion: of a mode at a tenth of
/// the rate it is 3 % of its gain.
const LARGEST_CONSTANT: f64 = 0.1;
/// Modes that do not bring the misfit down by this share of it are left out.
const WORTH: f64 = 0.1;
/// Counts of modes tried in vain after which no more are.
const PATIENCE: usize = 3;
/// Most modes that are tried.
const MOST_MODES: usize = if MOST_SENSOR_MODES < 16 { MOST_SENSOR_MODES } else { 16 };
/// Steps of the iteration; it converges in three to ten where it does.
const ITERATIONS: usize = 20;
/// Lines that poles are found from, and gains; more of them say little more.
const MOST_LINES: usize = 400;
/// Fewest lines of a file.
const FEWEST_LINES: usize = 8;
/// Damping ratio that poles begin with.
const FIRST_DAMPING: f64 = 0.01;

/// Why no modes follow from a response.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum ResponseError {
    /// The text is no table of a response.
    #[error("{0}")]
    Format(String),
    /// Headings that say of no kind of response what it is.
    #[error(
        "columns {0:?}: a frequency response has frequency_hz and real, imaginary or magnitude, phase_deg; an impulse \
         response has time_s and response_1_s"
    )]
    Columns(Vec<String>),
    /// Too few lines.
    #[error("{0} lines: at least {FEWEST_LINES} are needed")]
    Few(usize),
    /// A number that cannot be.
    #[error("line {row} of the numbers: {column} {value}: {why}")]
    Number {
        /// Which line of numbers, from 1.
        row: usize,
        column: String,
        value: f64,
        why: &'static str,
    },
    /// No modes come near.
    #[error(
        "{modes} modes miss {:.1} % of the response (limit {:.0} %): it is not that of a structure that passes slow \
         motion unchanged, or too noisy",
        100.0 * misfit, 100.0 * LARGEST_MISFIT
    )]
    Misfit { modes: usize, misfit: f64 },
    /// Modes explain little of what they are for.
    #[error(
        "{modes} modes miss {:.2} % of the response, and without any 1 misses {:.2} %: they must explain at least half \
         of what distinguishes it from 1",
        100.0 * misfit, 100.0 * without
    )]
    Unexplained { modes: usize, misfit: f64, without: f64 },
    /// The response fits with a sign turned.
    #[error("{turned} is turned: with the other sign {modes} modes miss {:.2} % of the response", 100.0 * misfit)]
    Turned { turned: &'static str, modes: usize, misfit: f64 },
}

/// A response: the acceleration at the sensor over that of the outer ring, line by line.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyResponse {
    /// By ascending frequency.
    lines: Vec<Line>,
    /// Whether it was summed from samples of an impulse response, so that a constant may be added to it.
    summed: bool,
}

/// The response at one frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Line {
    /// Frequency (Hz).
    frequency: f64,
    value: c64,
}

/// Modes that follow from a response.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The modes, by frequency.
    pub modes: Vec<SensorMode>,
    /// rms of what they miss over that of the response.
    pub misfit: f64,
}

impl FrequencyResponse {
    /// Reads a table with headings: `frequency_hz` with `real` and `imaginary`, or `magnitude` and `phase_deg`; or
    /// `time_s` with `response_1_s`, an impulse response.
    ///
    /// # Errors
    /// What is no such table, with the line.
    pub fn from_csv(text: &str) -> Result<Self, ResponseError> {
        let (names, columns) = csv::columns(text, "csv", TextFormat::default()).map_err(ResponseError::Format)?;
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let polar = |[magnitude, degrees]: [f64; 2]| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            c64::new(magnitude * cos, magnitude * sin)
        };
        for (name, column) in names.iter().zip(&columns) {
            check(name, column, "must be finite", |value, _| value.is_finite())?;
        }
        let rows = |of: fn([f64; 2]) -> c64| {
            let values = columns[1].iter().zip(&columns[2]).map(|(&a, &b)| of([a, b]));
            columns[0].iter().zip(values).map(|(&frequency, value)| Line { frequency, value }).collect()
        };
        let lines: Vec<Line> = match names[..] {
            ["frequency_hz", "real", "imaginary"] => rows(|[real, imaginary]| c64::new(real, imaginary)),
            ["frequency_hz", "magnitude", "phase_deg"] => rows(polar),
            ["time_s", "response_1_s"] => transformed(&columns)?,
            _ => return Err(ResponseError::Columns(names.into_iter().map(str::to_owned).collect())),
        };
        let ascending = |value: f64, before: Option<f64>| before.map_or(value >= 0.0, |before| value > before);
        let frequencies: Vec<f64> = lines.iter().map(|line| line.frequency).collect();
        check(names[0], &frequencies, "must be at least 0 and grow from line to line", ascending)?;
        let lines: Vec<Line> = lines.into_iter().filter(|line| line.frequency > 0.0).collect();
        if lines.len() < FEWEST_LINES {
            return Err(ResponseError::Few(lines.len()));
        }
        Ok(Self { lines, summed: names[0] == "time_s" })
    }

    /// The fewest modes within the band of the lines that come as near to the response as more of them would.
    ///
    /// # Errors
    /// A response that none come near enough, and whether they would with a sign turned.
    pub fn fit(&self) -> Result<Fit, ResponseError> {
        self.nearest().map_err(|error| self.turned().unwrap_or(error))
    }

    /// Which sign is turned, if modes come near with the other.
    fn turned(&self) -> Option<ResponseError> {
        let with = |turned: &'static str, turn: fn(c64) -> c64| {
            let lines = self.lines.iter().map(|line| Line { value: turn(line.value), ..*line }).collect();
            let Fit { modes, misfit } = Self { lines, ..*self }.nearest().ok()?;
            Some(ResponseError::Turned { turned, modes: modes.len(), misfit })
        };
        with("the response's sign", |value| -value).or_else(|| with("the sign of its phase", |value| value.conj()))
    }

    fn nearest(&self) -> Result<Fit, ResponseError> {
        let every = self.lines.len().div_ceil(MOST_LINES);
        let lines: Vec<Line> = self.lines.iter().copied().step_by(every).collect();
        let without = misfit(&[], &self.lines);
        let mut best = Fit { modes: Vec::new(), misfit: without };
        // Each mode takes four numbers from the lines.
        let mut in_vain = 0;
        for count in 1..=MOST_MODES.min(lines.len() / 4) {
            if best.misfit <= GOOD_MISFIT || in_vain == PATIENCE {
                break;
            }
            in_vain += 1;
            let modes = poles(&lines, count).and_then(|poles| self.gains(&lines, &poles));
            let possible = modes.filter(|(modes, _)| modes.iter().all(|mode| mode.check().is_ok()));
            let Some((modes, constant)) = possible else { continue };
            let rest = self.lines.iter().map(|line| Line { value: line.value - constant, ..*line });
            let rest: Vec<Line> = rest.collect();
            let misfit = misfit(&modes, &rest);
            if misfit < (1.0 - WORTH) * best.misfit {
                (best, in_vain) = (Fit { modes, misfit }, 0);
            }
        }
        if !(best.misfit <= LARGEST_MISFIT) {
            return Err(ResponseError::Misfit { modes: best.modes.len(), misfit: best.misfit });
        }
        if without > GOOD_MISFIT && best.misfit > LEAST_EXPLAINED * without {
            let Fit { modes, misfit } = best;
            return Err(ResponseError::Unexplained { modes: modes.len(), misfit, without });
        }
        best.modes.sort_by(|one, other| one.frequency.total_cmp(&other.frequency));
        Ok(best)
    }

    /// Modes of these ω and ζ, and a constant where the samples may have made it.
    fn gains(&self, lines: &[Line], poles: &[[f64; 2]]) -> Option<(Vec<SensorMode>, f64)> {
        let free = self.summed.then(|| gains(lines, poles, true)).flatten();
        free.filter(|(_, constant)| constant.abs() <= LARGEST_CONSTANT).or_else(|| gains(lines, poles, false))
    }
}

/// Response of modes at a frequency (Hz).
pub fn response(modes: &[SensorMode], frequency: f64) -> c64 {
    let s = c64::new(0.0, TAU * frequency);
    modes.iter().fold(c64::new(1.0, 0.0), |sum, mode| {
        let [displacement, rate] = columns_of(s, [TAU * mode.frequency, mode.damping_ratio]);
        sum + displacement * mode.gain + rate * mode.quadrature_gain
    })
}

/// What a mode of ω and ζ adds to the response for each unit of Γ and of Κ.
fn columns_of(s: c64, [frequency, damping_ratio]: [f64; 2]) -> [c64; 2] {
    let resonance = s * s + s * (2.0 * damping_ratio * frequency) + frequency * frequency;
    [-s * s / resonance, -s * frequency / resonance]
}

fn misfit(modes: &[SensorMode], lines: &[Line]) -> f64 {
    let missed: f64 = lines.iter().map(|line| (response(modes, line.frequency) - line.value).norm_sqr()).sum();
    let whole: f64 = lines.iter().map(|line| line.value.norm_sqr()).sum();
    (missed / whole).sqrt()
}

/// Refuses a column in which a number, with the one before it, is not `as_it_must_be`.
fn check(
    name: &str,
    column: &[f64],
    why: &'static str,
    as_it_must_be: impl Fn(f64, Option<f64>) -> bool,
) -> Result<(), ResponseError> {
    let before = std::iter::once(None).chain(column.iter().copied().map(Some));
    match column.iter().zip(before).position(|(&value, before)| !as_it_must_be(value, before)) {
        None => Ok(()),
        Some(row) => Err(ResponseError::Number { row: row + 1, column: name.to_owned(), value: column[row], why }),
    }
}

/// An impulse response's lines: its Fourier transform at the multiples of the inverse of its length, up to a quarter of
/// its sampling rate, beyond which the sum is no longer near the integral.
fn transformed(columns: &[Vec<f64>]) -> Result<Vec<Line>, ResponseError> {
    let (times, values) = (&columns[0], &columns[1]);
    if times.len() < 4 * FEWEST_LINES {
        return Err(ResponseError::Few(times.len() / 4));
    }
    let step = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    let even =
        |value: f64, before: Option<f64>| before.is_none_or(|before| (value - before - step).abs() < 1e-3 * step);
    check("time_s", times, "must grow by equal steps", even)?;
    let length = step * times.len() as f64;
    let line = |k: usize| {
        let frequency = k as f64 / length;
        let terms = values.iter().zip(times).map(|(&value, &time)| {
            let (sin, cos) = (TAU * frequency * time).sin_cos();
            c64::new(value * cos, -value * sin)
        });
        Line { frequency, value: terms.sum::<c64>() * step }
    };
    Ok((1..=times.len() / 4).map(line).collect())
}

/// ω and ζ of those of so many modes that lie within the lines, where the iteration for them ends well. Frequencies are
/// measured by the highest line's.
fn poles(lines: &[Line], count: usize) -> Option<Vec<[f64; 2]>> {
    let (lowest, highest) = (lines.first()?.frequency, lines.last()?.frequency);
    let unit = TAU * highest;
    let spread = |k: usize| (lowest + (highest - lowest) * (k as f64 + 0.5) / count as f64) / highest;
    let mut poles: Vec<c64> = (0..count).map(|k| c64::new(-FIRST_DAMPING * spread(k), spread(k))).collect();
    for _ in 0..ITERATIONS {
        let equation = |Line { frequency, value }: &Line| {
            let s = c64::new(0.0, frequency / highest);
            let basis: Vec<c64> = poles.iter().flat_map(|pole| fractions(s, *pole)).collect();
            let unknown = basis.iter().copied().chain([c64::new(1.0, 0.0)]).chain(basis.iter().map(|of| -of * value));
            (unknown.collect(), *value)
        };
        let found = nearest_real(lines.iter().map(equation))?;
        let next = zeros(&poles, &found[2 * count + 1..])?;
        let moved = poles.iter().zip(&next).map(|(one, other)| (one - other).norm()).fold(0.0, f64::max);
        poles = next;
        if moved < 1e-9 {
            break;
        }
    }
    let within = poles.iter().filter(|pole| (lowest / highest..=1.0).contains(&pole.norm()));
    Some(within.map(|pole| [unit * pole.norm(), (-pole.re / pole.norm()).clamp(1e-6, 1.0)]).collect())
}

/// The two real fractions of a pair of complex poles.
fn fractions(s: c64, pole: c64) -> [c64; 2] {
    let (one, other) = ((s - pole).inv(), (s - pole.conj()).inv());
    [one + other, c64::new(0.0, 1.0) * (one - other)]
}

/// Zeros of 1 + Σ c φ over pairs of poles: eigenvalues of A − b cᵀ. One of each pair, by frequency, stable.
fn zeros(poles: &[c64], weights: &[f64]) -> Option<Vec<c64>> {
    let size = 2 * poles.len();
    let entry = |i: usize, k: usize| {
        let pole = poles[i / 2];
        let own = match (i / 2 == k / 2, i % 2, k % 2) {
            (false, ..) => 0.0,
            (_, 0, 1) => pole.im,
            (_, 1, 0) => -pole.im,
            _ => pole.re,
        };
        own - if i.is_multiple_of(2) { 2.0 * weights[k] } else { 0.0 }
    };
    let matrix: Vec<Vec<f64>> = (0..size).map(|i| (0..size).map(|k| entry(i, k)).collect()).collect();
    let values = eigenvalues(&matrix).ok()?;
    let stable = |pole: c64| c64::new(-pole.re.abs(), pole.im.abs());
    let mut next: Vec<c64> = values.iter().filter(|value| value.im > 0.0).map(|value| stable(*value)).collect();
    // Two real ones stand for a mode that is critically damped.
    let mut real: Vec<f64> = values.iter().filter(|value| value.im == 0.0).map(|value| value.re.abs()).collect();
    real.sort_by(f64::total_cmp);
    next.extend(real.chunks_exact(2).map(|two| c64::new(-(two[0] * two[1]).sqrt(), 0.0)));
    next.sort_by(|one, other| one.norm().total_cmp(&other.norm()));
    (next.len() == poles.len() && next.iter().all(|pole| pole.norm().is_finite())).then_some(next)
}

/// Real numbers whose sum with these complex weights comes nearest to a complex number, in all of the equations.
fn nearest_real(equations: impl Iterator<Item = (Vec<c64>, c64)>) -> Option<Vec<f64>> {
    let (mut rows, mut known) = (Vec::new(), Vec::new());
    for (weights, value) in equations {
        rows.push(weights.iter().map(|of| of.re).collect());
        rows.push(weights.iter().map(|of| of.im).collect());
        known.extend([value.re, value.im]);
    }
    least_squares(&rows, &known).ok()
}

/// Modes of these ω and ζ with the gains that come nearest, and, `with_constant`, what the response has beside them at
/// all frequencies.
fn gains(lines: &[Line], poles: &[[f64; 2]], with_constant: bool) -> Option<(Vec<SensorMode>, f64)> {
    let equation = |Line { frequency, value }: &Line| {
        let s = c64::new(0.0, TAU * frequency);
        let constant = with_constant.then_some(c64::new(1.0, 0.0));
        (poles.iter().flat_map(|pole| columns_of(s, *pole)).chain(constant).collect(), value - 1.0)
    };
    let found = nearest_real(lines.iter().map(equation))?;
    let modes =
        poles.iter().zip(found.as_chunks::<2>().0).map(|([frequency, damping_ratio], [gain, quadrature])| SensorMode {
            frequency: frequency / TAU,
            damping_ratio: *damping_ratio,
            gain: *gain,
            quadrature_gain: *quadrature,
        });
    Some((modes.collect(), if with_constant { *found.last()? } else { 0.0 }))
}
