//! Polynomials given by what they and their derivatives are at the ends of an interval.

pub mod hermite;
mod quintic;

pub(crate) use quintic::Quintic;
