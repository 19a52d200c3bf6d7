//! Deterministic elementary functions and small numerical tools that know nothing of bearings.
//!
//! Bits must be equal on every machine. The standard library's sine, cosine and power functions are the
//! platform's own; those used here are compiled with the project.

pub mod bytes;
pub mod checksum;
pub mod counter_noise;
pub mod elliptic;
pub mod hermite;
pub mod lanes;
pub mod low_pass;
mod ninth_root;
pub mod number;
pub mod plane;
mod power;
pub(crate) mod quintic;
pub mod row;
#[cfg(test)]
pub(crate) mod trees;
mod trigonometry;

pub use ninth_root::ninth_root;
pub use power::rough_power;
pub use trigonometry::{sin_cos, wrap};
