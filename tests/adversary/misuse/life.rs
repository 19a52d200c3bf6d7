//! Calls that begin, arrange and end the life of an instance.

use super::chance::Chance;
use super::standard::{DISCARD, ERROR, OK, WARNING};
use super::walker::{ALL_CATEGORIES, State, Strangers, Walker};
use crate::two::{Call, logger};
use brinell_fmi::fmi2::*;
use std::ffi::{CStr, CString, c_void};
use std::ptr;

pub(super) fn platform(w: &mut Walker, _: &mut Chance, _: bool, _: &Strangers) {
    // SAFETY: a static string.
    let text = unsafe { CStr::from_ptr(fmi2GetTypesPlatform()) };
    w.judge("fmi2GetTypesPlatform", OK, Status::Ok, String::new);
    w.require(text == c"default", || format!("{text:?}"));
}

pub(super) fn version(w: &mut Walker, _: &mut Chance, _: bool, _: &Strangers) {
    // SAFETY: a static string.
    let text = unsafe { CStr::from_ptr(fmi2GetVersion()) };
    w.judge("fmi2GetVersion", OK, Status::Ok, String::new);
    w.require(text == c"2.0", || format!("{text:?}"));
}

/// Another instance, of good arguments or with one that is wrong: then NULL, and a line that says why.
pub(super) fn instantiate(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let (guid, location) = (w.stage.resources.guid.clone(), w.stage.resources.uri());
    let elsewhere = format!("{location}/elsewhere");
    let mut call = Call {
        name: Some("another"),
        fmu_type: CO_SIMULATION,
        guid: Some(&guid),
        location: Some(&location),
        logger: Some(logger()),
        logging: chance.one_in(2),
    };
    let wrong = if kind { 9 } else { chance.below(10) };
    match wrong {
        0 => call.name = None,
        1 => call.name = Some(" \n"),
        2 => call.fmu_type = 0,
        3 => call.fmu_type = *chance.pick(&[-1, 2, i32::MAX, i32::MIN]),
        4 => call.guid = None,
        5 => call.guid = Some("{00000000-0000-0000-0000-000000000000}"),
        6 => call.location = None,
        7 => call.location = Some(*chance.pick(&["", "http://a/b", "file:///", "file://else/where", &elsewhere])),
        8 => call.logger = None,
        _ => {}
    }
    let (c, log) = call.make();
    let lines = log.take();
    let status = if c.is_null() { Status::Error } else { Status::Ok };
    w.remember(format!("fmi2Instantiate(another one, wrong argument {wrong}): {status:?}"));
    w.tally.count("fmi2Instantiate", w.model.state, status);
    w.require(c.is_null() == (wrong < 9), || format!("{lines:?}"));
    let complaints = lines.iter().filter(|line| line.status == Status::Error).count();
    w.require(complaints == usize::from(wrong < 8), || format!("{lines:?}"));
    // SAFETY: any handle may be passed. Without callbacks there is nobody to tell.
    unsafe {
        fmi2FreeInstance(c);
        assert!(fmi2Instantiate(ptr::null(), 1, ptr::null(), ptr::null(), ptr::null(), TRUE, TRUE).is_null());
    }
}

/// The end of the instance and of its twin. What is called on the handle afterwards leads nowhere.
pub(super) fn free(w: &mut Walker, chance: &mut Chance, _: bool, others: &Strangers) {
    w.compare();
    if chance.one_in(2) {
        w.compare_with_the_straight_way();
    }
    w.tally.count("fmi2FreeInstance", w.model.state, Status::Ok);
    w.remember("fmi2FreeInstance".to_owned());
    let (clean, c) = (w.model.state != State::Error, w.subject.c);
    // SAFETY: any handle may be passed.
    unsafe {
        fmi2FreeInstance(c);
        fmi2FreeInstance(w.twin.c);
    }
    let lines = w.subject.lines();
    let loses = w.lacks_room();
    w.require(loses || lines.is_empty(), || format!("{lines:?}"));
    if clean {
        w.compare_recordings();
    }
    w.gone = true;
    no_instance(w, c, chance);
    if !others.dead.is_empty() {
        no_instance(w, ptr::without_provenance_mut(*chance.pick(&others.dead)), chance);
    }
    let invented = chance.number() as usize;
    for handle in [ptr::null_mut(), ptr::without_provenance_mut(invented), ptr::from_ref(w.stage).cast_mut().cast()] {
        no_instance(w, handle, chance);
    }
}

/// Calls on a handle that is freed, invented or NULL: errors, and nobody's log hears of them.
fn no_instance(w: &mut Walker, c: *mut c_void, chance: &mut Chance) {
    let (mut number, mut state, mut size) = (0.0, ptr::null_mut(), 0);
    let reference = 0;
    // SAFETY: any handle may be passed; pointers to one value each.
    let status = unsafe {
        match chance.below(12) {
            0 => fmi2GetReal(c, &raw const reference, 1, &raw mut number),
            1 => fmi2SetReal(c, &raw const reference, 1, &raw const number),
            2 => fmi2DoStep(c, 0.0, 1e-5, TRUE),
            3 => fmi2Reset(c),
            4 => fmi2Terminate(c),
            5 => fmi2GetFMUstate(c, &raw mut state),
            6 => fmi2SetFMUstate(c, c),
            7 => fmi2SerializedFMUstateSize(c, c, &raw mut size),
            8 => fmi2SetDebugLogging(c, TRUE, 0, ptr::null()),
            9 => fmi2SetupExperiment(c, FALSE, 0.0, 0.0, FALSE, 0.0),
            10 => fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, &raw mut number),
            _ => fmi2CancelStep(c),
        }
    };
    w.tally.strange += 1;
    let untouched = number == 0.0 && state.is_null() && size == 0;
    w.require(status == Status::Error && untouched, || format!("{status:?} from handle {c:?}, which is not one"));
    let lines = w.subject.lines();
    w.require(lines.is_empty(), || format!("{lines:?}"));
}

pub(super) fn debug_logging(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    const KNOWN: [(&str, u8); 6] = [
        ("logEvents", 1),
        ("logStatusWarning", 2),
        ("logStatusDiscard", 4),
        ("logStatusError", 8),
        ("logStatusFatal", 0),
        ("logAll", ALL_CATEGORIES),
    ];
    let on = kind || !chance.one_in(4);
    let mut names: Vec<&str> = (0..chance.below(3)).map(|_| chance.pick(&KNOWN).0).collect();
    let of = |name: &&str| KNOWN.iter().find(|(known, _)| known == name).map_or(0, |(_, bits)| *bits);
    let mut verdict = OK;
    let wrong = if kind { 9 } else { chance.below(10) };
    if wrong == 0 {
        names.push(*chance.pick(&["", "%s%n", "logall", "Ereignisse ä"]));
        verdict = WARNING;
    }
    let texts: Vec<_> = names.iter().map(|name| CString::new(*name).unwrap()).collect();
    let mut pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
    let (mut count, mut list) = (pointers.len(), pointers.as_ptr());
    match wrong {
        1 => {
            pointers.push(ptr::null());
            (count, list, verdict) = (pointers.len(), pointers.as_ptr(), ERROR);
        }
        2 => (count, list, verdict) = (3, ptr::null(), ERROR),
        3 => (count, list, verdict) = (usize::MAX, pointers.as_ptr().wrapping_add(1), ERROR),
        _ => {}
    }
    let before = w.categories;
    if verdict != ERROR {
        let listed = names.iter().map(of).fold(0, |all, one| all | one);
        let known = |name: &&str| KNOWN.iter().any(|(known, _)| known == name);
        w.categories = if !on {
            0
        } else if names.is_empty() {
            ALL_CATEGORIES
        } else if names.iter().any(known) {
            listed
        } else {
            w.categories
        };
    }
    // SAFETY: as many strings as said, each ended by NUL; or pointers that are to be refused.
    let status = unsafe { fmi2SetDebugLogging(w.subject.c, on.into(), count, list) };
    let done = w.judge("fmi2SetDebugLogging", verdict, status, || format!("{on}, {count}, {names:?}"));
    w.require(done || w.categories == before, || "categories".to_owned());
}

pub(super) fn setup(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    const STARTS: [f64; 7] = [0.0, 0.0, -3.0, 1e-3, 1e5, 1e6, 1.76e9];
    let mut start = *chance.pick(&STARTS);
    let mut stop = chance.one_in(3).then(|| start + chance.decades(3e-4, 1e-2).max(1e3 * f64::EPSILON * start.abs()));
    let mut tolerance = chance.one_in(3).then(|| chance.decades(1e-7, 1e-3));
    let mut verdict = OK;
    if !kind {
        let odd = *chance.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
        verdict = ERROR;
        match chance.below(8) {
            0 => start = odd,
            1 => stop = Some(odd),
            2 => stop = Some(start),
            3 => stop = Some(start - chance.decades(1e-6, 1e3).max(1e-9 * start.abs())),
            4 => tolerance = Some(odd),
            5 => tolerance = Some(-chance.between(0.0, 1.0)),
            _ => verdict = OK,
        }
    }
    let status = w.subject.setup(tolerance, start, stop);
    if w.judge("fmi2SetupExperiment", verdict, status, || format!("{tolerance:?}, {start:?}, {stop:?}")) {
        w.follow(move |twin| twin.setup(tolerance, start, stop));
        w.model.clock = Some((start, stop));
    }
}

pub(super) fn enter(w: &mut Walker, _: &mut Chance, _: bool, _: &Strangers) {
    let verdict = if w.model.clock.is_some() { OK } else { ERROR };
    let status = w.subject.enter();
    if w.judge("fmi2EnterInitializationMode", verdict, status, String::new) {
        w.follow(|twin| twin.enter());
        w.model.state = State::Initialization;
    }
}

pub(super) fn exit(w: &mut Walker, _: &mut Chance, _: bool, _: &Strangers) {
    let allowed = w.model.state == State::Initialization;
    let status = w.subject.exit();
    let done = w.judge("fmi2ExitInitializationMode", w.unless_wild(w.begins_recording()), status, String::new);
    if done {
        w.follow(|twin| twin.exit());
        w.model.state = State::StepComplete;
    }
    if allowed {
        w.recording_began(done);
    }
}

pub(super) fn terminate(w: &mut Walker, _: &mut Chance, _: bool, _: &Strangers) {
    // What cannot be stored stays in memory, which is worth a warning.
    let verdict = if w.lacks_room() { OK.or(WARNING) } else { OK };
    let status = w.subject.terminate();
    if w.judge("fmi2Terminate", verdict, status, String::new) {
        w.follow(|twin| twin.terminate());
        w.model.state = State::Terminated;
        w.compare_recordings();
    }
}

/// Gives a usable instance, whatever was before.
pub(super) fn reset(w: &mut Walker, _: &mut Chance, _: bool, _: &Strangers) {
    // A recording that cannot be finished is lost, which is worth a warning and no more.
    let verdict = if w.lacks_room() { OK.or(WARNING) } else { OK };
    let clean = w.model.state != State::Error;
    let status = w.subject.reset();
    if w.judge("fmi2Reset", verdict, status, String::new) {
        // SAFETY: any handle may be passed.
        assert_eq!(unsafe { fmi2Reset(w.twin.c) }, Status::Ok);
        if clean {
            w.compare_recordings();
        }
        w.start_over();
    }
}

pub(super) fn cancel(w: &mut Walker, _: &mut Chance, _: bool, _: &Strangers) {
    // SAFETY: any handle may be passed.
    let status = unsafe { fmi2CancelStep(w.subject.c) };
    w.judge("fmi2CancelStep", OK.or(DISCARD), status, String::new);
}
