//! Sine, cosine and random numbers with the same bits on every machine.
//!
//! The standard library's sine and cosine are the platform's own; these are compiled with the project.

pub mod counter_noise;
mod trigonometry;

pub use trigonometry::{sin_cos, wrap};
