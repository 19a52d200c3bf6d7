//! Which part of the bearing is damaged, how spalls of the inner raceway are sized, and what an answer is worth: from
//! signals that are made here, by the kinematics of an element of finite size, or by the library's own simulation.

use crate::machine::{RATE, Spall, recorded, scene, shipped, signal, signal_of};
use brinell::scene::Scene;
use brinell_analysis::recording::Recording;
use brinell_analysis::sizing::{Fault, Grade, Report, Standing, Verdict, size};
use brinell_analysis::spectrum::{Band, Spectrum};
use brinell_analysis::statistics::{Random, rms};
use std::f64::consts::TAU;

fn sized(signal: Vec<f64>, speed: f64) -> Report {
    size(&[Recording::new("made", signal, RATE, speed).unwrap()], &scene()).unwrap()
}

fn inner(length: f64) -> Spall {
    Spall { length, inner: true, first_impact: true, early: 0.0 }
}

#[test]
fn a_spall_of_the_inner_raceway_is_sized_by_two_speeds_and_one_gives_a_lower_bound() {
    for length in [5.0, 8.0] {
        let made = |speed: f64| Recording::new("made", signal_of(inner(length), speed, 0.03), RATE, speed).unwrap();
        let both = [made(10.0), made(14.0)];
        let report = size(&both, &scene()).unwrap();
        assert_eq!((report.fault, report.standing), (Fault::Inner, Some(Standing::Firm)), "{}", report.reason);
        let found = report.length_deg.unwrap_or(f64::NAN);
        // A tenth is what is asked of recordings.
        assert!((found / length - 1.0).abs() < 0.1, "{length} degrees: {found}, {}", report.reason);
        // Arc on the inner raceway, whose radius is 15.5475 mm at 5 µm of clearance.
        let arc = 15.5475 * found.to_radians();
        assert!((report.length_mm.unwrap() - arc).abs() < 1e-9, "{:?}", report.length_mm);
        // Strong passages are up to eight times as strong; the 90 % and 10 % quantiles lie within that.
        let modulation = report.recordings[0].modulation;
        assert!((3.0..9.0).contains(&modulation), "{modulation}");
        // 0.4 % of slip were put in: the shaft's order of BPFI is 9 − 3.585·0.996.
        assert!((report.slip - 0.004).abs() < 2e-4, "slip {}", report.slip);
        // Where the entry is differs from machine to machine by a third of the length.
        let one = size(&both[..1], &scene()).unwrap();
        assert_eq!((one.length_deg, one.recordings[0].length_deg), (None, None));
        // First and last impact lie within the spall; elements are caught before its end.
        let least = one.at_least_deg.unwrap();
        assert!(least <= length && least > 0.4 * length, "{least} of {length}: {}", one.reason);
        assert!(one.next.contains("two speeds"), "{}", one.next);
    }
}

#[test]
fn a_passage_with_one_impact_on_the_inner_raceway_is_unresolved() {
    let report = sized(signal_of(Spall { first_impact: false, ..inner(5.0) }, 10.0, 0.03), 10.0);
    assert_eq!((report.fault, report.verdict), (Fault::Inner, Verdict::Unresolved));
    assert!(report.reason.contains("one impact per passage in the load zone"), "{}", report.reason);
}

/// Four seconds in which something knocks `order` times a turn, louder and softer `modulation` times a turn.
fn knocking(order: f64, modulation: f64) -> Vec<f64> {
    let (mut random, speed) = (Random::new(11), 10.0);
    let mut signal: Vec<f64> = (0..(4.0 * RATE) as usize).map(|_| 0.05 * random.normal()).collect();
    for k in 0..(4.0 * order * speed) as usize {
        let time = (k as f64 + 0.3 + 0.005 * random.normal()) / (order * speed);
        let loud = 0.5 + 0.5 * (TAU * modulation * speed * time).cos();
        let first = (time * RATE).ceil() as usize;
        for (i, sample) in signal.iter_mut().enumerate().skip(first).take(256) {
            let after = i as f64 / RATE - time;
            *sample += loud * (-after / 0.6e-3).exp() * (TAU * 9000.0 * after).sin();
        }
    }
    signal
}

#[test]
fn a_recording_says_which_kind_of_fault_it_looks_like() {
    // Orders of a 6205: ball twice a turn of its own, loud with the cage; outer raceway; inner raceway with the shaft.
    let kinds = [
        (Fault::Element, knocking(4.7135, 0.3983)),
        (Fault::Inner, knocking(5.4152, 1.0)),
        (Fault::Outer, signal(5.0, 10.0, 0.03)),
    ];
    for (fault, signal) in kinds {
        let report = sized(signal, 10.0);
        assert_eq!(report.fault, fault, "{}", report.reason);
        assert_eq!(report.verdict == Verdict::Resolved, fault == Fault::Outer, "{:?}: {:?}", fault, report.length_deg);
        let said = report.reason.contains("looks like a fault of a rolling element");
        assert_eq!(said, fault == Fault::Element, "{}", report.reason);
        let combs = report.recordings[0].combs;
        assert_eq!(report.recordings[0].grade, Grade::Clear, "{combs:?}");
        let shares = [(Fault::Outer, combs.outer), (Fault::Inner, combs.inner), (Fault::Element, combs.element)];
        for (kind, comb) in shares {
            // What is left of the others is noise and what the comb's own lines do not cover.
            assert!(if kind == fault { comb.share > 0.1 } else { comb.alone < 0.05 }, "{fault:?}: {combs:?}");
        }
        assert!(report.recordings[0].speaks_against.is_empty(), "{:?}", report.recordings[0].speaks_against);
    }
    assert_eq!(sized(signal(0.0, 10.0, 0.05), 10.0).fault, Fault::None);
}

#[test]
fn lines_of_shaft_and_mains_are_no_fault_of_any_bearing() {
    let mut random = Random::new(7);
    let count = (5.0 * RATE) as usize;
    // Resonances whose loudness follows the shaft, the mains and nothing else, as a healthy machine's does.
    let signal: Vec<f64> = (0..count)
        .map(|i| {
            let t = i as f64 / RATE;
            let tone = |f: f64| (TAU * f * t).cos();
            let shaft = (1..40).map(|k| tone(10.03 * f64::from(k)) / f64::from(k).sqrt()).sum::<f64>();
            let mains = (1..7).map(|k| tone(99.93 * f64::from(k)) / f64::from(k)).sum::<f64>();
            let loud = (0.3 * shaft + 0.3 * mains).exp();
            random.normal() * loud + 0.5 * shaft
        })
        .collect();
    // Bearings with frequencies anywhere: BPFO from 2.5 to 4.1, BPFI from 4.0 to 6.5 times the shaft's speed.
    for (balls, diameter) in [(7, 9.0), (8, 11.0), (9, 6.5), (10, 11.0)] {
        let bearing = brinell::scene::Bearing::steel_balls(balls, 1e-3 * diameter, 39.04e-3);
        let scene = Scene { bearing, ..scene() };
        // The speed is said a third of a per cent too low.
        let report = size(&[Recording::new("made", signal.clone(), RATE, 10.0).unwrap()], &scene).unwrap();
        assert_eq!(report.fault, Fault::None, "{balls} of {diameter} mm: {}", report.reason);
        let said = report
            .reason
            .contains("A spall of 2 degrees as loud as recorded ones (37 % and more) would have been seen");
        assert!(said, "{}", report.reason);
    }
}

#[test]
fn recordings_of_different_faults_give_no_length() {
    let recordings = [signal(5.0, 10.0, 0.03), signal_of(inner(5.0), 10.0, 0.03)];
    let recordings = recordings.map(|signal| Recording::new("made", signal, RATE, 10.0).unwrap());
    let report = size(&recordings, &scene()).unwrap();
    assert_eq!((report.fault, report.verdict), (Fault::Undecided, Verdict::Unresolved));
    assert!(report.reason.contains("different faults"), "{}", report.reason);
}

#[test]
fn below_24_khz_no_length_is_read_from_events_however_long_it_seems() {
    let signal = signal(8.0, 10.0, 0.03);
    let low = Spectrum::of(&signal, RATE).filtered(Band { low: 0.0, high: 0.1 * RATE });
    let coarse: Vec<f64> = low.into_iter().step_by(4).collect();
    let report = size(&[Recording::new("coarse", coarse, 0.25 * RATE, 10.0).unwrap()], &scene()).unwrap();
    assert_eq!(report.verdict, Verdict::Unresolved, "{:?}", report.length_deg);
    assert!(report.reason.contains("sampling rate of 12800 Hz: below 24000 Hz"), "{}", report.reason);
}

#[test]
fn one_speed_is_provisional_and_two_that_agree_are_firm() {
    let made = |length: f64, speed: f64| Recording::new("made", signal(length, speed, 0.03), RATE, speed).unwrap();
    let of = |recordings: &[Recording]| size(recordings, &scene()).unwrap();
    let near = of(&[made(5.0, 10.0), made(5.0, 12.0)]);
    assert_eq!(near.standing, Some(Standing::Provisional));
    assert!(near.reason.contains("PROVISIONAL") && near.reason.contains("1.3 times apart"), "{}", near.reason);
    let two = of(&[made(5.0, 10.0), made(5.0, 14.0)]);
    assert_eq!(two.standing, Some(Standing::Firm));
    assert!(!two.reason.contains("PROVISIONAL"), "{}", two.reason);
    // Alike enough not to contradict each other, but not to confirm.
    assert_eq!(of(&[made(5.0, 10.0), made(5.8, 14.0)]).standing, Some(Standing::Provisional));
}

#[test]
fn the_interval_holds_what_is_picked_in_resamples_too() {
    // Half of the passages, drawn by chance, end a little early: which is the last impact is chance.
    let spall = |early| Spall { length: 5.3, inner: false, first_impact: true, early };
    let found = &sized(signal_of(spall(0.2), 10.0, 0.03), 10.0).recordings[0];
    let (length, interval) = found.length_deg.zip(found.uncertainty_deg).unwrap();
    assert!([5.3, 5.1].into_iter().all(|truth| (length - truth).abs() <= interval), "{length} ± {interval}");
    // So early that both are seen.
    let report = sized(signal_of(spall(0.8), 10.0, 0.03), 10.0);
    assert_eq!(report.length_deg, None);
    assert!(report.reason.contains("which of these is the last is unknown"), "{}", report.reason);
}

/// What the sensor of the shipped inner scene records at a speed (Hz), by the cheap law, with noise 30 dB below it.
fn simulated(speed: f64, seconds: f64) -> Vec<f64> {
    let clean = recorded(Scene { shaft_speed: TAU * speed, ..shipped("6205-inner-5deg") }, RATE, seconds);
    let mut random = Random::new(3);
    let noise = 0.03 * rms(&clean);
    clean.iter().map(|x| x + noise * random.normal()).collect()
}

#[test]
fn a_simulated_inner_spall_is_named_as_one_in_the_load_zone_and_never_sized_wrong() {
    let report = sized(simulated(15.0, 1.5), 15.0);
    assert_eq!(report.fault, Fault::Inner, "{:?}", report.recordings[0].combs);
    // Recordings of such spalls show 4- to 19-fold; noise fills the weak passages here.
    assert!(report.recordings[0].modulation > 2.0, "{}", report.recordings[0].modulation);
    // The floor's rebound makes a third impact: most of these are unresolved.
    let right = report.length_deg.is_none_or(|length| (length / 5.0 - 1.0).abs() < 0.15);
    assert!(right, "{:?}", report.length_deg);
}

#[test]
fn a_wrong_speed_gives_no_length_and_the_refusal_says_which_one_would_suit() {
    let outer = (signal(5.0, 10.0, 0.03), Fault::Outer);
    let inside = (signal_of(inner(8.0), 10.0, 0.03), Fault::Inner);
    for (signal, fault) in [outer, inside] {
        // Over fifteen turns as over forty.
        for signal in [&signal[..(1.5 * RATE) as usize], &signal] {
            let report = sized(signal.to_vec(), 10.0);
            assert_eq!(report.fault, fault, "{} s: {}", signal.len() as f64 / RATE, report.reason);
            for share in [0.5, 0.667, 1.5, 2.0] {
                let report = sized(signal.to_vec(), 10.0 * share);
                let named = report.fault;
                let is_silent = report.length_deg.is_none() && [Fault::Undecided, Fault::None].contains(&named);
                assert!(is_silent, "{fault:?} at {share}: {named:?} {:?}", report.length_deg);
            }
        }
    }
    // BPFI is 1.51 times BPFO: what is the outer raceway's at 10 Hz was named the inner one's at 6.67 Hz, with a
    // length.
    let refused = sized(signal(5.0, 10.0, 0.03), 6.667).reason;
    // 0.4 % of slip were put in, and a comb's windows are as wide.
    let suits = |refused: &str, part: &str| {
        let suited = refused.split_once("that suits ").map_or("", |(_, suited)| suited);
        let speeds = suited.split(" or ").filter_map(|one| one.strip_prefix(part)?.split_whitespace().nth(5));
        let near = |speed: &str| speed.parse::<f64>().is_ok_and(|speed| (speed / 10.0 - 1.0).abs() < 0.01);
        refused.contains("is the speed right?") && speeds.into_iter().any(near)
    };
    assert!(suits(&refused, "the outer raceway"), "{refused}");
    let refused = sized(signal_of(inner(8.0), 10.0, 0.03), 15.0).reason;
    assert!(suits(&refused, "the inner raceway"), "{refused}");
}

#[test]
fn after_a_skid_of_the_cage_the_longer_part_is_sized_and_the_answer_says_so() {
    // At 2.8 of 4 s the cage skips 14 of 40 degrees: 35.7 passages a second.
    let mut signal = signal(5.0, 10.0, 0.03);
    let at = (2.8 * RATE) as usize;
    signal.drain(at..at + (14.0 / 40.0 / 35.7 * RATE) as usize);
    let report = sized(signal, 10.0);
    let length = report.length_deg.unwrap_or_else(|| panic!("{}", report.reason));
    assert!((length / 5.0 - 1.0).abs() < 0.1, "{length}: {}", report.reason);
    let [from, to] = report.recordings[0].used_s.unwrap();
    // Where it skips is known to an eighth of the recording, and as much is left out.
    assert!(from == 0.0 && (1.8..2.8).contains(&to), "{from} to {to}");
    assert!(report.reason.contains("the cage skidded, or a piece is missing"), "{}", report.reason);
}

#[test]
fn a_recording_reversed_in_time_gives_no_length() {
    for (mut signal, speed) in [(signal(5.0, 10.0, 0.03), 10.0), (signal_of(inner(8.0), 15.0, 0.03), 15.0)] {
        signal.reverse();
        let report = sized(signal, speed);
        assert_eq!(report.verdict, Verdict::Unresolved, "{:?}", report.length_deg);
        assert!(report.reason.contains("is it reversed in time?"), "{}", report.reason);
    }
}

#[test]
fn a_recording_given_twice_is_refused_by_both_names() {
    let made = |name: &str| Recording::new(name, signal(5.0, 10.0, 0.03), RATE, 10.0).unwrap();
    let refused = size(&[made("one"), made("other")], &scene()).unwrap_err().to_string();
    assert!(refused.contains("other and one have equal samples"), "{refused}");
}
