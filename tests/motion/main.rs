//! How bearings move: against laws of mechanics, closed forms and each other.
#![allow(clippy::unwrap_used, clippy::expect_used)]

#[path = "../support/counting.rs"]
mod counting;
mod defects;
mod equilibrium;
mod exactness;
mod exchange;
mod fastest_eigenvalue;
mod host;
mod parts;
mod physics;
mod sensing;
#[path = "../support/mod.rs"]
mod support;
mod trajectories;
