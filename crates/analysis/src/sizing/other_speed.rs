//! Whether a recording suits another speed than the one that is stated.
//!
//! Kinds of fault differ by the order of their comb, so that at another speed any comb is that of another kind: BPFI
//! is 1.5 times BPFO. Three questions are asked that an order does not answer.
//!
//! **Is there a comb beside it?** At twice the speed the comb takes every second line of the recording, and as strong
//! ones stand between them.
//!
//! **Does the spall turn?** One of the inner raceway passes through the load zone once a turn, and its lines have
//! sidebands at the speed of the shaft that belongs to them, the comb's frequency over the order of BPFI. Lines of the
//! outer raceway have none at that distance.
//!
//! **Which speed do the shaft's own lines have?** Unbalance and misalignment make lines at its harmonics in the signal
//! itself. Where they stand out at the stated speed and not at the other, sidebands do not matter.

use crate::spectra::combs::SLIP;
use crate::spectra::lines::{Lines, QUIET, steps};
use crate::spectra::{Combs, Fault};
use crate::spectrum;
use crate::spectrum::Spectrum;
use crate::statistics;
use brinell::geometry::kinematics::Frequencies;

/// Speeds that are considered, as shares of the stated one.
const SPEEDS: [f64; 2] = [0.5, 2.0];
/// Share of the named comb's from which another is as strong: at twice the speed the lines between have 0.9 and more.
const AS_STRONG: f64 = 0.85;
/// Share of the variance below which a comb beside the named one is none: as much as a clear fault has.
const BESIDE: f64 = 0.1;
/// Standard deviations above those at other distances from which sidebands exist: recordings of inner raceways have 6
/// to 34, of outer ones −1 to 2.7 and one 7.
const SIDEBANDS: f64 = 4.0;
/// Harmonics of the shaft that are sought in the signal, and by how much those at the stated speed must be higher than
/// those at another one (nepers of power).
const SHAFT: usize = 5;
const CONFIRMS: f64 = 1.0;
/// Difference of the shaft's speed from the stated one at which its lines are sought, as a share.
const NEAR: f64 = 0.015;

/// What speaks for another speed, in words; `None` where nothing does or no kind is named.
pub(super) fn doubt(
    (signal, spectrum): (&[f64], &mut Spectrum),
    rate: f64,
    combs: &Combs,
    nominal: Frequencies,
    speed: f64,
) -> Option<String> {
    let fault = combs.fault();
    let comb = combs.of(fault)?;
    let suiting = |frequency: f64, kinds: &[Fault]| suiting(frequency, kinds, nominal, speed);
    let beside = &combs.elsewhere;
    if beside.share >= (AS_STRONG * comb.share).max(BESIDE) {
        return Some(format!(
            "beside the comb at {:.2} Hz with {:.1} % of the variance there is one at {:.2} Hz with {:.1} %, limit \
             {AS_STRONG} of the former; it suits {}",
            comb.frequency,
            100.0 * comb.share,
            beside.frequency,
            100.0 * beside.share,
            suiting(beside.frequency, &[Fault::Outer, Fault::Inner, Fault::Element])
        ));
    }
    let lines = Lines::of(&spectrum.squared_envelope(comb.band), rate, comb.band, SPEEDS[1] * nominal.bpfi, speed);
    let turning = comb.frequency / nominal.bpfi * speed;
    let sidebands = sidebands(&lines, comb.frequency, turning);
    let (stand, others): (_, &[Fault]) = match fault {
        Fault::Outer if sidebands >= SIDEBANDS => ("not below", &[Fault::Inner]),
        Fault::Inner if sidebands < SIDEBANDS => ("below", &[Fault::Outer, Fault::Element]),
        _ => return None,
    };
    let other = if fault == Fault::Outer { nominal.bpfi } else { nominal.bpfo };
    let [stated, other] = shaft_lines(signal, rate, [speed, comb.frequency / other * speed]);
    if stated >= other + CONFIRMS {
        return None;
    }
    Some(format!(
        "at ± {turning:.2} Hz, by which an inner raceway's lines have sidebands, those of the comb at {:.2} Hz are \
         {sidebands:.1} standard deviations above chance, {stand} the limit of {SIDEBANDS:.1}, and the shaft's own \
         lines do not confirm the speed; it suits {}",
        comb.frequency,
        suiting(comb.frequency, others)
    ))
}

/// Which of these kinds of fault a comb (Hz) would suit, and at which speed of the shaft.
fn suiting(frequency: f64, kinds: &[Fault], nominal: Frequencies, speed: f64) -> String {
    let all = kinds.iter().filter_map(|kind| {
        let own = match kind {
            Fault::Outer => nominal.bpfo,
            Fault::Inner => nominal.bpfi,
            Fault::Element => 2.0 * nominal.bsf,
            Fault::Undecided | Fault::None => return None,
        };
        let share = frequency / own;
        let considered = share >= SPEEDS[0] * (1.0 - SLIP.end()) && share <= SPEEDS[1] * (1.0 - SLIP.start());
        considered.then(|| format!("{} at a shaft speed of {:.2} Hz", kind.name(), share * speed))
    });
    all.collect::<Vec<_>>().join(" or ")
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

/// Mean of ln(1 + height above the noise near it) of the signal's lines at the harmonics of each speed (Hz), at the
/// most near it.
fn shaft_lines<const N: usize>(signal: &[f64], rate: f64, speeds: [f64; N]) -> [f64; N] {
    let (power, bin) = spectrum::power(signal, rate, signal.len());
    let resolution = rate / signal.len() as f64;
    let height = |f: f64, speed: f64| {
        let at = |f: f64| ((f / bin).max(0.0) as usize).min(power.len());
        // The main lobe of a line that lies between bins, too.
        let line = power[at(f - bin)..at(f + 2.0 * bin)].iter().copied().fold(0.0, f64::max);
        let noise = statistics::median(&power[at(f - 0.4 * speed)..at(f + 0.4 * speed)]);
        if noise > 0.0 { libm::log1p(line / noise) } else { 0.0 }
    };
    let mean = |speed: f64| (1..=SHAFT).map(|k| height(k as f64 * speed, speed)).sum::<f64>() / SHAFT as f64;
    speeds.map(|speed| {
        let near = steps(speed * (1.0 - NEAR), speed * (1.0 + NEAR), resolution / SHAFT as f64);
        near.map(mean).fold(0.0, f64::max)
    })
}
