//! A Brinell bearing as hosts of the Functional Mock-up Interface see it: the dynamic library inside an FMU.
//!
//! The only crate of the workspace that exports C functions. Tests and benches aside it is the only one with `unsafe`
//! code, but for the small host of the command `check` (`fmu-build/src/slave.rs`, `slave3.rs`), which calls such
//! functions. It touches no floating-point control state, starts no thread, keeps nothing in thread-local storage and
//! prints nothing.
//!
//! | file | knows |
//! |---|---|
//! | `c_types` | the C types that the versions of the interface share, and the callbacks of both |
//! | `mode` | the modes of an instance |
//! | `boundary` | how a call reaches its instance, and what becomes of panics and failures |
//! | `handles` | which handles are alive; a stale or invented one is refused without being dereferenced |
//! | `arguments` | how an argument from C becomes a slice or a string |
//! | `failure` | what can go wrong, with which status and which advice |
//! | `logger` | the host's logger and its categories |
//! | `instantiation` | how an instance comes to be, or why it does not |
//! | `uri`, `resources`, `resource_error` | where the scene lies, how it is read, and what can be wrong with it |
//! | `shared_models` | the models read, one for all instances that have the same resources |
//! | `clock` | communication points and steps |
//! | `instance` | one instance: model, clock, mode |
//! | `snapshot`, `snapshots`, `blob` | a saved state, as a handle and as bytes |
//! | `addressing` | what references stand for in FMI 3.0: rows of the variable table, arrays, the time |
//! | `intermediate_updates` | what a host wants of intermediate updates |
//! | `intermediate` | steps that tell the host how far they have come, and return early |
//! | [`fmi2`], [`fmi3`] | the functions of FMI 2.0 and of FMI 3.0 |

#![allow(unsafe_code)]

pub(crate) mod arguments;
pub(crate) mod boundary;
mod c_interface;
pub mod fmi2;
pub mod fmi3;
pub mod instance;
pub(crate) mod instantiation;
pub(crate) mod intermediate;
pub mod resources;
mod variables;
