//! The FMI 2.0 rules, each shown by a test that calls the exported C functions as a host would.
//!
//! `unsafe` is what a C interface is called with; each test passes only what its sentence says.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

mod derivatives;
mod host;
mod hostile;
mod input_derivatives;
mod instantiate;
mod logging;
mod modes;
mod output_derivatives;
mod panics;
mod parameter_derivatives;
mod processes;
mod recordings;
mod saved_states;
mod steps;
mod variables;
