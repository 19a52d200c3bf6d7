//! Whether a recording suits another speed than the one that is stated.
//!
//! Kinds of fault differ by the order of their comb, so that at another speed any comb is that of another kind: BPFI
//! is 1.5 times BPFO. Questions are asked that an order does not answer.
//!
//! **Are its lines those of one comb, and is it the strongest?** At twice the speed as strong ones stand between them,
//! at half the speed each second or two of three are missing, and at other speeds what is named may be sidebands of a
//! comb elsewhere.
//!
//! **Which speed do the shaft's own lines have?** Unbalance and misalignment make lines at its harmonics in the signal
//! itself. They are looked at where the shaft would turn if the comb were another kind's. On recorded machines they are
//! 3.4 to 10 nepers high at the speed of the shaft, 0.5 to 7 more than at those other speeds.
//!
//! **With which shaft do the passages' strengths repeat?** That is asked if these lines decide nothing ([`Strengths`]).
//! A spall of the inner raceway passes through the load zone once a turn of the shaft, an element's once of the cage.

use super::combs::{Comb, Combs, SLIP};
use super::fault::{EXISTS, Fault};
use super::shaft_lines::{CONFIRMS, DECIBELS, ShaftLines, THERE};
use super::strengths::Strengths;
use crate::spectrum::Spectrum;
use brinell::geometry::kinematics::Frequencies;

/// Speeds that are considered, as shares of the stated one.
const SPEEDS: [f64; 2] = [0.5, 2.0];
/// Share of the named comb's from which lines between its own are as strong. At twice the speed they hold the first of
/// the recording's own comb, and more than what is named; between those of a recording's own comb is noise.
const AS_STRONG: f64 = 0.5;
/// Share of the comb's below which lines are missing that are no multiples of 2, or of 3: at half the speed they have
/// at most 0.09, at the speed of the recording 0.65 and more.
const MISSING: f64 = 0.2;
/// Times the named comb's share from which one elsewhere is stronger: at the speed of a recording 0.14 to 1.2, at other
/// speeds up to 6.
const STRONGER: f64 = 2.0;
/// Share of their variance from which strengths repeat with something, and how many times what explains less is
/// excluded. Of pieces of 1 s recorded over spalls of the inner raceway, which other lines do not decide, its shaft
/// explains 0.29 to 0.64 and that of the outer one nothing; of an element's the cage 0.3 and a shaft half of that.
const REPEATS: f64 = 0.25;
const PLAINLY: f64 = 2.0;
/// Share from which the shaft of the inner raceway is not excluded: over spalls of the outer one it is at most 0.06.
const EXCLUDED: f64 = 0.2;

/// What confirms the stated speed, in words, if anything does.
///
/// # Errors
/// What speaks for another one.
pub(crate) fn check(
    (shaft, spectrum): (&ShaftLines, &mut Spectrum),
    rate: f64,
    combs: &Combs,
    nominal: Frequencies,
    speed: f64,
) -> Result<Option<String>, String> {
    let fault = combs.fault();
    let Some(comb) = combs.of(fault) else { return Ok(None) };
    check_lines(combs, comb, nominal, speed)?;
    let mut others = suiting(comb.frequency, fault, nominal, speed);
    // What repeats as a fault does may be one at its own speed, although what is named repeats more.
    if combs.elsewhere.share >= EXISTS.max(comb.share / STRONGER) {
        others.extend(suiting(combs.elsewhere.frequency, Fault::None, nominal, speed));
    }
    let stated = shaft.height(speed);
    let heights: Vec<f64> = others.iter().map(|&(_, other)| shaft.height(other)).collect();
    let highest = heights.iter().copied().fold(0.0, f64::max);
    let heights = format!(
        "the shaft's own lines are {:.0} dB above the noise at the stated speed, {:.0} dB at another one: {}",
        DECIBELS * stated,
        DECIBELS * highest,
        in_words(&others)
    );
    if highest >= (stated + CONFIRMS).max(THERE) {
        return Err(heights);
    }
    if stated >= (highest + CONFIRMS).max(THERE) {
        return Ok(Some(heights));
    }
    let strongest = if fault == Fault::Element { STRONGER } else { 1.0 };
    if combs.elsewhere.share >= strongest * comb.share {
        return Err(stronger(combs, comb, nominal, speed) + ", and no lines of the shaft confirm the speed");
    }
    let envelope = spectrum.squared_envelope(comb.band);
    check_strengths((&envelope, rate), (fault, comb), nominal, speed)
        .map_err(|why| format!("{why}, and no lines of the shaft confirm the speed; that suits {}", in_words(&others)))
}

/// Whether the passages' strengths repeat with what a defect of this kind turns with, and not with what another does.
fn check_strengths(
    (envelope, rate): (&[f64], f64),
    (fault, comb): (Fault, &Comb),
    nominal: Frequencies,
    speed: f64,
) -> Result<Option<String>, String> {
    let elements = ((nominal.bpfo + nominal.bpfi) / speed).round() as usize;
    let strengths = Strengths::of(envelope, rate, comb.frequency, elements)?;
    // The passages' order of it.
    let [outer, inner, element] = [nominal.bpfo / speed, nominal.bpfi / speed, 2.0 * nominal.bsf / nominal.ftf];
    let (order, rivals): (f64, &[f64]) = match fault {
        Fault::Outer => (outer, &[inner]),
        Fault::Inner => (inner, &[outer]),
        _ => (element, &[inner, outer]),
    };
    let own = strengths.share(order);
    let others = rivals.iter().map(|&order| (strengths.share(order), comb.frequency / order));
    let (other, rival) = others.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
    let shares = format!(
        "{:.0} % of the variance of the passages' strengths repeats with the {} at the stated speed, {:.0} % with a \
         shaft at {rival:.2} Hz",
        100.0 * own,
        if fault == Fault::Element { "cage" } else { "shaft" },
        100.0 * other,
    );
    if own >= REPEATS.max(PLAINLY * other) {
        return Ok(Some(shares));
    }
    // A spall of the outer raceway need not feel the shaft, one of the inner raceway does, and an element's the cage.
    if fault == Fault::Outer && other < EXCLUDED { Ok(None) } else { Err(shares) }
}

/// Whether the named comb's lines are all there, and none between them.
fn check_lines(combs: &Combs, comb: &Comb, nominal: Frequencies, speed: f64) -> Result<(), String> {
    let between = &combs.between;
    if between.share >= AS_STRONG * comb.share {
        return Err(format!(
            "between the lines at multiples of {:.2} Hz ({:.1} % of the envelope's variation) there are those of {:.2} \
             Hz ({:.1} %, limit {AS_STRONG} of the former); that suits {}",
            comb.frequency,
            100.0 * comb.share,
            between.frequency,
            100.0 * between.share,
            in_words(&suiting(between.frequency, Fault::None, nominal, speed))
        ));
    }
    for (times, held) in [2.0, 3.0].into_iter().zip(combs.between_multiples) {
        if held < MISSING * comb.share {
            return Err(format!(
                "the lines at multiples of {:.2} Hz ({:.1} % of the envelope's variation) are, except {:.1} %, those \
                 of {:.2} Hz (limit {MISSING} of all); that suits {}",
                comb.frequency,
                100.0 * comb.share,
                100.0 * held,
                times * comb.frequency,
                in_words(&suiting(times * comb.frequency, Fault::None, nominal, speed))
            ));
        }
    }
    Ok(())
}

fn stronger(combs: &Combs, comb: &Comb, nominal: Frequencies, speed: f64) -> String {
    let other = &combs.elsewhere;
    format!(
        "lines at multiples of {:.2} Hz ({:.1} % of the envelope's variation) are stronger than those of {:.2} Hz \
         ({:.1} %); that suits {}",
        other.frequency,
        100.0 * other.share,
        comb.frequency,
        100.0 * comb.share,
        in_words(&suiting(other.frequency, Fault::None, nominal, speed))
    )
}

/// The kinds of fault, except one, that a comb (Hz) would suit, and at which speed of the shaft (Hz).
fn suiting(frequency: f64, except: Fault, nominal: Frequencies, speed: f64) -> Vec<(Fault, f64)> {
    let kinds = [(Fault::Outer, nominal.bpfo), (Fault::Inner, nominal.bpfi), (Fault::Element, 2.0 * nominal.bsf)];
    let considered = SPEEDS[0] * (1.0 - SLIP.end())..=SPEEDS[1] * (1.0 - SLIP.start());
    let others = kinds.into_iter().filter(|&(kind, own)| kind != except && considered.contains(&(frequency / own)));
    others.map(|(kind, own)| (kind, frequency / own * speed)).collect()
}

fn in_words(suiting: &[(Fault, f64)]) -> String {
    if suiting.is_empty() {
        return "no part at half to twice the stated speed".to_owned();
    }
    let one = |(kind, speed): &(Fault, f64)| format!("{} at a shaft speed of {speed:.2} Hz", kind.name());
    suiting.iter().map(one).collect::<Vec<_>>().join(" or ")
}
