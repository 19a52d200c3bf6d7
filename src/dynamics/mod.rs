//! Equations of motion of rings, rolling elements and sensor: state in, derivative and forces out.
//!
//! Knows neither steps nor hosts. Time enters only through an [`Excitation`](parameters::Excitation), which gives the
//! cage angle and the prescribed motions and loads as polynomials of the time since the last communication point.

pub mod contacts;
pub mod derivatives;
mod element;
pub mod equilibrium;
pub mod motion;
pub mod parameters;
pub mod quasi_static;
pub mod spatial;
