//! Calls that save, restore and serialize states: one's own, other instances', freed, invented and damaged ones.

use super::chance::Chance;
use super::standard::{ERROR, OK};
use super::walker::{Blob, Saved, State, Strangers, Walker};
use brinell_fmi::fmi2::*;
use std::ptr;
use std::sync::Arc;

/// Most states that an instance keeps.
const MOST: usize = 8;

/// a handle that is not of this instance's states.
fn not_ours(w: &Walker, chance: &mut Chance, others: &Strangers) -> FmuState {
    let invented = chance.number() as usize;
    let address = match chance.below(6) {
        0 if !w.freed.is_empty() => return *chance.pick(&w.freed),
        1 | 2 if !others.states.is_empty() => *chance.pick(&others.states),
        3 => w.subject.c.addr(),
        4 if !w.saved.is_empty() => chance.pick(&w.saved).handle.addr() ^ 1 << chance.below(64),
        5 => *chance.pick(&[1, 8, 16, usize::MAX, usize::MAX - 7]),
        _ => invented | 1,
    };
    // Chance may hit one's own.
    let own = w.saved.iter().any(|saved| saved.handle.addr() == address);
    ptr::without_provenance_mut(if own { 1 } else { address })
}

pub(super) fn get_state(w: &mut Walker, chance: &mut Chance, kind: bool, others: &Strangers) {
    if !kind && chance.one_in(3) {
        let wrong = not_ours(w, chance, others);
        let mut handle = wrong;
        let pointer = if chance.one_in(3) { ptr::null_mut() } else { &raw mut handle };
        // SAFETY: a pointer to one value, or NULL. The handle in it may have any value.
        let status = unsafe { fmi2GetFMUstate(w.subject.c, pointer) };
        w.judge("fmi2GetFMUstate", ERROR, status, || format!("{wrong:?}"));
        w.require(handle == wrong, || "the handle changed".to_owned());
        return;
    }
    let model = w.model.clone();
    let over =
        (!w.saved.is_empty() && (w.saved.len() == MOST || chance.one_in(3))).then(|| chance.below(w.saved.len()));
    let before = over.map_or(ptr::null_mut(), |index| w.saved[index].handle);
    let mut handle = before;
    // SAFETY: NULL or a handle of this instance.
    let status = unsafe { fmi2GetFMUstate(w.subject.c, &raw mut handle) };
    w.judge("fmi2GetFMUstate", OK, status, || format!("over {over:?}"));
    w.require(over.is_none() || handle == before, || "the handle changed".to_owned());
    w.require(!w.freed.contains(&handle), || "the handle of a freed state is used again".to_owned());
    let twin = w.together.then(|| w.twin.save());
    let saved = Saved { handle, twin, model };
    match over {
        Some(index) => {
            let old = std::mem::replace(&mut w.saved[index], saved);
            forget_twins(w, &old);
        }
        None => w.saved.push(saved),
    }
}

fn forget_twins(w: &Walker, saved: &Saved) {
    if let Some(handle) = saved.twin {
        assert_eq!(w.twin.free(handle), Status::Ok);
    }
}

pub(super) fn set_state(w: &mut Walker, chance: &mut Chance, kind: bool, others: &Strangers) {
    if w.saved.is_empty() || !kind && chance.one_in(3) {
        let wrong = if chance.one_in(4) { ptr::null_mut() } else { not_ours(w, chance, others) };
        let status = w.subject.restore(wrong);
        w.judge("fmi2SetFMUstate", ERROR, status, || format!("{wrong:?}"));
        return;
    }
    let index = chance.below(w.saved.len());
    let (handle, twin, model) = (w.saved[index].handle, w.saved[index].twin, w.saved[index].model.clone());
    // A run that is taken up in its middle is recorded from there.
    let begins = w.file != Some(true) && model.state == State::StepComplete;
    let mut verdict = if begins { w.begins_recording() } else { OK };
    if model.wild || begins && w.file.is_none() {
        verdict = OK.or(ERROR);
    }
    let status = w.subject.restore(handle);
    let done = status <= Status::Warning;
    if begins && (w.file == Some(false) || !done) {
        w.recording_began(done);
    }
    if w.judge("fmi2SetFMUstate", verdict, status, || format!("state {index}")) {
        w.together = twin.is_some_and(|twin| w.twin.restore(twin) == Status::Ok);
        w.require(twin.is_none() || w.together, || "the twin cannot be restored".to_owned());
        // The samples between that state and a later one are gone for the instance, not for the twin.
        w.recording &= w.together;
        w.model = model;
    }
    w.compare();
}

/// Passes a state instead of its address, as fmusim does.
fn free_by_value(w: &mut Walker, chance: &mut Chance, others: &Strangers) {
    let own = (!w.saved.is_empty() && chance.one_in(2)).then(|| chance.below(w.saved.len()));
    let strange: Vec<usize> = w.freed.iter().map(|handle| handle.addr()).chain(others.states.iter().copied()).collect();
    let handle = match own {
        Some(index) => w.saved[index].handle,
        None if strange.is_empty() => return,
        None => ptr::without_provenance_mut(*chance.pick(&strange)),
    };
    let own = w.saved.iter().position(|saved| saved.handle == handle);
    // SAFETY: a handle is no address and is not followed.
    let status = unsafe { fmi2FreeFMUstate(w.subject.c, handle.cast()) };
    w.judge("fmi2FreeFMUstate", if own.is_some() { OK } else { ERROR }, status, || format!("{handle:?} itself"));
    if let Some(index) = own {
        let saved = w.saved.swap_remove(index);
        forget_twins(w, &saved);
        w.freed.push(saved.handle);
    }
}

pub(super) fn free_state(w: &mut Walker, chance: &mut Chance, kind: bool, others: &Strangers) {
    if !kind && chance.one_in(4) {
        return free_by_value(w, chance, others);
    }
    if w.saved.is_empty() || !kind && chance.one_in(2) {
        let wrong = not_ours(w, chance, others);
        let (mut handle, mut verdict) = (wrong, ERROR);
        let mut pointer = &raw mut handle;
        match chance.below(4) {
            0 => (pointer, verdict) = (ptr::null_mut(), OK),
            1 => (handle, verdict) = (ptr::null_mut(), OK),
            _ => {}
        }
        let before = handle;
        // SAFETY: a pointer to one value, or NULL. The handle in it may have any value.
        let status = unsafe { fmi2FreeFMUstate(w.subject.c, pointer) };
        w.judge("fmi2FreeFMUstate", verdict, status, || format!("{before:?}"));
        w.require(handle == before, || "the handle changed".to_owned());
        return;
    }
    let index = chance.below(w.saved.len());
    let mut handle = w.saved[index].handle;
    // SAFETY: a handle of this instance.
    let status = unsafe { fmi2FreeFMUstate(w.subject.c, &raw mut handle) };
    w.judge("fmi2FreeFMUstate", OK, status, || format!("state {index}"));
    w.require(handle.is_null(), || "the handle is not NULL".to_owned());
    let saved = w.saved.swap_remove(index);
    forget_twins(w, &saved);
    w.freed.push(saved.handle);
}

pub(super) fn state_size(w: &mut Walker, chance: &mut Chance, kind: bool, others: &Strangers) {
    let good = !w.saved.is_empty() && (kind || chance.one_in(2));
    let handle = if good { chance.pick(&w.saved).handle } else { not_ours(w, chance, others) };
    let null = !kind && chance.one_in(4);
    let mut size = 0;
    let pointer = if null { ptr::null_mut() } else { &raw mut size };
    // SAFETY: any handle may be passed; a pointer to one value, or NULL.
    let status = unsafe { fmi2SerializedFMUstateSize(w.subject.c, handle, pointer) };
    let done = w.judge("fmi2SerializedFMUstateSize", if good && !null { OK } else { ERROR }, status, || {
        format!("{handle:?}, NULL {null}")
    });
    w.require(done == (size > 0), || format!("size {size}"));
}

pub(super) fn serialize(w: &mut Walker, chance: &mut Chance, kind: bool, others: &Strangers) {
    let good = !w.saved.is_empty() && (kind || !chance.one_in(3));
    let handle = if good { chance.pick(&w.saved).handle } else { not_ours(w, chance, others) };
    let mut size = 0;
    if good {
        // SAFETY: a handle of this instance; a pointer to one value.
        assert_eq!(unsafe { fmi2SerializedFMUstateSize(w.subject.c, handle, &raw mut size) }, Status::Ok);
    }
    let mut bytes = vec![0xa5u8; size + 2];
    let (mut said, mut null) = (size, false);
    match if kind { 9 } else { chance.below(6) } {
        0 => said = *chance.pick(&[0, 1, size.saturating_sub(1), size + 1]),
        1 => null = true,
        _ => {}
    }
    let right = good && said == size && !null;
    let pointer = if null { ptr::null_mut() } else { bytes.as_mut_ptr().cast() };
    // SAFETY: any handle may be passed; the buffer has at least the size said, or is NULL.
    let status = unsafe { fmi2SerializeFMUstate(w.subject.c, handle, pointer, said) };
    let done = w.judge("fmi2SerializeFMUstate", if right { OK } else { ERROR }, status, || {
        format!("{handle:?}, {said} of {size}")
    });
    let untouched = if done { &bytes[size..] } else { &bytes[..] };
    w.require(untouched.iter().all(|byte| *byte == 0xa5), || "written where nothing was wanted".to_owned());
}

/// A state as bytes, for this instance and others.
pub(super) fn publish(w: &Walker, chance: &mut Chance) -> Option<Blob> {
    if w.saved.is_empty() {
        return None;
    }
    let saved = chance.pick(&w.saved);
    let bytes = Arc::new(w.subject.serialize(saved.handle));
    let sound = saved.twin.is_some();
    Some(Blob { scene: w.stage.name, bytes, model: saved.model.clone(), sound })
}

pub(super) fn deserialize(w: &mut Walker, chance: &mut Chance, kind: bool, others: &Strangers) {
    let own = publish(w, chance);
    let list: Vec<Blob> = others.blobs.iter().cloned().chain(own).collect();
    if list.is_empty() || w.saved.len() == MOST {
        return;
    }
    let blob = chance.pick(&list).clone();
    let mut bytes = blob.bytes.to_vec();
    let mut right = blob.scene == w.stage.name;
    match if kind { 9 } else { chance.below(8) } {
        0 | 1 => {
            let index = chance.below(bytes.len());
            bytes[index] ^= 1 << chance.below(8);
            right = false;
        }
        2 => {
            bytes.truncate(chance.below(bytes.len()));
            right = false;
        }
        3 => {
            bytes.extend_from_slice(&[0; 8][..1 + chance.below(8)]);
            right = false;
        }
        4 => {
            bytes = (0..chance.below(2000)).map(|_| chance.number() as u8).collect();
            right = false;
        }
        _ => {}
    }
    let pointer_is_null = !kind && chance.one_in(8);
    let mut handle = if !kind && chance.one_in(8) { not_ours(w, chance, others) } else { ptr::null_mut() };
    let before = handle;
    let pointer = if pointer_is_null { ptr::null_mut() } else { &raw mut handle };
    right &= !pointer_is_null && before.is_null();
    // SAFETY: as many bytes as said; a pointer to one value, or NULL.
    let status = unsafe { fmi2DeSerializeFMUstate(w.subject.c, bytes.as_ptr().cast(), bytes.len(), pointer) };
    let call = || format!("{} bytes of {}, over {before:?}, in {:?}", bytes.len(), blob.scene, blob.model.state);
    let done = w.judge("fmi2DeSerializeFMUstate", if right { OK } else { ERROR }, status, call);
    w.require(done || handle == before, || "the handle changed".to_owned());
    if done {
        // The twin takes the same bytes, if they come from a run that broke no rule.
        let twin = (blob.sound && blob.model.state != State::Error).then(|| w.twin.deserialize(&bytes).unwrap());
        w.saved.push(Saved { handle, twin, model: blob.model });
    }
}
