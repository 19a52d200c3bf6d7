//! The FMI 3.0 rules, each shown by a test that calls the exported C functions as a host would.
//!
//! `unsafe` is what a C interface is called with; each test passes only what its sentence says.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

mod derivatives;
mod host;
mod instantiate;
mod modes;
mod outliving;
mod saved_states;
mod steps;
#[path = "../fmi2/host.rs"]
#[allow(dead_code)]
mod two;
mod updates;
mod variables;
