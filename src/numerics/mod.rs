//! Deterministic elementary functions and small numerical tools that know nothing of bearings.
//!
//! Bits must be equal on every machine. The standard library's sine, cosine and power functions are the
//! platform's own; those used here are compiled with the project.

pub mod bytes;
pub mod checksum;
pub mod elementary;
pub mod lanes;
pub mod lists;
pub mod low_pass;
pub mod number;
pub mod plane;
pub mod polynomials;
#[cfg(test)]
pub(crate) mod trees;

pub use elementary::counter_noise;
pub use elementary::ninth_root::ninth_root;
pub use elementary::power::rough_power;
pub use elementary::trigonometry::{SMALL_ANGLE, direction_angle, sin_cos, small_turn, wrap};
