//! The adversary: random scenes, recordings, calls and symmetries that look for a silent wrong number.
//!
//! A failure prints its seed, and each case that was found is kept as a test of its own where it belongs.
//! `BRINELL_SEED=7 cargo test --workspace --test adversary NAME` replays a seed; `BRINELL_SCENES=10000` makes every
//! test of random scenes that long, beginning with `BRINELL_SEED` if both are given.
//!
//! `unsafe` is what a C interface is called with.
#![allow(unsafe_code)]
// What helpers unwrap is the test's own set-up.
#![allow(clippy::unwrap_used, clippy::expect_used, unreachable_pub)]

mod corpus;
mod derivatives;
mod invariances;
mod misuse;
mod recordings;
mod scenes;
mod spatial;
mod subject;
#[path = "../support/mod.rs"]
mod support;
#[path = "../fuzz/src/targets/mod.rs"]
mod targets;
#[path = "../fmi/fmi3/host.rs"]
#[allow(dead_code)]
mod three;
#[path = "../fmi/fmi2/host.rs"]
#[allow(dead_code)]
mod two;
mod units;

use brinell_oracle as oracle;
use brinell_oracle::{case, draw, random_case};
