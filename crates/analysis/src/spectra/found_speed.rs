//! The speed of the shaft between two limits, found in the signal itself.
//!
//! The limits are so close that no speed between them is the half or double of another one: lines alone do not tell an
//! octave. Candidates are the speeds whose own lines stand out ([`ShaftLines`]). One is explained by another if it is a
//! passage frequency of the bearing at that one's speed, or a part of one and not higher. The highest that is left is
//! the speed, if no other is nearly as high. The bearing's own lines check it as they check a stated one.

use super::combs::SLIP;
use super::shaft_lines::{CONFIRMS, DECIBELS, SHAFT, ShaftLines, THERE};
use crate::recording::SizingError;
use brinell::geometry::kinematics;
use brinell::scene::Bearing;

/// Largest ratio of two limits: nothing between them is an octave of anything else.
pub const WIDEST: f64 = 1.9;
/// Fewest turns of the slowest shaft: the noise between two of its lines is then judged by a dozen bins and more.
const FEWEST_TURNS: f64 = 20.0;
/// Difference of two speeds up to which they are one, as a share.
const ONE: f64 = 0.02;
/// Candidates that are looked at.
const MOST: usize = 12;
/// Parts of a passage frequency that it explains.
const PARTS: u32 = 3;

/// A speed (Hz), and how high the weakest of its lines are (nepers of power).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Candidate {
    speed: f64,
    height: f64,
}

/// The speed (Hz) between two limits (Hz) of the shaft of a signal, sampled at `rate` (Hz).
///
/// # Errors
/// Limits that a signal of this rate and duration cannot show, and speeds of which none stands out or several do.
pub fn find_speed(
    name: &str,
    signal: &[f64],
    rate: f64,
    bearing: &Bearing,
    limits: [f64; 2],
) -> Result<f64, SizingError> {
    let refuse = |why: String| SizingError::NoSpeed { name: name.to_owned(), why };
    check_limits(signal.len() as f64 / rate, rate, limits).map_err(refuse)?;
    let [low, high] = limits;
    let all = ShaftLines::of(signal, rate).weakest(low, high);
    let candidates = candidates(all);
    let Some(highest) = candidates.first().filter(|highest| highest.height >= THERE) else {
        let (speed, height) = candidates.first().map_or((low, 0.0), |c| (c.speed, c.height));
        return Err(refuse(format!(
            "no lines of a shaft of {low} to {high} Hz: the weakest three of five are at most {:.0} dB above the \
             noise, at {speed:.2} Hz, limit {:.0} dB",
            DECIBELS * height,
            DECIBELS * THERE
        )));
    };
    let there: Vec<Candidate> = candidates.iter().copied().filter(|c| c.height >= THERE).collect();
    let orders = orders(bearing);
    let mut left = there.iter().copied().filter(|one| !there.iter().any(|other| explains(*other, *one, &orders)));
    let leader = left.next().unwrap_or(*highest);
    let rivals = left.filter(|c| c.height > leader.height - CONFIRMS);
    let equals: Vec<Candidate> = std::iter::once(leader).chain(rivals).collect();
    if equals.len() == 1 {
        return Ok(leader.speed);
    }
    let words: Vec<String> =
        equals.iter().map(|c| format!("{:.2} Hz with {:.0} dB", c.speed, DECIBELS * c.height)).collect();
    Err(refuse(format!(
        "the speed of the shaft is not unique: {} above the noise in the weakest three of its first five lines; one \
         must be higher by {:.0} dB than all others",
        words.join(", "),
        DECIBELS * CONFIRMS
    )))
}

fn check_limits(duration: f64, rate: f64, [low, high]: [f64; 2]) -> Result<(), String> {
    if !(low > 0.0 && low < high && high.is_finite()) {
        return Err(format!(
            "a speed is sought from {low} to {high} Hz: the first must be above 0 and below the second"
        ));
    }
    if high >= WIDEST * low {
        return Err(format!(
            "a speed is sought from {low} to {high} Hz: the second may be at most {WIDEST} times the first, as the \
             half of a speed has lines at the same places"
        ));
    }
    let top = SHAFT as f64 * high;
    if top > 0.45 * rate {
        return Err(format!(
            "a speed is sought up to {high} Hz, the {SHAFT}th line of which is at {top:.1} Hz: at a sampling rate of \
             {rate:.1} Hz at most {:.1} Hz is shown",
            0.45 * rate
        ));
    }
    let turns = low * duration;
    if turns < FEWEST_TURNS {
        return Err(format!(
            "a speed is sought from {low} Hz on, of which {duration:.3} s are {turns:.1} turns: at least \
             {FEWEST_TURNS} are needed"
        ));
    }
    Ok(())
}

/// The highest of speeds that are apart from each other, the first highest.
fn candidates(mut all: Vec<(f64, f64)>) -> Vec<Candidate> {
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut found: Vec<Candidate> = Vec::new();
    for (speed, height) in all {
        if found.len() == MOST {
            break;
        }
        if !found.iter().any(|one| same(speed, one.speed)) {
            found.push(Candidate { speed, height });
        }
    }
    found
}

fn same(speed: f64, other: f64) -> bool {
    (speed / other - 1.0).abs() < ONE
}

/// Passage frequencies of a bearing, as multiples of the shaft's speed.
fn orders(bearing: &Bearing) -> [f64; 4] {
    let of = kinematics::frequencies(bearing, 0.0, 1.0);
    [of.bpfo, of.bpfi, 2.0 * of.bsf, of.bsf]
}

/// Whether a candidate's shaft makes the lines of another one, too.
fn explains(shaft: Candidate, other: Candidate, orders: &[f64]) -> bool {
    let ratio = other.speed / shaft.speed;
    let passes = |order: f64| (1.0 - SLIP.end()..=1.0 - SLIP.start()).contains(&(ratio / order));
    let lower = other.height <= shaft.height && shaft != other;
    orders.iter().any(|&order| passes(order) || lower && (2..=PARTS).any(|parts| passes(order / f64::from(parts))))
}
