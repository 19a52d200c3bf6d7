//! The rules of FMI, each shown by a test that calls the exported C functions as a host would.
//!
//! `unsafe` is what a C interface is called with; each test passes only what its sentence says.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

mod allocations;
mod both;
#[path = "../support/counting.rs"]
mod counting;
mod fmi2;
mod fmi3;
mod stack;
#[path = "fmi3/host.rs"]
mod three;
#[path = "fmi2/host.rs"]
mod two;
