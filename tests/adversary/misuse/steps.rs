//! Calls that step through time, say how a step went, and tell how inputs and outputs go on.

use super::chance::Chance;
use super::stage::is_real;
use super::standard::{DISCARD, ERROR, OK};
use super::walker::{State, Strangers, Walker};
use brinell::simulation::interface::table::Causality;
use brinell_fmi::fmi2::*;
use std::ffi::CStr;
use std::ptr;

/// A step that a sensible host might take from `time`: long against the rounding of the time, short against a run.
fn step_size(time: f64, chance: &mut Chance) -> f64 {
    if time.abs() > 1e4 || chance.one_in(2) { chance.between(2e-5, 2e-4) } else { chance.decades(1e-6, 1e-4) }
}

pub(super) fn do_step(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let (time, stop) = w.model.clock.unwrap_or((0.0, None));
    let mut step = step_size(time, chance);
    let (mut point, mut wrong) = (time, false);
    if !kind {
        wrong = true;
        match chance.below(12) {
            // Skipped, repeated, half a step off, a second back.
            0 => point = time + step,
            1 => point = time - step,
            2 => point = time + 0.5 * step,
            3 => point = time - 0.5 * step,
            4 => point = time - 0.9,
            5 => point = *chance.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX]),
            6 => step = *chance.pick(&[0.0, -0.0, -1e-5, f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
            // A host's rounding.
            7 => (point, wrong) = (time.next_up(), false),
            8 => (point, wrong) = (time.next_down(), false),
            _ => wrong = false,
        }
    }
    let end = point + step;
    let mut verdict = if wrong { ERROR } else { OK };
    if let Some(stop) = stop.filter(|_| !wrong) {
        let beyond = end - stop;
        if beyond > 0.4 * step {
            verdict = ERROR;
        } else if beyond > 0.0 {
            // Perhaps a host's rounding.
            verdict = OK.or(ERROR);
        }
    }
    let mut may_lack_room = false;
    if verdict == OK {
        may_lack_room = w.file != Some(false) && w.lacks_room();
        verdict = w.unless_wild(if may_lack_room { OK.or(ERROR) } else { OK });
        may_lack_room &= !w.model.wild && w.model.state == State::StepComplete;
    }
    let looks = !w.model.rates.is_empty() && w.model.state == State::StepComplete;
    let before = if looks { read_inputs(w) } else { None };
    let repeatable = Boolean::from(chance.one_in(2));
    // SAFETY: no pointers but the handle.
    let status = unsafe { fmi2DoStep(w.subject.c, point, step, repeatable) };
    let done = w.judge("fmi2DoStep", verdict, status, || format!("{point:?}, {step:?}"));
    if w.model.state == State::Error {
        w.model.last_step = Status::Error;
    }
    if done {
        w.follow(move |twin| twin.step(point, step));
        w.model.clock = Some((end, stop));
        w.model.last_step = Status::Ok;
        if let Some(before) = before {
            inputs_follow_their_derivatives(w, &before, step);
        }
        w.model.rates.clear();
    } else if verdict != ERROR {
        w.tally.no_room += u64::from(may_lack_room);
        // A step that failed half-way has left samples behind.
        w.recording = false;
    }
}

fn read_inputs(w: &mut Walker) -> Option<Vec<(u32, f64)>> {
    let inputs = w.stage.reals(Some(Causality::Input));
    let values = w.subject.get(&inputs);
    w.subject.lines();
    Some(inputs.into_iter().zip(values.ok()?).collect())
}

/// A derivative that was accepted has moved its input: x + x′h + x″h²/2. What the host leaves out of a ring's motion is
/// taken from its velocity and acceleration.
fn inputs_follow_their_derivatives(w: &mut Walker, before: &[(u32, f64)], h: f64) {
    let after = read_inputs(w).unwrap();
    let value = |name: &str| {
        let of = |(reference, _): &&(u32, f64)| w.stage.variable(*reference).name == name;
        before.iter().find(of).map_or(0.0, |(_, value)| *value)
    };
    for (reference, rates) in &w.model.rates {
        let name = w.stage.variable(*reference).name.as_str();
        // "shaft.vy" goes on as "shaft.ay" says, unless its derivative is given.
        let (ring, letters) = name.split_once('.').unwrap();
        let motion = letters.strip_prefix('v').map(|axis| value(&format!("{ring}.a{axis}")));
        let rate =
            |name: String| w.model.rates.iter().find(|(r, _)| w.stage.variable(**r).name == name).map(|(_, r)| r[0]);
        // What a ring's acceleration and velocity say together with its position would be another polynomial.
        let alone = |axis: &str| ["v", "a"].iter().all(|motion| rate(format!("{ring}.{motion}{axis}")).is_none());
        if matches!(letters, "x" | "y") && (rates.contains(&None) || !alone(letters)) {
            continue;
        }
        let jerk = letters.strip_prefix('v').and_then(|axis| rate(format!("{ring}.a{axis}"))).flatten();
        let (first, second) = (rates[0].or(motion).unwrap_or(0.0), rates[1].or(jerk).unwrap_or(0.0));
        let of = |list: &[(u32, f64)]| list.iter().find(|(r, _)| r == reference).unwrap().1;
        let (start, end) = (of(before), of(&after));
        // A position's derivative takes its velocity along, whose own is then no matter.
        let overridden = letters.strip_prefix('v').is_some_and(|axis| {
            let position = format!("{ring}.{axis}");
            w.model.rates.keys().any(|other| w.stage.variable(*other).name == position)
        });
        let moved = start + first * h + 0.5 * second * h * h;
        // Rounding of a few operations.
        let margin = 1e-12 * (start.abs() + (first * h).abs() + (second * h * h).abs());
        let right = overridden || (end - moved).abs() <= margin;
        w.require(right, || {
            format!("{name} went from {start:?} to {end:?}, not {moved:?}: derivatives {rates:?}, step {h:?}")
        });
    }
}

pub(super) fn input_derivatives(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let inputs = w.stage.reals(Some(Causality::Input));
    let mut reference = *chance.pick(&inputs);
    let mut order = if kind { 1 } else { 1 + chance.below(2) as i32 };
    let size = match (w.stage.variable(reference).name.rsplit_once('.').unwrap().1, order) {
        ("speed", 1) => 1e3,
        ("speed", _) => 1e6,
        // Positions move by some micrometres, velocities by millimetres a second, loads by some newtons.
        ("x" | "y", 1) if w.stage.variable(reference).name.contains("load") => 1e4,
        ("x" | "y", _) if w.stage.variable(reference).name.contains("load") => 1e7,
        ("x" | "y", 1) => 1e-3,
        ("x" | "y", _) | ("vx" | "vy", 1) => 1.0,
        ("vx" | "vy", _) | ("ax" | "ay", 1) => 1e3,
        _ => 1e6,
    };
    let mut value = chance.between(-size, size);
    // Orders above those that act, as the description says, are discarded.
    let highest = if w.stage.variable(reference).description.contains("orders 1 and 2 act") { 2 } else { 1 };
    let mut verdict = if order > highest { DISCARD } else { OK };
    let (mut turns_wild, mut count) = (false, 1);
    match if kind { 9 } else { chance.below(9) } {
        0 => (value, verdict) = (*chance.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]), DISCARD),
        1 => {
            (order, verdict) =
                *chance.pick(&[(0, ERROR), (-1, ERROR), (3, DISCARD), (i32::MAX, DISCARD), (i32::MIN, ERROR)])
        }
        2 => (reference, verdict) = (w.stage.unknown(chance), ERROR),
        3 => {
            let others = w.stage.references(|v| v.causality != Causality::Input);
            (reference, verdict) = (*chance.pick(&others), ERROR);
        }
        4 => (count, verdict) = (usize::MAX, ERROR),
        5 => (value, turns_wild) = (value * chance.decades(1.0, 1e12), true),
        6 => (count, verdict) = (0, OK),
        _ => {}
    }
    let null = !kind && chance.one_in(12);
    let orders = if null { ptr::null() } else { &raw const order };
    if null && count > 0 {
        verdict = ERROR;
    }
    // SAFETY: one element each, or arguments that are to be refused.
    let status =
        unsafe { fmi2SetRealInputDerivatives(w.subject.c, &raw const reference, count, orders, &raw const value) };
    let call = || format!("{reference}, {count}, order {order}, {value:?}");
    if w.judge("fmi2SetRealInputDerivatives", verdict, status, call) && count == 1 {
        w.follow(move |twin| {
            // SAFETY: one element each.
            unsafe { fmi2SetRealInputDerivatives(twin.c, &raw const reference, 1, &raw const order, &raw const value) }
        });
        w.model.wild |= turns_wild;
        w.model.rates.entry(reference).or_default()[order as usize - 1] = Some(value);
    }
}

pub(super) fn output_derivatives(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let outputs = w.stage.reals(Some(Causality::Output));
    let mut list: Vec<u32> = (0..chance.below(6)).map(|_| *chance.pick(&outputs)).collect();
    let mut orders = vec![1; list.len()];
    let mut verdict = OK.or(DISCARD);
    if !kind && !list.is_empty() {
        match chance.below(5) {
            0 => (orders[0], verdict) = (*chance.pick(&[0, 2, -1, i32::MAX]), ERROR),
            1 => (list[0], verdict) = (w.stage.unknown(chance), ERROR),
            2 => {
                let others = w.stage.references(|v| !outputs.contains(&v.reference));
                (list[0], verdict) = (*chance.pick(&others), DISCARD);
            }
            _ => {}
        }
    }
    let mut values = vec![f64::NAN; list.len()];
    let (vr, value) = (list.as_ptr(), values.as_mut_ptr());
    // SAFETY: the arrays are as long as said.
    let status = unsafe { fmi2GetRealOutputDerivatives(w.subject.c, vr, list.len(), orders.as_ptr(), value) };
    w.judge("fmi2GetRealOutputDerivatives", w.unless_wild(verdict), status, || format!("{list:?}, {orders:?}"));
    if status == Status::Ok {
        w.follow(move |twin| {
            let mut values = vec![0.0; list.len()];
            let (vr, value) = (list.as_ptr(), values.as_mut_ptr());
            // SAFETY: the arrays are as long as said.
            unsafe { fmi2GetRealOutputDerivatives(twin.c, vr, list.len(), orders.as_ptr(), value) }
        });
    }
    let fine = status != Status::Ok || values.iter().all(|value| value.is_finite());
    w.require(fine, || format!("not finite under OK: {values:?}"));
}

pub(super) fn directional(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let outputs = w.stage.reals(Some(Causality::Output));
    let inputs = w.stage.reals(Some(Causality::Input));
    let mut unknowns: Vec<u32> = (0..chance.below(6)).map(|_| *chance.pick(&outputs)).collect();
    let mut knowns: Vec<u32> = (0..chance.below(4)).map(|_| *chance.pick(&inputs)).collect();
    let mut seed: Vec<f64> = knowns.iter().map(|_| chance.between(-1.0, 1.0)).collect();
    let mut verdict = OK.or(DISCARD);
    match if kind { 9 } else { chance.below(6) } {
        0 if !unknowns.is_empty() => (unknowns[0], verdict) = (w.stage.unknown(chance), ERROR),
        1 if !knowns.is_empty() => {
            let others = w.stage.references(|v| !is_real(v) || v.causality == Causality::Output);
            (knowns[0], verdict) = (*chance.pick(&others), DISCARD);
        }
        2 if !seed.is_empty() => {
            seed[0] = *chance.pick(&[f64::NAN, f64::INFINITY, f64::MAX, 1e300]);
            verdict = OK.or(DISCARD).or(ERROR);
        }
        _ => {}
    }
    let mut values = vec![f64::NAN; unknowns.len()];
    let (u, k) = (unknowns.as_ptr(), knowns.as_ptr());
    // SAFETY: the arrays are as long as said.
    let status = unsafe {
        fmi2GetDirectionalDerivative(
            w.subject.c,
            u,
            unknowns.len(),
            k,
            knowns.len(),
            seed.as_ptr(),
            values.as_mut_ptr(),
        )
    };
    w.judge("fmi2GetDirectionalDerivative", w.unless_wild(verdict), status, || {
        format!("{unknowns:?}, {knowns:?}, {seed:?}")
    });
    let fine = status != Status::Ok || values.iter().all(|value| value.is_finite());
    w.require(fine, || format!("not finite under OK: {values:?}"));
}

/// A kind of status: the one that a function knows, another one, or no kind at all.
fn status_kind(chance: &mut Chance, kind: bool, known: StatusKind) -> StatusKind {
    if kind || chance.one_in(2) { known } else { *chance.pick(&[0, 1, 2, 3, 4, -1, i32::MAX, i32::MIN]) }
}

type Get<T> = unsafe extern "C" fn(Component, StatusKind, *mut T) -> Status;

/// Asks a function for the status that it knows, another one or none, into a value or to NULL. True if it was given.
fn told<T>(
    (w, chance, kind): (&mut Walker, &mut Chance, bool),
    (function, get): (&'static str, Get<T>),
    known: StatusKind,
    value: &mut T,
) -> bool {
    let asked = status_kind(chance, kind, known);
    let null = !kind && chance.one_in(4);
    let pointer = if null { ptr::null_mut() } else { ptr::from_mut(value) };
    let verdict = if null { ERROR } else { OK };
    let verdict = if asked == known { verdict } else { DISCARD };
    // SAFETY: a pointer to one value, or NULL.
    let status = unsafe { get(w.subject.c, asked, pointer) };
    w.judge(function, verdict, status, || format!("{asked}, NULL {null}"))
}

pub(super) fn status(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let mut value = Status::Fatal;
    let done = told((w, chance, kind), ("fmi2GetStatus", fmi2GetStatus), DO_STEP_STATUS, &mut value);
    w.require(!done || value == w.model.last_step, || format!("{value:?}"));
}

pub(super) fn real_status(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let mut value = f64::NAN;
    let done = told((w, chance, kind), ("fmi2GetRealStatus", fmi2GetRealStatus), LAST_SUCCESSFUL_TIME, &mut value);
    // The step has landed exactly where the host computes its end.
    let time = w.model.clock.map(|(time, _)| time);
    w.require(!done || Some(value) == time, || format!("{value:?} and not {time:?}"));
}

pub(super) fn integer_status(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let asked = status_kind(chance, kind, DO_STEP_STATUS);
    let mut value = 77;
    // SAFETY: a pointer to one value.
    let status = unsafe { fmi2GetIntegerStatus(w.subject.c, asked, &raw mut value) };
    w.judge("fmi2GetIntegerStatus", DISCARD, status, || format!("{asked}"));
    w.require(value == 77, || format!("{value}"));
}

pub(super) fn boolean_status(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let mut value = 77;
    let done = told((w, chance, kind), ("fmi2GetBooleanStatus", fmi2GetBooleanStatus), TERMINATED, &mut value);
    w.require(value == if done { FALSE } else { 77 }, || format!("{value}"));
}

pub(super) fn string_status(w: &mut Walker, chance: &mut Chance, kind: bool, _: &Strangers) {
    let mut value: FmiString = ptr::null();
    let done = told((w, chance, kind), ("fmi2GetStringStatus", fmi2GetStringStatus), PENDING_STATUS, &mut value);
    // SAFETY: what is given under OK is a string that ends in NUL.
    w.require(!done || unsafe { CStr::from_ptr(value) } == c"no step is pending", || "text".to_owned());
}
