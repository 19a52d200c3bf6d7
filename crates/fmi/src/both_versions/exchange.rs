//! What the functions of model exchange share in both versions: a mode in which they may be called, and an instance
//! that somebody else integrates.

use crate::instance::Mode::{ContinuousTime, Error, Event, Initialization, Terminated};
use crate::instance::{Failure, Modes, modes};

pub(crate) type Instance<'a> = &'a mut crate::instance::Instance;
pub(crate) type Done = Result<(), Failure>;

/// Modes in which what the model is may be read.
pub(crate) const AT_ANY_TIME: Modes = modes([Initialization, Event, ContinuousTime, Terminated, Error]);

/// Functions of a version and its handle, by name and arguments: the modes in which they may be called, and what they
/// do. `ALWAYS` and `Status` are the version's.
macro_rules! functions {
    ($version:ident, $handle:ty;
        $($(#[$meaning:meta])* $name:ident($($argument:ident: $type:ty),*) $within:expr, $body:expr;)*) => {$(
        $(#[$meaning])*
        ///
        /// # Safety
        /// The instance may be any value; pointers are null or point to what their names say, arrays to as many
        /// elements as said.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: $handle, $($argument: $type),*) -> Status {
            use crate::instance::{Function, Modes, Version};
            const ANY: Function = Function { name: stringify!($name), version: Version::$version, allowed: ALWAYS };
            const WITHIN: Modes = $within;
            const HERE: Function = Function { name: stringify!($name), version: Version::$version, allowed: WITHIN };
            crate::boundary::call(instance, &ANY, |instance| {
                instance.exchanges(&HERE, &WITHIN)?;
                #[allow(clippy::redundant_closure_call)]
                ($body)(instance, &HERE, $($argument),*)
            })
        }
    )*};
}

pub(crate) use functions;
