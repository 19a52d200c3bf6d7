//! Calls that read and set variables and their derivatives.

use super::chance::Chance;
use super::stage::{gentle, impossible, wild};
use super::standard::{DISCARD, ERROR, OK, Statuses};
use super::walker::{Folder, State, Strangers, Walker};
use brinell_fmi::fmi2::*;
use std::ffi::CString;
use std::ptr;

/// A list of references for reading: real ones, with at most one wrong thing.
fn references(w: &Walker, chance: &mut Chance, kind: bool, right: &[u32]) -> (Vec<u32>, Statuses) {
    let mut list: Vec<u32> = match chance.below(4) {
        0 => right.to_vec(),
        _ if right.is_empty() => vec![],
        _ => (0..chance.below(8)).map(|_| *chance.pick(right)).collect(),
    };
    if kind || chance.one_in(2) {
        return (list, OK);
    }
    let others: Vec<u32> = w.stage.references(|v| !right.contains(&v.reference));
    let wrong = if chance.one_in(2) { w.stage.unknown(chance) } else { *chance.pick(&others) };
    list.insert(chance.below(list.len() + 1), wrong);
    (list, ERROR)
}

/// Pointers and a count that are to be refused; `None` for good ones.
fn bad_arrays(chance: &mut Chance, kind: bool) -> Option<usize> {
    (!kind && chance.one_in(4)).then(|| chance.below(6))
}

/// Reads into memory that a mistake of this number makes unfit. The call is an error, and nothing is written.
fn refused<T>(mistake: usize, get: impl Fn(*const u32, usize, *mut T) -> Status) -> Status {
    let mut words = [0u64; 8];
    let base = words.as_mut_ptr();
    let status = match mistake {
        0 => get(ptr::null(), 3, base.cast()),
        1 => get(base.cast(), 3, ptr::null_mut()),
        2 => get(base.wrapping_byte_add(1).cast(), 2, base.wrapping_add(4).cast()),
        3 => get(base.cast(), 4, base.wrapping_byte_add(8).cast()),
        4 => get(base.cast(), usize::MAX, base.wrapping_add(4).cast()),
        _ => get(base.cast(), (1 << 20) + 1, base.wrapping_add(4).cast()),
    };
    assert_eq!(words, [0; 8]);
    status
}

pub(super) fn get_real(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    if let Some(mistake) = bad_arrays(chance, kind) {
        // SAFETY: unfit arrays are to be refused before they are touched.
        let status = refused(mistake, |vr, n, value: *mut f64| unsafe { fmi2GetReal(w.subject.c, vr, n, value) });
        w.judge("fmi2GetReal", ERROR, status, || format!("mistake {mistake}"));
        return;
    }
    let (list, verdict) = references(w, chance, kind, &w.stage.reals(None));
    let result = w.subject.get(&list);
    let status = result.as_ref().err().copied().unwrap_or(Status::Ok);
    w.judge("fmi2GetReal", w.unless_wild(verdict), status, || format!("{list:?}"));
    // What a host asks for decides what its coupling is told to lose.
    if status == Status::Ok {
        let list = list.clone();
        w.follow(move |twin| twin.get(&list).err().unwrap_or(Status::Ok));
    }
    let finite = result.iter().flatten().all(|value| value.is_finite());
    w.require(finite, || format!("not finite under OK: {result:?}"));
}

pub(super) fn get_integer(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    if let Some(mistake) = bad_arrays(chance, kind) {
        // SAFETY: as above.
        let status = refused(mistake, |vr, n, value: *mut i32| unsafe { fmi2GetInteger(w.subject.c, vr, n, value) });
        w.judge("fmi2GetInteger", ERROR, status, || format!("mistake {mistake}"));
        return;
    }
    let (list, verdict) = references(w, chance, kind, &w.stage.integers());
    let status = w.subject.get_integers(&list).err().unwrap_or(Status::Ok);
    w.judge("fmi2GetInteger", w.unless_wild(verdict), status, || format!("{list:?}"));
}

pub(super) fn get_boolean(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let (list, verdict) = references(w, chance, kind, &[]);
    let mut values = vec![7; list.len()];
    // SAFETY: the arrays are as long as said.
    let status = unsafe { fmi2GetBoolean(w.subject.c, list.as_ptr(), list.len(), values.as_mut_ptr()) };
    w.judge("fmi2GetBoolean", verdict, status, || format!("{list:?}"));
}

pub(super) fn get_string(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let folder: Vec<u32> = w.stage.folder().into_iter().collect();
    let (list, verdict) = references(w, chance, kind, &folder);
    let mut values: Vec<FmiString> = vec![ptr::null(); list.len()];
    // SAFETY: the arrays are as long as said.
    let status = unsafe { fmi2GetString(w.subject.c, list.as_ptr(), list.len(), values.as_mut_ptr()) };
    let done = w.judge("fmi2GetString", verdict, status, || format!("{list:?}"));
    for value in values.iter().filter(|_| done) {
        // SAFETY: Brinell hands out strings that end in NUL, valid until the next call.
        let text = unsafe { std::ffi::CStr::from_ptr(*value) }.to_str().unwrap().to_owned();
        w.require(text == path(w, w.folder), || format!("folder {text:?}"));
    }
}

fn path(w: &Walker, folder: Folder) -> String {
    let path = match folder {
        Folder::None => return String::new(),
        Folder::Shared => w.folders.shared(),
        Folder::Full => w.folders.full().unwrap(),
        Folder::Blocked => w.folders.blocked(),
    };
    path.to_str().unwrap().to_owned()
}

pub(super) fn set_real(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let settable = w.stage.settable(w.model.state == State::StepComplete);
    let right: Vec<u32> = settable.iter().copied().filter(|r| !w.stage.takes_long(*r)).collect();
    let mut list: Vec<u32> = (0..chance.below(6)).map(|_| *chance.pick(&right)).collect();
    let mut values: Vec<f64> = list.iter().map(|&r| gentle(w.stage.variable(r), chance)).collect();
    let (mut verdict, mut turns_wild) = (OK, false);
    let reference = *chance.pick(&right);
    let index = chance.below(list.len() + 1);
    match if kind { 9 } else { chance.below(8) } {
        0 => {
            list.insert(index, reference);
            values.insert(index, wild(w.stage.variable(reference), chance));
            turns_wild = true;
        }
        1 | 2 => {
            list.insert(index, reference);
            values.insert(index, impossible(w.stage.variable(reference), chance));
            verdict = DISCARD;
        }
        3 | 4 => {
            let others: Vec<u32> = w.stage.references(|v| !settable.contains(&v.reference));
            let wrong = if chance.one_in(3) { w.stage.unknown(chance) } else { *chance.pick(&others) };
            list.insert(index, wrong);
            values.insert(index, 1.0);
            verdict = ERROR;
        }
        5 => {
            let mistake = chance.below(6);
            // SAFETY: unfit arrays are to be refused before they are touched; reading may overlap, so that is left out.
            let set = |vr: *const u32, n, value: *mut f64| unsafe { fmi2SetReal(w.subject.c, vr, n, value) };
            let status = refused(if mistake == 3 { 2 } else { mistake }, set);
            w.judge("fmi2SetReal", ERROR, status, || format!("mistake {mistake}"));
            return;
        }
        _ => {}
    }
    let status = w.subject.set(&list, &values);
    if w.judge("fmi2SetReal", verdict, status, || format!("{list:?}, {values:?}")) {
        let (all, of) = (list.clone(), values.clone());
        w.follow(move |twin| twin.set(&all, &of));
        w.model.wild |= turns_wild;
        // The last value given to a variable is the one that is read back.
        if w.model.state != State::Instantiated {
            let read = w.subject.get(&list).unwrap();
            let last = |r: &u32| values[list.iter().rposition(|other| other == r).unwrap()];
            let same = list.iter().zip(&read).all(|(r, value)| value.to_bits() == last(r).to_bits());
            w.require(same, || format!("read back {read:?}"));
        }
    }
}

pub(super) fn set_integer(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let laws = w.stage.references(|v| v.name == "contact.law");
    let fixed = w.model.state == State::StepComplete;
    // With a defect the other laws take seconds to set up.
    let healthy = w.stage.references(|v| v.name.starts_with("defect")).is_empty();
    let law = if healthy { 1 + chance.below(3) as i32 } else { 1 };
    let seeds = w.stage.references(|v| v.name == "cage.seed");
    let seed_verdict = if fixed && !seeds.is_empty() { ERROR } else { OK };
    let (list, value, verdict) = match if kind { 9 } else { chance.below(6) } {
        0 => (laws, *chance.pick(&[0, 4, -1, i32::MAX, i32::MIN]), if fixed { ERROR } else { DISCARD }),
        1 => (vec![w.stage.unknown(chance)], 1, ERROR),
        2 => (w.stage.references(|v| v.name != "contact.law")[..3].to_vec(), 1, ERROR),
        3 => (vec![], 1, OK),
        4 => (seeds, chance.below(1000) as i32, seed_verdict),
        _ => (laws, law, if fixed { ERROR } else { OK }),
    };
    let values = vec![value; list.len()];
    let status = w.subject.set_integers(&list, &values);
    if w.judge("fmi2SetInteger", verdict, status, || format!("{list:?}, {values:?}")) {
        w.follow(move |twin| twin.set_integers(&list, &values));
    }
}

pub(super) fn set_boolean(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let (list, verdict) = references(w, chance, kind, &[]);
    let values = vec![TRUE; list.len()];
    // SAFETY: the arrays are as long as said.
    let status = unsafe { fmi2SetBoolean(w.subject.c, list.as_ptr(), list.len(), values.as_ptr()) };
    w.judge("fmi2SetBoolean", verdict, status, || format!("{list:?}"));
}

/// The folder of the recorder: none, good, full, impossible; or a text that is none.
pub(super) fn set_string(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let Some(reference) = w.stage.folder() else {
        let (list, verdict) = references(w, chance, kind, &[]);
        let values = vec![c"text".as_ptr(); list.len()];
        // SAFETY: the arrays are as long as said.
        let status = unsafe { fmi2SetString(w.subject.c, list.as_ptr(), list.len(), values.as_ptr()) };
        w.judge("fmi2SetString", verdict, status, || format!("{list:?}"));
        return;
    };
    let mut verdict = if w.model.state == State::StepComplete { ERROR } else { OK };
    let full = w.folders.full().is_some();
    let folder = match chance.below(if kind { 6 } else { 8 }) {
        0 => Folder::None,
        1..=3 if full => Folder::Full,
        1..=5 => Folder::Shared,
        _ => Folder::Blocked,
    };
    let text = CString::new(path(w, folder)).unwrap();
    let (mut list, mut values) = (vec![reference], vec![text.as_ptr()]);
    match if kind { 9 } else { chance.below(9) } {
        0 => (values, verdict) = (vec![ptr::null()], ERROR),
        1 => (values, verdict) = (vec![c"\xff\xfe".as_ptr()], ERROR),
        2 => (list, verdict) = (vec![w.stage.unknown(chance)], ERROR),
        3 => (list, verdict) = (vec![w.stage.reals(None)[0]], ERROR),
        _ => {}
    }
    // SAFETY: the arrays are as long as said; strings end in NUL or are NULL.
    let status = unsafe { fmi2SetString(w.subject.c, list.as_ptr(), 1, values.as_ptr()) };
    if w.judge("fmi2SetString", verdict, status, || format!("{list:?}, {text:?}")) {
        let own = match folder {
            Folder::None => String::new(),
            _ => w.folders.own(w.number).to_str().unwrap().to_owned(),
        };
        let own = CString::new(own).unwrap();
        // SAFETY: one element each.
        w.alongside(|twin| unsafe { fmi2SetString(twin.c, &raw const reference, 1, &own.as_ptr()) });
        w.folder = folder;
    }
}
