//! The one border between the host and the model: every function that takes an instance passes through [`call`].
//!
//! No panic crosses it. After a panic the instance alone is in error; it can be reset, or a saved state restored,
//! since both set the simulation up anew. Whoever returns an error leaves the instance in error, as the standard wants
//! it.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::arithmetic::UsualArithmetic;
use crate::c_interface::{Component, Status};
use crate::instance::{Borrowed, Failure, Function, Instance, Mode, handles};

/// Runs a function's body on the instance behind a handle, if the instance's mode allows the function.
#[inline]
pub(crate) fn call<B>(component: Component, function: &'static Function, body: B) -> Status
where
    B: FnOnce(&mut Instance) -> Result<(), Failure>,
{
    call_lending(component, function, |instance| body(instance))
}

/// As [`call`], for a body that lends the instance to calls of the host while it runs.
#[inline]
pub(crate) fn call_lending<B>(component: Component, function: &'static Function, body: B) -> Status
where
    B: FnOnce(&mut Borrowed) -> Result<(), Failure>,
{
    let _usual = UsualArithmetic::begin();
    // There is no instance, so there is no logger: the status has to say it all.
    let Some(mut instance) = handles::borrow(component) else { return Status::Error };
    if !function.allowed.contains(instance.mode) {
        let failure = Failure::OutOfMode { mode: instance.mode, function };
        return fail(&mut instance, function, failure);
    }
    let outcome = catch_unwind(AssertUnwindSafe(|| body(&mut instance)));
    if instance.is_given_up() {
        // The call that is in the instance now says so: its logger is not this one's any more.
        return Status::Error;
    }
    let status = match outcome {
        Ok(Ok(())) => Status::Ok,
        Ok(Err(failure)) => fail(&mut instance, function, failure),
        Err(payload) => {
            instance.damaged = true;
            fail(&mut instance, function, Failure::Panic(words(payload)))
        }
    };
    if instance.mode == Mode::IntermediateUpdate && instance.is_abandoned() {
        instance.mode = Mode::Error;
        return fail(&mut instance, function, Failure::OutlivesUpdate);
    }
    status
}

/// Logs a failure, and puts the instance into error if the failure is one.
#[cold]
#[inline(never)]
fn fail(instance: &mut Instance, function: &'static Function, failure: Failure) -> Status {
    let status = failure.status();
    if status >= Status::Error {
        match &mut instance.updates {
            // The step that is under way must find its instance: it fails when the host returns to it.
            Some(updates) if instance.mode == Mode::IntermediateUpdate => updates.failed = true,
            _ => instance.mode = Mode::Error,
        }
    }
    let logger = &instance.logger;
    // Formatting is code too: if it panics, the line is lost and the status stands.
    let logged = catch_unwind(AssertUnwindSafe(|| {
        let text = || format!("{}: {failure}.{}", function.name, failure.advice(function.version));
        if failure.must_be_told() { logger.tell(status, text()) } else { logger.line(status, text) }
    }));
    drop(logged.map_err(words));
    status
}

/// Runs code that has no instance yet. `None` if it panics.
pub(crate) fn guard<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    let _usual = UsualArithmetic::begin();
    catch_unwind(AssertUnwindSafe(body)).map_err(words)
}

/// What a panic says.
fn words(payload: Box<dyn Any + Send>) -> String {
    let words = if let Some(text) = payload.downcast_ref::<&str>() {
        (*text).to_owned()
    } else if let Some(text) = payload.downcast_ref::<String>() {
        text.clone()
    } else {
        // Dropping what we do not know could panic once more.
        std::mem::forget(payload);
        return "panic of an unknown kind".to_owned();
    };
    drop(payload);
    words
}
