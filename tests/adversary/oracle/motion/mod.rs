//! What the state's derivative is, its integration, its balance at rest, and what is read of it.

pub mod balance;
pub mod linear;
mod rates;
mod ring_rates;
pub mod run;
pub mod signals;
pub mod surfaces;
