//! Whether a recording suits another speed than the one that is stated.
//!
//! Kinds of fault differ by the order of their comb, so that at another speed any comb is that of another kind: BPFI
//! is 1.5 times BPFO. Three questions are asked that an order does not answer.
//!
//! **Are there lines between?** At twice the speed the comb takes every second line of the recording, and as strong
//! ones stand between them.
//!
//! **Which speed do the shaft's own lines have?** Unbalance and misalignment make lines at its harmonics in the signal
//! itself. They are looked at where the shaft would turn if the comb were another kind's. On recorded machines they are
//! 3.4 to 10 nepers high at the speed of the shaft, 0.5 to 7 more than at those other speeds.
//!
//! **Does the spall turn?** That is asked if these lines decide nothing. One of the inner raceway passes through the
//! load zone once a turn, and its lines have sidebands at the speed of the shaft that belongs to them, the comb's
//! frequency over the order of BPFI. Lines of the outer raceway have none at that distance.

use super::combs::{Combs, SLIP};
use super::fault::{EXISTS, Fault};
use super::lines::{Lines, QUIET, steps};
use super::shaft_lines::{CONFIRMS, ShaftLines, THERE};
use crate::spectrum::Spectrum;
use crate::statistics;
use brinell::geometry::kinematics::Frequencies;

/// Speeds that are considered, as shares of the stated one.
const SPEEDS: [f64; 2] = [0.5, 2.0];
/// Share of the named comb's from which lines between its own are as strong. At twice the speed they hold the first of
/// the recording's own comb, and more than what is named; between those of a recording's own comb is noise.
const AS_STRONG: f64 = 0.5;
/// Standard deviations above those at other distances from which sidebands exist: recordings of inner raceways have 6
/// to 34, of outer ones −1 to 2.7 and one 7; simulated ones of outer raceways up to 4.1.
const SIDEBANDS: f64 = 5.0;

/// What confirms the stated speed, in words, if anything does.
///
/// # Errors
/// What speaks for another one.
pub(crate) fn check(
    (signal, spectrum): (&[f64], &mut Spectrum),
    rate: f64,
    combs: &Combs,
    nominal: Frequencies,
    speed: f64,
) -> Result<Option<String>, String> {
    let fault = combs.fault();
    let Some(comb) = combs.of(fault) else { return Ok(None) };
    let between = &combs.between;
    if between.share >= AS_STRONG * comb.share {
        return Err(format!(
            "between the lines of the comb at {:.2} Hz with {:.1} % of the variance there are those of one at {:.2} Hz \
             with {:.1} %, limit {AS_STRONG} of the former; it suits {}",
            comb.frequency,
            100.0 * comb.share,
            between.frequency,
            100.0 * between.share,
            in_words(&suiting(between.frequency, Fault::None, nominal, speed))
        ));
    }
    let mut others = suiting(comb.frequency, fault, nominal, speed);
    // What repeats as a fault does may be one at its own speed, although what is named repeats more.
    if combs.elsewhere.share >= EXISTS {
        others.extend(suiting(combs.elsewhere.frequency, Fault::None, nominal, speed));
    }
    let shaft = ShaftLines::of(signal, rate);
    let stated = shaft.height(speed);
    let heights: Vec<f64> = others.iter().map(|&(_, other)| shaft.height(other)).collect();
    let highest = heights.iter().copied().fold(0.0, f64::max);
    let heights = format!(
        "the shaft's own lines are {stated:.1} nepers of power above the noise at the stated speed, {highest:.1} at \
         another one that is considered: {}",
        in_words(&others)
    );
    if highest >= (stated + CONFIRMS).max(THERE) {
        return Err(heights);
    }
    if stated >= (highest + CONFIRMS).max(THERE) {
        return Ok(Some(heights));
    }
    let lines = Lines::of(&spectrum.squared_envelope(comb.band), rate, comb.band, SPEEDS[1] * nominal.bpfi, speed);
    let turning = comb.frequency / nominal.bpfi * speed;
    let sidebands = sidebands(&lines, comb.frequency, turning);
    let stand = match fault {
        Fault::Outer if sidebands >= SIDEBANDS => "not below",
        Fault::Inner if sidebands < SIDEBANDS => "below",
        _ => return Ok(None),
    };
    Err(format!(
        "at ± {turning:.2} Hz, by which an inner raceway's lines have sidebands, those of the comb at {:.2} Hz are \
         {sidebands:.1} standard deviations above chance, {stand} the limit of {SIDEBANDS:.1}, and no lines of the \
         shaft confirm the speed; it suits {}",
        comb.frequency,
        in_words(&others)
    ))
}

/// The kinds of fault, except one, that a comb (Hz) would suit, and at which speed of the shaft (Hz).
fn suiting(frequency: f64, except: Fault, nominal: Frequencies, speed: f64) -> Vec<(Fault, f64)> {
    let kinds = [(Fault::Outer, nominal.bpfo), (Fault::Inner, nominal.bpfi), (Fault::Element, 2.0 * nominal.bsf)];
    let considered = SPEEDS[0] * (1.0 - SLIP.end())..=SPEEDS[1] * (1.0 - SLIP.start());
    let others = kinds.into_iter().filter(|&(kind, own)| kind != except && considered.contains(&(frequency / own)));
    others.map(|(kind, own)| (kind, frequency / own * speed)).collect()
}

fn in_words(suiting: &[(Fault, f64)]) -> String {
    let one = |(kind, speed): &(Fault, f64)| format!("{} at a shaft speed of {speed:.2} Hz", kind.name());
    suiting.iter().map(one).collect::<Vec<_>>().join(" or ")
}

/// How far sidebands of a comb (Hz) at about `distance` (Hz) stand above those at other distances (standard
/// deviations). What modulates makes one on each side: the lower of the two counts, and [`QUIET`] of the comb's own
/// line does not.
fn sidebands(lines: &Lines, comb: f64, distance: f64) -> f64 {
    let own: Vec<f64> = lines.heights(comb, |f| lines.at(f)).map(|(_, height)| height).collect();
    let strength = |distance: f64| {
        let heights = lines.heights(comb, |f| lines.at(f - distance).min(lines.at(f + distance)));
        let logs = heights.zip(&own).map(|((_, height), own)| libm::log1p(height / (1.0 + QUIET * own)));
        statistics::mean(&logs.collect::<Vec<_>>())
    };
    let step = 0.5 / lines.duration;
    let near = steps(distance * (1.0 + SLIP.start()), distance * (1.0 + SLIP.end()), step);
    let chance: Vec<f64> = steps(0.08 * comb, 0.46 * comb, step).map(strength).collect();
    above(&chance, near.map(strength).fold(0.0, f64::max))
}

/// How far a value stands above chance, in standard deviations of the lower half of `chance`: its upper half is widened
/// by combs that share some harmonics with the one that is judged.
fn above(chance: &[f64], value: f64) -> f64 {
    let middle = statistics::median(chance);
    let spread = middle - statistics::quantile(chance, 0.1587).unwrap_or(middle);
    (value - middle) / spread.max(0.05)
}
