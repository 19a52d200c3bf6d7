//! Whether a recording suits another speed than the one that is stated.
//!
//! Kinds of fault are told by the order of their comb, so that at another speed any comb is that of another kind: BPFI
//! is 1.5 times BPFO. Two questions are asked that an order does not answer.
//!
//! **Is there a comb beside it?** At twice the speed the comb takes every second line of the recording, and as strong
//! ones stand between them.
//!
//! **Does the spall turn?** One of the inner raceway passes through the load zone once a turn, and its lines have
//! sidebands at the speed of the shaft that belongs to them, the comb's frequency over the order of BPFI. Lines of the
//! outer raceway have none at that distance.

use crate::spectra::combs::{LOBE, Lines, QUIET, SIGNIFICANT, SLIP, above, steps};
use crate::spectra::{Combs, Fault};
use crate::spectrum::Spectrum;
use crate::statistics;
use brinell::geometry::kinematics::Frequencies;

/// Speeds that are thought of, as shares of the stated one.
const SPEEDS: [f64; 2] = [0.5, 2.0];
/// Share of the named comb's strength from which another is as strong: combs beside a comb that is a recording's own
/// reach 0.81 of it, lines between those of a wrong one have 0.9 to 2.5 times its strength.
const AS_STRONG: f64 = 0.85;
/// Fewest lines of a comb beside the named one: half of the ten, one of which may be the shaft's.
const FEWEST: usize = 4;
/// Difference of frequencies, as a share, up to which they are of one line: passages wander.
const SAME_LINE: f64 = 0.01;
/// Difference of frequencies, as a share, up to which combs are one.
const SAME_COMB: f64 = 0.04;
/// Standard deviations above those at other distances from which sidebands exist: recordings of inner raceways have 6
/// to 34, of outer ones −1 to 2.7, but for one of 7.
const SIDEBANDS: f64 = 4.0;

/// What speaks for another speed, in words; `None` where nothing does or no kind is named.
pub(super) fn doubt(
    spectrum: &mut Spectrum,
    rate: f64,
    combs: &Combs,
    nominal: Frequencies,
    speed: f64,
) -> Option<String> {
    let fault = combs.fault();
    let comb = combs.of(fault)?;
    let lines = Lines::of(&spectrum.squared_envelope(comb.band), rate, SPEEDS[1] * nominal.bpfi, speed);
    let suiting = |frequency: f64, kinds: &[Fault]| suiting(frequency, kinds, nominal, speed);
    if let Some((beside, strength)) = comb_beside(&lines, comb.frequency, nominal)
        && strength >= AS_STRONG * comb.strength
    {
        let who = suiting(beside, &[Fault::Outer, Fault::Inner, Fault::Element]);
        return Some(format!(
            "beside the comb at {:.2} Hz of strength {:.1} there is one at {beside:.2} Hz of strength {strength:.1}, \
             limit {AS_STRONG} of the former; it suits {who}",
            comb.frequency, comb.strength
        ));
    }
    let turning = comb.frequency / nominal.bpfi * speed;
    let sidebands = sidebands(&lines, comb.frequency, turning);
    let (stand, who) = match fault {
        Fault::Outer if sidebands >= SIDEBANDS => ("not below", suiting(comb.frequency, &[Fault::Inner])),
        Fault::Inner if sidebands < SIDEBANDS => ("below", suiting(comb.frequency, &[Fault::Outer, Fault::Element])),
        _ => return None,
    };
    Some(format!(
        "at ± {turning:.2} Hz, by which an inner raceway's lines have sidebands, those of the comb at {:.2} Hz are \
         {sidebands:.1} standard deviations above chance, {stand} the limit of {SIDEBANDS:.1}; it suits {who}",
        comb.frequency
    ))
}

/// Which of these kinds of fault a comb (Hz) would suit, and at which speed of the shaft.
fn suiting(frequency: f64, kinds: &[Fault], nominal: Frequencies, speed: f64) -> String {
    let all = kinds.iter().filter_map(|kind| {
        let (name, own) = match kind {
            Fault::Outer => ("the outer raceway", nominal.bpfo),
            Fault::Inner => ("the inner raceway", nominal.bpfi),
            Fault::Element => ("a rolling element", 2.0 * nominal.bsf),
            Fault::Undecided | Fault::None => return None,
        };
        let share = frequency / own;
        let thought_of = share >= SPEEDS[0] * (1.0 - SLIP.end()) && share <= SPEEDS[1] * (1.0 - SLIP.start());
        thought_of.then(|| format!("{name} at a shaft speed of {:.2} Hz", share * speed))
    });
    all.collect::<Vec<_>>().join(" or ")
}

/// The strongest comb of lines that one at `named` (Hz) does not have, if it stands above chance: its frequency (Hz)
/// and strength.
fn comb_beside(lines: &Lines, named: f64, nominal: Frequencies) -> Option<(f64, f64)> {
    let of_named = |f: f64| (f - (f / named).round() * named).abs() < (SAME_LINE * f).max(LOBE / lines.duration);
    let strength = |frequency: f64| {
        let heights = lines.heights(frequency, |f| lines.at(f)).filter(|&(f, _)| !of_named(f));
        let logs: Vec<f64> = heights.map(|(_, height)| libm::log1p(height)).collect();
        if logs.len() < FEWEST { 0.0 } else { statistics::mean(&logs) }
    };
    let (low, high) = (SPEEDS[0] * (1.0 - SLIP.end()) * nominal.bpfo, SPEEDS[1] * nominal.bpfi);
    // The tenth line is met within half of the bins that its lobe spans.
    let all: Vec<(f64, f64)> = steps(low, high, 0.05 / lines.duration)
        .filter(|&f| !lines.of_shaft(f) && (f / named - 1.0).abs() > SAME_COMB)
        .map(|f| (f, strength(f)))
        .collect();
    let best = all.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let chance: Vec<f64> = all.into_iter().map(|(_, strength)| strength).collect();
    (above(&chance, best.1) >= SIGNIFICANT).then_some(best)
}

/// How far sidebands of a comb (Hz) at about `distance` (Hz) stand above those at other distances (standard
/// deviations). What modulates makes one on each side: the lower of the two counts,
/// and [`QUIET`] of the comb's own line is not heard.
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
