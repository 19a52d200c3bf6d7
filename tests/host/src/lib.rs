//! A small FMI host: just enough to step an FMU's library through its C interface where no other host runs, under Wine,
//! QEMU and Valgrind, and where a benchmark wants nothing in between. [`Instance`] speaks FMI 2.0, [`three::Instance`]
//! FMI 3.0.
//!
//! It trusts the library to follow the standard's binary interface; that is what loading a library means.

#![allow(unsafe_code)]

mod library;
pub mod three;
mod two;

pub use library::{HostError, State, library_beside};
pub use two::Instance;
