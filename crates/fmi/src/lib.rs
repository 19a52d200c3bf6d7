//! A Brinell bearing as hosts of the Functional Mock-up Interface see it: the dynamic library inside an FMU.
//!
//! The only crate of the workspace that exports C functions, and tests and benches aside the only one with `unsafe`
//! code. It leaves the floating-point control state as it was, starts no thread, keeps nothing in thread-local storage
//! and prints nothing.
//!
//! | file or folder | knows |
//! |---|---|
//! | `c_interface` | the C types that both versions share, callbacks, the logger, addresses of files |
//! | `arithmetic` | the processor's rounding during a call, whatever the host's is |
//! | `arguments` | how an argument from C becomes a slice or a string |
//! | `both_versions` | what the functions of both versions share: those that differ by their names alone, variables of
//! all types, model exchange |
//! | `boundary` | how a call reaches its instance, and what becomes of panics and failures |
//! | `instance` | one instance: model, clock, mode, handles, failures, saved states, references of FMI 3.0 |
//! | `instantiation` | how an instance comes to be, or why it does not |
//! | `intermediate` | steps that tell the host how far they have come, and return early |
//! | `resources` | where the model lies, how it is read once for all instances, and what can be wrong with it |
//! | [`fmi2`], [`fmi3`] | the functions of FMI 2.0 and of FMI 3.0 |

#![allow(unsafe_code)]

pub(crate) mod arguments;
pub(crate) mod arithmetic;
mod both_versions;
pub(crate) mod boundary;
mod c_interface;
pub mod fmi2;
pub mod fmi3;
pub mod instance;
pub(crate) mod instantiation;
pub(crate) mod intermediate;
pub mod resources;
