//! A ball bearing whose rings move in space, a second time: contact law `hertz`, line spalls with sharp edges.
//!
//! Groove centres lie on circles, of radius C_o = R_o − r_go and C_i = R_i + r_gi about their ring's axis, so that a
//! contact is the distance of a ball's centre from a circle. Every derivative here is a difference quotient, and the
//! integration is a Runge–Kutta pair with its own error estimate: what the library differentiates and what it steps by
//! has no part in it.

mod bearing;
mod case;
mod contact;
#[cfg(test)]
mod figures;
#[cfg(test)]
mod motion_figures;
mod random;
mod run;
mod spall;
mod statics;
pub mod vector;

pub use bearing::{Acting, Ball, SpatialBearing};
pub use case::{AxialSetting, Body, Gyroscopic, Host, Spall, SpatialCase, SpatialRing, Step};
pub use random::random;
pub use run::{SpatialRun, Stop};
pub use statics::{Balance, Held};
