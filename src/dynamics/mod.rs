//! Equations of motion of rings, rolling elements and sensor: state in, derivative and forces out.
//!
//! Knows neither steps nor hosts. Time enters only through a [`drive::Drive`], which gives the cage angle and the
//! prescribed motions and loads as polynomials of the time since the last communication point.

pub mod between;
pub mod contact_lanes;
pub mod drive;
pub mod equilibrium;
pub mod equilibrium_variation;
pub mod forces;
pub mod jacobian;
mod linearized;
pub mod model;
pub mod rings;
pub mod tangent;
pub mod variation;
