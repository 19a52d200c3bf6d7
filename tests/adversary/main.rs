//! The adversary: random scenes, recordings, calls and symmetries that look for a silent wrong number.
//!
//! A failure prints its seed. `BRINELL_SEED=7 cargo test --test adversary NAME` replays it; `BRINELL_SCENES=10000` makes every
//! random test that long, beginning with `BRINELL_SEED` if both are given.

#![allow(clippy::unwrap_used, clippy::expect_used, unreachable_pub)]

mod case;
mod draw;
mod oracle;
mod recordings;
mod scenes;
