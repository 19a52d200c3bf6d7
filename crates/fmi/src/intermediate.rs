//! A step that tells its host how far it has come: FMI 3.0's intermediate update, and the early return it may ask for.
//!
//! The host is called after each accepted integration step. It may read outputs as they are there and set inputs, which
//! then act from there on. A run that is inspected so has the bits of one that is not, unless inputs are set. An early
//! return ends the step where the host was called, or at a later instant that it names, and that exactly.

use crate::boundary;
use crate::c_interface::Bool;
use crate::instance::{Borrowed, Clock, Failure, GivenUp, Mode};

/// Takes a step from a communication point, with intermediate updates if the host wants them. Gives the time (s) that
/// it has reached, and whether that is before the end asked for.
pub(crate) fn take_step(instance: &mut Borrowed, point: f64, step: f64) -> Result<(f64, bool), Failure> {
    if instance.updates.is_none() {
        instance.take_step(point, step)?;
        let clock = instance.clock.ok_or(Failure::NotSetUp)?;
        return Ok((clock.time, false));
    }
    let whole = instance.begin_step(point, step)?;
    let mut under_way = instance.simulation.begin_step(step)?;
    let mut early = false;
    while !under_way.is_done() {
        instance.simulation.advance_once(&mut under_way)?;
        let inspection = instance.simulation.inspect(&under_way);
        let time = if under_way.is_done() && !early { whole.time } else { point + under_way.elapsed() };
        // Rounding may not lead beyond the step.
        let time = time.clamp(point, whole.time);
        let wanted = update(instance, [point, time, whole.time], under_way.is_done())?;
        instance.simulation.resume(&mut under_way, inspection)?;
        if let Some(at) = wanted {
            under_way.shorten_to(at - point);
            early |= at < whole.time;
        }
    }
    let clock = instance.clock.ok_or(Failure::NotSetUp)?;
    let reached = if early { clock.moved(point, under_way.elapsed()) } else { whole };
    let length = under_way.elapsed();
    instance.simulation.end_step(under_way);
    instance.finish_step(reached, length)?;
    Ok((reached.time, early))
}

/// Calls the host at `time` in a step between two others (s). Gives the time at which it wants the step to return
/// early, if it does.
fn update(instance: &mut Borrowed, [from, time, to]: [f64; 3], is_done: bool) -> Result<Option<f64>, Failure> {
    let Some(updates) = &mut instance.updates else { return Ok(None) };
    let (callback, environment) = (updates.callback, updates.environment);
    let can_return = updates.early_return && !is_done;
    updates.may_set = updates.with_inputs && !is_done;
    updates.failed = false;
    let may_set = updates.may_set;
    let clock = instance.clock;
    instance.clock = clock.map(|clock| Clock { time, ..clock });
    instance.mode = Mode::IntermediateUpdate;
    let (mut wanted, mut at): (Bool, f64) = (0, time);
    let returned = instance.lend(|| {
        boundary::guard(|| {
            let (wanted, at) = (&raw mut wanted, &raw mut at);
            // SAFETY: the host promises a callable function for as long as the instance lives (FMI 3.0,
            // fmi3InstantiateCoSimulation); the variables are ours and outlive the call.
            unsafe { callback(environment, time, may_set.into(), 1, 1, can_return.into(), wanted, at) };
        })
    });
    let returned = returned.map_err(|GivenUp| Failure::GivenUp)?;
    instance.mode = Mode::StepComplete;
    instance.clock = clock;
    returned.map_err(Failure::UpdateUnwound)?;
    if instance.updates.as_ref().is_some_and(|updates| updates.failed) {
        return Err(Failure::FailedInUpdate(time));
    }
    if wanted == 0 || !can_return {
        return Ok(None);
    }
    if !(at >= from && at <= to) {
        return Err(Failure::EarlyReturnTime { at, from, to });
    }
    Ok(Some(at))
}
