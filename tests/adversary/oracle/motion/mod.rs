//! The state, its derivative, its integration, its balance at rest, and what is read of it.

pub mod balance;
pub(crate) mod instant;
pub mod linear;
mod rates;
mod ring_rates;
pub mod run;
pub mod signals;
pub mod turning;
