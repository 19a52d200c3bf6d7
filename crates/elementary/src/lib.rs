//! Sine, cosine and random numbers with the same bits on every machine.
//!
//! The standard library's sine and cosine are the platform's own; these are compiled with the project.

// Units in brackets, as in `[m]`, are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod counter_noise;
mod trigonometry;

pub use trigonometry::{sin_cos, wrap};
