//! Several recordings of one spall: what they say together, and what an answer rests on.

use super::event_length::EventLength;
use super::measured::Cut;
use super::raceway::Raceway;
use super::report::{Kind, Method, Report, Standing};
use super::sized::{FLOOR, Length, Sized};
use super::unresolved::Unresolved;
use crate::spectra::{Fault, Grade};
use crate::statistics;
use brinell::scene::Scene;

/// Scatter between recordings of one spall, as a share of the length, from which they contradict each other.
const CONTRADICTION: f64 = 0.2;
/// Ratio of speeds from which they distinguish time from angle: with 10 % of agreement below, an event at a fixed time
/// would lie 30 % off.
const SPEEDS_APART: f64 = 1.3;
/// Difference of lengths at two speeds up to which they agree, as a share.
const AGREEMENT: f64 = 0.1;
/// Range of the onset before the first impact, as a share of the length, up to which it is one of the inner raceway.
const WANDERS: f64 = 0.06;

/// Several lengths of one spall, combined.
pub(super) struct Combined {
    /// Their mean (degrees).
    pub(super) length: f64,
    /// Its standard uncertainty (degrees).
    pub(super) uncertainty: f64,
}

/// Combines lengths of one spall from so many recordings; or says why there is none.
pub(super) fn combine(lengths: &[&Length], of: usize) -> Result<Combined, String> {
    if 2 * lengths.len() <= of {
        return Err(format!("{} of {of} recordings give a length", lengths.len()));
    }
    let weight = |l: &Length| 1.0 / (l.statistical * l.statistical + FLOOR * FLOOR);
    let total: f64 = lengths.iter().map(|l| weight(l)).sum();
    let mean = lengths.iter().map(|l| weight(l) * l.length).sum::<f64>() / total;
    let all: Vec<f64> = lengths.iter().map(|l| l.length).collect();
    let scatter = statistics::deviation(&all);
    if scatter > CONTRADICTION * mean {
        return Err(format!("the recordings contradict each other: {all:.2?} degrees are not one spall"));
    }
    let systematic = lengths.iter().map(|l| l.systematic).fold(0.0, f64::max);
    let statistical = (1.0 / total).sqrt().max(scatter / (all.len() as f64).sqrt());
    Ok(Combined { length: mean, uncertainty: statistical.hypot(systematic) })
}

/// The fault that all recordings that show one look like.
pub(super) fn common_fault(sized: &[Sized]) -> Fault {
    let mut named = sized.iter().map(|s| s.measured.fault).filter(|&fault| fault != Fault::None);
    let Some(first) = named.next() else { return Fault::None };
    if named.all(|fault| fault == first) { first } else { Fault::Undecided }
}

/// How plainly they show it: as the least plain of those that show it, and no more than possible if they differ.
pub(super) fn common_grade(sized: &[Sized]) -> Grade {
    let fault = common_fault(sized);
    let of_fault = sized.iter().filter(|s| s.measured.fault == fault).map(|s| s.measured.grade);
    match fault {
        Fault::None => Grade::None,
        Fault::Undecided => Grade::Possible,
        _ => of_fault.max().unwrap_or(Grade::Possible),
    }
}

/// Which recording would settle what is open.
pub(super) fn next_step(sized: &[Sized]) -> String {
    let alone = |s: &Sized| s.inside_alone().filter(|_| standing(sized) != Standing::Firm);
    let open = sized.iter().find_map(|s| alone(s).or(s.length.as_ref().err().cloned()));
    let named = sized.iter().any(|s| s.measured.fault != Fault::None);
    // A healthy one among damaged ones settles nothing.
    let open = open.filter(|why| !(named && sized.len() > 1 && matches!(why, Unresolved::NoPattern(..))));
    match open {
        Some(why) => why.next_step().to_owned(),
        None if standing(sized) == Standing::Firm => "nothing; record again to see whether it grows".to_owned(),
        None => {
            let speed = sized.first().map_or(0.0, |s| s.measured.speed);
            format!(
                "record at {:.1} Hz and less or {:.1} Hz and more, and size both recordings together",
                speed / SPEEDS_APART,
                speed * SPEEDS_APART
            )
        }
    }
}

/// On the inner raceway a length is one of two speeds.
pub(super) fn firm_inside(sized: &[Sized]) -> Result<(), String> {
    let is_inside = sized.iter().any(|s| s.inside_alone().is_some());
    if !is_inside || standing(sized) == Standing::Firm {
        return Ok(());
    }
    Err(format!("a length on the inner raceway needs two speeds {SPEEDS_APART} times apart that agree"))
}

/// Lengths of different raceways are not of one spall.
pub(super) fn of_one_fault(sized: &[Sized]) -> Result<(), String> {
    let differ = sized.iter().any(|s| s.measured.fault != Fault::None) && common_fault(sized) == Fault::Undecided;
    if differ && sized.len() > 1 {
        let each: Vec<String> =
            sized.iter().map(|s| format!("{}: {}", s.measured.name, s.measured.combs.described())).collect();
        return Err(format!("the recordings look like different faults: {}", each.join("; ")));
    }
    Ok(())
}

/// Onsets of one spall of the inner raceway that are at different angles.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "the onset wanders by {onset:.2} degrees from recording to recording, limit {limit:.2}, the impacts by \
     {impacts:.2}: it is not the spall's entry, and the length is at least that from first to last impact, \
     {at_least:.2} degrees"
)]
pub(super) struct Wandering {
    onset: f64,
    limit: f64,
    impacts: f64,
    /// From first to last impact, the least of all recordings (degrees).
    pub(super) at_least: f64,
}

/// Whether the events of recordings of one spall of the inner raceway begin at one angle.
pub(super) fn steady_onset(sized: &[Sized]) -> Result<(), Wandering> {
    let inner = sized.iter().filter(|s| s.measured.raceway == Raceway::Inner && s.length.is_ok());
    steady(&inner.filter_map(|s| s.events.as_ref()).collect::<Vec<_>>())
}

/// The onset before the first impact is an angle: on the inner raceway, where little is seen of an entry, one that
/// wanders from speed to speed is not the spall's, however well the lengths agree.
fn steady(events: &[&EventLength]) -> Result<(), Wandering> {
    let least = |of: &dyn Fn(&EventLength) -> f64| events.iter().map(|e| of(e)).fold(f64::INFINITY, f64::min);
    let range = |of: &dyn Fn(&EventLength) -> f64| -least(&|e| -of(e)) - least(of);
    let span = |e: &EventLength| e.impacts.last().copied().unwrap_or(0.0);
    let (onset, limit) = (range(&|e| e.onset), WANDERS * least(&|e| e.length));
    if events.len() < 2 || onset <= limit {
        return Ok(());
    }
    Err(Wandering { onset, limit, impacts: range(&span), at_least: least(&span) })
}

/// What was cut off, in words.
pub(super) fn cuts(sized: &[Sized]) -> Vec<String> {
    let all = sized.iter().filter_map(|s| s.measured.cut.map(|cut| (&s.measured.name, cut)));
    let words = all.map(|(name, Cut { used: [from, to], at, shift })| {
        format!(
            "WARNING: of {name} only {from:.2} to {to:.2} s were used: the passages after about {at:.2} s are shifted \
             by {shift:.1} degrees against those before (the cage skidded, or a piece is missing)"
        )
    });
    words.collect()
}

pub(super) fn common_kind(lengths: &[&Length]) -> Kind {
    let kind = lengths.first().map_or(Kind::Undecided, |l| l.kind);
    if lengths.iter().all(|l| l.kind == kind) { kind } else { Kind::Undecided }
}

/// Firm where lengths at two speeds that are far enough apart agree in degrees.
pub(super) fn standing(sized: &[Sized]) -> Standing {
    let found: Vec<(f64, f64)> =
        sized.iter().filter_map(|s| s.length.as_ref().ok().map(|l| (s.measured.speed, l.length))).collect();
    let pairs = found.iter().flat_map(|a| found.iter().map(move |b| (a, b)));
    let mut wide = pairs.filter(|(a, b)| b.0 >= SPEEDS_APART * a.0).peekable();
    let firm = wide.peek().is_some() && wide.all(|(a, b)| (b.1 - a.1).abs() <= AGREEMENT * a.1);
    if firm { Standing::Firm } else { Standing::Provisional }
}

/// What a resolved answer rests on, and its warnings.
pub(super) fn basis(report: &Report, sized: &[Sized], scene: &Scene) -> String {
    let mut text = match report.method {
        Some(Method::Waveform) => "similarity of the averaged passage to the scene's rig".to_owned(),
        _ => "travel from the entry's onset to the last impact".to_owned(),
    };
    if let Some(described) = sized.iter().find(|s| s.length.is_ok()).map(|s| s.classification.described(scene)) {
        text += &described;
    }
    if report.standing == Some(Standing::Provisional) {
        text += &format!(
            "; PROVISIONAL: an event that belongs to the structure, at the same time at any speed, is distinguished \
             from one of the spall by recordings at speeds {SPEEDS_APART} times apart that agree in degrees"
        );
    }
    for cut in cuts(sized) {
        text += &format!("; {cut}");
    }
    let lost = sized.iter().filter(|s| s.length.is_err()).count();
    if lost > 0 {
        text += &format!("; {lost} of {} recordings unresolved", sized.len());
        for healthy in sized.iter().filter(|s| matches!(s.length, Err(Unresolved::Healthy(_)))) {
            text += &format!("; WARNING: {} sounds like the scene's bearing without a spall", healthy.measured.name);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_an_inner_spall_whose_onset_wanders_are_a_lower_bound_although_they_agree() {
        let of = |onset: f64, impact: f64| EventLength {
            length: impact - onset + 0.2,
            statistical: 0.05,
            systematic: 0.3,
            limit: 1.0,
            first: 3.0,
            onset,
            impacts: vec![0.0, impact],
        };
        assert_eq!(steady(&[&of(-1.30, 3.55), &of(-1.42, 3.52), &of(-1.25, 3.57)]), Ok(()));
        let refused = steady(&[&of(-1.16, 4.10), &of(-1.66, 4.10)]).unwrap_err();
        assert_eq!(refused.at_least, 4.10);
        let why = refused.to_string();
        assert!(why.contains("wanders by 0.50") && why.contains("4.10 degrees"), "{why}");
        assert_eq!(steady(&[&of(-1.16, 4.10)]), Ok(()));
    }
}
