//! The adversary: what a machine tries that no host should do. Seeds are printed, and each case that it has found is kept as a test
//! of its own where it belongs.
//!
//! `unsafe` is what a C interface is called with.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used)]

#[path = "../fmi2/host.rs"]
#[allow(dead_code)]
mod host;
mod misuse;
